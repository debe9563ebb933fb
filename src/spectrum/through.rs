//! Products of narrow and smooth curves under a shift between them: by a few points if the narrow
//! curve is one line or some, else by a table of each wavelength's weight.

use super::cubic::catmull_rom;
use super::fine::{Fine, FineSensor};
use super::log_grid::{LANES, LogAxis, PHASES};

/// Nodes between two rows of [`Responses`]: they are an eighth of a spacing apart. A channel is a
/// smooth function of the shift; lines between rows leave (h/8)²/8 of its second derivative, 1e-4
/// of the eye's weights.
const ROW_NODES: i64 = 4;

/// Number of numbers in [`Responses`] at most, 32 MB.
const MOST_NUMBERS: f64 = 8_388_608.0;

/// Number of points in [`Sparse`] at most; beyond it a table is as fast.
const MOST_POINTS: usize = 24;

/// Nodes that two points represent, one spacing of the axis: Gauss's rule leaves 1/4320 of the
/// fourth derivative of the other curve, if the curve fills the nodes, and less if it is narrower.
const CHUNK: usize = PHASES;

/// Share of a curve's light below which a chunk is left out.
const FAINT: f64 = 1e-9;

/// Share of a curve's light beside its lines below which the rest counts as nothing: an opened bell
/// keeps as much in its tails.
const REST: f64 = 1e-6;

/// Share of a chunk that has to stand out from the curve beside it to count as a line.
const STANDS_OUT: f64 = 0.05;

/// A curve as a few points: its integral over anything smooth is a sum over them.
#[derive(Debug, Clone)]
pub struct Sparse {
    /// Places, in nodes of the axis from its first wavelength, and amounts, in means of nodes.
    points: Vec<[f64; 2]>,
}

impl Sparse {
    /// Splits a curve into its lines, features within a spacing that stand out, and the rest.
    /// Either is None if it is empty; the lines also if they are more than some two dozen points.
    /// Each spacing's part becomes the two points that have its moments up to the third (Gauss's
    /// rule with the line as weight).
    pub fn split(fine: Fine) -> (Option<Self>, Option<Fine>) {
        let lines = standing_out(fine.means());
        let total: f64 = lines.iter().sum();
        let mut left = fine.clone();
        let mut points = Vec::new();
        // Chunks begin where light does.
        let mut start = 0;
        while let Some(dark) = lines[start..].iter().position(|line| *line > 0.0) {
            start += dark;
            let end = (start + CHUNK).min(lines.len());
            let (chunk, all) = (&lines[start..end], &fine.means()[start..end]);
            let light: f64 = chunk.iter().sum();
            if light > FAINT * total && light > STANDS_OUT * all.iter().sum::<f64>() {
                let first = (fine.first() + start as i64) as f64;
                points.extend(
                    two_points(chunk)
                        .into_iter()
                        .map(|[x, mass]| [first + x, mass]),
                );
                left.take(start, chunk);
            }
            if points.len() > MOST_POINTS {
                return (None, Some(fine));
            }
            start = end;
        }
        let rest: f64 = left.means().iter().sum();
        let all: f64 = fine.means().iter().sum();
        let is_dark = left.ends_dark() && rest <= REST * all;
        let sparse = (!points.is_empty()).then_some(Self { points });
        (sparse, (!is_dark).then_some(left))
    }

    /// These points and, if they are too many for a table, one for each node of a curve.
    pub fn with_all(lines: Option<Self>, rest: &Fine) -> Self {
        let mut points = lines.map_or_else(Vec::new, |lines| lines.points);
        let nodes = (rest.first()..).zip(rest.means());
        points.extend(nodes.map(|(node, mean)| [node as f64, *mean]));
        Self { points }
    }
}

/// The amount by which the curve exceeds its opening by a spacing: lowered to its least within half
/// a spacing to either side, then raised to the greatest of that, a curve loses its narrower
/// features (Serra 1982, Image Analysis and Mathematical Morphology, ch. II).
fn standing_out(means: &[f64]) -> Vec<f64> {
    let over = |list: &[f64], most: fn(f64, f64) -> f64| -> Vec<f64> {
        (0..list.len())
            .map(|i| {
                let near = &list[i.saturating_sub(CHUNK / 2)..(i + CHUNK / 2 + 1).min(list.len())];
                near.iter().copied().fold(list[i], most)
            })
            .collect()
    };
    let opened = over(&over(means, f64::min), f64::max);
    means
        .iter()
        .zip(opened)
        .map(|(mean, low)| (mean - low).max(0.0))
        .collect()
}

/// The two points with the moments, up to the third, of the masses at 0, 1, 2, …; one point if they
/// are at one place.
fn two_points(masses: &[f64]) -> Vec<[f64; 2]> {
    let mass: f64 = masses.iter().sum();
    let moment = |about: f64, power: i32| -> f64 {
        let parts = (0..)
            .zip(masses)
            .map(|(i, m)| m * (f64::from(i) - about).powi(power));
        parts.sum::<f64>() / mass
    };
    let mean = moment(0.0, 1);
    let variance = moment(mean, 2);
    if variance <= f64::EPSILON {
        return vec![[mean, mass]];
    }
    // Roots of x² − (skew/variance) x − variance: the orthogonal polynomial of degree 2.
    let half = 0.5 * moment(mean, 3) / variance;
    let root = (half * half + variance).sqrt();
    let far = half + root.copysign(half);
    let near = -variance / far;
    let share = near / (near - far);
    vec![
        [mean + far, mass * share],
        [mean + near, mass * (1.0 - share)],
    ]
}

impl FineSensor {
    /// The channels of f(Dλ)·g(λ), where f is `sparse`, given ln D, and g by the place of λ in
    /// nodes of the axis.
    #[inline]
    pub fn through(&self, sparse: &Sparse, ln_doppler: f64, g: impl Fn(f64) -> f64) -> [f64; 3] {
        let shift = ln_doppler / self.axis().spacing() * PHASES as f64;
        let mut sum = [0.0; 3];
        for [node, mass] in &sparse.points {
            let node = node - shift;
            if let Some(weights) = self.weights_at(node) {
                let light = mass * g(node);
                (0..3).for_each(|c| sum[c] += weights[c] * light);
            }
        }
        sum
    }

    /// Writes the responses of all wavelengths to a curve shifted by whole nodes: three channels of
    /// `columns`.
    fn respond(&self, fine: &Fine, shift: i64, columns: usize, out: &mut [f64]) {
        let last = self.axis().count() as i64 - 1;
        let dark = fine.ends_dark();
        let lit = fine.first()..=fine.last();
        let taps: [[f64; 4]; PHASES] =
            std::array::from_fn(|phase| catmull_rom(phase as f64 / PHASES as f64));
        for (i, weight) in self.nodes() {
            let node = i + shift;
            if dark && !lit.contains(&node) {
                continue;
            }
            let mean = fine.mean(node);
            let (below, phase) = (i.div_euclid(PHASES as i64), i.rem_euclid(PHASES as i64));
            for (tap, part) in (below - 1..).zip(taps[phase as usize]) {
                let j = tap.clamp(0, last) as usize;
                for c in 0..3 {
                    out[c * columns + j] += weight[c] * mean * part;
                }
            }
        }
    }
}

/// The response of a sensor to a smooth curve seen through a narrow one, under any shift of the
/// narrow one.
///
/// Channel c of f(Dλ)·g(λ) is Σⱼ V_cj(ln D) gⱼ, where gⱼ is g at the axis' wavelengths and V_cj the
/// channel of f times the cubic (Catmull-Rom in ln λ) that is 1 at the j-th and 0 at the others. It
/// is exact for every g that is such a cubic, so for constants; the error of others is that of the
/// cubic, at most h²/10 of g″. Reading it at a shift costs as much as the product of two baked
/// curves.
#[derive(Debug, Clone)]
pub struct Responses {
    /// Rows of three channels, each as long as the axis and on to the next multiple of [`LANES`].
    rows: Vec<f32>,
    /// Length of a channel.
    columns: usize,
    /// Shift of the first row, in rows.
    first: i64,
    /// Rows per unit of ln D.
    per_unit: f64,
    scale: f64,
}

impl Responses {
    /// Distance of rows in units of an axis' spacing.
    pub const SPACING: f64 = ROW_NODES as f64 / PHASES as f64;

    /// Whether a table from `low` to `high` is small enough to be made.
    pub fn fits(axis: LogAxis, [low, high]: [f64; 2]) -> bool {
        let rows = (high - low) / (axis.spacing() * Self::SPACING);
        3.0 * rows * axis.count() as f64 <= MOST_NUMBERS
    }

    /// Tabulates a curve for ln D from `low` to `high`, constant beyond.
    pub fn new(sensor: &FineSensor, fine: &Fine, [low, high]: [f64; 2]) -> Self {
        let per_unit = 1.0 / (sensor.axis().spacing() * Self::SPACING);
        let count = sensor.axis().count();
        let columns = count.next_multiple_of(LANES);
        let first = (low * per_unit).floor() as i64;
        let last = ((high * per_unit).ceil() as i64).max(first + 1);
        let mut exact = vec![0.0; 3 * columns * (last - first + 1) as usize];
        for (row, out) in (first..=last).zip(exact.chunks_exact_mut(3 * columns)) {
            sensor.respond(fine, row * ROW_NODES, columns, out);
        }
        let scale = exact.iter().fold(0.0f64, |most, v| most.max(v.abs()));
        let over = if scale > 0.0 { 1.0 / scale } else { 0.0 };
        let shape = |value: &f64| {
            let shape = (value * over) as f32;
            // Subnormal numbers would slow the kernel four-fold.
            if shape.abs() < 1e-30 { 0.0 } else { shape }
        };
        Self {
            rows: exact.iter().map(shape).collect(),
            columns,
            first,
            per_unit,
            scale,
        }
    }

    /// Memory of its rows, bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.rows)
    }

    /// The channels of the curve under a shift, given ln D, times a shape: values of order 1, as
    /// many as the axis has.
    #[inline]
    pub fn channels(&self, ln_doppler: f64, shape: &[f32]) -> [f64; 3] {
        let size = 3 * self.columns;
        let last = (self.rows.len() / size - 1) as f64;
        let place = (ln_doppler * self.per_unit - self.first as f64).clamp(0.0, last);
        let below = (place as usize).min(last as usize - 1);
        let share = (place - below as f64) as f32;
        let rows = &self.rows[below * size..(below + 2) * size];
        let (low, high) = rows.split_at(size);
        [0, 1, 2].map(|c| {
            let channel = c * self.columns..(c + 1) * self.columns;
            let sum = weigh(&low[channel.clone()], &high[channel], share, shape);
            self.scale * f64::from(sum).max(0.0)
        })
    }
}

/// Σ (low + (high − low)·share)·shape, in lanes of fixed order.
#[inline(always)]
fn weigh(low: &[f32], high: &[f32], share: f32, shape: &[f32]) -> f32 {
    let mut lanes = [0.0f32; LANES];
    let keep = 1.0 - share;
    let (chunks, rest) = shape.as_chunks::<LANES>();
    let rows = low
        .as_chunks::<LANES>()
        .0
        .iter()
        .zip(high.as_chunks::<LANES>().0);
    for ((low, high), shape) in rows.zip(chunks) {
        for i in 0..LANES {
            lanes[i] += (low[i] * keep + high[i] * share) * shape[i];
        }
    }
    let start = chunks.len() * LANES;
    for (i, shape) in rest.iter().enumerate() {
        lanes[i] += (low[start + i] * keep + high[start + i] * share) * shape;
    }
    lanes.iter().sum()
}
