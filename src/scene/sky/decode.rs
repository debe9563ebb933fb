//! Files of sky images: Radiance HDR, OpenEXR, PNG, known by their first bytes.
//!
//! HDR and EXR hold linear light, of Rec. 709 where they do not say of what else. PNG is taken as
//! sRGB, of 8 or 16 bits, grey or palette too. Alpha is left out.

use super::image::{MOST_PIXELS, MOST_SIDES, SkyImage, make_finite};
use super::primaries::Primaries;
use super::{SkyWarning, openexr, radiance};
use crate::color::spaces::decode;
use image::codecs::png::PngDecoder;
use image::{DynamicImage, ImageDecoder, Limits};
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
    Broken(String),
    /// A line of a Radiance file's header.
    #[error("the image's header says `{line}`: expected {expected}")]
    Header {
        /// The line.
        line: String,
        /// What should stand in it.
        expected: &'static str,
    },
    /// An OpenEXR file without colors.
    #[error("the image has no channels R, G and B, nor Y, but {0}")]
    NoPicture(String),
    /// An OpenEXR file with more pictures than one.
    #[error("the image has several layers of colors, of which any could be the sky: {0}")]
    Layers(String),
    /// An OpenEXR file of luminance and chroma.
    #[error(
        "the image's colors are luminance and chroma, or have fewer pixels in some channels (of {0}): that is not read"
    )]
    Subsampled(String),
    /// Too many pixels, or none.
    #[error(
        "the image says it has {width} x {height} pixels: expected at least 1 x 1, at most {} x {} and {MOST_PIXELS} in all",
        MOST_SIDES[0], MOST_SIDES[1]
    )]
    Size {
        /// Columns.
        width: u64,
        /// Rows.
        height: u64,
    },
    /// An OpenEXR file that has too many pixels beyond its display window.
    #[error(
        "the image's data window is of {width} x {height} pixels: expected at most {} x {} and {MOST_PIXELS} in all",
        MOST_SIDES[0], MOST_SIDES[1]
    )]
    DataWindow {
        /// Columns.
        width: u64,
        /// Rows.
        height: u64,
    },
    /// Memory is short.
    #[error("the image needs {0} bytes of memory, more than there are: make it smaller")]
    Memory(u64),
}

impl SkyImageError {
    /// What a decoder refuses.
    pub(super) fn broken(error: impl ToString) -> Self {
        Self::Broken(error.to_string())
    }

    /// What to do about it.
    pub fn remedy(&self) -> &'static str {
        match self {
            Self::Read(_) => "see that the file may be read",
            Self::Empty | Self::Format => "name a panorama as Radiance HDR, OpenEXR or PNG",
            Self::LongFile | Self::Size { .. } | Self::Memory(_) => {
                "save the panorama with fewer pixels"
            }
            Self::DataWindow { .. } => "save it cropped to its display window",
            Self::Broken(_) => "copy the file again, or save it as a flat OpenEXR of R, G and B",
            Self::Header { .. } => "save the file again, or mend that line in it",
            Self::NoPicture(_) | Self::Layers(_) => {
                "save the picture alone, as R, G and B (in Blender \"OpenEXR\", not \"OpenEXR MultiLayer\")"
            }
            Self::Subsampled(_) => "save it as R, G and B",
        }
    }
}

/// What a file holds.
pub(super) struct Pixels {
    pub(super) width: usize,
    /// By rows from the top.
    pub(super) texels: Vec<[f32; 3]>,
    /// What the colors are; None where the file does not say.
    pub(super) primaries: Option<Primaries>,
    pub(super) warnings: Vec<SkyWarning>,
}

impl Pixels {
    fn into_sky(mut self) -> SkyImage {
        // Conversion mixes the components of a texel: one that is infinite would spoil the others.
        let mut strange = 0;
        let convert = |primaries: Primaries| {
            strange = make_finite(&mut self.texels);
            primaries.convert(&mut self.texels)
        };
        let converted = self.primaries.and_then(convert);
        let size = [self.width, self.texels.len() / self.width];
        let stretched = (size[0] != 2 * size[1]).then_some(SkyWarning::Shape { size });
        SkyImage::with_strange(self.width, self.texels, strange)
            .with_warnings(self.warnings.into_iter().chain(converted).chain(stretched))
    }
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
        let pixels = match bytes {
            [] => Err(SkyImageError::Empty),
            [0x89, b'P', b'N', b'G', ..] => png(bytes),
            [0x76, 0x2f, 0x31, 0x01, ..] => openexr::decode(bytes),
            [b'#', b'?', ..] => radiance::decode(bytes),
            _ => Err(SkyImageError::Format),
        };
        pixels.map(Pixels::into_sky)
    }
}

/// That a picture may have so many columns and rows, and that there is memory for as many bytes a
/// pixel: refused here with a message, rather than by the system when pixels are unpacked.
pub(super) fn check_size([width, height]: [u64; 2], bytes: u64) -> Result<(), SkyImageError> {
    let [most_columns, most_rows] = MOST_SIDES.map(u64::from);
    let sides = (1..=most_columns).contains(&width) && (1..=most_rows).contains(&height);
    if !(sides && width * height <= MOST_PIXELS) {
        return Err(SkyImageError::Size { width, height });
    }
    check_memory(width * height * bytes)
}

/// That there is memory for so many bytes.
pub(super) fn check_memory(bytes: u64) -> Result<(), SkyImageError> {
    Vec::<u8>::new()
        .try_reserve_exact(bytes as usize)
        .map_err(|_| SkyImageError::Memory(bytes))
}

/// An image of whole numbers in sRGB.
fn png(bytes: &[u8]) -> Result<Pixels, SkyImageError> {
    let mut limits = Limits::default();
    limits.max_alloc = Some(8 * MOST_PIXELS);
    let decoder = PngDecoder::with_limits(Cursor::new(bytes), limits);
    let decoder = decoder.map_err(SkyImageError::broken)?;
    let (width, height) = decoder.dimensions();
    let pixel = u64::from(decoder.color_type().bytes_per_pixel());
    check_size([width, height].map(u64::from), 12 + pixel)?;
    let deep = decoder.color_type().bytes_per_pixel() > decoder.color_type().channel_count();
    let image = DynamicImage::from_decoder(decoder).map_err(SkyImageError::broken)?;
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
    Ok(Pixels {
        width: width as usize,
        texels,
        primaries: None,
        warnings: Vec::new(),
    })
}
