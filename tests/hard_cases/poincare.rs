//! A scene moved as a whole: turned, set in motion and carried elsewhere in space and time. No
//! picture of it changes, for no frame is better than another.
//!
//! The map of events is X ↦ ΛX + a with Λ = L(c)·Q: the turn Q first, then the boost that gives
//! celerity c to what was at rest, L(c) = B(c)⁻¹ = B(−c). A body of celerity u whose rest frame has
//! its origin at the event o has the content e of its rest frame at the events o + L(u)e, so
//! Λ(o + L(u)e) + a = (Λo + a) + L(c)·Q·L(u)e, and with v = Qu
//!
//! Q·L(u) = L(v)·Q,   L(c)·L(v) = L(u′)·W,   hence   L(c)·Q·L(u) = L(u′)·R,   R = W·Q.
//!
//! u′ = v + c(γ_v + c·v/(1 + γ_c)) is the space part of L(c)(γ_v, v). W is the Wigner rotation,
//! a turn about v×c by ε with tan(ε/2) = |v×c|/(1 + γ_c + γ_v + γ_u′) (Macfarlane 1962). So the
//! worldline goes on with u′ through Λo + a, and its content is turned by R in its rest frame.
//!
//! The boosts are written out here and are not those of `relativity`, whose work the pictures test.

use super::numbers::Random;
use glam::{DAffine3, DMat3, DQuat, DVec3};
use restframe::relativity::{Celerity, Event, Worldline};
use restframe::scene::{Background, Camera, Geometry, Light, LightShape, Scene};
use std::sync::Arc;

/// A rotation, then a boost, then a translation of spacetime.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Poincare {
    /// Q.
    pub(crate) turn: DQuat,
    /// c, γβ of what was at rest.
    pub(crate) celerity: DVec3,
    /// a, metres.
    pub(crate) shift: Event,
}

impl Poincare {
    /// A boost of this Lorentz factor in any direction, any turn, and a translation by whole
    /// eighths of up to 8 m.
    pub(crate) fn at_random(seed: u64, lorentz_factor: f64) -> Self {
        let mut random = Random(seed);
        let eighths = |v: f64| (v * 64.0).round() / 8.0;
        let [axis, direction, place] = [(); 3].map(|()| random.vector());
        let speed = ((lorentz_factor - 1.0) * (lorentz_factor + 1.0)).sqrt();
        Self {
            turn: DQuat::from_xyzw(axis.x, axis.y, axis.z, random.next()).normalize(),
            celerity: direction.normalize() * speed,
            shift: Event::new(
                eighths(random.next()),
                DVec3::from(place.to_array().map(eighths)),
            ),
        }
    }

    /// The scene with every worldline moved, and what stands on it turned along.
    pub(crate) fn scene(&self, scene: &Scene) -> Scene {
        let moved: Vec<(Worldline, DMat3)> =
            scene.worldlines.iter().map(|w| self.worldline(w)).collect();
        let turn = |worldline: usize| moved[worldline].1;
        let camera = camera(&scene.camera, turn(scene.camera.worldline));
        let line = moved[camera.worldline].0;
        let exposure = after(line.origin, boosted(line.celerity.vector(), camera.event));
        Scene {
            lab_time: exposure.t,
            camera,
            geometry: Arc::new(geometry(&scene.geometry, turn)),
            lights: scene
                .lights
                .iter()
                .map(|l| light(l, turn(l.worldline)))
                .collect(),
            background: background(&scene.background, turn(scene.background.worldline)),
            worldlines: moved.iter().map(|(line, _)| *line).collect(),
            ..scene.clone()
        }
    }

    /// The worldline with u′ through Λo + a, and R.
    pub(crate) fn worldline(&self, line: &Worldline) -> (Worldline, DMat3) {
        let (c, v) = (self.celerity, self.turn * line.celerity.vector());
        let u = v + c * (lorentz_factor(v) + c.dot(v) / (1.0 + lorentz_factor(c)));
        let sum = 1.0 + lorentz_factor(c) + lorentz_factor(v) + lorentz_factor(u);
        let half = v.cross(c) / sum;
        let wigner = DQuat::from_xyzw(half.x, half.y, half.z, 1.0).normalize();
        let moved = Worldline {
            celerity: Celerity::new(u).unwrap(),
            origin: self.event(line.origin),
        };
        (moved, DMat3::from_quat(wigner * self.turn))
    }

    /// ΛX + a.
    pub(crate) fn event(&self, e: Event) -> Event {
        after(
            self.shift,
            boosted(self.celerity, Event::new(e.t, self.turn * e.x)),
        )
    }
}

fn lorentz_factor(u: DVec3) -> f64 {
    1f64.hypot(u.length())
}

/// L(u)e: (γt + u·x, x + u(t + (u·x)/(1 + γ))).
pub(crate) fn boosted(u: DVec3, e: Event) -> Event {
    let along = u.dot(e.x);
    Event::new(
        lorentz_factor(u) * e.t + along,
        e.x + u * (e.t + along / (1.0 + lorentz_factor(u))),
    )
}

fn after(origin: Event, e: Event) -> Event {
    Event::new(origin.t + e.t, origin.x + e.x)
}

fn camera(camera: &Camera, turn: DMat3) -> Camera {
    Camera {
        event: Event::new(camera.event.t, turn * camera.event.x),
        axes: turn * camera.axes,
        ..*camera
    }
}

fn geometry(geometry: &Geometry, turn: impl Fn(usize) -> DMat3) -> Geometry {
    let mut geometry = geometry.clone();
    for instance in &mut geometry.instances {
        let turn = DAffine3::from_mat3(turn(instance.worldline as usize));
        instance.rest_from_mesh = turn * instance.rest_from_mesh;
    }
    geometry
}

fn light(light: &Light, turn: DMat3) -> Light {
    let mut light = light.clone();
    match &mut light.shape {
        LightShape::Point { position } => *position = turn * *position,
        LightShape::Spot {
            position,
            direction,
            ..
        } => {
            *position = turn * *position;
            *direction = turn * *direction;
        }
        LightShape::Sun { direction } => *direction = turn * *direction,
    }
    light
}

fn background(background: &Background, turn: DMat3) -> Background {
    Background {
        axes: turn * background.axes,
        ..background.clone()
    }
}

#[test]
fn a_moved_worldline_has_its_content_at_the_moved_events() {
    let line = Worldline {
        celerity: Celerity::from_beta(DVec3::new(0.3, -0.6, 0.5)).unwrap(),
        origin: Event::new(0.5, DVec3::new(1.0, -2.0, 3.0)),
    };
    for speed in [0.0, 0.75, 10.0, 1e3] {
        let transform = Poincare {
            turn: DQuat::from_xyzw(0.1, -0.5, 0.7, 0.4).normalize(),
            celerity: DVec3::new(0.48, 0.64, -0.6) * speed,
            shift: Event::new(-7.0, DVec3::new(4.0, 5.5, -6.0)),
        };
        let (moved, turn) = transform.worldline(&line);
        let content = Event::new(2.0, DVec3::new(-0.25, 4.0, 1.5));
        let there = transform.event(after(line.origin, boosted(line.celerity.vector(), content)));
        let turned = Event::new(content.t, turn * content.x);
        let here = after(moved.origin, boosted(moved.celerity.vector(), turned));
        let size = there.t.abs() + there.x.length();
        assert!(
            (here.t - there.t).abs() < 1e-14 * size,
            "{here:?} {there:?}"
        );
        assert!(
            (here.x - there.x).length() < 1e-14 * size,
            "{here:?} {there:?}"
        );
    }
}
