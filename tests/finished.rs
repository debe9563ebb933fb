//! Finished frames: what `restframe verify` finds in a folder, and what `restframe assemble` makes
//! of it, read back by other programs.
//!
//! ffmpeg and ffprobe (5.1) must be installed.
mod again;
mod animations;
mod desk;
mod refusals;
mod sheets;
mod verify;
mod videos;
