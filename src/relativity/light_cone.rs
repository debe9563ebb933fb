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
    let distance = path.length();
    (distance > 0.0).then(|| Arrival {
        emission: Event::new(event.t - distance, position),
        direction: path / distance,
        distance,
    })
}
