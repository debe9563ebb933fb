//! Frames of a run as tasks, and batches of tasks that are rendered together: those that share a
//! trace, of any shots, as many as memory allows.

use super::memory::most_together;
use crate::frame::{FrameFingerprint, TraceKey};
use crate::render::Options;
use crate::store::{Claim, FileStamps, Status};

/// A frame to be rendered or kept.
#[derive(Debug, Clone)]
pub(super) struct FrameTask {
    /// Index of its job in the run.
    pub(super) job: usize,
    pub(super) frame: u32,
    pub(super) trace: TraceKey,
    pub(super) status: Status,
    /// Stamps of its files at the time when `status` was determined; empty if there were none.
    pub(super) stamps: FileStamps,
    /// Expected cost, seconds.
    pub(super) work: f64,
}

impl FrameTask {
    /// Why it is rendered again, if it existed before.
    pub(super) fn reason(&self) -> Option<String> {
        match &self.status {
            Status::Fresh => Some("fresh, rendered by --force".to_owned()),
            Status::Missing => None,
            Status::Stale { reason } => Some(format!("stale because {reason}")),
        }
    }
}

/// A frame that this process has claimed.
pub(super) struct ClaimedFrame {
    pub(super) task: FrameTask,
    /// What the frame is made of.
    pub(super) key: FrameFingerprint,
    pub(super) claim: Claim,
}

/// Batches of tasks, in the order of the first task of each trace. A batch has one trace, and at most
/// [`most_together`] tasks. `options` are those of the jobs, by their numbers.
pub(super) fn batches(tasks: Vec<FrameTask>, options: &[&Options]) -> Vec<Vec<FrameTask>> {
    // Equal traces of two shots may still need different layers.
    let like = |one: &&Options| options.iter().position(|other| other == one);
    let layers: Vec<Option<usize>> = options.iter().map(like).collect();
    let mut groups = indexmap::IndexMap::<_, Vec<FrameTask>>::new();
    for task in tasks {
        let group = groups.entry((task.trace, layers[task.job]));
        group.or_default().push(task);
    }
    let mut batches = Vec::new();
    for tasks in groups.into_values() {
        let most = most_together(options[tasks[0].job]);
        batches.extend(tasks.chunks(most).map(<[FrameTask]>::to_vec));
    }
    batches
}
