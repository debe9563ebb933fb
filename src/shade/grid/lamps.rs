//! Channels of lamps on a surface, under the shifts of both.

use crate::shade::curve::Curve;
use crate::shade::curves::CurveShader;
use crate::shade::integrand::Reading;
use crate::shade::material::{MaterialCurves, ReflectorTables};
use crate::shade::received::{Doppler, finite};
use crate::shade::scratch::ShadeScratch;
use crate::shade::table::add;
use crate::shade::walk::Lamps;

/// The shifts of a surface's reflectance and of a lamp's light to the camera, and their logarithms.
struct Shifts {
    factors: [f64; 2],
    ln: [f64; 2],
}

fn any_narrow(one: &Curve, other: &Curve) -> bool {
    one.narrow().is_some() || other.narrow().is_some()
}

impl CurveShader {
    /// Light that a surface reflects of lamps. Those that share the surface's shift are summed by
    /// emitter, so that each table is read once.
    pub(super) fn lamps_xyz(
        &self,
        material: &MaterialCurves,
        doppler: Doppler,
        lamps: Lamps<'_>,
        scratch: &mut ShadeScratch,
    ) -> [f64; 3] {
        let mut sum = [0.0; 3];
        let shift = doppler.shift();
        let ln_shift = shift.ln();
        let lobes = material.reflectors();
        let mut comoving = std::mem::take(&mut scratch.comoving);
        comoving.clear();
        comoving.resize(self.emitters.len() * lobes.len(), 0.0);
        for lamp in lamps.iter() {
            let emitter = lamp.emitter;
            let scale = lamp.scale * lamp.doppler.irradiance();
            let shares = lamp.weights.iter().map(|weight| finite(scale * weight));
            let lamp_shift = lamp.doppler.shift();
            let shared = lamp_shift == 1.0 || self.emitters[emitter].curve.constant().is_some();
            if shared && lobes.iter().all(|lobe| lobe.tables[emitter].is_some()) {
                let sums = &mut comoving[emitter * lobes.len()..];
                sums.iter_mut()
                    .zip(shares)
                    .for_each(|(sum, share)| *sum += share);
            } else {
                let shifts = Shifts {
                    factors: [shift, shift * lamp_shift],
                    ln: [ln_shift, ln_shift + lamp_shift.ln()],
                };
                let xyz = self.lamp_xyz(lobes.iter().zip(shares), emitter, &shifts, scratch);
                add(&mut sum, xyz, 1.0);
            }
        }
        let emitters = comoving.chunks_exact(lobes.len().max(1));
        for (emitter, shares) in emitters.enumerate() {
            for (lobe, share) in lobes.iter().zip(shares) {
                if let Some(table) = &lobe.tables[emitter]
                    && *share > 0.0
                {
                    add(&mut sum, table.at(ln_shift), finite(*share));
                }
            }
        }
        scratch.comoving = comoving;
        let power = doppler.radiance();
        sum.map(|v| v * power)
    }

    /// Light of one lamp that moves against the surface: two shifts, of reflectance and emitter.
    /// Lobes come with their shares of the emitter's light.
    fn lamp_xyz<'a>(
        &self,
        lobes: impl Iterator<Item = (&'a ReflectorTables, f64)>,
        emitter: usize,
        shifts: &Shifts,
        scratch: &mut ShadeScratch,
    ) -> [f64; 3] {
        let mut sum = [0.0; 3];
        let [ln_surface, ln_lamp] = shifts.ln;
        let emitter = &self.emitters[emitter];
        for (lobe, share) in lobes {
            if share <= 0.0 {
                continue;
            }
            let reflectance = &lobe.reflectance;
            let xyz = match (
                reflectance.constant(),
                reflectance.baked(),
                emitter.curve.baked(),
            ) {
                (Some(constant), ..) if emitter.tabulated => {
                    emitter.table.at(ln_lamp).map(|v| v * constant)
                }
                _ if self.quadrature.is_some() && any_narrow(reflectance, &emitter.curve) => {
                    let curves = [reflectance, &emitter.curve];
                    self.narrow_lamp_xyz(curves, shifts, scratch)
                }
                (None, Some(reflectance), Some(light)) => {
                    let peak = reflectance.peak() * light.peak();
                    let (one, other) = (reflectance.shifted(ln_surface), light.shifted(ln_lamp));
                    self.sensor.xyz_of_product(&one, &other).map(|v| v * peak)
                }
                _ => {
                    let [light, reflected] = scratch.buffers(self.sensor.axis().count());
                    let factor = emitter.curve.read(shifts.factors[1], light)
                        * reflectance.read(shifts.factors[0], reflected);
                    for (reflected, light) in reflected.iter_mut().zip(&*light) {
                        *reflected *= light;
                    }
                    self.sensor.xyz_of_shape(reflected).map(|v| v * factor)
                }
            };
            add(&mut sum, xyz, share);
        }
        sum
    }

    /// Light of a lamp of 1 on a reflectance, of which at least one is narrow.
    fn narrow_lamp_xyz(
        &self,
        curves: [&Curve; 2],
        shifts: &Shifts,
        scratch: &mut ShadeScratch,
    ) -> [f64; 3] {
        let (narrow, ln_shift, smooth, shift) = match curves.map(Curve::narrow) {
            [Some(narrow), None] => (narrow, shifts.ln[0], curves[1], shifts.factors[1]),
            [None, Some(narrow)] => (narrow, shifts.ln[1], curves[0], shifts.factors[0]),
            _ => {
                let reading = |i: usize| Reading {
                    curve: curves[i],
                    shift: shifts.factors[i],
                };
                return self.meeting(&reading(0), &reading(1));
            }
        };
        let ln_own = shift.ln();
        let at = |node| smooth.at_node(ln_own, node, |node| narrow.wavelength_nm(node));
        let [shape, _] = scratch.buffers(self.sensor.axis().count());
        narrow.times(ln_shift, at, shape, |shape| smooth.read(shift, shape))
    }
}
