//! Frames of which nothing is there, in runs: where of a million two are there, there are three runs.

use std::ops::RangeInclusive;

/// Frames in a row that are told one by one; longer runs are told as one.
pub(super) const SINGLY: u32 = 12;

/// Frames in a row.
pub(super) type Run = RangeInclusive<u32>;

/// How many there are in a run.
pub(super) fn count(run: &Run) -> u32 {
    run.end() - run.start() + 1
}

/// The runs of those of `frames` that are not `there`, both ascending.
pub(super) fn gaps(there: impl IntoIterator<Item = u32>, frames: u32) -> Vec<Run> {
    let mut runs = Vec::new();
    let mut next = 1;
    for frame in there.into_iter().chain([frames + 1]) {
        if frame > next {
            runs.push(next..=frame - 1);
        }
        next = frame + 1;
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gaps_and_what_is_there_are_all_frames() {
        assert_eq!(gaps([], 5), [1..=5]);
        assert!(gaps([1, 2, 3], 3).is_empty());
        assert_eq!(
            gaps([2, 500_000], 1_000_000),
            [1..=1, 3..=499_999, 500_001..=1_000_000]
        );
        for there in [&[1][..], &[3], &[1, 5], &[2, 3, 4]] {
            let missing: u32 = gaps(there.iter().copied(), 5).iter().map(count).sum();
            assert_eq!(missing as usize + there.len(), 5);
        }
    }
}
