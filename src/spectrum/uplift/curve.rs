//! A smooth curve of a given color.

use super::fit;
use super::fit::{HALF_NM, WEIGHTS, quadratic, tinted, variable};
use crate::color::cie::RANGE_NM;
use crate::spectrum::{Beyond, MAX_VALUE, SpectrumError};

/// Largest error of the RGB of a curve (times the greatest component, if above 1).
pub const RGB_ERROR: f64 = 1e-9;

/// Threshold of dark and pale colors. Colors whose components are all below it are fitted as
/// brighter ones and scaled; those whose components are all within it of the greatest, as less pale
/// ones and mixed with white.
pub const DARKEST: f64 = 1e-3;

/// A smooth curve of a given color.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Uplift {
    scale: f64,
    shape: Shape,
    beyond: Beyond,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Shape {
    /// A gray: 1 everywhere.
    Flat,
    /// 1 − tint·(1 − sigmoid of x).
    Sigmoid {
        /// Of u², u and 1 in x.
        coefficients: [f64; 3],
        /// 1, or less for a color so near white that a stronger one is fitted in its place.
        tint: f64,
    },
}

impl Uplift {
    /// The curve of a linear Rec. 709 color, each component from 0 to 1e300.
    ///
    /// A color with a component above 1 is the color with its greatest component 1, scaled:
    /// emission, not reflectance. One whose components are all below [`DARKEST`] is scaled
    /// likewise. The linear RGB under D65 is met within [`RGB_ERROR`], including corners of the
    /// cube; it takes about 50 µs. The narrowest features, those of the corners, are 10 nm wide.
    pub fn new(rgb: [f64; 3]) -> Result<Self, SpectrumError> {
        for (found, channel) in rgb.into_iter().zip(["red", "green", "blue"]) {
            if !(0.0..=MAX_VALUE).contains(&found) {
                return Err(SpectrumError::Component { channel, found });
            }
        }
        let beyond = Beyond::Hold;
        if rgb[0] == rgb[1] && rgb[1] == rgb[2] {
            return Ok(Self {
                scale: rgb[0],
                shape: Shape::Flat,
                beyond,
            });
        }
        let greatest = rgb.into_iter().fold(0.0, f64::max);
        let scale = greatest / greatest.clamp(DARKEST, 1.0);
        let bright = rgb.map(|part| part / scale);
        let paleness = 1.0 - bright.into_iter().fold(1.0, f64::min);
        let tint = paleness / paleness.max(DARKEST);
        let coefficients = fit::fit(bright.map(|part| 1.0 - (1.0 - part) / tint));
        let shape = Shape::Sigmoid { coefficients, tint };
        Ok(Self {
            scale,
            shape,
            beyond,
        })
    }

    /// The same curve with another course beyond 360 to 830 nm.
    #[must_use]
    pub fn with_beyond(self, beyond: Beyond) -> Self {
        Self { beyond, ..self }
    }

    /// The curve at a wavelength.
    pub fn at(&self, lambda_nm: f64) -> f64 {
        if self.beyond == Beyond::Zero && !(RANGE_NM[0]..=RANGE_NM[1]).contains(&lambda_nm) {
            return 0.0;
        }
        match self.shape {
            Shape::Flat => self.scale,
            Shape::Sigmoid { coefficients, tint } => {
                self.scale * tinted(tint, quadratic(coefficients, variable(lambda_nm)))
            }
        }
    }

    /// 360 to 830 nm, outside of which the curve is constant; None if it is constant everywhere.
    pub fn support_nm(&self) -> Option<[f64; 2]> {
        (self.shape != Shape::Flat || self.beyond == Beyond::Zero).then_some(RANGE_NM)
    }

    /// The curve's greatest value.
    pub fn peak(&self) -> f64 {
        let Shape::Sigmoid {
            coefficients: [a, b, c],
            tint,
        } = self.shape
        else {
            return self.scale;
        };
        let vertex = (-0.5 * b / a).clamp(-1.0, 1.0);
        let places = [-1.0, 1.0, if vertex.is_nan() { 1.0 } else { vertex }];
        let greatest = places
            .map(|u| quadratic([a, b, c], u))
            .into_iter()
            .fold(f64::MIN, f64::max);
        self.scale * tinted(tint, greatest)
    }

    /// Approximate narrowest width in nm over which the curve changes by half of itself: the least
    /// √(1 + x²)/|dx/dλ|; None if it is constant.
    pub fn feature_nm(&self) -> Option<f64> {
        let Shape::Sigmoid {
            coefficients: [a, b, c],
            ..
        } = self.shape
        else {
            return None;
        };
        let width = |u: f64| quadratic([a, b, c], u).hypot(1.0) / (2.0 * a * u + b).abs();
        WEIGHTS
            .iter()
            .map(|row| HALF_NM * width(row.0))
            .min_by(f64::total_cmp)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::cie::xyz_with_substeps;
    use crate::color::lab_from_xyz;
    use crate::color::spaces::{D65_XYZ, RGB_FROM_XYZ, XYZ_FROM_RGB, apply};
    use crate::spectrum::illuminant;
    use proptest::prelude::*;

    /// The curve's color, by the same sums: what the fit set out to meet.
    fn color(curve: &Uplift) -> [f64; 3] {
        let mut rgb = [0.0; 3];
        for (index, (_, weight)) in WEIGHTS.iter().enumerate() {
            let value = curve.at(360.0 + index as f64);
            (0..3).for_each(|i| rgb[i] += weight[i] * value);
        }
        rgb
    }

    fn largest_difference(a: [f64; 3], b: [f64; 3]) -> f64 {
        (0..3).map(|i| (a[i] - b[i]).abs()).fold(0.0, f64::max)
    }

    fn grid() -> impl Iterator<Item = [f64; 3]> {
        const LEVELS: [f64; 10] = [0.0, 1e-4, 0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 1.0];
        LEVELS.into_iter().flat_map(|r| {
            LEVELS
                .into_iter()
                .flat_map(move |g| LEVELS.into_iter().map(move |b| [r, g, b]))
        })
    }

    #[test]
    fn colors_however_near_to_white_are_met() {
        for exponent in 0..52 {
            let pale = 1.0 - 0.5f64.powi(exponent);
            for rgb in [
                [pale, 1.0, 1.0],
                [1.0, pale, 1.0],
                [pale, 1.0, pale],
                [pale, pale, 1.0],
            ] {
                let error = largest_difference(color(&Uplift::new(rgb).unwrap()), rgb);
                assert!(error < RGB_ERROR, "{rgb:?} {error:e}");
            }
        }
    }

    #[test]
    fn every_color_to_the_corners_of_the_cube_is_met() {
        for rgb in grid() {
            let error = largest_difference(color(&Uplift::new(rgb).unwrap()), rgb);
            assert!(error < RGB_ERROR, "{rgb:?} {error:e}");
        }
    }

    /// By the whole path, D65 to XYZ to Rec. 709, at ⅛ nm. What is left is the white of the table
    /// against the rounded one: at most 2.9e-4 in RGB and 0.025 in L*a*b*, at magenta.
    #[test]
    fn an_uplifted_color_under_d65_is_seen_as_itself() {
        let d65 = illuminant("D65").unwrap();
        let white = xyz_with_substeps(|nm| d65.at(nm), 8)[1];
        for rgb in grid().filter(|rgb| rgb.iter().all(|part| [0.0, 0.01, 0.5, 1.0].contains(part)))
        {
            let curve = Uplift::new(rgb).unwrap();
            let xyz = xyz_with_substeps(|nm| d65.at(nm) * curve.at(nm), 8).map(|part| part / white);
            let error = largest_difference(apply(&RGB_FROM_XYZ, xyz), rgb);
            assert!(error < 3e-4, "{rgb:?} {error:e}");
            let wanted = lab_from_xyz(apply(&XYZ_FROM_RGB, rgb), D65_XYZ);
            let found = lab_from_xyz(xyz, D65_XYZ);
            assert!(
                largest_difference(found, wanted) < 0.03,
                "{rgb:?} {found:?} {wanted:?}"
            );
        }
    }

    #[test]
    fn black_white_and_grays_are_constant_and_exact() {
        for gray in [0.0, 1e-300, 0.18, 0.5, 1.0, 40.0] {
            let curve = Uplift::new([gray; 3]).unwrap();
            assert!(
                [1e-300, 360.0, 555.5, 1e300]
                    .iter()
                    .all(|&nm| curve.at(nm) == gray)
            );
            assert_eq!(
                (curve.support_nm(), curve.feature_nm(), curve.peak()),
                (None, None, gray)
            );
        }
    }

    #[test]
    fn colors_beyond_one_or_near_zero_are_scaled() {
        let unit = Uplift::new([1.0, 0.25, 0.5]).unwrap();
        let bright = Uplift::new([8.0, 2.0, 4.0]).unwrap();
        let faint = Uplift::new([1e-9, 2.5e-10, 5e-10]).unwrap();
        assert_eq!(bright.at(600.0), 8.0 * unit.at(600.0));
        assert!(largest_difference(color(&faint), [1e-9, 2.5e-10, 5e-10]) < 1e-15);
    }

    #[test]
    fn beyond_the_visible_the_end_goes_on_or_is_zero() {
        let curve = Uplift::new([0.8, 0.1, 0.1]).unwrap();
        assert_eq!(
            (curve.at(1e-300), curve.at(1e300)),
            (curve.at(360.0), curve.at(830.0))
        );
        let ending = curve.with_beyond(Beyond::Zero);
        assert_eq!((ending.at(359.9), ending.at(830.1)), (0.0, 0.0));
        assert_eq!(ending.at(830.0), curve.at(830.0));
    }

    #[test]
    fn components_that_are_no_amounts_of_light_are_named() {
        for (rgb, word) in [
            ([-0.1, 0.0, 0.0], "red component is -0.1"),
            ([0.0, f64::NAN, 0.0], "green component is NaN"),
            ([0.0, 0.0, f64::INFINITY], "blue component is inf"),
        ] {
            assert!(Uplift::new(rgb).unwrap_err().to_string().contains(word));
        }
    }

    proptest! {
        #[test]
        fn any_color_is_met_by_a_curve_within_its_bounds(
            rgb in prop::array::uniform3(prop_oneof![
                Just(0.0), Just(1.0), 0.0..1.0, 0.999..1.0, 0.0..1e-3, (-300.0..0.0_f64).prop_map(f64::exp)
            ]),
            nm in prop_oneof![300.0..900.0, Just(1e-300), Just(1e300)],
        ) {
            let curve = Uplift::new(rgb).unwrap();
            prop_assert!(largest_difference(color(&curve), rgb) < RGB_ERROR);
            prop_assert!((0.0..=1.0).contains(&curve.at(nm)));
            prop_assert!(curve.at(nm) <= curve.peak() * (1.0 + 1e-14));
        }
    }
}
