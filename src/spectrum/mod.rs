//! Curves over wavelength: what a light emits, a surface reflects, a sensor adds up.
//!
//! Wavelengths are in nm, temperatures in K, spectral radiance in W·m⁻²·sr⁻¹·nm⁻¹, everything f64.
//! A curve is defined, finite and never negative at every wavelength above 0, since a Doppler shift
//! may bring any of them into view. The curves that the author wrote stand here as they were
//! written; how they are held for rendering is another matter.
//!
//! Of ours, only [`color`](crate::color) is imported.

mod band;
mod bound;
pub mod cardinal;
mod fine;
pub mod illuminant;
mod lines;
mod log_grid;
mod luminous;
mod narrow_bound;
pub mod planck;
pub mod quadrature;
mod roughness;
pub mod sampled;
mod sensor;
mod through;
mod tinted;
pub mod uplift;

pub use bound::GridBound;
pub use cardinal::{Beyond, Cardinal};
pub use fine::{Fine, FineSensor};
pub use illuminant::illuminant;
pub use lines::{LINES_NM, LineAxis, Lines};
pub use log_grid::{Baked, LogAxis, Shifted, Smoothing};
pub use luminous::luminous_integral;
pub use planck::PlanckShape;
pub use quadrature::Quadrature;
pub use roughness::Roughness;
pub use sampled::Sampled;
pub use sensor::{Sensor, catmull_rom};
pub use through::{Responses, Sparse};
pub use tinted::Tinted;
pub use uplift::{ColoredLight, Uplift};

/// How many widths from its center a gaussian falls below 1e-30 of its peak (e⁻⁷² = 5e-32).
const GAUSSIAN_REACH: f64 = 12.0;

/// A curve over wavelength, in whatever unit its user scales it to.
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
        /// Where the peak is, nm.
        center_nm: f64,
        /// Standard deviation, nm; more than 0.
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
    /// The curve at a wavelength (nm): finite and at least 0 for every wavelength above 0.
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

    /// A gaussian of a finite center and a width > 0, both nm.
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

    /// The range in nm outside of which the curve is constant on either side, perhaps 0.
    ///
    /// A gaussian and Planck's curve count as 0 where they are below 1e-30 of their peak. `None` if
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

    /// The curve's greatest value over all wavelengths.
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

    /// About the width in nm of the narrowest thing that the curve does; `None` if it is constant.
    ///
    /// The closest spacing of its points, a gaussian's standard deviation, a tenth of the wavelength
    /// at which Planck's curve peaks, the steepest rise or fall of a color's curve by ½.
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

/// Why numbers do not make a curve. Points are counted from 1.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SpectrumError {
    /// An empty list or file.
    #[error("there are no points: a curve needs at least one")]
    NoPoints,
    /// More than [`sampled::MAX_ROWS`] points.
    #[error("there are more than {} points", sampled::MAX_ROWS)]
    TooMany,
    /// A point's wavelength is not positive and finite.
    #[error("the wavelength of point {point} is {found} nm: it must be finite and greater than 0")]
    Wavelength {
        /// Which point.
        point: usize,
        /// Its wavelength, nm.
        found: f64,
    },
    /// A point's value is negative, NaN or too large.
    #[error(
        "the value of point {point} (at {nm} nm) is {found}: it must be from 0 to {:e}",
        sampled::MAX_VALUE
    )]
    Value {
        /// Which point.
        point: usize,
        /// Its wavelength, nm.
        nm: f64,
        /// Its value.
        found: f64,
    },
    /// Wavelengths do not ascend.
    #[error(
        "point {point} is at {found} nm, the one before at {before} nm: wavelengths must ascend"
    )]
    Order {
        /// Which point.
        point: usize,
        /// Its wavelength, nm.
        found: f64,
        /// The previous point's, nm.
        before: f64,
    },
    /// A spline's tension is out of range.
    #[error("the tension is {found}: it must be from 0 to 1")]
    Tension {
        /// What was asked for.
        found: f64,
    },
    /// A temperature is negative or not finite.
    #[error("the temperature is {found} K: it must be finite and at least 0")]
    Temperature {
        /// What was asked for, K.
        found: f64,
    },
    /// The wavelength at which a black body's curve is to be 1 is not positive and finite.
    #[error(
        "a black body's curve cannot be 1 at {found} nm: the wavelength must be greater than 0"
    )]
    UnitAt {
        /// What was asked for, nm.
        found: f64,
    },
    /// A gaussian's center is not finite.
    #[error("the center is {found} nm: it must be finite")]
    Center {
        /// What was asked for, nm.
        found: f64,
    },
    /// A gaussian's width is not positive and finite.
    #[error("the width is {found} nm: it must be finite and greater than 0")]
    Width {
        /// What was asked for, nm.
        found: f64,
    },
    /// A color's component is negative, NaN or too large.
    #[error(
        "the {channel} component is {found}: it must be from 0 to {:e}",
        sampled::MAX_VALUE
    )]
    Component {
        /// "red", "green" or "blue".
        channel: &'static str,
        /// What was asked for.
        found: f64,
    },
}

#[cfg(test)]
mod tests {
    use super::*;
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
