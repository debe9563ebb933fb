//! Consecutive frames that one line of a forecast stands for.

use crate::queue::FrameForecast;

/// Consecutive frames with equal plans, which either share one trace or have one each.
pub(super) struct Run {
    pub(super) first: FrameForecast,
    /// Number of the last frame, and that of its trace.
    pub(super) last: [u32; 2],
}

impl Run {
    pub(super) fn of(first: FrameForecast) -> Self {
        let last = [first.frame, first.trace];
        Self { first, last }
    }

    /// Whether the next frame belongs to this run: from the second on, its trace is the same or the
    /// next one, as it was from the first to the second.
    pub(super) fn takes(&self, next: &FrameForecast) -> bool {
        let [frame, trace] = self.last;
        let (first, length) = (&self.first, frame - self.first.frame);
        let step = next.trace.wrapping_sub(trace);
        let same_step = match length {
            0 => step <= 1,
            _ => step == u32::from(trace != first.trace),
        };
        let effects = first.effects.names() == next.effects.names();
        next.frame == frame + 1 && same_step && first.status == next.status && effects
    }
}
