//! Differences of two images, for tests against golden images and for accuracy studies.
//!
//! In color ([`color_difference`], CIEDE2000 of each pixel), in linear values ([`relative_rmse`],
//! [`max_difference`]), and as an image ([`panels`]).

use crate::color::{Lab, delta_e_2000, lab_from_xyz};

/// Difference, in levels, from which on a pixel of [`panels`] is white.
const WHITE_DIFFERENCE: u32 = 32;

/// Reason why two images cannot be compared.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum CompareError {
    /// The images have different sizes.
    #[error("pictures of different size cannot be compared: {a} against {b} values")]
    Size {
        /// Number of values of the first.
        a: usize,
        /// Number of values of the second.
        b: usize,
    },
    /// The values are not whole pixels, or not whole rows of `width` pixels.
    #[error("{values} values are no picture of {width} pixels a row")]
    Shape {
        /// Number of values of each image.
        values: usize,
        /// Width in pixels.
        width: usize,
    },
}

/// The meaning of the numbers of an RGB image.
#[derive(Debug, Clone, Copy)]
pub struct Viewing {
    /// XYZ from linear RGB; the reference white is that of RGB (1, 1, 1).
    pub xyz_from_rgb: [[f64; 3]; 3],
    /// Transfer from encoded to linear value, both 0 to 1: the inverse of the sRGB curve.
    pub decode: fn(f64) -> f64,
}

impl Viewing {
    /// The color of an encoded 8-bit pixel.
    pub fn lab_from_rgb8(&self, rgb8: [u8; 3]) -> Lab {
        let rgb = rgb8.map(|byte| (self.decode)(f64::from(byte) / 255.0));
        lab_from_xyz(self.xyz(rgb), self.xyz([1.0; 3]))
    }

    fn xyz(&self, rgb: [f64; 3]) -> [f64; 3] {
        self.xyz_from_rgb
            .map(|row| row[0] * rgb[0] + row[1] * rgb[1] + row[2] * rgb[2])
    }
}

/// Three numbers on the differences of all pixels.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Comparison {
    /// Their mean.
    pub mean: f64,
    /// The 99th percentile (nearest rank).
    pub p99: f64,
    /// The largest.
    pub worst: f64,
}

impl Comparison {
    /// Statistics of `differences`, in which NaN counts as infinite; all 0 if there are none.
    pub fn of(mut differences: Vec<f64>) -> Self {
        for difference in &mut differences {
            if difference.is_nan() {
                *difference = f64::INFINITY;
            }
        }
        differences.sort_unstable_by(f64::total_cmp);
        let count = differences.len();
        let rank = (count * 99).div_ceil(100);
        let (Some(&worst), Some(&p99)) = (
            differences.last(),
            rank.checked_sub(1).and_then(|index| differences.get(index)),
        ) else {
            return Self::default();
        };
        Self {
            mean: differences.iter().sum::<f64>() / count as f64,
            p99,
            worst,
        }
    }
}

/// CIEDE2000 between the pixels of two encoded images, three bytes per pixel.
///
/// # Errors
/// If their sizes differ, or are not a multiple of three.
pub fn color_difference(a: &[u8], b: &[u8], viewing: &Viewing) -> Result<Comparison, CompareError> {
    check_pair(a.len(), b.len())?;
    let ((pixels_a, rest), (pixels_b, _)) = (a.as_chunks::<3>(), b.as_chunks::<3>());
    if !rest.is_empty() {
        return Err(CompareError::Shape {
            values: a.len(),
            width: 1,
        });
    }
    let difference = |(&a, &b): (&[u8; 3], &[u8; 3])| match a == b {
        true => 0.0,
        false => delta_e_2000(viewing.lab_from_rgb8(a), viewing.lab_from_rgb8(b)),
    };
    Ok(Comparison::of(
        pixels_a.iter().zip(pixels_b).map(difference).collect(),
    ))
}

/// √(Σ(a − b)² / Σb²) over all values, `b` being the reference: 0.01 is one percent.
/// 0 if the two are equal, infinite if only `b` is all zero.
///
/// # Errors
/// If their sizes differ.
pub fn relative_rmse(a: &[[f32; 3]], b: &[[f32; 3]]) -> Result<f64, CompareError> {
    check_pair(a.len(), b.len())?;
    let (mut error, mut reference) = (0.0, 0.0);
    for (a, b) in pairs(a, b) {
        error += (a - b) * (a - b);
        reference += b * b;
    }
    Ok(if error == 0.0 {
        0.0
    } else {
        (error / reference).sqrt()
    })
}

/// The largest |a − b| of all values; NaN counts as infinite.
///
/// # Errors
/// If their sizes differ.
pub fn max_difference(a: &[[f32; 3]], b: &[[f32; 3]]) -> Result<f64, CompareError> {
    check_pair(a.len(), b.len())?;
    let difference = |(a, b): (f64, f64)| if a == b { 0.0 } else { (a - b).abs() };
    let worst = |worst: f64, d: f64| {
        if d.is_nan() {
            f64::INFINITY
        } else {
            worst.max(d)
        }
    };
    Ok(pairs(a, b).map(difference).fold(0.0, worst))
}

/// An image for people to look at when two images differ: `a`, `b`, and the difference of each
/// channel, side by side, three times as wide. A difference of 32 levels is white, so that a single
/// level is visible.
///
/// # Errors
/// If their sizes differ, or are not a multiple of a row of `width` pixels of three bytes.
pub fn panels(width: u32, a: &[u8], b: &[u8]) -> Result<Vec<u8>, CompareError> {
    check_pair(a.len(), b.len())?;
    let width = width as usize;
    let shape = CompareError::Shape {
        values: a.len(),
        width,
    };
    let row = width
        .checked_mul(3)
        .filter(|&row| row > 0 && a.len().is_multiple_of(row));
    let row = row.ok_or(shape)?;
    let mut panels = Vec::with_capacity(a.len() * 3);
    for (a, b) in a.chunks_exact(row).zip(b.chunks_exact(row)) {
        panels.extend_from_slice(a);
        panels.extend_from_slice(b);
        panels.extend(a.iter().zip(b).map(|(&a, &b)| {
            (u32::from(a.abs_diff(b)) * 255)
                .div_ceil(WHITE_DIFFERENCE)
                .min(255) as u8
        }));
    }
    Ok(panels)
}

fn check_pair(a: usize, b: usize) -> Result<(), CompareError> {
    if a == b {
        Ok(())
    } else {
        Err(CompareError::Size { a, b })
    }
}

fn pairs(a: &[[f32; 3]], b: &[[f32; 3]]) -> impl Iterator<Item = (f64, f64)> {
    let values = a.as_flattened().iter().zip(b.as_flattened());
    values.map(|(&a, &b)| (f64::from(a), f64::from(b)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// IEC 61966-2-1:1999, its four-digit matrix and its curve, as an oracle apart from ours.
    const SRGB: Viewing = Viewing {
        xyz_from_rgb: [
            [0.4124, 0.3576, 0.1805],
            [0.2126, 0.7152, 0.0722],
            [0.0193, 0.1192, 0.9505],
        ],
        decode: |x| {
            if x <= 0.04045 {
                x / 12.92
            } else {
                ((x + 0.055) / 1.055).powf(2.4)
            }
        },
    };

    /// The published values come from a matrix of more digits than the standard's four.
    const PUBLISHED_TOLERANCE: f64 = 0.03;

    #[test]
    fn the_primaries_of_srgb_have_their_known_lab() {
        // Two places, as published widely for D65, e.g. by B. Lindbloom's calculator.
        for (rgb8, expected) in [
            ([255, 0, 0], [53.24, 80.09, 67.20]),
            ([0, 255, 0], [87.73, -86.18, 83.18]),
            ([0, 0, 255], [32.30, 79.19, -107.86]),
            ([255, 255, 255], [100.0, 0.0, 0.0]),
        ] {
            let lab = SRGB.lab_from_rgb8(rgb8);
            for (found, expected) in lab.into_iter().zip(expected) {
                assert!(
                    (found - expected).abs() < PUBLISHED_TOLERANCE,
                    "{rgb8:?}: {lab:?}"
                );
            }
        }
    }

    #[test]
    fn comparisons_tell_mean_p99_and_worst() {
        let comparison = Comparison::of((1..=200).rev().map(f64::from).collect());
        assert_eq!(
            comparison,
            Comparison {
                mean: 100.5,
                p99: 198.0,
                worst: 200.0
            }
        );
        assert_eq!(Comparison::of(vec![]), Comparison::default());
        assert_eq!(
            Comparison::of(vec![3.0]),
            Comparison {
                mean: 3.0,
                p99: 3.0,
                worst: 3.0
            }
        );
        assert_eq!(Comparison::of(vec![f64::NAN, 0.0]).worst, f64::INFINITY);
    }

    #[test]
    fn one_wrong_pixel_is_the_worst_and_the_rest_are_equal() {
        let a = vec![90; 300];
        let mut b = a.clone();
        b[150] = 255;
        let comparison = color_difference(&a, &b, &SRGB).expect("sizes agree");
        assert!(comparison.worst > 20.0);
        assert_eq!(comparison.p99, 0.0);
        assert!((comparison.mean - comparison.worst / 100.0).abs() < 1e-12);
    }

    #[test]
    fn relative_rmse_is_the_root_of_the_ratio_of_energies() {
        let rmse = relative_rmse(&[[1.0, 2.0, 3.0]], &[[1.0, 2.0, 2.0]]);
        assert_eq!(rmse, Ok((1.0_f64 / 9.0).sqrt()));
        assert_eq!(relative_rmse(&[[0.0; 3]], &[[0.0; 3]]), Ok(0.0));
        assert_eq!(relative_rmse(&[[1.0; 3]], &[[0.0; 3]]), Ok(f64::INFINITY));
    }

    #[test]
    fn the_largest_difference_is_found_and_nan_is_no_agreement() {
        assert_eq!(
            max_difference(&[[1.0, 2.0, 3.0]], &[[1.5, -2.0, 3.0]]),
            Ok(4.0)
        );
        assert_eq!(
            max_difference(&[[f32::NAN; 3]], &[[0.0; 3]]),
            Ok(f64::INFINITY)
        );
        assert_eq!(
            max_difference(&[[f32::INFINITY; 3]], &[[f32::INFINITY; 3]]),
            Ok(0.0)
        );
    }

    #[test]
    fn panels_show_both_and_their_difference() {
        let panels = panels(1, &[10, 20, 30, 0, 0, 0], &[10, 21, 62, 0, 0, 255]);
        let expected = vec![
            10, 20, 30, 10, 21, 62, 0, 8, 255, // first row
            0, 0, 0, 0, 0, 255, 0, 0, 255, // second row
        ];
        assert_eq!(panels, Ok(expected));
    }

    #[test]
    fn pictures_that_do_not_match_are_refused() {
        assert!(color_difference(&[0; 3], &[0; 6], &SRGB).is_err());
        assert!(color_difference(&[0; 4], &[0; 4], &SRGB).is_err());
        assert!(relative_rmse(&[[0.0; 3]], &[]).is_err());
        assert!(max_difference(&[[0.0; 3]], &[]).is_err());
        for width in [0, 2, u32::MAX] {
            assert!(panels(width, &[0; 9], &[0; 9]).is_err());
        }
    }
}
