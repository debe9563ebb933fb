//! Estimate of the share of an image's light that was not followed in mirrors and glass.
//!
//! For each ray the tracer knows the share of its mirrored and refracted light that was cut,
//! because it was too deep or too faint, but not how bright that light would have been. It is
//! assumed to be as bright as the rest: of a ray that received the light L with the share c cut,
//! L/(1 − c) would have arrived, and c of that is missing. This is exact if everything around is
//! equally bright, and if luminous surfaces mirror each other without end. If most of the cut rays
//! see black, the image's mean light is used for them if that gives more: Σ c · ΣL / rays.

/// Largest share of missing light that causes no warning.
pub const SILENT: f64 = 0.005;

/// Largest factor by which a ray's light is extrapolated. If nearly nothing was followed, it says
/// little of the rest.
const MOST: f64 = 1000.0;

/// Sums over the rays of an image.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct LeftOut {
    /// Number of rays.
    rays: f64,
    /// Sum of their light: luminance, or radiance of all bands.
    light: f64,
    /// Sum of the shares cut.
    cut: f64,
    /// Missing light, extrapolated from what the rays themselves received.
    lost: f64,
}

impl LeftOut {
    /// Counts rays and their light, whatever was cut of it.
    #[inline(always)]
    pub fn add_rays(&mut self, rays: u32, light: f64) {
        self.rays += f64::from(rays);
        self.light += light;
    }

    /// Counts what was cut of one ray that received this much light. The ray itself is counted by
    /// [`add_rays`](Self::add_rays).
    #[inline(always)]
    pub fn add_cut(&mut self, cut: f64, light: f64) {
        self.cut += cut;
        self.lost += cut * light * (1.0 / (1.0 - cut).max(0.0)).min(MOST);
    }

    /// Adds the sums of another part of the image.
    pub fn add(&mut self, other: &Self) {
        self.rays += other.rays;
        self.light += other.light;
        self.cut += other.cut;
        self.lost += other.lost;
    }

    /// Estimated share of the image's light that is missing, from 0 to 1. 0 for a black image, and
    /// if light is not finite.
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
