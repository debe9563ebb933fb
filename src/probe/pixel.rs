//! What the center of one pixel sees: event, Doppler factor, spectrum, color.

use crate::film::{Channels, SILENT};
use crate::frame::Frame;
use crate::relativity::Event;
use crate::render::{self, Enough, LabPath, View, development};
use crate::scene::{Lobe, Scene};
use crate::shade::{Radiance, ShadeScratch};
use crate::shot::Spectra;
use crate::trace::{Branch, Node, Scratch, Seen, ShadeTrees, Surface};
use glam::DVec3;
use serde::Serialize;

/// Result of `restframe probe`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Probe {
    /// Frame number.
    pub frame: u32,
    /// Column and row of the pixel; (0, 0) is the upper left.
    pub pixel: [u32; 2],
    /// Direction of view, a unit vector in the camera's rest frame. None outside of a fisheye's
    /// circle, where nothing is seen and all light is 0. Not part of the JSON.
    #[serde(skip)]
    pub direction: Option<[f64; 3]>,
    /// The first surface; None if the background or nothing is seen.
    pub hit: Option<ProbeHit>,
    /// The sensor's wavelengths, nm, in the camera's rest frame.
    pub wavelengths: Vec<f64>,
    /// Spectral radiance at these wavelengths, W·m⁻²·sr⁻¹·nm⁻¹.
    pub radiance: Vec<f64>,
    /// CIE 1931 XYZ, cd/m², as in the image: 0 if the window excludes the visible.
    pub xyz: [f64; 3],
    /// Linear sRGB after exposure; with `sensor.color = "bands"`, the three bands after exposure.
    pub rgb: [f64; 3],
    /// All nodes of the shade tree: the first surface, and those seen in mirrors and through glass,
    /// each after the one in which it is seen.
    pub chain: Vec<ProbeNode>,
    /// Share of mirrored and refracted light that was not followed; the error is at most this times
    /// the light arriving there.
    pub cut: f64,
    /// `effects.bounces` with which less than 0.5 % would be cut; None if that is so already, and
    /// if the light is too faint for any number.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub enough_bounces: Option<u32>,
    /// The part of `radiance` that surfaces reflect or emit without heat, and the background.
    pub surface: Vec<f64>,
    /// The thermal part of `radiance`.
    pub thermal: Vec<f64>,
}

/// A node of the pixel's shade tree.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ProbeNode {
    /// Index in the chain of the node in which it is seen; None if the camera sees it directly.
    pub parent: Option<u32>,
    /// The lobe of that node that passes the light on: "mirror" or "refraction".
    pub by: Option<&'static str>,
    /// Share of its light that is passed on: Fresnel's times the lobe's weight, 1 if seen directly.
    pub coefficient: f64,
    /// D from here to its parent, or to the camera.
    pub doppler: f64,
    /// The surface, with the `distance` to its parent and the `doppler` to the camera; None for the
    /// background.
    pub hit: Option<ProbeHit>,
}

/// A surface that sends light to the camera.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ProbeHit {
    /// Its model.
    pub model: String,
    /// Its material.
    pub material: String,
    /// Its worldline.
    pub worldline: String,
    /// The emission event, in lab coordinates.
    pub event: ProbeEvent,
    /// Lab length of the light path, meters.
    pub distance: f64,
    /// Unit normal toward the viewer, in the surface's rest frame.
    pub normal: [f64; 3],
    /// D = ω_observed/ω_source.
    pub doppler: f64,
}

/// An event in the lab; times in meters of light travel, positions in meters.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ProbeEvent {
    /// Time.
    pub t: f64,
    /// Position.
    pub x: [f64; 3],
}

/// Probes the center of `pixel`, which must lie in the frame's image. `exposure` is in stops.
///
/// # Example
/// ```
/// use restframe::{frame::Frame, probe, render::View, scene::{Library, Scene}, shot};
/// use restframe::trace::build_aggregate;
/// use std::path::Path;
///
/// let text = r#"
/// worldline.coming.velocity = [0, 0, 0.6]
/// model = [{ file = "assets/sphere.obj", worldline = "coming" }]
/// camera.position = [0, 0, 5]
/// "#;
/// let shot = shot::parse(text, Path::new("coming.toml"))?;
/// let frame = Frame::new(&shot, 1)?;
/// let scene = Scene::resolve(&frame, &Library::load(&shot)?, None)?;
/// let bodies = build_aggregate(&scene.geometry, None);
/// let view = View::new(&frame, &frame.effects, &scene, &bodies);
/// let [width, height] = shot.image.size;
/// let seen = probe::probe(&frame, [width / 2, height / 2], &view, &scene, 0.0);
/// let doppler = seen.hit.map(|hit| hit.doppler);
/// assert!(doppler.is_some_and(|d| (d - 2.0).abs() < 1e-4)); // √((1 + β)/(1 − β))
/// # Ok::<(), shot::Mistakes>(())
/// ```
pub fn probe(
    frame: &Frame<'_>,
    pixel: [u32; 2],
    view: &View<'_>,
    scene: &Scene,
    exposure: f64,
) -> Probe {
    let shader = view.shader();
    let mut light = Radiance::new(shader.wavelengths_nm().len());
    let (mut chain, mut cut, mut direction) = (Vec::new(), 0.0, None);
    let mut enough = None;
    let (mut channels, mut xyz) = ([0.0; 3], [0.0; 3]);
    if let Some((trees, towards)) = look(frame, pixel, view, scene) {
        let root = trees.roots[0];
        chain = self::chain(view, scene, trees.nodes_of(root), towards);
        cut = root.cut;
        enough = enough_bounces(view, cut, towards);
        light = if matches!(frame.accuracy.spectra, Spectra::Grid | Spectra::Rgb) {
            // The grid's own curves are made for sums, with bends smoothed. RGB has no curves.
            view.curves(frame).radiance(&trees, root)
        } else {
            shader.radiance(&trees, root)
        };
        // As in the image, in whichever way spectra are represented.
        let mut scratch = ShadeScratch::default();
        channels = shader.xyz(&trees, root, &mut scratch);
        xyz = match render::channels(frame.sensor.color) {
            Channels::Xyz => channels,
            Channels::Bands => view.eye(frame).xyz(&trees, root, &mut scratch),
        };
        direction = Some(towards);
    }
    let radiance = light.total();
    let gain = (exposure.exp2() / 100.0).min(f64::MAX);
    let rgb = development(frame.sensor.color, exposure)
        .rgb_from_xyz
        .map(|row| {
            // Clamped to a fraction of f64's range, so that their sum is finite.
            const MOST: f64 = f64::MAX / 4.0;
            let terms = row.iter().zip(channels);
            let terms = terms.map(|(m, v)| (m * (v * gain)).clamp(-MOST, MOST));
            terms.sum::<f64>()
        });
    Probe {
        frame: frame.number,
        pixel,
        direction: direction.map(|direction| direction.to_array()),
        hit: chain.first().and_then(|node| node.hit.clone()),
        chain,
        cut,
        enough_bounces: enough,
        wavelengths: view.shader().wavelengths_nm(),
        radiance,
        surface: light.surface,
        thermal: light.thermal,
        xyz,
        rgb,
    }
}

/// The shade tree of the ray through the center of `pixel`, and its direction in the camera's rest
/// frame; None if the projection has no such ray.
pub(super) fn look(
    frame: &Frame<'_>,
    pixel: [u32; 2],
    view: &View<'_>,
    scene: &Scene,
) -> Option<(ShadeTrees, DVec3)> {
    let point = [0, 1].map(|i| (f64::from(pixel[i]) + 0.5) / f64::from(frame.image.size[i]));
    let direction = scene.camera.looks_along(point)?;
    let mut trees = ShadeTrees::default();
    view.tracer()
        .trace(&[direction], &mut Scratch::default(), &mut trees);
    Some((trees, direction))
}

/// The least number of bounces that would miss little of a ray, if much is cut.
fn enough_bounces(view: &View<'_>, cut: f64, direction: DVec3) -> Option<u32> {
    let will_do = |bounces: u32| {
        let mut trees = ShadeTrees::default();
        render::deeper(view, bounces).trace(&[direction], &mut Scratch::default(), &mut trees);
        trees.roots[0].cut <= SILENT
    };
    if cut <= SILENT || !view.branches() {
        return None;
    }
    match render::least(view.tracer().bounces, will_do) {
        Enough::Bounces(bounces) => Some(bounces),
        Enough::None => None,
    }
}

fn chain(view: &View<'_>, scene: &Scene, nodes: &[Node], direction: DVec3) -> Vec<ProbeNode> {
    let mut chain: Vec<ProbeNode> = Vec::new();
    for node in nodes {
        let before = node
            .branch
            .map(|branch| chain[branch.parent as usize].clone());
        let hit = match (&node.seen, &before) {
            (Seen::Sky(_), _) => None,
            (Seen::Surface(surface), None) => {
                Some(first_hit(view, scene, surface, node.doppler, direction))
            }
            (Seen::Surface(surface), Some(before)) => {
                let to = before.hit.as_ref().map(|hit| &hit.event);
                Some(further_hit(view, scene, surface, node.doppler, to))
            }
        };
        chain.push(match node.branch {
            None => ProbeNode {
                parent: None,
                by: None,
                coefficient: 1.0,
                doppler: node.doppler,
                hit,
            },
            Some(branch) => ProbeNode {
                parent: Some(branch.parent),
                by: lobe(scene, nodes, &branch).map(|lobe| lobe.kind.key()),
                coefficient: branch.share
                    * lobe(scene, nodes, &branch).map_or(0.0, |lobe| lobe.reflectance.weight),
                doppler: branch.doppler,
                hit,
            },
        });
    }
    chain
}

/// The lobe by which a branch leaves.
fn lobe<'a>(scene: &'a Scene, nodes: &[Node], branch: &Branch) -> Option<&'a Lobe> {
    let Seen::Surface(surface) = nodes[branch.parent as usize].seen else {
        return None;
    };
    let material = &scene.materials[surface.material as usize];
    material.bsdf.lobes().get(branch.lobe as usize)
}

fn first_hit(
    view: &View<'_>,
    scene: &Scene,
    surface: &Surface,
    doppler: f64,
    direction: DVec3,
) -> ProbeHit {
    let path = LabPath::new(view, surface, direction);
    hit(scene, surface, doppler, path.emission, path.distance)
}

/// A surface that is seen in another one, at the event `to`.
fn further_hit(
    view: &View<'_>,
    scene: &Scene,
    surface: &Surface,
    doppler: f64,
    to: Option<&ProbeEvent>,
) -> ProbeHit {
    const LAB: usize = 0;
    let own = &surface.hit;
    let instance = &scene.geometry.instances[own.instance as usize];
    let point = scene
        .geometry
        .surface_point(own.instance, own.triangle, own.weights);
    let event = view
        .spacetime()
        .link(LAB, instance.worldline as usize)
        .event(Event::new(surface.time, point.position));
    let distance = to.map_or(0.0, |to| (DVec3::from(to.x) - event.x).length());
    hit(scene, surface, doppler, event, distance)
}

fn hit(scene: &Scene, surface: &Surface, doppler: f64, event: Event, distance: f64) -> ProbeHit {
    let own = &surface.hit;
    let instance = &scene.geometry.instances[own.instance as usize];
    let point = scene
        .geometry
        .surface_point(own.instance, own.triangle, own.weights);
    let towards = if own.front { 1.0 } else { -1.0 };
    ProbeHit {
        model: scene.model_names[instance.model as usize].clone(),
        material: scene.materials[instance.material as usize].name.clone(),
        worldline: scene.worldline_names[instance.worldline as usize].clone(),
        event: ProbeEvent {
            t: event.t,
            x: event.x.to_array(),
        },
        distance,
        normal: (point.normal * towards).to_array(),
        doppler,
    }
}
