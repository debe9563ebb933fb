//! The node tree: placement of every mesh, instance and lamp.
//!
//! The walk has a stack of its own, so that depth costs no call stack. The file shows its default
//! scene; without one, the first scene that has nodes; without scenes, every node without a parent.
//! Nodes hidden by KHR_node_visibility are left out with everything below them, including lamps.

use super::flat::{Extent, Pose};
use super::source::{Source, name_of};
use crate::model::mesh::is_in_range;
use crate::model::{Model, ModelError, Placement, Warning};
use ::glam::{DAffine3, DMat3, DMat4, DQuat, DVec3};
use ::gltf::json::Index;
use ::gltf::json::accessor::{Accessor, ComponentType};
use serde_json::Value;
use std::collections::HashMap;

/// Number of mesh instances that one file may have.
const MAX_INSTANCES: u64 = 10_000_000;

/// Largest departure of the last row of a matrix from 0 0 0 1 that counts as rounding.
const NOT_AFFINE: f64 = 1e-5;

/// Meshes of the file that have become meshes of the model.
struct Made {
    /// For each mesh of the file, its indices in the model.
    whole: Vec<Option<Vec<usize>>>,
    /// For each flattened mesh, by the index of the original and the bits of the direction of
    /// flattening, its index in the model; None if nothing is left.
    flat: HashMap<(usize, [u64; 3]), Option<usize>>,
    /// Number of instances by EXT_mesh_gpu_instancing, including those scaled to a line or a point.
    instances: u64,
}

/// Adds every instance and lamp of the scene to the model.
pub(super) fn place(source: &Source<'_>, model: &mut Model) -> Result<(), ModelError> {
    let parentless = source.parentless_nodes()?;
    let mut stack = Vec::new();
    for root in source.scene_roots(&parentless)?.into_iter().rev() {
        stack.push((root, Pose::ORIGIN));
    }
    let mut made = Made {
        whole: vec![None; source.root.meshes.len()],
        flat: HashMap::new(),
        instances: 0,
    };
    let mut is_visited = vec![false; source.root.nodes.len()];
    while let Some((index, parent)) = stack.pop() {
        if std::mem::replace(&mut is_visited[index], true) {
            return Err(source.not_a_tree(index));
        }
        let visibility = &source.raw["nodes"][index]["extensions"]["KHR_node_visibility"];
        if visibility["visible"] == false {
            continue;
        }
        let pose = parent.then(source.local(index)?);
        let world = pose.world;
        let [x, y, z] = [
            world.matrix3.x_axis,
            world.matrix3.y_axis,
            world.matrix3.z_axis,
        ];
        if ![x, y, z, world.translation].into_iter().all(is_in_range) {
            return Err(ModelError::NotFinite {
                file: source.file.clone(),
                at: format!("the place of node `{}`", source.node_name(index)),
                found: world.to_string(),
            });
        }
        source.node(index, pose, &mut made, model)?;
        let children = source.root.nodes[index].children.iter().flatten().rev();
        stack.extend(children.map(|child| (child.value(), pose)));
    }
    Ok(())
}

impl Source<'_> {
    fn node(
        &self,
        index: usize,
        pose: Pose,
        made: &mut Made,
        model: &mut Model,
    ) -> Result<(), ModelError> {
        let node = &self.root.nodes[index];
        let name = self.node_name(index);
        let extensions = &self.raw["nodes"][index]["extensions"];
        let light = extensions["KHR_lights_punctual"]["light"].as_u64();
        if let Some(light) = light {
            self.lamp(light, &name, &pose.world, model)?;
        }
        if let Some(mesh) = node.mesh {
            let from = format!("node `{name}`");
            self.item(&self.root.meshes, mesh, "mesh", &from)?;
            let parts = match &made.whole[mesh.value()] {
                Some(parts) => parts.clone(),
                None => self.mesh(mesh.value(), model)?,
            };
            made.whole[mesh.value()] = Some(parts.clone());
            if node.skin.is_some() {
                model.warnings.push(Warning::Skin { node: from.clone() });
            }
            let instancing = &extensions["EXT_mesh_gpu_instancing"]["attributes"];
            let mut are_seen = true;
            for instance in self.instances(instancing, &from, made)? {
                are_seen &= self.stand(&parts, pose.then(instance), &name, made, model)?;
            }
            if !are_seen {
                model.warnings.push(Warning::Squashed { node: from });
            }
        }
        let has_children = node.children.as_ref().is_some_and(|c| !c.is_empty());
        let is_empty = node.mesh.is_none() && node.camera.is_none() && light.is_none();
        if is_empty && !has_children && sounds_like_a_lamp(&name) {
            model.warnings.push(Warning::LostLamp {
                node: format!("node `{name}`"),
            });
        }
        Ok(())
    }

    /// Adds an instance. Returns whether any of it is visible.
    fn stand(
        &self,
        parts: &[usize],
        pose: Pose,
        node: &str,
        made: &mut Made,
        model: &mut Model,
    ) -> Result<bool, ModelError> {
        let extent = pose.extent();
        let mut is_seen = parts.is_empty();
        for &mesh in parts {
            let placed = match extent {
                Extent::Nothing => None,
                Extent::Solid(world) => Some((mesh, world)),
                Extent::Flat { world, lost } => {
                    let key = (mesh, lost.to_array().map(f64::to_bits));
                    let flattened = match made.flat.get(&key) {
                        Some(&flattened) => flattened,
                        None => self.flattened(mesh, lost, node, model)?,
                    };
                    made.flat.insert(key, flattened);
                    flattened.map(|mesh| (mesh, world))
                }
            };
            let node = node.to_owned();
            is_seen |= placed.is_some();
            model
                .placements
                .extend(placed.map(|(mesh, world)| Placement { mesh, world, node }));
        }
        self.check_instances(model.placements.len() as u64)?;
        Ok(is_seen)
    }

    fn check_instances(&self, count: u64) -> Result<(), ModelError> {
        if count <= MAX_INSTANCES {
            return Ok(());
        }
        Err(ModelError::TooMany {
            file: self.file.clone(),
            what: "instances of meshes",
            count,
            limit: MAX_INSTANCES,
        })
    }

    /// The node's transforms by EXT_mesh_gpu_instancing; the identity without it.
    fn instances(
        &self,
        attributes: &Value,
        from: &str,
        made: &mut Made,
    ) -> Result<Vec<Pose>, ModelError> {
        const FLOAT: [ComponentType; 1] = [ComponentType::F32];
        const TURN: [ComponentType; 3] =
            [ComponentType::F32, ComponentType::I8, ComponentType::I16];
        let Some(attributes) = attributes.as_object().filter(|a| !a.is_empty()) else {
            return Ok(vec![Pose::ORIGIN]);
        };
        let at = |key: &str| {
            let index = attributes.get(key)?.as_u64()?;
            Some(Index::<Accessor>::new(
                u32::try_from(index).unwrap_or(u32::MAX),
            ))
        };
        let all = ["TRANSLATION", "ROTATION", "SCALE"].map(at);
        let counts = all.iter().flatten().map(|&i| self.written(i, from));
        let most = counts.collect::<Result<Vec<u64>, _>>()?.into_iter().max();
        made.instances = made.instances.saturating_add(most.unwrap_or_default());
        self.check_instances(made.instances)?;
        let [shift, turn, scale] = all;
        let shift = shift
            .map(|i| self.vectors::<3>(i, &FLOAT, from))
            .transpose()?;
        let turn = turn
            .map(|i| self.vectors::<4>(i, &TURN, from))
            .transpose()?;
        let scale = scale
            .map(|i| self.vectors::<3>(i, &FLOAT, from))
            .transpose()?;
        let counts = [
            shift.as_ref().map(Vec::len),
            turn.as_ref().map(Vec::len),
            scale.as_ref().map(Vec::len),
        ];
        let Some(count) = counts.into_iter().flatten().next() else {
            return Err(self.invalid(from, "has instances without TRANSLATION, ROTATION or SCALE"));
        };
        if counts.into_iter().flatten().any(|other| other != count) {
            return Err(self.invalid(from, "has instances with attributes of unequal length"));
        }
        (0..count)
            .map(|i| {
                let shift = shift.as_ref().map_or(DVec3::ZERO, |v| DVec3::from(v[i]));
                let scale = scale.as_ref().map_or(DVec3::ONE, |v| DVec3::from(v[i]));
                let turn = turn.as_ref().map_or([0.0, 0.0, 0.0, 1.0], |v| v[i]);
                self.affine(scale, turn, shift, &format!("instance {i} of {from}"))
            })
            .collect()
    }

    fn local(&self, index: usize) -> Result<Pose, ModelError> {
        let raw = &self.raw["nodes"][index];
        let at = || format!("node `{}`", self.node_name(index));
        if let Some(m) = numbers::<16>(&raw["matrix"]) {
            let off = [m[3], m[7], m[11], m[15] - 1.0];
            if off.into_iter().any(|v| v.abs() > NOT_AFFINE) {
                return Err(self.invalid(
                    &at(),
                    "has a matrix that is not affine: expected 0 0 0 1 in its last row",
                ));
            }
            let world = DAffine3::from_mat4(DMat4::from_cols_array(&m));
            let is_mirrored = world.matrix3.determinant() < 0.0;
            return Ok(Pose {
                world,
                handed: if is_mirrored { -1.0 } else { 1.0 },
            });
        }
        let shift = numbers(&raw["translation"]).map_or(DVec3::ZERO, DVec3::from_array);
        let scale = numbers(&raw["scale"]).map_or(DVec3::ONE, DVec3::from_array);
        let turn = numbers(&raw["rotation"]).unwrap_or([0.0, 0.0, 0.0, 1.0]);
        self.affine(scale, turn, shift, &at())
    }

    fn affine(
        &self,
        scale: DVec3,
        turn: [f64; 4],
        shift: DVec3,
        at: &str,
    ) -> Result<Pose, ModelError> {
        let length = turn.iter().map(|v| v * v).sum::<f64>().sqrt();
        if !(length > 0.0 && length.is_finite()) {
            let problem = format!("has the rotation {turn:?}, expected a quaternion of length 1");
            return Err(self.invalid(at, problem));
        }
        let turn = DQuat::from_array(turn.map(|v| v / length));
        let axes = DMat3::from_quat(turn) * DMat3::from_diagonal(scale);
        let signs = scale.to_array().map(|s| if s < 0.0 { -1.0 } else { 1.0 });
        Ok(Pose {
            world: DAffine3::from_mat3_translation(axes, shift),
            handed: signs.into_iter().product(),
        })
    }

    /// Nodes without a parent, if all nodes form trees.
    fn parentless_nodes(&self) -> Result<Vec<usize>, ModelError> {
        let nodes = &self.root.nodes;
        let mut has_parent = vec![false; nodes.len()];
        for (index, node) in nodes.iter().enumerate() {
            for &child in node.children.iter().flatten() {
                let from = format!("node `{}`", self.node_name(index));
                self.item(nodes, child, "node", &from)?;
                if std::mem::replace(&mut has_parent[child.value()], true) {
                    return Err(self.not_a_tree(child.value()));
                }
            }
        }
        let roots: Vec<usize> = (0..nodes.len()).filter(|&i| !has_parent[i]).collect();
        // Each node has one parent, so those that no root leads to form a circle.
        let mut is_reached = vec![false; nodes.len()];
        let mut stack = roots.clone();
        while let Some(index) = stack.pop() {
            is_reached[index] = true;
            stack.extend(
                nodes[index]
                    .children
                    .iter()
                    .flatten()
                    .map(|child| child.value()),
            );
        }
        match is_reached.iter().position(|&reached| !reached) {
            Some(index) => Err(self.not_a_tree(index)),
            None => Ok(roots),
        }
    }

    /// The index of the scene that is shown, if there is one.
    pub(super) fn shown_scene(&self) -> Option<usize> {
        let scenes = &self.root.scenes;
        let with_nodes = || scenes.iter().position(|scene| !scene.nodes.is_empty());
        let default = self.root.scene.map(|scene| scene.value());
        default
            .or_else(with_nodes)
            .or((!scenes.is_empty()).then_some(0))
    }

    fn scene_roots(&self, parentless: &[usize]) -> Result<Vec<usize>, ModelError> {
        let scenes = &self.root.scenes;
        let Some(index) = self.shown_scene() else {
            return Ok(parentless.to_vec());
        };
        let scene = scenes
            .get(index)
            .ok_or_else(|| self.dangling("the file", "scene", index, scenes.len()))?;
        for &node in &scene.nodes {
            self.item(&self.root.nodes, node, "node", "the scene")?;
        }
        Ok(scene.nodes.iter().map(|node| node.value()).collect())
    }

    fn not_a_tree(&self, index: usize) -> ModelError {
        let node = format!("node `{}`", self.node_name(index));
        ModelError::NotATree {
            file: self.file.clone(),
            node,
        }
    }

    fn node_name(&self, index: usize) -> String {
        let node = self.root.nodes.get(index);
        name_of(node.and_then(|node| node.name.as_deref()), "node", index)
    }
}

fn numbers<const N: usize>(value: &Value) -> Option<[f64; N]> {
    let list = value.as_array()?;
    let numbers: Option<Vec<f64>> = list.iter().map(Value::as_f64).collect();
    numbers?.try_into().ok()
}

fn sounds_like_a_lamp(name: &str) -> bool {
    let name = name.to_lowercase();
    ["light", "lamp", "area", "sun", "spot", "panel"]
        .iter()
        .any(|word| name.contains(word))
}
