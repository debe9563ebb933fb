//! Where the past light cone of an event meets a body at rest.

use super::Event;
use glam::DVec3;

/// Light from a resting point to an event, in the point's rest frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arrival {
    /// When and where it was emitted.
    pub emission: Event,
    /// Unit direction of travel, from the point to the event.
    pub direction: DVec3,
    /// Length of the light path, in metres.
    pub distance: f64,
}

/// The light that reaches `event` from a point that always rests at `position`, both in the
/// point's rest frame: emitted at t − |x − position|, the only event of the point's worldline on
/// the past cone. None where the point is at the event itself.
pub fn light_arriving(event: Event, position: DVec3) -> Option<Arrival> {
    let path = event.x - position;
    let (direction, distance) = direction_and_length(path)?;
    Some(Arrival {
        emission: Event::new(event.t - distance, position),
        direction,
        distance,
    })
}

/// Unit vector and length, to all digits of any vector that is finite and not zero: where squares
/// would leave the numbers, in multiples of its largest component.
fn direction_and_length(v: DVec3) -> Option<(DVec3, f64)> {
    /// Squares of lengths that keep their digits.
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
