//! Settings of a shot that place nothing in the scene: clock, image, effects, sensor, output. Every
//! key has a default; its comment states the unit.

use super::Track;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Upper bound on `effects.bounces`.
pub const MOST_BOUNCES: u32 = 64;

/// Largest number of pixels on a side of an image.
pub const LARGEST_SIDE: u32 = 32768;

/// Shortest wavelength of a sensor's window, nm: gamma rays of 1 TeV.
const SHORTEST_NM: f64 = 1e-9;

/// Longest wavelength of a sensor's window, nm: radio waves of 300 Hz.
const LONGEST_NM: f64 = 1e15;

/// `[shot]`: title, length and clock of the sequence.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Clock {
    /// Title of the shot, written to the images' metadata. Default: the file's stem.
    pub title: Option<String>,
    /// Number of images, numbered from 1, at most a million. Default: 1.
    #[schemars(range(min = 1, max = 1_000_000))]
    pub frames: u32,
    /// Images per second of the assembled video, above 0. Default: 24.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub fps: f64,
    /// Lab time of the exposure, s. A constant is a stop-frame: velocities may ramp, time stands still. Default: 0.
    pub time: Track<f64>,
    /// Speed of light, m/s, above 0: ties seconds to metres. Default: 1.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub light_speed: f64,
}

impl Default for Clock {
    fn default() -> Self {
        Clock {
            title: None,
            frames: 1,
            fps: 24.0,
            time: Track::default(),
            light_speed: 1.0,
        }
    }
}

/// `[image]`: size and sampling of every image.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Image {
    /// Width and height in pixels, each from 1 to 32768. Default: [1280, 720].
    #[schemars(inner(range(min = 1, max = LARGEST_SIDE)))]
    pub size: [u32; 2],
    /// Samples per pixel, from 1 to 65536. Default: 16.
    #[schemars(range(min = 1, max = 65536))]
    pub samples: u32,
    /// Reconstruction filter of the pixels. Default: "blackman-harris".
    pub filter: Filter,
}

impl Default for Image {
    fn default() -> Self {
        Image {
            size: [1280, 720],
            samples: 16,
            filter: Filter::BlackmanHarris,
        }
    }
}

/// Reconstruction filter of the pixels.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Filter {
    /// A smooth bell over the neighbouring pixels: no stairs, no ringing.
    BlackmanHarris,
    /// The plain mean over the pixel's square.
    Box,
}

/// `[effects]`: which effects are simulated. "auto" means in the frames that call for it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Effects {
    /// Finite light speed: retardation, aberration, contraction. "off" is as if c were infinite. Default: "auto".
    pub geometry: Switch,
    /// The shift of wavelengths; "off" reads curves unshifted. Default: "auto".
    pub doppler: Switch,
    /// The change of power with motion. Default: "full".
    pub beaming: Beaming,
    /// Thermal light of the materials that have a temperature. Default: "auto".
    pub thermal: Switch,
    /// Whether surfaces keep light from each other. Default: "auto".
    pub shadows: Switch,
    /// Depth of mirror and refraction, where a material has them: how many surfaces light may have been reflected or refracted by. 0 turns both off. `render` says where more would show. Default: 8.
    #[schemars(range(max = MOST_BOUNCES))]
    pub bounces: u32,
}

impl Default for Effects {
    fn default() -> Self {
        Effects {
            geometry: Switch::Auto,
            doppler: Switch::Auto,
            beaming: Beaming::Full,
            thermal: Switch::Auto,
            shadows: Switch::Auto,
            bounces: 8,
        }
    }
}

/// Whether an effect is simulated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Switch {
    /// In the frames that call for it.
    Auto,
    /// Never.
    Off,
}

/// The change of power with motion, D being the Doppler factor observed over emitted frequency.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Beaming {
    /// D⁵ on spectral radiance, D³ on spectral irradiance: the physics.
    Full,
    /// D² on both.
    Square,
    /// None.
    Off,
}

/// `[[splice]]`: rows of the image that are rendered with other effects.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Splice {
    /// First and last row as fractions of the height from the top, ascending, from 0 to 1.
    #[schemars(inner(range(min = 0, max = 1)))]
    pub rows: [f64; 2],
    /// The effects that differ there.
    pub effects: SpliceEffects,
}

/// The effects that a splice changes; the rest are the shot's.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct SpliceEffects {
    /// Finite light speed: retardation, aberration, contraction. Default: the shot's.
    pub geometry: Option<Switch>,
    /// The shift of wavelengths. Default: the shot's.
    pub doppler: Option<Switch>,
    /// The change of power with motion. Default: the shot's.
    pub beaming: Option<Beaming>,
    /// Thermal light. Default: the shot's.
    pub thermal: Option<Switch>,
    /// Whether surfaces keep light from each other. Default: the shot's.
    pub shadows: Option<Switch>,
    /// Depth of mirror and refraction. Default: the shot's.
    #[schemars(range(max = MOST_BOUNCES))]
    pub bounces: Option<u32>,
}

/// `[sensor]`: from spectral radiance to pixel values.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Sensor {
    /// Shortest and longest wavelength seen, nm, ascending: any band from gamma rays to radio, from 1e-9 to 1e15. Default: [360, 830].
    #[schemars(inner(range(min = SHORTEST_NM, max = LONGEST_NM)))]
    pub window: [f64; 2],
    /// How wavelengths become color. Default: "cie1931".
    pub color: SensorColor,
    /// "auto", metered on frame 1 and kept, or stops: 0 makes 100 cd/m² 1.0 (of bands 100 W·m⁻²·sr⁻¹), +1 doubles; from -200 to 200. Default: "auto".
    #[schemars(extend("minimum" = -200, "maximum" = 200))]
    pub exposure: Exposure,
    /// What becomes of values above 1. Default: "clip".
    pub tone: Tone,
    /// What becomes, in PNG files, of colors that no screen shows; bands are clipped always. Default: "clip".
    pub gamut: Gamut,
}

impl Default for Sensor {
    fn default() -> Self {
        Sensor {
            window: [360.0, 830.0],
            color: SensorColor::Cie1931,
            exposure: Exposure::Auto(AutoExposure::Auto),
            tone: Tone::Clip,
            gamut: Gamut::Clip,
        }
    }
}

/// How wavelengths become color.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum SensorColor {
    /// As the CIE's standard observer of 1931 (2°) sees them: what the window leaves of 360 to 830 nm.
    Cie1931,
    /// False color: the radiance of the window's long, middle and short third (equal ratios of wavelength) is red, green and blue.
    Bands,
}

/// How bright a radiance appears.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Exposure {
    /// Stops: 0 makes 100 cd/m² 1.0 (of bands 100 W·m⁻²·sr⁻¹), +1 doubles.
    Stops(Track<f64>),
    /// Metered on frame 1 and kept.
    Auto(AutoExposure),
}

/// The word for a metered exposure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum AutoExposure {
    /// The 95th percentile of frame 1 becomes 0.8: of luminance, or of the mean of the bands.
    Auto,
}

/// What becomes of values above 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Tone {
    /// They are cut off at 1.
    Clip,
}

/// What becomes of colors that no screen shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Gamut {
    /// Each of red, green and blue is cut off at 0 and 1, which changes hue and brightness.
    Clip,
    /// Hue, as OKLab has it, and luminance are kept, and chroma is lowered as far as it must be; what is brighter than white is white.
    Compress,
}

/// `[output]`: files and layers that are written.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Output {
    /// Image files of every frame. Default: ["png"].
    #[schemars(length(min = 1))]
    pub formats: Vec<Format>,
    /// Extra layers of the EXR. Default: [].
    pub layers: Vec<Layer>,
    /// What the EXR's color channels are held in. Default: "float".
    pub depth: Depth,
}

impl Default for Output {
    fn default() -> Self {
        Output {
            formats: vec![Format::Png],
            layers: Vec::new(),
            depth: Depth::Float,
        }
    }
}

/// A kind of image file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Format {
    /// 8 bit sRGB after exposure and tone.
    Png,
    /// Linear floats after exposure, before tone, with layers.
    Exr,
}

/// What the color channels of an EXR are held in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Depth {
    /// 32 bits a value.
    Float,
    /// 16 bits a value, from 6e-8 to 65504, 3 digits: half the file. Layers stay at 32.
    Half,
}

/// An extra layer of the EXR, about the first surface that a pixel sees.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Layer {
    /// Doppler factor: observed over emitted frequency.
    Doppler,
    /// Lab length of the light path, m.
    Distance,
    /// Lab time of emission, m of light travel.
    EmissionTime,
    /// Number of the worldline in the order of the shot.
    Worldline,
}
