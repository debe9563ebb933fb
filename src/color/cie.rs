//! The CIE 1931 2° color-matching functions, and integrals with them.
//!
//! Wavelengths in nm. Radiance in W·m⁻²·sr⁻¹·nm⁻¹ gives XYZ with Y the luminance in cd/m²; power in
//! W/nm gives lumens, and so on: integrals include the factor [`EFFICACY`]. Tables: CIE 015:2018,
//! Colorimetry, at 1 nm.

use super::tables::XYZ_BAR;

/// Luminous efficacy of radiation where ȳ is 1, lm/W (CIE 018:2019, K_m rounded).
pub const EFFICACY: f64 = 683.0;

/// First and last wavelength of the table, nm.
pub const RANGE_NM: [f64; 2] = [360.0, 830.0];

/// x̄, ȳ, z̄ at a wavelength: linear between whole nm, 0 outside 360 to 830 nm.
pub fn xyz_bar(lambda_nm: f64) -> [f64; 3] {
    if !(RANGE_NM[0]..=RANGE_NM[1]).contains(&lambda_nm) {
        return [0.0; 3];
    }
    let place = lambda_nm - RANGE_NM[0];
    let below = (place as usize).min(XYZ_BAR.len() - 2);
    let (low, high) = (XYZ_BAR[below], XYZ_BAR[below + 1]);
    let part = place - below as f64;
    std::array::from_fn(|i| low[i] * (1.0 - part) + high[i] * part)
}

/// XYZ of a curve: 683 ∫ (x̄, ȳ, z̄) f dλ by the trapezoidal rule at 1 nm, as the CIE prescribes.
///
/// For a curve with features narrower than a few nm use [`xyz_with_substeps`].
pub fn xyz_of(curve: impl Fn(f64) -> f64) -> [f64; 3] {
    xyz_with_substeps(curve, 1)
}

/// XYZ of a curve by the trapezoidal rule with `per_nm` steps in each nm: the reference quadrature.
///
/// The error falls as per_nm⁻², once a step is below the curve's narrowest feature; cost grows as
/// 470·per_nm evaluations.
pub fn xyz_with_substeps(curve: impl Fn(f64) -> f64, per_nm: u32) -> [f64; 3] {
    let steps = 470 * per_nm.max(1);
    let step_nm = 470.0 / f64::from(steps);
    let mut sum = [0.0; 3];
    for index in 0..=steps {
        let lambda_nm = RANGE_NM[0] + f64::from(index) * step_nm;
        let end = if index == 0 || index == steps {
            0.5
        } else {
            1.0
        };
        let value = end * curve(lambda_nm);
        let bar = xyz_bar(lambda_nm.min(RANGE_NM[1]));
        (0..3).for_each(|i| sum[i] += bar[i] * value);
    }
    sum.map(|total| EFFICACY * step_nm * total)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_matching_functions_are_their_table_and_zero_outside() {
        assert_eq!(xyz_bar(555.0), [0.5120501, 1.0, 0.005749999]);
        assert_eq!(xyz_bar(360.0), XYZ_BAR[0]);
        assert_eq!(xyz_bar(830.0), XYZ_BAR[470]);
        for outside in [359.999, 830.001, 1e-300, 1e300, f64::NAN] {
            assert_eq!(xyz_bar(outside), [0.0; 3]);
        }
    }
}
