//! The luminance of a curve, by a rule that resolves its knots and narrow features.

use super::Spectrum;
use crate::color::cie::{EFFICACY, RANGE_NM, xyz_bar};

/// Nodes (half-widths from the middle) and weights of the Gauss-Legendre rule of three points:
/// exact for a cubic curve times the linear ȳ between two nm.
const GAUSS: [(f64, f64); 3] = [
    (-0.774_596_669_241_483_4, 5.0 / 18.0),
    (0.0, 8.0 / 18.0),
    (0.774_596_669_241_483_4, 5.0 / 18.0),
];

/// 683 ∫ ȳ S dλ: the luminance in cd/m² of a curve read as radiance.
///
/// Exact except for rounding if the curve is piecewise cubic or linear; to 1e-7 for Gaussians of
/// any width and for colors. Less exact for a black body below 10 K, whose light doubles within a
/// nm.
pub fn luminous_integral(spectrum: &Spectrum) -> f64 {
    let (longest_nm, [first_nm, last_nm]) = smooth_pieces(spectrum);
    let mut ends: Vec<f64> = (360..=830)
        .map(f64::from)
        .chain([first_nm, last_nm])
        .collect();
    ends.extend(spectrum.knots_nm());
    ends.retain(|nm| (first_nm..=last_nm).contains(nm));
    ends.sort_by(f64::total_cmp);
    ends.dedup();
    let pieces = ends
        .windows(2)
        .map(|pair| integral(spectrum, pair[0], pair[1], longest_nm));
    EFFICACY * pieces.sum::<f64>()
}

/// The longest step that resolves a curve between its knots, and the part of the table to
/// integrate.
fn smooth_pieces(spectrum: &Spectrum) -> (f64, [f64; 2]) {
    let steps_nm = spectrum.features_nm().map_or(1.0, |width| 0.5 * width);
    match (spectrum, spectrum.support_nm()) {
        (Spectrum::Gaussian { .. }, Some([from, to])) => (
            steps_nm,
            [from, to].map(|nm| nm.clamp(RANGE_NM[0], RANGE_NM[1])),
        ),
        (Spectrum::Rgb(_) | Spectrum::Tinted(_), _) => (steps_nm, RANGE_NM),
        _ => (1.0, RANGE_NM),
    }
}

/// ∫ ȳ S dλ between two wavelengths with no whole nm and no knot between them.
fn integral(spectrum: &Spectrum, from_nm: f64, to_nm: f64, longest_nm: f64) -> f64 {
    let count = ((to_nm - from_nm) / longest_nm).ceil().clamp(1.0, 10_000.0);
    let step_nm = (to_nm - from_nm) / count;
    let mut sum = 0.0;
    for piece in 0..count as u32 {
        let middle_nm = from_nm + (f64::from(piece) + 0.5) * step_nm;
        for (node, weight) in GAUSS {
            let lambda_nm = middle_nm + 0.5 * step_nm * node;
            sum += weight * xyz_bar(lambda_nm)[1] * spectrum.at(lambda_nm);
        }
    }
    sum * step_nm
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::cie::{xyz_of, xyz_with_substeps};
    use crate::color::spaces;
    use crate::spectrum::{Beyond, Sampled, illuminant};

    fn chromaticity([x, y, z]: [f64; 3]) -> [f64; 2] {
        [x / (x + y + z), y / (x + y + z)]
    }

    #[test]
    fn an_equal_energy_spectrum_is_white_at_a_third() {
        let [x, y] = chromaticity(xyz_of(|_| 1.0));
        assert!(
            (x - 1.0 / 3.0).abs() < 1e-4 && (y - 1.0 / 3.0).abs() < 1e-4,
            "{x} {y}"
        );
    }

    #[test]
    fn d65_has_its_published_chromaticity() {
        let d65 = illuminant("D65").unwrap();
        let [x, y] = chromaticity(xyz_of(|nm| d65.at(nm)));
        let white = spaces::D65_XY;
        assert!(
            (x - white[0]).abs() < 1e-4 && (y - white[1]).abs() < 1e-4,
            "{x} {y}"
        );
    }

    #[test]
    fn one_watt_at_555_nm_is_683_lumen() {
        for width_nm in [1e-6, 1e-3, 0.1] {
            let line = Spectrum::Gaussian {
                center_nm: 555.0,
                width_nm,
            };
            let area = width_nm * std::f64::consts::TAU.sqrt();
            let lumen = luminous_integral(&line) / area;
            // ȳ falls by up to 2e-4 within a nm of its peak.
            assert!(
                (lumen / 683.0 - 1.0).abs() < 3e-4 * width_nm.max(1e-2),
                "{width_nm} {lumen}"
            );
        }
    }

    #[test]
    fn luminous_integrals_of_narrow_and_broken_curves_match_brute_force() {
        let sawtooth: Vec<_> = (0..400)
            .map(|i| (400.0 + 0.37 * f64::from(i), f64::from(i % 3)))
            .collect();
        for spectrum in [
            Spectrum::Gaussian {
                center_nm: 589.3,
                width_nm: 1.0,
            },
            Spectrum::Gaussian {
                center_nm: 361.0,
                width_nm: 1.0,
            },
            Spectrum::Gaussian {
                center_nm: 470.2,
                width_nm: 0.2,
            },
            Spectrum::Gaussian {
                center_nm: 500.0,
                width_nm: 1e5,
            },
            Spectrum::Sampled(Sampled::new(&sawtooth, Beyond::Zero).unwrap()),
            illuminant("A").unwrap(),
            illuminant("F11").unwrap(),
        ] {
            let expected = xyz_with_substeps(|nm| spectrum.at(nm), 2000)[1];
            let found = luminous_integral(&spectrum);
            assert!(
                (found / expected - 1.0).abs() < 1e-6,
                "{spectrum:?}: {found} {expected}"
            );
        }
    }

    /// The number of lumen per watt of a black body is greatest, 95, near 6640 K.
    #[test]
    fn a_black_body_gives_at_most_95_lumen_per_watt() {
        let efficacy = |kelvin: f64| {
            xyz_of(|nm| crate::spectrum::planck::radiance(nm, kelvin))[1]
                / crate::spectrum::planck::total(kelvin)
        };
        assert!(
            (efficacy(6640.0) - 95.0).abs() < 0.5,
            "{}",
            efficacy(6640.0)
        );
        assert!(efficacy(6640.0) > efficacy(6400.0).max(efficacy(6900.0)));
    }
}
