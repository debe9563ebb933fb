//! The shot as its author wrote it: what the TOML says, key by key, nothing resolved.
//!
//! In: the text of a shot file. Out: a [`Shot`] in which every value is of the right type and
//! range, or all of the file's mistakes at once. Units are the file's own: metres, units of c,
//! nanometres, kelvins, degrees. What the renderer needs is built from it by `scene`.
//!
//! The doc comments of the author's types are what `restframe schema` prints and what a
//! message quotes as help. A text is read in three steps: a tree with byte spans, the walk of
//! that tree against the schema, the checks that need more than one key.
//!
//! Source: the shot format, which README.md introduces and `restframe schema` prints.

mod accuracy;
mod appearance;
mod body;
mod camera;
mod check;
mod diagnostics;
mod file_names;
mod gltf_json;
mod later;
mod light;
mod load;
mod mistake;
mod model_files;
mod named_files;
mod names;
mod nearby;
mod obj_lines;
mod schema;
mod sequence;
mod settings;
mod sky;
mod still;
mod text;
mod track;
mod walk;

use indexmap::IndexMap;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

pub use accuracy::{Accuracy, AccuracyKeys, Precision, Preset, Spectra};
pub use appearance::{
    Beyond, Diffuse, Emission, Gaussian, Highlight, Material, Mirror, Refraction, SpectrumTable,
    SpectrumValue, Thermal, ThermalCurve,
};
pub use body::{
    Array, GammaVelocity, LightUnits, Model, RapidityVelocity, Scale, Velocity, Worldline,
};
pub use camera::{Camera, Projection};
pub use check::{ILLUMINANTS, MAX_INSTANCES};
pub use gltf_json::{GltfJson, TextFault};
pub use light::{Light, LightKind};
pub use load::{MAX_BYTES, load, parse};
pub use mistake::{Mistake, Mistakes, Places};
pub use model_files::{FileError, Library, MODEL_BYTES, ModelFile, ModelFiles};
pub use obj_lines::{
    OBJ_KEYWORDS, before_comment, each_line, each_obj_line, is_utf16, keyword_and_rest,
};
pub use schema::schema;
pub use sequence::{Corner, Inset, InsetPixel, MOST_COLUMNS, PixelName, Sequence, Sheet, Video};
pub use settings::{
    AutoExposure, Beaming, Clock, Depth, Effects, Exposure, Filter, Format, Image, LARGEST_SIDE,
    Layer, MOST_BOUNCES, Output, Sensor, SensorColor, Splice, SpliceEffects, Switch, Tone,
};
pub use sky::{
    Background, MOST_STARS, RandomStars, STAR_KELVIN, STAR_MAGNITUDE, StarCatalogue, Stars,
};
pub use still::Moving;
pub use text::{SAVE_AS_UTF8, TextError, text_of};
pub use track::{Blend, Ease, Track};

/// A restframe shot: what is in the scene, how it moves, who looks at it and what is written.
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
    /// Materials by name. A name that a model file has too is laid over the imported material: given keys replace, the rest stays.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub material: IndexMap<String, Material>,
    /// Spectra by name, for use wherever a spectrum stands.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub spectrum: IndexMap<String, SpectrumTable>,
    /// Lamps beside those of the model files.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub light: Vec<Light>,
    /// What is seen where no surface is.
    #[serde(default)]
    #[schemars(extend("default" = {}))]
    pub background: Background,
    /// The camera: where it is, where it looks, how wide.
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
    /// What is approximated, and how finely.
    #[serde(default)]
    #[schemars(extend("default" = {}), with = "AccuracyKeys")]
    pub accuracy: Accuracy,
    /// Files and layers that are written.
    #[serde(default)]
    #[schemars(extend("default" = {}))]
    pub output: Output,
    /// Plots of single pixels' curves, drawn into the PNG.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub inset: Vec<Inset>,
    /// What is assembled from the finished frames.
    #[serde(default)]
    #[schemars(extend("default" = {}))]
    pub sequence: Sequence,
    /// The shot file's path, as it was given.
    #[serde(skip)]
    #[schemars(skip)]
    pub path: PathBuf,
    /// Where in the file each key stands, for mistakes that later stages find.
    #[serde(skip)]
    #[schemars(skip)]
    pub places: Places,
}
