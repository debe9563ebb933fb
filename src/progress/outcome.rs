//! Outcome of one frame in a run: kept, rendered or failed.

/// Outcome of one frame in a run.
#[derive(Debug, Clone, PartialEq)]
pub enum FrameOutcome {
    /// It was there already.
    Kept {
        /// Why, if it was not there when the run began.
        reason: Option<String>,
    },
    /// It was rendered.
    Rendered {
        /// Why it had to be, if it was there before: "stale because …".
        reason: Option<String>,
        /// Seconds of the wall clock; of a shared trace its part.
        seconds: f64,
        /// Share of its light that was not followed in mirrors and glass.
        cut: f64,
    },
    /// It could not be rendered or written.
    Failed {
        /// Why.
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

    /// Why.
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
