//! The checks that involve more than one key, the author's names or the disk.
//!
//! Each file checks one part of the shot. Values that the walk found mistaken are absent from the
//! shot by now: whether the author wrote a key is asked of the file's [`Places`](super::Places), and
//! which names exist of the walk.

mod bodies;
mod camera;
mod checks;
mod lights;
mod materials;
mod settings;
mod spectra;

pub use bodies::MAX_INSTANCES;
pub use spectra::ILLUMINANTS;

pub(super) use checks::check;
