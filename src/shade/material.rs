//! Spectra of materials and lamps as curves, with tables over ln D that stand in for sums over
//! wavelengths.

use super::curve::Curve;
use super::received::{Doppler, finite};
use super::table::XyzTable;
use super::thermal::BlackbodySpectrum;
use crate::spectrum::Sensor;

/// The curves of a material.
pub(super) struct MaterialCurves {
    /// Its lobes, in their order; those that are not specular come first.
    pub(super) lobes: Vec<ReflectorTables>,
    pub(super) non_specular: usize,
    pub(super) emission: Option<EmitterTable>,
    pub(super) thermal: Option<BlackbodySpectrum>,
    /// Whether the curve of its own light, or of a lobe that reflects lamps, is narrow.
    pub(super) narrow: bool,
}

impl MaterialCurves {
    /// The lobes that reflect lamps.
    #[inline(always)]
    pub(super) fn reflectors(&self) -> &[ReflectorTables] {
        &self.lobes[..self.non_specular]
    }

    /// Memory of curves and tables, bytes.
    pub(super) fn bytes(&self) -> usize {
        self.lobes.iter().map(ReflectorTables::bytes).sum::<usize>()
            + self.emission.as_ref().map_or(0, EmitterTable::bytes)
            + self.thermal.as_ref().map_or(0, BlackbodySpectrum::bytes)
    }
}

/// The reflectance of a lobe, and the sensor's channels of its product with each emitter, for lamps
/// that move with the surface.
pub(super) struct ReflectorTables {
    pub(super) reflectance: Curve,
    /// By emitter, none for a specular lobe; None where no table is made.
    pub(super) tables: Vec<Option<XyzTable>>,
}

impl ReflectorTables {
    fn bytes(&self) -> usize {
        let tables = self.tables.iter().flatten().map(XyzTable::bytes);
        self.reflectance.bytes() + tables.sum::<usize>()
    }
}

/// A spectrum of light, and the sensor's channels of it.
pub(super) struct EmitterTable {
    pub(super) curve: Curve,
    pub(super) table: XyzTable,
    /// Whether the table stands in for the sum over wavelengths.
    pub(super) tabulated: bool,
}

impl EmitterTable {
    /// Memory of curve and table, bytes.
    pub(super) fn bytes(&self) -> usize {
        self.curve.bytes() + self.table.bytes()
    }

    /// The sensor's channels of the light as it is received. `shape` has the length of the axis.
    pub(super) fn xyz(&self, doppler: Doppler, sensor: &Sensor, shape: &mut [f32]) -> [f64; 3] {
        let power = doppler.radiance();
        let shift = doppler.shift();
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

    /// Adds the spectral radiance received at the axis' wavelengths.
    pub(super) fn add(&self, doppler: Doppler, out: &mut [f64], shape: &mut [f32]) {
        let peak = self.curve.read(doppler.shift(), shape);
        let factor = finite(peak * doppler.radiance());
        for (out, shape) in out.iter_mut().zip(&*shape) {
            *out += factor * f64::from(*shape);
        }
    }
}
