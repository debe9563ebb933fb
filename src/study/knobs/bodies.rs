//! Knob: triangles of spheres.

use super::Knob;
use crate::scene::Scene;
use crate::study::displacement::displacement_of_spheres;
use crate::study::spheres;
use crate::study::start::Start;
use crate::study::timed_render::{Bodies, Variant};
use crate::trace::build_aggregate;
use std::sync::Arc;

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
