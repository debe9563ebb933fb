//! Metadata of an image file, the same for PNG and EXR.
//!
//! Everything except the channels is optional; only what is given is written. There are no
//! wall-clock times here, because equal shots give equal bytes.

use crate::film::Channels;

/// Name and version of this program, as files have it.
pub const SOFTWARE: &str = concat!("restframe ", env!("CARGO_PKG_VERSION"));

/// Keyword of the fingerprint in image files.
pub const FINGERPRINT: &str = "restframe:fingerprint";

/// The facts written into a file. Each field states their names in files.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Metadata {
    /// Program and version, `software` or `Software`; see [`SOFTWARE`].
    pub software: Option<String>,
    /// A title or comment, `comments` or `Comment`.
    pub comments: Option<String>,
    /// Owner of the image, `owner` or `Author`.
    pub owner: Option<String>,
    /// Frames per second of the sequence, `framesPerSecond` (EXR only, a rational). Above 0.
    pub frames_per_second: Option<f64>,
    /// World (the lab) to camera space, `worldToCamera` (EXR only): camera space left-handed,
    /// y up, looking along +z. For column vectors, in column-major order (glam's
    /// `to_cols_array`); OpenEXR's own order, row vectors in row-major order, is the same.
    pub camera_from_world: Option<[f64; 16]>,
    /// World to normalized device space, `worldToNDC` (EXR only), ordered as the other.
    pub ndc_from_world: Option<[f64; 16]>,
    /// Meaning of R, G and B. For bands the files have `restframe:color`, "bands", and nothing that
    /// holds only for colors: the EXR has neither `chromaticities`, `adoptedNeutral` nor
    /// `whiteLuminance`, and the `colorInteropID` of data that are not a color.
    pub channels: Channels,
    /// Shortest and longest wavelength seen, nm, `restframe:window`.
    pub window_nm: Option<[f64; 2]>,
    /// Exposure in stops, `restframe:exposure`: 1.0 is 100 / 2^stops in cd/m² of white, or in
    /// W·m⁻²·sr⁻¹ of a band. For colors it also gives the EXR's `whiteLuminance`, the cd/m² of RGB
    /// (1, 1, 1).
    pub exposure_stops: Option<f64>,
    /// Samples per pixel, `samplesPerPixel` (PNG: `restframe:samples`).
    pub samples_per_pixel: Option<u32>,
    /// Number of the frame, from 1, `restframe:frame`.
    pub frame: Option<u32>,
    /// Velocity of the camera in the lab, units of c, `restframe:beta`.
    pub beta: Option<[f64; 3]>,
    /// Lorentz factor of the camera in the lab, `restframe:gamma`; exact even where `beta` in the
    /// EXR's single precision is 1.
    pub lorentz_factor: Option<f64>,
    /// The shot's time at the frame, s, `restframe:time`.
    pub time_s: Option<f64>,
    /// Names of the worldlines in the order of the layer's numbers, `restframe:worldlines`.
    pub worldlines: Vec<String>,
    /// Fingerprint: hash of everything that affects the pixels, `restframe:fingerprint`; read back
    /// by [`fingerprint`](super::fingerprint).
    pub fingerprint: Option<String>,
    /// The shot as TOML, `restframe:shot`.
    pub shot: Option<String>,
}

impl Metadata {
    /// The luminance of RGB (1, 1, 1) in cd/m², if it is a color, the exposure is known and `f32`
    /// can hold it.
    pub(super) fn white_luminance(&self) -> Option<f32> {
        if self.channels != Channels::Xyz {
            return None;
        }
        let white = crate::film::WHITE_AT_ZERO_STOPS / self.exposure_stops?.exp2();
        Some(white as f32).filter(|white| white.is_normal())
    }

    /// Frames per second as numerator and denominator, if it is above 0 and fits.
    pub(super) fn frame_rate(&self) -> Option<(i32, u32)> {
        self.frames_per_second.and_then(rational_rate)
    }
}

/// A frame rate as a fraction: the broadcast rates (23.976, 29.97, 59.94 …) as n·1000/1001, others
/// by the least denominator up to 1000. None if it is not above 0, or beyond a million.
pub fn rational_rate(rate: f64) -> Option<(i32, u32)> {
    const TOLERANCE: f64 = 1e-6;
    const BROADCAST_TOLERANCE: f64 = 1e-4;
    if !(rate > 0.0 && rate < 1e6) {
        return None;
    }
    let nominal = (rate * 1.001).round();
    let is_whole = (rate - rate.round()).abs() < TOLERANCE;
    if !is_whole && (rate * 1.001 - nominal).abs() < BROADCAST_TOLERANCE {
        return Some((nominal as i32 * 1000, 1001));
    }
    let error = |denominator: u32| {
        let scaled = rate * f64::from(denominator);
        (scaled - scaled.round()).abs()
    };
    let denominator = (1..1000).find(|&d| error(d) < TOLERANCE).unwrap_or(1000);
    let numerator = (rate * f64::from(denominator)).round() as i32;
    (numerator > 0).then_some((numerator, denominator))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frame_rates_become_the_rationals_that_players_know() {
        for (rate, expected) in [
            (24.0, Some((24, 1))),
            (23.976, Some((24_000, 1001))),
            (29.97, Some((30_000, 1001))),
            (59.94, Some((60_000, 1001))),
            (12.5, Some((25, 2))),
            (1.0 / 3.0, Some((1, 3))),
            (f64::NAN, None),
            (0.0, None),
            (-24.0, None),
            (1e300, None),
            (1e-9, None),
        ] {
            assert_eq!(rational_rate(rate), expected, "{rate}");
        }
    }

    #[test]
    fn white_luminance_halves_with_each_stop() {
        let white = |stops| {
            Metadata {
                exposure_stops: Some(stops),
                ..Metadata::default()
            }
            .white_luminance()
        };
        assert_eq!(white(0.0), Some(100.0));
        assert_eq!(white(1.0), Some(50.0));
        assert_eq!(white(-2.0), Some(400.0));
        assert_eq!(white(-500.0), None);
        assert_eq!(Metadata::default().white_luminance(), None);
    }
}
