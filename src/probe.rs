//! What the centre of one pixel sees: the event, the Doppler factor, the curve, the colour.

use crate::render::{LabPath, View};
use crate::scene::Scene;
use crate::shot::Shot;
use crate::spectrum::color_space::RGB_FROM_XYZ;
use crate::trace::{Node, Root, Scratch, ShadeTrees};
use glam::DVec3;
use serde::Serialize;

/// The answer of `restframe probe`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Probe {
    /// Number of the frame.
    pub frame: u32,
    /// The pixel, from the upper left one, (0, 0).
    pub pixel: [u32; 2],
    /// Where the pixel looks: a unit vector in the camera's rest frame. None outside of a fisheye's
    /// circle, where nothing is seen and all light is 0. Not part of the JSON.
    #[serde(skip)]
    pub direction: Option<[f64; 3]>,
    /// The first surface; None where the background is seen, or nothing.
    pub hit: Option<ProbeHit>,
    /// The sensor's wavelengths, nm, in the camera's rest frame.
    pub wavelengths: Vec<f64>,
    /// Spectral radiance there, W·m⁻²·sr⁻¹·nm⁻¹.
    pub radiance: Vec<f64>,
    /// Of that radiance, cd/m².
    pub xyz: [f64; 3],
    /// Linear sRGB after exposure.
    pub rgb: [f64; 3],
}

/// The first surface on a camera ray.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ProbeHit {
    /// Its model.
    pub model: String,
    /// Its material.
    pub material: String,
    /// The worldline it rides on.
    pub worldline: String,
    /// The emission event, in lab coordinates.
    pub event: ProbeEvent,
    /// Lab length of the light path, metres.
    pub distance: f64,
    /// Unit normal towards the viewer, in the surface's rest frame.
    pub normal: [f64; 3],
    /// D = ω_observed/ω_source.
    pub doppler: f64,
}

/// An event in the lab: metres of light travel, metres.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ProbeEvent {
    /// Time.
    pub t: f64,
    /// Position.
    pub x: [f64; 3],
}

/// Probes the centre of `pixel`, which must lie in the shot's image. `exposure` is in stops.
pub fn probe(
    shot: &Shot,
    frame: u32,
    pixel: [u32; 2],
    view: &View<'_>,
    scene: &Scene,
    exposure: f64,
) -> Probe {
    let point = [0, 1].map(|i| (f64::from(pixel[i]) + 0.5) / f64::from(shot.image.size[i]));
    let direction = scene.camera.looks_along(point);
    let (hit, radiance) = match direction {
        Some(direction) => seen(view, scene, direction),
        None => (None, vec![0.0; view.shader().wavelengths_nm().len()]),
    };
    let xyz = view.shader().xyz_of(&radiance);
    let gain = exposure.exp2() / 100.0;
    let rgb = RGB_FROM_XYZ.map(|row| row.iter().zip(xyz).map(|(m, v)| m * v).sum::<f64>() * gain);
    Probe {
        frame,
        pixel,
        direction: direction.map(|direction| direction.to_array()),
        hit,
        wavelengths: view.shader().wavelengths_nm(),
        radiance,
        xyz,
        rgb,
    }
}

/// The first surface in a direction, and the radiance from there.
fn seen(view: &View<'_>, scene: &Scene, direction: DVec3) -> (Option<ProbeHit>, Vec<f64>) {
    let mut trees = ShadeTrees::default();
    view.tracer()
        .trace(&[direction], &mut Scratch::default(), &mut trees);
    let root = trees.roots[0];
    let hit = match root {
        Root::Sky(_) => None,
        Root::Surface(index) => Some(hit(view, scene, &trees.nodes[index as usize], direction)),
    };
    (hit, view.shader().radiance(&trees, root))
}

fn hit(view: &View<'_>, scene: &Scene, node: &Node, direction: DVec3) -> ProbeHit {
    let instance = &scene.geometry.instances[node.hit.instance as usize];
    let worldline = instance.worldline as usize;
    let point =
        scene
            .geometry
            .surface_point(node.hit.instance, node.hit.triangle, node.hit.weights);
    let arriving = view
        .spacetime()
        .link(worldline, scene.camera.worldline)
        .light(-direction);
    let towards = arriving.direction.dot(point.flat_normal).signum();
    let path = LabPath::new(view, node, direction);
    ProbeHit {
        model: scene.model_names[instance.model as usize].clone(),
        material: scene.materials[instance.material as usize].name.clone(),
        worldline: scene.worldline_names[worldline].clone(),
        event: ProbeEvent {
            t: path.emission.t,
            x: path.emission.x.to_array(),
        },
        distance: path.distance,
        normal: (point.normal * towards).to_array(),
        doppler: node.doppler,
    }
}
