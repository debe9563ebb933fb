//! A. Boosts.

use glam::DVec3;
use restframe::relativity::{Boost, Celerity};

cases! {
    /// Relative tolerance: four roundings.
    fn a3_lorentz_factors_are_never_expressed_through_beta(card) {
        let u = Celerity::from_lorentz_factor(1e8, DVec3::Z).unwrap();
        let forward = 1.0 / Boost::into_rest_of(u).light(DVec3::Z).frequency_ratio;
        card.relative("D head-on at γ = 1e8", 2e8, forward, 4.0 * f64::EPSILON);
    }
}
