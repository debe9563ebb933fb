//! A finished frame as pixels, and smaller copies of it.

use crate::color::spaces;
use crate::image::decode::{self, Decoded, Fault};
use crate::render::development;
use crate::shot::{Format, Shot};
use crate::store::ShotFolder;
use std::path::PathBuf;

/// An image of 8 bits per channel, sRGB, as in the PNG.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FrameImage {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Three bytes per pixel, row by row from the top.
    pub rgb8: Vec<u8>,
}

/// A frame that cannot be read.
#[derive(Debug, thiserror::Error)]
#[error("frame {frame}: {}: {why}", file.display())]
pub struct FrameImageError {
    /// Its number.
    pub frame: u32,
    /// The file.
    pub file: PathBuf,
    /// The reason.
    pub why: String,
}

/// Reads a frame from its PNG or, if none is written, from its EXR, with the transfer that a PNG
/// has. It must have the size that the folder expects.
///
/// # Errors
/// A file that is missing, broken or of another size.
pub fn read(shot_folder: &ShotFolder, frame: u32) -> Result<FrameImage, FrameImageError> {
    let extension = shown_extension(shot_folder.shot());
    let file = shot_folder
        .path
        .join(shot_folder.names.frame(frame, extension));
    let size = shot_folder.keys.resolution().size;
    let decoded = decode::read_bytes(&file, size)
        .and_then(|bytes| decode_as(shot_folder.shot(), extension, &bytes, size));
    match decoded {
        Ok(Decoded { rgb8, .. }) => Ok(FrameImage {
            width: size[0],
            height: size[1],
            rgb8,
        }),
        Err(fault) => Err(FrameImageError {
            frame,
            file,
            why: fault.to_string(),
        }),
    }
}

/// The extension of the files from which frames are shown.
pub(super) fn shown_extension(shot: &Shot) -> &'static str {
    if shot.output.formats.contains(&Format::Png) {
        "png"
    } else {
        "exr"
    }
}

/// Decodes a file of a shot by its extension.
pub(super) fn decode_as(
    shot: &Shot,
    extension: &str,
    bytes: &[u8],
    size: [u32; 2],
) -> Result<Decoded, Fault> {
    match extension {
        // An EXR holds exposed light: only the transfer is left of development.
        "exr" => decode::exr(bytes, size, development(shot.sensor.color, 0.0).encode),
        _ => decode::png(bytes, size),
    }
}

/// An image at another size, never enlarged: each pixel is the mean, in linear light, over the area
/// that it covers. An image of that size already is unchanged.
pub(super) fn reduce(image: &FrameImage, width: u32, height: u32) -> FrameImage {
    if [width, height] == [image.width, image.height] {
        return image.clone();
    }
    let linear: Vec<f32> = (0..=255_u8)
        .map(|byte| spaces::decode(f64::from(byte) / 255.0) as f32)
        .collect();
    let stride = image.width as usize * 3;
    let mut rgb8 = Vec::with_capacity(width as usize * height as usize * 3);
    for y in 0..height {
        // Rows first, then columns of their mean.
        let mut mean = vec![0.0_f32; stride];
        for (row, weight) in shares(y, height, image.height) {
            let bytes = &image.rgb8[row as usize * stride..][..stride];
            for (sum, byte) in mean.iter_mut().zip(bytes) {
                *sum += weight * linear[usize::from(*byte)];
            }
        }
        for x in 0..width {
            let mut sum = [0.0_f32; 3];
            for (column, weight) in shares(x, width, image.width) {
                for (sum, value) in sum.iter_mut().zip(&mean[column as usize * 3..]) {
                    *sum += weight * value;
                }
            }
            let encode = |linear: f32| spaces::encode(f64::from(linear)) * 255.0;
            rgb8.extend(sum.map(|linear| encode(linear).round().clamp(0.0, 255.0) as u8));
        }
    }
    FrameImage {
        width,
        height,
        rgb8,
    }
}

/// The pixels of `old` that pixel `index` of `new` covers, with their shares, which add up to 1.
fn shares(index: u32, new: u32, old: u32) -> impl Iterator<Item = (u32, f32)> {
    let scale = f64::from(old) / f64::from(new);
    let (from, to) = (f64::from(index) * scale, f64::from(index + 1) * scale);
    let last = (to.ceil() as u32).min(old);
    (from as u32..last).map(move |pixel| {
        let low = from.max(f64::from(pixel));
        let high = to.min(f64::from(pixel + 1));
        (pixel, ((high - low).max(0.0) / scale) as f32)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn black_and_white_mix_to_half_the_light() {
        let image = FrameImage {
            width: 2,
            height: 2,
            rgb8: vec![0, 0, 0, 255, 255, 255, 255, 255, 255, 0, 0, 0],
        };
        // Half the light is 0.735 of the code, not half of it.
        assert_eq!(reduce(&image, 1, 1).rgb8, [188, 188, 188]);
    }

    #[test]
    fn shares_cover_each_old_pixel_once() {
        for (old, new) in [(7, 3), (1280, 320), (37, 36), (5, 5), (1000, 1)] {
            let mut covered = vec![0.0; old as usize];
            for index in 0..new {
                let mut sum = 0.0;
                for (pixel, share) in shares(index, new, old) {
                    covered[pixel as usize] += f64::from(share);
                    sum += f64::from(share);
                }
                // Shares of 32 bits.
                assert!((sum - 1.0).abs() < 1e-4, "{old} to {new}: {sum}");
            }
            let each = f64::from(new) / f64::from(old);
            assert!(covered.iter().all(|share| (share - each).abs() < 1e-5));
        }
    }
}
