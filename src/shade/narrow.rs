//! Curves that are narrower than the distance of the sensor's wavelengths: emission lines, narrow
//! filters, spiky tables. Sums over those wavelengths would miss part of their light, or count it
//! twice.
//!
//! The channels of one such curve, and of a lamp's light on a paint that moves with it, are
//! tabulated over ln D from integrals ([`Fine`]). Multiplied by smooth curves under other shifts, its
//! lines are read at a few points ([`Sparse`]) and the rest of it by weights of its own
//! ([`Responses`]). Two narrow curves under shifts of their own are integrated together
//! (`grid/meeting.rs`).

use super::table::{XyzTable, add, interesting};
use crate::spectrum::{Fine, FineSensor, Responses, Sparse, Spectrum};
use std::sync::{Arc, OnceLock};

/// Distance from its center, in widths, at which a gaussian is cut off in integrals with another
/// narrow curve: there it is 2e-11 of the peak.
const REACH: f64 = 7.0;

/// A narrow curve, ready to be read under any shift.
pub(super) struct Narrow {
    fine: Fine,
    /// Its lines, and the rest of it.
    parts: OnceLock<(Option<Sparse>, Option<Responses>)>,
    sensor: Arc<FineSensor>,
    /// The range of ln D over which its channels change.
    range: [f64; 2],
    /// The wavelengths between which it is not 0, nm; None if it is extrapolated by another value.
    extent_nm: Option<[f64; 2]>,
}

impl Narrow {
    /// A spectrum of samples `fine`, for |ln D| up to `reach`.
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

    /// A table of the sensor's channels for |ln D| up to `reach`; None if it would be too large. The
    /// curve is constant outside of `support_nm`.
    pub(super) fn table(&self, reach: f64, support_nm: Option<[f64; 2]>) -> Option<XyzTable> {
        XyzTable::fits(self.sensor.axis(), reach, support_nm)
            .then(|| XyzTable::of_fine(&self.sensor, &self.fine, reach, support_nm))
    }

    /// The wavelength (nm) at a position on the axis, in nodes.
    pub(super) fn wavelength_nm(&self, node: f64) -> f64 {
        self.sensor.wavelength_nm(node)
    }

    /// The channels of the curve under a shift times a smooth factor. `at` gives that factor at a
    /// position on the axis, in nodes; `write` writes its shape over the axis into `shape`, and
    /// returns the factor of the shape.
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

    /// The parts, made when a ray first needs them.
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

    /// The wavelengths between which it is not 0, nm; None if it is extrapolated by another value.
    pub(super) fn extent_nm(&self) -> Option<[f64; 2]> {
        self.extent_nm
    }

    /// Memory of samples and weights, bytes.
    pub(super) fn bytes(&self) -> usize {
        let left = self.parts.get().and_then(|(_, left)| left.as_ref());
        self.fine.bytes() + left.map_or(0, Responses::bytes)
    }
}
