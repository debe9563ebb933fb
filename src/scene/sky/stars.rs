//! Stars: discs that emit as black bodies, found by direction.
//!
//! A star is a disc of uniform radiance, so that aberration, beaming and shift of its light need no
//! rules of their own. Its illuminance at an observer at rest in the sky, on a surface that faces
//! it, is that of its visual magnitude, whatever its size and temperature.

use super::catalogue::Star;
use crate::color::cie;
use crate::shot::STAR_KELVIN;
use crate::spectrum::{catmull_rom, planck};
use glam::DVec3;
use std::f64::consts::PI;
use std::sync::LazyLock;

/// The visual magnitude of an illuminance of 1 lx outside the atmosphere (Allen 1976, Astrophysical
/// Quantities, 3rd edition; a star of magnitude 0 gives 2.5·10⁻⁶ lx).
const LUX_MAGNITUDE: f64 = -13.98;

/// The light of a star's disc: its spectral radiance is `scale` · B(λ, T).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StarLight {
    /// Temperature T, K.
    pub temperature_k: f64,
    /// Factor on Planck's curve.
    pub scale: f64,
}

/// Stars of one size, sorted into the cells of a grid on the faces of a cube.
#[derive(Debug, Clone, PartialEq)]
pub struct Stars {
    /// Number of cells along an edge of the cube.
    side: usize,
    /// Index of the first entry of each cell; one more at the end.
    first: Vec<u32>,
    entries: Vec<Entry>,
    lights: Vec<StarLight>,
    /// Square of the distance, on the unit sphere, from the center of a disc to its edge.
    chord_squared: f64,
}

/// A star whose disc may reach into a cell.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Entry {
    direction: DVec3,
    star: u32,
}

impl Stars {
    /// Stars, at most [`MOST_STARS`](crate::shot::MOST_STARS), whose discs are `size_deg` degrees
    /// across (above 0, at most 10).
    pub fn new(stars: &[Star], size_deg: f64) -> Self {
        let radius = 0.5 * size_deg.to_radians();
        let chord = 2.0 * (0.5 * radius).sin();
        // About two cells per star, none smaller than a disc: most contain at most one star.
        let most = (90.0 / size_deg).max(1.0);
        let side = (stars.len() as f64 / 2.0).sqrt().ceil().clamp(1.0, most) as usize;
        let projected = PI * radius.sin().powi(2);
        let light = |star: &Star| StarLight {
            temperature_k: star.temperature_k,
            scale: illuminance(star.magnitude) / projected / luminance(star.temperature_k),
        };
        let mut grid = Self {
            side,
            first: vec![0; 6 * side * side + 1],
            entries: Vec::new(),
            lights: stars.iter().map(light).collect(),
            chord_squared: chord * chord,
        };
        grid.sort_in(stars, chord);
        grid
    }

    /// Counting sort: the stars of a cell keep their order.
    fn sort_in(&mut self, stars: &[Star], chord: f64) {
        for star in stars {
            cells(star.direction, chord, self.side, |cell| {
                self.first[cell + 1] += 1
            });
        }
        for cell in 1..self.first.len() {
            self.first[cell] += self.first[cell - 1];
        }
        let none = Entry {
            direction: DVec3::ZERO,
            star: 0,
        };
        self.entries = vec![none; self.first.last().map_or(0, |last| *last as usize)];
        let mut next = self.first.clone();
        for (number, star) in (0..).zip(stars) {
            cells(star.direction, chord, self.side, |cell| {
                self.entries[next[cell] as usize] = Entry {
                    direction: star.direction,
                    star: number,
                };
                next[cell] += 1;
            });
        }
    }

    /// Number of stars.
    pub fn count(&self) -> usize {
        self.lights.len()
    }

    /// The stars whose discs contain a unit direction.
    #[inline]
    pub fn seen(&self, direction: DVec3) -> impl Iterator<Item = StarLight> {
        let cell = cell_of(direction, self.side);
        let [from, to] = [self.first[cell], self.first[cell + 1]].map(|i| i as usize);
        self.entries[from..to]
            .iter()
            .filter(move |entry| entry.direction.distance_squared(direction) <= self.chord_squared)
            .map(|entry| self.lights[entry.star as usize])
    }
}

/// Illuminance of a visual magnitude, lx.
fn illuminance(magnitude: f64) -> f64 {
    10f64.powf(-0.4 * (magnitude - LUX_MAGNITUDE))
}

/// Entries of [`LUMINANCE`] per unit of ln T.
const PER_UNIT: f64 = 100.0;

/// ln Y over ln T; entry 1 is the lowest temperature of a star.
static LUMINANCE: LazyLock<Vec<f64>> = LazyLock::new(|| {
    let count = ((STAR_KELVIN[1] / STAR_KELVIN[0]).ln() * PER_UNIT).ceil() as usize + 4;
    let kelvin = |i: usize| STAR_KELVIN[0] * ((i as f64 - 1.0) / PER_UNIT).exp();
    (0..count)
        .map(|i| cie::xyz_of(|nm| planck::radiance(nm, kelvin(i)))[1].ln())
        .collect()
});

/// Luminance of a black body, cd/m², for the temperatures that stars may have.
fn luminance(kelvin: f64) -> f64 {
    let place = (kelvin / STAR_KELVIN[0]).ln().max(0.0) * PER_UNIT;
    let first = (place as usize).min(LUMINANCE.len() - 4);
    let taps = catmull_rom(place - first as f64);
    let near = &LUMINANCE[first..first + 4];
    let ln: f64 = taps.iter().zip(near).map(|(tap, ln)| tap * ln).sum();
    ln.exp()
}

/// The cell that contains a direction.
#[inline]
fn cell_of(direction: DVec3, side: usize) -> usize {
    let size = direction.abs();
    let axis = if size.x >= size.y && size.x >= size.z {
        0
    } else if size.y >= size.z {
        1
    } else {
        2
    };
    let face = 2 * axis + usize::from(direction[axis] < 0.0);
    let along = |axis: usize, by: usize| step(direction[(axis + by) % 3] / size[axis], side);
    (face * side + along(axis, 1)) * side + along(axis, 2)
}

/// The row or column of a place from −1 to 1 on a face.
#[inline]
fn step(place: f64, side: usize) -> usize {
    ((0.5 * (place + 1.0) * side as f64) as usize).min(side - 1)
}

/// Calls `add` with every cell that a disc may reach into: those of the box around it, as seen on
/// each face.
fn cells(middle: DVec3, chord: f64, side: usize, mut add: impl FnMut(usize)) {
    // Wider than rounding in either place.
    let reach = chord * (1.0 + 1e-9) + 1e-14;
    // On a face its own axis has the greatest component.
    let least = 1.0 / 3f64.sqrt() - 1e-9;
    for face in 0..6 {
        let axis = face / 2;
        let height = if face % 2 == 0 {
            middle[axis]
        } else {
            -middle[axis]
        };
        let heights = [(height - reach).max(least), height + reach];
        if heights[1] < least {
            continue;
        }
        let span = |by: usize| {
            let place = middle[(axis + by) % 3];
            let [low, high] = [place - reach, place + reach];
            let low = heights
                .map(|h| low / h)
                .into_iter()
                .fold(f64::MAX, f64::min);
            let high = heights
                .map(|h| high / h)
                .into_iter()
                .fold(f64::MIN, f64::max);
            (low <= 1.0 && high >= -1.0)
                .then(|| step(low.max(-1.0), side)..=step(high.min(1.0), side))
        };
        if let (Some(rows), Some(columns)) = (span(1), span(2)) {
            for row in rows {
                for column in columns.clone() {
                    add((face * side + row) * side + column);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::sky::random::random_stars;
    use crate::shot::RandomStars;

    fn strewn(count: u32, size: f64) -> (Vec<Star>, Stars) {
        let stars = random_stars(&RandomStars {
            count,
            seed: 5,
            size,
            temperature: [3000.0, 30000.0],
            magnitude: [0.0, 6.0],
        });
        let grid = Stars::new(&stars, size);
        (stars, grid)
    }

    #[test]
    fn the_grid_finds_the_stars_that_a_search_of_all_finds() {
        for (count, size) in [
            (1, 10.0),
            (40, 10.0),
            (3000, 1.0),
            (3000, 0.05),
            (20_000, 3.0),
        ] {
            let (stars, grid) = strewn(count, size);
            let radius = 0.5 * size.to_radians();
            let mut met = 0;
            // Directions of another sky, and those at the edges and corners of discs and faces.
            let (others, _) = strewn(3000, 1.0);
            let edges = stars.iter().take(1000).map(|star| {
                let side = star.direction.any_orthonormal_vector();
                let turned =
                    star.direction * (0.999 * radius).cos() + side * (0.999 * radius).sin();
                turned.normalize()
            });
            let corners = [-1.0, 0.0, 1.0]
                .into_iter()
                .flat_map(|x| [-1.0, 1.0].map(|y| DVec3::new(x, y, y).normalize()));
            for direction in others
                .iter()
                .map(|s| s.direction)
                .chain(edges)
                .chain(corners)
            {
                let near = |star: &&Star| star.direction.angle_between(direction) < radius;
                let expected: Vec<f64> =
                    stars.iter().filter(near).map(|s| s.temperature_k).collect();
                let found: Vec<f64> = grid.seen(direction).map(|s| s.temperature_k).collect();
                assert_eq!(found, expected, "{direction} of {count} at {size}");
                met += found.len();
            }
            assert!(met > 0 || count == 1, "{count} {size}");
        }
    }

    /// Allen's round number for magnitude 0, and the luminance by the reference quadrature.
    #[test]
    fn a_star_of_magnitude_zero_gives_two_and_a_half_microlux() {
        assert!((illuminance(0.0) / 2.54e-6 - 1.0).abs() < 0.01);
        assert!((illuminance(-13.98) - 1.0).abs() < 1e-12);
        for kelvin in [500.0, 777.7, 3000.0, 5772.0, 3e4, 1e6, 1e9] {
            let exact = cie::xyz_of(|nm| planck::radiance(nm, kelvin))[1];
            assert!((luminance(kelvin) / exact - 1.0).abs() < 3e-6, "{kelvin}");
        }
    }
}
