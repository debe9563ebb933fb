//! The renderer on one page: plan, trace, shade, film.

use crate::accel::Aggregate;
use crate::color::spaces;
use crate::film::{Channels, Development, Film};
use crate::frame::Frame;
use crate::scene::Scene;
use crate::shot::{Layer, SensorColor};

mod band;
mod encode;
mod expose;
mod lab_path;
mod left_out;
mod meter;
mod paint;
mod prepared;
mod profile;
mod together;
mod view;

pub use encode::{InsetTooSmall, PictureInfo, Pictures, encode};
pub use expose::Stopped;
pub use lab_path::LabPath;
pub use left_out::{Enough, enough_bounces, left_out_warning};
pub(crate) use left_out::{deeper, least};
pub use meter::{Metered, metered_exposure};
pub use prepared::{Exposing, Prepared};
pub use profile::{Profile, Seconds};
pub use together::{Member, Together, Watch, render_together};
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
pub fn render(
    frame: &Frame<'_>,
    scene: &Scene,
    stage: &Aggregate,
    options: &Options,
    done: &(dyn Fn(u64) + Sync),
) -> Film {
    let member = Member { frame, scene };
    together::render_one(member, stage, options, done, None)
}

/// [`render`], with its seconds counted in `profile` if there is one, which takes a little longer.
pub fn render_profiled(
    frame: &Frame<'_>,
    scene: &Scene,
    stage: &Aggregate,
    options: &Options,
    done: &(dyn Fn(u64) + Sync),
    profile: Option<&Profile>,
) -> Film {
    let member = Member { frame, scene };
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

/// What the channels of a sensor's films hold.
pub fn channels(color: SensorColor) -> Channels {
    match color {
        SensorColor::Cie1931 => Channels::Xyz,
        SensorColor::Bands => Channels::Bands,
    }
}

/// How a sensor's films are developed.
pub fn development(color: SensorColor, exposure_stops: f64) -> Development {
    const IDENTITY: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    Development {
        rgb_from_xyz: match channels(color) {
            Channels::Xyz => spaces::RGB_FROM_XYZ,
            Channels::Bands => IDENTITY,
        },
        exposure_stops,
        encode: spaces::encode,
    }
}
