//! Size and quality of an image, and what follows from the sensor: channels and development of films.

use crate::color::spaces;
use crate::film::{Channels, Development};
use crate::shot::{Layer, SensorColor};

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

/// The channels of a sensor's films.
pub fn channels(color: SensorColor) -> Channels {
    match color {
        SensorColor::Cie1931 => Channels::Xyz,
        SensorColor::Bands => Channels::Bands,
    }
}

/// Parameters for developing a sensor's films.
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
