//! Light of curves that are narrower than the wavelengths are apart: lines of lamps and of what
//! glows, narrow filters, spiky tables.
//!
//! The channels of one such curve, and of a lamp's light on a paint that moves with it, are
//! tabulated over ln D from integrals ([`Fine`]). Where one is met by smooth curves under other
//! shifts, its lines are a few points ([`Sparse`]) and the rest of it stands for the sensor's
//! weights ([`Responses`]). Where two meet under shifts of their own they are integrated as their
//! authors wrote them, over what they share; if that is much, one is read by its means
//! ([`unresolved`](super::unresolved())).

use super::table::{XyzTable, add, interesting};
use crate::spectrum::{Fine, FineSensor, Responses, Sparse, Spectrum};
use std::sync::{Arc, OnceLock};

/// How many widths from its center a gaussian ends where it meets another narrow curve: 2e-11 of
/// the peak.
const REACH: f64 = 7.0;

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
