//! What takes frames, one after the other, and becomes a file.

use super::still::Still;
use std::path::PathBuf;

/// A file in the making. Dropped before its end it leaves nothing. Errors continue "FILE: ".
pub(super) trait Target {
    /// Takes the next frame, of the number given.
    fn add(&mut self, frame: u32, still: &Still) -> Result<(), String>;

    /// Gives the file its name; returns its path.
    fn finish(self: Box<Self>) -> Result<PathBuf, String>;
}
