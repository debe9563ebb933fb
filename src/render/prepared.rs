//! Shots read with all files that they name and checked frame by frame; and their exposure.

use super::metered_exposure;
use crate::accel::Aggregate;
use crate::frame::{Frame, Frames, refuse_shifted_rgb};
use crate::scene::{Library, Scene};
use crate::shade::{Settings, Unresolved, unresolved};
use crate::shot::{self, Exposure, Mistakes, Shot};
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
    pub fn exposure(&self) -> Result<(Exposing, Option<(Scene, Aggregate)>), Mistakes> {
        match &self.shot.sensor.exposure {
            Exposure::Stops(_) => Ok((Exposing::Authored, None)),
            Exposure::Auto(_) => {
                let metered = metered_exposure(&self.shot, &self.library)?;
                let exposing = metered.stops.map_or(Exposing::Black, Exposing::Metered);
                Ok((exposing, Some((metered.scene, metered.aggregate))))
            }
        }
    }
}

/// The exposure of a shot's frames.
#[derive(Debug, Clone)]
pub enum Exposing {
    /// As the author wrote it.
    Authored,
    /// As metered on frame 1, in stops.
    Metered(f64),
    /// 0 stops, because frame 1 was metered and is black.
    Black,
}

impl Exposing {
    /// Exposure of one frame, in stops.
    pub fn stops(&self, frame: &Frame<'_>) -> f64 {
        match self {
            Self::Authored => frame.exposure_stops.unwrap_or_default(),
            Self::Metered(stops) => *stops,
            Self::Black => 0.0,
        }
    }
}
