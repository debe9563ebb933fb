//! The fast form of spectra: on an axis in ln λ a Doppler shift is a translation.
//!
//! A [`Baked`] curve is tabulated at 32 phases between two wavelengths of the sensor's axis, each
//! phase a contiguous row. Reading it at all the sensor's wavelengths under a shift D takes one
//! integer offset and one linear weight between two rows: no search, no transcendental function. It
//! is a convex combination, so that a curve that is non-negative (or at most 1) stays so.
//!
//! Error: at most (h/32)²/8 · max|d²S/d(ln λ)²|, with h the axis spacing: 2·10⁻⁴ of the peak for a
//! Gaussian of σ = 5 nm at 589 nm and the default of 84 wavelengths; for curves that are smoothed
//! first, that of the smoothed curve. Cost: two loads, a multiply and a fused multiply-add per
//! wavelength. The alternative, a 4-tap filter on one row, errs by 10⁻¹ there.
//!
//! Bends within the spacing, as tables at every 5 nm have them, would be seen by chance, depending
//! on where a wavelength falls. So such curves are averaged first ([`Smoothing::OverSpacing`]): a
//! D65 lamp under a shift is then ten times nearer to its exact color, at no cost.

use super::Spectrum;

/// The sensor's wavelengths: `count` bins of equal width in ln λ, each with its center as
/// wavelength.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LogAxis {
    window_nm: [f64; 2],
    /// First wavelength, nm.
    first_nm: f64,
    spacing: f64,
    count: usize,
}

impl LogAxis {
    /// `count` ≥ 1 bins over the window (nm, ascending, above 0).
    pub fn new(window_nm: [f64; 2], count: usize) -> Self {
        let spacing = (window_nm[1] / window_nm[0]).ln() / count as f64;
        Self {
            window_nm,
            first_nm: window_nm[0] * (spacing / 2.0).exp(),
            spacing,
            count,
        }
    }

    /// The window: beginning of the first bin and end of the last, nm.
    pub fn window_nm(&self) -> [f64; 2] {
        self.window_nm
    }

    /// Number of wavelengths.
    pub fn count(&self) -> usize {
        self.count
    }

    /// h = ln(λ_{j+1}/λ_j).
    pub fn spacing(&self) -> f64 {
        self.spacing
    }

    /// The wavelength at place `j`, nm; `j` may be any real number.
    pub fn wavelength_nm(&self, j: f64) -> f64 {
        self.first_nm * (j * self.spacing).exp()
    }

    /// The place of a wavelength, in units of the spacing from the first.
    pub fn place(&self, lambda_nm: f64) -> f64 {
        (lambda_nm / self.first_nm).ln() / self.spacing
    }

    /// All wavelengths, nm.
    pub fn wavelengths_nm(&self) -> Vec<f64> {
        (0..self.count)
            .map(|j| self.wavelength_nm(j as f64))
            .collect()
    }
}

/// Rows between two neighbors of the axis.
pub(super) const PHASES: usize = 32;

/// Their distance in units of the axis' spacing.
pub(super) const PHASE_SPACING: f64 = 1.0 / PHASES as f64;

/// Number of columns that a curve may have, 32 MB. In a very narrow window a wide curve would need
/// more, and cannot be baked.
const MOST_COLUMNS: f64 = 262_144.0;

/// A curve tabulated for reading at an axis' wavelengths under any shift.
#[derive(Debug, Clone)]
pub struct Baked {
    /// PHASES rows of `columns` values, and [`LANES`] more that kernels may read; row p, column c
    /// is the curve at place first + c + p/PHASES.
    rows: Vec<f32>,
    columns: usize,
    /// Place of column 0.
    first: i64,
    axis: LogAxis,
    peak: f64,
}

/// A curve seen under one shift: value j is `peak` · (a\[j\]·(1−weight) + b\[j\]·weight).
#[derive(Debug, Clone, Copy)]
pub struct Shifted<'a> {
    a: &'a [f32],
    b: &'a [f32],
    weight: f32,
}

/// Treatment of a curve before it is tabulated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Smoothing {
    /// None, for curves without bends.
    None,
    /// Averaged over the axis' spacing and corrected so that cubics in ln λ stay unchanged: the
    /// mean there times 13/12, less 1/24 of the means a spacing to either side. Clamped to the
    /// range of the curve.
    OverSpacing,
    /// Averaged over the axis' spacing: the mean in each wavelength's bin.
    Mean,
}

impl Smoothing {
    /// Bounds on Σ |f̃ − f| over the wavelengths of the axis, under any shift, relative to V(f), h
    /// V(f′) and h² V(f″): sums of the kernel's Peano kernels.
    pub(super) const REACH: [f64; 3] = [0.542, 0.1046, 0.01547];

    /// The treatment for a curve: those through points bend at them.
    pub fn of(spectrum: &Spectrum) -> Self {
        if spectrum.knots_nm().is_empty() {
            Self::None
        } else {
            Self::OverSpacing
        }
    }

    /// Smooths values at [`PHASES`] places per spacing; the first and the last continue beyond the
    /// ends.
    fn apply(self, values: Vec<f64>) -> Vec<f64> {
        if self == Self::None {
            return values;
        }
        let last = values.len() as i64 - 1;
        let at = |list: &[f64], i: i64| list[i.clamp(0, last) as usize];
        let half = (PHASES / 2) as i64;
        let mean = |i: i64| {
            let inner: f64 = (1 - half..half).map(|k| at(&values, i + k)).sum();
            let ends = at(&values, i - half) + at(&values, i + half);
            (inner + 0.5 * ends) / PHASES as f64
        };
        let means: Vec<f64> = (0..=last).map(mean).collect();
        if self == Self::Mean {
            return means;
        }
        let peak = values.iter().copied().fold(0.0, f64::max);
        (0..=last)
            .map(|i| {
                let [before, after] = [-1, 1].map(|side| at(&means, i + side * PHASES as i64));
                let corrected = at(&means, i) * (1.0 + SPREAD) - (before + after) * (0.5 * SPREAD);
                corrected.clamp(0.0, peak)
            })
            .collect()
    }
}

/// Number of values that kernels process at a time.
pub(super) const LANES: usize = 8;

/// Variance of the mean over a spacing by trapezoids, in squares of the spacing: 1/12, and what the
/// trapezoids add.
const SPREAD: f64 = 1.0 / 12.0 + 1.0 / (6.0 * (PHASES * PHASES) as f64);

/// Columns beside a curve's support that smoothing may change.
const TOUCHED: i64 = 2;

impl Baked {
    /// Tabulates `curve` (of the wavelength in nm, finite and ≥ 0) as far as shifts of |ln D| up to
    /// `reach` can bring it to the axis; the rest does not count for its peak. Beyond `support_nm`
    /// the curve is taken to be constant; None means that it is constant everywhere.
    ///
    /// None if the table would be too large because the axis is very fine.
    pub fn new(
        axis: LogAxis,
        reach: f64,
        support_nm: Option<[f64; 2]>,
        smoothing: Smoothing,
        curve: impl Fn(f64) -> f64,
    ) -> Option<Self> {
        let seen = [
            -1.0 - reach / axis.spacing,
            axis.count() as f64 + reach / axis.spacing,
        ];
        let [low, high] = support_nm.map_or([0.0, 0.0], |support| {
            support.map(|nm| axis.place(nm).clamp(seen[0], seen[1]))
        });
        if high - low > MOST_COLUMNS {
            return None;
        }
        // A window wholly beyond an end reads only that end.
        let first = low.floor() as i64 - axis.count as i64 - 1 - TOUCHED;
        let columns = (high.ceil() as i64 + 2 + TOUCHED - first) as usize + axis.count;
        let fine = |i: usize| {
            let place = first as f64 + i as f64 / PHASES as f64;
            curve(axis.wavelength_nm(place))
        };
        let values = smoothing.apply((0..columns * PHASES).map(fine).collect());
        let peak = values.iter().copied().fold(0.0, f64::max);
        let scale = if peak > 0.0 { 1.0 / peak } else { 0.0 };
        let mut rows = vec![0.0; columns * PHASES + LANES];
        for (i, value) in values.iter().enumerate() {
            let shape = (value * scale) as f32;
            // Subnormal numbers would slow the kernel four-fold.
            rows[i % PHASES * columns + i / PHASES] = if shape < 1e-30 { 0.0 } else { shape };
        }
        Some(Self {
            rows,
            columns,
            first,
            axis,
            peak,
        })
    }

    /// Memory of its rows, bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.rows)
    }

    /// The value at a place of the axis in units of the phases' spacing.
    pub(super) fn at_node(&self, node: i64) -> f64 {
        let last = (self.columns * PHASES) as i64 - 1;
        let i = (node - self.first * PHASES as i64).clamp(0, last) as usize;
        self.peak * f64::from(self.rows[i % PHASES * self.columns + i / PHASES])
    }

    /// Factor of [`Shifted`] values: the greatest value of the curve.
    pub fn peak(&self) -> f64 {
        self.peak
    }

    /// The curve at D·λ for all wavelengths λ of the axis, given ln D (finite).
    #[inline(always)]
    pub fn shifted(&self, ln_doppler: f64) -> Shifted<'_> {
        let last = ((self.columns - self.axis.count) * PHASES - 1) as f64;
        let at = (ln_doppler / self.axis.spacing - self.first as f64) * PHASES as f64;
        let at = at.clamp(0.0, last - 1.0);
        let below = at as usize;
        let row = |i: usize| {
            let start = i % PHASES * self.columns + i / PHASES;
            &self.rows[start..start + self.axis.count.next_multiple_of(LANES)]
        };
        Shifted {
            a: row(below),
            b: row(below + 1),
            weight: (at - below as f64) as f32,
        }
    }
}

impl<'a> Shifted<'a> {
    /// The two rows, as long as the axis and on to the next multiple of [`LANES`] with numbers of
    /// no effect, and their weights.
    #[inline(always)]
    pub(super) fn rows(&self) -> ([&'a [f32]; 2], [f32; 2]) {
        ([self.a, self.b], [1.0 - self.weight, self.weight])
    }

    /// Writes the values, relative to the curve's peak, to `out` (of the axis' length).
    #[inline(always)]
    pub fn write(&self, out: &mut [f32]) {
        let keep = 1.0 - self.weight;
        for ((out, a), b) in out.iter_mut().zip(self.a).zip(self.b) {
            *out = a * keep + b * self.weight;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axis() -> LogAxis {
        LogAxis::new([360.0, 830.0], 84)
    }

    fn worst(support: Option<[f64; 2]>, shifts: &[f64], curve: impl Fn(f64) -> f64) -> f64 {
        let axis = axis();
        let reach = shifts.iter().fold(0.0f64, |m, d| m.max(d.ln().abs()));
        let baked = Baked::new(axis, reach, support, Smoothing::None, &curve).unwrap();
        let mut out = vec![0.0; axis.count()];
        let mut worst = 0f64;
        for &d in shifts {
            baked.shifted(d.ln()).write(&mut out);
            for (j, value) in out.iter().enumerate() {
                let exact = curve(d * axis.wavelength_nm(j as f64));
                worst = worst.max((f64::from(*value) * baked.peak() - exact).abs() / baked.peak());
            }
        }
        worst
    }

    #[test]
    fn the_default_axis_begins_as_the_contract_shows() {
        let nm = axis().wavelengths_nm();
        assert_eq!(
            (format!("{:.1}", nm[0]), format!("{:.1}", nm[1])),
            ("361.8".into(), "365.4".into())
        );
        assert!((nm[83] * (axis().spacing() / 2.0).exp() - 830.0).abs() < 1e-9);
    }

    #[test]
    fn a_sodium_line_keeps_its_shape_under_any_shift() {
        let line = |nm: f64| (-0.5 * ((nm - 589.0) / 5.0).powi(2)).exp();
        let shifts: Vec<f64> = (0..400).map(|i| 0.5 * 1.0041f64.powi(i)).collect();
        // (h/32)²/8 · max|S''| with S'' in ln λ: (589/5)² at the center.
        let bound = (axis().spacing() / 32.0).powi(2) / 8.0 * (589.0f64 / 5.0).powi(2);
        let worst = worst(Some([500.0, 680.0]), &shifts, line);
        assert!(worst < bound * 1.01 + 1e-6, "{worst} {bound}");
    }

    #[test]
    fn beyond_its_support_a_curve_is_constant_however_far_it_is_shifted() {
        let step = |nm: f64| ((nm.clamp(400.0, 700.0) - 400.0) / 300.0).min(1.0);
        let shifts = [1e-300, 1e-6, 0.3, 3.0, 1e6, 1e300];
        assert!(worst(Some([400.0, 700.0]), &shifts, step) < 2e-5);
    }

    #[test]
    fn what_a_very_narrow_window_would_make_too_large_is_not_baked() {
        let narrow = LogAxis::new([588.999, 589.001], 84);
        let wide = Some([300.0, 830.0]);
        assert!(Baked::new(narrow, 1.0, wide, Smoothing::None, |_| 1.0).is_none());
        // As far as it can be shifted into view, it is small.
        assert!(Baked::new(narrow, 1e-9, wide, Smoothing::None, |_| 1.0).is_some());
    }

    #[test]
    fn smoothing_leaves_cubics_as_they_are_and_a_kink_as_far_off_as_it_says() {
        let places = |curve: &dyn Fn(f64) -> f64| -> Vec<f64> {
            (-400..=400)
                .map(|i| curve(f64::from(i) / PHASES as f64))
                .collect()
        };
        let smoothed = |values: &[f64]| Smoothing::OverSpacing.apply(values.to_vec());
        let cubic = places(&|u| 1500.0 + u * (3.0 + u * (2.0 - 0.5 * u)));
        // Away from the ends.
        let smooth = smoothed(&cubic);
        for i in 100..700 {
            assert!((smooth[i] / cubic[i] - 1.0).abs() < 1e-13, "{i}");
        }
        for (order, curve) in [
            |u: f64| f64::from(u8::from(u > 0.01)),
            |u: f64| u.clamp(0.0, 8.0),
            |u: f64| 0.5 * u.clamp(0.0, 8.0).powi(2),
        ]
        .into_iter()
        .enumerate()
        {
            let values = places(&curve);
            let off: Vec<f64> = smoothed(&values)
                .into_iter()
                .zip(&values)
                .take(500)
                .map(|(a, b)| (a - b).abs())
                .collect();
            let sums = (0..PHASES).map(|phase| off.iter().skip(phase).step_by(PHASES).sum());
            let worst = sums.fold(0.0, f64::max);
            let stated = Smoothing::REACH[order];
            assert!(worst <= 1.05 * stated, "{order}: {worst} {stated}");
        }
    }

    #[test]
    fn constants_stay_exact() {
        assert!(worst(None, &[1e-9, 0.7, 1.0, 1e9], |_| 0.25) < 1e-9);
    }
}
