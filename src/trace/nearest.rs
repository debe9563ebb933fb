//! Nearest hits over all worldlines: the rays of a wave go to the rest frame of one worldline after
//! the other, as a batch.
//!
//! A point x + s·k of a ray has the same s in every rest frame, so hits on different worldlines
//! compare by s alone.

use super::clock::{Phase, timed};
use super::link::boost_directions;
use super::secondary_ray::{RestRay, SecondaryRay};
use super::spacetime::Spacetime;
use super::tracer::Tracer;
use crate::accel::{Hit, RayBatch, every_instance};
use glam::DVec3;

/// The nearest hit of a ray so far.
#[derive(Clone, Copy)]
pub(super) struct NearestHit {
    /// Length of the light path in the rest frame that the ray starts in.
    pub(super) s: f64,
    pub(super) hit: Hit,
    /// In the rest frame of what was hit: when the light left, the ray's direction, and ω over
    /// what it is where the ray starts.
    pub(super) time: f64,
    pub(super) direction: DVec3,
    pub(super) frequency_ratio: f64,
}

/// Rays of a wave in the rest frame of one worldline, as a structure of arrays.
#[derive(Default)]
pub(super) struct RestRays {
    batch: RayBatch,
    /// Which ray of the wave each is.
    numbers: Vec<u32>,
    /// As in [`RestRay`].
    slownesses: Vec<f64>,
    stretches: Vec<f64>,
    frequency_ratios: Vec<f64>,
    hits: Vec<Option<Hit>>,
}

/// Finds what camera rays of unit `directions` meet first.
pub(super) fn camera_hits(
    tracer: &Tracer<'_>,
    directions: &[DVec3],
    rays: &mut RestRays,
    nearest: &mut Vec<Option<NearestHit>>,
) {
    nearest.clear();
    nearest.resize(directions.len(), None);
    for worldline in tracer.aggregate.worldlines() {
        timed(tracer.clock, Phase::Boost, || {
            rays.set_camera_rays(tracer, worldline, directions);
        });
        timed(tracer.clock, Phase::Traverse, || {
            rays.update(tracer, worldline, nearest);
        });
    }
}

/// Finds what rays from surfaces meet first.
pub(super) fn secondary_hits<'a>(
    tracer: &Tracer<'_>,
    secondary: impl ExactSizeIterator<Item = &'a SecondaryRay> + Clone,
    rays: &mut RestRays,
    nearest: &mut Vec<Option<NearestHit>>,
) {
    nearest.clear();
    nearest.resize(secondary.len(), None);
    for worldline in tracer.aggregate.worldlines() {
        rays.clear();
        for (number, ray) in (0..).zip(secondary.clone()) {
            if let Some(ray) = ray.among(worldline, tracer.spacetime) {
                rays.push(number, &ray);
            }
        }
        rays.update(tracer, worldline, nearest);
    }
}

impl RestRays {
    fn clear(&mut self) {
        self.batch.clear();
        self.numbers.clear();
        self.slownesses.clear();
        self.stretches.clear();
        self.frequency_ratios.clear();
    }

    fn push(&mut self, number: u32, ray: &RestRay) {
        self.batch.push(ray.origin, ray.direction, f64::INFINITY);
        self.numbers.push(number);
        self.slownesses.push(ray.slowness);
        self.stretches.push(ray.stretch);
        self.frequency_ratios.push(ray.frequency_ratio);
    }

    /// The rays of the camera in the rest frame of `worldline`.
    fn set_camera_rays(&mut self, tracer: &Tracer<'_>, worldline: usize, directions: &[DVec3]) {
        let (spacetime, count) = (tracer.spacetime, directions.len());
        self.clear();
        let link = spacetime.link(worldline, tracer.scene.camera.worldline);
        boost_directions(
            link,
            directions,
            &mut self.batch.directions,
            &mut self.frequency_ratios,
        );
        let ratios = self.frequency_ratios.iter();
        let stretches = ratios.map(|&ratio| spacetime.path_ratio(ratio));
        self.stretches.extend(stretches);
        let origin = spacetime.camera_event(worldline);
        self.batch.origins.resize(count, origin);
        self.batch.reaches.resize(count, f64::INFINITY);
        self.slownesses.resize(count, 1.0);
        self.numbers.extend(0..count as u32);
    }

    /// Replaces the nearest hits by nearer ones among the bodies of `worldline`.
    fn update(
        &mut self,
        tracer: &Tracer<'_>,
        worldline: usize,
        nearest: &mut [Option<NearestHit>],
    ) {
        let stretches = self.numbers.iter().zip(&self.stretches);
        for (reach, (&number, &stretch)) in self.batch.reaches.iter_mut().zip(stretches) {
            if let Some(found) = &nearest[number as usize] {
                *reach = found.s * stretch;
            }
        }
        tracer
            .aggregate
            .intersect(worldline, &self.batch, every_instance, &mut self.hits);
        for (ray, hit) in self.hits.iter().enumerate() {
            if let Some(hit) = hit {
                let best = &mut nearest[self.numbers[ray] as usize];
                self.keep_nearer(ray, hit, tracer.spacetime, best);
            }
        }
    }

    #[inline(always)]
    fn keep_nearer(
        &self,
        ray: usize,
        hit: &Hit,
        spacetime: &Spacetime,
        best: &mut Option<NearestHit>,
    ) {
        let s = hit.t / self.stretches[ray];
        if best.as_ref().is_none_or(|best| s < best.s) {
            let delay = spacetime.delay(self.slownesses[ray] * hit.t);
            *best = Some(NearestHit {
                s,
                hit: *hit,
                time: self.batch.origins[ray].t - delay,
                direction: self.batch.directions[ray],
                frequency_ratio: self.frequency_ratios[ray],
            });
        }
    }
}
