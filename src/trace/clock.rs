//! Where a tracer's time goes, for studies: seconds by phase, only where somebody asks.

use std::cell::Cell;
use std::time::Instant;

/// A part of tracing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    /// Camera rays to the rest frames of bodies.
    Boost,
    /// Camera rays through the bodies of a rest frame.
    Traverse,
    /// Rays from surfaces to lamps, their boosts included.
    Shadow,
    /// The rest: surface events, lamps seen from there, and what mirrors and glass show.
    Surfaces,
}

/// One thread's seconds by phase.
#[derive(Debug, Default)]
pub struct Clock {
    nanoseconds: [Cell<u64>; 4],
}

impl Clock {
    /// Seconds in a phase so far.
    pub fn seconds(&self, phase: Phase) -> f64 {
        self.nanoseconds[phase as usize].get() as f64 * 1e-9
    }

    fn add(&self, phase: Phase, nanoseconds: u64) {
        let sum = &self.nanoseconds[phase as usize];
        sum.set(sum.get() + nanoseconds);
    }
}

/// Runs a phase, on the clock if there is one.
#[inline(always)]
pub(super) fn timed<T>(clock: Option<&Clock>, phase: Phase, work: impl FnOnce() -> T) -> T {
    let Some(clock) = clock else { return work() };
    let begun = Instant::now();
    let done = work();
    clock.add(phase, begun.elapsed().as_nanos() as u64);
    done
}

/// [`timed`] for [`Phase::Surfaces`], within which shadows are traced: they do not count twice.
#[inline(always)]
pub(super) fn timed_without_shadows<T>(clock: Option<&Clock>, work: impl FnOnce() -> T) -> T {
    let Some(clock) = clock else { return work() };
    let shadow = |clock: &Clock| clock.nanoseconds[Phase::Shadow as usize].get();
    let (begun, before) = (Instant::now(), shadow(clock));
    let done = work();
    let all = begun.elapsed().as_nanos() as u64;
    clock.add(Phase::Surfaces, all.saturating_sub(shadow(clock) - before));
    done
}
