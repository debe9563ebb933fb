//! Curves over the sensor's wavelengths, baked or as their author wrote them, and tables that
//! stand in for them.

use super::bake::{Bake, MOST_TABLES, MaterialCurves, Settings, Sight, distinct_emitters};
use super::passage::Passages;
use super::radiance::Radiance;
use super::received::{Received, finite};
use super::shader::ShadeScratch;
use super::sky::SkyShade;
use super::table::XyzTable;
use super::thermal::BlackBodies;
use crate::scene::Scene;
use crate::shot::Spectra;
use crate::spectrum::{Quadrature, Sensor};
use crate::trace::{Node, Root, Seen, ShadeTrees, Surface};
use std::cell::OnceCell;
use std::sync::Arc;

/// Turns shade trees to light by curves over the sensor's wavelengths.
pub(super) struct CurveShader {
    pub(super) sensor: Sensor,
    pub(super) received: Received,
    pub(super) surfaces: Vec<MaterialCurves>,
    /// Index of its emitter and scale, for each light.
    pub(super) lamps: Vec<(usize, f64)>,
    /// Distinct spectra of lamps.
    pub(super) emitters: Vec<Sight>,
    pub(super) sky: SkyShade,
    bodies: Option<Arc<BlackBodies>>,
    /// Whether tables stand in for sums over wavelengths.
    pub(super) tabulated: bool,
    /// Largest |ln D| between a surface and the camera, and between a lamp and the camera.
    pub(super) reach: [f64; 2],
    /// What narrow curves that meet are summed by; None where none is.
    pub(super) quadrature: Option<Quadrature>,
}

impl CurveShader {
    /// Prepares the curves of a scene.
    pub(super) fn new(
        scene: &Scene,
        settings: &Settings<'_>,
        sensor: Sensor,
        quadrature: &Quadrature,
    ) -> Self {
        let axis = sensor.axis();
        let (lamps, spectra) = distinct_emitters(scene);
        let few = scene.materials.len() * spectra.len() <= MOST_TABLES;
        let tabulated = settings.accuracy.spectra == Spectra::Grid && XyzTable::serves(axis) && few;
        let bake = Bake {
            sensor: &sensor,
            settings,
            tabulated,
            few,
            quadrature,
            fine: OnceCell::new(),
        };
        let emitters: Vec<Sight> = spectra
            .iter()
            .map(|spectrum| bake.emitter(spectrum))
            .collect();
        let surfaces: Vec<MaterialCurves> = scene
            .materials
            .iter()
            .map(|material| bake.surface(material, &emitters))
            .collect();
        let glows = surfaces.iter().any(|s| s.glow.is_some());
        let bodies = (glows || scene.background.stars.is_some())
            .then(|| Arc::new(BlackBodies::new(&sensor)));
        if let (true, Some(bodies)) = (tabulated, &bodies) {
            // Before the threads that would wait for it.
            bodies.entries();
        }
        let sky = SkyShade::new(&scene.background, &bake, bodies.clone());
        Self {
            received: Received::new(settings.called),
            surfaces,
            lamps,
            emitters,
            sky,
            bodies,
            tabulated,
            reach: [settings.reach, settings.reach + settings.lamp_reach],
            quadrature: bake.fine.get().map(|_| quadrature.clone()),
            sensor,
        }
    }

    /// Memory of curves and tables, bytes.
    pub(super) fn bytes(&self) -> usize {
        self.surfaces
            .iter()
            .map(MaterialCurves::bytes)
            .sum::<usize>()
            + self.emitters.iter().map(Sight::bytes).sum::<usize>()
            + self.sky.bytes()
            + self.bodies.as_ref().map_or(0, |bodies| bodies.bytes())
    }

    /// What the camera receives along a ray, in the sensor's channels: XYZ (cd/m²), or the totals of
    /// three bands (W·m⁻²·sr⁻¹).
    pub(super) fn xyz(
        &self,
        trees: &ShadeTrees,
        root: Root,
        scratch: &mut ShadeScratch,
    ) -> [f64; 3] {
        match trees.nodes_of(root) {
            [] => [0.0; 3],
            [only] => self.node_xyz(trees, only, scratch),
            nodes => self.tree_xyz(trees, nodes, scratch),
        }
    }

    /// Spectral radiance that the camera receives along a ray, at the sensor's wavelengths.
    pub(super) fn radiance(&self, trees: &ShadeTrees, root: Root) -> Radiance {
        let count = self.sensor.axis().count();
        let mut sum = Radiance::new(count);
        let mut scratch = ShadeScratch::default();
        let mut passages = Passages::new(count);
        let nodes = trees.nodes_of(root);
        for node in nodes {
            self.pass(nodes, node, &mut passages);
            let mut light = Radiance::new(count);
            self.add_node(trees, node, &mut light, &mut scratch);
            for (sum, light) in sum.parts_mut().into_iter().zip(light.parts_mut()) {
                passages.weigh_last(light);
                for (sum, value) in sum.iter_mut().zip(&*light) {
                    *sum = finite(*sum + value);
                }
            }
        }
        sum
    }

    /// Light of a tree of several nodes, each through the mirrors and glass on its way.
    fn tree_xyz(&self, trees: &ShadeTrees, nodes: &[Node], scratch: &mut ShadeScratch) -> [f64; 3] {
        let count = self.sensor.axis().count();
        let mut passages = std::mem::take(&mut scratch.passages);
        passages.clear(count);
        let mut sum = [0.0; 3];
        for node in nodes {
            self.pass(nodes, node, &mut passages);
            if let Some(grey) = passages.last_grey() {
                if grey > 0.0 {
                    add(&mut sum, self.node_xyz(trees, node, scratch), grey);
                }
                continue;
            }
            if self.quadrature.is_some() && self.is_narrow(trees, nodes, node) {
                add(&mut sum, self.narrow_node(trees, nodes, node), 1.0);
                continue;
            }
            let mut light = std::mem::take(&mut scratch.radiance);
            light.clear(count);
            self.add_node(trees, node, &mut light, scratch);
            let mut total = light.total();
            passages.weigh_last(&mut total);
            add(&mut sum, self.sensor.xyz(&total), 1.0);
            scratch.radiance = light;
        }
        scratch.passages = passages;
        sum.map(finite)
    }

    /// Adds the way of a node's light to those of the tree's nodes before it.
    fn pass(&self, nodes: &[Node], node: &Node, passages: &mut Passages) {
        let Some(branch) = node.branch else {
            return passages.start();
        };
        let by = nodes[branch.parent as usize];
        let curve = match by.seen {
            Seen::Surface(surface) => {
                Some(self.surfaces[surface.material as usize].passing(branch.lobe))
            }
            Seen::Sky(_) => None,
        };
        passages.go_on(&branch, curve, self.received.shift(by.doppler));
    }

    fn node_xyz(&self, trees: &ShadeTrees, node: &Node, scratch: &mut ShadeScratch) -> [f64; 3] {
        match &node.seen {
            Seen::Sky(direction) => {
                let [shape, _] = scratch.buffers(self.sensor.axis().count());
                self.sky
                    .xyz(*direction, node.doppler, self.received, &self.sensor, shape)
            }
            Seen::Surface(surface) => self.surface_xyz(trees, surface, node.doppler, scratch),
        }
    }

    fn surface_xyz(
        &self,
        trees: &ShadeTrees,
        surface: &Surface,
        doppler: f64,
        scratch: &mut ShadeScratch,
    ) -> [f64; 3] {
        let curves = &self.surfaces[surface.material as usize];
        let mut sum = [0.0; 3];
        if let Some(emission) = &curves.emission {
            let [shape, _] = scratch.buffers(self.sensor.axis().count());
            let xyz = emission.xyz(doppler, self.received, &self.sensor, shape);
            add(&mut sum, xyz, 1.0);
        }
        if let (Some(glow), Some(bodies)) = (&curves.glow, &self.bodies) {
            let [shape, _] = scratch.buffers(self.sensor.axis().count());
            let xyz = glow.xyz(doppler, self.received, &self.sensor, bodies, shape);
            add(&mut sum, xyz, 1.0);
        }
        let lamps = trees.lamps_on(surface);
        if !lamps.is_empty() {
            add(
                &mut sum,
                self.lamps_xyz(trees, lamps, doppler, curves, scratch),
                1.0,
            );
        }
        sum
    }

    /// Adds the spectral radiance of one node as the camera would see it directly.
    fn add_node(
        &self,
        trees: &ShadeTrees,
        node: &Node,
        light: &mut Radiance,
        scratch: &mut ShadeScratch,
    ) {
        let doppler = node.doppler;
        let [shape, _] = scratch.buffers(self.sensor.axis().count());
        let surface = match &node.seen {
            Seen::Surface(surface) => surface,
            Seen::Sky(direction) => {
                return self.sky.add(
                    *direction,
                    doppler,
                    self.received,
                    &self.sensor,
                    &mut light.surface,
                    shape,
                );
            }
        };
        let curves = &self.surfaces[surface.material as usize];
        if let Some(emission) = &curves.emission {
            emission.add(doppler, self.received, &mut light.surface, shape);
        }
        if let Some(glow) = &curves.glow {
            glow.add(
                doppler,
                self.received,
                self.sensor.axis(),
                &mut light.thermal,
            );
        }
        for lit in trees.lamps_on(surface) {
            self.add_lamp(trees, curves, doppler, lit, &mut light.surface, scratch);
        }
    }
}

#[inline(always)]
pub(super) fn add(sum: &mut [f64; 3], value: [f64; 3], factor: f64) {
    for (sum, value) in sum.iter_mut().zip(value) {
        *sum += value * factor;
    }
}
