//! One image under one set of effects: everything a ray needs.

use super::{Member, rows, spliced};
use crate::accel::Aggregate;
use crate::plan::{self, Called, MotionError};
use crate::scene::{Material, Scene};
use crate::shade::{Settings, Shader};
use crate::shot::{Accuracy, Effects, Sensor, SensorColor, Shot, Spectra, Switch};
use crate::trace::{Spacetime, Tracer};
use std::ops::Range;
use std::sync::{Arc, OnceLock};

/// One image under one set of effects: everything that a ray needs.
pub struct View<'a> {
    scene: &'a Scene,
    stage: &'a Aggregate,
    /// What is simulated.
    pub called: Called,
    standing: Arc<Standing>,
    shader: Shader,
    /// Made when first asked for.
    curves: OnceLock<Shader>,
    bounces: u32,
    cutoff: f64,
    /// Largest |ln D| between a surface and the camera, and between a lamp and a surface.
    reaches: [f64; 2],
}

impl<'a> View<'a> {
    /// Prepares the image `frame` of a shot under the author's `switches`.
    ///
    /// # Errors
    /// Where a worldline has no velocity in this frame.
    pub fn new(
        shot: &Shot,
        frame: u32,
        switches: &Effects,
        scene: &'a Scene,
        stage: &'a Aggregate,
    ) -> Result<Self, MotionError> {
        Self::sharing(&Standings::default(), shot, frame, switches, scene, stage)
    }

    /// [`View::new`] among images in which worldlines stand to each other as `standings` has it.
    fn sharing(
        standings: &Standings,
        shot: &Shot,
        frame: u32,
        switches: &Effects,
        scene: &'a Scene,
        stage: &'a Aggregate,
    ) -> Result<Self, MotionError> {
        let called = plan::called(shot, frame, switches)?;
        // Where nothing moves the links are translations, which cost nothing; light still takes
        // its time to the camera.
        let standing = standings.under(switches.geometry, scene, stage);
        let bounces = if called.mirror || called.refraction {
            switches.bounces
        } else {
            0
        };
        // Between two bodies D is at most the square of what it is between either and the camera.
        let hops = 1.0 + 2.0 * f64::from(bounces);
        let settings = Settings {
            called: &called,
            accuracy: &shot.accuracy,
            sensor: &shot.sensor,
            reach: hops * standing.to_camera,
            lamp_reach: standing.to_lamps,
        };
        let shader = Shader::new(scene, &settings);
        let reaches = [settings.reach, settings.lamp_reach];
        Ok(Self {
            reaches,
            scene,
            stage,
            called,
            standing,
            shader,
            curves: OnceLock::new(),
            bounces,
            cutoff: shot.accuracy.cutoff,
        })
    }

    /// The scene.
    pub(super) fn scene(&self) -> &Scene {
        self.scene
    }

    /// The shader of this image.
    pub fn shader(&self) -> &Shader {
        &self.shader
    }

    /// The shader of this image as the CIE's observer sees it, whatever the shot's sensor makes of
    /// its window.
    pub fn eye(&self, shot: &Shot) -> Shader {
        let [reach, lamp_reach] = self.reaches;
        let settings = Settings {
            called: &self.called,
            accuracy: &shot.accuracy,
            sensor: &Sensor {
                color: SensorColor::Cie1931,
                ..shot.sensor.clone()
            },
            reach,
            lamp_reach,
        };
        Shader::new(self.scene, &settings)
    }

    /// The shader of curves over the sensor's own window, made once for all pixels that are asked
    /// about.
    pub fn curves(&self, shot: &Shot) -> &Shader {
        self.curves
            .get_or_init(|| self.shader_over(shot.sensor.window, shot.accuracy.wavelengths))
    }

    /// A shader of this image over another band (nm), for curves and not for images: spectra are
    /// evaluated as their author wrote them, so that no baking shows at any wavelength or shift.
    pub fn shader_over(&self, window_nm: [f64; 2], wavelengths: u32) -> Shader {
        let settings = Settings {
            called: &self.called,
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

    /// How its worldlines stand to each other.
    pub fn spacetime(&self) -> &Spacetime {
        &self.standing.spacetime
    }

    /// Whether mirrors or glass are followed.
    pub fn branches(&self) -> bool {
        self.bounces > 0
    }

    /// The tracer for its rays.
    pub fn tracer(&self) -> Tracer<'_> {
        Tracer {
            scene: self.scene,
            aggregate: self.stage,
            spacetime: self.spacetime(),
            shadows: self.called.shadows,
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
        let shadows = |view: &Self| !view.scene.lights.is_empty() && view.called.shadows;
        of_scene(self) == of_scene(other)
            && surfaces(self) == surfaces(other)
            && self.scene.worldlines == other.scene.worldlines
            && branches(self) == branches(other)
            && shadows(self) == shadows(other)
    }
}

/// How the worldlines of a scene stand to each other.
struct Standing {
    spacetime: Spacetime,
    /// Largest |ln D| of any worldline to the camera's.
    to_camera: f64,
    /// Largest |ln D| between any body and any lamp.
    to_lamps: f64,
}

/// [`Standing`] with light of finite speed and without, each made once for all images in which it
/// is the same.
#[derive(Default)]
pub(super) struct Standings {
    finite: OnceLock<Arc<Standing>>,
    snapshot: OnceLock<Arc<Standing>>,
}

impl Standings {
    fn under(&self, geometry: Switch, scene: &Scene, stage: &Aggregate) -> Arc<Standing> {
        let made = match geometry {
            Switch::Auto => &self.finite,
            Switch::Off => &self.snapshot,
        };
        let lamps = || scene.lights.iter().map(|light| light.worldline);
        let standing = made.get_or_init(|| {
            Arc::new(Standing {
                spacetime: Spacetime::new(scene, geometry == Switch::Auto),
                to_camera: largest_rapidity(
                    scene,
                    scene.camera.worldline,
                    0..scene.worldlines.len(),
                ),
                to_lamps: stage
                    .worldlines()
                    .map(|body| largest_rapidity(scene, body, lamps()))
                    .fold(0.0, f64::max),
            })
        });
        Arc::clone(standing)
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
        stage: &'a Aggregate,
        height: u32,
        standings: &Standings,
    ) -> Result<Self, MotionError> {
        let Member { shot, frame, scene } = member;
        let view =
            |switches: &Effects| View::sharing(standings, shot, frame, switches, scene, stage);
        Ok(Self {
            whole: view(&shot.effects)?,
            splices: shot
                .splice
                .iter()
                .map(|splice| Ok((rows(splice, height), view(&spliced(&shot.effects, splice))?)))
                .collect::<Result<_, _>>()?,
        })
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
