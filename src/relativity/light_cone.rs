//! Retardation: the event at which light left a point at rest to reach a given event.

use super::Event;
use glam::DVec3;

/// Light from a resting point to an event, in the point's rest frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arrival {
    /// When and where the light was emitted.
    pub emission: Event,
    /// Unit direction of travel, from the point to the event.
    pub direction: DVec3,
    /// Length of the light path, in metres.
    pub distance: f64,
}

/// Light that reaches `event` from a point that rests at `position`, both in the point's rest frame.
///
/// It is emitted at t − |x − position|, the one event of the point's worldline on the past light
/// cone (Møller 1972 §2.6). None if the event is at the point itself, where light has no direction.
pub fn light_arriving(event: Event, position: DVec3) -> Option<Arrival> {
    let path = event.x - position;
    let (direction, distance) = direction_and_length(path)?;
    Some(Arrival {
        emission: Event::new(event.t - distance, position),
        direction,
        distance,
    })
}

/// Unit vector and length of a finite vector, to all digits; None for zero. Where squares would
/// underflow or overflow, lengths are taken in multiples of the largest component.
fn direction_and_length(v: DVec3) -> Option<(DVec3, f64)> {
    /// Squares of lengths that neither underflow nor overflow in part.
    const SQUARES: std::ops::Range<f64> = 1e-280..1e280;
    let square = v.length_squared();
    let unit = if SQUARES.contains(&square) {
        1.0
    } else {
        v.abs().max_element()
    };
    let (scaled, length) = (v / unit, (v / unit).length());
    (length > 0.0).then(|| (scaled / length, length * unit))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn direction_and_distance_keep_their_digits_at_any_distance() {
        for far in [1e-320, 1e-300, 1e-160, 1e-9, 1.0, 1e9, 1e160, 1e300] {
            let event = Event::new(0.0, DVec3::new(far, 0.0, far));
            let light = light_arriving(event, DVec3::ZERO).expect("apart");
            let exact = far * 2_f64.sqrt();
            // 1e-320 is some 2000 of the smallest numbers, and has no more digits.
            let digits = if far < 1e-310 { 1e-3 } else { 1e-15 };
            assert!((light.distance / exact - 1.0).abs() < digits, "{far:e}");
            assert!((light.direction.length() - 1.0).abs() < 1e-15, "{far:e}");
            assert!((light.direction.x - 0.5_f64.sqrt()).abs() < 1e-15);
        }
        assert_eq!(
            light_arriving(Event::new(1.0, DVec3::ONE), DVec3::ONE),
            None
        );
    }
}
