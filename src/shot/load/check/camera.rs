//! The camera: one way to state its direction and its field of view, and a point to look at.

use super::checks::Checks;
use crate::shot::{Projection, Track};

impl Checks<'_> {
    pub(super) fn camera(&mut self) {
        let camera = &self.shot.camera;
        if camera.worldline.as_deref() == Some("camera") {
            let message = "the camera cannot ride on its own worldline".to_owned();
            self.report("camera.worldline", message, "name another one, or \"lab\"");
        } else {
            self.check_worldline("camera.worldline", camera.worldline.as_ref());
        }
        self.either("look_at", "yaw");
        self.either("look_at", "pitch");
        self.either("hfov", "vfov");
        self.fields_of_view();
        self.looks_at_itself();
    }

    fn either(&mut self, one: &str, other: &str) {
        let path = format!("camera.{other}");
        if self.given(&format!("camera.{one}")) && self.given(&path) {
            let message = format!("`{one}` and `{other}` exclude each other");
            self.report(&path, message, "leave out one of them");
        }
    }

    /// Bounds on angles that depend on the projection, which the schema cannot express.
    fn fields_of_view(&mut self) {
        let camera = &self.shot.camera;
        if camera.projection.is_none() && self.given("camera.projection") {
            return; // it is mistaken by itself
        }
        match camera.projection.unwrap_or_default() {
            Projection::Perspective => {
                let help = "a wider view needs projection = \"fisheye\" or \"equirectangular\"";
                let fits = |angle| angle < 180.0;
                self.angles("camera.hfov", camera.hfov.as_ref(), fits, "below 180", help);
                self.angles("camera.vfov", camera.vfov.as_ref(), fits, "below 180", help);
            }
            Projection::Equirectangular => {
                let help =
                    "the sphere has 180 degrees from pole to pole, and 360 around it: `hfov`";
                let fits = |angle| angle <= 180.0;
                self.angles(
                    "camera.vfov",
                    camera.vfov.as_ref(),
                    fits,
                    "at most 180",
                    help,
                );
            }
            Projection::Fisheye => {}
        }
    }

    fn angles(
        &mut self,
        key: &str,
        angle: Option<&Track<f64>>,
        fits: fn(f64) -> bool,
        bound: &str,
        help: &str,
    ) {
        for (end, degrees) in angle.into_iter().flat_map(Track::authored) {
            if !fits(degrees) {
                let key = format!("{key}{end}");
                let message = format!("`{key}` must be {bound}, not {degrees}");
                self.report(&key, message, help);
            }
        }
    }

    fn looks_at_itself(&mut self) {
        let camera = &self.shot.camera;
        let Some(target) = &camera.look_at else {
            return;
        };
        if camera.position.is_none() && self.given("camera.position") {
            return; // it is mistaken by itself
        }
        let origin = Track::default();
        let position = camera.position.as_ref().unwrap_or(&origin);
        if let Some(frame) = self.first(position, target, |from, to| from == to) {
            let message = format!("the camera looks at its own position at frame {frame}");
            self.report(
                "camera.look_at",
                message,
                "look at another point, or write yaw and pitch",
            );
        }
    }
}
