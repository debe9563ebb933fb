//! Channels of a sensor, and their development.

use crate::color::spaces;
use crate::film::{Channels, Development};
use crate::shot::SensorColor;

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
