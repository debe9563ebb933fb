//! Displacement of surfaces in pixels, as seen through the center of each pixel, and the share of
//! pixels that show another body.
//!
//! A point of a surface is traced back to the image in f64: from the body's rest frame along the
//! past light cone of the exposure to the camera's frame, and there through its projection.

use super::results::Percentiles;
use super::spheres::{Sphere, spheres};
use crate::accel::Hit;
use crate::image::compare::Comparison;
use crate::model::Mesh;
use crate::render::View;
use crate::trace::{Scratch, Seen, ShadeTrees, Tracer};
use glam::DVec3;
use rayon::prelude::*;

/// Differences in the surfaces that two images show.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Displacement {
    /// Distance from the center of each pixel to the place at which the image shows the surface
    /// found there, over the pixels in which both images show the same body. Pixels.
    pub pixels: Percentiles,
    /// Share of all pixels in which the images show different instances, or only one of them shows
    /// any.
    pub mistaken: f64,
}

/// Distances between the pixels and the points that rays of `other` find through them: the error of
/// rays, with the weights in triangles taken as exact.
///
/// In f64 the rest is the rounding of the way back, mostly below 1e-9 pixels. Near the poles of a
/// panorama a pixel is a small part of its row, and a surface is displaced by as many of them. Both
/// views must show the same bodies in the same order from the same camera.
pub fn displacement(reference: &View<'_>, other: &View<'_>, size: [u32; 2]) -> Displacement {
    compare(reference, other, size, |hit| {
        let geometry = &other.tracer().scene.geometry;
        geometry
            .surface_point(hit.instance, hit.triangle, hit.weights)
            .position
    })
}

/// The same for tessellated spheres: distances between the pixels and the points of the exact
/// spheres that lie behind the points found in `other`, as seen from the spheres' centers. Bodies
/// that are not spheres ([`spheres`]) count as exact.
pub fn displacement_of_spheres(
    reference: &View<'_>,
    other: &View<'_>,
    size: [u32; 2],
) -> Displacement {
    let geometry = &other.tracer().scene.geometry;
    let exact: Vec<Exact> = geometry.meshes.iter().map(|mesh| Exact::of(mesh)).collect();
    compare(reference, other, size, |hit| {
        let instance = &geometry.instances[hit.instance as usize];
        let mesh = &geometry.meshes[instance.mesh as usize];
        let point = exact[instance.mesh as usize].point(mesh, hit);
        instance.rest_from_mesh.transform_point3(point)
    })
}

/// The exact spheres that the triangles of one mesh approximate.
struct Exact {
    spheres: Vec<Sphere>,
    /// Number of the sphere of each triangle.
    numbers: Vec<Option<u32>>,
}

impl Exact {
    fn of(mesh: &Mesh) -> Self {
        let spheres = spheres(mesh);
        let mut numbers = vec![None; mesh.triangles.len()];
        for (sphere, number) in spheres.iter().zip(0..) {
            for &triangle in &sphere.triangles {
                numbers[triangle as usize] = Some(number);
            }
        }
        Self { spheres, numbers }
    }

    /// The point of the sphere, or of the triangle if it belongs to none.
    fn point(&self, mesh: &Mesh, hit: &Hit) -> DVec3 {
        let corners = mesh.triangles[hit.triangle as usize].map(|i| mesh.positions[i as usize]);
        let [a, b, c] = hit.weights;
        let found = corners[0] * a + corners[1] * b + corners[2] * c;
        match self.numbers[hit.triangle as usize] {
            Some(number) => {
                let Sphere { center, radius, .. } = self.spheres[number as usize];
                center + (found - center).normalize_or_zero() * radius
            }
            None => found,
        }
    }
}

/// Compares pixel by pixel. `stands` gives the exact place, in the rest frame of its body, for a
/// hit of `other`.
fn compare(
    reference: &View<'_>,
    other: &View<'_>,
    size: [u32; 2],
    stands: impl Fn(&Hit) -> DVec3 + Sync,
) -> Displacement {
    let row = |y: u32| -> Vec<Pixel> {
        let points: Vec<[f64; 2]> = (0..size[0]).map(|x| pixel_center([x, y], size)).collect();
        let (should, found) = (first_hits(reference, &points), first_hits(other, &points));
        let pixels = points.iter().zip(should.iter().zip(found));
        pixels
            .map(|(point, pair)| match pair {
                (None, None) => Pixel::Empty,
                (Some(should), Some(found)) if should.instance == found.instance => {
                    let position = stands(&found);
                    off_by(other, found.instance, position, *point, size)
                        .map_or(Pixel::Mistaken, Pixel::Off)
                }
                _ => Pixel::Mistaken,
            })
            .collect()
    };
    let pixels: Vec<Pixel> = (0..size[1]).into_par_iter().flat_map_iter(row).collect();
    let mistaken = pixels.iter().filter(|p| matches!(p, Pixel::Mistaken));
    let part = mistaken.count() as f64 / pixels.len().max(1) as f64;
    let off = pixels.iter().filter_map(|pixel| match pixel {
        Pixel::Off(off) => Some(*off),
        Pixel::Empty | Pixel::Mistaken => None,
    });
    let Comparison { mean, p99, worst } = Comparison::of(off.collect());
    Displacement {
        pixels: Percentiles { mean, p99, worst },
        mistaken: part,
    }
}

/// What the center of a pixel shows in both images.
enum Pixel {
    /// No body in either.
    Empty,
    /// The same body, displaced by this many pixels.
    Off(f64),
    /// Different bodies.
    Mistaken,
}

/// The center of a pixel, in fractions of the image.
fn pixel_center([x, y]: [u32; 2], [width, height]: [u32; 2]) -> [f64; 2] {
    [
        (f64::from(x) + 0.5) / f64::from(width),
        (f64::from(y) + 0.5) / f64::from(height),
    ]
}

/// The first hits of the rays through image points; None for no hit, and where a projection has no
/// ray.
fn first_hits(view: &View<'_>, points: &[[f64; 2]]) -> Vec<Option<Hit>> {
    let tracer = Tracer {
        shadows: false,
        bounces: 0,
        ..view.tracer()
    };
    let camera = &tracer.scene.camera;
    let aims: Vec<Option<DVec3>> = points.iter().map(|p| camera.looks_along(*p)).collect();
    let directions: Vec<DVec3> = aims.iter().copied().flatten().collect();
    let mut trees = ShadeTrees::default();
    tracer.trace(&directions, &mut Scratch::default(), &mut trees);
    let mut roots = trees.roots.iter();
    let mut first = || match trees.nodes_of(*roots.next()?).first()?.seen {
        Seen::Surface(surface) => Some(surface.hit),
        Seen::Sky(_) => None,
    };
    aims.iter().map(|aim| aim.and_then(|_| first())).collect()
}

/// Distance in pixels from `point` to the place at which the image shows a point in the rest frame
/// of an instance; None if the image does not show it.
fn off_by(
    view: &View<'_>,
    instance: u32,
    position: DVec3,
    point: [f64; 2],
    size: [u32; 2],
) -> Option<f64> {
    let Tracer {
        scene, spacetime, ..
    } = view.tracer();
    let worldline = scene.geometry.instances[instance as usize].worldline as usize;
    let to_camera = spacetime.camera_event(worldline).x - position;
    let light = spacetime
        .link(scene.camera.worldline, worldline)
        .light(to_camera.try_normalize()?);
    let shown = scene.camera.image_point(-light.direction, point)?;
    let [x, y] = [0, 1].map(|i| (shown[i] - point[i]) * f64::from(size[i]));
    let off = x.hypot(y);
    off.is_finite().then_some(off)
}
