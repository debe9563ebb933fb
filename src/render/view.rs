//! The view of one image under one set of effects: everything that a ray needs.

use super::Member;
use crate::accel::Aggregate;
use crate::frame::{ActiveEffects, Frame, Sensor};
use crate::scene::{Material, Scene};
use crate::shade::{Settings, Shader};
use crate::shot::{Accuracy, Effects, SensorColor, Spectra, Switch};
use crate::trace::{Spacetime, Tracer};
use std::ops::Range;
use std::sync::{Arc, OnceLock};

/// One image under one set of effects: everything that a ray needs.
pub struct View<'a> {
    scene: &'a Scene,
    aggregate: &'a Aggregate,
    /// The effects that are simulated.
    pub effects: ActiveEffects,
    motion: Arc<RelativeMotion>,
    shader: Shader,
    /// Made on first use.
    curves: OnceLock<Shader>,
    bounces: u32,
    cutoff: f64,
    /// Largest |ln D| between a surface and the camera, and between a lamp and a surface.
    reaches: [f64; 2],
}

impl<'a> View<'a> {
    /// Prepares a frame's image under the author's `switches`: the frame's own effects, or those of a
    /// splice.
    pub fn new(
        frame: &Frame<'_>,
        switches: &Effects,
        scene: &'a Scene,
        aggregate: &'a Aggregate,
    ) -> Self {
        Self::sharing(
            &RelativeMotions::default(),
            frame,
            switches,
            scene,
            aggregate,
        )
    }

    /// [`View::new`] among images in which worldlines stand to each other as `motions` has it.
    fn sharing(
        motions: &RelativeMotions,
        frame: &Frame<'_>,
        switches: &Effects,
        scene: &'a Scene,
        aggregate: &'a Aggregate,
    ) -> Self {
        let effects = frame.active_effects(switches);
        // If nothing moves, the links are translations, which cost nothing; light still takes its
        // time to the camera.
        let motion = motions.under(switches.geometry, scene, aggregate);
        let bounces = if effects.mirror || effects.refraction {
            switches.bounces
        } else {
            0
        };
        // Between two bodies D is at most the square of what it is between either and the camera.
        let hops = 1.0 + 2.0 * f64::from(bounces);
        let settings = Settings {
            effects: &effects,
            accuracy: &frame.accuracy,
            sensor: &frame.sensor,
            reach: hops * motion.to_camera,
            lamp_reach: motion.to_lamps,
        };
        let shader = Shader::new(scene, &settings);
        let reaches = [settings.reach, settings.lamp_reach];
        Self {
            reaches,
            scene,
            aggregate,
            effects,
            motion,
            shader,
            curves: OnceLock::new(),
            bounces,
            cutoff: frame.accuracy.cutoff,
        }
    }

    /// The scene.
    pub(super) fn scene(&self) -> &Scene {
        self.scene
    }

    /// The shader of this image.
    pub fn shader(&self) -> &Shader {
        &self.shader
    }

    /// The shader of this image as the CIE's observer sees it, whatever the frame's sensor makes of
    /// its window.
    pub fn eye(&self, frame: &Frame<'_>) -> Shader {
        let [reach, lamp_reach] = self.reaches;
        let settings = Settings {
            effects: &self.effects,
            accuracy: &frame.accuracy,
            sensor: &Sensor {
                color: SensorColor::Cie1931,
                ..frame.sensor
            },
            reach,
            lamp_reach,
        };
        Shader::new(self.scene, &settings)
    }

    /// The shader of curves over the sensor's own window, made once for all pixels.
    pub fn curves(&self, frame: &Frame<'_>) -> &Shader {
        self.curves
            .get_or_init(|| self.shader_over(frame.sensor.window, frame.accuracy.wavelengths))
    }

    /// A shader of this image over another band (nm), for curves and not for images: spectra are
    /// evaluated as their author wrote them, so that no baking shows at any wavelength or shift.
    pub fn shader_over(&self, window_nm: [f64; 2], wavelengths: u32) -> Shader {
        let settings = Settings {
            effects: &self.effects,
            accuracy: &Accuracy {
                spectra: Spectra::Exact,
                wavelengths,
                ..Accuracy::default()
            },
            sensor: &Sensor {
                window: window_nm,
                ..Sensor::default()
            },
            // Nothing is tabulated over D.
            reach: 0.0,
            lamp_reach: 0.0,
        };
        Shader::new(self.scene, &settings)
    }

    /// Relative motion of its worldlines.
    pub fn spacetime(&self) -> &Spacetime {
        &self.motion.spacetime
    }

    /// Whether mirrors or glass are followed.
    pub fn branches(&self) -> bool {
        self.bounces > 0
    }

    /// The tracer for its rays.
    pub fn tracer(&self) -> Tracer<'_> {
        Tracer {
            scene: self.scene,
            aggregate: self.aggregate,
            spacetime: self.spacetime(),
            shadows: self.effects.shadows,
            bounces: self.bounces,
            cutoff: self.cutoff,
            clock: None,
        }
    }

    /// Whether tracing would give the same, as far as that is cheap to compare: false if images
    /// were put together that do not share a trace.
    pub(super) fn traces_like(&self, other: &Self) -> bool {
        let of_scene = |view: &Self| {
            let scene = view.scene;
            let numbers = [scene.materials.len(), scene.lights.len()];
            (numbers, scene.camera.worldline, scene.background.is_black())
        };
        let surfaces = |view: &Self| {
            let materials = view.scene.materials.iter();
            let lobes = materials.map(|m| m.bsdf.lobes().iter().map(|lobe| lobe.kind));
            lobes.map(Vec::from_iter).collect::<Vec<_>>()
        };
        let mut materials = self.scene.materials.iter();
        let passing = materials.any(Material::passes_light_on);
        let branches = |view: &Self| passing.then_some((view.bounces, view.cutoff));
        let shadows = |view: &Self| !view.scene.lights.is_empty() && view.effects.shadows;
        of_scene(self) == of_scene(other)
            && surfaces(self) == surfaces(other)
            && self.scene.worldlines == other.scene.worldlines
            && branches(self) == branches(other)
            && shadows(self) == shadows(other)
    }
}

/// Relative motion of the worldlines of a scene.
struct RelativeMotion {
    spacetime: Spacetime,
    /// Largest |ln D| of any worldline relative to the camera's.
    to_camera: f64,
    /// Largest |ln D| between any body and any lamp.
    to_lamps: f64,
}

/// [`RelativeMotion`] with light of finite speed and without, each made once for all images in which it
/// is the same.
#[derive(Default)]
pub(super) struct RelativeMotions {
    finite: OnceLock<Arc<RelativeMotion>>,
    snapshot: OnceLock<Arc<RelativeMotion>>,
}

impl RelativeMotions {
    fn under(&self, geometry: Switch, scene: &Scene, aggregate: &Aggregate) -> Arc<RelativeMotion> {
        let made = match geometry {
            Switch::Auto => &self.finite,
            Switch::Off => &self.snapshot,
        };
        let lamps = || scene.lights.iter().map(|light| light.worldline);
        let motion = made.get_or_init(|| {
            Arc::new(RelativeMotion {
                spacetime: Spacetime::new(scene, geometry == Switch::Auto),
                to_camera: largest_rapidity(
                    scene,
                    scene.camera.worldline,
                    0..scene.worldlines.len(),
                ),
                to_lamps: aggregate
                    .worldlines()
                    .map(|body| largest_rapidity(scene, body, lamps()))
                    .fold(0.0, f64::max),
            })
        });
        Arc::clone(motion)
    }
}

/// Largest |ln D| between the worldline `from` and any of `to`, with a margin for rounding.
fn largest_rapidity(scene: &Scene, from: usize, to: impl Iterator<Item = usize>) -> f64 {
    let own = scene.worldlines[from].celerity;
    let rapidity = |other: usize| {
        scene.worldlines[other]
            .celerity
            .seen_from(own)
            .magnitude()
            .asinh()
    };
    to.map(rapidity).fold(0.0, f64::max) * (1.0 + 1e-9) + 1e-9
}

/// The views of one image: its own, and those of rows that splices cover.
pub(super) struct Views<'a> {
    whole: View<'a>,
    splices: Vec<(Range<u32>, View<'a>)>,
}

impl<'a> Views<'a> {
    /// Prepares an image of `height` rows.
    pub(super) fn new(
        member: Member<'a>,
        aggregate: &'a Aggregate,
        height: u32,
        motions: &RelativeMotions,
    ) -> Self {
        let Member { frame, scene } = member;
        let view = |switches: &Effects| View::sharing(motions, frame, switches, scene, aggregate);
        let splices = frame.splices.iter();
        Self {
            whole: view(&frame.effects),
            splices: splices
                .map(|splice| (splice.rows_of(height), view(&splice.effects)))
                .collect(),
        }
    }

    /// The view of a row.
    pub(super) fn of_row(&self, row: u32) -> &View<'a> {
        self.splices
            .iter()
            .rev()
            .find(|(rows, _)| rows.contains(&row))
            .map_or(&self.whole, |(_, view)| view)
    }

    /// Memory of its tables, in bytes.
    pub(super) fn bytes(&self) -> usize {
        let splices = self.splices.iter().map(|(_, view)| view);
        splices
            .chain([&self.whole])
            .map(|view| view.shader.bytes())
            .sum()
    }
}
