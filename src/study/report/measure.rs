//! The error that a chart shows, the place of a point on its axis, and quantities as text.

use crate::study::results::{Errors, Percentiles, Point, Sweep, Timing};

/// A measure of the error of an image.
#[derive(Debug, Clone, Copy)]
pub(super) struct Measure {
    /// Title of the axis.
    pub(super) label: &'static str,
    /// Unit of the axis; empty if it has none.
    pub(super) unit: &'static str,
    of: fn(&Errors) -> Option<f64>,
}

/// Measures, with visible differences first.
const MEASURES: [Measure; 3] = [
    Measure {
        label: "ΔE2000, 99th percentile",
        unit: "",
        of: |errors| errors.delta_e.map(p99),
    },
    Measure {
        label: "error of radiance, relative",
        unit: "",
        of: |errors| Some(errors.radiance),
    },
    Measure {
        label: "displacement, 99th percentile",
        unit: "px",
        of: |errors| errors.displacement.map(p99),
    },
];

fn p99(percentiles: Percentiles) -> f64 {
    percentiles.p99
}

/// An error of a point, for a logarithmic axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Error {
    /// Finite and above 0.
    Measured(f64),
    /// Zero: the reference itself, or equal to it.
    None,
    /// Infinite or NaN.
    Beyond,
}

impl Measure {
    /// The first measure by which points of the sweep differ from its reference; if there is none,
    /// the first that they have.
    pub(super) fn of(sweep: &Sweep) -> Self {
        let errors = || sweep.points.iter().filter_map(|p| p.errors.as_ref());
        let has = |m: &&Self| errors().any(|e| (m.of)(e).is_some());
        let tells = |m: &&Self| errors().any(|e| (m.of)(e).is_some_and(|v| v != 0.0));
        let mut measures = MEASURES.iter();
        let [first, ..] = &MEASURES;
        *measures
            .clone()
            .find(tells)
            .or_else(|| measures.find(has))
            .unwrap_or(first)
    }

    /// The error of a point by this measure, if it has one.
    pub(super) fn error(&self, point: &Point) -> Option<Error> {
        let Some(errors) = &point.errors else {
            return Some(Error::None);
        };
        Some(match (self.of)(errors)? {
            0.0 => Error::None,
            value if value.is_finite() && value > 0.0 => Error::Measured(value),
            _ => Error::Beyond,
        })
    }
}

pub(super) use crate::plot::quantity::*;

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
