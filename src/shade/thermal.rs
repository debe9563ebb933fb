//! Thermal light. A black body at T received under D is a black body at D·T: D⁵ B(Dλ, T) = B(λ, DT).
//! So one table over temperature serves all black bodies under all Doppler factors; under other
//! powers of D what is left over is a factor.

use super::curve::{Curve, write_shape};
use super::received::{Doppler, finite};
use super::table::XyzTable;
use crate::scene::{self, Thermal};
use crate::spectrum::{LogAxis, Sensor, catmull_rom, planck};
use std::sync::OnceLock;

/// The sensor's channels of black bodies: the logarithms of the three over ln T.
pub(super) struct BlackbodyTable {
    /// Made when they are first asked for: spectral radiance needs none.
    entries: OnceLock<Vec<[f64; 3]>>,
    sensor: Sensor,
    coldest_k: f64,
    hottest_k: f64,
}

/// λT (nm·K) below which a body's light counts as 0; at the window's longest wavelength it is
/// the coldest entry, 25 K for the visible. There x = hc/(λkT) is 693, so B is less than 1e-301 of
/// c₁λ⁻⁵, which is at most 1e65 in any window: what a film holds ends at 1e-45, and an exposure
/// multiplies by 1e60 at most.
const DARK_NM_K: f64 = 25.0 * 830.0;
/// λT (nm·K) above which B is proportional to T (Rayleigh–Jeans) within x/2 = 2e-7; at the window's
/// shortest wavelength it is the hottest entry, 1e11 K for the visible.
const BRIGHT_NM_K: f64 = 1e11 * 360.0;
/// A channel of at most this counts as 0: it is less than any film holds.
const DARK: f64 = 1e-300;
/// Entries per unit of ln T. The logarithm's slope and curvature are about x, taken where most of
/// the channel's light is: the cubic's error is below 1e-6 at x = 20 (1000 K in the visible), 2e-5
/// at 200. Over the widest windows there are 8000 entries.
const PER_UNIT: f64 = 100.0;

impl BlackbodyTable {
    pub(super) fn new(sensor: &Sensor) -> Self {
        let [shortest, longest] = sensor.axis().window_nm();
        Self {
            entries: OnceLock::new(),
            sensor: sensor.clone(),
            coldest_k: DARK_NM_K / longest,
            hottest_k: BRIGHT_NM_K / shortest,
        }
    }

    /// The table.
    pub(super) fn entries(&self) -> &[[f64; 3]] {
        self.entries.get_or_init(|| self.tabulate())
    }

    fn tabulate(&self) -> Vec<[f64; 3]> {
        let sensor = &self.sensor;
        let wavelengths = sensor.axis().wavelengths_nm();
        let mut curve = vec![0.0; wavelengths.len()];
        let seen: Vec<(usize, f64)> = (0..)
            .zip(wavelengths)
            .filter(|(j, _)| sensor.sees(*j))
            .collect();
        let count = ((self.hottest_k / self.coldest_k).ln() * PER_UNIT).ceil() as usize + 4;
        (0..count)
            .map(|i| {
                let kelvin = self.coldest_k * ((i as f64 - 1.0) / PER_UNIT).exp();
                for (j, nm) in &seen {
                    curve[*j] = planck::radiance(*nm, kelvin);
                }
                sensor.xyz(&curve).map(|v| v.max(f64::MIN_POSITIVE).ln())
            })
            .collect()
    }

    /// Memory of the table, bytes.
    pub(super) fn bytes(&self) -> usize {
        self.entries
            .get()
            .map_or(0, |entries| size_of_val(&**entries))
    }

    /// XYZ (cd/m²), or band totals (W·m⁻²·sr⁻¹), of a black body.
    #[inline(always)]
    pub(super) fn xyz(&self, kelvin: f64) -> [f64; 3] {
        if kelvin <= self.coldest_k {
            return [0.0; 3];
        }
        let place = (kelvin.min(self.hottest_k) / self.coldest_k).ln() * PER_UNIT;
        let entries = self.entries();
        let first = (place as usize).min(entries.len() - 4);
        let taps = catmull_rom(place - first as f64);
        let beyond = (kelvin / self.hottest_k).max(1.0);
        let [_, below, above, _] = [0, 1, 2, 3].map(|i| entries[first + i]);
        [0, 1, 2].map(|c| {
            let ln: f64 = taps
                .iter()
                .zip(&entries[first..])
                .map(|(tap, entry)| tap * entry[c])
                .sum();
            // A warmer body is brighter at every wavelength, but a cubic would overshoot where a
            // channel starts: its sum over a coarse axis may be 0 at one entry and not at the next.
            let light = ln
                .clamp(below[c].min(above[c]), above[c].max(below[c]))
                .exp();
            if light > DARK { light * beyond } else { 0.0 }
        })
    }
}

/// Thermal light of a material: emissivity times Planck's curve.
pub(super) struct BlackbodySpectrum {
    temperature_k: f64,
    emissivity: Curve,
    /// 1, or what brings the peak of Planck's curve to the strength that the shot gives.
    scale: f64,
    /// The sensor's channels over ln D, for an emissivity that varies over wavelengths.
    table: Option<XyzTable>,
}

impl BlackbodySpectrum {
    pub(super) fn new(thermal: &Thermal, emissivity: Curve) -> Self {
        let scale = match thermal.curve {
            scene::Curve::Absolute => 1.0,
            scene::Curve::Peak(strength) => {
                // The peak of a very cold body underflows to 0.
                let peak = planck::peak_radiance(thermal.temperature_k);
                if peak > 0.0 {
                    (strength / peak).min(f64::MAX)
                } else {
                    0.0
                }
            }
        };
        Self {
            temperature_k: thermal.temperature_k,
            emissivity,
            scale,
            table: None,
        }
    }

    /// The same with a table of its light, if the emissivity is not constant. `table` makes it of a
    /// function as [`XyzTable::new`] takes it.
    pub(super) fn tabulated(
        mut self,
        axis: LogAxis,
        table: impl FnOnce(&dyn Fn(f64, &mut [f32]) -> f64) -> XyzTable,
    ) -> Self {
        if self.emissivity.constant().is_none() {
            self.table = Some(table(&|d, out| self.read(d, axis, out)));
        }
        self
    }

    /// The same with this table of its light over ln D.
    pub(super) fn with_table(mut self, table: XyzTable) -> Self {
        self.table = Some(table);
        self
    }

    /// Memory of its table, bytes.
    pub(super) fn bytes(&self) -> usize {
        self.table.as_ref().map_or(0, XyzTable::bytes)
    }

    /// Spectral radiance at a wavelength (nm) in the surface's rest frame; finite.
    pub(super) fn at(&self, nm: f64) -> f64 {
        finite(self.scale * self.emissivity.at(nm) * planck::radiance(nm, self.temperature_k))
    }

    /// Writes the shape of emissivity times Planck's curve at D·λ. Returns its factor.
    fn read(&self, shift: f64, axis: LogAxis, out: &mut [f32]) -> f64 {
        let value = |j: usize| {
            let nm = shift * axis.wavelength_nm(j as f64);
            self.emissivity.at(nm) * planck::radiance(nm, self.temperature_k)
        };
        write_shape(value, out)
    }

    /// The sensor's channels of the light as it is received. `scratch` has the length of the axis.
    pub(super) fn xyz(
        &self,
        doppler: Doppler,
        sensor: &Sensor,
        bodies: &BlackbodyTable,
        scratch: &mut [f32],
    ) -> [f64; 3] {
        let shift = doppler.shift();
        if let Some(emissivity) = self.emissivity.constant() {
            let factor = (emissivity * self.scale * doppler.black_body()).min(f64::MAX);
            return bodies.xyz(shift * self.temperature_k).map(|v| v * factor);
        }
        let factor = (self.scale * doppler.radiance()).min(f64::MAX);
        if let Some(table) = &self.table {
            return table.at(shift.ln()).map(|v| v * factor);
        }
        if let Some(narrow) = self.emissivity.narrow() {
            let seen = self.received(doppler);
            let black = |node| seen.black_at(narrow.wavelength_nm(node));
            return narrow.times(shift.ln(), black, scratch, |shape| {
                write_shape(
                    |j| seen.black_at(sensor.axis().wavelength_nm(j as f64)),
                    shape,
                )
            });
        }
        let peak = self.read(shift, sensor.axis(), scratch);
        sensor.xyz_of_shape(scratch).map(|v| v * peak * factor)
    }

    /// Adds the spectral radiance received at the axis' wavelengths.
    pub(super) fn add(&self, doppler: Doppler, axis: LogAxis, out: &mut [f64]) {
        let seen = self.received(doppler);
        if self.emissivity.narrow().is_some() {
            let mut shares = vec![0.0; axis.count()];
            let peak = self.emissivity.read(seen.shift, &mut shares);
            for (j, (out, share)) in out.iter_mut().zip(&shares).enumerate() {
                *out += seen.black_at(axis.wavelength_nm(j as f64)) * peak * f64::from(*share);
            }
            return;
        }
        for (j, out) in out.iter_mut().enumerate() {
            *out += seen.at(axis.wavelength_nm(j as f64));
        }
    }

    /// Temperature (K) and emissivity.
    pub(super) fn parts(&self) -> (f64, &Curve) {
        (self.temperature_k, &self.emissivity)
    }

    /// The light as it is received.
    pub(super) fn received(&self, doppler: Doppler) -> ReceivedBlackbody<'_> {
        let shift = doppler.shift();
        ReceivedBlackbody {
            factor: (self.scale * doppler.black_body()).min(f64::MAX),
            // A black body at D·T, and no power of D, which might overflow.
            kelvin: shift * self.temperature_k,
            emissivity: &self.emissivity,
            shift,
        }
    }
}

/// Thermal light as it is received.
pub(super) struct ReceivedBlackbody<'a> {
    factor: f64,
    kelvin: f64,
    pub(super) emissivity: &'a Curve,
    pub(super) shift: f64,
}

impl ReceivedBlackbody<'_> {
    /// Spectral radiance at a wavelength, W·m⁻²·sr⁻¹·nm⁻¹.
    pub(super) fn at(&self, nm: f64) -> f64 {
        self.factor * self.emissivity.at(self.shift * nm) * planck::radiance(nm, self.kelvin)
    }

    /// The same for emissivity 1.
    pub(super) fn black_at(&self, nm: f64) -> f64 {
        self.factor * planck::radiance(nm, self.kelvin)
    }
}
