//! Which images of a shot are asked for, and their folder.

use crate::render::Options;
use crate::shot::{Format, LARGEST_SIDE, Shot};
use std::path::PathBuf;

/// Size and sampling asked for in place of the shot's, and the folder of the pictures.
///
/// # Example
/// ```
/// use restframe::store::Request;
/// let half = Request { scale: 0.5, ..Request::default() };
/// assert_eq!(half.out.to_str(), Some("renders"));
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Request {
    /// Folder of the shots' folders. Default: `renders`.
    pub out: PathBuf,
    /// Factor on the image's size, above 0. Default: 1.
    pub scale: f64,
    /// Samples per pixel in place of the shot's. Default: the shot's.
    pub samples: Option<u32>,
}

impl Default for Request {
    fn default() -> Self {
        Self {
            out: PathBuf::from("renders"),
            scale: 1.0,
            samples: None,
        }
    }
}

impl Request {
    /// Size, samples and layers of a shot's images.
    pub fn options(&self, shot: &Shot) -> Options {
        let side = |pixels: u32| {
            (f64::from(pixels) * self.scale)
                .round()
                .clamp(1.0, f64::from(LARGEST_SIDE)) as u32
        };
        let [width, height] = shot.image.size.map(side);
        let exr = shot.output.formats.contains(&Format::Exr);
        Options {
            width,
            height,
            samples: self.samples.unwrap_or(shot.image.samples),
            layers: if exr {
                shot.output.layers.clone()
            } else {
                Vec::new()
            },
        }
    }

    /// Refuses a scale that makes an image of the shot larger than allowed.
    ///
    /// # Errors
    /// The size, the shot and the limit.
    pub fn check(&self, shot: &Shot) -> Result<(), String> {
        let [width, height] = shot.image.size.map(|side| f64::from(side) * self.scale);
        if width.max(height).round() <= f64::from(LARGEST_SIDE) {
            return Ok(());
        }
        Err(format!(
            "--scale {} makes {width:.0} x {height:.0} pixels of {}; a side has at most {LARGEST_SIDE}",
            self.scale,
            shot.path.display()
        ))
    }
}
