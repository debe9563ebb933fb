//! Shade trees to channels as exactly as f64 goes: `accuracy.spectra = "exact"`.
//!
//! All light along a ray, through its mirrors and glass, is one function of wavelength, made of
//! spectra as their author wrote them, each read under its own shift, and of Planck's law. It is
//! summed once, by [`Quadrature`], within [`TOLERANCE`](crate::spectrum::quadrature::TOLERANCE)
//! = 1e-10 of the greatest channel: no table, no axis, no f32.
//!
//! Cost: from 3300 readings of all light of a ray for XYZ, 0.1 ms where a lamp lights paint, 1 ms
//! where it glows too; a grid of 84 wavelengths takes less than a hundredth. For checking others.

use super::curve::Curve;
use super::curves::CurveShader;
use super::received::finite;
use super::thermal::SeenGlow;
use crate::spectrum::quadrature::cuts_nm;
use crate::spectrum::{ColoredLight, Quadrature, planck};
use crate::trace::{Node, Root, Seen, ShadeTrees, Surface};

impl CurveShader {
    /// What the camera receives along a ray, in the quadrature's channels.
    pub(super) fn exact(
        &self,
        quadrature: &Quadrature,
        trees: &ShadeTrees,
        root: Root,
    ) -> [f64; 3] {
        let nodes = trees.nodes_of(root);
        let mut ends: Vec<End<'_>> = Vec::with_capacity(nodes.len());
        let mut cuts = Vec::new();
        for node in nodes {
            let end = End {
                way: self.way(nodes, node),
                sources: self.sources(trees, node),
            };
            end.way.iter().for_each(|way| way.add_cuts(&mut cuts));
            end.sources
                .iter()
                .for_each(|source| source.add_cuts(&mut cuts));
            ends.push(end);
        }
        match &ends[..] {
            [] => [0.0; 3],
            [only] => quadrature.channels(&mut cuts, |nm| only.at(nm)),
            ends => quadrature.channels(&mut cuts, |nm| through_ways(ends, nm)),
        }
    }

    /// The last surface on a node's way to the camera; None where the camera sees it directly.
    fn way(&self, nodes: &[Node], node: &Node) -> Option<Way<'_>> {
        let branch = node.branch?;
        let by = &nodes[branch.parent as usize];
        let curve = match by.seen {
            Seen::Surface(surface) => {
                Some(self.surfaces[surface.material as usize].passing(branch.lobe))
            }
            Seen::Sky(_) => None,
        };
        Some(Way {
            parent: branch.parent as usize,
            share: branch.share,
            passed: curve.map(|curve| Reading {
                curve,
                shift: self.received.shift(by.doppler),
            }),
        })
    }

    /// All light of a node as the camera would see it directly.
    pub(super) fn sources(&self, trees: &ShadeTrees, node: &Node) -> Vec<Source<'_>> {
        let mut sources = Vec::new();
        let doppler = node.doppler;
        match &node.seen {
            Seen::Sky(direction) => {
                self.sky
                    .add_sources(*direction, doppler, self.received, &mut sources);
            }
            Seen::Surface(surface) => {
                let curves = &self.surfaces[surface.material as usize];
                if let Some(emission) = &curves.emission {
                    sources.push(Source::Curve {
                        factor: self.received.radiance(doppler),
                        reading: Reading {
                            curve: &emission.curve,
                            shift: self.received.shift(doppler),
                        },
                    });
                }
                if let Some(glow) = &curves.glow {
                    sources.push(Source::Glow(glow.seen(doppler, self.received)));
                }
                self.add_lamps(trees, surface, doppler, &mut sources);
            }
        }
        sources
    }

    /// Adds the light of a surface's lamps: those of one emitter and shift once.
    fn add_lamps<'a>(
        &'a self,
        trees: &ShadeTrees,
        surface: &Surface,
        doppler: f64,
        sources: &mut Vec<Source<'a>>,
    ) {
        let own = &self.surfaces[surface.material as usize];
        let power = self.received.radiance(doppler);
        let surface_shift = self.received.shift(doppler);
        let lobes = own.reflecting();
        let mut groups: Vec<(usize, f64, Vec<f64>)> = Vec::new();
        for lit in trees.lamps_on(surface) {
            let (emitter, scale) = self.lamps[lit.light as usize];
            let shift = self.received.shift(lit.doppler) * surface_shift;
            let scale = finite(scale * self.received.irradiance(lit.doppler));
            let weights = trees.weights_of(lit, lobes.len()).iter();
            let shares = weights.map(|weight| finite(scale * weight));
            match groups.iter_mut().find(|g| (g.0, g.1) == (emitter, shift)) {
                Some((.., sums)) => sums
                    .iter_mut()
                    .zip(shares)
                    .for_each(|(sum, share)| *sum += share),
                None => groups.push((emitter, shift, shares.collect())),
            }
        }
        for (emitter, shift, shares) in groups {
            let lit = lobes.iter().zip(shares).filter(|(_, share)| *share > 0.0);
            let terms = lit.map(|(lobe, share)| Reflected {
                factor: finite(finite(share) * power),
                reading: Reading {
                    curve: &lobe.reflectance,
                    shift: surface_shift,
                },
            });
            sources.push(Source::Lit {
                light: Reading {
                    curve: &self.emitters[emitter].curve,
                    shift,
                },
                terms: terms.collect(),
            });
        }
    }
}

/// A curve under a shift.
#[derive(Clone, Copy)]
pub(super) struct Reading<'a> {
    pub(super) curve: &'a Curve,
    pub(super) shift: f64,
}

impl Reading<'_> {
    pub(super) fn at(&self, nm: f64) -> f64 {
        self.curve.at(self.shift * nm)
    }

    pub(super) fn add_cuts(&self, cuts: &mut Vec<f64>) {
        cuts_nm(self.curve.spectrum(), self.shift, cuts);
    }
}

/// Spectral radiance, W·m⁻²·sr⁻¹·nm⁻¹, as the camera would see it directly.
pub(super) enum Source<'a> {
    /// A factor times a curve.
    Curve { factor: f64, reading: Reading<'a> },
    /// A surface's thermal light.
    Glow(SeenGlow<'a>),
    /// A star: a factor times a black body.
    BlackBody { factor: f64, kelvin: f64 },
    /// A sky image's colour times D65.
    Painted {
        factor: f64,
        light: ColoredLight,
        d65: Reading<'a>,
    },
    /// Lamps of one spectrum and shift, reflected by the surface's lobes.
    Lit {
        light: Reading<'a>,
        terms: Vec<Reflected<'a>>,
    },
}

/// A term of a surface under lamps.
pub(super) struct Reflected<'a> {
    pub(super) factor: f64,
    pub(super) reading: Reading<'a>,
}

impl Source<'_> {
    fn at(&self, nm: f64) -> f64 {
        match self {
            Self::Curve { factor, reading } => factor * reading.at(nm),
            Self::Glow(glow) => glow.at(nm),
            Self::BlackBody { factor, kelvin } => factor * planck::radiance(nm, *kelvin),
            Self::Painted { factor, light, d65 } => {
                finite(factor * d65.at(nm)) * light.at(d65.shift * nm)
            }
            Self::Lit { light, terms } => {
                let light = light.at(nm);
                terms
                    .iter()
                    .map(|term| finite(term.factor * light) * term.reading.at(nm))
                    .sum()
            }
        }
    }

    /// Of what is no product of curves alone, what they leave: [`Source::at`] over an emissivity, or all.
    pub(super) fn rest_at(&self, nm: f64) -> f64 {
        match self {
            Self::Glow(glow) => glow.black_at(nm),
            Self::BlackBody { .. } | Self::Painted { .. } => self.at(nm),
            Self::Curve { .. } | Self::Lit { .. } => 1.0,
        }
    }

    fn add_cuts(&self, cuts: &mut Vec<f64>) {
        match self {
            Self::Curve { reading, .. } => reading.add_cuts(cuts),
            Self::Glow(glow) => cuts_nm(glow.emissivity.spectrum(), glow.shift, cuts),
            Self::BlackBody { .. } => {}
            Self::Painted { d65, .. } => {
                d65.add_cuts(cuts);
                cuts.extend(ColoredLight::SUPPORT_NM.map(|nm| nm / d65.shift));
            }
            Self::Lit { light, terms } => {
                light.add_cuts(cuts);
                terms.iter().for_each(|term| term.reading.add_cuts(cuts));
            }
        }
    }
}

/// A surface by way of which something is seen.
struct Way<'a> {
    /// Its position among the tree's nodes.
    parent: usize,
    /// Share of the light that its term is given.
    share: f64,
    /// What the term leaves; None where it leaves nothing.
    passed: Option<Reading<'a>>,
}

impl Way<'_> {
    fn at(&self, nm: f64) -> f64 {
        let passed = self.passed.as_ref().map_or(0.0, |reading| reading.at(nm));
        self.share * passed
    }

    fn add_cuts(&self, cuts: &mut Vec<f64>) {
        self.passed
            .iter()
            .for_each(|reading| reading.add_cuts(cuts));
    }
}

/// A node of a tree as light.
struct End<'a> {
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
        let share = end
            .way
            .as_ref()
            .map_or(1.0, |way| left[way.parent] * way.at(nm));
        left.push(share);
        if share > 0.0 {
            sum += share * end.at(nm);
        }
    }
    finite(sum)
}
