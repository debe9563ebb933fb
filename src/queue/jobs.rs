//! List of the jobs of a run: shots opened, frames chosen, and all mistakes in them.

use super::frames::Resolved;
use super::job::{Job, choose_shard};
use super::settings::Settings;
use crate::shot::{Mistakes, Shot};
use crate::store::{Names, ShotFolder};
use std::collections::HashMap;

/// The jobs of a run, and what was wrong with the others.
#[derive(Default)]
pub struct JobList {
    /// Those that can be rendered, in the order of the shots.
    pub jobs: Vec<Job>,
    /// Mistakes of shots, in the order in which they were found. A run is not begun with any.
    pub mistakes: Vec<Mistakes>,
    /// How many shots have a folder that cannot be read; why, was reported.
    pub unreadable: usize,
}

/// A run that contradicts itself or its shots: nothing of it is begun.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct Contradiction(String);

impl JobList {
    /// Opens the jobs of some shots. Warns of frames that a shot does not have.
    ///
    /// # Errors
    /// Two shots that would write the same files, a size that is too large, a shot of which no frame
    /// is chosen.
    pub fn open(shots: &[Shot], settings: &Settings<'_>) -> Result<Self, Contradiction> {
        let progress = settings.progress;
        refuse_same_folder(shots)?;
        let chosen = shots.iter().map(|shot| choose(shot, settings));
        let chosen = chosen.collect::<Result<Vec<_>, _>>()?;
        let mut list = Self::default();
        let mut folders = Vec::new();
        for (shot, frames) in shots.iter().zip(chosen) {
            match ShotFolder::new(shot, &settings.request) {
                Ok(folder) => folders.push((folder, frames)),
                Err(mistakes) => list.mistakes.push(mistakes),
            }
        }
        if let Some(shard) = settings.shard {
            choose_shard(&mut folders, shard);
            if !folders.is_empty() && folders.iter().all(|(_, frames)| frames.is_empty()) {
                let [k, n] = shard.numbers();
                progress.warn(&format!(
                    "no frame falls to shard {k}/{n}: there are fewer traces than shards"
                ));
            }
        }
        for (folder, frames) in folders {
            let path = folder.shot().path.display().to_string();
            match Job::new(folder, frames, settings.output) {
                Ok(job) => list.jobs.push(job),
                Err(error) => {
                    progress.error(&format!("{path}: {error}"));
                    list.unreadable += 1;
                }
            }
        }
        Ok(list)
    }

    /// Reads what the shots name, where a frame is to be rendered, and warns of what their pictures
    /// will not show. Mistakes are added to the list.
    pub fn prepare(&mut self, settings: &Settings<'_>) {
        for job in &mut self.jobs {
            self.mistakes.extend(job.prepare(settings.force).err());
        }
        let prepared = self.jobs.iter().filter_map(Job::prepared);
        for warning in prepared.flat_map(|prepared| prepared.warnings()) {
            settings.progress.warn(&warning);
        }
    }
}

/// Refuses two shots whose images would have the same names.
fn refuse_same_folder(shots: &[Shot]) -> Result<(), Contradiction> {
    let mut seen = HashMap::new();
    for shot in shots {
        let path = shot.path.display().to_string();
        if let Some(other) = seen.insert(Names::new(shot).stem, path.clone()) {
            return Err(Contradiction(format!(
                "{other} and {path} would write the same images; rename one, or render them apart with --out"
            )));
        }
    }
    Ok(())
}

/// The frames asked for that a shot has.
fn choose(shot: &Shot, settings: &Settings<'_>) -> Result<Vec<u32>, Contradiction> {
    let frames = shot.shot.frames;
    let path = shot.path.display();
    let Resolved {
        frames: chosen,
        outside,
    } = settings.frames.resolve(frames);
    settings.request.check(shot).map_err(Contradiction)?;
    if chosen.is_empty() {
        return Err(Contradiction(format!(
            "{path} has frames 1 to {frames}; none was chosen"
        )));
    }
    if outside > 0 {
        settings.progress.warn(&format!(
            "{path} has frames 1 to {frames}; {outside} others are left out"
        ));
    }
    Ok(chosen)
}
