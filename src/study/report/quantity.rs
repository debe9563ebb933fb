//! Quantities of a study as text.

pub(super) use crate::plot::quantity::*;
use crate::study::results::Timing;

/// The range of equal renders in the unit of their median, such as 4.0–4.3; None if there was only
/// one.
pub(super) fn range(timing: Timing) -> Option<String> {
    let (unit, _) = unit_of_time(timing.median);
    (timing.least < timing.greatest).then(|| {
        let [least, greatest] = [timing.least, timing.greatest].map(|s| number(s / unit));
        format!("{least}–{greatest}")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_range_is_told_where_there_is_one() {
        let one = Timing {
            median: 0.0041,
            least: 0.0041,
            greatest: 0.0041,
        };
        assert_eq!(range(one), None);
        let three = Timing {
            least: 0.004,
            greatest: 0.0043,
            ..one
        };
        assert_eq!(range(three).as_deref(), Some("4–4.3"));
    }
}
