//! The camera of one frame. Meters and degrees in its worldline's rest frame.

use super::at::At;
use crate::shot::{self, Projection};
use glam::DVec3;

/// Where the camera is, where it looks, how wide.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// Place of its worldline in [`Frame::worldlines`](super::Frame).
    pub worldline: usize,
    /// Position, m.
    pub position: DVec3,
    /// Where it looks, before `pan` and `tilt`.
    pub aim: Aim,
    /// Turn about the line of sight, degrees.
    pub roll_deg: f64,
    /// Yaw added to where it looks, degrees.
    pub pan_deg: f64,
    /// Pitch added to where it looks, degrees.
    pub tilt_deg: f64,
    /// Horizontal field of view, degrees.
    pub hfov_deg: Option<f64>,
    /// Vertical field of view, degrees. Where neither is given the projection chooses.
    pub vfov_deg: Option<f64>,
    /// How directions become pixels.
    pub projection: Projection,
}

/// Where a camera looks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Aim {
    /// At a point, m.
    At(DVec3),
    /// Along a direction.
    Along {
        /// Turn about y from −z, degrees, positive to the right.
        yaw_deg: f64,
        /// Turn upwards, degrees.
        pitch_deg: f64,
    },
}

impl Camera {
    pub(super) fn new(at: At<'_>) -> Self {
        let shot::Camera {
            worldline,
            position,
            look_at,
            yaw,
            pitch,
            roll,
            pan,
            tilt,
            hfov,
            vfov,
            projection,
        } = &at.shot.camera;
        let degrees = |track| at.given(track).unwrap_or(0.0);
        Self {
            worldline: at.worldline(worldline, "lab"),
            position: at.vector(position),
            aim: match at.given(look_at) {
                Some(point) => Aim::At(DVec3::from(point)),
                None => Aim::Along {
                    yaw_deg: degrees(yaw),
                    pitch_deg: degrees(pitch),
                },
            },
            roll_deg: degrees(roll),
            pan_deg: degrees(pan),
            tilt_deg: degrees(tilt),
            hfov_deg: at.given(hfov),
            vfov_deg: at.given(vfov),
            projection: projection.unwrap_or_default(),
        }
    }

    /// Whether it looks at its own position, which is no direction.
    pub(super) fn looks_at_itself(&self) -> bool {
        matches!(self.aim, Aim::At(point) if point - self.position == DVec3::ZERO)
    }
}
