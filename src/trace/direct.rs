//! Direct light on a surface: lamps on the past light cone of the surface event, in the surface's
//! rest frame.

use super::clock::timed_shadow;
use super::stage::RestRay;
use super::surface::Place;
use super::{DirectLight, ShadeTrees, Tracer};
use crate::relativity::{Event, light_arriving};
use crate::scene::{Light, LightShape, Lobe, Material};
use glam::DVec3;

/// Nearest distance of a lamp that is told apart, m: the Planck length. Irradiance, I cos θ/r²,
/// grows without bound towards a point of light, and beyond all numbers below 1e-154 m; nearer than
/// this it grows no more. A picture cannot hold it long before: that is counted when it is developed.
const NEAREST: f64 = 1.6e-35;

/// Light that arrives at a surface event.
struct Incoming {
    /// Unit direction of travel in the lamp's rest frame and in the surface's.
    in_lamp: DVec3,
    in_surface: DVec3,
    /// D from lamp to surface.
    doppler: f64,
    /// Length of the light path in the lamp's rest frame; infinite for a sun.
    distance: f64,
    /// share / r², r at least [`NEAREST`]; or share for a sun.
    falloff: f64,
}

/// Adds the lamps that light a surface of the given material.
pub(super) fn add_lamps(
    tracer: &Tracer<'_>,
    surface: &Place,
    material: &Material,
    trees: &mut ShadeTrees,
) {
    let lobes = material.bsdf.non_specular();
    for (index, light) in tracer.scene.lights.iter().enumerate() {
        let Some((irradiance, incoming)) = light_on(tracer, surface, light) else {
            continue;
        };
        trees.direct.push(DirectLight {
            light: index as u32,
            first_weight: trees.weights.len() as u32,
            doppler: incoming.doppler,
        });
        let (normal, to_lamp) = (surface.point.normal, -incoming.in_surface);
        let weight = |lobe: &Lobe| lobe.reflected(irradiance, normal, to_lamp, surface.view());
        trees.weights.extend(lobes.iter().map(weight));
    }
}

/// share · cos θ / r² of a lamp, m⁻², and its light, where it lights the surface.
fn light_on(tracer: &Tracer<'_>, surface: &Place, light: &Light) -> Option<(f64, Incoming)> {
    let incoming = incoming(tracer, surface, light)?;
    let cos = surface.point.normal.dot(-incoming.in_surface);
    if cos <= 0.0 || incoming.falloff <= 0.0 {
        return None;
    }
    let shaded = || in_shadow(tracer, surface, light, &incoming);
    if tracer.shadows && timed_shadow(tracer.clock, shaded) {
        return None;
    }
    Some((incoming.falloff * cos, incoming))
}

/// The lamp's light at the surface event, or None where the lamp is at that very event: there its
/// light has no direction and the lamp is on neither side of the surface, so it lights nothing.
fn incoming(tracer: &Tracer<'_>, surface: &Place, light: &Light) -> Option<Incoming> {
    let spacetime = tracer.spacetime;
    let (in_lamp, distance, spread) = match light.shape {
        LightShape::Point { position } | LightShape::Spot { position, .. } => {
            let event = spacetime
                .link(light.worldline, surface.worldline)
                .event(surface.event);
            let arrival = light_arriving(event, position)?;
            (
                arrival.direction,
                arrival.distance,
                arrival.distance.max(NEAREST).powi(2),
            )
        }
        LightShape::Sun { direction } => (direction, f64::INFINITY, 1.0),
    };
    let seen = spacetime
        .link(surface.worldline, light.worldline)
        .light(in_lamp);
    Some(Incoming {
        in_lamp,
        in_surface: seen.direction,
        doppler: spacetime.received_ratio(light.worldline, surface.worldline, &seen),
        distance,
        falloff: light.shape.share(in_lamp) / spread,
    })
}

/// Whether a body of any worldline stands on the light path between surface and lamp. The path is
/// one null line: in each rest frame it starts at the surface event, and its length there is that
/// in the lamp's frame times the ratio of frequencies.
fn in_shadow(tracer: &Tracer<'_>, surface: &Place, light: &Light, incoming: &Incoming) -> bool {
    let spacetime = tracer.spacetime;
    // From the smooth surface, or facets of a round body would shade each other where lamps rise.
    let off_surface = surface.point.bulge + surface.point.flat_normal * surface.point.clearance;
    let start = Event::new(surface.event.t, surface.event.x + off_surface);
    // So much nearer to the lamp: what stands beyond it casts no shadow.
    let nearer = off_surface.dot(-incoming.in_surface) / spacetime.path_ratio(incoming.doppler);
    let distance = (incoming.distance - nearer).max(0.0);
    tracer.stage.worldlines().any(|worldline| {
        let (origin, seen) = if worldline == surface.worldline {
            let own = crate::relativity::SeenLight {
                direction: incoming.in_surface,
                frequency_ratio: incoming.doppler,
            };
            (start.x, own)
        } else {
            let there = spacetime.link(worldline, surface.worldline).event(start);
            let seen = spacetime
                .link(worldline, light.worldline)
                .light(incoming.in_lamp);
            (there.x, seen)
        };
        let ray = RestRay {
            origin,
            direction: -seen.direction,
        };
        let reach = distance * spacetime.path_ratio(seen.frequency_ratio);
        tracer.stage.blocks(worldline, &ray, reach)
    })
}
