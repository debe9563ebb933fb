//! Metering: exposure from a small render of frame 1.

use super::{Options, render};
use crate::accel::Aggregate;
use crate::film::auto_exposure;
use crate::frame::Frame;
use crate::scene::{Library, Scene};
use crate::shot::{LARGEST_SIDE, Mistakes, Shot};
use crate::trace::build_aggregate;

/// Result of metering, with the scene of frame 1, so that rendering it need not repeat the work.
pub struct Metered {
    /// Exposure in stops; None if the image is black.
    pub stops: Option<f64>,
    /// The scene of frame 1.
    pub scene: Scene,
    /// Its bodies.
    pub aggregate: Aggregate,
}

/// Exposure metered on a small render of frame 1, whatever frames are asked for.
///
/// # Errors
/// Mistakes of frame 1.
pub fn metered_exposure(shot: &Shot, library: &Library) -> Result<Metered, Mistakes> {
    let frame = Frame::new(shot, 1)?;
    let scene = Scene::resolve(&frame, library, None)?;
    let aggregate = build_aggregate(&scene.geometry, None);
    let [width, height] = frame.image.size.map(f64::from);
    let rows = (METER_WIDTH * height / width)
        .round()
        .clamp(1.0, LARGEST_SIDE.into());
    let options = Options {
        width: METER_WIDTH as u32,
        height: rows as u32,
        samples: 1,
        layers: Vec::new(),
    };
    let film = render(&frame, &scene, &aggregate, &options, &|_| ());
    Ok(Metered {
        stops: auto_exposure(&film),
        scene,
        aggregate,
    })
}

/// Width of the render for metering, pixels.
const METER_WIDTH: f64 = 160.0;
