//! Tables of the sensor's channels of a curve over ln D. Where one shift serves all that a curve is a
//! product of, a table replaces the sum over wavelengths when a ray is shaded.

use crate::spectrum::{Fine, FineSensor, LogAxis, Sensor, catmull_rom};

/// Entries between two neighbours of the sensor's axis. With 4 the cubic between entries is within
/// 2.3e-5 of the sum over wavelengths it stands for, for a band of σ = 9 nm (`tests/shading.rs`);
/// with 8, below the 1e-6 of f32 sums; the table takes twice as long to make.
const FINENESS: f64 = 8.0;

/// Most entries per unit of ln D over a window as wide as the visible, however fine the axis: a
/// band of σ = 1 nm at 560 nm spans two. In proportion more over a narrower window.
const FINEST: f64 = 1000.0;
/// ln(longest/shortest) of the visible, about.
const VISIBLE: f64 = 0.8;
/// Fewest entries per unit of ln D, however coarse the axis of a wide window: what falls as e⁻ˣ,
/// x = hc/(λkT), in Wien's part is within (x/400)³/60 of itself, 2e-7 at x = 10, 3e-5 at 50.
const COARSEST: f64 = 400.0;
/// With more entries per unit than this, in a window narrower than a tenth of the visible, tables
/// over the shifts of a fast scene would take longer to make than sums over wavelengths.
const MOST: f64 = 1e4;

/// Most entries of a table of a narrow curve.
const MOST_ENTRIES: f64 = 32_768.0;

/// XYZ (cd/m²), or band totals (W·m⁻²·sr⁻¹), of a curve C(Dλ), W·m⁻²·sr⁻¹·nm⁻¹, tabulated over
/// ln D.
pub(super) struct XyzTable {
    entries: Vec<[f64; 3]>,
    /// ln D of entry 1.
    start: f64,
    per_unit: f64,
}

impl XyzTable {
    /// Whether tables pay over an axis. Otherwise curves are summed over wavelengths.
    pub(super) fn serves(axis: LogAxis) -> bool {
        per_unit(axis) <= MOST
    }

    /// Whether a table of a narrow curve would have at most [`MOST_ENTRIES`] entries.
    pub(super) fn fits(axis: LogAxis, reach: f64, support_nm: Option<[f64; 2]>) -> bool {
        let [low, high] = interesting(axis, reach, support_nm);
        (high - low) * per_unit(axis) <= MOST_ENTRIES
    }

    /// Distance of entries in ln D.
    pub(super) fn spacing(axis: LogAxis) -> f64 {
        1.0 / per_unit(axis)
    }

    /// Tabulates `read(D, out)`, which writes the curve's shape at D·λ and returns its factor, for
    /// |ln D| ≤ `reach`, less where the curve, constant outside of `support_nm`, changes less far.
    pub(super) fn new(
        sensor: &Sensor,
        reach: f64,
        support_nm: Option<[f64; 2]>,
        mut read: impl FnMut(f64, &mut [f32]) -> f64,
    ) -> Self {
        let mut shape = vec![0.0; sensor.axis().count()];
        Self::of(sensor.axis(), reach, support_nm, |ln_doppler| {
            let factor = read(ln_doppler.exp(), &mut shape);
            sensor.xyz_of_shape(&shape).map(|v| v * factor)
        })
    }

    /// The same of a curve of samples `fine`.
    pub(super) fn of_fine(
        sensor: &FineSensor,
        fine: &Fine,
        reach: f64,
        support_nm: Option<[f64; 2]>,
    ) -> Self {
        Self::of(sensor.axis(), reach, support_nm, |ln_doppler| {
            sensor.channels(fine, ln_doppler)
        })
    }

    fn of(
        axis: LogAxis,
        reach: f64,
        support_nm: Option<[f64; 2]>,
        channels: impl FnMut(f64) -> [f64; 3],
    ) -> Self {
        let per_unit = per_unit(axis);
        let [low, high] = interesting(axis, reach, support_nm);
        let count = ((high - low) * per_unit).ceil() as usize + 4;
        let ln_doppler = |i: usize| low + (i as f64 - 1.0) / per_unit;
        Self {
            entries: (0..count).map(ln_doppler).map(channels).collect(),
            start: low,
            per_unit,
        }
    }

    /// Memory of its entries, bytes.
    pub(super) fn bytes(&self) -> usize {
        size_of_val(&*self.entries)
    }

    /// The channels under the shift D = exp(`ln_doppler`); never negative.
    #[inline(always)]
    pub(super) fn at(&self, ln_doppler: f64) -> [f64; 3] {
        let last = (self.entries.len() - 4) as f64;
        let place = ((ln_doppler - self.start) * self.per_unit).clamp(0.0, last + 0.999_999);
        let first = place as usize;
        let taps = catmull_rom(place - first as f64);
        let mut sum = [0.0f64; 3];
        for (entry, tap) in self.entries[first..first + 4].iter().zip(taps) {
            for (sum, value) in sum.iter_mut().zip(entry) {
                *sum += tap * value;
            }
        }
        sum.map(|v| v.max(0.0))
    }
}

/// Entries per unit of ln D.
fn per_unit(axis: LogAxis) -> f64 {
    let width = axis.spacing() * axis.count() as f64;
    let finest = FINEST * (VISIBLE / width).max(1.0);
    (FINENESS / axis.spacing()).clamp(COARSEST, finest)
}

/// The range of ln D, within ±`reach`, in which any wavelength of the axis reads inside the support.
pub(super) fn interesting(axis: LogAxis, reach: f64, support_nm: Option<[f64; 2]>) -> [f64; 2] {
    let [low, high] = support_nm.map_or([0.0, 0.0], |[a, b]| {
        let longest = axis.wavelength_nm((axis.count() + 1) as f64);
        let shortest = axis.wavelength_nm(-2.0);
        [(a / longest).ln(), (b / shortest).ln()]
    });
    let low = low.max(-reach).min(reach);
    [low, high.min(reach).max(low)]
}

/// Adds channels times a factor.
#[inline(always)]
pub(super) fn add(sum: &mut [f64; 3], value: [f64; 3], factor: f64) {
    for (sum, value) in sum.iter_mut().zip(value) {
        *sum += value * factor;
    }
}
