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
mod clock;
mod direct;
mod flight;
mod grow;
mod mesh_tree;
mod optics;
mod ray;
mod real;
mod sampler;
mod spacetime;
mod stage;
mod surface;
mod tree;
mod triangle;

use crate::scene::{Material, Scene};
use clock::{timed, timed_without_shadows};
use glam::DVec3;
use grow::Buds;
use surface::Place;

pub use clock::{Clock, Phase};
pub use ray::boost_directions;
pub use sampler::{Samples, filter_offset};
pub use spacetime::{Link, Spacetime};
pub use stage::{BodyHit, RestRay, Stage};
pub use tree::{Branch, DirectLight, Node, Root, Seen, ShadeTrees, Surface};

/// Scratch memory of [`Tracer::trace`], to be kept from call to call.
#[derive(Default)]
pub struct Scratch {
    boosted: Vec<(DVec3, f64)>,
    nearest: Vec<Option<Nearest>>,
    buds: Buds,
}

/// The nearest hit of a ray so far.
#[derive(Clone, Copy)]
struct Nearest {
    /// Length of the light path in the rest frame that the ray starts in.
    s: f64,
    hit: BodyHit,
    /// In the rest frame of what was hit: when the light left, the ray's direction, and ω over
    /// what it is where the ray starts.
    time: f64,
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
    /// How many mirrors and boundaries of glass are followed, one after the other; 0 where the
    /// image calls for none.
    pub bounces: u32,
    /// Branches that carry no more than this share of what arrives by them are not followed. What
    /// is lost is [`Root::cut`].
    pub cutoff: f64,
    /// Where seconds are counted, if anywhere.
    pub clock: Option<&'a Clock>,
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
        timed_without_shadows(self.clock, || self.add_trees(directions, scratch, trees));
    }

    fn add_trees(&self, directions: &[DVec3], scratch: &mut Scratch, trees: &mut ShadeTrees) {
        for (direction, nearest) in directions.iter().zip(&scratch.nearest) {
            let first = trees.nodes.len();
            let cut = match nearest {
                Some(nearest) => self.add_tree(nearest, &mut scratch.buds, trees),
                None => {
                    self.add_sky(*direction, trees);
                    0.0
                }
            };
            trees.roots.push(Root {
                first: first as u32,
                count: (trees.nodes.len() - first) as u32,
                cut,
            });
        }
    }

    /// Nearest hits among the bodies of one worldline.
    fn meet(&self, worldline: usize, directions: &[DVec3], scratch: &mut Scratch) {
        let link = self.spacetime.link(worldline, self.scene.camera.worldline);
        timed(self.clock, Phase::Boost, || {
            boost_directions(link, directions, &mut scratch.boosted);
        });
        timed(self.clock, Phase::Traverse, || {
            self.traverse(worldline, scratch)
        });
    }

    /// Nearest hits of boosted rays.
    fn traverse(&self, worldline: usize, scratch: &mut Scratch) {
        let camera = self.spacetime.camera_event(worldline);
        for (nearest, &(direction, ratio)) in scratch.nearest.iter_mut().zip(&scratch.boosted) {
            let ray = RestRay {
                origin: camera.x,
                direction,
            };
            let path = self.spacetime.path_ratio(ratio);
            let reach = nearest.as_ref().map_or(f64::INFINITY, |n| n.s * path);
            if let Some(hit) = self.stage.nearest(worldline, &ray, reach) {
                let s = hit.t / path;
                if nearest.as_ref().is_none_or(|n| s < n.s) {
                    *nearest = Some(Nearest {
                        s,
                        hit,
                        time: camera.t - self.spacetime.delay(hit.t),
                        direction,
                        frequency_ratio: ratio,
                    });
                }
            }
        }
    }

    /// Adds the tree of a camera ray that meets a surface; returns what was cut off.
    fn add_tree(&self, nearest: &Nearest, buds: &mut Buds, trees: &mut ShadeTrees) -> f64 {
        let material = self.material(nearest);
        let place = self.place(nearest, material);
        let doppler = 1.0 / nearest.frequency_ratio;
        self.add_surface(nearest, place.as_ref(), None, doppler, trees);
        match &place {
            Some(place) if material.passes_light_on() => {
                grow::grow(self, place, material, buds, trees)
            }
            _ => 0.0,
        }
    }

    fn material(&self, nearest: &Nearest) -> &Material {
        let instance = &self.scene.geometry.instances[nearest.hit.instance as usize];
        &self.scene.materials[instance.material as usize]
    }

    /// The surroundings of a hit, where its material reflects light or passes it on.
    #[inline(always)]
    fn place(&self, nearest: &Nearest, material: &Material) -> Option<Place> {
        let lit = material.takes_lamps() && !self.scene.lights.is_empty();
        (lit || material.passes_light_on()).then(|| {
            let mut place = Place::new(self.scene, &nearest.hit, nearest.direction, nearest.time);
            place.point.clearance = self.stage.clearance(place.point.clearance);
            place
        })
    }

    /// Adds the node of a hit, and the lamps on it.
    fn add_surface(
        &self,
        nearest: &Nearest,
        place: Option<&Place>,
        branch: Option<Branch>,
        doppler: f64,
        trees: &mut ShadeTrees,
    ) {
        let first_lamp = trees.direct.len() as u32;
        let hit = nearest.hit;
        let number = self.scene.geometry.instances[hit.instance as usize].material;
        let material = &self.scene.materials[number as usize];
        if let (Some(place), true) = (place, material.takes_lamps()) {
            direct::add_lamps(self, place, material, trees);
        }
        trees.nodes.push(Node {
            branch,
            doppler,
            seen: Seen::Surface(Surface {
                material: number,
                s: nearest.s,
                time: nearest.time,
                hit,
                lamps: trees.direct.len() as u32 - first_lamp,
                first_lamp,
            }),
        });
    }

    /// Adds the background that a camera ray sees.
    fn add_sky(&self, direction: DVec3, trees: &mut ShadeTrees) {
        if let Some((seen, doppler)) = self.sky(self.scene.camera.worldline, direction) {
            trees.nodes.push(Node {
                branch: None,
                doppler,
                seen: Seen::Sky(seen),
            });
        }
    }

    /// The background in a unit direction of some rest frame: the direction on its own axes, and D
    /// from it to that frame. None where it is black.
    fn sky(&self, worldline: usize, direction: DVec3) -> Option<(DVec3, f64)> {
        let background = &self.scene.background;
        if background.is_black() {
            return None;
        }
        let light = self
            .spacetime
            .link(background.worldline, worldline)
            .light(-direction);
        let seen = background.axes.transpose() * -light.direction;
        Some((seen, 1.0 / light.frequency_ratio))
    }
}
