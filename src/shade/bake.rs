//! What a shader is made of: the curves of materials and lamps, baked, and their tables.

use super::curve::Curve;
use super::narrow::Narrow;
use super::received::{Received, finite};
use super::table::XyzTable;
use super::thermal::Glow;
use crate::frame::{self, ActiveEffects};
use crate::scene::{Material, Reflectance, Scene, Thermal};
use crate::shot::{Accuracy, Spectra};
use crate::spectrum::quadrature::cuts_nm;
use crate::spectrum::{Fine, FineSensor, Quadrature, Sensor, Spectrum, planck};
use crate::trace::Term;
use std::cell::OnceCell;
use std::sync::Arc;

/// A material's curves.
pub(super) struct MaterialCurves {
    pub(super) diffuse: Option<Reflecting>,
    pub(super) highlight: Option<Reflecting>,
    pub(super) emission: Option<Sight>,
    pub(super) glow: Option<Glow>,
    mirror: Option<Curve>,
    refraction: Option<Curve>,
    /// Whether a curve that makes light of its own or of lamps is narrow.
    pub(super) narrow: bool,
}

impl MaterialCurves {
    /// Diffuse and highlight.
    pub(super) fn reflecting(&self) -> impl Iterator<Item = &Option<Reflecting>> {
        [&self.diffuse, &self.highlight].into_iter()
    }

    /// Memory of curves and tables, bytes.
    pub(super) fn bytes(&self) -> usize {
        let reflecting = |r: &Reflecting| {
            let tables = r.tables.iter().flatten().map(XyzTable::bytes);
            r.reflectance.bytes() + tables.sum::<usize>()
        };
        let passing = [&self.mirror, &self.refraction].into_iter().flatten();
        self.reflecting().flatten().map(reflecting).sum::<usize>()
            + passing.map(Curve::bytes).sum::<usize>()
            + self.emission.as_ref().map_or(0, Sight::bytes)
            + self.glow.as_ref().map_or(0, Glow::bytes)
    }

    /// The share of light that a term passes on.
    pub(super) fn passing(&self, term: Term) -> Option<&Curve> {
        match term {
            Term::Mirror => self.mirror.as_ref(),
            Term::Refraction => self.refraction.as_ref(),
        }
    }
}

/// A reflectance, and XYZ of its product with each emitter for lamps that move with the surface.
pub(super) struct Reflecting {
    pub(super) reflectance: Curve,
    /// By emitter; None where none is made.
    pub(super) tables: Vec<Option<XyzTable>>,
}

/// A curve that is seen as it is.
pub(super) struct Sight {
    pub(super) curve: Curve,
    pub(super) table: XyzTable,
    /// Whether the table stands in for the sum over wavelengths.
    pub(super) tabulated: bool,
}

impl Sight {
    /// Memory of curve and table, bytes.
    pub(super) fn bytes(&self) -> usize {
        self.curve.bytes() + self.table.bytes()
    }

    /// XYZ under the Doppler factor `d`.
    pub(super) fn xyz(
        &self,
        d: f64,
        received: Received,
        sensor: &Sensor,
        shape: &mut [f32],
    ) -> [f64; 3] {
        let power = received.radiance(d);
        let shift = received.shift(d);
        if self.tabulated {
            return self.table.at(shift.ln()).map(|v| v * power);
        }
        if let Some(narrow) = self.curve.narrow() {
            let seen = narrow.times(
                shift.ln(),
                |_| 1.0,
                shape,
                |shape| {
                    shape.fill(1.0);
                    1.0
                },
            );
            return seen.map(|v| finite(v * power));
        }
        let factor = finite(self.curve.read(shift, shape) * power);
        sensor.xyz_of_shape(shape).map(|v| v * factor)
    }

    /// Adds the spectral radiance under the Doppler factor `d` at the axis' wavelengths.
    pub(super) fn add(&self, d: f64, received: Received, out: &mut [f64], shape: &mut [f32]) {
        let peak = self.curve.read(received.shift(d), shape);
        let factor = finite(peak * received.radiance(d));
        for (out, shape) in out.iter_mut().zip(&*shape) {
            *out += factor * f64::from(*shape);
        }
    }
}

/// What a [`Shader`](super::Shader) is made for, beside the scene.
pub struct Settings<'a> {
    /// Effects of the image.
    pub called: &'a ActiveEffects,
    /// How spectra are held.
    pub accuracy: &'a Accuracy,
    /// The band that is seen, and how.
    pub sensor: &'a frame::Sensor,
    /// Largest |ln D| between a surface and the camera.
    pub reach: f64,
    /// Largest |ln D| between a lamp and a surface.
    pub lamp_reach: f64,
}

/// For each light its emitter and scale, and the emitters' spectra.
pub(super) fn distinct_emitters(scene: &Scene) -> (Vec<(usize, f64)>, Vec<Arc<Spectrum>>) {
    let mut spectra: Vec<Arc<Spectrum>> = Vec::new();
    let lamps = scene
        .lights
        .iter()
        .map(|light| {
            let known = spectra.iter().position(|s| *s == light.spectrum);
            let emitter = known.unwrap_or_else(|| {
                spectra.push(Arc::clone(&light.spectrum));
                spectra.len() - 1
            });
            (emitter, light.scale)
        })
        .collect();
    (lamps, spectra)
}

/// Makes curves and tables.
pub(super) struct Bake<'a> {
    pub(super) sensor: &'a Sensor,
    pub(super) settings: &'a Settings<'a>,
    /// Whether tables stand in for sums over wavelengths.
    pub(super) tabulated: bool,
    /// Whether there are no more pairs of material and emitter than are tabulated.
    pub(super) few: bool,
    /// The integrals that the sensor's channels stand for.
    pub(super) quadrature: &'a Quadrature,
    /// Made where a curve is narrow.
    pub(super) fine: OnceCell<Arc<FineSensor>>,
}

/// Most pairs of material and emitter that are tabulated, some 100 kB each; with more, every lamp
/// is read wavelength by wavelength.
pub(super) const MOST_TABLES: usize = 1000;

impl Bake<'_> {
    pub(super) fn curve(&self, spectrum: &Arc<Spectrum>, weight: f64, limit: f64) -> Curve {
        self.narrowed(self.smooth_curve(spectrum, weight, limit))
    }

    /// A curve that counts as smooth, whatever it is.
    pub(super) fn smooth_curve(&self, spectrum: &Arc<Spectrum>, weight: f64, limit: f64) -> Curve {
        let curve = Curve::new(spectrum, weight, limit, self.sensor.axis());
        match self.settings.accuracy.spectra {
            Spectra::Grid => curve.baked_within(self.reach()),
            _ => curve,
        }
    }

    fn narrowed(&self, curve: Curve) -> Curve {
        match self.settings.accuracy.spectra {
            Spectra::Grid | Spectra::Spline => {
                curve.narrowed_within(self.reach(), |fine, spectrum| {
                    let sensor = Arc::clone(self.fine());
                    Narrow::new(fine, spectrum, self.reach(), sensor)
                })
            }
            Spectra::Exact | Spectra::Lines | Spectra::Rgb => curve,
        }
    }

    /// Largest |ln D| under which any curve is read.
    fn reach(&self) -> f64 {
        self.shifted(self.settings.reach + self.settings.lamp_reach)
    }

    /// A reach, or 0 where curves do not shift.
    fn shifted(&self, reach: f64) -> f64 {
        if self.settings.called.doppler {
            reach
        } else {
            0.0
        }
    }

    /// The sensor at the nodes of narrow curves.
    fn fine(&self) -> &Arc<FineSensor> {
        let make = || Arc::new(FineSensor::new(self.sensor, self.quadrature));
        self.fine.get_or_init(make)
    }

    pub(super) fn surface(&self, material: &Material, emitters: &[Sight]) -> MaterialCurves {
        let reflecting = |weight: f64, spectrum: &Arc<Spectrum>| {
            let reflectance = self.curve(spectrum, weight, 1.0);
            let tables = emitters
                .iter()
                .map(|e| self.product(&reflectance, &e.curve))
                .collect();
            Reflecting {
                reflectance,
                tables,
            }
        };
        let passing =
            |term: Option<&Reflectance>| term.map(|r| self.curve(&r.spectrum, r.weight, 1.0));
        let thermal = material
            .thermal
            .as_ref()
            .filter(|_| self.settings.called.thermal);
        let mut curves = MaterialCurves {
            narrow: false,
            diffuse: material
                .diffuse
                .as_ref()
                .map(|r| reflecting(r.weight, &r.spectrum)),
            highlight: material
                .highlight
                .as_ref()
                .map(|h| reflecting(h.reflectance.weight, &h.reflectance.spectrum)),
            emission: material.emission.as_ref().map(|e| {
                self.sight(
                    self.curve(&e.spectrum, e.weight, f64::INFINITY),
                    self.settings.reach,
                )
            }),
            glow: thermal.map(|t| self.glow(t)),
            mirror: passing(material.mirror.as_ref()),
            refraction: passing(material.refraction.as_ref().map(|r| &r.transmittance)),
        };
        let reflectances = curves.reflecting().flatten().map(|r| &r.reflectance);
        let sources = curves.emission.iter().map(|sight| &sight.curve);
        let emissivity = curves.glow.iter().map(|glow| glow.parts().1);
        let narrow = reflectances
            .chain(sources)
            .chain(emissivity)
            .any(|curve| curve.narrow().is_some());
        curves.narrow = narrow;
        curves
    }

    fn glow(&self, thermal: &Thermal) -> Glow {
        // Read at exact wavelengths, so not baked.
        let emissivity = Curve::new(&thermal.emissivity, 1.0, 1.0, self.sensor.axis());
        let glow = Glow::new(thermal, self.narrowed(emissivity));
        // Planck's curve is nowhere constant: as far as D reaches.
        let everywhere = Some([f64::MIN_POSITIVE, f64::MAX]);
        let (kelvin, emissivity) = glow.parts();
        if emissivity.narrow().is_some() {
            let light = |nm| emissivity.at(nm) * planck::radiance(nm, kelvin);
            let mut cuts = Vec::new();
            cuts_nm(emissivity.spectrum(), 1.0, &mut cuts);
            let reach = self.shifted(self.settings.reach);
            // What goes on beyond its points is no longer constant.
            let support = emissivity
                .narrow()
                .and_then(Narrow::extent_nm)
                .or(everywhere);
            if let Some(table) = self.fine_table(reach, support, &cuts, light) {
                return glow.with_table(table);
            }
        }
        if !self.tabulated {
            return glow;
        }
        glow.tabulated(self.sensor.axis(), |read| {
            self.table(self.settings.reach, everywhere, read)
        })
    }

    pub(super) fn emitter(&self, spectrum: &Arc<Spectrum>) -> Sight {
        let reach = self.settings.reach + self.settings.lamp_reach;
        self.sight(self.curve(spectrum, 1.0, f64::INFINITY), reach)
    }

    pub(super) fn sight(&self, curve: Curve, reach: f64) -> Sight {
        let support = curve.support_nm();
        let narrow = curve.narrow();
        let (table, tabulated) = match narrow.map(|n| n.table(self.shifted(reach), support)) {
            Some(Some(table)) => (table, true),
            Some(None) => (self.table(0.0, None, |_, _| 0.0), false),
            None => (
                self.table(reach, support, |d, out| curve.read(d, out)),
                self.tabulated,
            ),
        };
        Sight {
            curve,
            table,
            tabulated,
        }
    }

    /// XYZ of reflectance times emitter under one shift, where a table is made of it.
    fn product(&self, reflectance: &Curve, emitter: &Curve) -> Option<XyzTable> {
        let support = match (reflectance.support_nm(), emitter.support_nm()) {
            (Some([a, b]), Some([c, d])) => Some([a.min(c), b.max(d)]),
            (one, other) => one.or(other),
        };
        let narrow = [reflectance, emitter].map(Curve::narrow);
        if narrow.iter().any(Option::is_some) {
            if !self.few {
                return None;
            }
            // There is light where both have some.
            let extents = narrow.into_iter().flatten().filter_map(Narrow::extent_nm);
            let support = extents.fold(support, |support, [c, d]| {
                support.map(|[a, b]| [a.max(c).min(b), b.min(d).max(a)])
            });
            let mut cuts = Vec::new();
            for curve in [reflectance, emitter] {
                cuts_nm(curve.spectrum(), 1.0, &mut cuts);
            }
            let reach = self.shifted(self.settings.reach);
            let product = |nm| finite(reflectance.at(nm) * emitter.at(nm));
            return self.fine_table(reach, support, &cuts, product);
        }
        if !self.tabulated {
            return None;
        }
        let mut light = vec![0.0; self.sensor.axis().count()];
        Some(self.table(self.settings.reach, support, |d, out| {
            let factor = emitter.read(d, &mut light) * reflectance.read(d, out);
            for (out, light) in out.iter_mut().zip(&light) {
                *out *= light;
            }
            factor
        }))
    }

    /// A table of a curve that is narrow somewhere, unless it would be too large.
    fn fine_table(
        &self,
        reach: f64,
        support_nm: Option<[f64; 2]>,
        cuts_nm: &[f64],
        curve: impl Fn(f64) -> f64,
    ) -> Option<XyzTable> {
        let axis = self.sensor.axis();
        let fine = Fine::new(axis, reach, support_nm?, cuts_nm, curve)?;
        XyzTable::fits(axis, reach, support_nm)
            .then(|| XyzTable::of_fine(self.fine(), &fine, reach, support_nm))
    }

    /// A table over |ln D| up to `reach`, or at D = 1 alone where curves do not shift or sums take
    /// its place.
    fn table(
        &self,
        reach: f64,
        support_nm: Option<[f64; 2]>,
        read: impl FnMut(f64, &mut [f32]) -> f64,
    ) -> XyzTable {
        let reach = if self.tabulated {
            self.shifted(reach)
        } else {
            0.0
        };
        XyzTable::new(self.sensor, reach, support_nm, read)
    }
}
