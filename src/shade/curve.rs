//! A spectrum as the shader holds it: baked on the sensor's axis, or as its author wrote it.

use crate::spectrum::{Baked, LogAxis, Smoothing, Spectrum};
use std::sync::Arc;

/// weight × spectrum, at most `limit`, ready to be read under any shift.
pub(super) struct Curve {
    spectrum: Arc<Spectrum>,
    weight: f64,
    limit: f64,
    axis: LogAxis,
    baked: Option<Baked>,
}

impl Curve {
    /// With accuracy.spectra = "grid" the curve is baked for |ln D| up to `reach`, unless that would
    /// be too large a table; with "spline" it is not, and `reach` is None. A reflectance has limit 1: what a spline overshoots between
    /// authored points is clamped.
    pub(super) fn new(
        spectrum: &Arc<Spectrum>,
        weight: f64,
        limit: f64,
        axis: LogAxis,
        reach: Option<f64>,
    ) -> Self {
        let mut curve = Self {
            spectrum: Arc::clone(spectrum),
            weight,
            limit,
            axis,
            baked: None,
        };
        curve.baked = reach.and_then(|reach| {
            let smoothing = Smoothing::of(spectrum);
            Baked::new(axis, reach, curve.support_nm(), smoothing, |nm| {
                curve.at(nm)
            })
        });
        curve
    }

    /// The exact value at a wavelength of the source's frame.
    pub(super) fn at(&self, nm: f64) -> f64 {
        (self.weight * self.spectrum.at(nm))
            .min(self.limit)
            .min(f64::MAX)
    }

    /// Memory of its table, bytes.
    pub(super) fn bytes(&self) -> usize {
        self.baked.as_ref().map_or(0, Baked::bytes)
    }

    /// The value everywhere, for a curve that is the same everywhere.
    pub(super) fn constant(&self) -> Option<f64> {
        matches!(*self.spectrum, Spectrum::Constant(_))
            .then(|| self.at(self.axis.wavelength_nm(0.0)))
    }

    /// As its author wrote it, without weight and limit.
    pub(super) fn spectrum(&self) -> &Spectrum {
        &self.spectrum
    }

    pub(super) fn support_nm(&self) -> Option<[f64; 2]> {
        self.spectrum.support_nm()
    }

    /// The baked form, or None where the curve is held as its author wrote it.
    #[inline(always)]
    pub(super) fn baked(&self) -> Option<&Baked> {
        self.baked.as_ref()
    }

    /// Writes the curve at `shift`·λ for the axis' wavelengths; `out` is to be multiplied by what
    /// is returned.
    #[inline(always)]
    pub(super) fn read(&self, shift: f64, out: &mut [f32]) -> f64 {
        match &self.baked {
            Some(baked) => {
                baked.shifted(shift.ln()).write(out);
                baked.peak()
            }
            None => write_shape(|j| self.at(shift * self.axis.wavelength_nm(j as f64)), out),
        }
    }
}

/// Writes values over the largest of them, which is returned: f32 holds any curve so.
pub(super) fn write_shape(value: impl Fn(usize) -> f64, out: &mut [f32]) -> f64 {
    let peak = (0..out.len()).map(&value).fold(0.0, f64::max);
    let scale = if peak > 0.0 { peak } else { 1.0 };
    for (j, out) in out.iter_mut().enumerate() {
        *out = (value(j) / scale) as f32;
    }
    peak
}
