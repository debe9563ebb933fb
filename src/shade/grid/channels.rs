//! A tree to spectral radiance at the sensor's wavelengths, and to its channels: by tables over ln D where there are some, else by sums over the
//! sensor's wavelengths.

use super::throughput::Throughputs;
use crate::shade::curves::CurveShader;
use crate::shade::radiance::Radiance;
use crate::shade::received::{Doppler, finite};
use crate::shade::scratch::ShadeScratch;
use crate::shade::table::add;
use crate::shade::walk::{Lamps, SpectralBasis, Visit};
use crate::trace::{Root, ShadeTrees};
use glam::DVec3;

impl CurveShader {
    /// What the camera receives along a ray, in the sensor's channels.
    pub(crate) fn xyz(
        &self,
        trees: &ShadeTrees,
        root: Root,
        scratch: &mut ShadeScratch,
    ) -> [f64; 3] {
        if root.count > 1 {
            return self.tree_xyz(trees, root, scratch);
        }
        let mut visits = self.walk.visits(trees, root);
        let node = visits.next();
        node.map_or([0.0; 3], |node| self.node_xyz(&node, scratch))
    }

    /// Light of a tree of several nodes, each through the mirrors and glass on its way.
    fn tree_xyz(&self, trees: &ShadeTrees, root: Root, scratch: &mut ShadeScratch) -> [f64; 3] {
        let count = self.sensor.axis().count();
        let mut throughputs = std::mem::take(&mut scratch.throughputs);
        throughputs.clear(count);
        let mut sum = [0.0; 3];
        for visit in self.walk.visits(trees, root) {
            self.push_throughput(&visit, &mut throughputs);
            if let Some(gray) = throughputs.last_gray() {
                if gray > 0.0 {
                    add(&mut sum, self.node_xyz(&visit, scratch), gray);
                }
                continue;
            }
            if self.quadrature.is_some() && self.is_narrow(&visit) {
                add(&mut sum, self.narrow_node(&visit), 1.0);
                continue;
            }
            let mut light = std::mem::take(&mut scratch.radiance);
            light.clear(count);
            self.add_node(&visit, &mut light, scratch);
            let mut total = light.total();
            throughputs.weigh_by_last(&mut total);
            add(&mut sum, self.sensor.xyz(&total), 1.0);
            scratch.radiance = light;
        }
        scratch.throughputs = throughputs;
        sum.map(finite)
    }

    /// Adds the throughput of a node to those of the nodes before it.
    pub(super) fn push_throughput(&self, visit: &Visit<'_>, throughputs: &mut Throughputs) {
        match visit.passage() {
            None => throughputs.push_direct(),
            Some(passage) => throughputs.push(&passage, self.passed(&passage).curve),
        }
    }

    /// Light of one node as the camera would see it directly.
    #[inline]
    fn node_xyz(&self, visit: &Visit<'_>, scratch: &mut ShadeScratch) -> [f64; 3] {
        let mut channels = Channels {
            shader: self,
            scratch,
            sum: [0.0; 3],
        };
        visit.add_to(&mut channels);
        channels.sum
    }
}

/// Sources as channels.
struct Channels<'a> {
    shader: &'a CurveShader,
    scratch: &'a mut ShadeScratch,
    sum: [f64; 3],
}

impl SpectralBasis for Channels<'_> {
    #[inline]
    fn sky(&mut self, direction: DVec3, doppler: Doppler) {
        let sensor = &self.shader.sensor;
        let [shape, _] = self.scratch.buffers(sensor.axis().count());
        let xyz = self.shader.sky.xyz(direction, doppler, sensor, shape);
        add(&mut self.sum, xyz, 1.0);
    }

    #[inline]
    fn emission(&mut self, material: usize, doppler: Doppler) {
        if let Some(emission) = &self.shader.materials[material].emission {
            let sensor = &self.shader.sensor;
            let [shape, _] = self.scratch.buffers(sensor.axis().count());
            add(&mut self.sum, emission.xyz(doppler, sensor, shape), 1.0);
        }
    }

    #[inline]
    fn thermal(&mut self, material: usize, doppler: Doppler) {
        let thermal = &self.shader.materials[material].thermal;
        if let (Some(thermal), Some(bodies)) = (thermal, &self.shader.bodies) {
            let sensor = &self.shader.sensor;
            let [shape, _] = self.scratch.buffers(sensor.axis().count());
            let xyz = thermal.xyz(doppler, sensor, bodies, shape);
            add(&mut self.sum, xyz, 1.0);
        }
    }

    #[inline]
    fn lamps(&mut self, material: usize, doppler: Doppler, lamps: Lamps<'_>) {
        let material = &self.shader.materials[material];
        let xyz = self
            .shader
            .lamps_xyz(material, doppler, lamps, self.scratch);
        add(&mut self.sum, xyz, 1.0);
    }
}

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
