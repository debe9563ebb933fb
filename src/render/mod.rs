//! The renderer on one page: plan, trace, shade, film.

use crate::film::{Channels, Development, Film};
use crate::plan::{self, Called};
use crate::scene::Scene;
use crate::shade::{Settings, Shader};
use crate::shot::{Accuracy, Effects, Layer, Sensor, SensorColor, Shot, Spectra, Splice, Switch};
use crate::spectrum::color_space;
use crate::trace::{Samples, Spacetime, Stage, Surface, Tracer};
use glam::DVec3;
use rayon::prelude::*;
use std::ops::Range;
use std::time::Instant;

mod meter;
mod paint;
mod profile;
mod together;

pub use meter::{Metered, metered_exposure, motion_mistake};
pub use profile::{Profile, Seconds};
pub use together::{Member, Together, TogetherError, Watch, render_together};

use paint::{BAND, Painter, Row, empty_film, split_bands};
use profile::Lap;

/// Size and quality of an image, as asked for on the command line or by the shot.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Samples a pixel, at least 1.
    pub samples: u32,
    /// Layers beside the light.
    pub layers: Vec<Layer>,
}

/// One image under one set of effects: everything a ray needs.
pub struct View<'a> {
    scene: &'a Scene,
    stage: &'a Stage,
    /// What is simulated.
    pub called: Called,
    spacetime: Spacetime,
    shader: Shader,
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
        stage: &'a Stage,
    ) -> Result<Self, plan::MotionError> {
        let called = plan::called(shot, frame, switches)?;
        // Where nothing moves the links are translations, which cost nothing; light still takes
        // its time to the camera.
        let spacetime = Spacetime::new(scene, switches.geometry == Switch::Auto);
        let bounces = if called.mirror || called.refraction {
            switches.bounces
        } else {
            0
        };
        // Between two bodies D is at most the square of what it is between either and the camera.
        let hops = 1.0 + 2.0 * f64::from(bounces);
        let to_camera = largest_rapidity(scene, scene.camera.worldline, 0..scene.worldlines.len());
        let settings = Settings {
            called: &called,
            accuracy: &shot.accuracy,
            sensor: &shot.sensor,
            reach: hops * to_camera,
            lamp_reach: stage
                .worldlines()
                .map(|body| largest_rapidity(scene, body, scene.lights.iter().map(|l| l.worldline)))
                .fold(0.0, f64::max),
        };
        let shader = Shader::new(scene, &settings);
        let reaches = [settings.reach, settings.lamp_reach];
        Ok(Self {
            reaches,
            scene,
            stage,
            called,
            spacetime,
            shader,
            bounces,
            cutoff: shot.accuracy.cutoff,
        })
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

    /// A shader of this image over another band (nm), for curves rather than pictures: spectra are
    /// read as their author wrote them, so that no baking shows at any wavelength or shift.
    pub fn shader_over(&self, window_nm: [f64; 2], wavelengths: u32) -> Shader {
        let settings = Settings {
            called: &self.called,
            accuracy: &Accuracy {
                spectra: Spectra::Spline,
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
        &self.spacetime
    }

    /// Whether mirrors or glass are followed.
    pub fn branches(&self) -> bool {
        self.bounces > 0
    }

    /// What rays are traced through.
    pub fn tracer(&self) -> Tracer<'_> {
        Tracer {
            scene: self.scene,
            stage: self.stage,
            spacetime: &self.spacetime,
            shadows: self.called.shadows,
            bounces: self.bounces,
            cutoff: self.cutoff,
            clock: None,
        }
    }
}

/// Renders one image. `done` is told of finished rays, from any thread.
///
/// # Errors
/// Where a worldline has no velocity in this frame.
pub fn render(
    shot: &Shot,
    frame: u32,
    scene: &Scene,
    stage: &Stage,
    options: &Options,
    done: &(dyn Fn(u64) + Sync),
) -> Result<Film, plan::MotionError> {
    render_profiled(shot, frame, scene, stage, options, done, None)
}

/// [`render`], with its seconds counted in `profile` if there is one, which takes a little longer.
///
/// # Errors
/// Where a worldline has no velocity in this frame.
pub fn render_profiled(
    shot: &Shot,
    frame: u32,
    scene: &Scene,
    stage: &Stage,
    options: &Options,
    done: &(dyn Fn(u64) + Sync),
    profile: Option<&Profile>,
) -> Result<Film, plan::MotionError> {
    let begun = Instant::now();
    let view = |effects: &Effects| View::new(shot, frame, effects, scene, stage);
    let whole = view(&shot.effects)?;
    let splices = shot
        .splice
        .iter()
        .map(|splice| {
            Ok((
                rows(splice, options.height),
                view(&spliced(&shot.effects, splice))?,
            ))
        })
        .collect::<Result<Vec<_>, plan::MotionError>>()?;
    let view_of = |row: u32| {
        splices
            .iter()
            .rev()
            .find(|(rows, _)| rows.contains(&row))
            .map_or(&whole, |(_, view)| view)
    };
    if let Some(profile) = profile {
        profile.add(|sum| sum.prepare += begun.elapsed().as_secs_f64());
    }
    let samples = Samples::new(options.samples, shot.image.filter);
    let bands = (options.height as usize).div_ceil(BAND);
    let mut film = empty_film(options, channels(shot));
    let mut parts = split_bands(&mut film, bands);
    parts
        .par_iter_mut()
        .enumerate()
        .for_each_init(Painter::default, |painter, (band, part)| {
            painter.lap = profile.map(|_| Lap::default());
            let first = (band * BAND) as u32;
            let last = (first + BAND as u32).min(options.height);
            for row in first..last {
                let place = Row {
                    number: row,
                    in_band: (row - first) as usize,
                    options,
                };
                painter.paint(view_of(row), &samples, &place, part);
                done(u64::from(options.width) * u64::from(options.samples));
            }
            if let (Some(profile), Some(lap)) = (profile, &painter.lap) {
                lap.report(profile);
            }
        });
    Ok(film)
}

/// What the channels of a shot's films hold.
pub fn channels(shot: &Shot) -> Channels {
    match shot.sensor.color {
        SensorColor::Cie1931 => Channels::Xyz,
        SensorColor::Bands => Channels::Bands,
    }
}

/// How a shot's films are developed.
pub fn development(shot: &Shot, exposure_stops: f64) -> Development {
    const IDENTITY: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    Development {
        rgb_from_xyz: match channels(shot) {
            Channels::Xyz => color_space::RGB_FROM_XYZ,
            Channels::Bands => IDENTITY,
        },
        exposure_stops,
        encode: color_space::encode,
    }
}

/// Effects of a splice: the shot's, but for what it changes.
pub fn spliced(effects: &Effects, splice: &Splice) -> Effects {
    let over = &splice.effects;
    Effects {
        geometry: over.geometry.unwrap_or(effects.geometry),
        doppler: over.doppler.unwrap_or(effects.doppler),
        beaming: over.beaming.unwrap_or(effects.beaming),
        thermal: over.thermal.unwrap_or(effects.thermal),
        shadows: over.shadows.unwrap_or(effects.shadows),
        bounces: over.bounces.unwrap_or(effects.bounces),
    }
}

/// The rows that a splice covers: those whose centres lie in it.
pub fn rows(splice: &Splice, height: u32) -> Range<u32> {
    let row = |fraction: f64| (fraction * f64::from(height) - 0.5).ceil().max(0.0) as u32;
    row(splice.rows[0])..row(splice.rows[1]).min(height)
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

/// The light path from a surface to the camera, in the lab.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LabPath {
    /// The emission event.
    pub emission: crate::relativity::Event,
    /// Length, metres.
    pub distance: f64,
}

impl LabPath {
    /// The path to the first surface of a camera ray of unit `direction` (camera's rest frame).
    pub fn new(view: &View<'_>, surface: &Surface, direction: DVec3) -> Self {
        const LAB: usize = 0;
        let spacetime = &view.spacetime;
        let camera = spacetime.camera_event(LAB);
        // As light that travels from the surface to the camera: no cancellation far away.
        let light = spacetime
            .link(LAB, view.scene.camera.worldline)
            .light(-direction);
        let distance = surface.s * spacetime.path_ratio(light.frequency_ratio);
        let emission = crate::relativity::Event::new(
            camera.t - spacetime.delay(distance),
            camera.x - light.direction * distance,
        );
        Self { emission, distance }
    }
}
