//! The shot as a whole: one field for each section of the file.

use super::{
    Accuracy, AccuracyKeys, Background, Camera, Clock, Effects, Image, Inset, Light, Material,
    Model, Output, Places, Sensor, Sequence, SpectrumTable, Splice, Worldline,
};
use indexmap::IndexMap;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// A restframe shot: the scene and its motion, the camera, the sensor, and the files to write.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Shot {
    /// Title, length and clock of the sequence.
    #[serde(default)]
    #[schemars(extend("default" = {}))]
    pub shot: Clock,
    /// Size and sampling of every image.
    #[serde(default)]
    #[schemars(extend("default" = {}))]
    pub image: Image,
    /// Inertial reference frames by name. "lab" (at rest) and "camera" (the camera's own) exist always.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub worldline: IndexMap<String, Worldline>,
    /// Models from files, and where they stand. At least one.
    #[schemars(length(min = 1))]
    pub model: Vec<Model>,
    /// Materials by name. A name that a model file has too is laid over the imported material: given keys replace, the rest stays. The material "*" is laid over all of them, below one of its own name.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub material: IndexMap<String, Material>,
    /// Spectra by name, for use wherever a spectrum stands.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub spectrum: IndexMap<String, SpectrumTable>,
    /// Lamps beside those of the model files.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub light: Vec<Light>,
    /// The background, seen where no surface is.
    #[serde(default)]
    #[schemars(extend("default" = {}))]
    pub background: Background,
    /// The camera: its position, direction and field of view.
    pub camera: Camera,
    /// Which effects are simulated.
    #[serde(default)]
    #[schemars(extend("default" = {}))]
    pub effects: Effects,
    /// Parts of the image rendered with other effects.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub splice: Vec<Splice>,
    /// From spectral radiance to pixel values.
    #[serde(default)]
    #[schemars(extend("default" = {}))]
    pub sensor: Sensor,
    /// Approximations, and how fine they are.
    #[serde(default)]
    #[schemars(extend("default" = {}), with = "AccuracyKeys")]
    pub accuracy: Accuracy,
    /// Files and layers to write.
    #[serde(default)]
    #[schemars(extend("default" = {}))]
    pub output: Output,
    /// Plots of single pixels' curves, drawn into the PNG.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub inset: Vec<Inset>,
    /// What to assemble from the finished frames.
    #[serde(default)]
    #[schemars(extend("default" = {}))]
    pub sequence: Sequence,
    /// Path of the shot file, as it was given.
    #[serde(skip)]
    #[schemars(skip)]
    pub path: PathBuf,
    /// Places of all keys in the file, for mistakes that are found later.
    #[serde(skip)]
    #[schemars(skip)]
    pub places: Places,
}
