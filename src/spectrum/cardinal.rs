//! The curve of the 1990 paper: a cardinal cubic spline through authored points.
//!
//! Wavelengths in nm; values are dimensionless or a radiance, never negative. The curve between two
//! points is a cubic Hermite, clamped at 0. It is not clamped above: that a reflectance stays below
//! 1 is up to the caller, who knows that it is one.

use super::SpectrumError;
use super::points::{Beyond, check_points};

/// A cardinal cubic spline on knots of any spacing.
#[derive(Debug, Clone, PartialEq)]
pub struct Cardinal {
    knots_nm: Vec<f64>,
    /// For each interval a, b, c, d of a + bu + cu² + du³, u from 0 to 1.
    cubics: Vec<[f64; 4]>,
    /// The values before the first and after the last knot.
    ends: [f64; 2],
}

impl Cardinal {
    /// The spline through (nm, value) `points`, strictly ascending in nm, with values from 0 to
    /// 1e300.
    ///
    /// Its slope at point i is (1 − tension)·(pᵢ₊₁ − pᵢ₋₁)/(xᵢ₊₁ − xᵢ₋₁), at the ends the one-sided
    /// difference times (1 − tension). `tension` is from 0 (Catmull & Rom 1974) to 1 (level at
    /// every point). A single point makes a constant.
    pub fn new(points: &[(f64, f64)], tension: f64, beyond: Beyond) -> Result<Self, SpectrumError> {
        check_points(points)?;
        if !(0.0..=1.0).contains(&tension) {
            return Err(SpectrumError::Tension { found: tension });
        }
        let last = points.len() - 1;
        let rise = |knot: usize, width: f64| {
            let (left, right) = (points[knot.saturating_sub(1)], points[(knot + 1).min(last)]);
            // The quotient of widths is at most 1: nothing overflows, however close two points are.
            (1.0 - tension) * (width / (right.0 - left.0)) * (right.1 - left.1)
        };
        let cubic = |left: usize| {
            let (p, q) = (points[left], points[left + 1]);
            let width = q.0 - p.0;
            let (from, to, step) = (rise(left, width), rise(left + 1, width), q.1 - p.1);
            [
                p.1,
                from,
                3.0 * step - 2.0 * from - to,
                from + to - 2.0 * step,
            ]
        };
        let ends = match beyond {
            Beyond::Hold => [points[0].1, points[last].1],
            Beyond::Zero => [0.0, 0.0],
        };
        let mut cubics: Vec<_> = (0..last).map(cubic).collect();
        // The last knot also starts an interval, of no width.
        cubics.push([points[last].1, 0.0, 0.0, 0.0]);
        Ok(Self {
            knots_nm: points.iter().map(|point| point.0).collect(),
            cubics,
            ends,
        })
    }

    /// The curve at a wavelength in nm, at least 0.
    pub fn at(&self, lambda_nm: f64) -> f64 {
        self.unclamped(lambda_nm).max(0.0)
    }

    /// The spline before clamping: through 0, 0, 1, 0, 0 it dips to −2/27.
    pub fn unclamped(&self, lambda_nm: f64) -> f64 {
        let after = self.knots_nm.partition_point(|&knot| knot <= lambda_nm);
        let last = self.knots_nm.len() - 1;
        match after.checked_sub(1) {
            None => self.ends[0],
            Some(left) if left == last && lambda_nm > self.knots_nm[last] => self.ends[1],
            Some(left) if left == last => self.cubics[last][0],
            Some(left) => {
                let (from, to) = (self.knots_nm[left], self.knots_nm[left + 1]);
                let [a, b, c, d] = self.cubics[left];
                let u = (lambda_nm - from) / (to - from);
                a + u * (b + u * (c + u * d))
            }
        }
    }

    /// Wavelengths of the points, nm.
    pub fn knots_nm(&self) -> &[f64] {
        &self.knots_nm
    }

    /// The greatest value of the curve, also between points.
    pub fn peak(&self) -> f64 {
        self.cubics
            .iter()
            .flat_map(|&cubic| summits(cubic))
            .fold(0.0, f64::max)
    }
}

/// The values of a + bu + cu² + du³ at 0 and at its extrema within (0, 1).
fn summits([a, b, c, d]: [f64; 4]) -> [f64; 3] {
    // Extrema do not depend on scale, and squares of the largest values would overflow.
    let size = b.abs().max(c.abs()).max(d.abs());
    let [slope, bend, twist] = [b / size, c / size, d / size];
    let root = (bend * bend - 3.0 * slope * twist).max(0.0).sqrt();
    let q = -(bend + root.copysign(bend));
    [0.0, slope / q, q / (3.0 * twist)].map(|u| {
        if u > 0.0 && u < 1.0 {
            a + u * (b + u * (c + u * d))
        } else {
            a
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn spline(values: &[f64], beyond: Beyond) -> Cardinal {
        let points: Vec<_> = values
            .iter()
            .enumerate()
            .map(|(i, &v)| (400.0 + 50.0 * i as f64, v))
            .collect();
        Cardinal::new(&points, 0.0, beyond).unwrap()
    }

    #[test]
    fn overshoot_through_one_peak_is_two_twentysevenths_and_is_clamped() {
        let curve = spline(&[0.0, 0.0, 1.0, 0.0, 0.0], Beyond::Hold);
        let sweep = || (0..=20_000).map(|i| 400.0 + 0.01 * f64::from(i));
        let dip = sweep().map(|nm| curve.unclamped(nm)).fold(0.0, f64::min);
        assert!((dip + 2.0 / 27.0).abs() < 1e-8, "{dip}");
        assert!((curve.unclamped(400.0 + 100.0 / 3.0) + 2.0 / 27.0).abs() < 1e-15);
        assert!(sweep().all(|nm| curve.at(nm) >= 0.0));
        assert_eq!(curve.peak(), 1.0);
    }

    #[test]
    fn the_spline_meets_its_points_exactly() {
        let points = [
            (300.0, 0.1),
            (301.0, 0.9),
            (550.0, 0.3),
            (551.5, 0.7),
            (900.0, 0.2),
        ];
        for tension in [0.0, 0.5, 1.0] {
            let curve = Cardinal::new(&points, tension, Beyond::Zero).unwrap();
            for (nm, value) in points {
                assert_eq!(curve.at(nm), value);
            }
        }
    }

    /// A cubic Hermite reproduces a straight line; with one-sided ends also in the end intervals.
    #[test]
    fn a_straight_line_stays_straight_on_uneven_knots() {
        let points = [10.0, 11.0, 20.0, 100.0, 1000.0].map(|nm| (nm, 2.0 + 0.25 * nm));
        let curve = Cardinal::new(&points, 0.0, Beyond::Hold).unwrap();
        for nm in [10.3, 10.9, 15.0, 70.0, 999.0] {
            let expected = 2.0 + 0.25 * nm;
            assert!((curve.at(nm) - expected).abs() < 1e-13 * expected, "{nm}");
        }
    }

    #[test]
    fn albedo_one_stays_exactly_one() {
        let curve = Cardinal::new(&[(1.0, 1.0), (400.0, 1.0), (401.0, 1.0)], 0.3, Beyond::Hold);
        let curve = curve.unwrap();
        assert!(
            [0.1, 1.0, 77.7, 400.5, 1e9]
                .iter()
                .all(|&nm| curve.at(nm) == 1.0)
        );
    }

    #[test]
    fn beyond_the_ends_it_holds_or_is_zero() {
        let (hold, zero) = (
            spline(&[0.5, 0.8], Beyond::Hold),
            spline(&[0.5, 0.8], Beyond::Zero),
        );
        assert_eq!((hold.at(1e-300), hold.at(1e300)), (0.5, 0.8));
        assert_eq!((zero.at(1e-300), zero.at(1e300)), (0.0, 0.0));
        assert_eq!((zero.at(400.0), zero.at(450.0)), (0.5, 0.8));
    }

    #[test]
    fn unusable_points_are_named() {
        let error = |points: &[(f64, f64)], tension| {
            Cardinal::new(points, tension, Beyond::Hold)
                .unwrap_err()
                .to_string()
        };
        assert!(error(&[], 0.0).contains("no points"));
        assert!(error(&[(500.0, 0.0), (500.0, 1.0)], 0.0).contains("point 2"));
        assert!(error(&[(0.0, 0.0)], 0.0).contains("greater than 0"));
        assert!(error(&[(500.0, f64::NAN)], 0.0).contains("NaN"));
        assert!(error(&[(500.0, -0.1)], 0.0).contains("-0.1"));
        assert!(error(&[(500.0, 0.1)], 1.5).contains("1.5"));
    }

    #[test]
    fn the_peak_between_points_of_huge_values_is_found() {
        let values = [0.0, 0.0, 1e300, 1e300, 0.0];
        let curve = spline(&values, Beyond::Hold);
        let middle = curve.at(525.0);
        assert!(middle > 1.1e300 && curve.peak() >= middle);
    }

    proptest! {
        #[test]
        fn always_finite_and_never_negative(
            exponents in prop::collection::btree_set(-300_i32..300, 1..12),
            values in prop::collection::vec(prop_oneof![0.0..1.0, Just(0.0), Just(1e300)], 12),
            tension in 0.0..=1.0,
            probe in -305.0..305.0_f64,
        ) {
            let points: Vec<_> =
                exponents.iter().map(|&e| 10_f64.powi(e)).zip(values).collect();
            let curve = Cardinal::new(&points, tension, Beyond::Hold).unwrap();
            let value = curve.at(10_f64.powf(probe));
            prop_assert!(value.is_finite() && value >= 0.0);
            prop_assert!(value <= curve.peak() * (1.0 + 1e-12), "{value} {}", curve.peak());
        }
    }
}
