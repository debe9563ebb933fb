//! An animated PNG: every frame with all its colors. W3C, Portable Network Graphics (Third
//! Edition), 2025: acTL, fcTL, fdAT.

use super::frame_image::FrameImage;
use super::output::Encoder;
use crate::store::{AtomicFile, AtomicWriter};
use std::path::PathBuf;

/// An animation being written.
pub(super) struct Apng {
    file: AtomicFile,
    writer: png::Writer<AtomicWriter>,
}

impl Apng {
    /// Begins an animation of this many frames, `rate` of them per second as a fraction; it loops
    /// forever.
    pub(super) fn new(
        file: AtomicFile,
        [width, height]: [u32; 2],
        frames: u32,
        rate: (i32, u32),
    ) -> Result<Self, String> {
        let begin = || -> Result<_, png::EncodingError> {
            let mut encoder = png::Encoder::new(file.writer(), width, height);
            encoder.set_color(png::ColorType::Rgb);
            encoder.set_depth(png::BitDepth::Eight);
            encoder.set_source_srgb(png::SrgbRenderingIntent::RelativeColorimetric);
            encoder.set_animated(frames, 0)?;
            let (numerator, denominator) = delay(rate);
            encoder.set_frame_delay(numerator, denominator)?;
            encoder.write_header()
        };
        let writer = begin().map_err(|error| error.to_string())?;
        Ok(Self { file, writer })
    }
}

impl Encoder for Apng {
    fn add(&mut self, _: u32, image: &FrameImage) -> Result<(), String> {
        self.writer
            .write_image_data(&image.rgb8)
            .map_err(|error| error.to_string())
    }

    fn finish(self: Box<Self>) -> Result<PathBuf, String> {
        self.writer.finish().map_err(|error| error.to_string())?;
        self.file.keep().map_err(|error| error.to_string())
    }
}

/// Seconds of a frame as a fraction of 16 bits: exact if it fits, else to 10⁻³ of it or to what 16
/// bits can hold.
fn delay((numerator, denominator): (i32, u32)) -> (u16, u16) {
    let (rate, over) = (f64::from(numerator), f64::from(denominator));
    let shrink = (rate.max(over) / f64::from(u16::MAX)).max(1.0);
    let fit = |value: f64| (value / shrink).round().clamp(1.0, f64::from(u16::MAX)) as u16;
    (fit(over), fit(rate))
}

#[cfg(test)]
mod tests {
    use super::delay;

    #[test]
    fn delays_of_usual_rates_are_exact() {
        assert_eq!(delay((24, 1)), (1, 24));
        assert_eq!(delay((24_000, 1001)), (1001, 24_000));
        assert_eq!(delay((25, 2)), (2, 25));
        let (n, d) = delay((120_000, 1001));
        let exact = 1001.0 / 120_000.0;
        assert!((f64::from(n) / f64::from(d) / exact - 1.0).abs() < 1e-3);
    }
}
