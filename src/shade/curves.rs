//! The curves of a scene, for `accuracy.spectra = "grid"`, `"spline"` and `"exact"`: baked on the
//! sensor's axis, or as their author wrote them, and tables that stand in for them.

use super::bake::{Bake, MOST_TABLES};
use super::material::{EmitterTable, MaterialCurves};
use super::settings::Settings;
use super::sky::SkyShade;
use super::table::XyzTable;
use super::thermal::BlackbodyTable;
use super::walk::TreeWalk;
use crate::scene::Scene;
use crate::shot::Spectra;
use crate::spectrum::{Quadrature, Sensor};
use std::cell::OnceCell;
use std::sync::Arc;

/// The curves of a scene, ready to shade trees.
pub(super) struct CurveShader {
    pub(super) sensor: Sensor,
    pub(super) walk: TreeWalk,
    /// By material of the scene.
    pub(super) materials: Vec<MaterialCurves>,
    /// By emitter of [`TreeWalk::emitters`].
    pub(super) emitters: Vec<EmitterTable>,
    pub(super) sky: SkyShade,
    pub(super) bodies: Option<Arc<BlackbodyTable>>,
    /// Whether tables stand in for sums over wavelengths.
    pub(super) tabulated: bool,
    /// Largest |ln D| between a surface and the camera, and between a lamp and the camera.
    pub(super) reach: [f64; 2],
    /// Integrates narrow curves that meet; None where none is narrow.
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
        let walk = TreeWalk::new(scene, settings.effects);
        let few = scene.materials.len() * walk.emitters().len() <= MOST_TABLES;
        let tabulated = settings.accuracy.spectra == Spectra::Grid && XyzTable::serves(axis) && few;
        let bake = Bake {
            sensor: &sensor,
            settings,
            tabulated,
            few,
            quadrature,
            fine: OnceCell::new(),
        };
        let emitters = walk.emitters().iter();
        let emitters: Vec<EmitterTable> = emitters.map(|emitter| bake.emitter(emitter)).collect();
        let materials = scene.materials.iter();
        let materials: Vec<MaterialCurves> = materials
            .map(|material| bake.material(material, &emitters))
            .collect();
        let thermal = materials.iter().any(|material| material.thermal.is_some());
        let bodies = (thermal || scene.background.stars.is_some())
            .then(|| Arc::new(BlackbodyTable::new(&sensor)));
        if let (true, Some(bodies)) = (tabulated, &bodies) {
            // Before the threads that would wait for it.
            bodies.entries();
        }
        let sky = SkyShade::new(&scene.background, &bake, bodies.clone());
        Self {
            walk,
            materials,
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
        self.materials
            .iter()
            .map(MaterialCurves::bytes)
            .sum::<usize>()
            + self.emitters.iter().map(EmitterTable::bytes).sum::<usize>()
            + self.sky.bytes()
            + self.bodies.as_ref().map_or(0, |bodies| bodies.bytes())
    }
}
