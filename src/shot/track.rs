//! A value over the frames of a shot: a constant, a ramp or keys.
//!
//! Frames are numbered from 1. Between keys the value is interpolated; before the first and after the
//! last key it is constant. An interpolated value is never outside the two authored ones, and is
//! exactly their value if they are equal.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A value that may move over the shot's frames: constant, ramp or keys.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, deny_unknown_fields)]
#[schemars(rename = "TrackOf{T}")]
pub enum Track<T> {
    /// The same in every frame.
    Constant(T),
    /// From `from` at frame 1 to `to` at the last frame, in equal steps; `from` if there is one frame.
    Ramp {
        /// Value at frame 1.
        from: T,
        /// Value at the last frame.
        to: T,
    },
    /// `[frame, value]` pairs, frames strictly ascending.
    Keys {
        /// `[frame, value]` pairs, such as `[[1, 0.0], [24, 0.5]]`: frames strictly ascending, from 1 to the shot's last.
        #[schemars(length(min = 1))]
        keys: Vec<(f64, T)>,
        /// How the value moves between keys. Default: "linear".
        #[serde(default)]
        ease: Ease,
    },
}

/// How a value moves between two keys.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Ease {
    /// At constant rate.
    #[default]
    Linear,
    /// With zero rate at each key: 3x² − 2x³.
    Smooth,
    /// Stays at a key's value until the next.
    Hold,
}

impl<T: Default> Default for Track<T> {
    fn default() -> Self {
        Track::Constant(T::default())
    }
}

/// A type that a [`Track`] can interpolate.
pub trait Blend: Copy + PartialEq {
    /// The value a share `t` (0 to 1) of the way from `self` to `other`.
    #[must_use]
    fn blend(self, other: Self, t: f64) -> Self;
}

impl Blend for f64 {
    fn blend(self, other: f64, t: f64) -> f64 {
        // Rounding may leave the range by an ulp.
        (self * (1.0 - t) + other * t)
            .max(self.min(other))
            .min(self.max(other))
    }
}

impl<const N: usize> Blend for [f64; N] {
    fn blend(self, other: Self, t: f64) -> Self {
        std::array::from_fn(|i| self[i].blend(other[i], t))
    }
}

impl<T: Blend> Track<T> {
    /// The value in `frame`, counted from 1, of a shot of `frames` frames.
    pub fn at(&self, frame: u32, frames: u32) -> T {
        self.at_instant(f64::from(frame), frames)
    }

    /// The value at a frame number that may lie between two frames.
    pub(crate) fn at_instant(&self, frame: f64, frames: u32) -> T {
        match self {
            Track::Constant(value) => *value,
            Track::Ramp { from, .. } if frames <= 1 => *from,
            Track::Ramp { from, to } => {
                from.blend(*to, ((frame - 1.0) / f64::from(frames - 1)).clamp(0.0, 1.0))
            }
            Track::Keys { keys, ease } => between_keys(keys, *ease, frame),
        }
    }

    /// All values that the author wrote, also those that no frame reaches.
    pub fn values(&self) -> impl Iterator<Item = T> + '_ {
        self.authored().into_iter().map(|(_, value)| value)
    }

    /// Whether the value is the same in every frame.
    pub fn is_constant(&self) -> bool {
        let mut values = self.values();
        let first = values.next();
        values.all(|value| Some(value) == first)
    }

    /// Every authored value with the end of its key path, such as `.keys[2][1]`.
    pub(crate) fn authored(&self) -> Vec<(String, T)> {
        match self {
            Track::Constant(value) => vec![(String::new(), *value)],
            Track::Ramp { from, to } => vec![(".from".into(), *from), (".to".into(), *to)],
            Track::Keys { keys, .. } => keys
                .iter()
                .enumerate()
                .map(|(i, (_, value))| (format!(".keys[{i}][1]"), *value))
                .collect(),
        }
    }

    /// The frame numbers for which the author gave a value.
    pub(crate) fn authored_frames(&self, frames: u32) -> Vec<f64> {
        match self {
            Track::Constant(_) => vec![1.0],
            Track::Ramp { .. } => vec![1.0, f64::from(frames)],
            Track::Keys { keys, .. } => keys.iter().map(|(frame, _)| *frame).collect(),
        }
    }
}

/// The value at `frame` of ascending keys, of which there is at least one (`load` checks both).
fn between_keys<T: Blend>(keys: &[(f64, T)], ease: Ease, frame: f64) -> T {
    let next = keys.partition_point(|(at, _)| *at <= frame);
    if next == 0 {
        return keys[0].1;
    }
    let (start, value) = keys[next - 1];
    let Some((end, target)) = keys.get(next) else {
        return value;
    };
    let x = (frame - start) / (end - start);
    match ease {
        Ease::Linear => value.blend(*target, x),
        Ease::Smooth => value.blend(*target, x * x * (3.0 - 2.0 * x)),
        Ease::Hold => value,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn keys(ease: Ease) -> Track<f64> {
        Track::Keys {
            keys: vec![(2.0, 10.0), (4.0, 20.0), (8.0, 0.0)],
            ease,
        }
    }

    #[test]
    fn ramp_reaches_both_ends_exactly() {
        let ramp = Track::Ramp { from: 0.1, to: 0.7 };
        assert_eq!((ramp.at(1, 49), ramp.at(49, 49)), (0.1, 0.7));
        assert!((ramp.at(25, 49) - 0.4).abs() < 1e-15);
    }

    #[test]
    fn ramp_of_one_frame_gives_from() {
        assert_eq!(Track::Ramp { from: 3.0, to: 9.0 }.at(1, 1), 3.0);
    }

    #[test]
    fn keys_hold_before_the_first_and_after_the_last() {
        let track = keys(Ease::Linear);
        assert_eq!((track.at(1, 20), track.at(20, 20)), (10.0, 0.0));
    }

    #[test]
    fn linear_keys_move_at_constant_rate() {
        let track = keys(Ease::Linear);
        assert_eq!(
            [3, 4, 5, 6].map(|frame| track.at(frame, 20)),
            [15.0, 20.0, 15.0, 10.0]
        );
    }

    #[test]
    fn smooth_keys_rest_at_each_key_and_halve_in_the_middle() {
        let track = keys(Ease::Smooth);
        assert_eq!((track.at(4, 20), track.at(6, 20)), (20.0, 10.0));
        assert!((track.at(5, 20) - 20.0 * (1.0 - 0.15625)).abs() < 1e-12);
    }

    #[test]
    fn hold_keys_keep_the_last_key_until_the_next() {
        let track = keys(Ease::Hold);
        assert_eq!(
            [3, 4, 7, 8].map(|frame| track.at(frame, 20)),
            [10.0, 20.0, 20.0, 0.0]
        );
    }

    #[test]
    fn vectors_move_component_by_component() {
        let ramp = Track::Ramp {
            from: [0.0, 4.0, -2.0],
            to: [1.0, 4.0, 2.0],
        };
        assert_eq!(ramp.at(2, 3), [0.5, 4.0, 0.0]);
    }

    #[test]
    fn a_ramp_between_equal_values_is_that_value_in_every_frame() {
        let ramp = Track::Ramp { from: 0.1, to: 0.1 };
        assert!(ramp.is_constant());
        assert!((1..=49).all(|frame| ramp.at(frame, 49) == 0.1));
    }

    #[test]
    fn values_lists_what_the_author_wrote() {
        assert_eq!(
            keys(Ease::Hold).values().collect::<Vec<_>>(),
            [10.0, 20.0, 0.0]
        );
        assert!(!keys(Ease::Hold).is_constant());
        assert!(Track::Constant(1.0).is_constant());
    }
}
