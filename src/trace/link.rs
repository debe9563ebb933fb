//! The map from one worldline's rest frame to another's, for single events and vectors and for
//! camera rays, many at a time.

use crate::relativity::{Boost, Event, FourVector, SeenLight, Transform};
use glam::DVec3;

/// The map from one worldline's rest frame to another's.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Link {
    /// As special relativity has it.
    Finite(Transform),
    /// As if light were infinitely fast: positions by translation, directions the same in all
    /// frames; frequencies still by the Doppler formula, for that direction.
    Snapshot {
        /// Positions.
        transform: Transform,
        /// Frequencies.
        doppler: Boost,
    },
}

impl Link {
    /// An event in the other frame.
    pub fn event(&self, e: Event) -> Event {
        match self {
            Self::Finite(transform) | Self::Snapshot { transform, .. } => transform.event(e),
        }
    }

    /// A difference of events in the other frame.
    pub fn vector(&self, v: FourVector) -> FourVector {
        match self {
            Self::Finite(transform) | Self::Snapshot { transform, .. } => transform.vector(v),
        }
    }

    /// Light of unit direction of travel `n` in the other frame.
    #[inline(always)]
    pub fn light(&self, n: DVec3) -> SeenLight {
        match self {
            Self::Finite(transform) => transform.light(n),
            Self::Snapshot { doppler, .. } => SeenLight {
                direction: n,
                ..doppler.light_of_unit(n)
            },
        }
    }

    /// Whether directions and frequencies are the same in both frames.
    pub fn is_translation(&self) -> bool {
        match self {
            Self::Finite(transform) => transform.is_translation(),
            Self::Snapshot { doppler, .. } => doppler.is_identity(),
        }
    }
}

/// Each camera ray direction (unit, away from the camera) in another rest frame, and the ratio of
/// light's frequency there to that in the camera's frame; replaces what `boosted` and `ratios` hold.
///
/// Where both frames move together nothing is computed.
pub fn boost_directions(
    link: &Link,
    directions: &[DVec3],
    boosted: &mut Vec<DVec3>,
    ratios: &mut Vec<f64>,
) {
    boosted.clear();
    ratios.clear();
    if link.is_translation() {
        boosted.extend_from_slice(directions);
        ratios.resize(directions.len(), 1.0);
        return;
    }
    boosted.reserve(directions.len());
    ratios.reserve(directions.len());
    #[cfg(target_arch = "x86_64")]
    if std::arch::is_x86_feature_detected!("fma") && std::arch::is_x86_feature_detected!("avx2") {
        #[expect(
            unsafe_code,
            reason = "the features it needs were detected on the line above"
        )]
        unsafe {
            boost_with_fma(link, directions, boosted, ratios);
        }
        return;
    }
    boost_each(link, directions, boosted, ratios);
}

/// [`boost_each`] compiled for processors with a fused multiply-add instruction, which the cross
/// products are made of: without it each is a call of the C library (six a ray, three times the
/// whole boost). The result is the same to the bit, since both round once.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn boost_with_fma(
    link: &Link,
    directions: &[DVec3],
    boosted: &mut Vec<DVec3>,
    ratios: &mut Vec<f64>,
) {
    boost_each(link, directions, boosted, ratios);
}

#[inline(always)]
fn boost_each(link: &Link, directions: &[DVec3], boosted: &mut Vec<DVec3>, ratios: &mut Vec<f64>) {
    for &direction in directions {
        // Light travels against the ray.
        let light = link.light(-direction);
        boosted.push(-light.direction);
        ratios.push(light.frequency_ratio);
    }
}
