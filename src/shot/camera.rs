//! The camera as its author placed it. Metres and degrees in its worldline's rest frame; yaw 0
//! looks along −z with +y up.

use super::Track;
use schemars::JsonSchema;
use serde::Deserialize;

/// `[camera]`: where it is, where it looks, how wide.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Camera {
    /// Worldline that it rides on. Default: "lab".
    pub worldline: Option<String>,
    /// Position in its worldline's rest frame, m. Default: [0, 0, 0].
    pub position: Option<Track<[f64; 3]>>,
    /// Point that it looks at, in its rest frame, m; in place of `yaw` and `pitch`.
    pub look_at: Option<Track<[f64; 3]>>,
    /// Turn about y from −z, degrees, positive to the right. Default: 0.
    pub yaw: Option<Track<f64>>,
    /// Turn upwards, degrees. Default: 0.
    pub pitch: Option<Track<f64>>,
    /// Turn about the line of sight, degrees. Default: 0.
    pub roll: Option<Track<f64>>,
    /// Yaw added to where it looks, degrees, positive to the right. Default: 0.
    pub pan: Option<Track<f64>>,
    /// Pitch added to where it looks, degrees, positive upwards. Default: 0.
    pub tilt: Option<Track<f64>>,
    /// Horizontal field of view, degrees, above 0 and below 180; this or `vfov`. Default: 90.
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 180))]
    pub hfov: Option<Track<f64>>,
    /// Vertical field of view, degrees, above 0 and below 180; in place of `hfov`.
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 180))]
    pub vfov: Option<Track<f64>>,
    /// How directions become pixels. Default: "perspective".
    pub projection: Option<Projection>,
}

/// How directions become pixels.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Projection {
    /// Straight lines stay straight.
    Perspective,
}
