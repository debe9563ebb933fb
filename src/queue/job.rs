//! A shot of the call: which of its frames are there, and what a run did about them.

use super::batch::Task;
use super::claim::refuse_link;
use super::claim::sweep;
use super::cost::Costs;
use super::deed::Deed;
use super::ledger::Ledger;
use super::manifest::Found;
use super::memory::check_memory;
use super::record::active_names;
use super::reel::{Glance, Reel, ReelError, Status};
use super::shard::Shard;
use super::shots::{Exposing, Prepared, Request};
use super::write::check_writable;
use crate::frame::{FrameFingerprint, TraceKey};
use crate::render::Options;
use crate::scene::Scene;
use crate::shot::{Mistakes, Shot};
use crate::trace::Stage;
use rayon::prelude::*;
use std::collections::{BTreeMap, HashMap};
use std::io;
use std::path::PathBuf;

/// Which frames of those chosen are rendered.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Force {
    /// Those that are missing or stale.
    #[default]
    No,
    /// All.
    Yes,
}

/// A shot of the call.
pub struct Job {
    /// Its frames in their folder.
    pub reel: Reel,
    /// What this run did about them so far.
    pub deeds: BTreeMap<u32, Deed>,
    /// Why this run can do no more for this shot.
    pub(super) halted: Option<String>,
    pub(super) options: Options,
    /// The frames chosen.
    chosen: Vec<Chosen>,
    pub(super) prepared: Option<Prepared>,
    pub(super) ledger: Option<Ledger>,
    pub(super) exposing: Option<Exposing>,
    /// Trees to be taken over by the next image.
    pub(super) kept: Option<(Scene, Stage)>,
    pub(super) end: End,
}

/// Whether a job's end has been told.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum End {
    Ahead,
    Told,
}

struct Chosen {
    frame: u32,
    trace: TraceKey,
    status: Status,
    /// The folder as it was when `status` was judged; nothing, where nothing was there.
    glance: Glance,
}

impl Job {
    /// A shot with the frames chosen of it.
    ///
    /// # Errors
    /// Files of the shot or of the folder that cannot be read.
    pub fn open(shot: &Shot, request: &Request, frames: &[u32]) -> Result<Self, ReelError> {
        let reel = Reel::new(shot, request);
        Self::new(reel.map_err(|m| ReelError::Mistakes(Box::new(m)))?, frames)
    }

    /// The frames chosen of a reel, whose folder is looked at now.
    ///
    /// # Errors
    /// A folder that cannot be read.
    pub fn new(mut reel: Reel, frames: &[u32]) -> Result<Self, ReelError> {
        reel.refresh()?;
        let there = reel.there();
        // All at once: those without a record are decoded.
        let statuses = frames.par_iter().map(|frame| match there.contains(frame) {
            true => (
                reel.glance(*frame),
                reel.status(*frame, &reel.keys.frame(*frame)),
            ),
            false => (Glance::default(), Status::Missing),
        });
        let statuses: Vec<_> = statuses.collect();
        let traces = reel.keys.trace_keys_of(frames);
        let chosen = frames.iter().zip(traces).zip(statuses);
        let chosen = chosen.map(|((frame, trace), (glance, status))| Chosen {
            frame: *frame,
            trace,
            status,
            glance,
        });
        Ok(Self {
            chosen: chosen.collect(),
            options: reel.options.clone(),
            reel,
            deeds: BTreeMap::new(),
            halted: None,
            prepared: None,
            ledger: None,
            exposing: None,
            kept: None,
            end: End::Ahead,
        })
    }

    /// How many frames were chosen.
    pub fn len(&self) -> usize {
        self.chosen.len()
    }

    /// Whether none was.
    pub fn is_empty(&self) -> bool {
        self.chosen.is_empty()
    }

    /// The frames chosen of which this run left none as it should be.
    pub fn missing(&self) -> Vec<u32> {
        let there = |frame: &u32| {
            let deed = self.deeds.get(frame);
            matches!(deed, Some(Deed::Kept { .. } | Deed::Rendered { .. }))
        };
        let frames = self.chosen.iter().map(|chosen| chosen.frame);
        frames.filter(|frame| !there(frame)).collect()
    }

    /// Reads what the shot names, if a frame is to be rendered, and checks those that are. Nothing
    /// is read where all is fresh.
    ///
    /// # Errors
    /// All its mistakes.
    pub fn prepare(&mut self, force: Force) -> Result<(), Mistakes> {
        let frames: Vec<u32> = self.wanted(force).map(|chosen| chosen.frame).collect();
        if !frames.is_empty() {
            let shot = self.reel.shot().clone();
            self.prepared = Some(Prepared::new(shot, frames.into_iter())?);
        }
        Ok(())
    }

    /// What the shot's files ask for and the picture will not show, if they have been read.
    pub fn prepared(&self) -> Option<&Prepared> {
        self.prepared.as_ref()
    }

    /// Makes the folder ready, if a frame is to be rendered; where it cannot be written to, or the
    /// images cannot be held, the job is halted. What was found without a record is written down.
    pub fn furnish(&mut self, shard: Option<Shard>) {
        if self.prepared.is_some() {
            self.halted = self.furnished(shard).err();
        }
        let fresh = self.chosen.iter().filter(|c| c.status == Status::Fresh);
        let fresh: Vec<u32> = fresh.map(|chosen| chosen.frame).collect();
        let found = |frame: &u32| self.reel.found(*frame, &self.reel.keys.frame(*frame));
        let found: Vec<Found> = fresh.par_iter().filter_map(found).collect();
        if !found.is_empty() && self.halted.is_none() {
            // The pictures are there all the same.
            let _unwritten = self
                .open_ledger(shard)
                .map(|ledger| ledger.append_found(&found));
        }
    }

    fn open_ledger(&self, shard: Option<Shard>) -> io::Result<Ledger> {
        let Reel { folder, names, .. } = &self.reel;
        Ledger::open(folder, names, shard, self.reel.shot())
    }

    fn furnished(&mut self, shard: Option<Shard>) -> Result<(), String> {
        check_memory(&self.options).map_err(|error| error.to_string())?;
        let (folder, names) = (&self.reel.folder, &self.reel.names);
        std::fs::create_dir_all(folder).map_err(|error| {
            let folder = folder.display();
            format!("cannot make {folder}: {error}; name another folder with --out")
        })?;
        check_writable(folder, &names.frame(1, "png")).map_err(|error| error.to_string())?;
        refuse_link(&folder.join(names.locks())).map_err(|error| error.to_string())?;
        sweep(folder, names);
        let ledger = self.open_ledger(shard);
        self.ledger = Some(ledger.map_err(|error| error.to_string())?);
        Ok(())
    }

    /// The frames to be rendered, as number `job` of the night.
    pub(super) fn tasks(&self, job: usize, force: Force) -> Vec<Task> {
        let task = |(chosen, work): (&Chosen, f64)| Task {
            job,
            frame: chosen.frame,
            trace: chosen.trace,
            because: match &chosen.status {
                Status::Fresh => Some("fresh, rendered by --force".to_owned()),
                Status::Missing => None,
                Status::Stale { because } => Some(format!("stale because {because}")),
            },
            glance: chosen.glance.clone(),
            work,
        };
        let wanted = self.wanted(force).zip(self.costs(force));
        wanted.map(task).collect()
    }

    /// The frames that are there already.
    pub(super) fn fresh(&self, force: Force) -> Vec<u32> {
        let fresh = |chosen: &&Chosen| force == Force::No && chosen.status == Status::Fresh;
        let frames = self.chosen.iter().filter(fresh);
        frames.map(|chosen| chosen.frame).collect()
    }

    fn wanted(&self, force: Force) -> impl Iterator<Item = &Chosen> {
        let all = self.chosen.iter();
        all.filter(move |chosen| force == Force::Yes || chosen.status != Status::Fresh)
    }

    /// Whether another process made a frame what it should be since it was looked at.
    pub(super) fn came_true(&self, task: &Task, key: &FrameFingerprint) -> bool {
        // Manifests are not read again, frame after frame: the files tell enough.
        self.reel.glance(task.frame) != task.glance
            && self.reel.status(task.frame, key) == Status::Fresh
    }

    /// Paths of a frame's files.
    pub(super) fn files(&self, frame: u32) -> Vec<PathBuf> {
        let names = self.reel.files(frame).into_iter();
        names.map(|name| self.reel.folder.join(name)).collect()
    }

    /// Seconds that each frame to be rendered is expected to take, of a shared trace its part.
    fn costs(&self, force: Force) -> impl Iterator<Item = f64> {
        let costs = Costs::new(&self.reel);
        let mut sharing: HashMap<TraceKey, f64> = HashMap::new();
        for chosen in self.wanted(force) {
            *sharing.entry(chosen.trace).or_default() += 1.0;
        }
        self.wanted(force).map(move |chosen| {
            let effects = active_names(self.reel.shot(), chosen.frame);
            let estimate = costs.estimate(&effects, self.reel.keys.resolution());
            estimate.trace / sharing[&chosen.trace] + estimate.shade
        })
    }

    /// Whether this run can do no more for the shot: its folder is full, or cannot be written to.
    pub fn is_halted(&self) -> bool {
        self.halted.is_some()
    }

    /// Whether nothing is left to do for it.
    pub(super) fn is_settled(&self) -> bool {
        self.halted.is_some() || self.deeds.len() == self.chosen.len()
    }

    /// Gives back what rendering took.
    pub(super) fn release(&mut self) {
        sweep(&self.reel.folder, &self.reel.names);
        (self.prepared, self.kept) = (None, None);
    }
}

/// Leaves each reel, of the frames chosen, those of one shard. Folders are not looked at: whatever a
/// machine finds there, all deal alike.
pub fn choose_shard(reels: &mut [(Reel, Vec<u32>)], shard: Shard) {
    let all = reels.iter();
    let traces = all.flat_map(|(reel, frames)| reel.keys.trace_keys_of(frames));
    let mut ours = shard.choose(traces).into_iter();
    for (_, frames) in reels {
        frames.retain(|_| ours.next() == Some(true));
    }
}
