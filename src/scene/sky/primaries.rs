//! Conversion of a file's colors, by its chromaticities, to linear Rec. 709.

use super::SkyWarning;
use crate::color::spaces::{
    D65_XY, Matrix, PRIMARIES_XY, RGB_FROM_XYZ, XYZ_FROM_RGB, apply, d65_from_white, product,
    xyz_from_primaries,
};

/// Largest difference of a chromaticity from that of Rec. 709 that counts as rounding: files have
/// three digits.
const SAME: f64 = 1e-3;

/// Largest plausible element of a matrix to Rec. 709; those of ProPhoto are about 2, of XYZ 3.3.
const STEEPEST: f64 = 100.0;

/// Largest amount by which rounding may make a component negative, relative to the greatest of its
/// color: half floats have 2⁻¹¹, shared exponents 2⁻⁸, and matrices add to it.
const ROUNDING: f32 = 0.02;

/// The chromaticities x, y of a file's red, green, blue and white.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Primaries {
    pub(super) rgb: [[f64; 2]; 3],
    pub(super) white: [f64; 2],
}

impl Primaries {
    /// CIE XYZ as a color space: the values are X, Y and Z themselves.
    pub(super) const XYZ: Self = Self {
        rgb: [[1.0, 0.0], [0.0, 1.0], [0.0, 0.0]],
        white: [1.0 / 3.0; 2],
    };

    const REC709: Self = Self {
        rgb: PRIMARIES_XY,
        white: D65_XY,
    };

    fn near(&self, other: &Self) -> bool {
        let all = |p: &Self| [p.rgb[0], p.rgb[1], p.rgb[2], p.white];
        let pairs = all(self).into_iter().zip(all(other));
        let mut apart = pairs.flat_map(|(a, b)| [a[0] - b[0], a[1] - b[1]]);
        apart.all(|apart| apart.abs() <= SAME)
    }

    /// Linear Rec. 709 from the file's RGB: the white becomes D65 by Bradford's adaptation, as in
    /// the Academy's and OpenColorIO's conversions (OpenEXR's own programs do not adapt). XYZ are
    /// those of the light itself, without adaptation: D65 is (0.9505, 1, 1.0891). None if the
    /// chromaticities are of no color space.
    fn rec709_from_rgb(&self) -> Option<Matrix> {
        let xyz = xyz_from_primaries(self.rgb, self.white);
        let adapted = if self.near(&Self::XYZ) {
            xyz
        } else {
            product(&d65_from_white(self.white), &xyz)
        };
        let matrix = product(&RGB_FROM_XYZ, &adapted);
        // The white lies within the primaries: each contributes to it, in X + Y + Z.
        let sum = |column: usize| xyz.iter().map(|row| row[column]).sum::<f64>();
        let inside = (0..3).all(|column| sum(column) > 0.0);
        let believed = matrix
            .iter()
            .flatten()
            .all(|element| element.abs() <= STEEPEST);
        (inside && believed).then_some(matrix)
    }

    /// Converts texels to linear Rec. 709. Colors beyond it are mixed with white of their own
    /// luminance until no component is negative, and are counted.
    pub(super) fn convert(&self, texels: &mut [[f32; 3]]) -> Option<SkyWarning> {
        if self.near(&Self::REC709) {
            return None;
        }
        let Some(matrix) = self.rec709_from_rgb() else {
            return Some(SkyWarning::Chromaticities {
                rgb: self.rgb,
                white: self.white,
            });
        };
        let mut count = 0;
        for texel in texels {
            *texel = apply(&matrix, texel.map(f64::from)).map(|part| part as f32);
            count += usize::from(bring_inside(texel));
        }
        (count > 0).then_some(SkyWarning::Gamut { count })
    }
}

/// Mixes a color that has luminance with white of the same luminance until no component is
/// negative. Returns whether it was beyond rounding.
fn bring_inside(texel: &mut [f32; 3]) -> bool {
    let least = texel.iter().copied().fold(f32::INFINITY, f32::min);
    let most = texel.iter().copied().fold(0.0, f32::max);
    let luminance: f64 = (0..3)
        .map(|c| XYZ_FROM_RGB[1][c] * f64::from(texel[c]))
        .sum();
    if !(least < 0.0 && luminance > 0.0 && luminance.is_finite()) {
        return false;
    }
    let part = luminance / (luminance - f64::from(least));
    *texel = texel.map(|v| (luminance + part * (f64::from(v) - luminance)).max(0.0) as f32);
    least < -ROUNDING * most
}
