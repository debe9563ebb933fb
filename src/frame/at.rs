//! Tracks of a shot to their values at one frame, and names of worldlines to their places.

use crate::shot::{Blend, Shot, Track};
use glam::DVec3;

/// One frame of a shot, at which tracks are read.
#[derive(Debug, Clone, Copy)]
pub(super) struct At<'a> {
    pub(super) shot: &'a Shot,
    /// Number of the frame, from 1.
    pub(super) number: u32,
}

impl<'a> At<'a> {
    /// The value of a track.
    pub(super) fn value<T: Blend>(self, track: &Track<T>) -> T {
        track.at(self.number, self.shot.shot.frames)
    }

    /// The value of a track that its author may have left out.
    pub(super) fn given<T: Blend>(self, track: &Option<Track<T>>) -> Option<T> {
        track.as_ref().map(|track| self.value(track))
    }

    /// A vector; zero where its author left it out.
    pub(super) fn vector(self, track: &Option<Track<[f64; 3]>>) -> DVec3 {
        self.given(track).map_or(DVec3::ZERO, DVec3::from)
    }

    /// The place of the worldline `name` in [`Frame::worldlines`](super::Frame), or of `default`
    /// where none is named. The lab has place 0; "camera" is another name for the worldline that the
    /// camera rides on, itself "lab" by default.
    pub(super) fn worldline(self, name: &Option<String>, default: &str) -> usize {
        let of_camera = || self.shot.camera.worldline.as_deref().unwrap_or("lab");
        let name = match name.as_deref().unwrap_or(default) {
            "camera" => of_camera(),
            name => name,
        };
        // Dangling names were refused when the shot was read, so what is not there is the lab.
        let own = self.shot.worldline.get_index_of(name);
        own.map_or(0, |place| place + 1)
    }
}
