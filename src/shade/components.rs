//! Shade trees to light where a spectrum is a row of numbers that multiply one by one: lines over
//! wavelength, or the three of a colour.
//!
//! Light is added up in the frame of what sends it, each lamp shifted into the frame of the
//! surface; one shift takes the sum to the camera.

use super::bake::{Settings, distinct_emitters};
use super::curve::Curve;
use super::received::{Received, finite};
use super::thermal::Glow;
use crate::scene::{Material, Reflectance, Scene};
use crate::spectrum::{LogAxis, Spectrum};
use crate::trace::{Node, Root, Seen, ShadeTrees, Surface};
use glam::DVec3;
use std::sync::Arc;

/// Numbers that stand for a spectrum.
pub(super) trait Components: Default {
    /// Adds `light` · `factor`, which is finite and at least 0.
    fn add(&mut self, light: &Self, factor: f64);

    /// Adds `light` · `share` · `factor`, the last two finite.
    fn add_product(&mut self, light: &Self, share: &Self, factor: f64);

    /// Multiplies one by one.
    fn multiply(&mut self, by: &Self);
}

/// How spectra become components, and what a shift does to them.
pub(super) trait Holding {
    /// What holds a spectrum.
    type Held: Components;

    /// Of light, by its curve over the wavelength in nm.
    fn light(&self, curve: impl Fn(f64) -> f64) -> Self::Held;

    /// Of what multiplies light.
    fn share(&self, curve: &Curve) -> Self::Held;

    /// Makes it nothing.
    fn clear(&self, held: &mut Self::Held);

    /// As seen under a shift: itself where that is exactly 1, else made in `buffer`.
    fn seen<'a>(
        &self,
        held: &'a Self::Held,
        shift: f64,
        buffer: &'a mut Self::Held,
    ) -> &'a Self::Held;

    /// Adds light of the sky from a unit direction of its own axes, in its rest frame.
    fn add_sky(&self, direction: DVec3, out: &mut Self::Held);
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

/// A material's terms.
struct Terms<C> {
    /// Reflectances of its lobes, in their order; those that are not specular stand first.
    lobes: Vec<C>,
    non_specular: usize,
    emission: Option<C>,
    thermal: Option<C>,
}

/// A scene's spectra in components.
pub(super) struct ComponentShader<H: Holding> {
    pub(super) holding: H,
    received: Received,
    surfaces: Vec<Terms<H::Held>>,
    /// Index of its emitter and scale, for each light.
    lamps: Vec<(usize, f64)>,
    emitters: Vec<H::Held>,
}

/// Memory of a walk through a tree, to be kept from ray to ray.
#[derive(Default)]
pub(super) struct Walk<C> {
    /// What the camera receives.
    sum: C,
    /// What a node sends.
    light: C,
    /// What a shift makes.
    buffer: C,
    /// What is left of a node's light on its way, for each node.
    ways: Vec<Way<C>>,
}

/// Light's way from a node to the camera.
#[derive(Default)]
struct Way<C> {
    /// Shares that are the same for all components; 0 where nothing passes.
    factor: f64,
    /// Of the surfaces that pass it on; without meaning for what the camera sees directly.
    share: C,
}

impl<H: Holding> ComponentShader<H> {
    /// Prepares a scene's spectra. The axis is that of its curves.
    pub(super) fn new(scene: &Scene, settings: &Settings<'_>, axis: LogAxis, holding: H) -> Self {
        let (lamps, spectra) = distinct_emitters(scene);
        let hold = Hold {
            holding: &holding,
            axis,
            thermal: settings.called.thermal,
        };
        Self {
            received: Received::new(settings.called),
            surfaces: scene.materials.iter().map(|m| hold.terms(m)).collect(),
            lamps,
            emitters: spectra.iter().map(|s| hold.light(s, 1.0)).collect(),
            holding,
        }
    }

    /// How many spectra it holds, at most.
    pub(super) fn held(&self) -> usize {
        let own_light = 2 * self.surfaces.len();
        let lobes = self.surfaces.iter().map(|s| s.lobes.len());
        lobes.sum::<usize>() + own_light + self.emitters.len()
    }

    /// What the camera receives along a ray.
    #[inline]
    pub(super) fn received<'a>(
        &self,
        trees: &ShadeTrees,
        root: Root,
        part: Part,
        walk: &'a mut Walk<H::Held>,
    ) -> &'a H::Held {
        self.holding.clear(&mut walk.sum);
        let nodes = trees.nodes_of(root);
        if walk.ways.len() < nodes.len() {
            walk.ways.resize_with(nodes.len(), Way::default);
        }
        for (index, node) in nodes.iter().enumerate() {
            self.pass(nodes, index, walk);
            if walk.ways[index].factor > 0.0 {
                self.add_node(trees, node, index, part, walk);
            }
        }
        &walk.sum
    }

    /// Follows the way of a node's light, through each surface under its shift to the camera.
    #[inline]
    fn pass(&self, nodes: &[Node], index: usize, walk: &mut Walk<H::Held>) {
        let (before, rest) = walk.ways.split_at_mut(index);
        let way = &mut rest[0];
        let Some(branch) = nodes[index].branch else {
            way.factor = 1.0;
            return;
        };
        let (by, earlier) = (
            nodes[branch.parent as usize],
            &before[branch.parent as usize],
        );
        let share = match by.seen {
            Seen::Surface(surface) => {
                Some(&self.surfaces[surface.material as usize].lobes[branch.lobe as usize])
            }
            Seen::Sky(_) => None,
        };
        let Some(share) = share else {
            way.factor = 0.0;
            return;
        };
        way.factor = earlier.factor * branch.share;
        let shift = self.received.shift(by.doppler);
        self.holding.clear(&mut way.share);
        way.share
            .add(self.holding.seen(share, shift, &mut walk.buffer), 1.0);
        if by.branch.is_some() {
            way.share.multiply(&earlier.share);
        }
    }

    /// Adds what the camera receives from a node.
    #[inline]
    fn add_node(
        &self,
        trees: &ShadeTrees,
        node: &Node,
        index: usize,
        part: Part,
        walk: &mut Walk<H::Held>,
    ) {
        let Walk {
            sum,
            light,
            buffer,
            ways,
        } = walk;
        self.holding.clear(light);
        match &node.seen {
            Seen::Sky(_) if part == Part::Thermal => return,
            Seen::Sky(direction) => self.holding.add_sky(*direction, light),
            Seen::Surface(surface) => self.add_surface(trees, surface, part, light, buffer),
        }
        let shift = self.received.shift(node.doppler);
        let power = finite(self.received.radiance(node.doppler));
        let seen = self.holding.seen(light, shift, buffer);
        let way = &ways[index];
        match node.branch {
            None => sum.add(seen, power),
            Some(_) => sum.add_product(seen, &way.share, finite(power * way.factor)),
        }
    }

    /// Adds what leaves a surface, in its rest frame.
    #[inline]
    fn add_surface(
        &self,
        trees: &ShadeTrees,
        surface: &Surface,
        part: Part,
        light: &mut H::Held,
        buffer: &mut H::Held,
    ) {
        let terms = &self.surfaces[surface.material as usize];
        if let Some(thermal) = &terms.thermal
            && part != Part::Surface
        {
            light.add(thermal, 1.0);
        }
        if part == Part::Thermal {
            return;
        }
        if let Some(emission) = &terms.emission {
            light.add(emission, 1.0);
        }
        for lit in trees.lamps_on(surface) {
            let (emitter, scale) = self.lamps[lit.light as usize];
            let scale = finite(scale * self.received.irradiance(lit.doppler));
            let shift = self.received.shift(lit.doppler);
            let arriving = self.holding.seen(&self.emitters[emitter], shift, buffer);
            let lobes = &terms.lobes[..terms.non_specular];
            for (reflectance, weight) in lobes.iter().zip(trees.weights_of(lit, lobes.len())) {
                if *weight > 0.0 {
                    light.add_product(arriving, reflectance, finite(scale * weight));
                }
            }
        }
    }
}

/// Turns a scene's spectra to components.
struct Hold<'a, H> {
    holding: &'a H,
    axis: LogAxis,
    thermal: bool,
}

impl<H: Holding> Hold<'_, H> {
    fn light(&self, spectrum: &Arc<Spectrum>, weight: f64) -> H::Held {
        let curve = Curve::new(spectrum, weight, f64::INFINITY, self.axis);
        self.holding.light(|nm| curve.at(nm))
    }

    fn share(&self, term: &Reflectance) -> H::Held {
        let curve = Curve::new(&term.spectrum, term.weight, 1.0, self.axis);
        self.holding.share(&curve)
    }

    fn terms(&self, material: &Material) -> Terms<H::Held> {
        let lobes = material.bsdf.lobes().iter();
        let glow = material.thermal.as_ref().filter(|_| self.thermal);
        Terms {
            lobes: lobes.map(|lobe| self.share(&lobe.reflectance)).collect(),
            non_specular: material.bsdf.non_specular().len(),
            emission: material
                .emission
                .as_ref()
                .map(|e| self.light(&e.spectrum, e.weight)),
            thermal: glow.map(|thermal| {
                let emissivity = Curve::new(&thermal.emissivity, 1.0, 1.0, self.axis);
                let glow = Glow::new(thermal, emissivity);
                self.holding.light(|nm| glow.at(nm))
            }),
        }
    }
}
