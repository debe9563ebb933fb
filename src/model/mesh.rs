//! From vertices and indices as a file has them to a checked [`Mesh`].
//!
//! A coordinate beyond the range of f32 counts as not finite: boxes of the acceleration trees are
//! in f32.

use super::{Mesh, ModelError, Warning};
use ::glam::{DVec3, Vec3};
use std::path::Path;

/// A mesh as the file has it, unchecked.
#[derive(Debug, Default)]
pub(super) struct RawMesh {
    /// Its name, for messages.
    pub(super) name: String,
    /// Vertices.
    pub(super) positions: Vec<DVec3>,
    /// One normal per vertex, of any length.
    pub(super) normals: Option<Vec<DVec3>>,
    /// Indices of vertices.
    pub(super) triangles: Vec<[u32; 3]>,
    /// Index of the material.
    pub(super) material: Option<usize>,
}

impl RawMesh {
    /// Checks indices and numbers, and removes triangles without area. None if nothing is left.
    pub(super) fn check(
        mut self,
        file: &Path,
        warnings: &mut Vec<Warning>,
    ) -> Result<Option<Mesh>, ModelError> {
        self.check_corners(file)?;
        let found = self.triangles.len();
        let positions = &self.positions;
        self.triangles
            .retain(|&corners| normal(positions, corners) != DVec3::ZERO);
        let count = found - self.triangles.len();
        if count > 0 {
            warnings.push(Warning::Degenerate {
                mesh: self.name.clone(),
                count,
            });
        }
        self.compact();
        let normals = self.unit_normals(warnings);
        let Self {
            positions,
            triangles,
            material,
            ..
        } = self;
        Ok((!triangles.is_empty()).then_some(Mesh {
            positions,
            normals,
            triangles,
            material,
        }))
    }

    fn check_corners(&self, file: &Path) -> Result<(), ModelError> {
        for &index in self.triangles.iter().flatten() {
            let position = self
                .positions
                .get(index as usize)
                .ok_or_else(|| ModelError::Index {
                    file: file.to_owned(),
                    mesh: self.name.clone(),
                    index,
                    count: self.positions.len(),
                })?;
            if !is_in_range(*position) {
                return Err(ModelError::NotFinite {
                    file: file.to_owned(),
                    at: format!("vertex {index} of {}", self.name),
                    found: position.to_string(),
                });
            }
        }
        Ok(())
    }

    /// Keeps only the vertices that triangles use: primitives may share one long list.
    fn compact(&mut self) {
        const UNUSED: u32 = u32::MAX;
        let mut new_from_old = vec![UNUSED; self.positions.len()];
        let mut kept = Vec::new();
        for index in self.triangles.iter_mut().flatten() {
            let new = &mut new_from_old[*index as usize];
            if *new == UNUSED {
                *new = kept.len() as u32;
                kept.push(*index as usize);
            }
            *index = *new;
        }
        self.positions = kept.iter().map(|&old| self.positions[old]).collect();
        if let Some(normals) = &mut self.normals {
            *normals = kept
                .iter()
                .map(|&old| normals.get(old).copied().unwrap_or_default())
                .collect();
        }
    }

    /// The normals at unit length. One that points nowhere is replaced by the area-weighted mean of
    /// the triangles around it.
    fn unit_normals(&mut self, warnings: &mut Vec<Warning>) -> Option<Vec<Vec3>> {
        let mut normals = self.normals.take()?;
        if normals.iter().any(|n| n.try_normalize().is_none()) {
            warnings.push(Warning::Normals {
                mesh: self.name.clone(),
            });
            let mut around = vec![DVec3::ZERO; normals.len()];
            for &corners in &self.triangles {
                let face = normal(&self.positions, corners);
                corners.iter().for_each(|&i| around[i as usize] += face);
            }
            for (own, mean) in normals.iter_mut().zip(around) {
                *own = own
                    .try_normalize()
                    .or(mean.try_normalize())
                    .unwrap_or(DVec3::Y);
            }
        }
        Some(
            normals
                .iter()
                .map(|n| n.normalize_or(DVec3::Y).as_vec3())
                .collect(),
        )
    }
}

/// Whether f32 can hold the coordinates.
pub(super) fn is_in_range(v: DVec3) -> bool {
    v.abs().max_element() <= f64::from(f32::MAX) && v.is_finite()
}

/// Twice the area times the unit normal. The indices must be in range.
pub(super) fn normal(positions: &[DVec3], corners: [u32; 3]) -> DVec3 {
    let [a, b, c] = corners.map(|i| positions[i as usize]);
    (b - a).cross(c - a)
}
