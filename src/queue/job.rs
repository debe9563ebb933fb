//! A shot of the run: which of its frames exist, and the outcome of each.

use super::batch::FrameTask;
use super::cost::Costs;
use super::memory::check_memory;
use super::settings::{Force, Output, Settings};
use super::shard::Shard;
use crate::accel::Aggregate;
use crate::frame::{Frame, FrameFingerprint, Frames, TraceKey};
use crate::progress::{FrameOutcome, Progress};
use crate::render::{Options, Prepared, ShotExposure};
use crate::scene::Scene;
use crate::shot::Mistakes;
use crate::store::{
    FileStamps, FolderError, Found, ManifestWriter, ShotFolder, Status, check_writable,
    refuse_link, sweep,
};
use rayon::prelude::*;
use std::collections::{BTreeMap, HashMap};
use std::io;
use std::path::PathBuf;

/// A shot of the run.
pub struct Job {
    /// Its frames in their folder.
    pub folder: ShotFolder,
    /// Outcomes of its frames so far, by number.
    pub outcomes: BTreeMap<u32, FrameOutcome>,
    /// The frames chosen.
    frames: Vec<u32>,
    /// Frames without an outcome yet; the run takes them.
    tasks: Vec<FrameTask>,
    /// Why this run can do no more for this shot.
    pub(super) halted: Option<String>,
    pub(super) prepared: Option<Prepared>,
    pub(super) manifest: Option<ManifestWriter>,
    pub(super) shot_exposure: Option<ShotExposure>,
    /// Bodies and trees for the next image.
    pub(super) kept: Option<(Scene, Aggregate)>,
    /// Whether it has been handed out as finished.
    pub(super) is_reported: bool,
}

impl Job {
    /// A job for the chosen frames of a shot. Its folder is read now, if images go there.
    ///
    /// # Errors
    /// A folder that cannot be read.
    pub(super) fn new(
        mut folder: ShotFolder,
        frames: Vec<u32>,
        output: Output<'_>,
    ) -> Result<Self, FolderError> {
        let statuses = if output.is_folder() {
            folder.refresh()?;
            look(&folder, &frames)
        } else {
            vec![(FileStamps::default(), Status::Missing); frames.len()]
        };
        let traces = folder.keys.trace_keys_of(&frames);
        let tasks = frames.iter().zip(traces).zip(statuses);
        let tasks = tasks.map(|((frame, trace), (stamps, status))| FrameTask {
            job: 0,
            frame: *frame,
            trace,
            status,
            stamps,
            work: 0.0,
        });
        Ok(Self {
            tasks: tasks.collect(),
            frames,
            folder,
            outcomes: BTreeMap::new(),
            halted: None,
            prepared: None,
            manifest: None,
            shot_exposure: None,
            kept: None,
            is_reported: false,
        })
    }

    /// The frames chosen.
    pub fn frames(&self) -> &[u32] {
        &self.frames
    }

    /// The chosen frames that are not up to date after this run.
    pub fn missing(&self) -> Vec<u32> {
        let is_there = |frame: &u32| {
            let outcome = self.outcomes.get(frame);
            matches!(
                outcome,
                Some(FrameOutcome::Kept { .. } | FrameOutcome::Rendered { .. })
            )
        };
        let frames = self.frames.iter().copied();
        frames.filter(|frame| !is_there(frame)).collect()
    }

    /// Reads the files of the shot, if a frame is to be rendered, and checks those frames. Nothing
    /// is read if all are fresh.
    ///
    /// # Errors
    /// All its mistakes.
    pub(super) fn prepare(&mut self, force: Force) -> Result<(), Mistakes> {
        let wanted = self.tasks.iter().filter(|task| is_wanted(task, force));
        let frames: Vec<u32> = wanted.map(|task| task.frame).collect();
        if !frames.is_empty() {
            let shot = self.folder.shot().clone();
            self.prepared = Some(Prepared::new(shot, frames.into_iter())?);
        }
        Ok(())
    }

    /// Size, samples and layers of its images.
    pub(super) fn options(&self) -> &Options {
        &self.folder.options
    }

    /// Prepares the folder, if a frame is to be rendered; if it cannot be written to, or the images
    /// do not fit into memory, the job is halted. Records frames that were found without a record.
    pub(super) fn prepare_folder(&mut self, shard: Option<Shard>) {
        if self.prepared.is_some() {
            self.halted = self.open_folder(shard).err();
        }
        let fresh = self.tasks.iter().filter(|t| t.status == Status::Fresh);
        let fresh: Vec<u32> = fresh.map(|task| task.frame).collect();
        let found = |frame: &u32| self.folder.found(*frame, &self.folder.keys.frame(*frame));
        let found: Vec<Found> = fresh.par_iter().filter_map(found).collect();
        if !found.is_empty() && self.halted.is_none() {
            // The images exist all the same.
            let _unwritten = self
                .open_manifest(shard)
                .map(|manifest| manifest.append_found(&found));
        }
    }

    /// Halts the job if its images do not fit into memory. Jobs that render to memory need no other
    /// preparation.
    pub(super) fn prepare_memory(&mut self) {
        let fits = check_memory(self.options());
        self.halted = fits.err().map(|error| error.to_string());
    }

    fn open_manifest(&self, shard: Option<Shard>) -> io::Result<ManifestWriter> {
        let ShotFolder { path, names, .. } = &self.folder;
        ManifestWriter::open(path, names, shard.map(Shard::numbers), self.folder.shot())
    }

    fn open_folder(&mut self, shard: Option<Shard>) -> Result<(), String> {
        check_memory(self.options()).map_err(|error| error.to_string())?;
        let (folder, names) = (&self.folder.path, &self.folder.names);
        std::fs::create_dir_all(folder).map_err(|error| {
            let folder = folder.display();
            format!("cannot make {folder}: {error}; name another folder with --out")
        })?;
        check_writable(&folder.join(names.frame(1, "png"))).map_err(|error| error.to_string())?;
        refuse_link(&folder.join(names.locks())).map_err(|error| error.to_string())?;
        sweep(folder, names);
        let manifest = self.open_manifest(shard);
        self.manifest = Some(manifest.map_err(|error| error.to_string())?);
        Ok(())
    }

    /// The tasks of number `job` of the run: first those to be rendered, then frames to be kept.
    pub(super) fn take_tasks(
        &mut self,
        job: usize,
        settings: &Settings<'_>,
    ) -> (Vec<FrameTask>, Vec<u32>) {
        let (mut wanted, kept): (Vec<_>, Vec<_>) = std::mem::take(&mut self.tasks)
            .into_iter()
            .partition(|task| is_wanted(task, settings.force));
        let costs = match settings.output.is_folder() {
            true => Costs::new(&self.folder),
            false => Costs::default(),
        };
        let costs = self.costs(&wanted, &costs);
        for (task, work) in wanted.iter_mut().zip(costs) {
            (task.job, task.work) = (job, work);
        }
        (wanted, kept.into_iter().map(|task| task.frame).collect())
    }

    /// Whether another process has brought a frame up to date since it was looked at.
    pub(super) fn was_rendered_meanwhile(&self, task: &FrameTask, key: &FrameFingerprint) -> bool {
        // Manifests are not read again for every frame: the files show enough.
        self.folder.stamps(task.frame) != task.stamps
            && self.folder.status(task.frame, key) == Status::Fresh
    }

    /// Paths of a frame's files.
    pub(super) fn files(&self, frame: u32) -> Vec<PathBuf> {
        let names = self.folder.files(frame).into_iter();
        names.map(|name| self.folder.path.join(name)).collect()
    }

    /// Seconds that each task is expected to take, of a shared trace its part.
    fn costs(&self, tasks: &[FrameTask], costs: &Costs) -> Vec<f64> {
        let mut sharing: HashMap<TraceKey, f64> = HashMap::new();
        for task in tasks {
            *sharing.entry(task.trace).or_default() += 1.0;
        }
        let mut frames = Frames::new(self.folder.shot());
        let seconds = |task: &FrameTask| {
            // A frame that is refused has no effects.
            let effects = frames.at(task.frame).map(Frame::active_names);
            let effects = effects.unwrap_or_default();
            let estimate = costs.estimate(&effects, self.folder.keys.resolution());
            estimate.trace / sharing[&task.trace] + estimate.shade
        };
        tasks.iter().map(seconds).collect()
    }

    /// Settles a frame that existed already.
    pub(super) fn keep(&mut self, frame: u32, progress: &Progress<'_>) {
        let outcome = FrameOutcome::Kept { reason: None };
        let (path, files) = (&self.folder.shot().path, self.files(frame));
        progress.frame(path, (frame, &outcome), &files, 0.0);
        self.outcomes.insert(frame, outcome);
    }

    /// Settles a frame, and reports it.
    pub(super) fn settle(
        &mut self,
        task: &FrameTask,
        outcome: FrameOutcome,
        progress: &Progress<'_>,
    ) {
        let path = &self.folder.shot().path;
        let files = self.files(task.frame);
        progress.frame(path, (task.frame, &outcome), &files, task.work);
        self.outcomes.insert(task.frame, outcome);
    }

    /// Settles a frame that failed.
    pub(super) fn fail(&mut self, task: &FrameTask, reason: &str, progress: &Progress<'_>) {
        let path = self.folder.shot().path.display();
        progress.error(&format!("{path}: frame {}: {reason}", task.frame));
        let reason = reason.to_owned();
        self.settle(task, FrameOutcome::Failed { reason }, progress);
    }

    /// Whether this run can do no more for the shot: its disk is full, or the folder cannot be
    /// written to.
    pub fn is_halted(&self) -> bool {
        self.halted.is_some()
    }

    /// Whether nothing is left to do for it.
    pub(super) fn is_settled(&self) -> bool {
        self.halted.is_some() || self.outcomes.len() == self.frames.len()
    }

    /// Frees the memory that rendering took.
    pub(super) fn release(&mut self) {
        (self.prepared, self.kept) = (None, None);
    }
}

/// The status of some frames. All at once, because those without a record are decoded.
fn look(folder: &ShotFolder, frames: &[u32]) -> Vec<(FileStamps, Status)> {
    let there = folder.there();
    let statuses = frames.par_iter().map(|frame| match there.contains(frame) {
        true => (
            folder.stamps(*frame),
            folder.status(*frame, &folder.keys.frame(*frame)),
        ),
        false => (FileStamps::default(), Status::Missing),
    });
    statuses.collect()
}

fn is_wanted(task: &FrameTask, force: Force) -> bool {
    force == Force::Yes || task.status != Status::Fresh
}

/// Keeps, in each folder, only the chosen frames of one shard. The contents of folders do not
/// matter, so that all machines divide the work in the same way.
pub(super) fn choose_shard(folders: &mut [(ShotFolder, Vec<u32>)], shard: Shard) {
    let all = folders.iter();
    let traces = all.flat_map(|(folder, frames)| folder.keys.trace_keys_of(frames));
    let mut ours = shard.choose(traces).into_iter();
    for (_, frames) in folders {
        frames.retain(|_| ours.next() == Some(true));
    }
}
