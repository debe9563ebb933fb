//! A tree to spectral radiance at the sensor's wavelengths.

use super::throughput::Throughputs;
use crate::shade::curves::CurveShader;
use crate::shade::radiance::Radiance;
use crate::shade::received::{Doppler, finite};
use crate::shade::scratch::ShadeScratch;
use crate::shade::walk::{Lamps, SpectralBasis, Visit};
use crate::trace::{Root, ShadeTrees};
use glam::DVec3;

impl CurveShader {
    /// Spectral radiance that the camera receives along a ray.
    pub(crate) fn radiance(&self, trees: &ShadeTrees, root: Root) -> Radiance {
        let count = self.sensor.axis().count();
        let mut sum = Radiance::new(count);
        let mut scratch = ShadeScratch::default();
        let mut throughputs = Throughputs::new(count);
        for visit in self.walk.visits(trees, root) {
            self.push_throughput(&visit, &mut throughputs);
            let mut light = Radiance::new(count);
            self.add_node(&visit, &mut light, &mut scratch);
            for (sum, light) in sum.parts_mut().into_iter().zip(light.parts_mut()) {
                throughputs.weigh_by_last(light);
                for (sum, value) in sum.iter_mut().zip(&*light) {
                    *sum = finite(*sum + value);
                }
            }
        }
        sum
    }

    /// Adds the spectral radiance of one node as the camera would see it directly.
    pub(super) fn add_node(
        &self,
        visit: &Visit<'_>,
        light: &mut Radiance,
        scratch: &mut ShadeScratch,
    ) {
        visit.add_to(&mut Wavelengths {
            shader: self,
            scratch,
            light,
        });
    }
}

/// Sources as spectral radiance.
struct Wavelengths<'a> {
    shader: &'a CurveShader,
    scratch: &'a mut ShadeScratch,
    light: &'a mut Radiance,
}

impl SpectralBasis for Wavelengths<'_> {
    fn sky(&mut self, direction: DVec3, doppler: Doppler) {
        let Self {
            shader,
            scratch,
            light,
        } = self;
        let axis = shader.sensor.axis();
        let [shape, _] = scratch.buffers(axis.count());
        let out = &mut light.surface;
        shader.sky.add(direction, doppler, axis, out, shape);
    }

    fn emission(&mut self, material: usize, doppler: Doppler) {
        if let Some(emission) = &self.shader.materials[material].emission {
            let count = self.shader.sensor.axis().count();
            let [shape, _] = self.scratch.buffers(count);
            emission.add(doppler, &mut self.light.surface, shape);
        }
    }

    fn thermal(&mut self, material: usize, doppler: Doppler) {
        if let Some(thermal) = &self.shader.materials[material].thermal {
            let axis = self.shader.sensor.axis();
            thermal.add(doppler, axis, &mut self.light.thermal);
        }
    }

    fn lamps(&mut self, material: usize, doppler: Doppler, lamps: Lamps<'_>) {
        let out = &mut self.light.surface;
        let shift = doppler.shift();
        let reflectors = self.shader.materials[material].reflectors();
        for lamp in lamps.iter() {
            let [light, reflected] = self.scratch.buffers(out.len());
            let emitter = &self.shader.emitters[lamp.emitter];
            let peak = emitter.curve.read(shift * lamp.doppler.shift(), light);
            let factor = lamp.scale * peak * doppler.radiance() * lamp.doppler.irradiance();
            for (lobe, weight) in reflectors.iter().zip(lamp.weights) {
                if *weight > 0.0 {
                    let factor = finite(factor * weight * lobe.reflectance.read(shift, reflected));
                    for ((out, light), reflected) in out.iter_mut().zip(&*light).zip(&*reflected) {
                        *out += factor * f64::from(light * reflected);
                    }
                }
            }
        }
    }
}
