//! Finished frames: what `restframe verify` finds in a folder, and what `restframe assemble` makes
//! of it, read back by other programs.
//!
//! ffmpeg and ffprobe (5.1) must be installed.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test's helpers fail by panicking"
)]

mod finished {
    pub(crate) mod again;
    pub(crate) mod animations;
    pub(crate) mod desk;
    pub(crate) mod refusals;
    pub(crate) mod sheets;
    pub(crate) mod verify;
    pub(crate) mod videos;
}
