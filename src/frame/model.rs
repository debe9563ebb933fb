//! Models of one frame: their names, where they stand, and the order of their bodies. Meters and
//! degrees, in the rest frame of the model's worldline.

use super::at::At;
use super::worldline::Worldline;
use crate::shot::{self, LightUnits, Scale};
use glam::{DAffine3, DMat3, DQuat, DVec3, EulerRot};
use indexmap::IndexMap;
use std::borrow::Cow;
use std::cmp::Ordering;
use std::path::Path;

/// A model file and where it stands at one frame: scaled, rotated, translated, then arrayed.
#[derive(Debug, Clone, PartialEq)]
pub struct Model<'a> {
    /// The shot's name for it, or the stem of its file.
    pub name: Cow<'a, str>,
    /// The model file, as the shot has it.
    pub file: &'a Path,
    /// Place of its worldline in [`Frame::worldlines`](super::Frame).
    pub worldline: usize,
    /// Translation, m.
    pub translate: DVec3,
    /// Rotation about x, then y, then z, degrees.
    pub rotate_deg: DVec3,
    /// Scale along each axis.
    pub scale: DVec3,
    /// Copies in rows, columns and layers.
    pub array: Option<Array>,
    /// Name of the material of every surface, in place of the file's materials.
    pub material: Option<&'a str>,
    /// Names of materials by the names that they have in the file.
    pub materials: &'a IndexMap<String, String>,
    /// Units of the lamps in the file.
    pub light_units: LightUnits,
}

/// Copies of a model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Array {
    /// Copies along x, y and z, each at least 1.
    pub count: [u32; 3],
    /// Distance from one copy to the next along x, y and z, m.
    pub step: DVec3,
    /// Whether the model's own place is the array's middle instead of its first copy.
    pub centered: bool,
}

impl<'a> Model<'a> {
    pub(super) fn new(model: &'a shot::Model, at: At<'a>) -> Self {
        let shot::Model {
            name,
            file,
            worldline,
            translate,
            rotate,
            scale,
            array,
            material,
            materials,
            light_units,
        } = model;
        let stem = || file.file_stem().unwrap_or_default().to_string_lossy();
        Self {
            name: name.as_deref().map_or_else(stem, Cow::Borrowed),
            file,
            worldline: at.worldline(worldline, "lab"),
            translate: at.vector(translate),
            rotate_deg: at.vector(rotate),
            scale: match scale {
                None => DVec3::ONE,
                Some(Scale::Uniform(scale)) => DVec3::splat(at.value(scale)),
                Some(Scale::PerAxis(scale)) => DVec3::from(at.value(scale)),
            },
            array: array.as_ref().map(|array| Array {
                count: array.count,
                step: DVec3::from(at.value(&array.step)),
                centered: array.centered,
            }),
            material: material.as_deref(),
            materials,
            light_units: light_units.unwrap_or_default(),
        }
    }

    /// The name of the shot's material for surfaces of a material of the file.
    pub fn given_material(&self, of_file: &str) -> Option<&'a str> {
        let mapped = || self.materials.get(of_file).map(String::as_str);
        self.material.or_else(mapped)
    }

    /// From the file's coordinates to the rest frame of its worldline, the array aside:
    /// translation · Rz·Ry·Rx · scale.
    pub fn rest_from_model(&self) -> DAffine3 {
        let angles = self.rotate_deg * (std::f64::consts::PI / 180.0);
        let turn = DQuat::from_euler(EulerRot::ZYX, angles.z, angles.y, angles.x);
        let linear = DMat3::from_quat(turn) * DMat3::from_diagonal(self.scale);
        DAffine3::from_mat3_translation(linear, self.translate)
    }

    /// Whether it has a size: an invertible map to its rest frame.
    pub(super) fn has_size(&self) -> bool {
        let rest_from_model = self.rest_from_model();
        rest_from_model.matrix3.determinant().is_normal() && rest_from_model.is_finite()
    }

    /// Whether the file may hold lamps: OBJ has none.
    pub(super) fn may_hold_lamps(&self) -> bool {
        let extension = self.file.extension();
        extension.is_none_or(|e| !e.eq_ignore_ascii_case("obj"))
    }

    /// By all that is said of it but its worldline.
    fn compare(&self, other: &Self) -> Ordering {
        // By all keys: one that is new does not compile until it has a place.
        let Self {
            name,
            file,
            worldline: _,
            translate,
            rotate_deg,
            scale,
            array,
            material,
            materials,
            light_units,
        } = self;
        let step = |model: &Self| model.array.map_or(DVec3::ZERO, |array| array.step);
        let copies = |array: &Option<Array>| array.map(|array| (array.count, array.centered));
        name.cmp(&other.name)
            .then_with(|| (*file).cmp(other.file))
            .then_with(|| by_values(*translate, other.translate))
            .then_with(|| by_values(*rotate_deg, other.rotate_deg))
            .then_with(|| by_values(*scale, other.scale))
            .then_with(|| copies(array).cmp(&copies(&other.array)))
            .then_with(|| by_values(step(self), step(other)))
            .then_with(|| material.cmp(&other.material))
            .then_with(|| materials.iter().cmp(other.materials.iter()))
            .then_with(|| (*light_units as u8).cmp(&(other.light_units as u8)))
    }
}

fn by_values(one: DVec3, other: DVec3) -> Ordering {
    let pairs = one.to_array().into_iter().zip(other.to_array());
    pairs.fold(Ordering::Equal, |order, (a, b)| {
        order.then_with(|| a.total_cmp(&b))
    })
}

/// The models in an order that does not depend on that of the shot: by their worldlines' names, their
/// own, and, where two share both, by all else that is said of them. Where two bodies are met at one
/// place, the first of them is seen.
pub(super) fn body_order(models: &[Model<'_>], worldlines: &[Worldline<'_>]) -> Vec<usize> {
    let worldline = |model: &Model<'_>| worldlines[model.worldline].name;
    let mut order: Vec<usize> = (0..models.len()).collect();
    order.sort_by(|&i, &j| {
        let [one, other] = [i, j].map(|place| &models[place]);
        worldline(one)
            .cmp(worldline(other))
            .then_with(|| one.compare(other))
    });
    order
}
