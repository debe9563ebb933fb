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

/// One of so many shadow rays is timed, by a hash of their number, so that it is not always that to
/// the same lamp: reading the clock takes a tenth of the time of a short one.
const TIMED_SHADOWS: u64 = 8;

/// Knuth's multiplicative hash, 2⁶⁴ over the golden ratio.
const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

/// One thread's seconds by phase.
#[derive(Debug, Default)]
pub struct Clock {
    nanoseconds: [Cell<u64>; 4],
    shadows: Cell<u64>,
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

/// Runs [`Phase::Shadow`] for one ray, some of which are timed and stand for the rest.
#[inline(always)]
pub(super) fn timed_shadow<T>(clock: Option<&Clock>, work: impl FnOnce() -> T) -> T {
    let Some(clock) = clock else { return work() };
    let number = clock.shadows.get();
    clock.shadows.set(number + 1);
    if (number.wrapping_mul(GOLDEN) >> 32) % TIMED_SHADOWS != 0 {
        return work();
    }
    let begun = Instant::now();
    let done = work();
    let nanoseconds = begun.elapsed().as_nanos() as u64;
    clock.add(Phase::Shadow, nanoseconds * TIMED_SHADOWS);
    done
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
