//! A measured curve: straight lines through (nm, value) pairs.

use super::SpectrumError;
use super::points::{Beyond, check_points};

/// A piecewise linear curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Sampled {
    pub(super) nm: Vec<f64>,
    pub(super) values: Vec<f64>,
    pub(super) beyond: Beyond,
}

impl Sampled {
    /// The polyline through (nm, value) `points`, strictly ascending in nm, values from 0 to
    /// [`MAX_VALUE`](super::MAX_VALUE).
    pub fn new(points: &[(f64, f64)], beyond: Beyond) -> Result<Self, SpectrumError> {
        check_points(points)?;
        let (nm, values) = points.iter().copied().unzip();
        Ok(Self { nm, values, beyond })
    }

    /// The same curve with another course beyond its ends.
    #[must_use]
    pub fn with_beyond(self, beyond: Beyond) -> Self {
        Self { beyond, ..self }
    }

    /// The curve at a wavelength.
    pub fn at(&self, lambda_nm: f64) -> f64 {
        let last = self.nm.len() - 1;
        let inside = (self.nm[0]..=self.nm[last]).contains(&lambda_nm);
        if !inside && self.beyond == Beyond::Zero {
            return 0.0;
        }
        let right = self.nm.partition_point(|&nm| nm <= lambda_nm);
        if right == 0 || right > last {
            return self.values[right.min(last)];
        }
        let (from, to) = (self.nm[right - 1], self.nm[right]);
        let (low, high) = (self.values[right - 1], self.values[right]);
        (low + (high - low) * ((lambda_nm - from) / (to - from))).max(0.0)
    }

    /// The points' wavelengths, nm.
    pub fn knots_nm(&self) -> &[f64] {
        &self.nm
    }

    /// The curve's greatest value.
    pub fn peak(&self) -> f64 {
        self.values.iter().copied().fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn between_points_it_is_linear_and_beyond_them_constant_or_zero() {
        let curve = Sampled::new(&[(400.0, 1.0), (500.0, 3.0)], Beyond::Hold).unwrap();
        let read = |curve: &Sampled| [1e-300, 400.0, 425.0, 500.0, 1e300].map(|nm| curve.at(nm));
        assert_eq!(read(&curve), [1.0, 1.0, 1.5, 3.0, 3.0]);
        assert_eq!(
            read(&curve.with_beyond(Beyond::Zero)),
            [0.0, 1.0, 1.5, 3.0, 0.0]
        );
    }
}
