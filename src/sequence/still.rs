//! A finished frame as pixels.

use crate::queue::Reel;
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

/// Reads a frame from its PNG.
///
/// # Errors
/// A file that is missing or no picture.
pub fn read(reel: &Reel, frame: u32) -> Result<Still, StillError> {
    let file = reel.folder.join(reel.names.frame(frame, "png"));
    let image = image::open(&file).map_err(|error| StillError {
        frame,
        file,
        why: error.to_string(),
    })?;
    let rgb = image.into_rgb8();
    Ok(Still {
        width: rgb.width(),
        height: rgb.height(),
        rgb8: rgb.into_raw(),
    })
}
