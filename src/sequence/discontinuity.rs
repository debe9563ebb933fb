//! Discontinuities: frames that do not fit between their neighbors, because they are black, shifted
//! or garbled.
//!
//! Frames are compared as grids of at most 64 × 64 means of the displayed values; the distance of
//! two grids is the root of the mean square. With x the grids, the difference of frame i is d =
//! |x(i) − ½(x(i−1) + x(i+1))|. It is compared with the error of interpolation here without frame
//! i: the smaller of |x(i−1) − ⅔x(i−2) − ⅓x(i+1)| and its mirror image, and the median of d in the
//! frames 2 to 4 away. The first frame is judged by extrapolation, 2d of the second against 2d of
//! the third, and the last likewise.
//!
//! A cut, the kink at the beginning of a ramp, and a value that turns back have a d of 1.5 times
//! the smaller of the two (½ against ⅓ of the step; 1 against ⅔ where it turns back), edges that
//! move evenly 0.87 times, a parabola 0.5 times; a single wrong frame has nothing to compare with
//! but the motion around it. So [`FACTOR`] is twice the worst of what sequences do. Rounding alone
//! can make d one level of 255, [`LEVEL`].
//!
//! Weak if two bad frames are adjacent (they look like two cuts), and if the author meant something
//! to flash for one frame, which the caller has to know.

use std::collections::VecDeque;

/// Ratio to the error of interpolation without the frame.
pub(super) const FACTOR: f64 = 3.0;

/// One level of the 8-bit values.
pub(super) const LEVEL: f64 = 1.0 / 255.0;

/// Number of cells on a side of a grid at most.
const CELLS: usize = 64;

/// Distances, in frames, of the differences whose median is taken.
const REACH: std::ops::RangeInclusive<usize> = 2..=4;

/// An image's means over the cells of a grid, 0 to 1.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Grid(Vec<f32>);

impl Grid {
    /// The grid of an image of three bytes per pixel and `width` pixels per row.
    pub(super) fn new(rgb8: &[u8], width: usize) -> Self {
        let rows = rgb8.chunks_exact(width.max(1) * 3);
        let height = rows.len();
        let (across, down) = (width.min(CELLS), height.min(CELLS));
        let mut sums = vec![0.0_f32; across * down * 3];
        let mut counts = vec![0.0_f32; across * down];
        for (y, row) in rows.enumerate() {
            for (x, pixel) in row.as_chunks::<3>().0.iter().enumerate() {
                let cell = y * down / height * across + x * across / width;
                counts[cell] += 255.0;
                for (sum, byte) in sums[cell * 3..].iter_mut().zip(pixel) {
                    *sum += f32::from(*byte);
                }
            }
        }
        for (cell, count) in sums.chunks_exact_mut(3).zip(counts) {
            cell.iter_mut().for_each(|sum| *sum /= count);
        }
        Self(sums)
    }
}

/// |Σ weight · grid|, as root of the mean square; None if a grid is missing.
fn distance<const N: usize>(terms: [(f32, &Option<Grid>); N]) -> Option<f64> {
    let mut sum = vec![0.0_f32; terms[0].1.as_ref()?.0.len()];
    for (weight, grid) in terms {
        for (sum, value) in sum.iter_mut().zip(&grid.as_ref()?.0) {
            *sum += weight * value;
        }
    }
    let squares: f64 = sum.iter().map(|x| f64::from(*x) * f64::from(*x)).sum();
    Some((squares / sum.len().max(1) as f64).sqrt())
}

/// A frame that does not fit between its neighbours.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Discontinuity {
    /// Its number.
    pub(super) frame: u32,
    /// Its difference from what its neighbors predict, 0 to 1.
    pub(super) difference: f64,
    /// The difference of others around it.
    pub(super) usual: f64,
}

/// Differences of a sequence's frames. Only four frames are kept.
#[derive(Debug, Default)]
pub(super) struct Differences {
    last: VecDeque<Option<Grid>>,
    count: usize,
    /// Numbers of the frames, except those in the middle of long gaps.
    frames: Vec<u32>,
    /// d of each frame.
    plain: Vec<Option<f64>>,
    /// Errors of interpolation in the frame before without this one, and in the frame after.
    before: Vec<Option<f64>>,
    after: Vec<Option<f64>>,
}

impl Differences {
    /// Adds frame number `frame`, which follows those before; None if it has no grid.
    pub(super) fn push(&mut self, frame: u32, grid: Option<Grid>) {
        self.end(frame - 1);
        self.frames.push(frame);
        self.take(grid);
    }

    /// Ends the sequence at frame number `frame`. Frames farther away than any frame is compared
    /// with need not be counted.
    pub(super) fn end(&mut self, frame: u32) {
        const FAR: u32 = *REACH.end() as u32 + 1;
        let before = self.frames.last().copied().unwrap_or(0);
        let gap = frame.saturating_sub(before);
        let near = (before + 1..=frame).take(FAR as usize);
        let beyond = (gap > FAR).then(|| (frame - (gap - FAR).min(FAR) + 1)..=frame);
        let numbers: Vec<u32> = near.chain(beyond.into_iter().flatten()).collect();
        for number in numbers {
            self.frames.push(number);
            self.take(None);
        }
    }

    fn take(&mut self, grid: Option<Grid>) {
        self.last.push_back(grid);
        if self.last.len() > 4 {
            self.last.pop_front();
        }
        self.count += 1;
        for list in [&mut self.plain, &mut self.before, &mut self.after] {
            list.push(None);
        }
        let n = self.count;
        match self.last.make_contiguous() {
            [a, b, c, d] => {
                self.plain[n - 2] = distance([(1.0, c), (-0.5, b), (-0.5, d)]);
                self.before[n - 2] = distance([(1.0, b), (-2.0 / 3.0, a), (-1.0 / 3.0, d)]);
                self.after[n - 3] = distance([(1.0, c), (-2.0 / 3.0, d), (-1.0 / 3.0, a)]);
            }
            [a, b, c] => self.plain[n - 2] = distance([(1.0, b), (-0.5, a), (-0.5, c)]),
            _ => {}
        }
    }

    /// The frames that do not fit.
    pub(super) fn discontinuities(&self) -> Vec<Discontinuity> {
        (0..self.count).filter_map(|i| self.judge(i)).collect()
    }

    fn judge(&self, index: usize) -> Option<Discontinuity> {
        let last = self.count.checked_sub(1)?;
        let (difference, shape) = match index {
            0 => (self.at(1)? * 2.0, self.at(2)? * 2.0),
            i if i == last => (
                self.at(last - 1)? * 2.0,
                self.at(last.checked_sub(2)?)? * 2.0,
            ),
            i => (self.at(i)?, least(self.before[i], self.after[i])?),
        };
        let usual = shape.max(self.median_around(index));
        let stands_out = difference > FACTOR * usual + LEVEL;
        stands_out.then_some(Discontinuity {
            frame: self.frames[index],
            difference,
            usual,
        })
    }

    fn at(&self, index: usize) -> Option<f64> {
        self.plain.get(index).copied().flatten()
    }

    /// The median difference of the frames around, the lower one of two; 0 if there are none.
    fn median_around(&self, index: usize) -> f64 {
        let left = REACH.filter_map(|step| self.at(index.checked_sub(step)?));
        let right = REACH.filter_map(|step| self.at(index + step));
        let mut around: Vec<f64> = left.chain(right).collect();
        around.sort_unstable_by(f64::total_cmp);
        let middle = around.len().saturating_sub(1) / 2;
        around.get(middle).copied().unwrap_or(0.0)
    }
}

fn least(a: Option<f64>, b: Option<f64>) -> Option<f64> {
    match (a, b) {
        (Some(a), Some(b)) => Some(a.min(b)),
        (one, other) => one.or(other),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIDE: usize = 80;

    /// A picture by the value of each pixel, 0 to 1.
    fn picture(value: impl Fn(f64, f64) -> f64) -> Vec<u8> {
        let pixel = |i: usize| {
            let (x, y) = ((i % SIDE) as f64 + 0.5, (i / SIDE) as f64 + 0.5);
            (value(x / SIDE as f64, y / SIDE as f64).clamp(0.0, 1.0) * 255.0).round() as u8
        };
        (0..SIDE * SIDE).flat_map(|i| [pixel(i); 3]).collect()
    }

    fn discontinuities(pictures: &[Vec<u8>]) -> Vec<usize> {
        let mut differences = Differences::default();
        for (frame, rgb8) in (1..).zip(pictures) {
            differences.push(frame, Some(Grid::new(rgb8, SIDE)));
        }
        let found = differences.discontinuities();
        found.iter().map(|found| found.frame as usize - 1).collect()
    }

    /// Discs that move by `path` of a share of the sequence, brighter to the right.
    fn sequence(frames: usize, path: impl Fn(f64) -> f64) -> Vec<Vec<u8>> {
        let frame = |i: usize| {
            let at = path(i as f64 / (frames - 1) as f64);
            picture(|x, y| {
                let (u, v) = ((x - at) * 5.0, y * 5.0);
                // Edges of a pixel's width.
                let inside = (0.3 - (u - u.round()).hypot(v - v.round())) * 16.0 + 0.5;
                0.05 + (0.35 + 0.5 * x) * inside.clamp(0.0, 1.0)
            })
        };
        (0..frames).map(frame).collect()
    }

    #[test]
    fn motion_at_any_pace_fits() {
        for frames in [5, 12, 49] {
            for speed in [0.0, 0.02, 0.2, 1.0, 3.0] {
                assert_eq!(
                    discontinuities(&sequence(frames, |t| speed * t)),
                    [0; 0],
                    "{speed}"
                );
                let smooth = |t: f64| speed * t * t * (3.0 - 2.0 * t);
                assert_eq!(
                    discontinuities(&sequence(frames, smooth)),
                    [0; 0],
                    "{speed}"
                );
                // It begins, turns back and stops, and that not within three frames.
                if frames < 10 {
                    continue;
                }
                let kinks = |t: f64| speed * (0.3 - (t - 0.5).abs()).max(0.0);
                assert_eq!(discontinuities(&sequence(frames, kinks)), [0; 0], "{speed}");
            }
        }
    }

    #[test]
    fn fades_and_cuts_fit() {
        let fade = |i: i32| picture(|x, _| x * (f64::from(i - 4) / 10.0).clamp(0.0, 1.0));
        assert_eq!(
            discontinuities(&(0..20).map(fade).collect::<Vec<_>>()),
            [0; 0]
        );
        for cut in 2..9 {
            let scene = |i: usize| picture(|x, y| if i < cut { x } else { 1.0 - y });
            let pictures: Vec<_> = (0..11).map(scene).collect();
            assert_eq!(discontinuities(&pictures), [0; 0], "a cut at {cut}");
        }
    }

    #[test]
    fn one_black_shifted_or_garbled_frame_is_found_wherever_it_stands() {
        for frames in [5, 12] {
            for bad in 0..frames {
                let good = sequence(frames, |t| 0.02 * t);
                let with = |picture: Vec<u8>| {
                    let mut pictures = good.clone();
                    pictures[bad] = picture;
                    discontinuities(&pictures)
                };
                assert_eq!(with(vec![0; SIDE * SIDE * 3]), [bad], "black {bad}");
                let mut shifted = good[bad].clone();
                shifted.rotate_right(SIDE * 3 * 5 + 12);
                assert_eq!(with(shifted), [bad], "shifted {bad}");
                let mut garbled = good[bad].clone();
                for (i, byte) in garbled[SIDE * SIDE..].iter_mut().enumerate() {
                    *byte = ((i as u64 * 2_654_435_761) >> 16) as u8;
                }
                assert_eq!(with(garbled), [bad], "garbled {bad}");
            }
        }
    }

    #[test]
    fn two_black_frames_apart_are_both_found() {
        for gap in 2..6 {
            let mut pictures = sequence(16, |t| 0.05 * t);
            for bad in [5, 5 + gap] {
                pictures[bad].fill(0);
            }
            assert_eq!(discontinuities(&pictures), [5, 5 + gap]);
        }
    }

    #[test]
    fn a_frame_that_cannot_be_shown_is_no_neighbor() {
        let mut differences = Differences::default();
        for (frame, rgb8) in (1..).zip(sequence(12, |t| 0.05 * t)) {
            differences.push(frame, (frame != 7).then(|| Grid::new(&rgb8, SIDE)));
        }
        assert_eq!(differences.discontinuities(), []);
    }

    /// The same, whether each frame of a gap is told or none of them is; and a gap costs nothing.
    #[test]
    fn gaps_of_any_length_part_what_is_around_them() {
        for gap in [1, 2, 4, 5, 9, 10, 11, 30, 1_000_000] {
            let mut pictures = sequence(12, |t| 0.05 * t);
            pictures[3].fill(0);
            let [mut told, mut untold] = [Differences::default(), Differences::default()];
            for (i, rgb8) in (0..).zip(&pictures) {
                let frame = if i < 6 { i + 1 } else { i + 1 + gap };
                if i == 6 && gap < 100 {
                    (7..frame).for_each(|missing| told.push(missing, None));
                }
                told.push(frame, Some(Grid::new(rgb8, SIDE)));
                untold.push(frame, Some(Grid::new(rgb8, SIDE)));
            }
            untold.end(2_000_000);
            let found = untold.discontinuities();
            assert_eq!(found, told.discontinuities(), "{gap}");
            assert_eq!(
                found.iter().map(|f| f.frame).collect::<Vec<_>>(),
                [4],
                "{gap}"
            );
            assert!(untold.frames.len() <= 12 + 4 * 5);
        }
    }

    #[test]
    fn a_grid_holds_the_means_of_its_cells() {
        let rgb8: Vec<u8> = (0..128 * 2)
            .flat_map(|i| [(i % 2) * 255, 51, 0])
            .map(|v| v as u8)
            .collect();
        let grid = Grid::new(&rgb8, 128);
        assert_eq!(grid.0.len(), 64 * 2 * 3);
        assert!(grid.0.chunks(3).all(|cell| cell == [0.5, 0.2, 0.0]));
    }
}
