//! An animated GIF: 256 colors, one palette for all frames. CompuServe, GIF89a (1990); loops by the
//! Netscape 2.0 extension.

use super::frame_image::FrameImage;
use super::output::Encoder;
use super::palette::Palette;
use crate::store::{AtomicFile, AtomicWriter};
use std::path::PathBuf;

/// Highest frame rate that viewers show; they slow faster ones down to 10 per second.
pub(super) const FASTEST: f64 = 50.0;

/// Number of frames from which the palette is made at most.
pub(super) const SAMPLED_FRAMES: u32 = 32;

/// Number of pixels, of all frames, from which the palette is made at most.
const SAMPLED_PIXELS: usize = 1 << 19;

/// An animation being written.
pub(super) struct Gif {
    file: AtomicFile,
    encoder: gif::Encoder<AtomicWriter>,
    palette: Palette,
    size: [u16; 2],
    fps: f64,
}

/// A regular sample of the pixels of an image that represents `frames`.
pub(super) fn sample(image: &FrameImage, frames: u32) -> impl Iterator<Item = [u8; 3]> + '_ {
    let pixels = image.rgb8.as_chunks::<3>().0;
    let most = SAMPLED_PIXELS / frames.clamp(1, SAMPLED_FRAMES) as usize;
    // Odd, so that it does not stay in a few columns of an even width.
    let step = pixels.len().div_ceil(most.max(1)) | 1;
    pixels.iter().step_by(step).copied()
}

impl Gif {
    /// Begins an animation of this size, `fps` frames per second; it loops forever.
    pub(super) fn new(
        file: AtomicFile,
        size: [u32; 2],
        fps: f64,
        palette: Palette,
    ) -> Result<Self, String> {
        let [Ok(width), Ok(height)] = size.map(u16::try_from) else {
            let [width, height] = size;
            return Err(format!(
                "a GIF has at most 65535 pixels a side, not {width} x {height}; ask for apng"
            ));
        };
        let begin = || {
            let mut encoder = gif::Encoder::new(file.writer(), width, height, &palette.bytes())?;
            encoder.set_repeat(gif::Repeat::Infinite)?;
            Ok(encoder)
        };
        let encoder = begin().map_err(|error: gif::EncodingError| error.to_string())?;
        Ok(Self {
            file,
            encoder,
            palette,
            size: [width, height],
            fps,
        })
    }
}

impl Encoder for Gif {
    fn add(&mut self, frame: u32, image: &FrameImage) -> Result<(), String> {
        let [width, height] = self.size;
        let indices = self.palette.map(&image.rgb8, usize::from(width));
        let frame = gif::Frame {
            width,
            height,
            delay: delay(frame, self.fps),
            buffer: indices.into(),
            ..gif::Frame::default()
        };
        let written = self.encoder.write_frame(&frame);
        written.map_err(|error| error.to_string())
    }

    fn finish(self: Box<Self>) -> Result<PathBuf, String> {
        let written = self.encoder.into_inner();
        written.map_err(|error| error.to_string())?;
        self.file.keep().map_err(|error| error.to_string())
    }
}

/// Display time of a frame, counted from 1, in hundredths of a second, such that the time up to any
/// frame is off by at most half of one.
fn delay(frame: u32, fps: f64) -> u16 {
    let end = |frame: u32| (f64::from(frame) * 100.0 / fps).round();
    (end(frame) - end(frame - 1)).clamp(0.0, f64::from(u16::MAX)) as u16
}

#[cfg(test)]
mod tests {
    use super::delay;

    #[test]
    fn delays_add_up_to_the_length_of_the_sequence() {
        for fps in [24.0, 23.976, 30.0, 12.5, 50.0, 7.0] {
            for frames in [1, 10, 49, 1000] {
                let total: f64 = (1..=frames).map(|frame| f64::from(delay(frame, fps))).sum();
                let exact = f64::from(frames) * 100.0 / fps;
                assert!((total - exact).abs() <= 0.5, "{fps}, {frames}: {total}");
            }
        }
    }
}
