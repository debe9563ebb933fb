//! Settings of one frame that place nothing in the scene: the sensor, and rows with effects of their
//! own.

use crate::shot::{self, Effects, Gamut, SensorColor, Shot, Tone};
use std::ops::Range;

/// Size and samples of a shot's images as they are asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Resolution {
    /// Pixels in a row, and rows.
    pub size: [u32; 2],
    /// Samples a pixel.
    pub samples: u32,
}

/// From spectral radiance to pixel values, exposure aside.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sensor {
    /// Shortest and longest wavelength seen, nm.
    pub window: [f64; 2],
    /// How wavelengths become color.
    pub color: SensorColor,
    /// What becomes of values above 1.
    pub tone: Tone,
    /// What becomes of colors that no screen shows.
    pub gamut: Gamut,
}

impl Sensor {
    /// The sensor of a shot.
    pub fn new(sensor: &shot::Sensor) -> Self {
        let shot::Sensor {
            window,
            color,
            exposure: _,
            tone,
            gamut,
        } = sensor;
        Self {
            window: *window,
            color: *color,
            tone: *tone,
            gamut: *gamut,
        }
    }
}

impl Default for Sensor {
    fn default() -> Self {
        Self::new(&shot::Sensor::default())
    }
}

/// Rows of the image that are rendered with effects of their own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Splice {
    /// First and last row as fractions of the height from the top.
    pub rows: [f64; 2],
    /// The shot's effects, but for what the splice changes.
    pub effects: Effects,
}

impl Splice {
    /// The splices of a shot.
    pub fn all(shot: &Shot) -> Vec<Self> {
        let splices = shot.splice.iter();
        splices.map(|s| Self::new(s, &shot.effects)).collect()
    }

    /// A splice over the shot's effects.
    pub fn new(splice: &shot::Splice, effects: &Effects) -> Self {
        let shot::Splice { rows, effects: own } = splice;
        let shot::SpliceEffects {
            geometry,
            doppler,
            beaming,
            thermal,
            shadows,
            bounces,
        } = *own;
        Self {
            rows: *rows,
            effects: Effects {
                geometry: geometry.unwrap_or(effects.geometry),
                doppler: doppler.unwrap_or(effects.doppler),
                beaming: beaming.unwrap_or(effects.beaming),
                thermal: thermal.unwrap_or(effects.thermal),
                shadows: shadows.unwrap_or(effects.shadows),
                bounces: bounces.unwrap_or(effects.bounces),
            },
        }
    }

    /// The rows that it covers of an image of so many: those whose centers lie in it.
    pub fn rows_of(&self, height: u32) -> Range<u32> {
        let row = |fraction: f64| (fraction * f64::from(height) - 0.5).ceil().max(0.0) as u32;
        row(self.rows[0])..row(self.rows[1]).min(height)
    }
}

/// Width to height in lowest terms: all that a camera reads of an image's size.
pub(super) fn aspect([width, height]: [u32; 2]) -> [u32; 2] {
    let (mut a, mut b) = (width, height);
    while b != 0 {
        (a, b) = (b, a % b);
    }
    [width / a.max(1), height / a.max(1)]
}
