//! Shots read with all files that they name and checked frame by frame; and their exposure.

use super::{Options, render};
use crate::accel::Aggregate;
use crate::film::auto_exposure;
use crate::frame::{Frame, Frames, refuse_shifted_rgb};
use crate::scene::{Library, Scene};
use crate::shade::{Settings, Unresolved, unresolved};
use crate::shot::{self, Exposure, LARGEST_SIDE, Mistakes, Shot};
use crate::trace::build_aggregate;
use indexmap::IndexSet;
use rayon::prelude::*;
use std::path::Path;

/// A shot without mistakes, and its files.
pub struct Prepared {
    /// The shot.
    pub shot: Shot,
    /// The files that it names.
    pub library: Library,
}

impl Prepared {
    /// Reads a shot and everything that it names, and resolves every frame.
    ///
    /// # Errors
    /// All mistakes of the shot.
    pub fn read(path: &Path) -> Result<Self, Mistakes> {
        let shot = shot::load(path)?;
        let frames = 1..=shot.shot.frames;
        Self::new(shot, frames)
    }

    /// Reads everything that a shot names, and resolves the given frames.
    ///
    /// # Errors
    /// All mistakes of the shot.
    pub fn new(shot: Shot, frames: impl Iterator<Item = u32>) -> Result<Self, Mistakes> {
        let library = Library::load(&shot)?;
        let frames: Vec<u32> = frames.collect();
        let wrong = frames.par_iter().map_init(
            || Frames::new(&shot),
            |all, number| {
                let frame = all.at(*number);
                frame.and_then(|frame| Scene::check(frame, &library)).err()
            },
        );
        // The first one, on any number of threads.
        if let Some(mistakes) = wrong.find_map_first(|mistakes| mistakes) {
            return Err(mistakes);
        }
        refuse_shifted_rgb(&shot)?;
        Ok(Self { shot, library })
    }

    /// Materials and lamps with bands that the sensor's wavelengths cannot resolve, by the first,
    /// the middle or the last frame: the first of these with a Doppler shift.
    pub fn unresolved(&self) -> Vec<Unresolved> {
        let frames = self.shot.shot.frames;
        let effects = [1, frames.div_ceil(2), frames]
            .into_iter()
            .find_map(|number| {
                let frame = Frame::new(&self.shot, number).ok()?;
                let effects = frame.active_effects(&frame.effects);
                effects.doppler.then_some((frame, effects))
            });
        let Some((frame, effects)) = effects else {
            return Vec::new();
        };
        let Ok(scene) = Scene::resolve(&frame, &self.library, None) else {
            return Vec::new();
        };
        let settings = Settings {
            effects: &effects,
            accuracy: &frame.accuracy,
            sensor: &frame.sensor,
            reach: 1.0,
            lamp_reach: 1.0,
        };
        unresolved(&scene, &settings)
    }

    /// Warnings: content of the shot's files that the image will not show, each once, and bands
    /// that its sensor cannot resolve.
    pub fn warnings(&self) -> Vec<String> {
        let seen: IndexSet<(&Path, String)> = self.library.warnings(&self.shot).collect();
        let line = |(file, warning): (&Path, String)| format!("{}: {warning}", file.display());
        let shot = self.shot.path.display();
        let unresolved = self.unresolved();
        let of_sensor = unresolved.iter().map(|pair| format!("{shot}: {pair}"));
        seen.into_iter().map(line).chain(of_sensor).collect()
    }

    /// The exposure of the shot's frames; and frame 1, if metering had to build it.
    ///
    /// # Errors
    /// Mistakes of frame 1.
    pub fn exposure(&self) -> Result<(ShotExposure, Option<(Scene, Aggregate)>), Mistakes> {
        match &self.shot.sensor.exposure {
            Exposure::Stops(_) => Ok((ShotExposure::Authored, None)),
            Exposure::Auto(_) => {
                let metered = metered_exposure(&self.shot, &self.library)?;
                let shot_exposure = metered
                    .stops
                    .map_or(ShotExposure::Black, ShotExposure::Metered);
                Ok((shot_exposure, Some((metered.scene, metered.aggregate))))
            }
        }
    }
}

/// The exposure of a shot's frames.
#[derive(Debug, Clone)]
pub enum ShotExposure {
    /// As the author wrote it.
    Authored,
    /// As metered on frame 1, in stops.
    Metered(f64),
    /// 0 stops, because frame 1 was metered and is black.
    Black,
}

impl ShotExposure {
    /// Exposure of one frame, in stops.
    pub fn stops(&self, frame: &Frame<'_>) -> f64 {
        match self {
            Self::Authored => frame.exposure_stops.unwrap_or_default(),
            Self::Metered(stops) => *stops,
            Self::Black => 0.0,
        }
    }
}

/// Result of metering, with the scene of frame 1, so that rendering it need not repeat the work.
pub struct Metered {
    /// Exposure in stops; None if the image is black.
    pub stops: Option<f64>,
    /// The scene of frame 1.
    pub scene: Scene,
    /// Its bodies.
    pub aggregate: Aggregate,
}

/// Exposure metered on a small render of frame 1, whatever frames are asked for.
///
/// # Errors
/// Mistakes of frame 1.
pub fn metered_exposure(shot: &Shot, library: &Library) -> Result<Metered, Mistakes> {
    let frame = Frame::new(shot, 1)?;
    let scene = Scene::resolve(&frame, library, None)?;
    let aggregate = build_aggregate(&scene.geometry, None);
    let [width, height] = frame.image.size.map(f64::from);
    let rows = (METER_WIDTH * height / width)
        .round()
        .clamp(1.0, LARGEST_SIDE.into());
    let options = Options {
        width: METER_WIDTH as u32,
        height: rows as u32,
        samples: 1,
        layers: Vec::new(),
    };
    let film = render(&frame, &scene, &aggregate, &options, &|_| ());
    Ok(Metered {
        stops: auto_exposure(&film),
        scene,
        aggregate,
    })
}

/// Width of the render for metering, pixels.
const METER_WIDTH: f64 = 160.0;
