//! Thermal radiation: Planck's law, its peak and its total.
//!
//! Wavelengths in nm, temperatures in K, spectral radiance in W·m⁻²·sr⁻¹·nm⁻¹. At T = 0 everything
//! is 0, and so it is for a temperature or wavelength that is negative or NaN, which
//! [`PlanckShape::new`] rejects by name.
//!
//! Source: Planck 1901, Ann. Phys. 309, 553, §10 (there as energy density), with the exact
//! constants of the SI brochure, 9th edition (2019).

use super::SpectrumError;

/// First radiation constant for spectral radiance, 2hc², in W·m⁻²·sr⁻¹·nm⁴: c₁ in B = c₁λ⁻⁵/(eˣ − 1).
///
/// From h = 662607015·10⁻⁴² J·s and c = 299792458 m/s; 10³⁶ turns m⁻²·m⁻¹·m⁵ into m⁻²·nm⁻¹·nm⁵.
pub const C1: f64 = (2 * 662_607_015_u128 * 299_792_458 * 299_792_458) as f64 / 1e6;

/// Second radiation constant hc/k, in nm·K: x = c₂/(λT).
///
/// From h and c as in [`C1`] and k = 1380649·10⁻²⁹ J/K.
pub const C2: f64 = (662_607_015_u128 * 299_792_458 * 100_000_000 / 1_380_649) as f64 / 1e12;

/// x = c₂/(λT) where B is greatest over λ: the root of x = 5(1 − e⁻ˣ).
const X_PEAK: f64 = 4.965_114_231_744_276;

/// x⁵/(eˣ − 1) at [`X_PEAK`].
const SHAPE_PEAK: f64 = 21.201_435_660_549_92;

/// x at which B has fallen to 1e-30 of its peak, on the side of short and of long wavelengths.
const X_SUPPORT: [f64; 2] = [88.434_812_377_064_57, 6.785_6e-8];

/// Wavelengths (nm) and temperatures (K) between which no factor of B over- or underflows.
const DIRECT_NM: std::ops::Range<f64> = 1e-50..1e50;
const DIRECT_K: std::ops::Range<f64> = 1e-200..1e200;

/// Planck's spectral radiance B(λ, T) = c₁λ⁻⁵ e⁻ˣ/(1 − e⁻ˣ), x = c₂/(λT); W·m⁻²·sr⁻¹·nm⁻¹.
///
/// The relative error is at most 4ε·max(x, 4) while 1e-50 ≤ λ < 1e50 nm: rounding x by 2ε costs
/// 2ε(x + 1), the other factors 5ε; together that is less, and nothing grows with |ln B|. Outside,
/// by [`ln_radiance`], the error is about ε·|ln B| + 2ε·x. The value is 0 below e⁻⁷⁴⁵, and the
/// greatest f64 where it would overflow.
pub fn radiance(lambda_nm: f64, temperature_k: f64) -> f64 {
    if is_dark(lambda_nm, temperature_k) {
        return 0.0;
    }
    if !DIRECT_NM.contains(&lambda_nm) || !DIRECT_K.contains(&temperature_k) {
        return ln_radiance(lambda_nm, temperature_k).exp().min(f64::MAX);
    }
    let x = C2 / (lambda_nm * temperature_k);
    let squared = lambda_nm * lambda_nm;
    // Half of e⁻ˣ at a time: c₁λ⁻⁵ may be as large as e⁻ˣ is small.
    let half = (-0.5 * x).exp();
    let value = C1 / (squared * squared * lambda_nm) * half * half / -(-x).exp_m1();
    value.min(f64::MAX)
}

/// ln B(λ, T), with B in W·m⁻²·sr⁻¹·nm⁻¹, for values beyond the range of B itself.
///
/// ln c₁ − 5 ln λ − x − ln(1 − e⁻ˣ), for any positive f64; −∞ at T = 0. Absolute error about ε·(5
/// |ln λ| + 2x).
pub fn ln_radiance(lambda_nm: f64, temperature_k: f64) -> f64 {
    if is_dark(lambda_nm, temperature_k) {
        return f64::NEG_INFINITY;
    }
    let (ln_lambda, ln_c2) = (lambda_nm.ln(), C2.ln());
    let x = C2 / lambda_nm / temperature_k;
    // 1 − e⁻ˣ = x to rounding here; ln x is computed so that x itself may underflow.
    let ln_quantum = if x < 1e-17 {
        ln_c2 - ln_lambda - temperature_k.ln()
    } else {
        (-(-x).exp_m1()).ln()
    };
    C1.ln() - 5.0 * ln_lambda - x - ln_quantum
}

/// Whether the law gives 0 here, or is not defined.
fn is_dark(lambda_nm: f64, temperature_k: f64) -> bool {
    let positive = |value: f64| value > 0.0 && value.is_finite();
    !positive(lambda_nm) || !positive(temperature_k)
}

/// Wavelength at which B(λ, T) is greatest, nm: 2.897771955·10⁶/T (Wien's displacement law).
pub fn peak_nm(temperature_k: f64) -> f64 {
    C2 / X_PEAK / temperature_k
}

/// The greatest B over all wavelengths, W·m⁻²·sr⁻¹·nm⁻¹: c₁ (T/c₂)⁵ x⁵/(eˣ − 1) at the peak's x.
///
/// Grows as T⁵; the greatest f64 where it would overflow (T above 1e64).
pub fn peak_radiance(temperature_k: f64) -> f64 {
    (C1 * (temperature_k / C2).powi(5) * SHAPE_PEAK).clamp(0.0, f64::MAX)
}

/// Radiance over all wavelengths, W·m⁻²·sr⁻¹: σT⁴/π = c₁ (T/c₂)⁴ π⁴/15 (Stefan and Boltzmann).
pub fn total(temperature_k: f64) -> f64 {
    let pi = std::f64::consts::PI;
    (C1 * (temperature_k / C2).powi(4) * pi.powi(4) / 15.0).clamp(0.0, f64::MAX)
}

/// Planck's curve scaled to 1 at one wavelength; dimensionless.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlanckShape {
    /// Temperature, K; 0 makes the curve 0 everywhere, `unit_at_nm` included.
    pub temperature_k: f64,
    /// Wavelength at which the curve is 1, nm.
    pub unit_at_nm: f64,
}

impl PlanckShape {
    /// A curve of a temperature ≥ 0 that is 1 at a wavelength > 0.
    pub fn new(temperature_k: f64, unit_at_nm: f64) -> Result<Self, SpectrumError> {
        if !temperature_k.is_finite() || temperature_k < 0.0 {
            return Err(SpectrumError::Temperature {
                found: temperature_k,
            });
        }
        if !unit_at_nm.is_finite() || unit_at_nm <= 0.0 {
            return Err(SpectrumError::UnitAt { found: unit_at_nm });
        }
        Ok(Self {
            temperature_k,
            unit_at_nm,
        })
    }

    /// B(λ, T)/B(unit_at, T), finite: the greatest f64 where it would overflow, as on the long side
    /// of a very cold body's `unit_at_nm`.
    pub fn at(&self, lambda_nm: f64) -> f64 {
        let here = radiance(lambda_nm, self.temperature_k);
        let unit = radiance(self.unit_at_nm, self.temperature_k);
        let normal = 1e-290..1e290;
        if normal.contains(&here) && normal.contains(&unit) {
            return (here / unit).min(f64::MAX);
        }
        let ln_unit = ln_radiance(self.unit_at_nm, self.temperature_k);
        if ln_unit == f64::NEG_INFINITY {
            return 0.0;
        }
        (ln_radiance(lambda_nm, self.temperature_k) - ln_unit)
            .exp()
            .min(f64::MAX)
    }

    /// The curve's greatest value.
    pub fn peak(&self) -> f64 {
        self.at(peak_nm(self.temperature_k))
    }

    /// The range in which the curve exceeds 1e-30 of its peak, nm; None at T = 0, where it is 0
    /// everywhere.
    pub fn support_nm(&self) -> Option<[f64; 2]> {
        let edge = |x: f64| (C2 / x / self.temperature_k).min(f64::MAX);
        (self.temperature_k > 0.0).then(|| X_SUPPORT.map(edge))
    }

    /// A tenth of the peak wavelength, nm, within which the curve changes little near it.
    pub fn feature_nm(&self) -> Option<f64> {
        (self.temperature_k > 0.0).then(|| 0.1 * peak_nm(self.temperature_k))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// ∫ B dλ in ln λ by the trapezoidal rule, which converges at once for such a bell.
    fn quadrature(temperature_k: f64, curve: impl Fn(f64) -> f64) -> f64 {
        let [from, to] = X_SUPPORT.map(|x| (C2 / x / temperature_k).ln());
        let steps = 4000;
        let step = (to - from) / f64::from(steps);
        let value = |index| (from + f64::from(index) * step).exp();
        (0..=steps)
            .map(|index| value(index) * curve(value(index)))
            .sum::<f64>()
            * step
    }

    #[test]
    fn constants_are_those_of_codata_2018() {
        assert!((C1 / 1.191_042_972_397_188e20 - 1.0).abs() < 1e-15);
        assert!((C2 / 1.438_776_877_503_933_8e7 - 1.0).abs() < 1e-15);
    }

    /// 5670.374419e-11 W·m⁻²·K⁻⁴ (CODATA 2018), over π.
    #[test]
    fn the_total_at_5800_kelvin_is_stefan_boltzmanns() {
        let expected = 20_425_553.694_837;
        assert!(
            (total(5800.0) / expected - 1.0).abs() < 1e-13,
            "{}",
            total(5800.0)
        );
        let summed = quadrature(5800.0, |nm| radiance(nm, 5800.0));
        assert!((summed / expected - 1.0).abs() < 1e-12, "{summed}");
        let sigma = 5.670_374_419e-8;
        assert!((total(1.0) * std::f64::consts::PI / sigma - 1.0).abs() < 1e-9);
    }

    #[test]
    fn a_moving_bodys_total_grows_as_the_fourth_power_of_the_doppler_factor() {
        for doppler in [0.1_f64, 0.5, 3.0, 14.106735979665884] {
            let (kelvin, seen) = (5800.0, 5800.0 * doppler);
            let sum = quadrature(seen, |nm| doppler.powi(5) * radiance(doppler * nm, kelvin));
            assert!(
                (sum / (doppler.powi(4) * total(kelvin)) - 1.0).abs() < 1e-12,
                "{doppler}"
            );
        }
    }

    #[test]
    fn the_peak_follows_wiens_displacement_law() {
        for kelvin in [2.725, 300.0, 5800.0, 1e9] {
            let peak = peak_nm(kelvin);
            assert!((peak * kelvin / 2.897_771_955e6 - 1.0).abs() < 1e-9);
            let top = radiance(peak, kelvin);
            let ratio = top / peak_radiance(kelvin);
            assert!((ratio - 1.0).abs() < 1e-14, "{kelvin} K: {ratio}");
            assert!(radiance(peak * 1.001, kelvin) < top && radiance(peak / 1.001, kelvin) < top);
        }
    }

    /// The wavelengths at which B is 1 % of its peak, over that of the peak.
    #[test]
    fn one_percent_points_are_where_they_should_be() {
        for ratio in [0.328_017_859_9, 6.623_935_265_6] {
            let part = radiance(ratio * peak_nm(5800.0), 5800.0) / peak_radiance(5800.0);
            assert!((part - 0.01).abs() < 1e-10, "{part}");
        }
    }

    #[test]
    fn long_waves_follow_rayleigh_and_jeans_to_the_next_order() {
        // 10 m, 1e4 K: 2ckT/λ⁴ · (1 − x/2 + …), x = 1.4388e-7.
        let (nm, kelvin) = (1e10, 1e4);
        let leading = C1 / C2 * kelvin / 1e40;
        assert!((radiance(nm, kelvin) / leading - (1.0 - 7.193_884e-8)).abs() < 1e-13);
    }

    #[test]
    fn short_waves_do_not_underflow_the_fifth_power() {
        let per_meter = radiance(0.1, 1e7) * 1e9;
        assert!(
            (per_meter / 6.720_461_386_135e27 - 1.0).abs() < 1e-12,
            "{per_meter:e}"
        );
    }

    #[test]
    fn deep_in_wiens_tail_it_is_zero_and_its_logarithm_is_right() {
        assert_eq!(radiance(550.0, 30.0), 0.0);
        let ln = ln_radiance(550.0, 30.0);
        assert!(
            (ln + 836.585_780_7 + 9.0 * 10_f64.ln()).abs() < 1e-6,
            "{ln}"
        );
    }

    #[test]
    fn nothing_shines_at_zero_kelvin_nor_below() {
        for kelvin in [0.0, -0.0, -1.0, f64::NAN, f64::NEG_INFINITY] {
            for nm in [1e-300, 550.0, 1e300] {
                assert_eq!(radiance(nm, kelvin), 0.0);
                assert_eq!(ln_radiance(nm, kelvin), f64::NEG_INFINITY);
            }
        }
        let cold = PlanckShape::new(0.0, 560.0).unwrap();
        assert_eq!(
            (cold.at(560.0), cold.peak(), cold.support_nm()),
            (0.0, 0.0, None)
        );
        for kelvin in [-1.0, f64::NAN, f64::INFINITY] {
            let message = PlanckShape::new(kelvin, 560.0).unwrap_err().to_string();
            assert!(message.contains("temperature"), "{message}");
        }
        assert!(PlanckShape::new(300.0, 0.0).is_err());
    }

    #[test]
    fn the_support_ends_at_1e30th_of_the_peak() {
        let curve = PlanckShape::new(4000.0, 560.0).unwrap();
        for nm in curve.support_nm().unwrap() {
            let part = radiance(nm, 4000.0) / peak_radiance(4000.0);
            assert!((part / 1e-30 - 1.0).abs() < 1e-4, "{nm} {part:e}");
        }
    }

    #[test]
    fn the_shape_is_one_where_asked_even_when_the_radiance_underflows() {
        for kelvin in [1.0, 30.0, 5800.0, 1e12] {
            let curve = PlanckShape::new(kelvin, 560.0).unwrap();
            assert_eq!(curve.at(560.0), 1.0);
            let ratio = (ln_radiance(570.0, kelvin) - ln_radiance(560.0, kelvin)).exp();
            assert!((curve.at(570.0) / ratio - 1.0).abs() < 1e-10, "{kelvin}");
        }
        assert_eq!(PlanckShape::new(1.0, 560.0).unwrap().at(1e6), f64::MAX);
    }

    proptest! {
        /// Relative to the size of the logarithm, whose own rounding is ε of it.
        #[test]
        fn a_moving_black_body_is_a_black_body_at_its_shifted_temperature(
            ln_nm in -12.0..12.0_f64, ln_kelvin in -3.0..9.0_f64, ln_doppler in -9.0..9.0_f64,
        ) {
            let [nm, kelvin, doppler] = [ln_nm, ln_kelvin, ln_doppler].map(|e| 10_f64.powf(e));
            let seen = ln_radiance(nm, doppler * kelvin);
            let shifted = 5.0 * doppler.ln() + ln_radiance(doppler * nm, kelvin);
            prop_assert!((seen - shifted).abs() <= 1e-13 * seen.abs().max(1.0));
        }

        #[test]
        fn the_direct_form_and_the_logarithm_agree(
            ln_nm in -12.0..12.0_f64, ln_kelvin in -3.0..9.0_f64,
        ) {
            let [nm, kelvin] = [ln_nm, ln_kelvin].map(|e| 10_f64.powf(e));
            let (value, ln) = (radiance(nm, kelvin), ln_radiance(nm, kelvin));
            if value > 1e-300 {
                prop_assert!((value.ln() - ln).abs() < 1e-12);
            } else {
                prop_assert!(ln < -690.0);
            }
            prop_assert!(ln >= -745.0 || value <= 5e-324);
        }

        #[test]
        fn finite_and_never_negative_at_any_positive_numbers(
            nm in -307.0..308.0_f64, kelvin in -307.0..308.0_f64, unit in -307.0..308.0_f64,
        ) {
            let [nm, kelvin, unit] = [nm, kelvin, unit].map(|e| 10_f64.powf(e));
            let curve = PlanckShape::new(kelvin, unit).unwrap();
            for value in [radiance(nm, kelvin), curve.at(nm), curve.peak(), peak_radiance(kelvin)] {
                prop_assert!(value.is_finite() && value >= 0.0);
            }
        }
    }
}
