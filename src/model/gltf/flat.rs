//! Meshes on nodes whose matrix flattens one direction, as a scale of 1 1 0 does: the remaining
//! plane is shown.
//!
//! The matrix M of such a node has rank 2. With unit vectors n across its plane and k along the
//! lost direction, cof M = a n kᵀ, where a > 0 is the area that a unit area gets. The mesh is
//! flattened along k, and on flat meshes M + s n kᵀ, which is invertible, acts like M; its
//! determinant s a has the sign chosen for s, so that the flattened mesh keeps its front.

use super::source::Source;
use crate::model::mesh::{RawMesh, normal};
use crate::model::{Mesh, Model, ModelError, Warning};
use ::glam::{DAffine3, DMat3, DVec3};

/// Relative thickness, to the second longest axis, below which a body is flat; and relative area
/// below which a flattened triangle has none.
const FLAT: f64 = 1e-12;

/// Placement of a node.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pose {
    /// Model space from node space.
    pub(super) world: DAffine3,
    /// −1 if the node is mirrored, which a matrix of rank 2 does not show; else 1.
    pub(super) handed: f64,
}

impl Pose {
    /// The pose of the model itself.
    pub(super) const ORIGIN: Self = Self {
        world: DAffine3::IDENTITY,
        handed: 1.0,
    };

    /// The pose `inner` within this one.
    pub(super) fn then(self, inner: Self) -> Self {
        Self {
            world: self.world * inner.world,
            handed: self.handed * inner.handed,
        }
    }

    /// What the pose leaves of a body.
    pub(super) fn extent(&self) -> Extent {
        let axes = self.world.matrix3;
        let DMat3 {
            x_axis,
            y_axis,
            z_axis,
        } = axes;
        let size = x_axis.length().max(y_axis.length()).max(z_axis.length());
        let [x, y, z] = [x_axis, y_axis, z_axis].map(|axis| axis / size);
        let cofactors = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y));
        let across = [cofactors.x_axis, cofactors.y_axis, cofactors.z_axis]
            .into_iter()
            .max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()))
            .unwrap_or(DVec3::ZERO);
        let area = across.length();
        let is_solid = x.dot(y.cross(z)).abs() > FLAT * area * area;
        let (world, lost) = if is_solid {
            (self.world, None)
        } else {
            let Some(across) = across.try_normalize().filter(|_| area > FLAT) else {
                return Extent::Nothing;
            };
            // Adding zero removes negative zeros, so that equal directions have equal bits.
            let lost = (cofactors.transpose() * across).normalize_or_zero() + DVec3::ZERO;
            let depth = across * (self.handed * size * area);
            let outer = DMat3::from_cols(depth * lost.x, depth * lost.y, depth * lost.z);
            let world = DAffine3::from_mat3_translation(axes + outer, self.world.translation);
            (world, Some(lost))
        };
        match lost {
            _ if !world.inverse().is_finite() => Extent::Nothing,
            None => Extent::Solid(world),
            Some(lost) => Extent::Flat { world, lost },
        }
    }
}

/// What a pose leaves of a body.
#[derive(Debug, Clone, Copy)]
pub(super) enum Extent {
    /// All dimensions.
    Solid(DAffine3),
    /// Two dimensions.
    Flat {
        /// Model space from the space of the flattened mesh; invertible.
        world: DAffine3,
        /// Unit vector along which the mesh is flattened.
        lost: DVec3,
    },
    /// A line or a point, which cannot be seen.
    Nothing,
}

impl Source<'_> {
    /// Adds mesh number `mesh` without its depth along `lost` and returns its number; None if no
    /// triangle of it has an area then.
    pub(super) fn flattened(
        &self,
        mesh: usize,
        lost: DVec3,
        node: &str,
        model: &mut Model,
    ) -> Result<Option<usize>, ModelError> {
        let Mesh {
            positions,
            triangles,
            material,
            ..
        } = &model.meshes[mesh];
        self.spend((positions.len() + 3 * triangles.len()) as u64)?;
        let has_area = |&corners: &[u32; 3]| {
            let normal = normal(positions, corners);
            normal.dot(lost).abs() > FLAT * normal.length()
        };
        let kept: Vec<[u32; 3]> = triangles.iter().copied().filter(has_area).collect();
        let (name, count) = (format!("node `{node}`"), triangles.len() - kept.len());
        if kept.is_empty() {
            return Ok(None);
        }
        if count > 0 {
            let mesh = name.clone();
            model.warnings.push(Warning::Degenerate { mesh, count });
        }
        let raw = RawMesh {
            name,
            positions: positions.iter().map(|&p| p - lost * p.dot(lost)).collect(),
            normals: None,
            triangles: kept,
            material: *material,
        };
        let made = raw.check(&self.file, &mut model.warnings)?;
        Ok(made.map(|mesh| {
            model.meshes.push(mesh);
            model.meshes.len() - 1
        }))
    }
}
