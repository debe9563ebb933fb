//! From the text of an OBJ file to a [`Model`].

use super::scan::called;
use super::{library, scan};
use crate::model::mesh::RawMesh;
use crate::model::polygon::Triangulator;
use crate::model::{Model, ModelError, Placement, Warning};
use crate::shot::ModelFiles;
use ::glam::{DAffine3, DVec3};
use indexmap::{IndexMap, IndexSet};
use tobj::LoadOptions;

/// Reads the text of an OBJ file and the material libraries that it names.
pub(in crate::model) fn read(bytes: Vec<u8>, files: &mut ModelFiles) -> Result<Model, ModelError> {
    let scan = scan::scan(&bytes, files)?;
    drop(bytes);
    let mut warnings = scan.warnings;
    let (materials, of_used) =
        library::read(&scan.libraries, &scan.materials, files, &mut warnings)?;
    let options = LoadOptions {
        single_index: true,
        ..LoadOptions::default()
    };
    let (parts, _) = tobj::load_obj_buf(&mut scan.text.as_bytes(), &options, |_| {
        let numbered = of_used.iter().enumerate();
        let numbered = numbered.map(|(number, &material)| (number.to_string(), material));
        Ok((
            vec![tobj::Material::default(); materials.len()],
            numbered.collect(),
        ))
    })
    .map_err(|error| ModelError::Obj {
        file: files.model.clone(),
        reason: error.to_string(),
    })?;
    let mut model = Model {
        materials,
        ..Model::default()
    };
    for (node, raw) in merge(parts, &scan.objects, &mut warnings) {
        if let Some(mesh) = raw.check(&files.model, &mut warnings)? {
            let mesh_index = model.meshes.len();
            model.meshes.push(mesh);
            model.placements.push(Placement {
                mesh: mesh_index,
                world: DAffine3::IDENTITY,
                node,
            });
        }
    }
    model.warnings = warnings;
    Ok(model)
}

/// One mesh for each name and material, in the order of their first faces.
fn merge(
    parts: Vec<tobj::Model>,
    objects: &IndexSet<String>,
    warnings: &mut Vec<Warning>,
) -> Vec<(String, RawMesh)> {
    let mut merged: IndexMap<(&str, Option<usize>), RawMesh> = IndexMap::new();
    let mut cutter = Triangulator::default();
    for part in parts {
        let number = part.name.parse().unwrap_or_default();
        let name = objects.get_index(number).map_or("", String::as_str);
        let material = part.mesh.material_id;
        let raw = merged.entry((name, material)).or_insert_with(|| RawMesh {
            name: called(name),
            material,
            normals: Some(Vec::new()),
            ..RawMesh::default()
        });
        append(raw, &part.mesh, &mut cutter);
    }
    let named = merged
        .into_iter()
        .map(|((name, _), raw)| (name.to_owned(), raw));
    let mut meshes: Vec<_> = named.collect();
    for (_, raw) in &mut meshes {
        let count = raw.normals.as_ref().map_or(0, Vec::len);
        if count != raw.positions.len() {
            raw.normals = None;
        }
        if count != raw.positions.len() && count > 0 {
            warnings.push(Warning::SomeNormals {
                mesh: raw.name.clone(),
            });
        }
    }
    meshes
}

fn append(raw: &mut RawMesh, part: &tobj::Mesh, cutter: &mut Triangulator) {
    let base = raw.positions.len() as u32;
    let triple = |v: &[f64]| DVec3::new(v[0], v[1], v[2]);
    let positions: Vec<DVec3> = part.positions.chunks_exact(3).map(triple).collect();
    if let Some(normals) = &mut raw.normals {
        normals.extend(part.normals.chunks_exact(3).map(triple));
    }
    let all_triangles = vec![3; part.indices.len() / 3];
    let arities = if part.face_arities.is_empty() {
        &all_triangles
    } else {
        &part.face_arities
    };
    let mut rest = part.indices.as_slice();
    let mut corners = Vec::new();
    for &arity in arities {
        let Some((face, after)) = rest.split_at_checked(arity as usize) else {
            break;
        };
        rest = after;
        corners.clear();
        corners.extend(face.iter().filter_map(|&i| positions.get(i as usize)));
        if corners.len() == face.len() {
            cutter.cut(&corners, |ends| {
                raw.triangles.push(ends.map(|i| base + face[i]))
            });
        }
    }
    raw.positions.extend(positions);
}
