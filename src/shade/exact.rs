//! `accuracy.spectra = "exact"`: shade trees to channels as exactly as f64 goes.
//!
//! All light along a ray, through its mirrors and glass, is one function of wavelength, made of
//! spectra as their author wrote them, each read under its own shift, and of Planck's law. It is
//! integrated once, by [`Quadrature`], within [`TOLERANCE`](crate::spectrum::quadrature::TOLERANCE)
//! = 1e-10 of the greatest channel: no table, no axis, no f32.
//!
//! Cost: from 3300 evaluations of all light of a ray for XYZ, 0.1 ms where a lamp lights paint, 1 ms
//! where it is thermal too; a grid of 84 wavelengths takes less than a hundredth. For checking
//! others.

use super::curves::CurveShader;
use super::integrand::{Reading, Reflected, Source};
use super::received::{Doppler, finite};
use super::walk::{Lamps, Passage, SpectralBasis, Visit};
use crate::spectrum::Quadrature;
use crate::trace::{Root, ShadeTrees};
use glam::DVec3;

impl CurveShader {
    /// What the camera receives along a ray, in the quadrature's channels.
    pub(super) fn exact(
        &self,
        quadrature: &Quadrature,
        trees: &ShadeTrees,
        root: Root,
    ) -> [f64; 3] {
        let mut ends: Vec<End<'_>> = Vec::with_capacity(root.count as usize);
        let mut cuts = Vec::new();
        for visit in self.walk.visits(trees, root) {
            let way = visit.passage().map(|passage| Way {
                parent: passage.parent,
                share: passage.share,
                passed: self.passed(&passage),
            });
            let sources = self.sources(&visit);
            way.iter().for_each(|way| way.passed.add_cuts(&mut cuts));
            sources.iter().for_each(|source| source.add_cuts(&mut cuts));
            ends.push(End { way, sources });
        }
        match &ends[..] {
            [] => [0.0; 3],
            [only] => quadrature.channels(&mut cuts, |nm| only.at(nm)),
            ends => quadrature.channels(&mut cuts, |nm| through_ways(ends, nm)),
        }
    }

    /// The reflectance or transmittance of a surface on a way, as the camera reads it.
    pub(super) fn passed(&self, passage: &Passage) -> Reading<'_> {
        Reading {
            curve: &self.materials[passage.material].lobes[passage.lobe].reflectance,
            shift: passage.doppler.shift(),
        }
    }

    /// All light of a node as the camera would see it directly.
    pub(super) fn sources(&self, visit: &Visit<'_>) -> Vec<Source<'_>> {
        let mut sources = Sources {
            shader: self,
            sources: Vec::new(),
        };
        visit.add_to(&mut sources);
        sources.sources
    }
}

/// Sources as functions of wavelength.
struct Sources<'a> {
    shader: &'a CurveShader,
    sources: Vec<Source<'a>>,
}

impl SpectralBasis for Sources<'_> {
    fn sky(&mut self, direction: DVec3, doppler: Doppler) {
        let sky = &self.shader.sky;
        sky.add_sources(direction, doppler, &mut self.sources);
    }

    fn emission(&mut self, material: usize, doppler: Doppler) {
        let emission = self.shader.materials[material].emission.as_ref();
        self.sources.extend(emission.map(|emission| Source::Curve {
            factor: doppler.radiance(),
            reading: Reading {
                curve: &emission.curve,
                shift: doppler.shift(),
            },
        }));
    }

    fn thermal(&mut self, material: usize, doppler: Doppler) {
        let thermal = self.shader.materials[material].thermal.as_ref();
        let received = thermal.map(|thermal| Source::Thermal(thermal.received(doppler)));
        self.sources.extend(received);
    }

    /// Lamps of one emitter and shift are one source.
    fn lamps(&mut self, material: usize, doppler: Doppler, lamps: Lamps<'_>) {
        let power = doppler.radiance();
        let surface_shift = doppler.shift();
        let mut groups: Vec<(usize, f64, Vec<f64>)> = Vec::new();
        for lamp in lamps.iter() {
            let shift = lamp.doppler.shift() * surface_shift;
            let scale = finite(lamp.scale * lamp.doppler.irradiance());
            let shares = lamp.weights.iter().map(|weight| finite(scale * weight));
            let group =
                |group: &&mut (usize, f64, Vec<f64>)| (group.0, group.1) == (lamp.emitter, shift);
            match groups.iter_mut().find(group) {
                Some((.., sums)) => sums.iter_mut().zip(shares).for_each(|(sum, share)| {
                    *sum += share;
                }),
                None => groups.push((lamp.emitter, shift, shares.collect())),
            }
        }
        let reflectors = self.shader.materials[material].reflectors();
        for (emitter, shift, shares) in groups {
            let lit = reflectors.iter().zip(shares);
            let lobes = lit.filter(|(_, share)| *share > 0.0);
            let lobes = lobes.map(|(lobe, share)| Reflected {
                factor: finite(finite(share) * power),
                reading: Reading {
                    curve: &lobe.reflectance,
                    shift: surface_shift,
                },
            });
            self.sources.push(Source::Lamp {
                light: Reading {
                    curve: &self.shader.emitters[emitter].curve,
                    shift,
                },
                lobes: lobes.collect(),
            });
        }
    }
}

/// The last surface on a node's way to the camera.
struct Way<'a> {
    /// Its position among the tree's nodes.
    parent: usize,
    /// Share of the light that its lobe is given.
    share: f64,
    /// What the lobe leaves.
    passed: Reading<'a>,
}

/// A node of a tree as light.
struct End<'a> {
    /// None where the camera sees it directly.
    way: Option<Way<'a>>,
    sources: Vec<Source<'a>>,
}

impl End<'_> {
    fn at(&self, nm: f64) -> f64 {
        finite(self.sources.iter().map(|source| source.at(nm)).sum())
    }
}

/// Light of all nodes at a wavelength, each through the mirrors and glass on its way.
fn through_ways(ends: &[End<'_>], nm: f64) -> f64 {
    let mut left = Vec::with_capacity(ends.len());
    let mut sum = 0.0;
    for end in ends {
        // Parents stand before children.
        let share = end.way.as_ref().map_or(1.0, |way| {
            left[way.parent] * (way.share * way.passed.at(nm))
        });
        left.push(share);
        if share > 0.0 {
            sum += share * end.at(nm);
        }
    }
    finite(sum)
}
