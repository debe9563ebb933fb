//! Shade trees to light where a spectrum is a row of coefficients that multiply one by one: lines
//! over wavelength, or the three of a colour.
//!
//! Light is added up in the rest frame of what sends it, each lamp shifted into the rest frame of
//! the surface; one shift takes the sum to the camera.

use crate::scene::{Material, Scene, WeightedSpectrum};
use crate::shade::curve::Curve;
use crate::shade::received::{Doppler, finite};
use crate::shade::settings::Settings;
use crate::shade::thermal::BlackbodySpectrum;
use crate::shade::walk::{Lamps, SpectralBasis, TreeWalk, Visit};
use crate::spectrum::{LogAxis, Spectrum};
use crate::trace::{Root, ShadeTrees};
use glam::DVec3;
use std::sync::Arc;

/// Coefficients that stand for a spectrum.
pub(super) trait Coefficients: Default {
    /// Adds `light` · `factor`, which is finite and at least 0.
    fn add(&mut self, light: &Self, factor: f64);

    /// Adds `light` · `share` · `factor`, the last two finite.
    fn add_product(&mut self, light: &Self, share: &Self, factor: f64);

    /// Multiplies one by one.
    fn multiply(&mut self, by: &Self);
}

/// How spectra become coefficients, and what a shift does to them.
pub(super) trait CoefficientBasis {
    /// What stands for a spectrum.
    type Coefficients: Coefficients;

    /// Of light, by its curve over the wavelength in nm.
    fn light(&self, curve: impl Fn(f64) -> f64) -> Self::Coefficients;

    /// Of a reflectance, transmittance or emissivity.
    fn share(&self, curve: &Curve) -> Self::Coefficients;

    /// Makes all coefficients 0.
    fn clear(&self, coefficients: &mut Self::Coefficients);

    /// Coefficients under a shift: themselves where that is exactly 1, else made in `buffer`.
    fn shifted<'a>(
        &self,
        coefficients: &'a Self::Coefficients,
        shift: f64,
        buffer: &'a mut Self::Coefficients,
    ) -> &'a Self::Coefficients;

    /// Adds light of the sky from a unit direction of its own axes, in its rest frame.
    fn add_sky(&self, direction: DVec3, out: &mut Self::Coefficients);
}

/// Which light is asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Part {
    /// All of it.
    Whole,
    /// What is not thermal, and the sky.
    Surface,
    /// Thermal light of surfaces.
    Thermal,
}

/// Coefficients of a material.
struct MaterialCoefficients<C> {
    /// Reflectances of its lobes, in their order.
    lobes: Vec<C>,
    emission: Option<C>,
    thermal: Option<C>,
}

/// A scene's spectra as coefficients.
pub(super) struct CoefficientShader<B: CoefficientBasis> {
    pub(super) basis: B,
    walk: TreeWalk,
    materials: Vec<MaterialCoefficients<B::Coefficients>>,
    emitters: Vec<B::Coefficients>,
}

/// Memory of shading a tree, to be kept from ray to ray.
#[derive(Default)]
pub(crate) struct Shading<C> {
    /// What the camera receives.
    sum: C,
    /// What a node sends.
    light: C,
    /// What a shift makes.
    buffer: C,
    /// For each node.
    throughputs: Vec<Throughput<C>>,
}

/// What mirrors and glass leave of a node's light on its way to the camera.
#[derive(Default)]
struct Throughput<C> {
    /// Whether the camera sees the node directly.
    direct: bool,
    /// Shares that are the same for all coefficients; 0 where nothing passes.
    factor: f64,
    /// Product of the reflectances; without meaning where there are none.
    share: C,
}

impl<B: CoefficientBasis> CoefficientShader<B> {
    /// Prepares a scene's spectra. The axis is that of its curves.
    pub(super) fn new(scene: &Scene, settings: &Settings<'_>, axis: LogAxis, basis: B) -> Self {
        let walk = TreeWalk::new(scene, settings.effects);
        let hold = Hold {
            basis: &basis,
            axis,
            thermal: settings.effects.thermal,
        };
        let emitters = walk.emitters().iter();
        Self {
            materials: scene.materials.iter().map(|m| hold.material(m)).collect(),
            emitters: emitters.map(|s| hold.light(s, 1.0)).collect(),
            walk,
            basis,
        }
    }

    /// How many spectra it holds.
    pub(super) fn held(&self) -> usize {
        let of_material = |material: &MaterialCoefficients<_>| {
            let own_light = [&material.emission, &material.thermal];
            material.lobes.len() + own_light.into_iter().flatten().count()
        };
        self.materials.iter().map(of_material).sum::<usize>() + self.emitters.len()
    }

    /// What the camera receives along a ray.
    #[inline]
    pub(super) fn received<'a>(
        &self,
        trees: &ShadeTrees,
        root: Root,
        part: Part,
        shading: &'a mut Shading<B::Coefficients>,
    ) -> &'a B::Coefficients {
        self.basis.clear(&mut shading.sum);
        let count = root.count as usize;
        if shading.throughputs.len() < count {
            shading.throughputs.resize_with(count, Throughput::default);
        }
        for (index, visit) in self.walk.visits(trees, root).enumerate() {
            self.follow(&visit, index, shading);
            if shading.throughputs[index].factor > 0.0 {
                self.add_node(&visit, index, part, shading);
            }
        }
        &shading.sum
    }

    /// Makes the throughput of a node of those before it.
    #[inline]
    fn follow(&self, visit: &Visit<'_>, index: usize, shading: &mut Shading<B::Coefficients>) {
        let (before, rest) = shading.throughputs.split_at_mut(index);
        let own = &mut rest[0];
        let passage = visit.passage();
        own.direct = passage.is_none();
        own.factor = 1.0;
        let Some(passage) = passage else { return };
        let earlier = &before[passage.parent];
        own.factor = earlier.factor * passage.share;
        let share = &self.materials[passage.material].lobes[passage.lobe];
        let shift = passage.doppler.shift();
        self.basis.clear(&mut own.share);
        let seen = self.basis.shifted(share, shift, &mut shading.buffer);
        own.share.add(seen, 1.0);
        if !earlier.direct {
            own.share.multiply(&earlier.share);
        }
    }

    /// Adds what the camera receives from a node.
    #[inline]
    fn add_node(
        &self,
        visit: &Visit<'_>,
        index: usize,
        part: Part,
        shading: &mut Shading<B::Coefficients>,
    ) {
        let Shading {
            sum,
            light,
            buffer,
            throughputs,
        } = shading;
        self.basis.clear(light);
        visit.add_to(&mut RestFrame {
            shader: self,
            part,
            light,
            buffer,
        });
        let doppler = visit.doppler();
        let power = finite(doppler.radiance());
        let seen = self.basis.shifted(light, doppler.shift(), buffer);
        let throughput = &throughputs[index];
        if throughput.direct {
            sum.add(seen, power);
        } else {
            let factor = finite(power * throughput.factor);
            sum.add_product(seen, &throughput.share, factor);
        }
    }
}

/// Sources in the rest frame of what sends their light: the shift to the camera is applied to
/// their sum.
struct RestFrame<'a, B: CoefficientBasis> {
    shader: &'a CoefficientShader<B>,
    part: Part,
    light: &'a mut B::Coefficients,
    buffer: &'a mut B::Coefficients,
}

impl<B: CoefficientBasis> SpectralBasis for RestFrame<'_, B> {
    #[inline]
    fn sky(&mut self, direction: DVec3, _: Doppler) {
        if self.part != Part::Thermal {
            self.shader.basis.add_sky(direction, self.light);
        }
    }

    #[inline]
    fn emission(&mut self, material: usize, _: Doppler) {
        if let Some(emission) = &self.shader.materials[material].emission
            && self.part != Part::Thermal
        {
            self.light.add(emission, 1.0);
        }
    }

    #[inline]
    fn thermal(&mut self, material: usize, _: Doppler) {
        if let Some(thermal) = &self.shader.materials[material].thermal
            && self.part != Part::Surface
        {
            self.light.add(thermal, 1.0);
        }
    }

    #[inline]
    fn lamps(&mut self, material: usize, _: Doppler, lamps: Lamps<'_>) {
        if self.part == Part::Thermal {
            return;
        }
        let shader = self.shader;
        let lobes = &shader.materials[material].lobes;
        for lamp in lamps.iter() {
            let scale = finite(lamp.scale * lamp.doppler.irradiance());
            let emitter = &shader.emitters[lamp.emitter];
            let shift = lamp.doppler.shift();
            let arriving = shader.basis.shifted(emitter, shift, self.buffer);
            for (reflectance, weight) in lobes.iter().zip(lamp.weights) {
                if *weight > 0.0 {
                    let factor = finite(scale * weight);
                    self.light.add_product(arriving, reflectance, factor);
                }
            }
        }
    }
}

/// Turns a scene's spectra to coefficients.
struct Hold<'a, B> {
    basis: &'a B,
    axis: LogAxis,
    thermal: bool,
}

impl<B: CoefficientBasis> Hold<'_, B> {
    fn light(&self, spectrum: &Arc<Spectrum>, weight: f64) -> B::Coefficients {
        let curve = Curve::new(spectrum, weight, f64::INFINITY, self.axis);
        self.basis.light(|nm| curve.at(nm))
    }

    fn share(&self, share: &WeightedSpectrum) -> B::Coefficients {
        let curve = Curve::new(&share.spectrum, share.weight, 1.0, self.axis);
        self.basis.share(&curve)
    }

    fn material(&self, material: &Material) -> MaterialCoefficients<B::Coefficients> {
        let lobes = material.bsdf.lobes().iter();
        let emission = material.emission.as_ref();
        let thermal = material.thermal.as_ref().filter(|_| self.thermal);
        MaterialCoefficients {
            lobes: lobes.map(|lobe| self.share(&lobe.reflectance)).collect(),
            emission: emission.map(|e| self.light(&e.spectrum, e.weight)),
            thermal: thermal.map(|thermal| {
                let emissivity = Curve::new(&thermal.emissivity, 1.0, 1.0, self.axis);
                let light = BlackbodySpectrum::new(thermal, emissivity);
                self.basis.light(|nm| light.at(nm))
            }),
        }
    }
}
