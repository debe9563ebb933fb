//! The shot as its author wrote it: the keys of the TOML file, with nothing resolved.
//!
//! In: the text of a shot file. Out: a [`Shot`] whose values all have the right type and range, or
//! all mistakes of the file at once ([`Mistakes`]). Units are those of the file: meters, units of c,
//! nanometers, kelvins, degrees. Values that move over the frames are [`Track`]s.
//!
//! The doc comments of the types here are what `restframe schema` prints and what messages quote as
//! help. `load/` goes from text to [`Shot`]; `files/` finds and reads the files that models name,
//! for those who import a model and for those who only fingerprint it.

mod accuracy;
mod at_frame;
mod body;
mod camera;
mod document;
mod files;
mod light;
mod load;
mod material;
mod named_files;
mod names;
mod sequence;
mod settings;
mod sky;
mod spectrum;
mod text;
mod track;

pub use accuracy::{Accuracy, AccuracyKeys, Precision, Preset, Spectra};
pub use at_frame::Moving;
pub use body::{
    Array, GammaVelocity, LightUnits, Model, RapidityVelocity, Scale, Velocity, Worldline,
};
pub use camera::{Camera, Projection};
pub use document::Shot;
pub use files::{
    FileError, GltfJson, Library, MODEL_BYTES, ModelFile, ModelFiles, OBJ_KEYWORDS, TextFault,
    before_comment, each_obj_line, keyword_and_rest,
};
pub use light::{Light, LightKind};
pub use load::{
    ILLUMINANTS, MAX_BYTES, MAX_INSTANCES, Mistake, Mistakes, Places, load, parse, schema,
};
pub use material::{
    Diffuse, Emission, Highlight, Material, Mirror, Refraction, Thermal, ThermalCurve,
};
pub use sequence::{Corner, Inset, InsetPixel, MOST_COLUMNS, PixelName, Sequence, Sheet, Video};
pub use settings::{
    AutoExposure, Beaming, Clock, Depth, Effects, Exposure, Filter, Format, Gamut, Image,
    LARGEST_SIDE, Layer, MOST_BOUNCES, Output, Sensor, SensorColor, Splice, SpliceEffects, Switch,
    Tone,
};
pub use sky::{
    Background, MOST_STARS, RandomStars, STAR_KELVIN, STAR_MAGNITUDE, StarCatalogue, Stars,
};
pub use spectrum::{Beyond, Gaussian, SpectrumTable, SpectrumValue};
pub use text::{SAVE_AS_UTF8, TextError, each_line, is_utf16, text_of};
pub use track::{Blend, Ease, Track};
