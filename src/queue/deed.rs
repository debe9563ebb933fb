//! What a run did about a frame.

/// What a run did about a frame.
#[derive(Debug, Clone, PartialEq)]
pub enum Deed {
    /// It was there already.
    Kept {
        /// How that came, if it was not so from the beginning.
        because: Option<String>,
    },
    /// It is there now.
    Rendered {
        /// Why it had to be, if it was there before: "stale because …".
        because: Option<String>,
        /// Its seconds on the clock on the wall, of a shared trace its part.
        seconds: f64,
        /// Share of its light that was not followed in mirrors and glass.
        cut: f64,
    },
    /// It is not there, and it was tried.
    Failed {
        /// Why.
        because: String,
    },
}

impl Deed {
    /// "kept", "rendered" or "failed".
    pub fn word(&self) -> &'static str {
        match self {
            Self::Kept { .. } => "kept",
            Self::Rendered { .. } => "rendered",
            Self::Failed { .. } => "failed",
        }
    }

    /// Why.
    pub fn because(&self) -> Option<&str> {
        match self {
            Self::Kept { because } | Self::Rendered { because, .. } => because.as_deref(),
            Self::Failed { because } => Some(because),
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
