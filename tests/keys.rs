//! What a frame is made of: shots at one frame, fingerprints, hashes of files.

#![expect(
    clippy::unwrap_used,
    clippy::panic,
    reason = "helpers of tests fail the test"
)]

#[path = "keys/desk.rs"]
mod desk;
#[path = "keys/files.rs"]
mod files;
#[path = "keys/fingerprints.rs"]
mod fingerprints;
#[path = "keys/golden.rs"]
mod golden;
#[path = "keys/still.rs"]
mod still;
#[path = "keys/traces.rs"]
mod traces;
