//! A curve over wavelength, of any kind.

use super::{Cardinal, PlanckShape, Sampled, SpectrumError, Tinted, Uplift};

/// Number of widths from its center at which a Gaussian is below 1e-30 of its peak (e⁻⁷² = 5e-32).
const GAUSSIAN_REACH: f64 = 12.0;

/// A curve over wavelength, in any unit to which its user scales it.
///
/// # Example
/// A green paint under a tungsten lamp, at 550 nm, and with the lamp blue-shifted by D = 1.2.
/// ```
/// use restframe::spectrum::{Spectrum, illuminant};
///
/// let paint = Spectrum::gaussian(550.0, 30.0)?;
/// let lamp = illuminant("A").ok_or("there is no illuminant A")?;
/// let at_rest = paint.at(550.0) * lamp.at(550.0);
/// let approaching = paint.at(550.0) * lamp.at(1.2 * 550.0); // read at D·λ
/// assert!(approaching > at_rest); // tungsten is brighter in the red
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub enum Spectrum {
    /// The same everywhere; finite and at least 0.
    Constant(f64),
    /// A cardinal spline through points.
    Cardinal(Cardinal),
    /// Planck's curve, 1 at a wavelength.
    Planck(PlanckShape),
    /// exp(−(λ − center)²/(2 width²)): a peak of 1.
    Gaussian {
        /// Wavelength of the peak, nm.
        center_nm: f64,
        /// Standard deviation, nm; above 0.
        width_nm: f64,
    },
    /// Straight lines through measured points.
    Sampled(Sampled),
    /// A smooth curve of a given color.
    Rgb(Uplift),
    /// The light of a given color: D65 times its smooth curve.
    Tinted(Tinted),
}

impl Spectrum {
    /// The curve at a wavelength in nm: finite and at least 0 for every wavelength above 0.
    pub fn at(&self, lambda_nm: f64) -> f64 {
        match self {
            Self::Constant(value) => *value,
            Self::Cardinal(curve) => curve.at(lambda_nm),
            Self::Planck(curve) => curve.at(lambda_nm),
            Self::Gaussian {
                center_nm,
                width_nm,
            } => {
                let widths = (lambda_nm - center_nm) / width_nm;
                (-0.5 * widths * widths).exp()
            }
            Self::Sampled(curve) => curve.at(lambda_nm),
            Self::Rgb(curve) => curve.at(lambda_nm),
            Self::Tinted(curve) => curve.at(lambda_nm),
        }
    }

    /// A Gaussian with a finite center and a width > 0, both in nm.
    pub fn gaussian(center_nm: f64, width_nm: f64) -> Result<Self, SpectrumError> {
        if !center_nm.is_finite() {
            return Err(SpectrumError::Center { found: center_nm });
        }
        if !width_nm.is_finite() || width_nm <= 0.0 {
            return Err(SpectrumError::Width { found: width_nm });
        }
        Ok(Self::Gaussian {
            center_nm,
            width_nm,
        })
    }

    /// The range in nm outside of which the curve is constant on either side.
    ///
    /// A Gaussian and Planck's curve count as 0 where they are below 1e-30 of their peak. None if
    /// the curve is constant everywhere.
    pub fn support_nm(&self) -> Option<[f64; 2]> {
        let ends = |knots: &[f64]| Some([*knots.first()?, *knots.last()?]);
        match self {
            Self::Constant(_) => None,
            Self::Cardinal(curve) => ends(curve.knots_nm()),
            Self::Planck(curve) => curve.support_nm(),
            Self::Gaussian {
                center_nm,
                width_nm,
            } => {
                let reach = GAUSSIAN_REACH * width_nm;
                Some([(center_nm - reach).max(0.0), (center_nm + reach).max(0.0)])
            }
            Self::Sampled(curve) => ends(curve.knots_nm()),
            Self::Rgb(curve) => curve.support_nm(),
            Self::Tinted(curve) => ends(curve.knots_nm()),
        }
    }

    /// The greatest value of the curve over all wavelengths.
    pub fn peak(&self) -> f64 {
        match self {
            Self::Constant(value) => *value,
            Self::Cardinal(curve) => curve.peak(),
            Self::Planck(curve) => curve.peak(),
            Self::Gaussian { .. } => 1.0,
            Self::Sampled(curve) => curve.peak(),
            Self::Rgb(curve) => curve.peak(),
            Self::Tinted(curve) => curve.peak(),
        }
    }

    /// Approximate width in nm of the curve's narrowest feature; None if it is constant.
    ///
    /// The smallest spacing of its points, a Gaussian's standard deviation, a tenth of the peak
    /// wavelength of Planck's curve, the steepest rise or fall of a color's curve by ½.
    pub fn features_nm(&self) -> Option<f64> {
        match self {
            Self::Constant(_) => None,
            Self::Gaussian { width_nm, .. } => Some(*width_nm),
            Self::Planck(curve) => curve.feature_nm(),
            Self::Rgb(curve) => curve.feature_nm(),
            Self::Tinted(curve) => curve.feature_nm(),
            Self::Cardinal(_) | Self::Sampled(_) => {
                let gaps = self.knots_nm().windows(2).map(|pair| pair[1] - pair[0]);
                gaps.min_by(f64::total_cmp)
            }
        }
    }

    /// The wavelengths (nm, ascending) at which the curve is not smooth; those between its ends.
    pub fn knots_nm(&self) -> &[f64] {
        match self {
            Self::Cardinal(curve) => curve.knots_nm(),
            Self::Sampled(curve) => curve.knots_nm(),
            Self::Tinted(curve) => curve.knots_nm(),
            _ => &[],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::{Beyond, illuminant};
    use proptest::prelude::*;

    fn examples() -> Vec<Spectrum> {
        let points = [
            (560.0, 0.0),
            (600.0, 0.08),
            (650.0, 0.9),
            (700.0, 0.08),
            (740.0, 0.0),
        ];
        let mut all: Vec<_> = illuminant::NAMES
            .iter()
            .filter_map(|name| illuminant(name))
            .collect();
        all.extend([
            Spectrum::Constant(0.5),
            Spectrum::Cardinal(Cardinal::new(&points, 0.0, Beyond::Hold).unwrap()),
            Spectrum::Planck(PlanckShape::new(30.0, 560.0).unwrap()),
            Spectrum::Planck(PlanckShape::new(5800.0, 560.0).unwrap()),
            Spectrum::Planck(PlanckShape::new(0.0, 560.0).unwrap()),
            Spectrum::gaussian(589.0, 5.0).unwrap(),
            Spectrum::gaussian(589.0, 1e-300).unwrap(),
            Spectrum::gaussian(-1e300, 1e300).unwrap(),
            Spectrum::Rgb(Uplift::new([0.8, 0.1, 0.1]).unwrap()),
            Spectrum::Rgb(Uplift::new([1.0, 0.0, 0.0]).unwrap()),
            Spectrum::Tinted(Tinted::new([1.0, 0.0, 0.0]).unwrap()),
            Spectrum::Tinted(Tinted::new([0.2, 0.5, 0.3]).unwrap().scaled(1e3)),
        ]);
        all
    }

    #[test]
    fn every_curve_is_finite_and_not_negative_at_any_wavelength() {
        for spectrum in examples() {
            for exponent in -3000..=3000 {
                let value = spectrum.at(10_f64.powf(0.1 * f64::from(exponent)));
                assert!(
                    value.is_finite() && value >= 0.0,
                    "{spectrum:?} {exponent} {value}"
                );
            }
        }
    }

    #[test]
    fn outside_of_its_support_a_curve_does_not_change() {
        // One that overflows at its peak is cut off there, and has no tail to measure against.
        for spectrum in examples()
            .into_iter()
            .filter(|curve| curve.peak() < f64::MAX)
        {
            let [from, to] = spectrum.support_nm().unwrap_or([1.0, 1.0]);
            let tolerance = 1e-29 * spectrum.peak();
            for (inner, outer) in [(from, 0.9 * from), (from, 1e-3 * from), (to, 2.0 * to)] {
                // A line may be so narrow that its support is its center alone.
                let inner = if outer < inner {
                    inner * (1.0 - 1e-12)
                } else {
                    inner * (1.0 + 1e-12)
                };
                let step = (spectrum.at(inner) - spectrum.at(outer)).abs();
                // The sign of a gaussian's lower end may have been cut away.
                assert!(
                    step <= tolerance || inner == 0.0,
                    "{spectrum:?} {inner} {outer}"
                );
            }
        }
    }

    #[test]
    fn a_gaussian_is_one_at_its_center_and_falls_by_root_e_within_its_width() {
        let line = Spectrum::gaussian(589.0, 5.0).unwrap();
        assert_eq!(line.at(589.0), 1.0);
        assert!((line.at(594.0) - (-0.5_f64).exp()).abs() < 1e-15);
        assert!(Spectrum::gaussian(589.0, 0.0).is_err());
        assert!(Spectrum::gaussian(f64::NAN, 1.0).is_err());
    }

    #[test]
    fn features_are_as_narrow_as_the_curve_says() {
        let width = |spectrum: &Spectrum| spectrum.features_nm();
        assert_eq!(width(&Spectrum::Constant(1.0)), None);
        assert_eq!(width(&Spectrum::gaussian(500.0, 2.0).unwrap()), Some(2.0));
        assert_eq!(width(&illuminant("D65").unwrap()), Some(5.0));
    }

    proptest! {
        /// Fifty per cent n times is 0.5ⁿ: nothing is lost by stacking filters.
        #[test]
        fn stacked_filters_multiply(count in 1..1000_i32, nm in 1e-3..1e9) {
            let filter = Spectrum::Constant(0.5);
            let through = (0..count).fold(1.0, |light, _| light * filter.at(nm));
            prop_assert_eq!(through, 0.5_f64.powi(count));
        }

        #[test]
        fn no_curve_exceeds_its_peak(nm in prop_oneof![1.0..1e4, 300.0..900.0]) {
            for spectrum in examples() {
                prop_assert!(spectrum.at(nm) <= spectrum.peak() * (1.0 + 1e-12), "{:?}", spectrum);
            }
        }
    }
}
