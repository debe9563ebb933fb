//! How much of a picture's light was not followed in mirrors and glass.
//!
//! Of a ray it is known which share of what arrives by mirrors and glass was cut, as too deep or
//! too faint, and not how bright that would have been. It is taken to be as bright as the rest: of
//! a ray that received the light L with the share c cut, L/(1 − c) would have arrived, and c of that
//! is left out. Exact where everything around is equally bright, and where surfaces that shine
//! themselves show each other without end. Where most of the rays with something cut see black, the
//! picture's mean light stands for what they lack, whichever is more: Σ c · ΣL / rays.

/// Largest share of a picture's light that is left out without a word.
pub const SILENT: f64 = 0.005;

/// Most that a ray's light is multiplied by to have what it lacks: where nearly nothing of what
/// arrives was followed, it tells little of the rest.
const MOST: f64 = 1000.0;

/// Sums over the rays of a picture.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct LeftOut {
    /// How many there are.
    rays: f64,
    /// Their light: luminance, or that of all bands.
    light: f64,
    /// The shares cut.
    cut: f64,
    /// Light that is left out by what the rays themselves see.
    lost: f64,
}

impl LeftOut {
    /// Counts so many rays and their light, whatever was cut of it.
    #[inline(always)]
    pub fn add_rays(&mut self, rays: u32, light: f64) {
        self.rays += f64::from(rays);
        self.light += light;
    }

    /// Counts what was cut of one ray that received so much light, with
    /// [`add_rays`](Self::add_rays) apart.
    #[inline(always)]
    pub fn add_cut(&mut self, cut: f64, light: f64) {
        self.cut += cut;
        self.lost += cut * light * (1.0 / (1.0 - cut).max(0.0)).min(MOST);
    }

    /// Adds the sums of another part of the picture.
    pub fn add(&mut self, other: &Self) {
        self.rays += other.rays;
        self.light += other.light;
        self.cut += other.cut;
        self.lost += other.lost;
    }

    /// Estimated share of the picture's light that is left out, from 0 to 1. 0 of a black one, and
    /// where light is beyond all numbers.
    pub fn share(&self) -> f64 {
        let lost = self.lost.max(self.light * (self.cut / self.rays.max(1.0)));
        let share = lost / (self.light + lost);
        if share.is_finite() { share } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(rays: &[(f64, f64)]) -> f64 {
        let mut sums = LeftOut::default();
        for (light, cut) in rays {
            sums.add_rays(1, *light);
            sums.add_cut(*cut, *light);
        }
        sums.share()
    }

    #[test]
    fn in_an_even_sky_it_is_the_mean_of_what_was_cut() {
        // Of radiance 1, each ray sees 1 − c.
        let share = of(&[(1.0, 0.0), (0.9, 0.1), (0.6, 0.4), (1.0, 0.0)]);
        assert!((share - 0.5 / 4.0).abs() < 1e-15, "{share}");
    }

    #[test]
    fn between_mirrors_that_shine_it_is_the_rest_of_the_series() {
        // 1 + ½ + ¼ of 2.
        assert!((of(&[(1.75, 0.125)]) - 0.125).abs() < 1e-15);
    }

    #[test]
    fn what_sees_black_is_taken_to_lack_the_mean() {
        let share = of(&[(0.0, 0.5), (1.0, 0.0), (1.0, 0.0), (2.0, 0.0)]);
        assert!((share - 0.125 / 1.125).abs() < 1e-15, "{share}");
        assert_eq!(of(&[(0.0, 1.0)]), 0.0);
        assert_eq!(of(&[]), 0.0);
        assert_eq!(of(&[(f64::INFINITY, 0.5)]), 0.0);
    }
}
