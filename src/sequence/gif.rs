//! An animated GIF: 256 colours, one palette for all frames. CompuServe, GIF89a (1990); loops by the
//! Netscape 2.0 extension.

use super::frame_image::FrameImage;
use super::output::Encoder;
use super::palette::Palette;
use crate::store::{AtomicFile, AtomicWriter};
use std::path::PathBuf;

/// Most frames a second that viewers show: faster ones they slow to 10.
pub(super) const FASTEST: f64 = 50.0;

/// Frames that the palette is made of, at most.
pub(super) const SAMPLED_FRAMES: u32 = 32;

/// Pixels that the palette is made of, at most, of all frames.
const SAMPLED_PIXELS: usize = 1 << 19;

/// Encoder of an animated GIF.
pub(super) struct Gif {
    file: AtomicFile,
    encoder: gif::Encoder<AtomicWriter>,
    palette: Palette,
    size: [u16; 2],
    fps: f64,
}

/// Sample of the pixels of a picture, one of those that represent `frames`.
pub(super) fn sample(image: &FrameImage, frames: u32) -> impl Iterator<Item = [u8; 3]> + '_ {
    let pixels = image.rgb8.as_chunks::<3>().0;
    let most = SAMPLED_PIXELS / frames.clamp(1, SAMPLED_FRAMES) as usize;
    // Odd, so that it does not keep to a few columns of an even width.
    let step = pixels.len().div_ceil(most.max(1)) | 1;
    pixels.iter().step_by(step).copied()
}

impl Gif {
    /// Begins one of frames of a size, `fps` of them a second; it plays forever.
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

/// Delay of a frame, counted from 1, hundredths of a second. Rounded so that the start of every frame is
/// off by half a hundredth at most.
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
