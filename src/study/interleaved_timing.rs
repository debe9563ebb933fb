//! Timing of variants against each other, in rounds, so that a machine that slows down affects all
//! of them equally.

use super::results::Timing;
use super::timed_render::StudyError;
use super::timed_render::{Run, Subject, Variant};

/// Seconds above which a variant is rendered in the first [`FEW`] rounds only.
const LONG: f64 = 2.0;
const FEW: u32 = 3;
/// Seconds above which a variant is rendered in the first round only.
const VERY_LONG: f64 = 20.0;

/// Measurements of all renders of a variant.
pub(super) struct Measured {
    pub(super) seconds: Vec<f64>,
    /// Seconds by round and phase.
    pub(super) phases: Vec<[f64; 9]>,
    pub(super) memory_mib: Option<f64>,
    /// Size of its files together.
    pub(super) file_bytes: u64,
}

impl Measured {
    /// Times of the whole image.
    pub(super) fn frame(&self) -> Timing {
        timing(self.seconds.clone())
    }

    /// Times of a phase.
    pub(super) fn phase(&self, phase: usize) -> Timing {
        timing(self.phases.iter().map(|phases| phases[phase]).collect())
    }

    fn new(run: &Run) -> Self {
        Self {
            seconds: vec![run.seconds],
            phases: vec![run.phases],
            memory_mib: run.memory_mib,
            file_bytes: run.files.iter().map(|(_, bytes)| bytes.len() as u64).sum(),
        }
    }

    fn add(&mut self, run: &Run) {
        self.seconds.push(run.seconds);
        self.phases.push(run.phases);
        self.memory_mib = match (self.memory_mib, run.memory_mib) {
            (Some(one), Some(other)) => Some(f64::min(one, other)),
            (one, other) => one.or(other),
        };
    }
}

/// Renders every variant `rounds` times, round by round. `look` gets the first render of each; the
/// others have the same pixels and files. No render is kept, so that memory is that of one.
pub(super) fn measure<T>(
    variants: &[Variant],
    subject: &Subject,
    rounds: u32,
    mut look: impl FnMut(&Variant, &Run) -> Result<T, StudyError>,
) -> Result<Vec<(Measured, T)>, StudyError> {
    let mut measured = Vec::new();
    for variant in variants {
        let run = variant.run(subject)?;
        measured.push((Measured::new(&run), look(variant, &run)?));
    }
    for round in 1..rounds {
        for (variant, (measured, _)) in variants.iter().zip(&mut measured) {
            let most = most_rounds(rounds, measured.seconds.first().copied());
            if round < most {
                measured.add(&variant.run(subject)?);
            }
        }
    }
    Ok(measured)
}

/// Number of rounds in which a variant takes part, from the seconds of its first.
pub(super) fn most_rounds(rounds: u32, first: Option<f64>) -> u32 {
    match first {
        Some(seconds) if seconds > VERY_LONG => 1,
        Some(seconds) if seconds > LONG => rounds.min(FEW),
        _ => rounds,
    }
}

/// Median, least and greatest of times; all 0 if there are none.
pub(super) fn timing(mut seconds: Vec<f64>) -> Timing {
    seconds.sort_by(f64::total_cmp);
    let (Some(&least), Some(&greatest)) = (seconds.first(), seconds.last()) else {
        return Timing::default();
    };
    Timing {
        median: median(&seconds),
        least,
        greatest,
    }
}

/// The median of ascending numbers, of which there is at least one.
pub(super) fn median(ascending: &[f64]) -> f64 {
    let half = ascending.len() / 2;
    if ascending.len().is_multiple_of(2) {
        (ascending[half - 1] + ascending[half]) / 2.0
    } else {
        ascending[half]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_is_the_middle_one_or_between_the_middle_two() {
        let of = |seconds: &[f64]| timing(seconds.to_vec());
        assert_eq!(of(&[3.0, 1.0, 2.0]).median, 2.0);
        let four = of(&[4.0, 1.0, 2.0, 3.0]);
        assert_eq!((four.least, four.median, four.greatest), (1.0, 2.5, 4.0));
    }
}
