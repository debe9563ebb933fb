//! The camera: placement in the rest frame of its worldline, field of view, projection. Meters and
//! degrees; yaw 0 looks along −z with +y up.

use super::Track;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// `[camera]`: its position, direction and field of view.
#[derive(Debug, Clone, Default, Serialize, Deserialize, JsonSchema)]
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
    /// Horizontal field of view, degrees; this or `vfov`, the other angle follows from square
    /// pixels. Perspective: above 0 and below 180, default 90. Equirectangular: up to 360. Fisheye:
    /// the circle's angle where it spans the width, up to 360.
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 360))]
    pub hfov: Option<Track<f64>>,
    /// Vertical field of view, degrees, in place of `hfov`. Perspective: above 0 and below 180.
    /// Equirectangular: up to 180. Fisheye: the circle's angle where it spans the height, up to 360.
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 360))]
    pub vfov: Option<Track<f64>>,
    /// How directions, in the camera's rest frame, become pixels. Default: "perspective".
    pub projection: Option<Projection>,
}

/// How directions become pixels.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Projection {
    /// Straight lines stay straight.
    #[default]
    Perspective,
    /// A panorama: columns are yaw from where the camera looks, positive to the right, rows are
    /// pitch, upwards positive. Without `hfov` and `vfov` the whole sphere fills the image, 360° by
    /// 180° whatever its shape; with one of them, that angle spans the width or height and the
    /// other follows from square pixels, up to what the sphere has.
    Equirectangular,
    /// A dome (equidistant): the angle from where the camera looks grows in proportion to the
    /// distance from the center. Without `hfov` and `vfov` a circle of 180° spans the shorter side.
    /// Outside of the circle nothing is seen: it is black, and layers have the background's values.
    Fisheye,
}
