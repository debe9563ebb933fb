//! Spectra as samples at equal distances, for comparison: the method that the splines of Hsiung et
//! al. 1990 (§3.2, §6) replaced.
//!
//! There are lines from 50 to 5000 nm, 991 of them at 5 nm. A Doppler shift resamples a curve,
//! linearly between samples and with 0 beyond them; products and sums go line by line. So the error
//! of a shift falls with the square of the spacing, s²/8 · max|d²S/dλ²| at the source, and features
//! narrower than s may be missed; cost grows as 1/s.

use crate::color::cie::{EFFICACY, xyz_bar};

/// First and last wavelength that may have a line, nm.
pub const LINES_NM: [f64; 2] = [50.0, 5000.0];

/// The wavelengths of the lines.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineAxis {
    spacing_nm: f64,
    count: usize,
}

impl LineAxis {
    /// Lines from 50 to at most 5000 nm, `spacing_nm` (above 0, at most 50) apart.
    pub fn new(spacing_nm: f64) -> Self {
        let [first, last] = LINES_NM;
        // A spacing that does not divide the range to the last bit still ends it.
        let steps = (last - first) / spacing_nm * (1.0 + 1e-12);
        Self {
            spacing_nm,
            count: steps as usize + 1,
        }
    }

    /// Number of lines.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Distance of lines, nm.
    pub fn spacing_nm(&self) -> f64 {
        self.spacing_nm
    }

    /// The wavelength of line j, nm.
    pub fn wavelength_nm(&self, j: usize) -> f64 {
        LINES_NM[0] + j as f64 * self.spacing_nm
    }

    /// The lines in a window (nm, ascending), by number.
    pub fn within(&self, [from, to]: [f64; 2]) -> impl Iterator<Item = usize> {
        let axis = *self;
        (0..self.count).filter(move |j| (from..=to).contains(&axis.wavelength_nm(*j)))
    }

    /// For each line in a window its number and the contribution of a radiance of 1 there to X, Y
    /// and Z (cd·m⁻² per W·m⁻²·sr⁻¹·nm⁻¹): the rectangle rule with the CIE's functions.
    pub fn cie1931(&self, window_nm: [f64; 2]) -> Vec<(usize, [f64; 3])> {
        self.weighed(window_nm, |nm| xyz_bar(nm).map(|bar| EFFICACY * bar))
    }

    /// For each line in a window its number and its contribution to the long, middle and short
    /// third of the window, which are equal in ln λ: its width (nm), to the third that contains it.
    pub fn bands(&self, window_nm: [f64; 2]) -> Vec<(usize, [f64; 3])> {
        let [from, to] = window_nm;
        self.weighed(window_nm, |nm| {
            let third = 3.0 * (nm / from).ln() / (to / from).ln();
            let mut bands = [0.0; 3];
            bands[2 - third.clamp(0.0, 2.0) as usize] = 1.0;
            bands
        })
    }

    /// Each line of a window with its weight times the part of its rectangle in the window, nm;
    /// lines without weight are left out.
    fn weighed(
        &self,
        [from, to]: [f64; 2],
        weight: impl Fn(f64) -> [f64; 3],
    ) -> Vec<(usize, [f64; 3])> {
        let half = 0.5 * self.spacing_nm;
        self.within([from, to])
            .map(|j| {
                let nm = self.wavelength_nm(j);
                let width = (nm + half).min(to) - (nm - half).max(from);
                (j, weight(nm).map(|weight| weight * width))
            })
            .filter(|(_, weights)| *weights != [0.0; 3])
            .collect()
    }
}

/// Values of a curve at the lines of an axis: finite and at least 0.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Lines(Vec<f64>);

impl Lines {
    /// A curve (of the wavelength in nm, at least 0) at all lines.
    pub fn sample(axis: LineAxis, curve: impl Fn(f64) -> f64) -> Self {
        let value = |j| curve(axis.wavelength_nm(j)).min(f64::MAX);
        Self((0..axis.count).map(value).collect())
    }

    /// The value at each line.
    pub fn values(&self) -> &[f64] {
        &self.0
    }

    /// Sets all lines of an axis to 0.
    pub fn clear(&mut self, axis: LineAxis) {
        self.0.clear();
        self.0.resize(axis.count, 0.0);
    }

    /// The value at a wavelength (nm), linear between lines; 0 where there are none.
    pub fn at(&self, axis: LineAxis, lambda_nm: f64) -> f64 {
        self.between((lambda_nm - LINES_NM[0]) / axis.spacing_nm)
    }

    /// Writes the curve at D·λ for each line's λ, where D is `doppler` (above 0): linear between
    /// lines, 0 where there are none.
    pub fn resample(&self, axis: LineAxis, doppler: f64, out: &mut Self) {
        // λ = 50 + s·j is read at D·λ, which is line D·j + 50·(D − 1)/s.
        let start = LINES_NM[0] * (doppler - 1.0) / axis.spacing_nm;
        out.0.resize(axis.count, 0.0);
        for (j, out) in out.0.iter_mut().enumerate() {
            *out = self.between(doppler * j as f64 + start);
        }
    }

    /// The value at a place in units of the spacing from the first line.
    #[inline(always)]
    fn between(&self, place: f64) -> f64 {
        let last = self.0.len().saturating_sub(1);
        if !(0.0..=last as f64).contains(&place) {
            return 0.0;
        }
        let below = (place as usize).min(last.saturating_sub(1));
        let (low, high) = (self.0[below], self.0[(below + 1).min(last)]);
        low + (high - low) * (place - below as f64)
    }

    /// Adds `light` · `factor` (finite, at least 0).
    pub fn add(&mut self, light: &Self, factor: f64) {
        for (sum, light) in self.0.iter_mut().zip(&light.0) {
            *sum = (*sum + light * factor).min(f64::MAX);
        }
    }

    /// Adds `light` · `reflectance` · `factor`, the last two finite and at least 0. Infinite light
    /// adds 0 where it is not reflected.
    pub fn add_product(&mut self, light: &Self, reflectance: &Self, factor: f64) {
        for ((sum, light), share) in self.0.iter_mut().zip(&light.0).zip(&reflectance.0) {
            *sum = (*sum + (light * factor).min(f64::MAX) * share).min(f64::MAX);
        }
    }

    /// Multiplies line by line.
    pub fn multiply(&mut self, by: &Self) {
        for (value, by) in self.0.iter_mut().zip(&by.0) {
            *value *= by;
        }
    }

    /// The sums over weighted lines of [`LineAxis::cie1931`] or [`LineAxis::bands`].
    pub fn weigh(&self, weights: &[(usize, [f64; 3])]) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for (j, weights) in weights {
            let value = self.0[*j];
            for (sum, weight) in sum.iter_mut().zip(weights) {
                *sum += weight * value;
            }
        }
        sum.map(|v| v.min(f64::MAX))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::cie::xyz_of;

    #[test]
    fn lines_stand_from_50_to_5000_nm() {
        for (spacing, count) in [
            (5.0, 991),
            (0.5, 9901),
            (50.0, 100),
            (1.0, 4951),
            (7.0, 708),
        ] {
            let axis = LineAxis::new(spacing);
            assert_eq!(axis.count(), count);
            assert!(axis.wavelength_nm(count - 1) <= 5000.0);
            assert!(axis.wavelength_nm(count) > 5000.0);
        }
        for tenths in 5..=500 {
            let axis = LineAxis::new(0.1 * f64::from(tenths));
            assert_eq!(axis.count(), (49_500 / tenths + 1) as usize, "{tenths}");
        }
    }

    #[test]
    fn a_straight_curve_is_resampled_exactly_and_is_nothing_beyond_the_lines() {
        let axis = LineAxis::new(5.0);
        let straight = Lines::sample(axis, |nm| 3.0 + 0.01 * nm);
        let mut shifted = Lines::default();
        for doppler in [1e-300, 0.01, 0.3, 0.999, 1.0, 1.7, 60.0, 101.0, 1e300] {
            straight.resample(axis, doppler, &mut shifted);
            for (j, found) in shifted.values().iter().enumerate() {
                let nm = doppler * axis.wavelength_nm(j);
                // Where a line is read at an end, rounding decides.
                if (nm - 50.0).abs() < 1e-9 || (nm - 5000.0).abs() < 1e-9 {
                    continue;
                }
                let inside = (50.0..=5000.0).contains(&nm);
                let exact = if inside { 3.0 + 0.01 * nm } else { 0.0 };
                assert!(
                    (found - exact).abs() < 1e-12 * (1.0 + exact),
                    "{doppler} {nm}"
                );
            }
        }
    }

    #[test]
    fn the_largest_numbers_stay_numbers() {
        let axis = LineAxis::new(50.0);
        let [most, none] = [f64::INFINITY, 0.0].map(|v| Lines::sample(axis, |_| v));
        let mut sum = none.clone();
        sum.add(&most, f64::MAX);
        sum.add_product(&most, &none, f64::MAX);
        assert!(sum.values().iter().all(|v| *v == f64::MAX));
        let mut dark = none.clone();
        dark.add_product(&most, &none, f64::MAX);
        assert_eq!(dark, none);
        let xyz = most.weigh(&axis.cie1931([360.0, 830.0]));
        assert_eq!(xyz, [f64::MAX; 3]);
    }

    /// At 1 nm the rectangle rule is the trapezoidal one, but for half a step at either end, where
    /// the functions are below 1e-5.
    #[test]
    fn an_equal_energy_spectrum_has_its_xyz() {
        let axis = LineAxis::new(1.0);
        let found = Lines::sample(axis, |_| 1.0).weigh(&axis.cie1931([360.0, 830.0]));
        for (found, exact) in found.into_iter().zip(xyz_of(|_| 1.0)) {
            assert!((found / exact - 1.0).abs() < 1e-6, "{found} {exact}");
        }
    }

    #[test]
    fn bands_are_thirds_of_the_window_cut_to_it() {
        let axis = LineAxis::new(5.0);
        let flat = Lines::sample(axis, |_| 1.0);
        // Thirds end at 400, 800, 1600 and 3200: each has half a rectangle of its ends' lines.
        let found = flat.weigh(&axis.bands([400.0, 3200.0]));
        for (found, exact) in found.into_iter().zip([1600.0, 800.0, 400.0]) {
            assert!((found - exact).abs() <= 5.0, "{found} {exact}");
        }
        let total: f64 = flat.weigh(&axis.bands([402.0, 3198.0])).iter().sum();
        assert!((total - 2796.0).abs() <= 5.0, "{total}");
        assert_eq!(flat.weigh(&axis.bands([501.0, 504.0])), [0.0; 3]);
    }
}
