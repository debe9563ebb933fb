//! An image of the whole sky, looked up by direction.
//!
//! Equirectangular: rows are equal steps of elevation from +90° to −90°, columns equal steps of
//! azimuth from −180° to 180°, and the color of a texel belongs to its center. Between centers,
//! colors are interpolated linearly in both angles, also across the seam; beyond the centers of the
//! first and last row, toward the pole, with the mean of that row as color of the pole. So the
//! lookup is continuous on the sphere. There is no further smoothing: where texels are much smaller
//! than pixels, as ahead of a fast camera, the pixel's samples average them.

use super::SkyWarning;
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// Largest number of columns and rows.
pub const MOST_SIDES: [u32; 2] = [32768, 16384];

/// Largest number of pixels: 2²⁷, 1.5 GiB of colors.
pub const MOST_PIXELS: u64 = 1 << 27;

/// An image of the whole sky: linear Rec. 709, every component finite and at least 0.
#[derive(Debug, Clone, PartialEq)]
pub struct SkyImage {
    width: usize,
    height: usize,
    /// Texels by rows from the top.
    texels: Vec<[f32; 3]>,
    /// Colors of +y and −y.
    poles: [[f32; 3]; 2],
    warnings: Vec<SkyWarning>,
}

impl SkyImage {
    /// An image of `width` ≥ 1 columns from texels by rows from the top, at least one row. Negative
    /// components and NaN become 0, infinite ones the greatest finite component, with a warning.
    pub fn new(width: usize, texels: Vec<[f32; 3]>) -> Self {
        Self::with_strange(width, texels, 0)
    }

    /// The same, after `strange` components have been brought into range already.
    pub(super) fn with_strange(width: usize, mut texels: Vec<[f32; 3]>, strange: usize) -> Self {
        let height = texels.len() / width;
        let count = strange + clamp(&mut texels);
        let clamped = (count > 0).then_some(SkyWarning::Clamped { count });
        let mean = |row: usize| {
            let row = &texels[row * width..(row + 1) * width];
            [0, 1, 2].map(|c| {
                let sum: f64 = row.iter().map(|texel| f64::from(texel[c])).sum();
                (sum / width as f64) as f32
            })
        };
        let poles = [mean(0), mean(height - 1)];
        Self {
            width,
            height,
            texels,
            poles,
            warnings: clamped.into_iter().collect(),
        }
    }

    /// The image with further warnings about its file.
    pub(super) fn with_warnings(mut self, warnings: impl IntoIterator<Item = SkyWarning>) -> Self {
        self.warnings.extend(warnings);
        self
    }

    /// Warnings about the file.
    pub fn warnings(&self) -> &[SkyWarning] {
        &self.warnings
    }

    /// Columns and rows.
    pub fn size(&self) -> [usize; 2] {
        [self.width, self.height]
    }

    /// Linear Rec. 709 in a unit direction.
    pub fn rgb(&self, direction: DVec3) -> [f64; 3] {
        let across = direction.x.hypot(direction.z);
        let azimuth = direction.x.atan2(-direction.z);
        let from_top = across.atan2(direction.y) / PI * self.height as f64 - 0.5;
        let column = (0.5 + azimuth / TAU) * self.width as f64 - 0.5;
        let below = from_top.floor();
        let [upper, lower] = [below, below + 1.0].map(|row| self.in_row(row, column));
        let last = self.height as f64 - 1.0;
        // From the pole to the center of its row it is only half a row.
        let part = if below < 0.0 {
            2.0 * from_top + 1.0
        } else if below >= last {
            2.0 * (from_top - last)
        } else {
            from_top - below
        };
        mix(upper, lower, part.clamp(0.0, 1.0))
    }

    /// The color at any column of a row; beyond the first and last row, that of the pole.
    fn in_row(&self, row: f64, column: f64) -> [f64; 3] {
        if row < 0.0 {
            return self.poles[0].map(f64::from);
        }
        if row >= self.height as f64 {
            return self.poles[1].map(f64::from);
        }
        let left = column.floor();
        let texel = |column: f64| {
            let column = (column as i64).rem_euclid(self.width as i64) as usize;
            self.texels[row as usize * self.width + column].map(f64::from)
        };
        mix(texel(left), texel(left + 1.0), column - left)
    }
}

fn mix(a: [f64; 3], b: [f64; 3], part: f64) -> [f64; 3] {
    [0, 1, 2].map(|c| a[c] * (1.0 - part) + b[c] * part)
}

/// The greatest finite component, at least 0.
fn greatest(texels: &[[f32; 3]]) -> f32 {
    let finite = texels.iter().flatten().filter(|value| value.is_finite());
    finite.copied().fold(0.0, f32::max)
}

/// Replaces NaN by 0 and infinite components by the greatest finite one with their sign. Returns
/// their number, without those that are still negative.
pub(super) fn make_finite(texels: &mut [[f32; 3]]) -> usize {
    let greatest = greatest(texels);
    let mut count = 0;
    for value in texels.iter_mut().flatten().filter(|v| !v.is_finite()) {
        let made = if value.is_nan() { 0.0 } else { greatest };
        count += usize::from(*value != f32::NEG_INFINITY);
        *value = made.copysign(*value);
    }
    count
}

/// Brings components into range. Returns how many were not.
fn clamp(texels: &mut [[f32; 3]]) -> usize {
    let components = || texels.iter().flatten();
    let greatest = greatest(texels);
    let clamped = |value: f32| match value {
        _ if value >= 0.0 => value.min(greatest),
        _ => 0.0, // NaN too
    };
    let wrong = |value: &&f32| !(**value >= 0.0 && **value <= greatest);
    let count = components().filter(wrong).count();
    if count > 0 {
        texels
            .iter_mut()
            .flatten()
            .for_each(|value| *value = clamped(*value));
    }
    count
}

#[cfg(test)]
mod tests {
    use super::*;

    fn looking(azimuth: f64, elevation: f64) -> DVec3 {
        let [a, e] = [azimuth, elevation].map(f64::to_radians);
        DVec3::new(a.sin() * e.cos(), e.sin(), -a.cos() * e.cos())
    }

    /// Eight columns, four rows: red is the column, green the row.
    fn numbered() -> SkyImage {
        let texel = |i: usize| [(i % 8) as f32, (i / 8) as f32, 1.0];
        SkyImage::new(8, (0..32).map(texel).collect())
    }

    fn near(found: [f64; 3], expected: [f64; 3]) {
        let off = (0..3)
            .map(|i| (found[i] - expected[i]).abs())
            .fold(0.0, f64::max);
        assert!(off < 1e-9, "{found:?} instead of {expected:?}");
    }

    #[test]
    fn minus_z_is_the_middle_the_right_is_right_and_up_is_up() {
        let image = numbered();
        near(image.rgb(DVec3::NEG_Z), [3.5, 1.5, 1.0]);
        // +x is a quarter turn to the right: two columns.
        near(image.rgb(DVec3::X), [5.5, 1.5, 1.0]);
        near(image.rgb(DVec3::NEG_X), [1.5, 1.5, 1.0]);
        near(image.rgb(looking(22.5, 22.5)), [4.0, 1.0, 1.0]);
        near(image.rgb(looking(22.5, -67.5)), [4.0, 3.0, 1.0]);
    }

    #[test]
    fn the_seam_joins_the_last_column_to_the_first() {
        let image = numbered();
        near(image.rgb(DVec3::Z), [3.5, 1.5, 1.0]); // between 7 and 0
        near(
            image.rgb(looking(179.0, 0.0)),
            [7.0 - 7.0 * 21.5 / 45.0, 1.5, 1.0],
        );
        for elevation in [-80.0, -30.0, 0.0, 10.0, 85.0] {
            let [left, right] =
                [180.0 - 1e-9, -180.0 + 1e-9].map(|azimuth| image.rgb(looking(azimuth, elevation)));
            assert!((left[0] - right[0]).abs() < 1e-8, "{left:?} {right:?}");
        }
    }

    #[test]
    fn a_pole_has_one_color_and_is_reached_continuously() {
        let image = numbered();
        for (pole, row) in [(90.0, 0.0), (-90.0, 3.0)] {
            near(image.rgb(looking(0.0, pole)), [3.5, row, 1.0]);
            for azimuth in 0..36 {
                let azimuth = 10.0 * f64::from(azimuth);
                let beside = image.rgb(looking(azimuth, pole * (1.0 - 1e-9)));
                assert!((beside[0] - 3.5).abs() < 1e-6, "{beside:?}");
            }
        }
        near(image.rgb(DVec3::new(-0.0, 1.0, -0.0)), [3.5, 0.0, 1.0]);
    }

    #[test]
    fn it_is_continuous_all_over_the_sphere() {
        let image = numbered();
        // Colour differs by at most 7 from one center to the next, 1/8 of a turn apart.
        for step in 0..20_000 {
            let azimuth = f64::from(step) * 37.7;
            let elevation = (f64::from(step) * 0.731).rem_euclid(180.0) - 90.0;
            let [a, b] = [0.0, 1e-5].map(|d| image.rgb(looking(azimuth + d, elevation + d)));
            assert!(
                (0..3).all(|c| (a[c] - b[c]).abs() < 1e-4),
                "{azimuth} {elevation}"
            );
        }
    }

    #[test]
    fn texels_that_are_no_light_are_clamped_and_counted() {
        let texels = vec![
            [0.5, -1.0, f32::NAN],
            [f32::INFINITY, f32::NEG_INFINITY, 40.0],
        ];
        let image = SkyImage::new(2, texels);
        assert_eq!(image.warnings, [SkyWarning::Clamped { count: 4 }]);
        assert_eq!(image.texels, [[0.5, 0.0, 0.0], [40.0, 0.0, 40.0]]);
        assert_eq!(SkyImage::new(1, vec![[0.0; 3]]).warnings, []);
        assert_eq!(
            SkyImage::new(1, vec![[f32::INFINITY; 3]]).texels,
            [[0.0; 3]]
        );
    }

    #[test]
    fn one_texel_is_the_whole_sky() {
        let image = SkyImage::new(1, vec![[1.0, 2.0, 3.0]]);
        for direction in [DVec3::X, DVec3::Y, DVec3::NEG_Y, DVec3::NEG_Z] {
            near(image.rgb(direction), [1.0, 2.0, 3.0]);
        }
    }
}
