//! The background of the scene: a spectrum or an image all around, and stars in front of it. All of
//! it is at rest in the worldline of the background. Nanometers, kelvins, degrees.

use super::{SpectrumValue, Track};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Largest number of stars of a sky.
pub const MOST_STARS: u32 = 1_000_000;

/// Lowest and highest temperature of a star, K. A colder one has no visible light; no hotter one is
/// known.
pub const STAR_KELVIN: [f64; 2] = [500.0, 1e9];

/// Lowest and highest visual magnitude of a star.
pub const STAR_MAGNITUDE: [f64; 2] = [-50.0, 50.0];

/// `[background]`: seen where no surface is.
#[derive(Debug, Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Background {
    /// Worldline that it rides on; "camera" leaves it unshifted. Default: "camera".
    pub worldline: Option<String>,
    /// Spectral radiance at scale 1, W·m⁻²·sr⁻¹·nm⁻¹, at least 0. Default: 0.0.
    #[schemars(extend("minimum" = 0))]
    pub spectrum: Option<SpectrumValue>,
    /// Image of the whole sky in place of `spectrum`, .hdr, .exr or .png, equirectangular with −z in its middle, its colors those that the file says (Rec. 709 where it does not): a white pixel is scale × "D65", a color a smooth curve times that, and beyond the visible its end's value goes on.
    pub image: Option<PathBuf>,
    /// Factor on `spectrum` or `image`, at least 0; stars stay as they are. Default: 1.
    #[schemars(extend("minimum" = 0))]
    pub scale: Option<Track<f64>>,
    /// Stars, added to `spectrum` or `image`: { file = "stars.csv" }, or { count = 2000 }. Default: none.
    pub stars: Option<Stars>,
}

/// Stars, each a disc that glows as a black body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Stars {
    /// From a catalogue.
    Catalogue(StarCatalogue),
    /// Distributed at random.
    Random(RandomStars),
}

impl Stars {
    /// The angular diameter of their discs, degrees.
    pub fn size(&self) -> f64 {
        match self {
            Self::Catalogue(stars) => stars.size,
            Self::Random(stars) => stars.size,
        }
    }
}

/// Stars from a catalogue.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StarCatalogue {
    /// CSV file of azimuth (degrees, 0 is −z, positive to the right), elevation (degrees), temperature (500 to 1e9 K), visual magnitude; at most a million rows.
    pub file: PathBuf,
    /// Angular diameter of every star in the sky's rest frame, degrees, from 1e-6 to 10; its light does not depend on it. Default: 0.05.
    #[serde(default = "size")]
    #[schemars(extend("minimum" = 1e-6, "maximum" = 10))]
    pub size: f64,
}

/// Stars distributed at random, the same for the same keys on every machine.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RandomStars {
    /// How many, from 1 to a million, evenly over the sphere.
    #[schemars(range(min = 1, max = MOST_STARS))]
    pub count: u32,
    /// Another seed, from 0 to 4294967295, is another sky. Default: 1.
    #[serde(default = "seed")]
    #[schemars(range(max = 4_294_967_295u32))]
    pub seed: u32,
    /// Angular diameter of every star in the sky's rest frame, degrees, from 1e-6 to 10; its light does not depend on it. Default: 0.05.
    #[serde(default = "size")]
    #[schemars(extend("minimum" = 1e-6, "maximum" = 10))]
    pub size: f64,
    /// Lowest and highest temperature, K, from 500 to 1e9; even in its logarithm between. Default: [3000, 30000].
    #[serde(default = "temperature")]
    #[schemars(inner(range(min = STAR_KELVIN[0], max = STAR_KELVIN[1])))]
    pub temperature: [f64; 2],
    /// Visual magnitude of the brightest and of the faintest, from -50 to 50; their number grows tenfold in two magnitudes, as in the real sky. Default: [0, 6].
    #[serde(default = "magnitude")]
    #[schemars(inner(range(min = STAR_MAGNITUDE[0], max = STAR_MAGNITUDE[1])))]
    pub magnitude: [f64; 2],
}

fn size() -> f64 {
    0.05
}

fn seed() -> u32 {
    1
}

fn temperature() -> [f64; 2] {
    [3000.0, 30000.0]
}

fn magnitude() -> [f64; 2] {
    [0.0, 6.0]
}
