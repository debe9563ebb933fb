//! What to study, its defaults, and the image that every setting starts from.

use super::timed_render::{Bodies, Variant};
use crate::frame::Frames;
use crate::render::Options;
use crate::shot::{Mistakes, Shot};
use crate::store;
use std::path::PathBuf;
use std::sync::Arc;

/// What to study.
#[derive(Debug, Clone)]
pub struct Request {
    /// Frame number, one of those of the shot.
    pub frame: u32,
    /// Size and samples of the image.
    pub options: Options,
    /// Number of renders of each setting, at least 1.
    pub repeats: u32,
    /// Scratch folder; its files are written only to time writing.
    pub scratch: PathBuf,
}

/// The image with the settings of the shot, from which every variant starts.
#[derive(Clone)]
pub(crate) struct Start<'a> {
    pub(super) shot: &'a Shot,
    pub(super) frame: u32,
    pub(super) options: Options,
    pub(super) bodies: Arc<Bodies>,
}

impl Start<'_> {
    /// A variant that does not differ yet.
    pub(super) fn variant(&self, setting: String, toml: Option<String>) -> Variant {
        Variant {
            setting,
            family: String::new(),
            toml,
            current: false,
            shot: self.shot.clone(),
            bodies: Arc::clone(&self.bodies),
            options: self.options.clone(),
        }
    }

    /// The shot unchanged.
    pub(super) fn as_it_is(&self) -> Variant {
        Variant {
            family: "as it is".to_owned(),
            current: true,
            ..self.variant("as it is".to_owned(), None)
        }
    }
}

/// Largest number of pixels of the image: one setting of most knobs then takes a second or less.
const PIXELS: f64 = 640.0 * 360.0;
/// Largest number of samples per pixel.
const SAMPLES: u32 = 4;

/// The last of the frames with the most effects.
///
/// # Errors
/// Mistakes of a frame.
pub fn default_frame(shot: &Shot) -> Result<u32, Mistakes> {
    let mut most = (0, 1);
    let mut all = Frames::new(shot);
    for number in 1..=shot.shot.frames {
        let frame = all.at(number)?;
        let active = frame.active_effects(&frame.effects);
        most = most.max((active.count(), number));
    }
    Ok(most.1)
}

/// Size and samples asked for, or such that a study does not take too long.
pub fn default_size(shot: &Shot, scale: Option<f64>, samples: Option<u32>) -> store::Request {
    let [width, height] = shot.image.size.map(f64::from);
    store::Request {
        scale: scale.unwrap_or_else(|| (PIXELS / (width * height)).sqrt().min(1.0)),
        samples: Some(samples.unwrap_or_else(|| shot.image.samples.min(SAMPLES))),
        ..store::Request::default()
    }
}
