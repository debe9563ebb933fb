//! What a run did with the frames of a shot.

use std::collections::BTreeMap;

/// What the run that writes the page did; empty where it rendered nothing.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RunFacts {
    /// By number, of the frames that it was asked for.
    pub outcomes: BTreeMap<u32, Outcome>,
}

/// What became of a frame.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Outcome {
    /// It was rendered.
    Rendered {
        /// Continues "rendered: ", such as "it was missing" or "sensor.exposure changed".
        because: String,
    },
    /// It was there already.
    Kept,
    /// It could not be rendered or written.
    Failed {
        /// Continues "failed: ".
        because: String,
    },
}
