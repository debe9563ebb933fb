//! Lamps, each at rest in a worldline.

use super::spectra::Spectra;
use crate::frame::{self, Amount};
use crate::model::{LUMENS_PER_WATT, Lamp, LampKind};
use crate::shot::{LightKind, LightUnits};
use crate::spectrum::luminous_integral;
use crate::spectrum::{Spectrum, SpectrumError};
use glam::{DAffine3, DVec3};
use std::f64::consts::PI;
use std::sync::Arc;

/// A lamp.
#[derive(Debug, Clone, PartialEq)]
pub struct Light {
    /// Name for messages.
    pub name: String,
    /// Index into the scene's worldlines.
    pub worldline: usize,
    /// Position and direction of the light, in the lamp's rest frame.
    pub shape: LightShape,
    /// Factor: scale × spectrum is the spectral intensity, W·sr⁻¹·nm⁻¹ (sun: irradiance,
    /// W·m⁻²·nm⁻¹), in the lamp's rest frame.
    pub scale: f64,
    /// Shape of the spectrum.
    pub spectrum: Arc<Spectrum>,
}

/// Origin of a lamp's light. Positions are in meters, directions are unit vectors of travel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LightShape {
    /// The same intensity in all directions.
    Point {
        /// Position.
        position: DVec3,
    },
    /// Full intensity within the inner cone, none outside the outer, as glTF blends them.
    Spot {
        /// Position.
        position: DVec3,
        /// Axis of the cone.
        direction: DVec3,
        /// Cosine of the inner half-angle.
        cos_inner: f64,
        /// Cosine of the outer half-angle, not above `cos_inner`.
        cos_outer: f64,
    },
    /// Parallel light from infinity.
    Sun {
        /// Direction of travel.
        direction: DVec3,
    },
}

impl LightShape {
    /// Share of the full intensity along the unit direction `n`: clamp((cos θ − cos outer)/(cos
    /// inner − cos outer))² (KHR_lights_punctual), a step if both cones are equal.
    pub fn share(&self, n: DVec3) -> f64 {
        match *self {
            Self::Spot {
                direction,
                cos_inner,
                cos_outer,
                ..
            } => {
                let cos = direction.dot(n);
                if cos >= cos_inner {
                    1.0
                } else if cos <= cos_outer {
                    0.0
                } else {
                    ((cos - cos_outer) / (cos_inner - cos_outer)).powi(2)
                }
            }
            Self::Point { .. } | Self::Sun { .. } => 1.0,
        }
    }
}

/// Reason why a lamp cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub(super) enum LightError {
    /// Its intensity is in candela or lux, but it emits no visible light.
    #[error("its spectrum has no visible power, so no candela or lux of it can be had")]
    Dark,
    /// A number of a file, in candela or lux, is too large.
    #[error("its intensity of {found:e} is beyond all numbers in cd or lx: write a smaller one")]
    TooStrong {
        /// The number in the file.
        found: f64,
    },
    /// Its spectrum is invalid.
    #[error(transparent)]
    Spectrum(#[from] SpectrumError),
}

impl Light {
    /// A lamp of the shot.
    pub(super) fn authored(
        light: &frame::Light<'_>,
        spectra: &Spectra<'_>,
    ) -> Result<Self, LightError> {
        let spectrum = spectra.curve(light.spectrum)?;
        let scale = match light.amount {
            Amount::Spectral(scale) => scale,
            Amount::Photometric(intensity) => {
                let lumens = luminous_integral(&spectrum);
                if !(lumens > 0.0 && (intensity / lumens).is_finite()) {
                    return Err(LightError::Dark);
                }
                intensity / lumens
            }
        };
        Ok(Self {
            name: light.name.to_string(),
            worldline: light.worldline,
            shape: shape(light),
            scale,
            spectrum,
        })
    }

    /// A lamp of a model file whose numbers are in `units`, placed by `rest_from_model`.
    pub(super) fn imported(
        lamp: &Lamp,
        units: LightUnits,
        worldline: usize,
        rest_from_model: &DAffine3,
    ) -> Result<Self, LightError> {
        let rest_from_lamp = *rest_from_model * lamp.world;
        let position = rest_from_lamp.translation;
        let direction = rest_from_lamp
            .transform_vector3(DVec3::NEG_Z)
            .normalize_or(DVec3::NEG_Z);
        let shape = match lamp.kind {
            LampKind::Point => LightShape::Point { position },
            LampKind::Sun => LightShape::Sun { direction },
            LampKind::Spot { inner, outer } => LightShape::Spot {
                position,
                direction,
                cos_inner: inner.cos(),
                cos_outer: outer.cos(),
            },
        };
        let (curve, scale) = Spectra::light(lamp.color, lamp.intensity * unit(units, lamp.kind))?;
        if !scale.is_finite() {
            let found = lamp.intensity;
            return Err(LightError::TooStrong { found });
        }
        Ok(Self {
            name: lamp.name.clone(),
            worldline,
            shape,
            scale,
            spectrum: Arc::new(Spectrum::Tinted(curve)),
        })
    }

    /// The same lamp, displaced.
    pub(super) fn displaced(&self, by: DVec3) -> Self {
        let mut moved = self.clone();
        match &mut moved.shape {
            LightShape::Point { position } | LightShape::Spot { position, .. } => *position += by,
            LightShape::Sun { .. } => {}
        }
        moved
    }
}

/// Candela or lux per unit of a file's lamps: Blender distributes the watts of a point or spot lamp
/// over the whole sphere.
fn unit(units: LightUnits, kind: LampKind) -> f64 {
    match (units, kind) {
        (LightUnits::Standard, _) => 1.0,
        (LightUnits::Unitless, _) | (LightUnits::Raw, LampKind::Sun) => LUMENS_PER_WATT,
        (LightUnits::Raw, LampKind::Point | LampKind::Spot { .. }) => LUMENS_PER_WATT / (4.0 * PI),
    }
}

fn shape(light: &frame::Light<'_>) -> LightShape {
    let cos = |degrees: f64| degrees.to_radians().cos();
    let position = light.position;
    let direction = light.direction.normalize_or(DVec3::NEG_Z);
    match light.kind {
        LightKind::Point => LightShape::Point { position },
        LightKind::Sun => LightShape::Sun { direction },
        LightKind::Spot => LightShape::Spot {
            position,
            direction,
            cos_inner: cos(light.inner_deg),
            cos_outer: cos(light.outer_deg),
        },
    }
}
