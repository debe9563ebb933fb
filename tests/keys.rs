//! What a frame is made of: shots at one frame, fingerprints, hashes of files.

mod desk;
mod files;
mod fingerprints;
mod golden;
mod still;
mod traces;
