//! Pixels: rays traced, shaded and averaged, a piece of a row at a time.

use super::band::Part;
use super::left_out::light;
use super::options::{Stopped, Watch};
use super::profile::PhaseTimes;
use super::{LabPath, Options, View};
use crate::shade::ShadeScratch;
use crate::shot::Layer;
use crate::trace::{Node, Samples, Scratch, Seen, ShadeTrees, Tracer};
use glam::DVec3;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// Number of rays that are traced together, so that their scratch memory stays in the second-level
/// cache.
const RAYS: u32 = 2048;
/// The same if each ray may grow a tree of a thousand nodes of about 100 bytes.
const RAYS_WITH_TREES: u32 = 256;
/// Number of rays shaded between two checks for a stop: milliseconds even by quadrature.
const RAYS_BETWEEN_LOOKS: usize = 64;
/// Number of pairs of surface and lamp among rays traced together at most, so that a check for a
/// stop comes after milliseconds even with ten thousand lamps.
const LAMPS: usize = 1 << 16;

/// A row of pixels.
pub(super) struct Row<'a> {
    pub(super) number: u32,
    pub(super) in_band: usize,
    pub(super) options: &'a Options,
    pub(super) samples: &'a Samples,
}

impl Row<'_> {
    /// The direction of sample `index` of pixel `x`; None if the projection has no ray there.
    #[inline(always)]
    fn looks_along(&self, view: &View<'_>, x: u32, index: u32) -> Option<DVec3> {
        let [width, height] = [self.options.width, self.options.height].map(f64::from);
        let [dx, dy] = self.samples.position(x, self.number, index);
        let point = [
            (f64::from(x) + dx) / width,
            (f64::from(self.number) + dy) / height,
        ];
        view.scene().camera.looks_along(point)
    }

    /// Index of pixel `x` in its band.
    fn place(&self, x: u32) -> usize {
        self.in_band * self.options.width as usize + x as usize
    }

    /// The index, among the `rays` of pixel `x`, of the ray of one of their samples, if it has one.
    fn ray_of(
        &self,
        view: &View<'_>,
        x: u32,
        sample: u32,
        (samples, rays): (&Range<u32>, &Range<usize>),
    ) -> Option<usize> {
        let before = samples.start..sample;
        if rays.len() == samples.len() {
            return Some(rays.start + before.len());
        }
        // Few pixels are at the edge of a projection: the camera is asked again which samples have
        // no ray.
        let has_ray = |&index: &u32| self.looks_along(view, x, index).is_some();
        has_ray(&sample).then(|| rays.start + before.filter(has_ray).count())
    }

    /// The sample of pixel `x` nearest to its center, whose surface the layers describe.
    fn central_sample(&self, x: u32) -> u32 {
        let off = |index: u32| {
            let [dx, dy] = self.samples.position(x, self.number, index);
            (dx - 0.5).powi(2) + (dy - 0.5).powi(2)
        };
        (0..self.samples.count())
            .min_by(|&a, &b| off(a).total_cmp(&off(b)))
            .unwrap_or(0)
    }
}

/// Samples that are traced together and then shaded for each image: all those of some pixels of a
/// row, or a part of those of one.
struct Piece {
    pixels: Range<u32>,
    samples: Range<u32>,
}

impl Piece {
    /// The pieces of a row of `width` pixels, of at most `rays` rays each.
    fn of_row(width: u32, samples: u32, rays: u32) -> impl Iterator<Item = Self> {
        let pixels = (rays / samples).max(1);
        (0..width).step_by(pixels as usize).flat_map(move |first| {
            (0..samples)
                .step_by(rays.min(samples) as usize)
                .map(move |begin| Self {
                    pixels: first..width.min(first + pixels),
                    samples: begin..samples.min(begin + rays),
                })
        })
    }

    fn rays(&self) -> u64 {
        self.pixels.len() as u64 * self.samples.len() as u64
    }
}

/// Scratch memory of one thread.
#[derive(Default)]
pub(super) struct Painter {
    /// Directions of the samples that have a ray, pixel by pixel.
    directions: Vec<DVec3>,
    /// The pixels of a piece: their columns, and the range of their directions.
    pixels: Vec<(u32, Range<usize>)>,
    scratch: Scratch,
    trees: ShadeTrees,
    shading: ShadeScratch,
    /// For a pixel whose samples are spread over several pieces, its light so far in each image.
    sums: Vec<[f64; 3]>,
    /// For the same pixel, its sample nearest to the center.
    central: u32,
    /// Seconds of tracing and of shading.
    pub(super) seconds: [f64; 2],
    /// Seconds by phase, if they are counted.
    pub(super) phase_times: Option<PhaseTimes>,
}

impl Painter {
    /// Renders a row of images that all use the trees of the first.
    pub(super) fn paint(
        &mut self,
        views: &[&View<'_>],
        row: &Row<'_>,
        parts: &mut [Part<'_>],
        watch: Watch<'_>,
    ) -> Result<(), Stopped> {
        self.sums.resize(views.len(), [0.0; 3]);
        let (lead, rays) = (views[0], rays_at_once(views[0]));
        for piece in Piece::of_row(row.options.width, row.samples.count(), rays) {
            go_on(watch.stop)?;
            let begun = Instant::now();
            self.trace(lead, row, &piece);
            let traced = Instant::now();
            self.write_layers(lead, row, &piece, &mut parts[0]);
            for (image, (view, part)) in views.iter().zip(&mut *parts).enumerate() {
                let image = (image, *view, part);
                self.shade(image, row, &piece, watch.stop)?;
            }
            let shading = traced.elapsed().as_secs_f64();
            self.seconds[0] += (traced - begun).as_secs_f64();
            self.seconds[1] += shading;
            if let Some(phase_times) = &mut self.phase_times {
                phase_times.shade += shading;
            }
            (watch.done)(piece.rays() * views.len() as u64);
        }
        Ok(())
    }

    fn trace(&mut self, view: &View<'_>, row: &Row<'_>, piece: &Piece) {
        let begun = self.phase_times.as_ref().map(|_| Instant::now());
        self.directions.clear();
        self.pixels.clear();
        for x in piece.pixels.clone() {
            let first = self.directions.len();
            for index in piece.samples.clone() {
                if let Some(direction) = row.looks_along(view, x, index) {
                    self.directions.push(direction);
                }
            }
            self.pixels.push((x, first..self.directions.len()));
        }
        self.trees.clear();
        if let (Some(phase_times), Some(begun)) = (&mut self.phase_times, begun) {
            phase_times.aim += begun.elapsed().as_secs_f64();
        }
        let tracer = Tracer {
            clock: self
                .phase_times
                .as_ref()
                .map(|phase_times| &phase_times.clock),
            ..view.tracer()
        };
        tracer.trace(&self.directions, &mut self.scratch, &mut self.trees);
    }

    /// Writes the mean over all samples of each pixel; samples without a ray are black.
    fn shade(
        &mut self,
        (image, view, part): (usize, &View<'_>, &mut Part<'_>),
        row: &Row<'_>,
        piece: &Piece,
        stop: &AtomicBool,
    ) -> Result<(), Stopped> {
        let count = row.samples.count();
        for (x, rays) in &self.pixels {
            let mut sum = match piece.samples.start {
                0 => [0.0; 3],
                _ => self.sums[image],
            };
            for ray in rays.clone() {
                if ray % RAYS_BETWEEN_LOOKS == 0 {
                    go_on(stop)?;
                }
                let root = self.trees.roots[ray];
                let xyz = view.shader().xyz(&self.trees, root, &mut self.shading);
                if root.cut > 0.0 && view.branches() {
                    let light = light(part.channels, xyz);
                    part.left_out.add_cut(root.cut, light);
                }
                for (sum, value) in sum.iter_mut().zip(xyz) {
                    *sum += value;
                }
            }
            if piece.samples.end == count {
                // Values that f32 cannot hold are counted when the film is developed.
                part.left_out.add_rays(count, light(part.channels, sum));
                part.xyz[row.place(*x)] = sum.map(|v| (v / f64::from(count)) as f32);
            } else {
                self.sums[image] = sum;
            }
        }
        Ok(())
    }

    /// Writes the layers of pixels whose central samples are in the piece.
    fn write_layers(&mut self, view: &View<'_>, row: &Row<'_>, piece: &Piece, part: &mut Part<'_>) {
        if part.layers.is_empty() {
            return;
        }
        for (x, rays) in &self.pixels {
            if piece.samples.start == 0 {
                self.central = row.central_sample(*x);
            }
            if piece.samples.contains(&self.central) {
                let of = (&piece.samples, rays);
                if let Some(ray) = row.ray_of(view, *x, self.central, of) {
                    self.write_surface(view, ray, row.place(*x), part);
                }
            }
        }
    }

    /// Writes the layers for the first surface that a ray meets, if any.
    fn write_surface(&self, view: &View<'_>, ray: usize, at: usize, part: &mut Part<'_>) {
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
                // On a covered pixel it is above 0, even at the end of f32's range.
                Layer::Doppler => doppler.max(f64::from(f32::MIN_POSITIVE)),
                Layer::Distance => path.distance,
                Layer::EmissionTime => path.emission.t,
                Layer::Worldline => f64::from(
                    view.scene().geometry.instances[surface.hit.instance as usize].worldline,
                ),
            }
            .clamp(f64::from(f32::MIN), f64::from(f32::MAX)) as f32;
        }
    }
}

/// Number of rays that are traced together.
fn rays_at_once(view: &View<'_>) -> u32 {
    let most = if view.branches() {
        RAYS_WITH_TREES
    } else {
        RAYS
    };
    let lamps = view.scene().lights.len().max(1);
    most.min((LAMPS / lamps).max(1) as u32)
}

fn go_on(stop: &AtomicBool) -> Result<(), Stopped> {
    if stop.load(Ordering::Relaxed) {
        Err(Stopped)
    } else {
        Ok(())
    }
}
