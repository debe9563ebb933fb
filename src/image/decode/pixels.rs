//! Decoding of a frame's file to pixels.

use super::canvas::{Canvas, Decoded};
use super::file::{Fault, check_size, exr_fault, png_fault};
use ::exr::block::reader::ChunksReader;
use ::exr::math::Vec2;
use std::io::Cursor;

/// Decodes a PNG of 8-bit RGB, with its checksums.
///
/// # Errors
/// The fault of the file.
pub fn png(bytes: &[u8], size: [u32; 2]) -> Result<Decoded, Fault> {
    let limits = ::png::Limits {
        // A row or two, and what zlib needs.
        bytes: (64 << 20) + 64 * size[0] as usize,
    };
    let mut decoder = ::png::Decoder::new_with_limits(Cursor::new(bytes), limits);
    decoder.set_ignore_text_chunk(true);
    let mut reader = decoder.read_info().map_err(png_fault)?;
    let info = reader.info();
    check_size([info.width, info.height].map(|side| side as usize), size)?;
    if (info.color_type, info.bit_depth) != (::png::ColorType::Rgb, ::png::BitDepth::Eight) {
        return Err(Fault::Damaged(
            "its pixels are not red, green and blue of 8 bits".to_owned(),
        ));
    }
    let mut rgb8 = vec![0; size[0] as usize * size[1] as usize * 3];
    reader.next_frame(&mut rgb8).map_err(png_fault)?;
    reader.finish().map_err(png_fault)?;
    Ok(Decoded {
        rgb8,
        not_finite: Vec::new(),
    })
}

/// Decodes an EXR as this program writes it: scan lines of one part, the channels R, G, B, and any
/// number of others that are only checked. `encode` is the display's transfer.
///
/// # Errors
/// The fault of the file.
pub fn exr(bytes: &[u8], size: [u32; 2], encode: fn(f64) -> f64) -> Result<Decoded, Fault> {
    let reader = ::exr::block::read(Cursor::new(bytes), true).map_err(exr_fault)?;
    let [header] = reader.headers() else {
        let parts = reader.headers().len();
        return Err(Fault::Damaged(format!("it has {parts} parts, not one")));
    };
    let Vec2(width, height) = header.layer_size;
    check_size([width, height], size)?;
    let mut canvas = Canvas::new(header, encode)?;
    let channels = header.channels.clone();
    let chunks = reader.all_chunks(true).map_err(exr_fault)?;
    for block in chunks.sequential_decompressor(true) {
        let block = block.map_err(exr_fault)?;
        canvas.take(&block, &channels)?;
    }
    canvas.finish()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::{Developed, Layers, to_rgb8};
    use crate::image::Metadata;
    use crate::image::exr::{self, Depth};
    use crate::image::png;

    const SIZE: [u32; 2] = [19, 37];

    /// A transfer as displays have it.
    fn encode(linear: f64) -> f64 {
        linear.max(0.0).powf(1.0 / 2.2)
    }

    /// A picture of many values, some beyond 1.
    fn linear() -> Developed {
        let pixel = |i: u32| [0, 1, 2].map(|c| ((i * 3 + c) % 101) as f32 / 80.0);
        Developed {
            linear: (0..SIZE[0] * SIZE[1]).map(pixel).collect(),
            saturated: 0,
        }
    }

    fn exr_bytes(developed: &Developed, depth: Depth, layers: &Layers) -> Vec<u8> {
        let metadata = Metadata::default();
        exr::encode(SIZE[0], SIZE[1], developed, depth, layers, &metadata).expect("encodes")
    }

    fn png_bytes(rgb8: &[u8]) -> Vec<u8> {
        png::encode(SIZE[0], SIZE[1], rgb8, &Metadata::default()).expect("encodes")
    }

    #[test]
    fn an_exr_is_shown_as_the_png_of_the_same_light() {
        let developed = linear();
        let rgb8 = to_rgb8(&developed, encode);
        let bytes = exr_bytes(&developed, Depth::Float, &Layers::default());
        let shown = exr(&bytes, SIZE, encode).expect("decodes");
        assert_eq!(shown.rgb8, rgb8);
        assert_eq!(png(&png_bytes(&rgb8), SIZE).expect("decodes"), shown);
    }

    #[test]
    fn a_half_exr_is_within_a_level_of_the_float_one() {
        // A half has 11 digits: 2⁻¹² of a value near 1 is a sixteenth of a level.
        let developed = linear();
        let rgb8 = to_rgb8(&developed, encode);
        let bytes = exr_bytes(&developed, Depth::Half, &Layers::default());
        let shown = exr(&bytes, SIZE, encode).expect("decodes");
        let apart = shown.rgb8.iter().zip(&rgb8).map(|(a, b)| a.abs_diff(*b));
        assert!(apart.max() <= Some(1));
    }

    #[test]
    fn values_that_are_not_finite_are_counted_in_every_channel() {
        let mut developed = linear();
        developed.linear[7][1] = f32::NAN;
        developed.linear[8][1] = f32::INFINITY;
        let mut distance = vec![1.0; developed.linear.len()];
        distance[3] = f32::NEG_INFINITY;
        let layers = Layers {
            distance: Some(distance),
            ..Layers::default()
        };
        for depth in [Depth::Float, Depth::Half] {
            let bytes = exr_bytes(&developed, depth, &layers);
            let found = exr(&bytes, SIZE, encode).expect("decodes");
            let expected = match depth {
                // What a half cannot hold is clamped when it is written, all but NaN.
                Depth::Half => [("G".to_owned(), 1), ("distance".to_owned(), 1)],
                Depth::Float => [("G".to_owned(), 2), ("distance".to_owned(), 1)],
            };
            assert_eq!(found.not_finite, expected);
        }
    }

    #[test]
    fn a_file_cut_anywhere_is_a_fault() {
        let developed = linear();
        let exr_file = exr_bytes(&developed, Depth::Float, &Layers::default());
        for end in 0..exr_file.len() {
            let cut = exr(&exr_file[..end], SIZE, encode);
            assert!(cut.is_err(), "{end} of {}", exr_file.len());
        }
        let png_file = png_bytes(&to_rgb8(&developed, encode));
        for end in 0..png_file.len() {
            assert!(
                png(&png_file[..end], SIZE).is_err(),
                "{end} of {}",
                png_file.len()
            );
        }
        let most = exr_file.len() - 40;
        let fault = exr(&exr_file[..most], SIZE, encode).expect_err("is cut");
        assert_eq!(fault, Fault::Truncated);
        let fault = png(&png_file[..png_file.len() - 40], SIZE).expect_err("is cut");
        assert_eq!(fault, Fault::Truncated);
    }

    #[test]
    fn a_file_with_any_byte_changed_neither_panics_nor_takes_memory() {
        let developed = linear();
        let exr_file = exr_bytes(&developed, Depth::Float, &Layers::default());
        let png_file = png_bytes(&to_rgb8(&developed, encode));
        let mut refused = [0; 2];
        for value in [0x00, 0x7f, 0x80, 0xff] {
            for at in 0..exr_file.len() {
                let mut file = exr_file.clone();
                file[at] = value;
                refused[0] += usize::from(exr(&file, SIZE, encode).is_err());
            }
            for at in 0..png_file.len() {
                let mut file = png_file.clone();
                file[at] = value;
                refused[1] += usize::from(png(&file, SIZE).is_err());
            }
        }
        assert!(refused.iter().all(|refused| *refused > 100), "{refused:?}");
    }

    #[test]
    fn another_size_is_refused_before_anything_is_decoded() {
        let bytes = exr_bytes(&linear(), Depth::Float, &Layers::default());
        let fault = exr(&bytes, [20, 37], encode).expect_err("is another");
        assert_eq!(
            fault.to_string(),
            "wrong size: 19 x 37 pixels, not 20 x 37 pixels"
        );
        let bytes = png_bytes(&to_rgb8(&linear(), encode));
        assert!(matches!(png(&bytes, [1, 1]), Err(Fault::Size { .. })));
    }
}
