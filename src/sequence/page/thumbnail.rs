//! A frame's thumbnail, as text embedded in the page.

use crate::sequence::frame_image::FrameImage;
use base64::prelude::{BASE64_STANDARD, Engine};
use image::codecs::jpeg::JpegEncoder;
use image::imageops::thumbnail;
use image::{ExtendedColorType, RgbImage};

/// Width of the largest, which the player shows while it plays, in pixels.
const WIDEST: u32 = 640;
/// Width of the smallest, however many bytes it has, in pixels.
const NARROWEST: u32 = 64;
/// JPEG quality, from 1 to 100.
const QUALITY: u8 = 80;
/// Bytes of all images of a page together, as embedded.
const BUDGET: usize = 11_000_000;

/// A thumbnail.
pub(super) struct Thumbnail {
    /// Width and height of the frame, in pixels.
    pub(super) size: [u32; 2],
    /// `data:image/jpeg;base64,…`
    pub(super) url: String,
}

/// The thumbnail of one of this many frames, as large as the page can bear.
pub(super) fn small(image: FrameImage, frames: u32) -> Option<Thumbnail> {
    let size = [image.width, image.height];
    let image = RgbImage::from_raw(image.width, image.height, image.rgb8)?;
    // Base64 has 4 characters for 3 bytes.
    let most = BUDGET / 4 * 3 / frames.max(1) as usize;
    let jpeg = fitting(&image, most)?;
    let url = format!("data:image/jpeg;base64,{}", BASE64_STANDARD.encode(jpeg));
    Some(Thumbnail { size, url })
}

/// The image as JPEG of at most `most` bytes, unless it has the smallest size.
fn fitting(image: &RgbImage, most: usize) -> Option<Vec<u8>> {
    let mut width = image.width().min(WIDEST);
    loop {
        let bytes = encoded(image, width)?;
        if bytes.len() <= most || width <= NARROWEST {
            return Some(bytes);
        }
        // Bytes are about proportional to pixels; a little less, so that few rounds are needed.
        let shrink = (most as f64 / bytes.len() as f64).sqrt() * 0.95;
        width = ((f64::from(width) * shrink) as u32).max(NARROWEST);
    }
}

fn encoded(image: &RgbImage, width: u32) -> Option<Vec<u8>> {
    let rows = f64::from(image.height()) * f64::from(width) / f64::from(image.width());
    // JPEG has no sides above 65535; images higher than 64 times their width are cut short.
    let height = (rows.round() as u32).clamp(1, width * 64);
    let small = thumbnail(image, width, height);
    let mut bytes = Vec::new();
    JpegEncoder::new_with_quality(&mut bytes, QUALITY)
        .encode(&small, width, height, ExtendedColorType::Rgb8)
        .ok()?;
    Some(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Noise, which JPEG can shrink least.
    fn noise(width: u32, height: u32) -> FrameImage {
        let mut state = 1_u32;
        let mut byte = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 24) as u8
        };
        let rgb8 = (0..width * height * 3).map(|_| byte()).collect();
        FrameImage {
            width,
            height,
            rgb8,
        }
    }

    #[test]
    fn the_pictures_of_any_sequence_fit_into_the_budget() {
        for frames in [1, 49, 1000] {
            let thumbnail = small(noise(640, 360), frames).expect("a picture");
            let all = thumbnail.url.len() * frames as usize;
            assert!(all < BUDGET + 100 * frames as usize, "{frames}: {all}");
            assert_eq!(thumbnail.size, [640, 360]);
        }
    }

    #[test]
    fn pictures_of_any_shape_have_a_small_one() {
        for [width, height] in [[1, 1], [1, 5000], [5000, 1], [640, 3], [3, 640]] {
            let thumbnail = small(noise(width, height), 1000).expect("a picture");
            assert_eq!(thumbnail.size, [width, height]);
            let text = thumbnail.url.split_once(',').expect("a data URL").1;
            let bytes = BASE64_STANDARD.decode(text).expect("base64");
            image::load_from_memory(&bytes).expect("a JPEG");
        }
    }
}
