//! Worldlines and their velocities, models and their placement. Velocities in units of c, lengths in
//! meters, times in seconds, angles in degrees.

use super::Track;
use indexmap::IndexMap;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// `[worldline.NAME]`: an inertial reference frame.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Worldline {
    /// Velocity in the lab in units of c, below 1: [0.5, 0, 0], or { gamma, direction }, or { rapidity, direction }.
    pub velocity: Velocity,
    /// Lab position of its origin at lab time `at`, m. Default: [0, 0, 0].
    #[serde(default)]
    pub passes: Track<[f64; 3]>,
    /// Lab time at which its origin is at `passes`, s; that event is also its rest time 0. Default: 0.
    #[serde(default)]
    pub at: Track<f64>,
}

/// A velocity, by the measure that its author prefers. It may change from frame to frame; within a
/// frame the motion is uniform, so that a ramp is a series of inertial scenes and not an acceleration.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Velocity {
    /// By Lorentz factor and direction.
    Gamma(GammaVelocity),
    /// By rapidity and direction.
    Rapidity(RapidityVelocity),
    /// As a vector in units of c.
    Beta(Track<[f64; 3]>),
}

/// A velocity by Lorentz factor and direction.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GammaVelocity {
    /// Lorentz factor, from 1 (at rest) to 1e74.
    #[schemars(extend("minimum" = 1, "maximum" = 1e74))]
    pub gamma: Track<f64>,
    /// Direction of motion in the lab, of any length but zero.
    pub direction: Track<[f64; 3]>,
}

/// A velocity by rapidity and direction.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RapidityVelocity {
    /// Rapidity artanh(v/c), from 0 (at rest) to 170.
    #[schemars(extend("minimum" = 0, "maximum" = 170))]
    pub rapidity: Track<f64>,
    /// Direction of motion in the lab, of any length but zero.
    pub direction: Track<[f64; 3]>,
}

/// `[[model]]`: a model file and its placement: scaled, rotated, translated, then arrayed.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Model {
    /// Name in messages and in `probe`. Default: the file's stem.
    pub name: Option<String>,
    /// Model file, .obj, .gltf or .glb, relative to the shot file.
    pub file: PathBuf,
    /// Worldline in whose rest frame it stands. Default: "lab".
    pub worldline: Option<String>,
    /// Translation, m. Default: [0, 0, 0].
    pub translate: Option<Track<[f64; 3]>>,
    /// Rotation about x, then y, then z, degrees. Default: [0, 0, 0].
    pub rotate: Option<Track<[f64; 3]>>,
    /// Scale, one number or one for each axis, not 0. Default: 1.
    pub scale: Option<Scale>,
    /// Copies in rows, columns and layers. Default: one.
    pub array: Option<Array>,
    /// Name of the material of every surface. Default: the file's materials.
    pub material: Option<String>,
    /// Material by the name it has in the file: { "Name in the file" = "red" }; "" is the name of surfaces to which the file gives none. Default: the file's materials, white where it gives none.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub materials: IndexMap<String, String>,
    /// Units of the lamps in a glTF file, as Blender's export option Lighting Mode has them. Default: "standard".
    pub light_units: Option<LightUnits>,
}

/// Units of the lamps in a model file. The file itself does not record them.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum LightUnits {
    /// Candela and lux, as glTF has it: a lamp of 100 cd is one of `intensity = 100` in the shot.
    #[default]
    Standard,
    /// W/sr and, of suns, W/m²: 683 cd or lx each.
    Unitless,
    /// Watts as Blender's panel shows them: 683/4π cd each; of suns W/m²: 683 lx each.
    Raw,
}

impl Model {
    /// The name of the shot's material for surfaces that have the material `of_file` in the file.
    pub fn given_material(&self, of_file: &str) -> Option<&String> {
        self.material
            .as_ref()
            .or_else(|| self.materials.get(of_file))
    }
}

/// A scale for all axes together or for each.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Scale {
    /// The same along all axes.
    Uniform(Track<f64>),
    /// Along x, y and z.
    PerAxis(Track<[f64; 3]>),
}

/// Copies of a model in rows, columns and layers.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Array {
    /// Copies along x, y and z, each at least 1, at most 10000000 in all.
    #[schemars(inner(range(min = 1)))]
    pub count: [u32; 3],
    /// Distance from one copy to the next along x, y and z, m.
    pub step: Track<[f64; 3]>,
    /// Whether the model's own place is the array's middle instead of its first copy. Default: false.
    #[serde(default)]
    pub centered: bool,
}
