//! A palette for all frames of an animation, and images in its colors.
//!
//! One palette and a fixed dither pattern avoid flicker: what does not change from frame to frame
//! has the same pixels in each. Colors are found by repeatedly splitting the box of colors with the
//! largest error along its widest axis (Heckbert 1982, by variance); counts are weighted by their
//! root, so that a small thing in front of a large black sky keeps its colors. Up to 256 colors are
//! kept exactly. Dithering is by Bayer's 8 × 8 matrix (1973).

use std::collections::BTreeMap;

/// Largest number of colors.
const MOST: usize = 256;

/// Not looked up yet.
const UNKNOWN: u16 = u16::MAX;

type Color = [u8; 3];

/// Colors, and the nearest of them to any other.
pub(super) struct Palette {
    colors: Vec<Color>,
    /// Largest offset of the dither pattern, in levels.
    spread: f64,
    /// For each 24-bit color the nearest of the palette, filled as needed.
    nearest: Vec<u16>,
}

impl Palette {
    /// The palette of samples of all images.
    pub(super) fn new(samples: impl IntoIterator<Item = Color>) -> Self {
        let mut counts: BTreeMap<Color, f64> = BTreeMap::new();
        for color in samples {
            *counts.entry(color).or_insert(0.0) += 1.0;
        }
        let mut boxes = vec![Cluster::new(
            counts.iter().map(|(c, n)| (*c, n.sqrt())).collect(),
        )];
        while boxes.len() < MOST {
            let worst = (0..boxes.len()).max_by(|a, b| boxes[*a].error.total_cmp(&boxes[*b].error));
            let Some(worst) = worst.filter(|worst| boxes[*worst].error > 0.0) else {
                break;
            };
            let (low, high) = boxes.swap_remove(worst).split();
            boxes.extend([low, high]);
        }
        let mut colors: Vec<Color> = boxes.iter().map(Cluster::color).collect();
        colors.sort_unstable();
        colors.dedup();
        let mut palette = Self {
            colors,
            spread: 0.0,
            nearest: vec![UNKNOWN; 1 << 24],
        };
        palette.spread = palette.spacing(&counts);
        palette
    }

    /// Distance of neighboring colors, in levels: values spread evenly over such a step have an
    /// error of 1/√12 of it.
    fn spacing(&mut self, counts: &BTreeMap<Color, f64>) -> f64 {
        let (mut squares, mut total) = (0.0, 0.0);
        for (color, count) in counts {
            let nearest = usize::from(self.index(*color));
            let nearest = self.colors[nearest];
            squares += count * f64::from(square(*color, nearest)) / 3.0;
            total += count;
        }
        (12.0 * squares / f64::max(total, 1.0)).sqrt()
    }

    /// Red, green and blue of each colour.
    pub(super) fn bytes(&self) -> Vec<u8> {
        self.colors.concat()
    }

    /// An image in the palette's colors. Pixels that have one of them are unchanged.
    pub(super) fn map(&mut self, rgb8: &[u8], width: usize) -> Vec<u8> {
        let pixels = rgb8.as_chunks::<3>().0;
        let mut indices = Vec::with_capacity(pixels.len());
        for (i, color) in pixels.iter().enumerate() {
            let (x, y) = (i % width, i / width);
            let own = self.index(*color);
            let index = if self.colors[usize::from(own)] == *color {
                own
            } else {
                let offset = self.spread * bayer(x, y);
                let dithered =
                    color.map(|c| (f64::from(c) + offset).round().clamp(0.0, 255.0) as u8);
                self.index(dithered)
            };
            indices.push(index);
        }
        indices
    }

    fn index(&mut self, color: Color) -> u8 {
        let [r, g, b] = color.map(usize::from);
        let at = (r << 16) | (g << 8) | b;
        if self.nearest[at] == UNKNOWN {
            let distance = |i: &usize| square(color, self.colors[*i]);
            let nearest = (0..self.colors.len()).min_by_key(distance);
            self.nearest[at] = nearest.unwrap_or(0) as u16;
        }
        self.nearest[at] as u8
    }
}

fn square(a: Color, b: Color) -> u32 {
    let squares = a
        .iter()
        .zip(b)
        .map(|(a, b)| u32::from(a.abs_diff(b)).pow(2));
    squares.sum()
}

/// Bayer's matrix at a pixel, −½ to ½: the bits of x ⊕ y and y in turn, the lowest first.
fn bayer(x: usize, y: usize) -> f64 {
    let mut value = 0;
    for bit in 0..3 {
        let (a, b) = (((x ^ y) >> bit) & 1, (y >> bit) & 1);
        value = value << 2 | a << 1 | b;
    }
    (value as f64 + 0.5) / 64.0 - 0.5
}

/// Colours of one box, with their weights.
struct Cluster {
    members: Vec<(Color, f64)>,
    mean: [f64; 3],
    /// The channel with the largest error, and the error of all three.
    axis: usize,
    error: f64,
}

impl Cluster {
    fn new(members: Vec<(Color, f64)>) -> Self {
        let total: f64 = members.iter().map(|(_, weight)| weight).sum();
        let over = |value: f64| value / f64::max(total, f64::MIN_POSITIVE);
        let sum = |f: &dyn Fn(&Color) -> f64| members.iter().map(|(c, w)| w * f(c)).sum::<f64>();
        let mean = [0, 1, 2].map(|i| over(sum(&|color| f64::from(color[i]))));
        let errors = [0, 1, 2].map(|i| sum(&|color| (f64::from(color[i]) - mean[i]).powi(2)));
        let axis = (0..3).max_by(|a, b| errors[*a].total_cmp(&errors[*b]));
        // A single color has no error except that of the mean's rounding.
        let error = if members.len() > 1 {
            errors.iter().sum()
        } else {
            0.0
        };
        Self {
            members,
            mean,
            axis: axis.unwrap_or(0),
            error,
        }
    }

    /// The two halves, divided at the mean; neither is empty if there is an error.
    fn split(self) -> (Self, Self) {
        let (axis, mean) = (self.axis, self.mean[self.axis]);
        let low = |(color, _): &(Color, f64)| f64::from(color[axis]) < mean;
        let (low, high) = self.members.into_iter().partition(low);
        (Self::new(low), Self::new(high))
    }

    fn color(&self) -> Color {
        self.mean.map(|value| value.round() as u8)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn up_to_256_colors_are_kept_as_they_are() {
        let colors: Vec<Color> = (0..=255).map(|i| [i, 255 - i, i / 2]).collect();
        let mut palette = Palette::new(colors.iter().copied());
        let indices = palette.map(&colors.concat(), 16);
        let bytes = palette.bytes();
        for (color, index) in colors.iter().zip(indices) {
            assert_eq!(bytes[usize::from(index) * 3..][..3], *color);
        }
    }

    #[test]
    fn a_ramp_of_many_colors_keeps_its_means() {
        // A ramp over 4096 colours, on blocks of 8 × 8 as the pattern has them.
        let color = |i: usize| [(i % 256) as u8, (i / 16) as u8, 128];
        let side = 64;
        let picture: Vec<u8> = (0..side * side).flat_map(color).collect();
        let mut palette = Palette::new(picture.as_chunks::<3>().0.iter().copied());
        let indices = palette.map(&picture, side);
        let shown: Vec<u8> = indices
            .iter()
            .flat_map(|i| palette.colors[usize::from(*i)])
            .collect();
        let mean = |bytes: &[u8], at: usize, channel: usize| {
            let pixel = |i: usize| f64::from(bytes[(at + i / 8 * side + i % 8) * 3 + channel]);
            (0..64).map(pixel).sum::<f64>() / 64.0
        };
        // A step of the palette is 256 / √256 = 16 levels on a plane of colours; a block's mean is
        // off by what is left of it after 64 thresholds and by the clamping at the ends.
        let worst = (0..side / 8 * (side / 8)).flat_map(|block| {
            let at = block / 8 * 8 * side + block % 8 * 8;
            let mean = &mean;
            let (shown, picture) = (&shown, &picture);
            (0..3).map(move |c| (mean(shown, at, c) - mean(picture, at, c)).abs())
        });
        let worst = worst.fold(0.0, f64::max);
        assert!(worst < 8.0, "{worst}");
    }

    #[test]
    fn the_pattern_has_each_threshold_once() {
        let mut values: Vec<i64> = (0..64)
            .map(|i| ((bayer(i % 8, i / 8) + 0.5) * 64.0 - 0.5).round() as i64)
            .collect();
        values.sort_unstable();
        assert_eq!(values, (0..64).collect::<Vec<_>>());
    }
}
