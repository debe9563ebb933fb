//! The camera: an event and axes in the rest frame of its worldline.

use super::projection::Projection;
use crate::frame::{Aim, Frame};
use crate::relativity::{Event, Worldline};
use glam::{DMat3, DMat4, DVec3};

/// The camera at its exposure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// Index into the scene's worldlines.
    pub worldline: usize,
    /// The event of the exposure, in the rest frame of that worldline.
    pub event: Event,
    /// Right, up and back, as columns; orthonormal.
    pub axes: DMat3,
    /// Map from image points to directions about those axes.
    pub projection: Projection,
}

impl Camera {
    /// Camera space, as image files define it (x right, y up, z forward), from the lab. None if the
    /// camera moves in the lab (`worldline`): each lab point then has another place at each time.
    pub fn camera_from_lab(&self, worldline: &Worldline) -> Option<DMat4> {
        worldline.celerity.is_rest().then(|| {
            let [right, up, back] = [self.axes.x_axis, self.axes.y_axis, self.axes.z_axis];
            let turn = DMat3::from_cols(right, up, -back).transpose();
            let position = self.event.x + worldline.origin.x;
            DMat4::from_mat3_translation(turn, -(turn * position))
        })
    }

    /// The unit direction, in the camera's rest frame, in which an image point is seen; None where
    /// the projection has no ray. `point` is in fractions of the image, from 0 at the left and top
    /// to 1.
    #[inline(always)]
    pub fn looks_along(&self, point: [f64; 2]) -> Option<DVec3> {
        let towards = self.projection.towards(point)?;
        Some((self.axes * towards).normalize())
    }

    /// The image point at which something in a direction (of any length, in the camera's rest
    /// frame) is seen, the inverse of [`Camera::looks_along`], also outside of the image; None if
    /// there is none. Of the points on both sides of a panorama's seam it is the one nearer to
    /// `near`.
    pub fn image_point(&self, direction: DVec3, near: [f64; 2]) -> Option<[f64; 2]> {
        self.projection
            .point_of(self.axes.transpose() * direction, near)
    }
}

impl Camera {
    /// The camera of a frame.
    ///
    /// The exposure is the event of the camera's position at the frame's lab time.
    pub(super) fn new(frame: &Frame<'_>) -> Self {
        let camera = &frame.camera;
        let (yaw, pitch) = match camera.aim {
            Aim::Along { yaw_deg, pitch_deg } => (yaw_deg.to_radians(), pitch_deg.to_radians()),
            Aim::At(point) => towards(point - camera.position),
        };
        let yaw = yaw + camera.pan_deg.to_radians();
        let pitch = pitch + camera.tilt_deg.to_radians();
        let roll = camera.roll_deg.to_radians();
        let worldline = &frame.worldlines[camera.worldline].motion;
        Self {
            worldline: camera.worldline,
            event: worldline.event_at_lab_time(camera.position, frame.lab_time),
            axes: axes(yaw, pitch, roll),
            projection: Projection::new(frame),
        }
    }
}

/// Yaw (about y, positive to the right of −z) and pitch (up) of a direction.
fn towards(direction: DVec3) -> (f64, f64) {
    let level = direction.x.hypot(direction.z);
    let yaw = if level > 0.0 {
        direction.x.atan2(-direction.z)
    } else {
        0.0
    };
    (yaw, direction.y.atan2(level))
}

/// Right, up and back of a camera turned by yaw, then pitch, then roll (clockwise, as seen through
/// the camera).
fn axes(yaw: f64, pitch: f64, roll: f64) -> DMat3 {
    DMat3::from_rotation_y(-yaw) * DMat3::from_rotation_x(pitch) * DMat3::from_rotation_z(-roll)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::relativity::Celerity;

    fn camera(text: &str) -> (Camera, Worldline) {
        let text = format!("{text}\n[[model]]\nfile = \"assets/sphere.obj\"\n[material.m]\n");
        let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("shot.toml");
        let shot = crate::shot::parse(&text, &path).unwrap();
        let lab = Worldline {
            origin: Event::new(0.0, DVec3::new(0.0, 0.0, 1.0)),
            ..Worldline::LAB
        };
        let mut frame = Frame::new(&shot, 1).unwrap();
        frame.worldlines[0].motion = lab;
        (Camera::new(&frame), lab)
    }

    #[test]
    fn camera_space_has_what_is_looked_at_straight_ahead() {
        let (camera, lab) = camera("[camera]\nposition = [1, 2, 3]\nlook_at = [5, 2, 0]");
        let map = camera.camera_from_lab(&lab).unwrap();
        let seen = map.transform_point3(DVec3::new(5.0, 2.0, 1.0));
        assert!(
            (seen - DVec3::new(0.0, 0.0, 5.0)).length() < 1e-14,
            "{seen}"
        );
        let moving = Worldline {
            celerity: Celerity::new(DVec3::X).unwrap(),
            ..lab
        };
        assert_eq!(camera.camera_from_lab(&moving), None);
    }

    #[test]
    fn yaw_and_pan_turn_to_the_right_pitch_and_tilt_up_and_roll_clockwise() {
        let ahead = |text: &str| {
            camera(&format!("[camera]\n{text}"))
                .0
                .looks_along([0.5, 0.5])
                .unwrap()
        };
        assert!((ahead("yaw = 90") - DVec3::X).length() < 1e-15);
        assert!((ahead("yaw = 60\npan = 30") - DVec3::X).length() < 1e-15);
        assert!((ahead("pitch = 30\ntilt = 60") - DVec3::Y).length() < 1e-15);
        // Rolled clockwise by 90 degrees, the top of the image is the camera's former right.
        let top = camera("[camera]\nroll = 90\nvfov = 90")
            .0
            .looks_along([0.5, 0.0])
            .unwrap();
        assert!(top.x > 0.7 && top.y.abs() < 1e-15, "{top}");
    }

    #[test]
    fn a_90_degree_view_ends_45_degrees_off_its_axis() {
        let corner = camera("[camera]\nhfov = 90")
            .0
            .looks_along([1.0, 0.5])
            .unwrap();
        assert!((corner.x + corner.z).abs() < 1e-15 && corner.y == 0.0);
    }

    #[test]
    fn every_projection_is_about_where_the_camera_looks() {
        for projection in ["perspective", "equirectangular", "fisheye"] {
            let projected = |text: &str, point| {
                camera(&format!("[camera]\nprojection = \"{projection}\"\n{text}"))
                    .0
                    .looks_along(point)
                    .unwrap()
            };
            let near = |found: DVec3, expected: DVec3| {
                assert!((found - expected).length() < 1e-15, "{projection} {found}");
            };
            let turned =
                "position = [1, 2, 3]\nlook_at = [1, 2, 9]\npan = 60\ntilt = 30\nroll = 20";
            let [yaw, pitch] = [240.0_f64, 30.0].map(f64::to_radians);
            let ahead = DVec3::new(
                pitch.cos() * yaw.sin(),
                pitch.sin(),
                -pitch.cos() * yaw.cos(),
            );
            near(projected(turned, [0.5, 0.5]), ahead);
            // Rolled clockwise, the upper half of the image is the camera's former right.
            let upper = projected("yaw = 90\nroll = 90", [0.5, 0.3]);
            assert!(
                upper.z > 0.1 && upper.y.abs() < 1e-15,
                "{projection} {upper}"
            );
        }
    }
    #[test]
    fn a_turned_camera_shows_what_it_sees_where_it_saw_it() {
        for projection in ["perspective", "equirectangular", "fisheye"] {
            let turned = "look_at = [1, 2, 9]\npan = 60\ntilt = 30\nroll = 20";
            let (camera, _) = camera(&format!(
                "[camera]\nprojection = \"{projection}\"\n{turned}"
            ));
            for point in [[0.5, 0.5], [0.3, 0.6], [0.71, 0.27], [0.52, 0.91]] {
                let direction = camera.looks_along(point).unwrap();
                let found = camera.image_point(direction * 1e-3, point).unwrap();
                let off = (found[0] - point[0]).hypot(found[1] - point[1]);
                assert!(off < 1e-14, "{projection} {point:?} {found:?}");
            }
        }
    }
}
