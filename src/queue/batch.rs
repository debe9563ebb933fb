//! Frames that are rendered together: those that share a trace, of whatever shots, as many as the
//! memory is meant to hold.

use super::job::Job;
use super::reel::Glance;
use crate::frame::TraceKey;
use crate::render::{Options, film_bytes};

/// Most memory for the films of a batch, bytes. A film of 1280 x 720 is 11 MiB: forty and more
/// share a trace, which leaves a fortieth of it to each; of more, little would be gained, and all
/// that a killed run was at work on is lost.
const FILMS: u64 = 512 << 20;

/// A frame to be rendered.
#[derive(Debug, Clone)]
pub(super) struct Task {
    /// Number of its job in the night.
    pub(super) job: usize,
    pub(super) frame: u32,
    pub(super) trace: TraceKey,
    /// Why, if it was there before.
    pub(super) because: Option<String>,
    /// The folder as it was when that was judged.
    pub(super) glance: Glance,
    /// What it is expected to cost.
    pub(super) work: f64,
}

/// Tasks in the order of work: by the first of each trace, tasks of one trace together, and so many
/// at once as [`FILMS`] holds.
pub(super) fn batches(tasks: Vec<Task>, jobs: &[Job]) -> Vec<Vec<Task>> {
    // Equal traces of two shots may still want other layers.
    let like = |job: &Job| jobs.iter().position(|other| other.options == job.options);
    let layers: Vec<Option<usize>> = jobs.iter().map(like).collect();
    let mut groups = indexmap::IndexMap::<_, Vec<Task>>::new();
    for task in tasks {
        let group = groups.entry((task.trace, layers[task.job]));
        group.or_default().push(task);
    }
    let mut batches = Vec::new();
    for tasks in groups.into_values() {
        let most = most_together(&jobs[tasks[0].job].options);
        batches.extend(tasks.chunks(most).map(<[Task]>::to_vec));
    }
    batches
}

/// How many frames that share a trace are in work at once: at least one, and so many that their
/// films take 512 MiB.
pub fn most_together(options: &Options) -> usize {
    let most = FILMS / film_bytes(options).max(1);
    usize::try_from(most).unwrap_or(usize::MAX).max(1)
}
