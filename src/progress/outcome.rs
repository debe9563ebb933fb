//! Outcome of one frame in a run: kept, rendered or failed.

/// Outcome of one frame in a run.
#[derive(Debug, Clone, PartialEq)]
pub enum FrameOutcome {
    /// It existed already.
    Kept {
        /// The reason, if it did not exist when the run began.
        reason: Option<String>,
    },
    /// It was rendered.
    Rendered {
        /// The reason, if it existed before: "stale because …".
        reason: Option<String>,
        /// Wall-clock seconds; its share of those of a shared trace.
        seconds: f64,
        /// Share of its light that was not followed in mirrors and glass.
        cut: f64,
    },
    /// It could not be rendered or written.
    Failed {
        /// The reason.
        reason: String,
    },
}

impl FrameOutcome {
    /// "kept", "rendered" or "failed".
    pub fn word(&self) -> &'static str {
        match self {
            Self::Kept { .. } => "kept",
            Self::Rendered { .. } => "rendered",
            Self::Failed { .. } => "failed",
        }
    }

    /// The reason, if there is one.
    pub fn reason(&self) -> Option<&str> {
        match self {
            Self::Kept { reason } | Self::Rendered { reason, .. } => reason.as_deref(),
            Self::Failed { reason } => Some(reason),
        }
    }

    /// Share of its light that this run did not follow in mirrors and glass.
    pub fn cut(&self) -> f64 {
        match self {
            Self::Rendered { cut, .. } => *cut,
            _ => 0.0,
        }
    }

    /// Seconds that it took.
    pub fn seconds(&self) -> f64 {
        match self {
            Self::Rendered { seconds, .. } => *seconds,
            _ => 0.0,
        }
    }
}
