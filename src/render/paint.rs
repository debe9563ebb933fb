//! Pixels: their rays traced, shaded and averaged, a band of rows at a time.

use super::profile::Lap;
use super::{LabPath, Options, View};
use crate::film::{Channels, Film, Layers};
use crate::shade::ShadeScratch;
use crate::shot::Layer;
use crate::trace::{Node, Samples, Scratch, Seen, ShadeTrees, Tracer};
use glam::DVec3;
use std::ops::Range;
use std::time::Instant;

/// Rows of pixels that one thread takes at a time.
pub(super) const BAND: usize = 8;
/// Rays that are boosted and traced together: their scratch memory stays in the second cache.
const RAYS: u32 = 2048;
/// The same where each ray may grow a tree of a thousand nodes, some 100 bytes each.
const RAYS_WITH_TREES: u32 = 256;

/// What one band of rows writes to.
pub(super) struct Part<'a> {
    xyz: &'a mut [[f32; 3]],
    layers: Vec<(Layer, &'a mut [f32])>,
}

pub(super) fn empty_film(options: &Options, channels: Channels) -> Film {
    let pixels = options.width as usize * options.height as usize;
    let layer = |which: Layer, background: f32| {
        options
            .layers
            .contains(&which)
            .then(|| vec![background; pixels])
    };
    Film {
        width: options.width,
        height: options.height,
        channels,
        xyz: vec![[0.0; 3]; pixels],
        layers: Layers {
            doppler: layer(Layer::Doppler, 0.0),
            distance: layer(Layer::Distance, 0.0),
            emission_time: layer(Layer::EmissionTime, 0.0),
            worldline: layer(Layer::Worldline, -1.0),
        },
    }
}

pub(super) fn split_bands(film: &mut Film, bands: usize) -> Vec<Part<'_>> {
    let size = film.width as usize * BAND;
    let mut parts: Vec<Part<'_>> = film
        .xyz
        .chunks_mut(size)
        .map(|xyz| Part {
            xyz,
            layers: Vec::new(),
        })
        .collect();
    debug_assert_eq!(parts.len(), bands);
    let layers = &mut film.layers;
    for (which, layer) in [
        (Layer::Doppler, &mut layers.doppler),
        (Layer::Distance, &mut layers.distance),
        (Layer::EmissionTime, &mut layers.emission_time),
        (Layer::Worldline, &mut layers.worldline),
    ] {
        for (part, values) in parts
            .iter_mut()
            .zip(layer.iter_mut().flat_map(|l| l.chunks_mut(size)))
        {
            part.layers.push((which, values));
        }
    }
    parts
}

/// A row of pixels.
pub(super) struct Row<'a> {
    pub(super) number: u32,
    pub(super) in_band: usize,
    pub(super) options: &'a Options,
}

impl Row<'_> {
    /// The direction of sample `index` of pixel `x`, where the camera looks anywhere in it.
    #[inline(always)]
    fn looks_along(&self, view: &View<'_>, samples: &Samples, x: u32, index: u32) -> Option<DVec3> {
        let [width, height] = [self.options.width, self.options.height].map(f64::from);
        let [dx, dy] = samples.position(x, self.number, index);
        let point = [
            (f64::from(x) + dx) / width,
            (f64::from(self.number) + dy) / height,
        ];
        view.scene.camera.looks_along(point)
    }
}

/// One thread's memory.
#[derive(Default)]
pub(super) struct Painter {
    /// Of the samples that see something, pixel by pixel.
    directions: Vec<DVec3>,
    /// Where the directions of each pixel end.
    ends: Vec<usize>,
    scratch: Scratch,
    trees: ShadeTrees,
    shading: ShadeScratch,
    /// Where seconds are counted, if anywhere.
    pub(super) lap: Option<Lap>,
}

impl Painter {
    /// Renders a row, some pixels at a time.
    pub(super) fn paint(
        &mut self,
        view: &View<'_>,
        samples: &Samples,
        row: &Row<'_>,
        part: &mut Part<'_>,
    ) {
        let width = row.options.width;
        let rays = if view.branches() {
            RAYS_WITH_TREES
        } else {
            RAYS
        };
        let step = (rays / samples.count()).max(1);
        for first in (0..width).step_by(step as usize) {
            let pixels = first..(first + step).min(width);
            self.trace(view, samples, row, pixels.clone());
            let begun = self.lap.as_ref().map(|_| Instant::now());
            let mut start = 0;
            for (index, x) in pixels.enumerate() {
                let rays = start..self.ends[index];
                start = rays.end;
                let at = row.in_band * width as usize + x as usize;
                part.xyz[at] = self.mean_xyz(view, rays.clone(), samples.count());
                if !part.layers.is_empty()
                    && let Some(central) = central_ray(view, samples, row, x, rays)
                {
                    self.write_layers(view, central, at, part);
                }
            }
            if let (Some(lap), Some(begun)) = (&mut self.lap, begun) {
                lap.shade += begun.elapsed().as_secs_f64();
            }
        }
    }

    fn trace(&mut self, view: &View<'_>, samples: &Samples, row: &Row<'_>, pixels: Range<u32>) {
        let begun = self.lap.as_ref().map(|_| Instant::now());
        self.directions.clear();
        self.ends.clear();
        for x in pixels {
            for index in 0..samples.count() {
                if let Some(direction) = row.looks_along(view, samples, x, index) {
                    self.directions.push(direction);
                }
            }
            self.ends.push(self.directions.len());
        }
        self.trees.clear();
        if let (Some(lap), Some(begun)) = (&mut self.lap, begun) {
            lap.aim += begun.elapsed().as_secs_f64();
        }
        let tracer = Tracer {
            clock: self.lap.as_ref().map(|lap| &lap.clock),
            ..view.tracer()
        };
        tracer.trace(&self.directions, &mut self.scratch, &mut self.trees);
    }

    /// The mean over all samples of a pixel: those of them that have no ray are black.
    fn mean_xyz(&mut self, view: &View<'_>, rays: Range<usize>, samples: u32) -> [f32; 3] {
        let count = f64::from(samples);
        let mut sum = [0.0; 3];
        for ray in rays {
            let xyz = view
                .shader
                .xyz(&self.trees, self.trees.roots[ray], &mut self.shading);
            for (sum, value) in sum.iter_mut().zip(xyz) {
                *sum += value;
            }
        }
        // What f32 cannot hold is counted when the film is developed.
        sum.map(|v| (v / count) as f32)
    }

    fn write_layers(&self, view: &View<'_>, ray: usize, at: usize, part: &mut Part<'_>) {
        let Some(Node {
            seen: Seen::Surface(surface),
            doppler,
            ..
        }) = self.trees.nodes_of(self.trees.roots[ray]).first()
        else {
            return;
        };
        let path = LabPath::new(view, surface, self.directions[ray]);
        for (layer, values) in &mut part.layers {
            values[at] = match layer {
                // On a covered pixel it is above 0, also where f32 is at its end.
                Layer::Doppler => doppler.max(f64::from(f32::MIN_POSITIVE)),
                Layer::Distance => path.distance,
                Layer::EmissionTime => path.emission.t,
                Layer::Worldline => f64::from(
                    view.scene.geometry.instances[surface.hit.instance as usize].worldline,
                ),
            }
            .clamp(f64::from(f32::MIN), f64::from(f32::MAX)) as f32;
        }
    }
}

/// Which of a pixel's `rays` belongs to the sample nearest to its centre, if that one has a ray.
fn central_ray(
    view: &View<'_>,
    samples: &Samples,
    row: &Row<'_>,
    x: u32,
    rays: Range<usize>,
) -> Option<usize> {
    let central = central_sample(samples, x, row.number);
    if rays.len() == samples.count() as usize {
        return Some(rays.start + central as usize);
    }
    // Few pixels are at the edge of what is seen: the camera is asked again which samples lack.
    let has_ray = |&index: &u32| row.looks_along(view, samples, x, index).is_some();
    has_ray(&central).then(|| rays.start + (0..central).filter(has_ray).count())
}

/// The sample nearest to the pixel's centre, whose surface the layers describe.
fn central_sample(samples: &Samples, x: u32, y: u32) -> u32 {
    let off = |index: u32| {
        let [dx, dy] = samples.position(x, y, index);
        (dx - 0.5).powi(2) + (dy - 0.5).powi(2)
    };
    (0..samples.count())
        .min_by(|&a, &b| off(a).total_cmp(&off(b)))
        .unwrap_or(0)
}
