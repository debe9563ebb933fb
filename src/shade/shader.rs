//! The shader of one image: its materials and lamps with their curves ready.

use super::bake::{Bake, MOST_TABLES, Settings, Sight, Surface, distinct_emitters};
use super::received::Received;
use super::table::XyzTable;
use super::thermal::BlackBodies;
use crate::scene::Scene;
use crate::shot::{SensorColor, Spectra};
use crate::spectrum::{LogAxis, Sensor};
use crate::trace::{Lit, Node, Root, ShadeTrees};

/// Turns shade trees to light.
pub struct Shader {
    sensor: Sensor,
    received: Received,
    surfaces: Vec<Surface>,
    /// Index of its emitter and scale, for each light.
    lamps: Vec<(usize, f64)>,
    /// Distinct spectra of lamps.
    emitters: Vec<Sight>,
    background: Option<Sight>,
    bodies: Option<BlackBodies>,
    /// Whether tables stand in for sums over wavelengths.
    tabulated: bool,
}

impl Shader {
    /// Prepares the curves of a scene.
    pub fn new(scene: &Scene, settings: &Settings<'_>) -> Self {
        let axis = LogAxis::new(
            settings.sensor.window,
            settings.accuracy.wavelengths as usize,
        );
        let sensor = match settings.sensor.color {
            SensorColor::Cie1931 => Sensor::cie1931(axis),
            SensorColor::Bands => Sensor::bands(axis),
        };
        let (lamps, spectra) = distinct_emitters(scene);
        let tabulated = settings.accuracy.spectra == Spectra::Grid
            && XyzTable::serves(axis)
            && scene.materials.len() * spectra.len() <= MOST_TABLES;
        let bake = Bake {
            sensor: &sensor,
            settings,
            tabulated,
        };
        let emitters: Vec<Sight> = spectra
            .iter()
            .map(|spectrum| bake.emitter(spectrum))
            .collect();
        let surfaces: Vec<Surface> = scene
            .materials
            .iter()
            .map(|material| bake.surface(material, &emitters))
            .collect();
        let background =
            scene.background.spectrum.as_ref().map(|spectrum| {
                bake.sight(bake.curve(spectrum, 1.0, f64::INFINITY), settings.reach)
            });
        let bodies = surfaces
            .iter()
            .any(|s| s.glow.is_some())
            .then(|| BlackBodies::new(&sensor));
        Self {
            received: Received::new(settings.called),
            surfaces,
            lamps,
            emitters,
            background,
            bodies,
            tabulated,
            sensor,
        }
    }

    /// The axis of the sensor's wavelengths.
    pub fn axis(&self) -> LogAxis {
        self.sensor.axis()
    }

    /// The sensor's wavelengths, nm.
    pub fn wavelengths_nm(&self) -> Vec<f64> {
        self.sensor.axis().wavelengths_nm()
    }

    /// What the camera receives along a ray, in the sensor's channels: XYZ (cd/m²), or the totals of
    /// three bands (W·m⁻²·sr⁻¹).
    pub fn xyz(&self, trees: &ShadeTrees, root: Root, scratch: &mut ShadeScratch) -> [f64; 3] {
        match root {
            Root::Sky(d) => self
                .background
                .as_ref()
                .map_or([0.0; 3], |sky| self.sight(sky, d, scratch)),
            Root::Surface(index) => self.surface_xyz(trees, index, scratch),
        }
    }

    /// Spectral radiance (W·m⁻²·sr⁻¹·nm⁻¹) that the camera receives along a ray, at
    /// [`Shader::wavelengths_nm`].
    pub fn radiance(&self, trees: &ShadeTrees, root: Root) -> Vec<f64> {
        let mut out = vec![0.0; self.sensor.axis().count()];
        let mut scratch = ShadeScratch::default();
        match root {
            Root::Sky(d) => {
                if let Some(sky) = &self.background {
                    self.add_sight(sky, d, &mut out, &mut scratch);
                }
            }
            Root::Surface(index) => {
                let node = trees.nodes[index as usize];
                let surface = &self.surfaces[node.material as usize];
                if let Some(emission) = &surface.emission {
                    self.add_sight(emission, node.doppler, &mut out, &mut scratch);
                }
                if let Some(glow) = &surface.glow {
                    glow.add(node.doppler, self.received, self.sensor.axis(), &mut out);
                }
                for lit in lamps(trees, &node) {
                    self.add_lamp(surface, &node, lit, &mut out, &mut scratch);
                }
            }
        }
        out.iter_mut().for_each(|value| *value = finite(*value));
        out
    }

    /// The sensor's channels of spectral radiance at [`Shader::wavelengths_nm`].
    pub fn xyz_of(&self, radiance: &[f64]) -> [f64; 3] {
        self.sensor.xyz(radiance)
    }

    fn surface_xyz(&self, trees: &ShadeTrees, index: u32, scratch: &mut ShadeScratch) -> [f64; 3] {
        let node = trees.nodes[index as usize];
        let surface = &self.surfaces[node.material as usize];
        let mut sum = [0.0; 3];
        if let Some(emission) = &surface.emission {
            add(&mut sum, self.sight(emission, node.doppler, scratch), 1.0);
        }
        if let (Some(glow), Some(bodies)) = (&surface.glow, &self.bodies) {
            let [shape, _] = scratch.buffers(self.sensor.axis().count());
            let xyz = glow.xyz(node.doppler, self.received, &self.sensor, bodies, shape);
            add(&mut sum, xyz, 1.0);
        }
        if node.lamps > 0 {
            add(
                &mut sum,
                self.lamps_xyz(trees, &node, surface, scratch),
                1.0,
            );
        }
        sum
    }

    /// Light of the surface's lamps. Those that share the surface's shift are summed by emitter,
    /// so that each table is read once.
    fn lamps_xyz(
        &self,
        trees: &ShadeTrees,
        node: &Node,
        surface: &Surface,
        scratch: &mut ShadeScratch,
    ) -> [f64; 3] {
        let mut sum = [0.0; 3];
        let shift = self.received.shift(node.doppler);
        scratch.comoving.clear();
        scratch.comoving.resize(self.emitters.len(), [0.0; 2]);
        for lit in lamps(trees, node) {
            let (emitter, scale) = self.lamps[lit.light as usize];
            let scale = scale * self.received.irradiance(lit.doppler);
            let shares = [scale * lit.diffuse, scale * lit.highlight].map(finite);
            let lamp_shift = self.received.shift(lit.doppler);
            let shared = lamp_shift == 1.0 || self.emitters[emitter].curve.constant().is_some();
            if shared && self.tabulated {
                scratch.comoving[emitter][0] += shares[0];
                scratch.comoving[emitter][1] += shares[1];
            } else {
                let xyz = self.lamp_xyz(
                    surface,
                    emitter,
                    shares,
                    [shift, shift * lamp_shift],
                    scratch,
                );
                add(&mut sum, xyz, 1.0);
            }
        }
        let ln_shift = shift.ln();
        for (emitter, shares) in scratch.comoving.iter().enumerate() {
            for (term, share) in surface.reflecting().zip(shares) {
                if let Some(reflecting) = term
                    && *share > 0.0
                {
                    add(
                        &mut sum,
                        reflecting.tables[emitter].at(ln_shift),
                        finite(*share),
                    );
                }
            }
        }
        let power = self.received.radiance(node.doppler);
        sum.map(|v| v * power)
    }

    /// Light of one lamp that moves against the surface: two shifts, of reflectance and emitter.
    fn lamp_xyz(
        &self,
        surface: &Surface,
        emitter: usize,
        shares: [f64; 2],
        shifts: [f64; 2],
        scratch: &mut ShadeScratch,
    ) -> [f64; 3] {
        let mut sum = [0.0; 3];
        let [ln_surface, ln_lamp] = shifts.map(f64::ln);
        let emitter = &self.emitters[emitter];
        for (term, share) in surface.reflecting().zip(shares) {
            let Some(reflecting) = term else { continue };
            if share <= 0.0 {
                continue;
            }
            let reflectance = &reflecting.reflectance;
            let xyz = match (
                reflectance.constant(),
                reflectance.baked(),
                emitter.curve.baked(),
            ) {
                (Some(constant), ..) if self.tabulated => {
                    emitter.table.at(ln_lamp).map(|v| v * constant)
                }
                (None, Some(reflectance), Some(light)) => {
                    let peak = reflectance.peak() * light.peak();
                    let (one, other) = (reflectance.shifted(ln_surface), light.shifted(ln_lamp));
                    self.sensor.xyz_of_product(&one, &other).map(|v| v * peak)
                }
                _ => {
                    let [light, reflected] = scratch.buffers(self.sensor.axis().count());
                    let factor = emitter.curve.read(shifts[1], light)
                        * reflectance.read(shifts[0], reflected);
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

    /// Adds the spectral radiance that one lamp makes of a surface.
    fn add_lamp(
        &self,
        surface: &Surface,
        node: &Node,
        lit: &Lit,
        out: &mut [f64],
        scratch: &mut ShadeScratch,
    ) {
        let (emitter, scale) = self.lamps[lit.light as usize];
        let [light, reflected] = scratch.buffers(out.len());
        let shift = self.received.shift(node.doppler);
        let peak = self.emitters[emitter]
            .curve
            .read(shift * self.received.shift(lit.doppler), light);
        let factor = scale
            * peak
            * self.received.radiance(node.doppler)
            * self.received.irradiance(lit.doppler);
        for (term, share) in [
            (&surface.diffuse, lit.diffuse),
            (&surface.highlight, lit.highlight),
        ] {
            if let Some(reflecting) = term
                && share > 0.0
            {
                let factor = finite(factor * share * reflecting.reflectance.read(shift, reflected));
                for ((out, light), reflected) in out.iter_mut().zip(&*light).zip(&*reflected) {
                    *out += factor * f64::from(light * reflected);
                }
            }
        }
    }

    fn sight(&self, sight: &Sight, d: f64, scratch: &mut ShadeScratch) -> [f64; 3] {
        let power = self.received.radiance(d);
        let shift = self.received.shift(d);
        if self.tabulated {
            return sight.table.at(shift.ln()).map(|v| v * power);
        }
        let [shape, _] = scratch.buffers(self.sensor.axis().count());
        let factor = finite(sight.curve.read(shift, shape) * power);
        self.sensor.xyz_of_shape(shape).map(|v| v * factor)
    }

    fn add_sight(&self, sight: &Sight, d: f64, out: &mut [f64], scratch: &mut ShadeScratch) {
        let [shape, _] = scratch.buffers(out.len());
        let peak = sight.curve.read(self.received.shift(d), shape);
        let factor = finite(peak * self.received.radiance(d));
        for (out, shape) in out.iter_mut().zip(&*shape) {
            *out += factor * f64::from(*shape);
        }
    }
}

/// Scratch memory of a [`Shader`], to be kept from ray to ray.
#[derive(Default)]
pub struct ShadeScratch {
    comoving: Vec<[f64; 2]>,
    light: Vec<f32>,
    reflected: Vec<f32>,
}

impl ShadeScratch {
    fn buffers(&mut self, count: usize) -> [&mut [f32]; 2] {
        self.light.resize(count, 0.0);
        self.reflected.resize(count, 0.0);
        [&mut self.light, &mut self.reflected]
    }
}

fn lamps<'a>(trees: &'a ShadeTrees, node: &Node) -> &'a [Lit] {
    &trees.lit[node.first_lamp as usize..(node.first_lamp + node.lamps) as usize]
}

/// Held to the largest number: infinitely much of nothing would be no number.
#[inline(always)]
fn finite(value: f64) -> f64 {
    value.min(f64::MAX)
}

#[inline(always)]
fn add(sum: &mut [f64; 3], value: [f64; 3], factor: f64) {
    for (sum, value) in sum.iter_mut().zip(value) {
        *sum += value * factor;
    }
}
