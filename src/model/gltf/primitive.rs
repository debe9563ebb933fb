//! Primitives of a glTF mesh. Each becomes one mesh of the model.

use super::extensions::unsupported;
use super::source::{Source, name_of};
use crate::model::mesh::RawMesh;
use crate::model::{Mesh, Model, ModelError, Warning};
use ::glam::DVec3;
use ::gltf::json::Index;
use ::gltf::json::accessor::{Accessor, ComponentType};
use ::gltf::json::mesh::{Mode, Primitive, Semantic};
use ::gltf::json::validation::Checked;

impl Source<'_> {
    /// Reads one mesh of the file and returns the indices of the meshes that it has become.
    pub(super) fn mesh(&self, index: usize, model: &mut Model) -> Result<Vec<usize>, ModelError> {
        let Some(mesh) = self.root.meshes.get(index) else {
            return Ok(Vec::new());
        };
        let name = format!("mesh `{}`", name_of(mesh.name.as_deref(), "mesh", index));
        let mut made = Vec::new();
        for (number, primitive) in mesh.primitives.iter().enumerate() {
            let at = match mesh.primitives.len() {
                1 => name.clone(),
                _ => format!("primitive {number} of {name}"),
            };
            self.check_compression(index, number, primitive)?;
            if let Some(part) = self.primitive(primitive, &at, model)? {
                made.push(model.meshes.len());
                model.meshes.push(part);
            }
        }
        Ok(made)
    }

    /// Refuses a primitive that exists in compressed form only: its accessors without data would be
    /// zeros.
    fn check_compression(
        &self,
        mesh: usize,
        number: usize,
        primitive: &Primitive,
    ) -> Result<(), ModelError> {
        const DRACO: &str = "KHR_draco_mesh_compression";
        let raw = &self.raw["meshes"][mesh]["primitives"][number];
        let positions = attribute(primitive, &Semantic::Positions);
        let positions = positions.and_then(|index| self.root.accessors.get(index.value()));
        let has_data = positions.is_some_and(|p| p.buffer_view.is_some() || p.sparse.is_some());
        if raw["extensions"][DRACO].is_object() && !has_data {
            return Err(unsupported(DRACO, &self.file));
        }
        Ok(())
    }

    fn primitive(
        &self,
        primitive: &Primitive,
        at: &str,
        model: &mut Model,
    ) -> Result<Option<Mesh>, ModelError> {
        let mode = match primitive.mode {
            Checked::Valid(mode @ (Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan)) => {
                mode
            }
            Checked::Valid(_) => {
                model.warnings.push(Warning::PointsOrLines {
                    mesh: at.to_owned(),
                });
                return Ok(None);
            }
            Checked::Invalid => return Err(self.invalid(at, "is of a mode beyond 0 to 6")),
        };
        let positions = attribute(primitive, &Semantic::Positions)
            .ok_or_else(|| self.invalid(at, "has no POSITION, expected one: export it again"))?;
        let positions = self.points(positions, at)?;
        let normals = attribute(primitive, &Semantic::Normals);
        let normals = normals
            .map(|normals| self.points(normals, at))
            .transpose()?;
        if let Some(normals) = normals.as_ref().filter(|n| n.len() != positions.len()) {
            let counts = format!(
                "{} normals for {} positions",
                normals.len(),
                positions.len()
            );
            return Err(self.invalid(at, format!("has {counts}, expected as many")));
        }
        let corners = match primitive.indices {
            Some(indices) => self.indices(indices, at)?,
            None => (0..positions.len() as u32).collect(),
        };
        self.warn_of_primitive(primitive, at, model);
        let material = primitive.material.map(|material| material.value());
        if let Some(index) = material.filter(|&index| index >= model.materials.len()) {
            return Err(self.dangling(at, "material", index, model.materials.len()));
        }
        let triangles = assemble(mode, &corners);
        let raw = RawMesh {
            name: at.to_owned(),
            positions,
            normals,
            triangles,
            material,
        };
        raw.check(&self.file, &mut model.warnings)
    }

    fn points(&self, index: Index<Accessor>, at: &str) -> Result<Vec<DVec3>, ModelError> {
        let vectors = self.vectors::<3>(index, &[ComponentType::F32], at)?;
        Ok(vectors.into_iter().map(DVec3::from).collect())
    }

    fn warn_of_primitive(&self, primitive: &Primitive, at: &str, model: &mut Model) {
        if attribute(primitive, &Semantic::Colors(0)).is_some() {
            model.warnings.push(Warning::VertexColors {
                mesh: at.to_owned(),
            });
        }
        if primitive
            .targets
            .as_ref()
            .is_some_and(|targets| !targets.is_empty())
        {
            model.warnings.push(Warning::ShapeKeys {
                mesh: at.to_owned(),
            });
        }
    }
}

fn attribute(primitive: &Primitive, wanted: &Semantic) -> Option<Index<Accessor>> {
    primitive
        .attributes
        .iter()
        .find_map(|(semantic, &index)| match semantic {
            Checked::Valid(semantic) if semantic == wanted => Some(index),
            _ => None,
        })
}

/// The triangles of a list, strip or fan (glTF 2.0, section 3.7.2.1): every second one of a strip
/// is turned so that all keep the winding of the first.
fn assemble(mode: Mode, corners: &[u32]) -> Vec<[u32; 3]> {
    match mode {
        Mode::TriangleStrip => corners
            .windows(3)
            .enumerate()
            .map(|(i, w)| {
                if i % 2 == 0 {
                    [w[0], w[1], w[2]]
                } else {
                    [w[0], w[2], w[1]]
                }
            })
            .collect(),
        Mode::TriangleFan => corners
            .windows(2)
            .skip(1)
            .map(|w| [corners[0], w[0], w[1]])
            .collect(),
        _ => corners
            .chunks_exact(3)
            .map(|c| [c[0], c[1], c[2]])
            .collect(),
    }
}
