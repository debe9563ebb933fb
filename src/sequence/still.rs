//! A finished frame as pixels.

use crate::image::decode::{self, Decoded, Fault};
use crate::queue::Reel;
use crate::render::development;
use crate::shot::{Format, Shot};
use std::path::PathBuf;

/// A picture of 8 bits a channel, sRGB, as the PNG has it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Still {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Three bytes a pixel, row by row from the top.
    pub rgb8: Vec<u8>,
}

/// A frame that cannot be shown.
#[derive(Debug, thiserror::Error)]
#[error("frame {frame}: {}: {why}", file.display())]
pub struct StillError {
    /// Its number.
    pub frame: u32,
    /// The file.
    pub file: PathBuf,
    /// What is wrong with it.
    pub why: String,
}

/// Reads a frame from its PNG; where none is written from its EXR, by the same transfer that a PNG
/// has. It must have the size that the reel asks for.
///
/// # Errors
/// A file that is missing, broken or of another size.
pub fn read(reel: &Reel, frame: u32) -> Result<Still, StillError> {
    let extension = shown_extension(reel.shot());
    let file = reel.folder.join(reel.names.frame(frame, extension));
    let size = reel.keys.resolution().size;
    let decoded = decode::read_bytes(&file, size)
        .and_then(|bytes| decode_as(reel.shot(), extension, &bytes, size));
    match decoded {
        Ok(Decoded { rgb8, .. }) => Ok(Still {
            width: size[0],
            height: size[1],
            rgb8,
        }),
        Err(fault) => Err(StillError {
            frame,
            file,
            why: fault.to_string(),
        }),
    }
}

/// The extension of the files that frames are shown from.
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
        // An EXR holds exposed light: of the development the transfer is left to do.
        "exr" => decode::exr(bytes, size, development(shot.sensor.color, 0.0).encode),
        _ => decode::png(bytes, size),
    }
}
