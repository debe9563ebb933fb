//! Camera rays to shade trees, in waves: all camera rays and their hits over all worldlines, the
//! surfaces met, the shadow rays of them all, direct light; then one branch of each tree, and again.

use super::branches::BranchOrigin;
use super::clock::timed_without_shadows;
use super::direct::LitSurfaces;
use super::growth::Growth;
use super::interaction::Interaction;
use super::nearest::{NearestHit, RestRays, camera_hits, secondary_hits};
use super::tracer::Tracer;
use super::tree::{Branch, Node, Root, Seen, ShadeTrees, Surface};
use crate::scene::Material;
use glam::DVec3;

/// Scratch memory of [`Tracer::trace`], to be kept from call to call.
#[derive(Default)]
pub struct Scratch {
    rays: RestRays,
    nearest: Vec<Option<NearestHit>>,
    lit: LitSurfaces,
    growth: Growth,
}

impl Tracer<'_> {
    /// Traces the camera rays of the given unit `directions` (camera's rest frame, away from the
    /// camera) and adds their shade trees to `trees`.
    pub fn trace(&self, directions: &[DVec3], scratch: &mut Scratch, trees: &mut ShadeTrees) {
        let (first_root, first_node) = (trees.roots.len(), trees.nodes.len());
        camera_hits(self, directions, &mut scratch.rays, &mut scratch.nearest);
        timed_without_shadows(self.clock, || {
            self.add_first_nodes(directions, scratch, trees);
            while scratch.growth.take_wave(&mut trees.roots) {
                let branches = scratch.growth.pending().iter().map(|branch| &branch.ray);
                secondary_hits(self, branches, &mut scratch.rays, &mut scratch.nearest);
                self.add_later_nodes(scratch, trees);
            }
            scratch.growth.bring_together(first_root, first_node, trees);
        });
    }

    /// Adds what camera rays see: a root each.
    fn add_first_nodes(&self, directions: &[DVec3], scratch: &mut Scratch, trees: &mut ShadeTrees) {
        let (lit, growth) = (&mut scratch.lit, &mut scratch.growth);
        for (direction, nearest) in directions.iter().zip(&scratch.nearest) {
            let first = trees.nodes.len();
            let mut root = Root {
                first: first as u32,
                count: 0,
                cut: 0.0,
            };
            if let Some(found) = nearest {
                let doppler = 1.0 / found.frequency_ratio;
                let passing = self.add_surface(found, None, doppler, lit, trees);
                if let Some((surface, material)) = passing {
                    let mut queue = growth.queue();
                    let origin = BranchOrigin::first(doppler);
                    queue.push_branches(self, &surface, material, &origin, &mut root);
                    growth.add(trees.roots.len() as u32, queue);
                }
            } else if let Some((seen, doppler)) = self.sky(self.scene.camera.worldline, *direction)
            {
                trees.nodes.push(Node {
                    branch: None,
                    doppler,
                    seen: Seen::Sky(seen),
                });
            }
            root.count = (trees.nodes.len() - first) as u32;
            trees.roots.push(root);
        }
        lit.light(self, trees);
    }

    /// Adds what the rays of a later wave see, and the branches from there.
    fn add_later_nodes(&self, scratch: &mut Scratch, trees: &mut ShadeTrees) {
        let (lit, growth) = (&mut scratch.lit, &mut scratch.growth);
        for (number, nearest) in scratch.nearest.iter().enumerate() {
            let (pending, tree) = growth.branch(number);
            let root = tree.root;
            if let Some(found) = nearest {
                let (branch, doppler) = pending.to_surface(found.frequency_ratio);
                let passing = self.add_surface(found, Some(branch), doppler, lit, trees);
                if let Some((surface, material)) = passing {
                    let root = &mut trees.roots[root as usize];
                    let origin = pending.origin_at(&surface, root.count, doppler);
                    let queue = &mut tree.queue;
                    queue.push_branches(self, &surface, material, &origin, root);
                }
            } else if let Some((seen, doppler)) =
                self.sky(pending.ray.worldline, pending.ray.direction)
            {
                let (branch, doppler) = pending.to_sky(doppler);
                trees.nodes.push(Node {
                    branch: Some(branch),
                    doppler,
                    seen: Seen::Sky(seen),
                });
            } else {
                continue;
            }
            growth.note_node(root, &mut trees.roots);
        }
        lit.light(self, trees);
    }

    /// Adds the node of a hit and lists it where lamps may light it. Returns the surface and its
    /// material if that passes light on.
    #[inline(always)]
    fn add_surface(
        &self,
        found: &NearestHit,
        branch: Option<Branch>,
        doppler: f64,
        lit: &mut LitSurfaces,
        trees: &mut ShadeTrees,
    ) -> Option<(Interaction, &Material)> {
        let number = self.scene.geometry.instances[found.hit.instance as usize].material;
        let material = &self.scene.materials[number as usize];
        let node = trees.nodes.len() as u32;
        trees.nodes.push(Node {
            branch,
            doppler,
            seen: Seen::Surface(Surface {
                material: number,
                s: found.s,
                time: found.time,
                hit: found.hit,
                lamps: 0,
                first_lamp: 0,
            }),
        });
        let takes_lamps = material.takes_lamps() && !self.scene.lights.is_empty();
        let passes_light_on = material.passes_light_on();
        if !takes_lamps && !passes_light_on {
            return None;
        }
        let surface = Interaction::new(self.scene, found);
        if takes_lamps {
            lit.list(self, &surface, number, node);
            if lit.are_many() {
                lit.light(self, trees);
            }
        }
        passes_light_on.then_some((surface, material))
    }
}
