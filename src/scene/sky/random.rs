//! Random stars, the same on every machine.

use super::catalogue::Star;
use crate::shot::RandomStars;
use glam::DVec3;

/// Growth of the number of stars: log₁₀ N(< m) rises by this per magnitude. The sky has 49 stars
/// brighter than the second magnitude and 4968 brighter than the sixth (counts from the Hipparcos
/// catalogue, OEIS A053406).
const COUNTS_PER_MAGNITUDE: f64 = 0.5;

/// The stars that the keys describe: uniform over the sphere, temperatures uniform in their
/// logarithm, magnitudes as in the real sky.
///
/// Directions use no functions that differ between machines; temperatures and magnitudes may differ
/// by rounding.
pub fn random_stars(keys: &RandomStars) -> Vec<Star> {
    let mut random = SplitMix(u64::from(keys.seed));
    let [coldest, hottest] = keys.temperature;
    let [brightest, faintest] = keys.magnitude;
    let growth = 10f64.powf(COUNTS_PER_MAGNITUDE * (faintest - brightest)) - 1.0;
    (0..keys.count)
        .map(|_| {
            let direction = random.direction();
            let kelvin = coldest * (random.unit() * (hottest / coldest).ln()).exp();
            let fainter = (random.unit() * growth).ln_1p() / std::f64::consts::LN_10;
            let magnitude = brightest + fainter / COUNTS_PER_MAGNITUDE;
            Star {
                direction,
                temperature_k: kelvin.clamp(coldest, hottest),
                magnitude: magnitude.clamp(brightest, faintest),
            }
        })
        .collect()
}

/// SplitMix64 (Steele, Lea and Flood 2014, Fast Splittable Pseudorandom Number Generators, OOPSLA;
/// the constants are Vigna's public-domain version of 2015, prng.di.unimi.it/splitmix64.c).
struct SplitMix(u64);

impl SplitMix {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = self.0;
        let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number from 0 to below 1, in steps of 2⁻⁵³.
    fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A direction uniform over the sphere, by products and roots alone (Marsaglia 1972, Choosing a
    /// Point from the Surface of a Sphere).
    fn direction(&mut self) -> DVec3 {
        loop {
            let [a, b] = [0, 1].map(|_| 2.0 * self.unit() - 1.0);
            let square = a * a + b * b;
            if square < 1.0 {
                let root = 2.0 * (1.0 - square).sqrt();
                return DVec3::new(a * root, b * root, 1.0 - 2.0 * square).normalize();
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn keys(count: u32, seed: u32) -> RandomStars {
        RandomStars {
            count,
            seed,
            size: 0.05,
            temperature: [3000.0, 30000.0],
            magnitude: [0.0, 6.0],
        }
    }

    /// The first numbers for seed 1234567, which ports of the generator are checked with.
    #[test]
    fn the_generator_is_splitmix64() {
        let mut random = SplitMix(1_234_567);
        let expected = [
            6_457_827_717_110_365_317,
            3_203_168_211_198_807_973,
            9_817_491_932_198_370_423,
        ];
        assert_eq!([0; 3].map(|_| random.next()), expected);
    }

    #[test]
    fn stars_are_evenly_spread_and_a_hundred_times_as_many_four_magnitudes_on() {
        let stars = random_stars(&keys(100_000, 7));
        let share = |which: &dyn Fn(&Star) -> bool| {
            stars.iter().filter(|star| which(star)).count() as f64 / stars.len() as f64
        };
        // √N/N = 0.0016 for a half.
        assert!((share(&|s| s.direction.x > 0.0) - 0.5).abs() < 0.006);
        assert!((share(&|s| s.direction.y > 0.5) - 0.25).abs() < 0.006);
        assert!((share(&|s| s.temperature_k > 9486.8) - 0.5).abs() < 0.006);
        // (10^(m/2) − 1)/(10^3 − 1) up to m.
        assert!((share(&|s| s.magnitude < 5.0) - 0.315_54).abs() < 0.006);
        assert!((share(&|s| s.magnitude < 4.0) - 0.099_1).abs() < 0.004);
        assert!(
            stars
                .iter()
                .all(|s| (s.direction.length() - 1.0).abs() < 1e-15)
        );
    }

    #[test]
    fn a_seed_is_a_sky() {
        assert_eq!(random_stars(&keys(50, 3)), random_stars(&keys(50, 3)));
        assert_ne!(random_stars(&keys(50, 3)), random_stars(&keys(50, 4)));
        let one = RandomStars {
            temperature: [5000.0; 2],
            magnitude: [2.5; 2],
            ..keys(10, 1)
        };
        for star in random_stars(&one) {
            assert_eq!((star.temperature_k, star.magnitude), (5000.0, 2.5));
        }
    }
}
