//! Metering: the exposure for a film, from percentiles of its luminance or of the mean of its
//! bands.

use super::{Channels, Film};

/// The percentile for automatic exposure.
const METERED_PERCENTILE: f64 = 95.0;
/// The linear value to which that percentile is brought.
const METERED_VALUE: f64 = 0.8;
/// The value that 0 stops make 1.0: luminance, cd/m², or radiance of a band, W·m⁻²·sr⁻¹.
pub const WHITE_AT_ZERO_STOPS: f64 = 100.0;

/// The `p`th percentile of luminance, cd/m², or of the mean of the bands, W·m⁻²·sr⁻¹: the least
/// value that at least `p` percent of the pixels do not exceed (nearest rank). `p` is clamped to 0
/// … 100. NaN and negative values count as 0, infinite ones as `f32::MAX`; an empty film gives 0.
pub fn luminance_percentile(film: &Film, p: f64) -> f32 {
    percentile(metered(film).collect(), p)
}

/// The exposure in stops that brings the 95th percentile to 0.8; None if the film is black.
///
/// If more than 95 % of the image is black, the percentile is that of the lit pixels, so that a few
/// lights in the dark are exposed correctly too.
pub fn auto_exposure(film: &Film) -> Option<f64> {
    let mut value = luminance_percentile(film, METERED_PERCENTILE);
    if value <= 0.0 {
        let lit = metered(film).filter(|&y| y > 0.0).collect();
        value = percentile(lit, METERED_PERCENTILE);
    }
    (value > 0.0).then(|| (METERED_VALUE * WHITE_AT_ZERO_STOPS / f64::from(value)).log2())
}

/// The metered value of each pixel: luminance, or the mean of the bands; never negative, always
/// finite.
fn metered(film: &Film) -> impl Iterator<Item = f32> {
    film.xyz.iter().map(|channels| {
        let value = match film.channels {
            Channels::Xyz => channels[1],
            Channels::Bands => channels.iter().map(|band| band / 3.0).sum(),
        };
        if value > 0.0 {
            value.min(f32::MAX)
        } else {
            0.0
        }
    })
}

fn percentile(mut values: Vec<f32>, p: f64) -> f32 {
    if values.is_empty() {
        return 0.0;
    }
    let rank = (p / 100.0 * values.len() as f64).ceil() as usize;
    let index = rank.clamp(1, values.len()) - 1;
    *values.select_nth_unstable_by(index, f32::total_cmp).1
}

#[cfg(test)]
mod tests {
    use super::*;

    fn film(luminances: impl IntoIterator<Item = f32>) -> Film {
        let xyz: Vec<_> = luminances.into_iter().map(|y| [0.0, y, 0.0]).collect();
        Film {
            width: xyz.len() as u32,
            height: 1,
            xyz,
            ..Film::default()
        }
    }

    #[test]
    fn percentiles_are_nearest_ranks() {
        let film = film((1..=100).rev().map(|y| y as f32));
        for p in [1.0, 50.0, 95.0, 100.0] {
            assert_eq!(luminance_percentile(&film, p), p as f32);
        }
        assert_eq!(luminance_percentile(&film, 0.0), 1.0);
        assert_eq!(luminance_percentile(&film, -5.0), 1.0);
        assert_eq!(luminance_percentile(&film, 1e9), 100.0);
        assert_eq!(luminance_percentile(&film, f64::NAN), 1.0);
    }

    #[test]
    fn automatic_exposure_brings_the_95th_percentile_to_four_fifths() {
        let stops = auto_exposure(&film((1..=100).map(|y| y as f32 * 3.0)));
        let value = 95.0 * 3.0 / 100.0 * stops.expect("lit").exp2();
        assert!((value - 0.8).abs() < 1e-12, "{value}");
    }

    #[test]
    fn bands_are_metered_by_their_mean() {
        let film = Film {
            channels: Channels::Bands,
            xyz: vec![[240.0, 0.0, 0.0]; 9],
            ..Film::default()
        };
        assert_eq!(auto_exposure(&film), Some(0.0));
    }

    #[test]
    fn a_black_film_has_no_exposure() {
        assert_eq!(auto_exposure(&film([0.0; 7])), None);
        assert_eq!(auto_exposure(&film([-1.0, f32::NAN])), None);
        assert_eq!(auto_exposure(&Film::default()), None);
    }

    #[test]
    fn a_light_in_the_dark_is_exposed_for() {
        let stops = auto_exposure(&film((0..1000).map(|i| if i == 500 { 80.0 } else { 0.0 })));
        assert_eq!(stops, Some(0.0));
    }

    #[test]
    fn an_infinite_luminance_gives_a_finite_exposure() {
        assert!(auto_exposure(&film([f32::INFINITY; 3])).is_some_and(f64::is_finite));
    }
}
