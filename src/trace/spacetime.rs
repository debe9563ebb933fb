//! How the worldlines of one image move relative to each other: a transform for each pair, composed
//! once.

use super::link::Link;
use crate::relativity::{Boost, Event, SeenLight, Transform, Worldline};
use crate::scene::Scene;

/// All links of an image.
#[derive(Debug, Clone)]
pub struct Spacetime {
    links: Vec<Link>,
    count: usize,
    finite: bool,
    /// The exposure in each worldline's rest frame.
    camera_events: Vec<Event>,
}

impl Spacetime {
    /// The links of a scene. With `finite_light_speed` false, bodies stand uncontracted where
    /// they are at the lab time of the exposure.
    pub fn new(scene: &Scene, finite_light_speed: bool) -> Self {
        let worldlines = &scene.worldlines;
        let count = worldlines.len();
        let at = |w: &Worldline| w.origin.x + w.celerity.beta() * (scene.lab_time - w.origin.t);
        let link = |to: &Worldline, from: &Worldline| {
            if finite_light_speed {
                Link::Finite(Transform::between(from, to))
            } else {
                let w = to.celerity.seen_from(from.celerity);
                Link::Snapshot {
                    transform: Transform::snapshot(at(from), at(to)),
                    doppler: Boost::into_rest_of(w),
                }
            }
        };
        let links: Vec<Link> = worldlines
            .iter()
            .flat_map(|to| worldlines.iter().map(move |from| (to, from)))
            .map(|(to, from)| link(to, from))
            .collect();
        let exposure = if finite_light_speed {
            scene.camera.event
        } else {
            Event::new(scene.lab_time, scene.camera.event.x)
        };
        // To frames at rest in the lab from what is known there: at large γ, the way through the
        // camera's frame would lose the digits that its time and place share.
        let camera = &worldlines[scene.camera.worldline];
        let in_lab = camera.lab_position(scene.camera.event.x, scene.lab_time);
        let in_frame = |to: usize| match &worldlines[to] {
            line if finite_light_speed
                && to != scene.camera.worldline
                && line.celerity.is_rest() =>
            {
                Event::new(scene.lab_time - line.origin.t, in_lab - line.origin.x)
            }
            _ => links[to * count + scene.camera.worldline].event(exposure),
        };
        let camera_events = (0..count).map(in_frame).collect();
        Self {
            links,
            count,
            finite: finite_light_speed,
            camera_events,
        }
    }

    /// The map to the rest frame of worldline `to` from that of `from`.
    #[inline(always)]
    pub fn link(&self, to: usize, from: usize) -> &Link {
        &self.links[to * self.count + from]
    }

    /// The exposure in the rest frame of a worldline.
    #[inline(always)]
    pub fn camera_event(&self, worldline: usize) -> Event {
        self.camera_events[worldline]
    }

    /// ω at the receiver over ω at the source, of light that `seen` describes on its way from the
    /// one worldline to the other. Where light takes no time all frames share its direction, and
    /// the one in Doppler's formula is the receiver's, as for the camera.
    #[inline(always)]
    pub fn received_ratio(&self, source: usize, receiver: usize, seen: &SeenLight) -> f64 {
        if self.finite {
            return seen.frequency_ratio;
        }
        1.0 / self
            .link(source, receiver)
            .light(seen.direction)
            .frequency_ratio
    }

    /// Length of a light path in one frame over its length in the other, for light whose
    /// frequencies stand in this ratio: the same ratio, or 1 where light takes no time.
    #[inline(always)]
    pub fn path_ratio(&self, frequency_ratio: f64) -> f64 {
        if self.finite { frequency_ratio } else { 1.0 }
    }

    /// How long light takes for a path of this length, in metres of light travel.
    #[inline(always)]
    pub fn delay(&self, distance: f64) -> f64 {
        if self.finite { distance } else { 0.0 }
    }
}
