//! The jobs of a run: shots opened, frames chosen, and all errors.

use super::frames::FrameList;
use super::job::{Job, choose_shard};
use super::settings::Settings;
use crate::progress::Progress;
use crate::shot::{Mistakes, Shot};
use crate::store::{FolderError, Names, Request, ShotFolder};
use std::collections::HashMap;

/// The jobs of a run, and the errors of the others.
#[derive(Default)]
pub(super) struct JobList {
    /// Those that can be rendered, in the order of the shots.
    pub(super) jobs: Vec<Job>,
    /// Mistakes of shots, in the order in which they were found. A run is not begun with any.
    pub(super) mistakes: Vec<Mistakes>,
    /// Folders that cannot be read; each was reported.
    pub(super) unreadable: Vec<FolderError>,
}

/// A run that contradicts itself or its shots, and does not begin.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct Contradiction(String);

impl JobList {
    /// Opens the jobs of some shots, reads what they name, where a frame is to be rendered, and warns
    /// of frames that a shot does not have and of what pictures will not show.
    ///
    /// # Errors
    /// Two shots that would write the same files, a size that is too large, a shot of which no frame
    /// is chosen.
    pub(super) fn open(shots: &[Shot], settings: &Settings<'_>) -> Result<Self, Contradiction> {
        let Settings { progress, .. } = *settings;
        if settings.output.is_folder() {
            refuse_same_folder(shots)?;
        }
        let choose = |shot| choose(shot, &settings.request, &settings.frames, progress);
        let chosen = shots.iter().map(choose);
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
            list.add(folder, frames, settings);
        }
        list.prepare(settings);
        Ok(list)
    }

    fn add(&mut self, folder: ShotFolder, frames: Vec<u32>, settings: &Settings<'_>) {
        let path = folder.shot().path.display().to_string();
        match Job::new(folder, frames, settings.output) {
            Ok(job) => self.jobs.push(job),
            Err(error) => {
                settings.progress.error(&format!("{path}: {error}"));
                self.unreadable.push(error);
            }
        }
    }

    fn prepare(&mut self, settings: &Settings<'_>) {
        for job in &mut self.jobs {
            self.mistakes.extend(job.prepare(settings.force).err());
        }
        let prepared = self.jobs.iter().filter_map(|job| job.prepared.as_ref());
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

/// The frames asked for that a shot has, at least one. Warns of others.
///
/// # Errors
/// A size that is too large, a list that has none of the shot's frames.
pub(super) fn choose(
    shot: &Shot,
    request: &Request,
    list: &FrameList,
    progress: &Progress<'_>,
) -> Result<Vec<u32>, Contradiction> {
    let frames = shot.shot.frames;
    let path = shot.path.display();
    let chosen = list.resolve(frames);
    request.check(shot).map_err(Contradiction)?;
    if chosen.frames.is_empty() {
        return Err(Contradiction(format!(
            "{path} has frames 1 to {frames}; none was chosen"
        )));
    }
    if chosen.outside > 0 {
        let outside = chosen.outside;
        progress.warn(&format!(
            "{path} has frames 1 to {frames}; {outside} others are left out"
        ));
    }
    Ok(chosen.frames)
}
