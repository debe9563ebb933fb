//! Lamps. All values are in the rest frame of the lamp's worldline: meters, candelas, lux, degrees.

use super::{SpectrumValue, Track};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// `[[light]]`: a lamp. Its spectrum gives the shape of its light, `intensity` or `scale` the amount.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Light {
    /// What kind of lamp it is.
    pub kind: LightKind,
    /// Name in messages. Default: its number.
    pub name: Option<String>,
    /// Worldline that it rides on. Default: "lab".
    pub worldline: Option<String>,
    /// Position in its rest frame, m. Needed by point and spot.
    pub position: Option<Track<[f64; 3]>>,
    /// Direction of travel of its light in its rest frame, of any length but zero. Needed by spot and sun.
    pub direction: Option<Track<[f64; 3]>>,
    /// Half-angle of a spot's fully lit cone, degrees, from 0 to `outer`. Default: 0.
    #[schemars(extend("minimum" = 0, "maximum" = 90))]
    pub inner: Option<Track<f64>>,
    /// Half-angle beyond which a spot is dark, degrees, above 0 and at most 90. Default: 45.
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 90))]
    pub outer: Option<Track<f64>>,
    /// Luminous intensity, cd (point, spot), or illuminance, lx (sun), at least 0. This or `scale`.
    #[schemars(extend("minimum" = 0))]
    pub intensity: Option<Track<f64>>,
    /// In place of `intensity`: scale × spectrum is W·sr⁻¹·nm⁻¹ (sun: W·m⁻²·nm⁻¹), at least 0.
    #[schemars(extend("minimum" = 0))]
    pub scale: Option<Track<f64>>,
    /// Shape of its spectrum. Default: the illuminant "D65".
    #[schemars(extend("minimum" = 0))]
    pub spectrum: Option<SpectrumValue>,
}

/// A kind of lamp.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum LightKind {
    /// From one point into all directions.
    Point,
    /// From one point into a cone.
    Spot,
    /// From infinity along one direction.
    Sun,
}
