//! Camera rays to shade trees: geometry, visibility and Doppler factors, no spectrum.
//!
//! In: a [`Scene`], its [`Stage`] of bodies, the [`Spacetime`] of the image and the directions of
//! some camera rays. Out: [`ShadeTrees`], one for each ray, in flat arrays.
//!
//! A camera ray is an event and a past-pointing null vector k whose frequency is 1 in the
//! camera's rest frame. Boosts are linear, so a point x + s·k has the same s in every rest frame:
//! hits on different worldlines compare by s alone, with no time test. In a body's frame |k| is
//! the frequency ratio, so s is the length there over that ratio, and 1 over it is the Doppler
//! factor.

mod ball;
mod bvh;
mod direct;
mod mesh_tree;
mod ray;
mod sampler;
mod spacetime;
mod stage;
mod triangle;

use crate::scene::Scene;
use glam::DVec3;

pub use ray::boost_directions;
pub use sampler::{Samples, filter_offset};
pub use spacetime::{Link, Spacetime};
pub use stage::{BodyHit, RestRay, Stage};

/// Shade trees of some camera rays, without spectra: what frames that differ only in colours,
/// temperatures or exposure share.
#[derive(Debug, Default)]
pub struct ShadeTrees {
    /// What each ray sees first, in the order of the rays.
    pub roots: Vec<Root>,
    /// Surfaces that were hit.
    pub nodes: Vec<Node>,
    /// Lamps that light them.
    pub lit: Vec<Lit>,
}

impl ShadeTrees {
    /// Empties the trees, keeping their memory.
    pub fn clear(&mut self) {
        self.roots.clear();
        self.nodes.clear();
        self.lit.clear();
    }
}

/// What a camera ray sees first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Root {
    /// The background.
    Sky {
        /// D from the sky to the camera.
        doppler: f64,
        /// Where the ray looks: a unit vector in the sky's own axes.
        direction: DVec3,
    },
    /// A surface: index into [`ShadeTrees::nodes`].
    Surface(u32),
}

/// A surface in a shade tree.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Node {
    /// Index into the scene's materials.
    pub material: u32,
    /// D from the surface to the camera.
    pub doppler: f64,
    /// Length of the light path in the camera's rest frame, metres.
    pub s: f64,
    /// What was hit where.
    pub hit: BodyHit,
    /// Its lamps: this many …
    pub lamps: u32,
    /// … from this index of [`ShadeTrees::lit`] on.
    pub first_lamp: u32,
}

/// A lamp's light on a surface. The irradiance of the surface is D³·I(Dλ)/r² times a cosine; here
/// stand the factors that do not depend on wavelength or on how much beaming is simulated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lit {
    /// Index into the scene's lights.
    pub light: u32,
    /// D from the lamp to the surface.
    pub doppler: f64,
    /// share · cos θ / (π r²), m⁻²: times ρ and the irradiance's spectrum gives radiance.
    pub diffuse: f64,
    /// share · cos θ · (n+8)/(8π) · (N·H)ⁿ / r².
    pub highlight: f64,
}

/// Scratch memory of [`Tracer::trace`], to be kept from call to call.
#[derive(Default)]
pub struct Scratch {
    boosted: Vec<(DVec3, f64)>,
    nearest: Vec<Option<Nearest>>,
}

/// The nearest hit of a ray so far.
#[derive(Clone, Copy)]
struct Nearest {
    s: f64,
    worldline: usize,
    hit: BodyHit,
    /// Ray direction in the rest frame of what was hit, and ω there over ω in the camera's.
    direction: DVec3,
    frequency_ratio: f64,
}

/// What of the scene is traced: everything that does not change from ray to ray.
pub struct Tracer<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// Its bodies.
    pub stage: &'a Stage,
    /// How its worldlines stand to each other.
    pub spacetime: &'a Spacetime,
    /// Whether bodies cast shadows.
    pub shadows: bool,
}

impl Tracer<'_> {
    /// Traces the camera rays of the given unit `directions` (camera's rest frame, away from the
    /// camera) and adds their shade trees to `trees`.
    pub fn trace(&self, directions: &[DVec3], scratch: &mut Scratch, trees: &mut ShadeTrees) {
        scratch.nearest.clear();
        scratch.nearest.resize(directions.len(), None);
        for worldline in self.stage.worldlines() {
            self.meet(worldline, directions, scratch);
        }
        let sky = self
            .spacetime
            .link(self.scene.background.worldline, self.scene.camera.worldline);
        let sky_from_rest = self.scene.background.axes.transpose();
        for (direction, nearest) in directions.iter().zip(&scratch.nearest) {
            let root = match nearest {
                Some(nearest) => Root::Surface(self.add_surface(nearest, trees)),
                None => {
                    let light = sky.light(-*direction);
                    Root::Sky {
                        doppler: 1.0 / light.frequency_ratio,
                        direction: sky_from_rest * -light.direction,
                    }
                }
            };
            trees.roots.push(root);
        }
    }

    /// Nearest hits among the bodies of one worldline.
    fn meet(&self, worldline: usize, directions: &[DVec3], scratch: &mut Scratch) {
        let link = self.spacetime.link(worldline, self.scene.camera.worldline);
        let origin = self.spacetime.camera_event(worldline).x;
        boost_directions(link, directions, &mut scratch.boosted);
        for (nearest, &(direction, ratio)) in scratch.nearest.iter_mut().zip(&scratch.boosted) {
            let ray = RestRay { origin, direction };
            let path = self.spacetime.path_ratio(ratio);
            let reach = nearest.as_ref().map_or(f64::INFINITY, |n| n.s * path);
            if let Some(hit) = self.stage.nearest(worldline, &ray, reach) {
                let s = hit.t / path;
                if nearest.as_ref().is_none_or(|n| s < n.s) {
                    *nearest = Some(Nearest {
                        s,
                        worldline,
                        hit,
                        direction,
                        frequency_ratio: ratio,
                    });
                }
            }
        }
    }

    fn add_surface(&self, nearest: &Nearest, trees: &mut ShadeTrees) -> u32 {
        let first_lamp = trees.lit.len() as u32;
        direct::add_lamps(self, nearest, &mut trees.lit);
        trees.nodes.push(Node {
            material: self.scene.geometry.instances[nearest.hit.instance as usize].material,
            doppler: 1.0 / nearest.frequency_ratio,
            s: nearest.s,
            hit: nearest.hit,
            lamps: trees.lit.len() as u32 - first_lamp,
            first_lamp,
        });
        trees.nodes.len() as u32 - 1
    }
}
