//! Bodies: meshes, and the placement of their instances in the rest frames of worldlines.

use super::library::Library;
use crate::frame::{Array, Model};
use crate::model::Mesh;
use glam::{DAffine3, DVec3, Vec3};
use std::sync::Arc;

/// An instance of a mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Instance {
    /// Index into [`Geometry::meshes`].
    pub mesh: u32,
    /// Index into the scene's worldlines.
    pub worldline: u32,
    /// Index into the scene's models.
    pub model: u32,
    /// Index into the scene's materials.
    pub material: u32,
    /// Whether the back of a triangle is visible.
    pub double_sided: bool,
    /// Rest-frame coordinates of its worldline from mesh coordinates; invertible.
    pub rest_from_mesh: DAffine3,
}

/// All bodies that rays can hit.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Geometry {
    /// Meshes, shared by their instances.
    pub meshes: Vec<Arc<Mesh>>,
    /// Instances, ordered by the names of their worldlines, then of their models, which does not
    /// depend on the order of the shot. Where two bodies are hit at the same place, the first one
    /// is seen.
    pub instances: Vec<Instance>,
    /// The arrangement from which the instances were made.
    pub(super) arrangement: Arrangement,
}

/// How the models of a shot become bodies in one image. Lists are by model, in the order of the
/// shot.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Arrangement {
    pub(super) placing: Vec<Placing>,
    /// Models in the order of their bodies.
    pub(super) order: Vec<usize>,
    /// Index of the worldline of each model.
    pub(super) worldlines: Vec<u32>,
    /// Indices of the materials of each model.
    pub(super) materials: Vec<Vec<u32>>,
    /// For each material, whether it is a boundary of glass. Such a boundary has two sides whatever
    /// its file says: light that enters would not get out otherwise.
    pub(super) glass: Vec<bool>,
}

/// Placement of a model in one image: rest frame from model, and the steps of its array.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Placing {
    pub(super) rest_from_model: DAffine3,
    array: Option<Array>,
}

/// A model without an array.
const ONE: Array = Array {
    count: [1; 3],
    step: DVec3::ZERO,
    centered: false,
};

impl Placing {
    /// Where a frame's model stands.
    pub(super) fn new(model: &Model<'_>) -> Self {
        Self {
            rest_from_model: model.rest_from_model(),
            array: model.array,
        }
    }

    /// Displacements of the copies of the array, x running fastest; a single zero without an array.
    pub(super) fn copies(&self) -> impl Iterator<Item = DVec3> + '_ {
        let Array {
            count,
            step,
            centered,
        } = self.array.unwrap_or(ONE);
        let counts = DVec3::from(count.map(f64::from));
        let first = if centered {
            step * (counts - 1.0) / -2.0
        } else {
            DVec3::ZERO
        };
        let [nx, ny, nz] = count;
        (0..nz)
            .flat_map(move |z| (0..ny).map(move |y| (y, z)))
            .flat_map(move |(y, z)| {
                (0..nx).map(move |x| first + step * DVec3::new(x.into(), y.into(), z.into()))
            })
    }
}

/// A point of a body's surface, in the rest frame of its worldline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfacePoint {
    /// Position, computed from the triangle's vertices: its error is that of the mesh, however far
    /// the ray came.
    pub position: DVec3,
    /// Unit normal of the triangle, by its winding.
    pub flat_normal: DVec3,
    /// Unit normal interpolated between the vertices; the flat normal if there are no vertex
    /// normals.
    pub normal: DVec3,
    /// Offset from the triangle to the smooth surface that the vertex normals describe; zero
    /// without vertex normals, and where that surface is concave.
    pub bulge: DVec3,
    /// A distance that is certain to separate a point from the surface on which it was computed.
    pub clearance: f64,
}

impl Geometry {
    /// The bodies of a shot's models, arranged.
    pub(super) fn new(library: &Library, arrangement: Arrangement) -> Self {
        let mut meshes: Vec<Arc<Mesh>> = Vec::new();
        let mut instances = Vec::new();
        let Arrangement {
            placing,
            order,
            worldlines,
            materials,
            glass,
        } = &arrangement;
        for &index in order {
            let place = &placing[index];
            let loaded = library.model(index);
            let numbers: Vec<u32> = loaded
                .meshes
                .iter()
                .map(|mesh| number_of(&mut meshes, mesh))
                .collect();
            for copy in place.copies() {
                instances.extend(loaded.file.placements.iter().map(|placement| {
                    let mut rest_from_mesh = place.rest_from_model * placement.world;
                    rest_from_mesh.translation += copy;
                    let own = loaded.meshes[placement.mesh].material;
                    let material = materials[index][own.unwrap_or(loaded.file.materials.len())];
                    Instance {
                        mesh: numbers[placement.mesh],
                        worldline: worldlines[index],
                        model: index as u32,
                        material,
                        double_sided: glass[material as usize]
                            || own.is_none_or(|own| loaded.file.materials[own].double_sided),
                        rest_from_mesh,
                    }
                }));
            }
        }
        Self {
            meshes,
            instances,
            arrangement,
        }
    }

    /// The surface point of an instance's triangle at barycentric `weights`.
    pub fn surface_point(&self, instance: u32, triangle: u32, weights: [f64; 3]) -> SurfacePoint {
        let instance = &self.instances[instance as usize];
        let mesh = &self.meshes[instance.mesh as usize];
        let corners = mesh.triangles[triangle as usize];
        let [a, b, c] = corners.map(|i| mesh.positions[i as usize]);
        let [wa, wb, wc] = weights;
        let place = &instance.rest_from_mesh;
        let position = place.transform_point3(a * wa + b * wb + c * wc);
        let (ab, ac) = (
            place.transform_vector3(b - a),
            place.transform_vector3(c - a),
        );
        // A mirrored instance turns its triangles over; the normal stays on the mesh's front.
        let handed = place.matrix3.determinant().signum();
        // Scaled first: products of the edges of the smallest bodies would underflow.
        let unit = |edge: DVec3| edge / edge.abs().max_element();
        let flat_normal = unit(ab).cross(unit(ac)).normalize_or(DVec3::Y) * handed;
        let inverse_transpose = place.matrix3.inverse().transpose();
        let of_corner = |normals: &[Vec3], i: u32| {
            (inverse_transpose * normals[i as usize].as_dvec3()).normalize_or(flat_normal)
        };
        let normals = mesh
            .normals
            .as_ref()
            .map(|n| corners.map(|i| of_corner(n, i)));
        let normal = normals.map_or(flat_normal, |[na, nb, nc]| {
            (na * wa + nb * wb + nc * wc).normalize_or(flat_normal)
        });
        let places = [a, b, c].map(|corner| place.transform_point3(corner));
        let bulge = normals.map_or(DVec3::ZERO, |normals| {
            bulge(position, places, normals, weights)
        });
        // 1e3 roundings of the largest coordinate involved.
        let size = position.abs().max_element()
            + place.translation.abs().max_element()
            + ab.abs().max_element().max(ac.abs().max_element());
        SurfacePoint {
            position,
            flat_normal,
            normal,
            bulge,
            clearance: 1e3 * f64::EPSILON * size,
        }
    }
}

/// The offset from a point of a triangle to the smooth surface above it: the point is projected
/// onto the planes of the vertex normals where they lie above it, and the projections are weighted
/// as the vertices are (Hanika 2021, Hacking the Shadow Terminator).
fn bulge(position: DVec3, corners: [DVec3; 3], normals: [DVec3; 3], weights: [f64; 3]) -> DVec3 {
    let lift = |i: usize| {
        let below = (position - corners[i]).dot(normals[i]).min(0.0);
        normals[i] * (-below * weights[i])
    };
    lift(0) + lift(1) + lift(2)
}

/// The index of a mesh among those known; models of one file share theirs.
fn number_of(known: &mut Vec<Arc<Mesh>>, mesh: &Arc<Mesh>) -> u32 {
    let number = known
        .iter()
        .position(|k| Arc::ptr_eq(k, mesh))
        .unwrap_or_else(|| {
            known.push(Arc::clone(mesh));
            known.len() - 1
        });
    number as u32
}
