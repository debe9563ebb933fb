//! A frame's file to pixels, read to its last byte, with all that can be wrong with it.
//!
//! The files may be anybody's: nothing is decoded whose size is not the one expected, so that
//! memory is bounded by the shot's own image, and no more of a file is read than such an image can
//! need.

mod canvas;

use ::exr::block::reader::ChunksReader;
use ::exr::error::Error as ExrError;
use ::exr::math::Vec2;
use ::png::DecodingError;
use canvas::Canvas;
use std::fs::{self, File};
use std::io::{self, Cursor, Read};
use std::path::Path;

/// What a file may have beside its pixels, bytes: the shot's text is at most 4 MiB of it.
pub(super) const MOST_METADATA: u64 = 16 << 20;

/// Channels at most: three colours and four layers.
const MOST_CHANNELS: usize = 7;

/// Bytes a pixel at most: channels of 32 bits, and as much again for what does not compress.
const MOST_PIXEL: u64 = 2 * 4 * MOST_CHANNELS as u64;

/// What is wrong with a file. Messages continue "FILE: ".
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Fault {
    /// It is not there.
    #[error("missing")]
    Missing,
    /// It has no bytes.
    #[error("empty: it has no bytes")]
    Empty,
    /// It ends too early.
    #[error("truncated: it ends before the picture does")]
    Truncated,
    /// What it holds is no picture of ours.
    #[error("damaged: {0}")]
    Damaged(String),
    /// Another size.
    #[error("wrong size: {}, not {}", pixels(*found), pixels(*expected))]
    Size {
        /// Pixels in a row, and rows.
        found: [usize; 2],
        /// What they should be.
        expected: [usize; 2],
    },
    /// The system cannot read it.
    #[error("unreadable: {0}")]
    Unreadable(String),
}

/// A size in words.
fn pixels([width, height]: [usize; 2]) -> String {
    format!("{width} x {height} pixels")
}

/// Pixels of 8 bits, and the channels with values that are not finite, each with how many.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Decoded {
    /// Three bytes a pixel, row by row from the top.
    pub rgb8: Vec<u8>,
    /// By name.
    pub not_finite: Vec<(String, u64)>,
}

/// Opens a regular file to be read, whoever put it there: a pipe would wait for a writer for ever,
/// and a device never end.
///
/// # Errors
/// Of the system, and what is no regular file.
pub fn open(path: &Path) -> io::Result<File> {
    if !fs::metadata(path)?.is_file() {
        let why = "it is no regular file; move it away";
        return Err(io::Error::new(io::ErrorKind::InvalidInput, why));
    }
    File::open(path)
}

/// The bytes of a file, unless it has more than an image of this size can need.
///
/// # Errors
/// A file that is missing, empty, too long or cannot be read.
pub fn read_bytes(path: &Path, size: [u32; 2]) -> Result<Vec<u8>, Fault> {
    let most = u64::from(size[0]) * u64::from(size[1]) * MOST_PIXEL + MOST_METADATA;
    let unreadable = |error: io::Error| match error.kind() {
        io::ErrorKind::NotFound => Fault::Missing,
        _ => Fault::Unreadable(error.to_string()),
    };
    let file = open(path).map_err(unreadable)?;
    let mut bytes = Vec::new();
    file.take(most + 1)
        .read_to_end(&mut bytes)
        .map_err(unreadable)?;
    match bytes.len() as u64 {
        0 => Err(Fault::Empty),
        length if length > most => Err(Fault::Damaged(format!(
            "it has more than {most} bytes, and no {} can need so many",
            pixels(size.map(|side| side as usize))
        ))),
        _ => Ok(bytes),
    }
}

/// Decodes a PNG of 8-bit RGB, checksums and all.
///
/// # Errors
/// What is wrong with it.
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

fn png_fault(error: DecodingError) -> Fault {
    match error {
        DecodingError::IoError(error) if error.kind() == io::ErrorKind::UnexpectedEof => {
            Fault::Truncated
        }
        error => Fault::Damaged(plain(&error.to_string())),
    }
}

/// Decodes an EXR as this program writes it: scan lines of one part, the channels R, G, B, and any
/// number of others that are only looked through. `encode` is the display's transfer.
///
/// # Errors
/// What is wrong with it.
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

fn exr_fault(error: ExrError) -> Fault {
    let text = error.to_string();
    // The decoder's words for an end of file.
    if text.contains("reference to missing bytes") {
        return Fault::Truncated;
    }
    Fault::Damaged(plain(&text))
}

/// A decoder's message on one line.
fn plain(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn check_size(found: [usize; 2], expected: [u32; 2]) -> Result<(), Fault> {
    let expected = expected.map(|side| side as usize);
    if found == expected {
        return Ok(());
    }
    Err(Fault::Size { found, expected })
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
