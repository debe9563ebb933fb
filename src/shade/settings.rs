//! What a shader is made for, beside the scene.

use crate::frame::{self, ActiveEffects};
use crate::shot::{Accuracy, SensorColor};
use crate::spectrum::{LogAxis, Quadrature, Sensor};

/// What a [`Shader`](super::Shader) is made for, beside the scene.
pub struct Settings<'a> {
    /// Effects of the image.
    pub effects: &'a ActiveEffects,
    /// How spectra are held.
    pub accuracy: &'a Accuracy,
    /// The band that is seen, and how.
    pub sensor: &'a frame::Sensor,
    /// Largest |ln D| between a surface and the camera.
    pub reach: f64,
    /// Largest |ln D| between a lamp and a surface.
    pub lamp_reach: f64,
}

impl Settings<'_> {
    /// The wavelengths of the sensor.
    pub(super) fn axis(&self) -> LogAxis {
        LogAxis::new(self.sensor.window, self.accuracy.wavelengths as usize)
    }

    /// The sensor over its wavelengths.
    pub(super) fn sensor(&self) -> Sensor {
        match self.sensor.color {
            SensorColor::Cie1931 => Sensor::cie1931(self.axis()),
            SensorColor::Bands => Sensor::bands(self.axis()),
        }
    }

    /// The integrals over wavelength that the sensor's sums stand for.
    pub(super) fn quadrature(&self) -> Quadrature {
        match self.sensor.color {
            SensorColor::Cie1931 => Quadrature::cie1931(self.sensor.window),
            SensorColor::Bands => Quadrature::bands(self.sensor.window),
        }
    }
}
