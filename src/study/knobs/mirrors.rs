//! Knobs of tracing: the depth to which light is followed through mirrors and glass, and the triangles of
//! spheres.

use super::Knob;
use crate::frame::ActiveEffects;
use crate::scene::Scene;
use crate::shot::MOST_BOUNCES;
use crate::study::displacement::displacement_of_spheres;
use crate::study::spheres;
use crate::study::start::Start;
use crate::study::timed_render::{Bodies, Variant};
use crate::trace::build_aggregate;
use std::sync::Arc;

const BOUNCES: [u32; 7] = [0, 1, 2, 3, 4, 8, 16];
const CUTOFFS: [f64; 6] = [0.3, 0.1, 0.01, 1e-3, 1e-4, 1e-6];

/// The knob `effects.bounces`.
pub(super) fn bounces(start: &Start<'_>, active: &ActiveEffects) -> Knob {
    let mut knob = Knob::new(
        "effects.bounces",
        "surfaces",
        "how many mirrors and faces of glass light is followed through",
    );
    knob.reference = "64 of them, the same cut-off";
    let variant = |bounces: u32, cutoff: f64| {
        let mut shot = start.shot.clone();
        shot.effects.bounces = bounces;
        for splice in &mut shot.splice {
            splice.effects.bounces = splice.effects.bounces.map(|own| match bounces {
                MOST_BOUNCES => MOST_BOUNCES,
                bounces => own.min(bounces),
            });
        }
        shot.accuracy.cutoff = cutoff;
        Variant {
            family: "bounces".to_owned(),
            current: bounces == start.shot.effects.bounces,
            shot,
            ..start.variant(
                format!("{bounces} bounces"),
                Some(format!("bounces = {bounces}")),
            )
        }
    };
    if no_branches(&mut knob, active) {
        return knob;
    }
    let (own, cutoff) = (start.shot.effects.bounces, start.shot.accuracy.cutoff);
    let mut counts = BOUNCES.to_vec();
    if !counts.contains(&own) {
        counts.push(own);
        counts.sort_unstable();
    }
    knob.variants = counts.into_iter().map(|n| variant(n, cutoff)).collect();
    knob.references = vec![variant(MOST_BOUNCES, cutoff)];
    knob
}

/// The knob `accuracy.cutoff`.
pub(super) fn cutoff(start: &Start<'_>, active: &ActiveEffects) -> Knob {
    let mut knob = Knob::new(
        "accuracy.cutoff",
        "surfaces",
        "the share of mirrored and refracted light that is not followed",
    );
    knob.reference = "the same number of bounces, nothing cut off";
    if no_branches(&mut knob, active) {
        return knob;
    }
    let own = start.shot.accuracy.cutoff;
    let variant = |cutoff: f64| {
        let mut shot = start.shot.clone();
        shot.accuracy.cutoff = cutoff;
        Variant {
            family: "cutoff".to_owned(),
            current: cutoff == own,
            shot,
            ..start.variant(
                format!("cutoff {cutoff:?}"),
                Some(format!("cutoff = {cutoff:?}")),
            )
        }
    };
    let mut shares = CUTOFFS.to_vec();
    if !shares.contains(&own) && own > 0.0 {
        shares.push(own);
        shares.sort_by(|a, b| b.total_cmp(a));
    }
    knob.variants = shares.into_iter().map(variant).collect();
    knob.references = vec![variant(0.0)];
    knob
}

/// Whether the image has neither mirror nor glass; adds a note then.
fn no_branches(knob: &mut Knob, active: &ActiveEffects) -> bool {
    let none = !active.mirror && !active.refraction;
    if none {
        knob.note = Some("the image calls for no mirror and no glass".to_owned());
    }
    none
}

/// Subdivisions of an icosahedron: 80 to 20480 triangles.
const LEVELS: [u32; 5] = [1, 2, 3, 4, 5];
const FINEST_LEVEL: u32 = 7;
/// Largest number of triangles of all spheres together, about 200 MB.
const MOST_TRIANGLES: usize = 2_000_000;

/// The tessellation of the shot's spheres.
pub(super) fn tessellation(start: &Start<'_>) -> Knob {
    let mut knob = Knob::new(
        "tessellation",
        "traverse",
        "triangles of which each sphere among the shot's meshes is made",
    );
    knob.reference = "the finest spheres, of 327680 triangles where there are few";
    knob.displacement = Some(displacement_of_spheres);
    let bodies = |level: u32| {
        let scene = &start.bodies.scene;
        let geometry = Arc::new(spheres::tessellated(&scene.geometry, level)?);
        let aggregate = build_aggregate(&geometry, None);
        let scene = Scene {
            geometry,
            ..scene.clone()
        };
        Some(Arc::new(Bodies { scene, aggregate }))
    };
    let variant = |level: u32| {
        let triangles = 20 * 4_u32.pow(level);
        Some(Variant {
            family: "subdivided icosahedron".to_owned(),
            bodies: bodies(level)?,
            ..start.variant(format!("{triangles} triangles a sphere"), None)
        })
    };
    let meshes = &start.bodies.scene.geometry.meshes;
    let count: usize = meshes.iter().map(|mesh| spheres::spheres(mesh).len()).sum();
    let fits = |level: &u32| count * (20 << (2 * level)) <= MOST_TRIANGLES;
    let finest = (1..=FINEST_LEVEL).rev().find(fits).unwrap_or(1);
    let Some(finest) = variant(finest) else {
        knob.note = Some(
            "no mesh of the shot is a sphere: what is flat is exact with any number of triangles, \
             and of other shapes nobody knows what they stand for"
                .to_owned(),
        );
        return knob;
    };
    knob.references = vec![finest];
    knob.variants = LEVELS
        .into_iter()
        .filter(fits)
        .filter_map(variant)
        .collect();
    knob.variants.push(Variant {
        family: "as in the file".to_owned(),
        ..start.as_it_is()
    });
    knob
}
