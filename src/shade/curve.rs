//! A curve: weight × spectrum, baked on the sensor's axis or as its author wrote it.

use super::narrow::Narrow;
use crate::spectrum::{Baked, Fine, LogAxis, Smoothing, Spectrum};
use std::sync::{Arc, OnceLock};

/// Share of local light that a grid may lose or add before a curve counts as narrow: half of the
/// flicker that is allowed in frames of a velocity ramp.
pub(super) const NOTICED: f64 = 1e-3;

/// The same for a curve that is not baked.
const NOTICED_AS_WRITTEN: f64 = 2e-3;

/// weight × spectrum, at most `limit`, ready to be read under any shift.
pub(super) struct Curve {
    spectrum: Arc<Spectrum>,
    weight: f64,
    limit: f64,
    axis: LogAxis,
    baked: Option<Baked>,
    narrow: Option<Narrow>,
    /// Samples between which a baked curve is read at any wavelength; made when first needed.
    fine: OnceLock<Option<Fine>>,
    reach: f64,
}

impl Curve {
    /// A curve as its author wrote it. A reflectance has limit 1, because a spline may overshoot it
    /// between points.
    pub(super) fn new(spectrum: &Arc<Spectrum>, weight: f64, limit: f64, axis: LogAxis) -> Self {
        Self {
            spectrum: Arc::clone(spectrum),
            weight,
            limit,
            axis,
            baked: None,
            narrow: None,
            fine: OnceLock::new(),
            reach: 0.0,
        }
    }

    /// The same baked for |ln D| up to `reach`, unless the table would be too large.
    pub(super) fn baked_within(mut self, reach: f64) -> Self {
        let smoothing = Smoothing::of(&self.spectrum);
        self.reach = reach;
        self.baked = self.table(reach, smoothing, |nm| self.at(nm));
        self
    }

    /// The same held as a narrow curve, made by `narrow`, if a grid would lose or add more than
    /// [`NOTICED`] of its light. What is baked then becomes means over the spacing of the axis.
    pub(super) fn narrowed_within(
        mut self,
        reach: f64,
        narrow: impl FnOnce(Fine, &Spectrum) -> Narrow,
    ) -> Self {
        if !Fine::is_worth_a_look(self.axis, &self.spectrum) {
            return self;
        }
        let Some(fine) = Fine::of(self.axis, reach, &self.spectrum, |nm| self.at(nm)) else {
            return self;
        };
        // A curve that is not baked is not smoothed either.
        let as_written;
        let (baked, noticed) = match &self.baked {
            Some(baked) => (Some(baked), NOTICED),
            None => {
                as_written = self.table(reach, Smoothing::None, |nm| self.at(nm));
                (as_written.as_ref(), NOTICED_AS_WRITTEN)
            }
        };
        if baked.is_none_or(|baked| fine.is_served_by(baked, noticed)) {
            return self;
        }
        // A curve that is not baked is still read as written where its values are asked for.
        if self.baked.is_some() {
            self.baked = self.table(reach, Smoothing::Mean, |nm| fine.near(nm));
        }
        self.narrow = Some(narrow(fine, &self.spectrum));
        self
    }

    fn table(&self, reach: f64, smoothing: Smoothing, curve: impl Fn(f64) -> f64) -> Option<Baked> {
        Baked::new(self.axis, reach, self.support_nm(), smoothing, curve)
    }

    /// The exact value at a wavelength (nm) of the source's rest frame; finite.
    pub(super) fn at(&self, nm: f64) -> f64 {
        (self.weight * self.spectrum.at(nm))
            .min(self.limit)
            .min(f64::MAX)
    }

    /// Memory of its tables, bytes.
    pub(super) fn bytes(&self) -> usize {
        let fine = self.fine.get().and_then(Option::as_ref);
        self.baked.as_ref().map_or(0, Baked::bytes)
            + self.narrow.as_ref().map_or(0, Narrow::bytes)
            + fine.map_or(0, Fine::bytes)
    }

    /// The value of a curve that is the same at all wavelengths; None of others.
    pub(super) fn constant(&self) -> Option<f64> {
        matches!(*self.spectrum, Spectrum::Constant(_))
            .then(|| self.at(self.axis.wavelength_nm(0.0)))
    }

    /// The spectrum as its author wrote it, without weight and limit.
    pub(super) fn spectrum(&self) -> &Spectrum {
        &self.spectrum
    }

    /// The wavelengths outside of which it is constant, nm; None if it is constant everywhere.
    pub(super) fn support_nm(&self) -> Option<[f64; 2]> {
        self.spectrum.support_nm()
    }

    /// The baked form; None if the curve is held as its author wrote it. Sums of it over wavelengths
    /// are wrong where the curve is narrow.
    #[inline(always)]
    pub(super) fn baked(&self) -> Option<&Baked> {
        self.baked.as_ref()
    }

    /// The narrow form; None if the curve is smooth enough for the axis.
    #[inline(always)]
    pub(super) fn narrow(&self) -> Option<&Narrow> {
        self.narrow.as_ref()
    }

    /// The curve at e^`ln_shift`·λ, λ at a position on the axis in nodes, which `nm` gives in nm. A
    /// baked curve is interpolated between means about the nodes.
    #[inline]
    pub(super) fn at_node(&self, ln_shift: f64, node: f64, nm: impl Fn(f64) -> f64) -> f64 {
        let fine = self.baked.as_ref().and_then(|_| {
            let make = || Fine::of(self.axis, self.reach, &self.spectrum, |nm| self.at(nm));
            self.fine.get_or_init(make).as_ref()
        });
        match fine {
            Some(fine) => fine.at(ln_shift, node),
            None => self.at(ln_shift.exp() * nm(node)),
        }
    }

    /// Writes the shape of the curve at `shift`·λ for the axis' wavelengths λ. Returns its factor. Of
    /// a narrow curve that is baked these are means over the spacing of the axis.
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

/// Writes values over the largest of them, and returns that one: so the f32 neither overflow nor
/// underflow.
pub(super) fn write_shape(value: impl Fn(usize) -> f64, out: &mut [f32]) -> f64 {
    let peak = (0..out.len()).map(&value).fold(0.0, f64::max);
    let scale = if peak > 0.0 { peak } else { 1.0 };
    for (j, out) in out.iter_mut().enumerate() {
        *out = (value(j) / scale) as f32;
    }
    peak
}
