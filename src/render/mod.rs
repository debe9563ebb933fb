//! The renderer on one page: plan, trace, shade, film.

use crate::accel::Aggregate;
use crate::color::spaces;
use crate::film::{Channels, Development, Film};
use crate::plan::MotionError;
use crate::scene::Scene;
use crate::shot::{Effects, Layer, SensorColor, Shot, Splice};
use std::ops::Range;

mod band;
mod encode;
mod expose;
mod lab_path;
mod left_out;
mod meter;
mod paint;
mod prepared;
mod profile;
mod shifts;
mod together;
mod view;

pub use encode::{PictureInfo, Pictures, encode};
pub use lab_path::LabPath;
pub use left_out::{Enough, enough_bounces, left_out_warning};
pub(crate) use left_out::{deeper, least};
pub use meter::{Metered, metered_exposure, motion_mistake};
pub use prepared::{Exposing, Prepared};
pub use profile::{Profile, Seconds};
pub use shifts::refuse_shifted_numbers;
pub use together::{Member, Together, TogetherError, Watch, render_together};
pub use view::View;

/// Size and quality of an image, as given on the command line or by the shot.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Samples per pixel, at least 1.
    pub samples: u32,
    /// Layers besides the light.
    pub layers: Vec<Layer>,
}

/// Renders one image. `done` is told of finished rays, from any thread.
///
/// # Errors
/// Where a worldline has no velocity in this frame.
pub fn render(
    shot: &Shot,
    frame: u32,
    scene: &Scene,
    stage: &Aggregate,
    options: &Options,
    done: &(dyn Fn(u64) + Sync),
) -> Result<Film, MotionError> {
    let member = Member { shot, frame, scene };
    together::render_one(member, stage, options, done, None)
}

/// [`render`], with its seconds counted in `profile` if there is one, which takes a little longer.
///
/// # Errors
/// Where a worldline has no velocity in this frame.
pub fn render_profiled(
    shot: &Shot,
    frame: u32,
    scene: &Scene,
    stage: &Aggregate,
    options: &Options,
    done: &(dyn Fn(u64) + Sync),
    profile: Option<&Profile>,
) -> Result<Film, MotionError> {
    let member = Member { shot, frame, scene };
    together::render_one(member, stage, options, done, profile)
}

/// Memory of an image's film with its layers, in bytes.
pub fn film_bytes(options: &Options) -> u64 {
    const LAYERS: [Layer; 4] = [
        Layer::Doppler,
        Layer::Distance,
        Layer::EmissionTime,
        Layer::Worldline,
    ];
    let layers = LAYERS.iter().filter(|layer| options.layers.contains(layer));
    let pixel = size_of::<[f32; 3]>() + size_of::<f32>() * layers.count();
    u64::from(options.width) * u64::from(options.height) * pixel as u64
}

/// What the channels of a shot's films hold.
pub fn channels(shot: &Shot) -> Channels {
    match shot.sensor.color {
        SensorColor::Cie1931 => Channels::Xyz,
        SensorColor::Bands => Channels::Bands,
    }
}

/// How a shot's films are developed.
pub fn development(shot: &Shot, exposure_stops: f64) -> Development {
    const IDENTITY: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    Development {
        rgb_from_xyz: match channels(shot) {
            Channels::Xyz => spaces::RGB_FROM_XYZ,
            Channels::Bands => IDENTITY,
        },
        exposure_stops,
        encode: spaces::encode,
    }
}

/// Effects of a splice: the shot's, but for what it changes.
pub fn spliced(effects: &Effects, splice: &Splice) -> Effects {
    let over = &splice.effects;
    Effects {
        geometry: over.geometry.unwrap_or(effects.geometry),
        doppler: over.doppler.unwrap_or(effects.doppler),
        beaming: over.beaming.unwrap_or(effects.beaming),
        thermal: over.thermal.unwrap_or(effects.thermal),
        shadows: over.shadows.unwrap_or(effects.shadows),
        bounces: over.bounces.unwrap_or(effects.bounces),
    }
}

/// The rows that a splice covers: those whose centres lie in it.
pub fn rows(splice: &Splice, height: u32) -> Range<u32> {
    let row = |fraction: f64| (fraction * f64::from(height) - 0.5).ceil().max(0.0) as u32;
    row(splice.rows[0])..row(splice.rows[1]).min(height)
}
