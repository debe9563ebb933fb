//! Decoding of sky images: Radiance HDR, OpenEXR, PNG, recognized by their first bytes.
//!
//! HDR and EXR hold linear light, of Rec. 709 unless they state other primaries. PNG is taken as
//! sRGB, of 8 or 16 bits, also gray or with a palette. Alpha is ignored.

use super::file::{LARGEST_FILE, Pixels, SkyImageError, check_size};
use super::image::{MOST_PIXELS, SkyImage, make_finite};
use super::primaries::Primaries;
use super::{SkyWarning, openexr, radiance};
use crate::color::spaces::decode;
use image::codecs::png::PngDecoder;
use image::{DynamicImage, ImageDecoder, Limits};
use std::io::{Cursor, Read};
use std::path::Path;

impl Pixels {
    fn into_sky(mut self) -> SkyImage {
        // Conversion mixes the components of a texel, so an infinite one would affect the others.
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

    /// Decodes the bytes of a file. The size is checked before pixels are read.
    ///
    /// # Errors
    /// The fault of the file.
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

/// An image of integers in sRGB.
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
