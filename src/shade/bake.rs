//! Makes the curves of materials and lamps, and their tables, for an image's sensor and shifts.

use super::curve::Curve;
use super::material::{EmitterTable, MaterialCurves, ReflectorTables};
use super::narrow::Narrow;
use super::received::finite;
use super::settings::Settings;
use super::table::XyzTable;
use super::thermal::BlackbodySpectrum;
use crate::scene::{Lobe, Material, Thermal};
use crate::shot::Spectra;
use crate::spectrum::quadrature::cuts_nm;
use crate::spectrum::{Fine, FineSensor, Quadrature, Sensor, Spectrum, planck};
use std::cell::OnceCell;
use std::sync::Arc;

/// Makes curves and tables.
///
/// Reach is always the largest |ln D|.
pub(super) struct Bake<'a> {
    pub(super) sensor: &'a Sensor,
    pub(super) settings: &'a Settings<'a>,
    /// Whether tables stand in for sums over wavelengths.
    pub(super) tabulated: bool,
    /// Whether there are at most [`MOST_TABLES`] pairs of material and emitter.
    pub(super) few: bool,
    /// The integrals over wavelength that the sensor's sums stand for.
    pub(super) quadrature: &'a Quadrature,
    /// Made when the first curve is narrow.
    pub(super) fine: OnceCell<Arc<FineSensor>>,
}

/// Most pairs of material and emitter that are tabulated, some 100 kB each; with more, every lamp
/// is read wavelength by wavelength.
pub(super) const MOST_TABLES: usize = 1000;

impl Bake<'_> {
    /// weight × spectrum, at most `limit`.
    pub(super) fn curve(&self, spectrum: &Arc<Spectrum>, weight: f64, limit: f64) -> Curve {
        self.narrowed(self.smooth_curve(spectrum, weight, limit))
    }

    /// The same held as a smooth curve, however narrow it is.
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

    /// The reach of any curve.
    fn reach(&self) -> f64 {
        self.shifted(self.settings.reach + self.settings.lamp_reach)
    }

    /// A reach, or 0 where spectra do not shift.
    fn shifted(&self, reach: f64) -> f64 {
        if self.settings.effects.doppler {
            reach
        } else {
            0.0
        }
    }

    /// The sensor over wavelengths close enough for narrow curves.
    fn fine(&self) -> &Arc<FineSensor> {
        let make = || Arc::new(FineSensor::new(self.sensor, self.quadrature));
        self.fine.get_or_init(make)
    }

    /// The curves of a material under lamps of these emitters.
    pub(super) fn material(
        &self,
        material: &Material,
        emitters: &[EmitterTable],
    ) -> MaterialCurves {
        let lobes = material.bsdf.lobes().iter();
        let lobes: Vec<ReflectorTables> = lobes.map(|lobe| self.lobe(lobe, emitters)).collect();
        let non_specular = material.bsdf.non_specular().len();
        let emission = material.emission.as_ref().map(|emission| {
            let curve = self.curve(&emission.spectrum, emission.weight, f64::INFINITY);
            self.emitter_table(curve, self.settings.reach)
        });
        let thermal = material.thermal.as_ref();
        let thermal = thermal.filter(|_| self.settings.effects.thermal);
        let thermal = thermal.map(|thermal| self.thermal(thermal));
        let reflectances = lobes[..non_specular].iter().map(|lobe| &lobe.reflectance);
        let emissivity = thermal.iter().map(|thermal| thermal.parts().1);
        let narrow = reflectances
            .chain(emission.iter().map(|emission| &emission.curve))
            .chain(emissivity)
            .any(|curve| curve.narrow().is_some());
        MaterialCurves {
            lobes,
            non_specular,
            emission,
            thermal,
            narrow,
        }
    }

    fn lobe(&self, lobe: &Lobe, emitters: &[EmitterTable]) -> ReflectorTables {
        let own = &lobe.reflectance;
        let reflectance = self.curve(&own.spectrum, own.weight, 1.0);
        let lamps = !lobe.kind.is_specular();
        let emitters = emitters.iter().filter(|_| lamps);
        let tables = emitters.map(|emitter| self.product(&reflectance, &emitter.curve));
        ReflectorTables {
            tables: tables.collect(),
            reflectance,
        }
    }

    fn thermal(&self, thermal: &Thermal) -> BlackbodySpectrum {
        // Read at exact wavelengths, so not baked.
        let emissivity = Curve::new(&thermal.emissivity, 1.0, 1.0, self.sensor.axis());
        let light = BlackbodySpectrum::new(thermal, self.narrowed(emissivity));
        // Planck's curve is nowhere constant: as far as D reaches.
        let everywhere = Some([f64::MIN_POSITIVE, f64::MAX]);
        let (kelvin, emissivity) = light.parts();
        if emissivity.narrow().is_some() {
            let curve = |nm| emissivity.at(nm) * planck::radiance(nm, kelvin);
            let mut cuts = Vec::new();
            cuts_nm(emissivity.spectrum(), 1.0, &mut cuts);
            let reach = self.shifted(self.settings.reach);
            // What goes on beyond its points is no longer constant.
            let support = emissivity
                .narrow()
                .and_then(Narrow::extent_nm)
                .or(everywhere);
            if let Some(table) = self.fine_table(reach, support, &cuts, curve) {
                return light.with_table(table);
            }
        }
        if !self.tabulated {
            return light;
        }
        light.tabulated(self.sensor.axis(), |read| {
            self.table(self.settings.reach, everywhere, read)
        })
    }

    /// The spectrum of lamps.
    pub(super) fn emitter(&self, spectrum: &Arc<Spectrum>) -> EmitterTable {
        let reach = self.settings.reach + self.settings.lamp_reach;
        self.emitter_table(self.curve(spectrum, 1.0, f64::INFINITY), reach)
    }

    /// Light of a curve that is received under |ln D| of at most `reach`.
    pub(super) fn emitter_table(&self, curve: Curve, reach: f64) -> EmitterTable {
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
        EmitterTable {
            curve,
            table,
            tabulated,
        }
    }

    /// Reflectance times emitter under one shift, where a table is made of it.
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

    /// A table of what `read` writes, see [`XyzTable::new`]; of D = 1 alone where spectra do not shift
    /// or sums over wavelengths are made.
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
