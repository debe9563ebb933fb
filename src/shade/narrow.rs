//! Light of curves that are narrower than the wavelengths are apart: lines of lamps and of what
//! glows, narrow filters, spiky tables.
//!
//! The channels of one such curve, and of a lamp's light on a paint that moves with it, are
//! tabulated over ln D from integrals ([`Fine`]). Where one is met by smooth curves under other
//! shifts, its lines are a few points ([`Sparse`]) and the rest of it stands for the sensor's
//! weights ([`Responses`]). Where two meet under shifts of their own they are integrated as their
//! authors wrote them, over what they share; if that is much, one is read by its means
//! ([`unresolved`](super::unresolved())).

use super::curve::write_shape;
use super::curves::{CurveShader, add};
use super::exact::{Reading, Source};
use super::received::finite;
use super::table::{XyzTable, interesting};
use crate::spectrum::{Fine, FineSensor, Responses, Sparse, Spectrum};
use crate::trace::{Node, Seen, ShadeTrees};
use std::sync::{Arc, OnceLock};

/// How many widths from its center a gaussian ends where it meets another narrow curve: 2e-11 of
/// the peak.
const REACH: f64 = 7.0;

/// Widest range, in spacings of the axis, over which narrow curves that meet are integrated for a
/// ray; of wider ones, tables with narrow bands all over, one is read by its means.
const WIDEST: f64 = 16.0;

/// A narrow curve, ready to be seen under any shift.
pub(super) struct Narrow {
    fine: Fine,
    /// Its lines, and what is left without them.
    parts: OnceLock<(Option<Sparse>, Option<Responses>)>,
    sensor: Arc<FineSensor>,
    /// The range of ln D in which it changes what is seen.
    range: [f64; 2],
    /// Where all its light lies, nm; None if some goes on beyond its last point.
    extent_nm: Option<[f64; 2]>,
}

impl Narrow {
    /// Of a spectrum held as `fine`, for |ln D| up to `reach`.
    pub(super) fn new(
        fine: Fine,
        spectrum: &Spectrum,
        reach: f64,
        sensor: Arc<FineSensor>,
    ) -> Self {
        let range = interesting(sensor.axis(), reach, spectrum.support_nm());
        let extent_nm = match *spectrum {
            Spectrum::Gaussian {
                center_nm,
                width_nm,
            } => Some([-REACH, REACH].map(|widths| (center_nm + widths * width_nm).max(0.0))),
            _ => spectrum.support_nm().filter(|_| fine.ends_dark()),
        };
        Self {
            fine,
            parts: OnceLock::new(),
            sensor,
            range,
            extent_nm,
        }
    }

    /// The sensor's channels over ln D up to `reach`, unless they are too many; `support_nm` is where
    /// it is not constant.
    pub(super) fn table(&self, reach: f64, support_nm: Option<[f64; 2]>) -> Option<XyzTable> {
        XyzTable::fits(self.sensor.axis(), reach, support_nm)
            .then(|| XyzTable::of_fine(&self.sensor, &self.fine, reach, support_nm))
    }

    /// The wavelength of a place in nodes of the axis, nm.
    pub(super) fn wavelength_nm(&self, node: f64) -> f64 {
        self.sensor.wavelength_nm(node)
    }

    /// The channels of the curve under a shift, times what is smooth: `at` gives it by the place of a
    /// wavelength in nodes of the axis; `write` writes it over the axis, into `shape`, and returns
    /// its factor.
    #[inline]
    pub(super) fn times(
        &self,
        ln_shift: f64,
        at: impl Fn(f64) -> f64,
        shape: &mut [f32],
        write: impl FnOnce(&mut [f32]) -> f64,
    ) -> [f64; 3] {
        let (lines, left) = self.parts();
        let mut sum = [0.0; 3];
        if let Some(lines) = lines {
            sum = self.sensor.through(lines, ln_shift, at);
        }
        if let Some(left) = left {
            let factor = write(shape);
            add(&mut sum, left.channels(ln_shift, shape), factor);
        }
        sum
    }

    /// Made where a ray first asks for them.
    fn parts(&self) -> &(Option<Sparse>, Option<Responses>) {
        self.parts.get_or_init(|| {
            let (lines, left) = Sparse::split(self.fine.clone());
            match left {
                Some(left) if !Responses::fits(self.sensor.axis(), self.range) => {
                    (Some(Sparse::with_all(lines, &left)), None)
                }
                left => {
                    let rows = |left| Responses::new(&self.sensor, &left, self.range);
                    (lines, left.map(rows))
                }
            }
        })
    }

    /// Where all its light lies, nm; None if some goes on beyond its last point.
    pub(super) fn extent_nm(&self) -> Option<[f64; 2]> {
        self.extent_nm
    }

    /// Memory of what it is held as, bytes.
    pub(super) fn bytes(&self) -> usize {
        let left = self.parts.get().and_then(|(_, left)| left.as_ref());
        self.fine.bytes() + left.map_or(0, Responses::bytes)
    }
}

impl CurveShader {
    /// The channels of the product of two narrow curves under shifts of their own.
    pub(super) fn meeting(&self, one: &Reading<'_>, other: &Reading<'_>) -> [f64; 3] {
        let product = product(1.0, vec![*one, *other], None);
        self.product_channels(&product)
    }

    /// The same where they share too much to be integrated together for a ray; None where they are.
    pub(super) fn apart(&self, one: &Reading<'_>, other: &Reading<'_>) -> Option<[f64; 3]> {
        let product = product(1.0, vec![*one, *other], None);
        let shared = self.shared(&[one, other], &product);
        shared.is_none().then(|| self.product_channels(&product))
    }

    /// Light of a node by way of mirrors and glass that color it, where some of the curves are
    /// narrow.
    pub(super) fn narrow_node(&self, trees: &ShadeTrees, nodes: &[Node], node: &Node) -> [f64; 3] {
        let mut way = Vec::new();
        let mut share = 1.0;
        let mut at = node;
        while let Some(branch) = &at.branch {
            let by = &nodes[branch.parent as usize];
            let Seen::Surface(surface) = by.seen else {
                return [0.0; 3];
            };
            let curve = self.surfaces[surface.material as usize].passing(branch.lobe);
            share *= branch.share;
            way.push(Reading {
                curve,
                shift: self.received.shift(by.doppler),
            });
            at = by;
        }
        let mut sum = [0.0; 3];
        for source in &self.sources(trees, node) {
            for mut product in products(source) {
                product.factor = finite(product.factor * share);
                product.readings.extend(&way);
                add(&mut sum, self.product_channels(&product), 1.0);
            }
        }
        sum.map(finite)
    }

    /// Whether light of a node, or its way to the camera, has to do with narrow curves.
    pub(super) fn is_narrow(&self, trees: &ShadeTrees, nodes: &[Node], node: &Node) -> bool {
        let own = match &node.seen {
            Seen::Sky(_) => self
                .sky
                .constant()
                .is_some_and(|sight| sight.curve.narrow().is_some()),
            Seen::Surface(surface) => {
                let lit = trees.lamps_on(surface).iter().any(|lit| {
                    let (emitter, _) = self.lamps[lit.light as usize];
                    self.emitters[emitter].curve.narrow().is_some()
                });
                lit || self.surfaces[surface.material as usize].narrow
            }
        };
        let way = std::iter::successors(node.branch.as_ref(), |branch| {
            nodes[branch.parent as usize].branch.as_ref()
        });
        own || way
            .filter_map(|branch| match nodes[branch.parent as usize].seen {
                Seen::Surface(surface) => {
                    Some(self.surfaces[surface.material as usize].passing(branch.lobe))
                }
                Seen::Sky(_) => None,
            })
            .any(|curve| curve.narrow().is_some())
    }

    fn product_channels(&self, product: &Product<'_>) -> [f64; 3] {
        let (narrow, smooth): (Vec<_>, Vec<_>) = product
            .readings
            .iter()
            .partition(|reading| reading.curve.narrow().is_some());
        if narrow.len() > 1
            && let Some(channels) = self.shared(&narrow, product)
        {
            return channels;
        }
        let axis = self.sensor.axis();
        let mut shape = vec![0.0; axis.count()];
        let others = match narrow[..] {
            [] => &[],
            [_, ref others @ ..] => others,
        };
        let write = |shape: &mut [f32]| {
            let mut values: Vec<f64> = (0..axis.count())
                .map(|j| product.rest_at(axis.wavelength_nm(j as f64)))
                .collect();
            for reading in smooth.iter().chain(others) {
                let factor = reading.curve.read(reading.shift, shape);
                for (value, shape) in values.iter_mut().zip(&*shape) {
                    *value = finite(*value * factor * f64::from(*shape));
                }
            }
            write_shape(|j| values[j], shape)
        };
        let channels = match narrow
            .first()
            .map(|first| (first.curve.narrow(), first.shift))
        {
            Some((Some(first), shift)) => {
                let at = |node| {
                    let nm = first.sensor.wavelength_nm(node);
                    let others = smooth.iter().chain(others);
                    others.fold(product.rest_at(nm), |light, reading| light * reading.at(nm))
                };
                first.times(shift.ln(), at, &mut shape, write)
            }
            _ => {
                let factor = write(&mut shape);
                self.sensor.xyz_of_shape(&shape).map(|v| v * factor)
            }
        };
        channels.map(|v| finite(v * product.factor))
    }

    /// A product as its authors wrote it, over what its narrow curves share; None if that is too
    /// much.
    fn shared(&self, narrow: &[&Reading<'_>], product: &Product<'_>) -> Option<[f64; 3]> {
        let quadrature = self.quadrature.as_ref()?;
        let mut range = quadrature.seen_nm()?;
        for reading in narrow {
            let extent = reading.curve.narrow().and_then(|narrow| narrow.extent_nm);
            if let Some([from, to]) = extent {
                range = [
                    range[0].max(from / reading.shift),
                    range[1].min(to / reading.shift),
                ];
            }
        }
        if range[0] >= range[1] {
            return Some([0.0; 3]);
        }
        if (range[1] / range[0]).ln() > WIDEST * self.sensor.axis().spacing() {
            return None;
        }
        let mut cuts = Vec::new();
        product
            .readings
            .iter()
            .for_each(|reading| reading.add_cuts(&mut cuts));
        let channels = quadrature.channels_within(range, &mut cuts, |nm| product.at(nm));
        Some(channels)
    }
}

/// Light as a product of curves.
struct Product<'a> {
    factor: f64,
    readings: Vec<Reading<'a>>,
    /// What else there is to it, smooth.
    rest: Option<&'a Source<'a>>,
}

impl Product<'_> {
    fn at(&self, nm: f64) -> f64 {
        let curves = self.readings.iter().map(|reading| reading.at(nm));
        finite(self.factor * self.rest_at(nm) * curves.product::<f64>())
    }

    fn rest_at(&self, nm: f64) -> f64 {
        self.rest.map_or(1.0, |source| source.rest_at(nm))
    }
}

fn product<'a>(
    factor: f64,
    readings: Vec<Reading<'a>>,
    rest: Option<&'a Source<'a>>,
) -> Product<'a> {
    Product {
        factor,
        readings,
        rest,
    }
}

/// The products that a source is the sum of.
fn products<'a>(source: &'a Source<'a>) -> Vec<Product<'a>> {
    match source {
        Source::Curve { factor, reading } => vec![product(*factor, vec![*reading], None)],
        Source::Glow(glow) => {
            let emissivity = Reading {
                curve: glow.emissivity,
                shift: glow.shift,
            };
            vec![product(1.0, vec![emissivity], Some(source))]
        }
        Source::BlackBody { .. } | Source::Painted { .. } => {
            vec![product(1.0, Vec::new(), Some(source))]
        }
        Source::Lit { light, terms } => terms
            .iter()
            .map(|term| product(term.factor, vec![*light, term.reading], None))
            .collect(),
    }
}
