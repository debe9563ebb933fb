//! Direct light: lamps on the past light cone of surface events, and which of them are in shadow.
//!
//! Surfaces of a wave are listed with the lamps on their viewer's side; the way to each lamp is a
//! shadow ray. All rays that are listed go to the rest frame of one worldline after the other, as a
//! batch. What is left becomes [`DirectLight`].

use super::clock::{Phase, timed};
use super::interaction::Interaction;
use super::tracer::Tracer;
use super::tree::{DirectLight, Seen, ShadeTrees};
use crate::accel::{RayBatch, every_instance};
use crate::relativity::{self, Event, light_arriving};
use crate::scene::{Light, LightShape, Lobe};
use glam::DVec3;
use std::ops::Range;

/// Nearest distance of a lamp that is told apart, m: the Planck length. Irradiance, I cos θ/r²,
/// grows without bound towards a point of light, and beyond all numbers below 1e-154 m; nearer than
/// this it grows no more. A picture cannot hold it long before: that is counted when it is developed.
const NEAREST: f64 = 1.6e-35;

/// Shadow rays that are traced together, at least, but for the last of a wave: their memory stays in
/// the second cache.
const SHADOW_RAYS: usize = 1024;

/// Surfaces of a wave that lamps may light.
#[derive(Default)]
pub(super) struct LitSurfaces {
    surfaces: Vec<LitSurface>,
    shadow_rays: Vec<ShadowRay>,
    /// By shadow ray: whether a body stands on it.
    blocked: Vec<bool>,
    /// Shadow rays in one rest frame, which they are, and what is found.
    batch: RayBatch,
    numbers: Vec<u32>,
    found: Vec<bool>,
}

/// A surface, and the lamps on its viewer's side.
struct LitSurface {
    /// Index of its node among all.
    node: u32,
    /// Index into the scene's materials.
    material: u32,
    /// The worldline in whose frame the rest is given.
    worldline: usize,
    shading_normal: DVec3,
    to_viewer: DVec3,
    /// Where its shadow rays start.
    start: Event,
    /// Its shadow rays.
    rays: Range<usize>,
}

/// The way from a surface to a lamp.
struct ShadowRay {
    /// Index into the surfaces listed.
    surface: u32,
    /// Index into the scene's lights.
    light: u32,
    /// share · cos θ / r² of the lamp, m⁻².
    irradiance: f64,
    /// From the lamp to the surface.
    arriving: Arriving,
    /// Length in the lamp's rest frame, from where shadow rays start.
    distance: f64,
}

/// Light that arrives at a surface event.
struct Arriving {
    /// Unit direction of travel in the lamp's rest frame and in the surface's.
    in_lamp: DVec3,
    in_surface: DVec3,
    /// D from lamp to surface.
    doppler: f64,
    /// Length of the light path in the lamp's rest frame; infinite for a sun.
    distance: f64,
    /// share / r², r at least [`NEAREST`]; or share for a sun.
    falloff: f64,
}

impl LitSurfaces {
    /// Lists the surface of the node of this index, with the lamps that would light it if nothing
    /// stood between them.
    #[inline(always)]
    pub(super) fn list(
        &mut self,
        tracer: &Tracer<'_>,
        surface: &Interaction,
        material: u32,
        node: u32,
    ) {
        let first = self.shadow_rays.len();
        let off_surface = surface.off_smooth_surface();
        for (light, number) in tracer.scene.lights.iter().zip(0..) {
            let Some(arriving) = arriving(tracer, surface, light) else {
                continue;
            };
            let cos = surface.shading_normal.dot(-arriving.in_surface);
            if cos <= 0.0 || arriving.falloff <= 0.0 {
                continue;
            }
            // So much nearer to the lamp: what stands beyond it casts no shadow.
            let nearer = off_surface.dot(-arriving.in_surface)
                / tracer.spacetime.path_ratio(arriving.doppler);
            self.shadow_rays.push(ShadowRay {
                surface: self.surfaces.len() as u32,
                light: number,
                irradiance: arriving.falloff * cos,
                distance: (arriving.distance - nearer).max(0.0),
                arriving,
            });
        }
        if self.shadow_rays.len() > first {
            self.surfaces.push(LitSurface {
                node,
                material,
                worldline: surface.worldline,
                shading_normal: surface.shading_normal,
                to_viewer: surface.to_viewer,
                start: Event::new(surface.event.t, surface.event.x + off_surface),
                rays: first..self.shadow_rays.len(),
            });
        }
    }

    /// Whether enough shadow rays are listed to be traced.
    pub(super) fn are_many(&self) -> bool {
        self.shadow_rays.len() >= SHADOW_RAYS
    }

    /// Adds the direct light on all surfaces listed to their nodes, and empties the list.
    pub(super) fn light(&mut self, tracer: &Tracer<'_>, trees: &mut ShadeTrees) {
        self.blocked.clear();
        self.blocked.resize(self.shadow_rays.len(), false);
        if tracer.shadows && !self.shadow_rays.is_empty() {
            timed(tracer.clock, Phase::Shadow, || self.find_blocked(tracer));
        }
        for surface in &self.surfaces {
            let first_lamp = trees.direct.len() as u32;
            for (ray, _) in (self.shadow_rays[surface.rays.clone()].iter())
                .zip(&self.blocked[surface.rays.clone()])
                .filter(|(_, blocked)| !**blocked)
            {
                surface.add(ray, tracer, trees);
            }
            let lamps = trees.direct.len() as u32 - first_lamp;
            if let Seen::Surface(node) = &mut trees.nodes[surface.node as usize].seen {
                (node.lamps, node.first_lamp) = (lamps, first_lamp);
            }
        }
        self.surfaces.clear();
        self.shadow_rays.clear();
    }

    /// Finds the shadow rays on which a body of any worldline stands.
    fn find_blocked(&mut self, tracer: &Tracer<'_>) {
        for worldline in tracer.aggregate.worldlines() {
            self.batch.clear();
            self.numbers.clear();
            for (ray, number) in self.shadow_rays.iter().zip(0..) {
                if !self.blocked[number as usize] {
                    let surface = &self.surfaces[ray.surface as usize];
                    let (origin, direction, reach) = ray.among(worldline, surface, tracer);
                    self.batch.push(origin, direction, reach);
                    self.numbers.push(number);
                }
            }
            tracer
                .aggregate
                .occluded(worldline, &self.batch, every_instance, &mut self.found);
            for (&number, &found) in self.numbers.iter().zip(&self.found) {
                self.blocked[number as usize] = found;
            }
        }
    }
}

impl LitSurface {
    /// Adds a lamp that lights the surface.
    #[inline(always)]
    fn add(&self, ray: &ShadowRay, tracer: &Tracer<'_>, trees: &mut ShadeTrees) {
        trees.direct.push(DirectLight {
            light: ray.light,
            first_weight: trees.weights.len() as u32,
            doppler: ray.arriving.doppler,
        });
        let to_lamp = -ray.arriving.in_surface;
        let material = &tracer.scene.materials[self.material as usize];
        let weight = |lobe: &Lobe| {
            lobe.reflected(ray.irradiance, self.shading_normal, to_lamp, self.to_viewer)
        };
        let lobes = material.bsdf.non_specular().iter();
        trees.weights.extend(lobes.map(weight));
    }
}

impl ShadowRay {
    /// The ray among the bodies of `worldline`: its start, unit direction and reach.
    ///
    /// It is one null line: in each rest frame it starts at the surface event, and its length there
    /// is that in the lamp's frame times the ratio of frequencies.
    #[inline(always)]
    fn among(
        &self,
        worldline: usize,
        surface: &LitSurface,
        tracer: &Tracer<'_>,
    ) -> (Event, DVec3, f64) {
        let spacetime = tracer.spacetime;
        let (origin, seen) = if worldline == surface.worldline {
            let own = relativity::SeenLight {
                direction: self.arriving.in_surface,
                frequency_ratio: self.arriving.doppler,
            };
            (surface.start, own)
        } else {
            let lamp = tracer.scene.lights[self.light as usize].worldline;
            let there = spacetime.link(worldline, surface.worldline);
            let seen = spacetime.link(worldline, lamp).light(self.arriving.in_lamp);
            (there.event(surface.start), seen)
        };
        let reach = self.distance * spacetime.path_ratio(seen.frequency_ratio);
        (origin, -seen.direction, reach)
    }
}

/// The lamp's light at the surface event, or None where the lamp is at that very event: there its
/// light has no direction and the lamp is on neither side of the surface, so it lights nothing.
#[inline(always)]
fn arriving(tracer: &Tracer<'_>, surface: &Interaction, light: &Light) -> Option<Arriving> {
    let spacetime = tracer.spacetime;
    let (in_lamp, distance, spread) = match light.shape {
        LightShape::Point { position } | LightShape::Spot { position, .. } => {
            let event = spacetime
                .link(light.worldline, surface.worldline)
                .event(surface.event);
            let arrival = light_arriving(event, position)?;
            (
                arrival.direction,
                arrival.distance,
                arrival.distance.max(NEAREST).powi(2),
            )
        }
        LightShape::Sun { direction } => (direction, f64::INFINITY, 1.0),
    };
    let seen = spacetime
        .link(surface.worldline, light.worldline)
        .light(in_lamp);
    Some(Arriving {
        in_lamp,
        in_surface: seen.direction,
        doppler: spacetime.received_ratio(light.worldline, surface.worldline, &seen),
        distance,
        falloff: light.shape.share(in_lamp) / spread,
    })
}
