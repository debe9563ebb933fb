//! Defaults of a study: the frame with the most effects, in a size at which most settings take a second
//! or less.

use crate::frame::Frames;
use crate::shot::{Mistakes, Shot};
use crate::store::Request;

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
pub fn default_size(shot: &Shot, scale: Option<f64>, samples: Option<u32>) -> Request {
    let [width, height] = shot.image.size.map(f64::from);
    Request {
        scale: scale.unwrap_or_else(|| (PIXELS / (width * height)).sqrt().min(1.0)),
        samples: Some(samples.unwrap_or_else(|| shot.image.samples.min(SAMPLES))),
        ..Request::default()
    }
}
