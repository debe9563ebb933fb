//! Development of a film: XYZ to linear Rec. 709 after exposure, or bands to bands; and linear
//! light to eight bits.
//!
//! 0 stops makes 100 cd/m² of the adopted white 1.0, or 100 W·m⁻²·sr⁻¹ of a band; each stop
//! doubles. Nothing is clipped except values that f32 cannot hold, since beaming spans more than
//! its 76 decades.

use super::Film;
use crate::color::compressed;
use rayon::prelude::*;

/// Parameters of development.
#[derive(Debug, Clone, Copy)]
pub struct Development {
    /// Linear Rec. 709 from CIE XYZ, rows R, G, B; white at Y = 1 becomes (1, 1, 1). The identity
    /// for bands, which are shown as red, green and blue.
    pub rgb_from_xyz: [[f64; 3]; 3],
    /// Exposure in stops: 0 makes 100 cd/m² (W·m⁻²·sr⁻¹ of a band) 1.0, +1 doubles.
    pub exposure_stops: f64,
    /// The display's transfer from linear to encoded value, both 0 to 1: the sRGB curve.
    /// Used by [`to_rgb8`], not for [`Developed`].
    pub encode: fn(f64) -> f64,
}

/// A developed film: linear light, always finite.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Developed {
    /// Linear Rec. 709, or bands, one triple per pixel. 1 is the display's white; values outside
    /// its gamut are negative.
    pub linear: Vec<[f32; 3]>,
    /// Number of values, on the film or after exposure, that were not finite or beyond `f32`.
    /// Infinite and too large ones are clamped to ±`f32::MAX`, NaN becomes 0.
    pub saturated: u64,
}

/// Develops `film`: rgb = M · xyz / 100 · 2^stops, with M = [`Development::rgb_from_xyz`].
///
/// # Example
/// One pixel of D65 white at 25 cd/m², brought to 1.0 by two stops.
/// ```
/// use restframe::color::spaces::{D65_XYZ, RGB_FROM_XYZ, encode};
/// use restframe::film::{Development, Film, develop, to_rgb8};
///
/// let film = Film {
///     width: 1,
///     height: 1,
///     xyz: vec![D65_XYZ.map(|value| (25.0 * value) as f32)],
///     ..Film::default()
/// };
/// let development = Development { rgb_from_xyz: RGB_FROM_XYZ, exposure_stops: 2.0, encode };
/// let developed = develop(&film, &development);
/// assert!(developed.linear[0].iter().all(|value| (value - 1.0).abs() < 1e-6));
/// assert_eq!(to_rgb8(&developed, encode), [255, 255, 255]);
/// ```
pub fn develop(film: &Film, development: &Development) -> Developed {
    // Kept finite: an infinite gain would turn black into NaN.
    let gain = (development.exposure_stops.exp2() / 100.0).min(f64::MAX);
    let mut saturated = 0;
    let linear = film
        .xyz
        .iter()
        .map(|xyz| {
            let xyz = xyz.map(|value| f64::from(hold(f64::from(value), &mut saturated)));
            development
                .rgb_from_xyz
                .map(|row| hold(dot(row, xyz) * gain, &mut saturated))
        })
        .collect();
    Developed { linear, saturated }
}

/// Linear light to 8 bits: encoded, clipped to 0 … 1, rounded to nearest. Three bytes per pixel.
pub fn to_rgb8(developed: &Developed, encode: fn(f64) -> f64) -> Vec<u8> {
    let quantize = |linear: f32| (encode(f64::from(linear)).clamp(0.0, 1.0) * 255.0).round() as u8;
    let mut rgb8 = vec![0; developed.linear.len() * 3];
    rgb8.par_chunks_exact_mut(3)
        .zip(&developed.linear)
        .for_each(|(bytes, linear)| {
            for (byte, &value) in bytes.iter_mut().zip(linear) {
                *byte = quantize(value);
            }
        });
    rgb8
}

/// The same colors, those that no screen shows brought into its gamut by [`compressed`].
pub fn compress_gamut(developed: &Developed) -> Developed {
    let shown = |linear: &[f32; 3]| compressed(linear.map(f64::from)).map(|part| part as f32);
    Developed {
        linear: developed.linear.par_iter().map(shown).collect(),
        saturated: developed.saturated,
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The nearest finite `f32`, 0 for NaN. Counts values that did not fit.
fn hold(value: f64, saturated: &mut u64) -> f32 {
    const MAX: f64 = f32::MAX as f64;
    if value.abs() <= MAX {
        return value as f32;
    }
    *saturated += 1;
    if value.is_nan() {
        0.0
    } else {
        value.clamp(-MAX, MAX) as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const IDENTITY: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

    fn developed(xyz: &[[f32; 3]], exposure_stops: f64) -> Developed {
        let film = Film {
            width: xyz.len() as u32,
            height: 1,
            xyz: xyz.to_vec(),
            ..Film::default()
        };
        develop(
            &film,
            &Development {
                rgb_from_xyz: IDENTITY,
                exposure_stops,
                encode: |x| x,
            },
        )
    }

    #[test]
    fn zero_stops_make_100_candela_one_and_a_stop_doubles() {
        assert_eq!(
            developed(&[[100.0, 50.0, -25.0]], 0.0).linear,
            [[1.0, 0.5, -0.25]]
        );
        assert_eq!(
            developed(&[[100.0, 50.0, -25.0]], 3.0).linear,
            [[8.0, 4.0, -2.0]]
        );
    }

    #[test]
    fn what_a_float_cannot_hold_is_clamped_and_counted() {
        let result = developed(&[[1e38, -1e38, 1.0], [0.0, 0.0, 0.0]], 20.0);
        assert_eq!(result.linear[0][..2], [f32::MAX, -f32::MAX]);
        assert_eq!(result.linear[1], [0.0; 3]);
        assert_eq!(result.saturated, 2);
    }

    #[test]
    fn values_that_are_not_finite_are_counted_and_never_reach_the_picture() {
        let result = developed(&[[f32::NAN, f32::INFINITY, f32::NEG_INFINITY]], 0.0);
        assert_eq!(result.linear[0][0], 0.0);
        assert!(result.linear[0][1] > 1e36 && result.linear[0][2] < -1e36);
        assert!(result.linear[0].iter().all(|value| value.is_finite()));
        assert_eq!(result.saturated, 3);
    }

    #[test]
    fn black_stays_black_at_any_exposure() {
        for stops in [-1e9, -2000.0, 2000.0, f64::INFINITY] {
            assert_eq!(developed(&[[0.0; 3]], stops), developed(&[[0.0; 3]], 0.0));
        }
    }

    #[test]
    fn eight_bits_are_clipped_and_rounded_to_nearest() {
        let linear = vec![
            [-0.5, 0.0, 1.0],
            [7.0, f32::MAX, 0.5 / 255.0],
            [0.49 / 255.0, 0.5, 0.6],
        ];
        let rgb8 = to_rgb8(
            &Developed {
                linear,
                saturated: 0,
            },
            |x| x,
        );
        assert_eq!(rgb8, [0, 0, 255, 255, 255, 1, 0, 128, 153]);
    }
}
