//! Narrow curves that meet others under shifts of their own: two of them, or light that mirrors and
//! glass color on its way.
//!
//! Two narrow curves are integrated as their authors wrote them, over the wavelengths that they
//! share; where these are too many for a ray, one is read by its means over the axis' spacing
//! ([`unresolved`](super::unresolved())).

use crate::shade::curve::write_shape;
use crate::shade::curves::CurveShader;
use crate::shade::integrand::{Reading, Source};
use crate::shade::narrow::Narrow;
use crate::shade::received::finite;
use crate::shade::table::add;
use crate::shade::walk::{Origin, Visit};

/// Widest range, in spacings of the axis, over which two narrow curves are integrated for a ray. Of
/// wider ones, tables with narrow bands all over, one is read by its means.
const WIDEST: f64 = 16.0;

impl CurveShader {
    /// The channels of the product of two narrow curves under shifts of their own.
    pub(super) fn meeting(&self, one: &Reading<'_>, other: &Reading<'_>) -> [f64; 3] {
        let product = product(1.0, vec![*one, *other], None);
        self.product_channels(&product)
    }

    /// The same where one of them is read by its means; None where they are integrated together.
    pub(super) fn apart(&self, one: &Reading<'_>, other: &Reading<'_>) -> Option<[f64; 3]> {
        let product = product(1.0, vec![*one, *other], None);
        let shared = self.shared(&[one, other], &product);
        shared.is_none().then(|| self.product_channels(&product))
    }

    /// Light of a node by way of mirrors and glass that color it, where some of the curves are
    /// narrow.
    pub(super) fn narrow_node(&self, visit: &Visit<'_>) -> [f64; 3] {
        let mut way = Vec::new();
        let mut share = 1.0;
        for passage in visit.passages() {
            share *= passage.share;
            way.push(self.passed(&passage));
        }
        let mut sum = [0.0; 3];
        for source in &self.sources(visit) {
            for mut product in products(source) {
                product.factor = finite(product.factor * share);
                product.readings.extend(&way);
                add(&mut sum, self.product_channels(&product), 1.0);
            }
        }
        sum.map(finite)
    }

    /// Whether a curve of a node's light, or of its way to the camera, is narrow.
    pub(super) fn is_narrow(&self, visit: &Visit<'_>) -> bool {
        let own = match visit.origin() {
            Origin::Sky => {
                let sky = self.sky.constant();
                sky.is_some_and(|own| own.curve.narrow().is_some())
            }
            Origin::Surface(material, lamps) => {
                let mut emitters = lamps.iter().map(|lamp| &self.emitters[lamp.emitter]);
                self.materials[material].narrow
                    || emitters.any(|emitter| emitter.curve.narrow().is_some())
            }
        };
        own || visit
            .passages()
            .any(|passage| self.passed(&passage).curve.narrow().is_some())
    }

    /// The channels of a product.
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
                    let nm = first.wavelength_nm(node);
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

    /// The integral of a product over the wavelengths that its narrow curves share; None if these are
    /// too many, see [`WIDEST`].
    fn shared(&self, narrow: &[&Reading<'_>], product: &Product<'_>) -> Option<[f64; 3]> {
        let quadrature = self.quadrature.as_ref()?;
        let mut range = quadrature.seen_nm()?;
        for reading in narrow {
            let extent = reading.curve.narrow().and_then(Narrow::extent_nm);
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
    /// A source that gives the smooth rest of it, see [`Source::rest_at`].
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
        Source::Thermal(light) => {
            let emissivity = Reading {
                curve: light.emissivity,
                shift: light.shift,
            };
            vec![product(1.0, vec![emissivity], Some(source))]
        }
        Source::BlackBody { .. } | Source::Image { .. } => {
            vec![product(1.0, Vec::new(), Some(source))]
        }
        Source::Lamp { light, lobes } => lobes
            .iter()
            .map(|lobe| product(lobe.factor, vec![*light, lobe.reading], None))
            .collect(),
    }
}
