//! Files of sky images: Radiance HDR, OpenEXR, PNG, known by their first bytes.
//!
//! HDR and EXR hold linear Rec. 709 light; an EXR's chromaticities and an HDR's EXPOSURE line are
//! not looked at. PNG is taken as sRGB, of 8 or 16 bits, grey or palette too. Alpha is left out.

use super::image::{MOST_PIXELS, MOST_SIDES, SkyImage};
use crate::spectrum::color_space::decode;
use image::codecs::hdr::HdrDecoder;
use image::codecs::openexr::OpenExrDecoder;
use image::codecs::png::PngDecoder;
use image::{DynamicImage, ImageDecoder, ImageError, Limits};
use std::io::{Cursor, Read};
use std::path::Path;

/// Longest file, bytes.
const LARGEST_FILE: u64 = 2 << 30;

/// Why a file is no sky.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SkyImageError {
    /// It could not be read.
    #[error("the image cannot be read: {0}")]
    Read(#[from] std::io::Error),
    /// More bytes than are read.
    #[error("the image is a file of more than {LARGEST_FILE} bytes: make it smaller")]
    LongFile,
    /// Nothing is in it.
    #[error("the image is an empty file")]
    Empty,
    /// It does not begin as any format that is read.
    #[error(
        "the image is in no format that is read: expected Radiance HDR (#?RADIANCE), OpenEXR or PNG"
    )]
    Format,
    /// The decoder refused.
    #[error("the image is broken, or not read in this form: {0}")]
    Broken(#[from] ImageError),
    /// Too many pixels, or none.
    #[error(
        "the image says it has {width} x {height} pixels: expected at least 1 x 1, at most {} x {} and {MOST_PIXELS} in all",
        MOST_SIDES[0], MOST_SIDES[1]
    )]
    Size {
        /// Columns.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// Memory is short.
    #[error("the image needs {0} bytes of memory, more than there are: make it smaller")]
    Memory(u64),
}

impl SkyImage {
    /// Reads a file.
    pub(in crate::scene) fn read(path: &Path) -> Result<Self, SkyImageError> {
        let mut bytes = Vec::new();
        std::fs::File::open(path)?
            .take(LARGEST_FILE + 1)
            .read_to_end(&mut bytes)?;
        if bytes.len() as u64 > LARGEST_FILE {
            return Err(SkyImageError::LongFile);
        }
        Self::decode(&bytes)
    }

    /// An image from the bytes of a file. Its size is looked at before its pixels.
    ///
    /// # Errors
    /// What is wrong with the file.
    pub fn decode(bytes: &[u8]) -> Result<Self, SkyImageError> {
        let file = Cursor::new(bytes);
        match bytes {
            [] => Err(SkyImageError::Empty),
            [0x89, b'P', b'N', b'G', ..] => {
                let mut limits = Limits::default();
                limits.max_alloc = Some(8 * MOST_PIXELS);
                encoded(PngDecoder::with_limits(file, limits)?)
            }
            [0x76, 0x2f, 0x31, 0x01, ..] => {
                linear(OpenExrDecoder::with_alpha_preference(file, Some(false))?)
            }
            [b'#', b'?', ..] => linear(HdrDecoder::new(file)?),
            _ => Err(SkyImageError::Format),
        }
    }
}

/// Columns and rows, if they can be had.
fn size(decoder: &impl ImageDecoder) -> Result<[usize; 2], SkyImageError> {
    let (width, height) = decoder.dimensions();
    let sides = 1..=MOST_SIDES[0];
    let rows = 1..=MOST_SIDES[1];
    let pixels = u64::from(width) * u64::from(height);
    if !(sides.contains(&width) && rows.contains(&height) && pixels <= MOST_PIXELS) {
        return Err(SkyImageError::Size { width, height });
    }
    // Refused here with a message, rather than by the system when pixels are unpacked.
    let bytes = decoder.total_bytes() + 12 * pixels;
    Vec::<u8>::new()
        .try_reserve_exact(bytes as usize)
        .map_err(|_| SkyImageError::Memory(bytes))?;
    Ok([width as usize, height as usize])
}

/// An image of three f32.
fn linear(decoder: impl ImageDecoder) -> Result<SkyImage, SkyImageError> {
    let [width, _] = size(&decoder)?;
    // Not touched before the decoder writes to it, so that a short file with a long header is
    // refused at once.
    let mut bytes = vec![0; decoder.total_bytes() as usize];
    decoder.read_image(&mut bytes)?;
    let (texels, _) = bytes.as_chunks::<12>();
    let texel = |bytes: &[u8; 12]| {
        let (parts, _) = bytes.as_chunks::<4>();
        [parts[0], parts[1], parts[2]].map(f32::from_ne_bytes)
    };
    Ok(SkyImage::new(width, texels.iter().map(texel).collect()))
}

/// An image of whole numbers in sRGB.
fn encoded(decoder: impl ImageDecoder) -> Result<SkyImage, SkyImageError> {
    let [width, _] = size(&decoder)?;
    let deep = decoder.color_type().bytes_per_pixel() > decoder.color_type().channel_count();
    let image = DynamicImage::from_decoder(decoder)?;
    let light = |codes: u32| -> Vec<f32> {
        let part = |code| f64::from(code) / f64::from(codes);
        (0..=codes).map(|code| decode(part(code)) as f32).collect()
    };
    let texels = if deep {
        let light = light(65535);
        let image = image.into_rgb16();
        let texel = |pixel: &image::Rgb<u16>| pixel.0.map(|code| light[usize::from(code)]);
        image.pixels().map(texel).collect()
    } else {
        let light = light(255);
        let image = image.into_rgb8();
        let texel = |pixel: &image::Rgb<u8>| pixel.0.map(|code| light[usize::from(code)]);
        image.pixels().map(texel).collect()
    };
    Ok(SkyImage::new(width, texels))
}
