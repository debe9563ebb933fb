//! Recognition of spheres among the triangles of meshes, and the same bodies with other
//! tessellations.
//!
//! A sphere is a connected, closed part of a mesh whose vertices lie on one, with triangles so
//! small and so similar that no other body can be meant: cubes, cylinders and domes also have their
//! vertices on a sphere.

use crate::model::Mesh;
use crate::scene::Geometry;
use glam::{DMat4, DVec3, DVec4, Vec3};
use indexmap::IndexMap;
use std::collections::{HashMap, HashSet};
use std::f64::consts::PI;
use std::sync::Arc;

/// Largest distance of vertices from the sphere, in radii: files hold f32, or six decimals.
const TOLERANCE: f64 = 1e-5;
/// Smallest number of vertices, that of an icosahedron.
const FEWEST: usize = 12;
/// Smallest distance of the plane of a triangle from the center, in radii. In a cylinder of two
/// rings a side or a lid is at √½ or nearer; in an icosahedron all are at 0.795.
const NEAREST_PLANE: f64 = 0.72;
/// Largest ratio of the widest circle about a triangle to the median one: √2 in spheres of rows and
/// columns, but much more in one that is cut off flat.
const WIDEST: f64 = 2.5;
/// Smallest volume, as a share of the ball's; an icosahedron has 0.605.
const LEAST_VOLUME: f64 = 0.5;

/// A part of a mesh that represents a sphere, in mesh coordinates.
#[derive(Debug, Clone, PartialEq)]
pub struct Sphere {
    /// Center, meters.
    pub center: DVec3,
    /// Radius, meters.
    pub radius: f64,
    /// Its triangles, ascending.
    pub triangles: Vec<u32>,
    /// Whether the front of its triangles is inside.
    pub inward: bool,
}

/// The spheres of a mesh, in the order of their first triangles.
pub fn spheres(mesh: &Mesh) -> Vec<Sphere> {
    let corners = welded(mesh);
    components(&corners, mesh.positions.len())
        .into_iter()
        .filter_map(|part| sphere(mesh, &corners, part))
        .collect()
}

/// The bodies with each sphere replaced by an icosahedron whose triangles are divided in four
/// `level` times: 20·4^level triangles with vertices on the sphere and normals of the sphere.
///
/// The surface is off by about 0.2·4^−level of the radius. Time grows slowly with the level, memory
/// like the number of triangles (about 130 bytes each in f64); levels above 8 are of little use.
/// None if no mesh contains a sphere. Instances keep their numbers and materials; triangles that
/// belong to no sphere keep their look but not their numbers.
pub fn tessellated(geometry: &Geometry, level: u32) -> Option<Geometry> {
    let found: Vec<Vec<Sphere>> = geometry.meshes.iter().map(|mesh| spheres(mesh)).collect();
    if found.iter().all(Vec::is_empty) {
        return None;
    }
    let unit = Icosphere::new(level);
    let meshes = geometry.meshes.iter().zip(&found);
    let mut tessellated = geometry.clone();
    tessellated.meshes = meshes
        .map(|(mesh, spheres)| match spheres.as_slice() {
            [] => Arc::clone(mesh),
            spheres => Arc::new(replaced(mesh, spheres, &unit)),
        })
        .collect();
    Some(tessellated)
}

/// The triangles, with the first of all vertices at one place: files repeat vertices where normals
/// or textures differ.
fn welded(mesh: &Mesh) -> Vec<[u32; 3]> {
    let mut first = HashMap::new();
    let places: Vec<u32> = mesh
        .positions
        .iter()
        .zip(0..)
        // Zeros of either sign are the same place.
        .map(|(p, i)| {
            *first
                .entry((*p + DVec3::ZERO).to_array().map(f64::to_bits))
                .or_insert(i)
        })
        .collect();
    mesh.triangles
        .iter()
        .map(|corners| corners.map(|i| places[i as usize]))
        .collect()
}

/// Connected components of the triangles, in the order of their first triangle.
fn components(triangles: &[[u32; 3]], vertices: usize) -> Vec<Vec<u32>> {
    let mut parents: Vec<u32> = (0..vertices as u32).collect();
    let root = |parents: &mut Vec<u32>, mut i: u32| {
        while parents[i as usize] != i {
            let above = parents[parents[i as usize] as usize];
            parents[i as usize] = above;
            i = above;
        }
        i
    };
    for [a, b, c] in triangles {
        let to = root(&mut parents, *a);
        for other in [b, c] {
            let from = root(&mut parents, *other);
            parents[from as usize] = to;
        }
    }
    let mut parts: IndexMap<u32, Vec<u32>> = IndexMap::new();
    for (triangle, number) in triangles.iter().zip(0..) {
        let part = root(&mut parents, triangle[0]);
        parts.entry(part).or_default().push(number);
    }
    parts.into_values().collect()
}

/// The sphere that a part of the mesh represents, if it does.
fn sphere(mesh: &Mesh, welded: &[[u32; 3]], triangles: Vec<u32>) -> Option<Sphere> {
    let corners: Vec<[u32; 3]> = triangles.iter().map(|&i| welded[i as usize]).collect();
    let mut vertices: Vec<u32> = corners.iter().flatten().copied().collect();
    vertices.sort_unstable();
    vertices.dedup();
    if vertices.len() < FEWEST || !is_closed(&corners) {
        return None;
    }
    let place = |i: u32| mesh.positions[i as usize];
    let points: Vec<DVec3> = vertices.iter().map(|&i| place(i)).collect();
    let (center, radius) = fitted(&points)?;
    let on = |p: &DVec3| ((*p - center).length() - radius).abs() <= TOLERANCE * radius;
    if !points.iter().all(on) {
        return None;
    }
    let facets = corners
        .iter()
        .map(|c| c.map(|i| (place(i) - center) / radius));
    let volume = unit_sphere_volume(facets)?;
    Some(Sphere {
        center,
        radius,
        triangles,
        inward: volume < 0.0,
    })
}

/// Whether each edge occurs once in either direction.
fn is_closed(triangles: &[[u32; 3]]) -> bool {
    let edges = |&[a, b, c]: &[u32; 3]| [(a, b), (b, c), (c, a)];
    let passed: HashSet<(u32, u32)> = triangles.iter().flat_map(edges).collect();
    passed.len() == 3 * triangles.len() && passed.iter().all(|&(a, b)| passed.contains(&(b, a)))
}

/// Center and radius of the sphere that fits the points best. The algebraic fit: |p|² = 2c·p + k is
/// linear in the center c and in k = r² − |c|², and is solved by least squares. None if the points
/// lie in a plane.
fn fitted(points: &[DVec3]) -> Option<(DVec3, f64)> {
    let count = points.len() as f64;
    let middle = points.iter().sum::<DVec3>() / count;
    let size = points
        .iter()
        .map(|p| (*p - middle).length())
        .fold(0.0, f64::max);
    let (mut normal, mut right) = (DMat4::ZERO, DVec4::ZERO);
    for point in points {
        let p = (*point - middle) / size;
        let row = (2.0 * p).extend(1.0);
        normal += DMat4::from_cols(row * row.x, row * row.y, row * row.z, row * row.w);
        right += row * p.length_squared();
    }
    // Divided by the count the sums are of order 1, so that the determinant indicates a plane.
    if (normal * (1.0 / count)).determinant().abs() < 1e-9 {
        return None;
    }
    let solved = normal.inverse() * right;
    let center = solved.truncate();
    let radius = (solved.w + center.length_squared()).sqrt();
    (center.is_finite() && radius.is_finite()).then_some((middle + center * size, radius * size))
}

/// The signed volume within triangles whose vertices lie on the unit sphere, if they cover it once
/// and evenly; negative if their fronts are inside.
fn unit_sphere_volume(facets: impl Iterator<Item = [DVec3; 3]>) -> Option<f64> {
    let mut volume = 0.0;
    let mut circles = Vec::new();
    for [a, b, c] in facets {
        let normal = (b - a).cross(c - a);
        let plane = a.dot(normal.normalize_or_zero()).abs();
        if plane < NEAREST_PLANE {
            return None;
        }
        volume += a.dot(normal) / 6.0;
        circles.push((1.0 - plane * plane).max(0.0).sqrt());
    }
    circles.sort_unstable_by(f64::total_cmp);
    let even = circles.last()? <= &(WIDEST * circles[circles.len() / 2]);
    let part = volume.abs() / (4.0 / 3.0 * PI);
    (even && (LEAST_VOLUME..1.0 + 3.0 * TOLERANCE).contains(&part)).then_some(volume)
}

/// A mesh with icospheres in place of its spheres.
fn replaced(mesh: &Mesh, spheres: &[Sphere], unit: &Icosphere) -> Mesh {
    let mut made = rest_of(mesh, spheres);
    let mut normals = made.normals.take().unwrap_or_default();
    for sphere in spheres {
        let first = made.positions.len() as u32;
        let front = if sphere.inward { -1.0 } else { 1.0 };
        let on_sphere = |p: &DVec3| sphere.center + *p * sphere.radius;
        made.positions.extend(unit.positions.iter().map(on_sphere));
        normals.extend(unit.positions.iter().map(|p| (*p * front).as_vec3()));
        made.triangles
            .extend(unit.triangles.iter().map(|&[a, b, c]| {
                let wound = if sphere.inward { [a, c, b] } else { [a, b, c] };
                wound.map(|i| first + i)
            }));
    }
    made.normals = Some(normals);
    made
}

/// The part of a mesh that is no sphere, with normals: a triangle without them gets its own.
fn rest_of(mesh: &Mesh, spheres: &[Sphere]) -> Mesh {
    let gone: HashSet<u32> = spheres.iter().flat_map(|s| &s.triangles).copied().collect();
    let mut rest = Mesh {
        positions: Vec::new(),
        normals: None,
        triangles: Vec::new(),
        material: mesh.material,
    };
    let mut normals: Vec<Vec3> = Vec::new();
    let mut numbers: HashMap<u32, u32> = HashMap::new();
    for (corners, _) in mesh
        .triangles
        .iter()
        .zip(0..)
        .filter(|(_, number)| !gone.contains(number))
    {
        let [a, b, c] = corners.map(|i| mesh.positions[i as usize]);
        let flat = (b - a).cross(c - a).normalize_or(DVec3::Y).as_vec3();
        let mut added = |i: u32| {
            rest.positions.push(mesh.positions[i as usize]);
            normals.push(mesh.normals.as_ref().map_or(flat, |n| n[i as usize]));
            rest.positions.len() as u32 - 1
        };
        rest.triangles.push(corners.map(|i| match mesh.normals {
            Some(_) => *numbers.entry(i).or_insert_with(|| added(i)),
            None => added(i),
        }));
    }
    rest.normals = Some(normals);
    rest
}

/// A tessellation of the unit sphere about the origin, with fronts outside.
struct Icosphere {
    positions: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
}

impl Icosphere {
    /// An icosahedron whose triangles are divided in four `level` times, new vertices on the sphere.
    fn new(level: u32) -> Self {
        let mut made = Self::icosahedron();
        (0..level).for_each(|_| made.divide());
        made
    }

    /// The icosahedron: poles, and two rings of five between them at the latitudes ±atan ½.
    fn icosahedron() -> Self {
        let (low, high) = (0.2_f64.sqrt(), 0.8_f64.sqrt());
        let ring = |up: f64, turn: f64| {
            (0..5).map(move |i| {
                let (sin, cos) = ((f64::from(i) + turn) * PI / 2.5).sin_cos();
                DVec3::new(high * sin, up * low, high * cos)
            })
        };
        let positions = [DVec3::Y, DVec3::NEG_Y]
            .into_iter()
            .chain(ring(1.0, 0.0))
            .chain(ring(-1.0, 0.5))
            .collect();
        let triangles = (0..5)
            .flat_map(|i| {
                let next = (i + 1) % 5;
                let (upper, upper_next) = (2 + i, 2 + next);
                let (lower, lower_next) = (7 + i, 7 + next);
                [
                    [0, upper, upper_next],
                    [upper, lower, upper_next],
                    [upper_next, lower, lower_next],
                    [1, lower_next, lower],
                ]
            })
            .collect();
        Self {
            positions,
            triangles,
        }
    }

    fn divide(&mut self) {
        let mut middles: HashMap<(u32, u32), u32> = HashMap::new();
        let positions = &mut self.positions;
        let mut middle = |a: u32, b: u32| {
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                let sum = positions[a as usize] + positions[b as usize];
                positions.push(sum.normalize());
                positions.len() as u32 - 1
            })
        };
        self.triangles = self
            .triangles
            .iter()
            .flat_map(|&[a, b, c]| {
                let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
                [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
            })
            .collect();
    }
}
