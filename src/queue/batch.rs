//! Frames that are rendered together: those that share a trace, of whatever shots, as many as the
//! memory is meant to hold.

use super::job::Job;
use super::reel::Glance;
use crate::plan::FrameKey;
use crate::render::Options;

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
    pub(super) key: FrameKey,
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
    let mut groups = indexmap::IndexMap::<_, Vec<Task>>::new();
    for task in tasks {
        // Equal traces of two shots may still want other layers.
        let layers = format!("{:?}", jobs[task.job].options);
        let group = groups.entry((task.key.trace.clone(), layers));
        group.or_default().push(task);
    }
    let mut batches = Vec::new();
    for tasks in groups.into_values() {
        let most = FILMS / film_bytes(&jobs[tasks[0].job].options).max(1);
        let most = usize::try_from(most).unwrap_or(usize::MAX).max(1);
        batches.extend(tasks.chunks(most).map(<[Task]>::to_vec));
    }
    batches
}

/// Bytes of a film and its layers.
fn film_bytes(options: &Options) -> u64 {
    const VALUE: u64 = size_of::<f32>() as u64;
    let values = 3 + options.layers.len() as u64;
    u64::from(options.width) * u64::from(options.height) * values * VALUE
}
