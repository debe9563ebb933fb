//! Light of a color: D65 times the color's uplift.
//!
//! The three numbers in a file are light relative to its white, so that (1, 1, 1) is D65 itself.
//! Beyond their tables both curves are constant.

use super::daylight::d65;
use super::uplift::Uplift;
use super::{Sampled, SpectrumError};

/// D65, 1 at 560 nm, times the smooth curve of a color, times a scale.
#[derive(Debug, Clone, PartialEq)]
pub struct Tinted {
    scale: f64,
    white: Sampled,
    color: Uplift,
    /// Points of D65, and the ends of the color's curve; ascending.
    knots_nm: Vec<f64>,
}

impl Tinted {
    /// The light of a linear Rec. 709 color, each component from 0 to 1e300: D65 times its
    /// [`Uplift`]. Under it, white is seen in that color.
    pub fn new(rgb: [f64; 3]) -> Result<Self, SpectrumError> {
        let (white, color) = (d65(), Uplift::new(rgb)?);
        let mut knots_nm = white.knots_nm().to_vec();
        knots_nm.extend(color.support_nm().into_iter().flatten());
        knots_nm.sort_by(f64::total_cmp);
        knots_nm.dedup();
        Ok(Self {
            scale: 1.0,
            white,
            color,
            knots_nm,
        })
    }

    /// The same curve times a factor, at least 0.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        let scale = self.scale * factor;
        Self { scale, ..self }
    }

    /// The curve at a wavelength.
    pub fn at(&self, lambda_nm: f64) -> f64 {
        self.scale * (self.white.at(lambda_nm) * self.color.at(lambda_nm))
    }

    /// The wavelengths at which the curve bends, nm; outside of them it is constant.
    pub fn knots_nm(&self) -> &[f64] {
        &self.knots_nm
    }

    /// The greatest value of the curve. Between two points, 5 nm apart where the color's curve is
    /// steepest, it rises and falls at most once.
    pub fn peak(&self) -> f64 {
        let between = |pair: &[f64]| {
            let [mut from, mut to] = [pair[0], pair[1]];
            // Trisection until the value no longer changes, which it does by the square of the
            // rest.
            for _ in 0..60 {
                let third = (to - from) / 3.0;
                if self.at(from + third) < self.at(to - third) {
                    from += third;
                } else {
                    to -= third;
                }
            }
            [pair[0], pair[1], from].map(|nm| self.at(nm))
        };
        let places = self.knots_nm.windows(2).flat_map(between);
        places.fold(0.0, f64::max)
    }

    /// Approximate width of the narrowest feature, nm: a step between points, or that of the
    /// color's curve.
    pub fn feature_nm(&self) -> Option<f64> {
        let gaps = self.knots_nm.windows(2).map(|pair| pair[1] - pair[0]);
        gaps.chain(self.color.feature_nm()).min_by(f64::total_cmp)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::cie::xyz_with_substeps;
    use crate::color::spaces::{RGB_FROM_XYZ, apply};
    use crate::spectrum::Spectrum;

    /// Linear RGB of a curve, over that of D65's luminance.
    fn color(curve: &Tinted) -> [f64; 3] {
        let white = xyz_with_substeps(|nm| d65().at(nm), 8)[1];
        let xyz = xyz_with_substeps(|nm| curve.at(nm), 8);
        apply(&RGB_FROM_XYZ, xyz.map(|part| part / white))
    }

    #[test]
    fn white_is_d65_and_grays_are_as_much_of_it() {
        let d65 = Spectrum::Sampled(d65());
        for gray in [0.0, 0.25, 1.0] {
            let light = Spectrum::Tinted(Tinted::new([gray; 3]).unwrap());
            for nm in [1.0, 300.0, 432.1, 560.0, 829.0, 1e9] {
                assert_eq!(light.at(nm), gray * d65.at(nm));
            }
            assert_eq!(light.peak(), gray * d65.peak());
            assert_eq!(light.support_nm(), d65.support_nm());
        }
    }

    /// The white of the table and that of Rec. 709, rounded to four digits, differ by 3e-4.
    #[test]
    fn the_light_of_a_color_has_that_color() {
        for rgb in [
            [1.0, 0.5, 0.25],
            [0.2, 1.0, 0.0],
            [0.0, 0.0, 1.0],
            [8.0, 7.0, 9.0],
        ] {
            let found = color(&Tinted::new(rgb).unwrap());
            let greatest = rgb.into_iter().fold(0.0, f64::max);
            for (found, wanted) in found.into_iter().zip(rgb) {
                assert!((found - wanted).abs() < 4e-4 * greatest, "{rgb:?} {found}");
            }
        }
    }

    #[test]
    fn the_peak_is_what_a_fine_search_finds() {
        for rgb in [
            [1.0, 0.5, 0.25],
            [1.0, 0.0, 0.0],
            [0.0, 0.9, 1.0],
            [0.3, 0.7, 0.2],
        ] {
            let curve = Tinted::new(rgb).unwrap().scaled(1e-3);
            let places = (0..=600_000).map(|i| 300.0 + 1e-3 * f64::from(i));
            let found = places.map(|nm| curve.at(nm)).fold(0.0, f64::max);
            let off = curve.peak() / found - 1.0;
            assert!((0.0..1e-7).contains(&off), "{rgb:?} {off:e}");
        }
    }
}
