//! Warnings about skies that the image may not show as their author meant them.

use std::fmt;

/// A doubt about a sky. Messages continue "FILE: ".
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum SkyWarning {
    /// Components that are negative or not finite.
    Clamped {
        /// Number of components.
        count: usize,
    },
    /// Colors outside of Rec. 709.
    Gamut {
        /// Number of pixels.
        count: usize,
    },
    /// Chromaticities of no color space.
    Chromaticities {
        /// x, y of red, green, blue.
        rgb: [[f64; 2]; 3],
        /// x, y of white.
        white: [f64; 2],
    },
    /// The width is not twice the height.
    Shape {
        /// Columns and rows.
        size: [usize; 2],
    },
    /// An OpenEXR file that declares itself a cube map.
    CubeMap,
    /// One of several layers, or one without a usual name for images.
    Layer {
        /// Its name.
        taken: String,
        /// The other layers of colors.
        others: Vec<String>,
    },
}

impl fmt::Display for SkyWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Clamped { count } => write!(
                f,
                "{count} components of its colors are negative, infinite or no number: they are clamped to 0 or to the greatest that is finite"
            ),
            Self::Gamut { count } => write!(
                f,
                "{count} of its pixels have colors beyond Rec. 709: they are mixed with white until they are in it, at the same luminance"
            ),
            Self::Chromaticities { rgb, white } => {
                let [r, g, b] = rgb;
                write!(
                    f,
                    "its chromaticities (red {r:?}, green {g:?}, blue {b:?}, white {white:?}) are those of no color space: its colors are taken for Rec. 709; save it again with the right ones, or without"
                )
            }
            Self::Shape {
                size: [width, height],
            } => write!(
                f,
                "it is {width} x {height} pixels, and an equirectangular sky is twice as wide as high{}: it is stretched over the whole sky as it is; save it as an equirectangular (latitude-longitude) panorama",
                guess(*width, *height)
            ),
            Self::CubeMap => f.write_str(
                "it says that it is a cube map (envmap), and is read as an equirectangular panorama: save it as one, by exrenvmap -latlong",
            ),
            Self::Layer { taken, others } if others.is_empty() => {
                write!(f, "its layer `{taken}`, the only one with colors, is the sky")
            }
            Self::Layer { taken, others } => write!(
                f,
                "its layer `{taken}` is the sky; `{}` could be too: save the one you want alone",
                others.join("`, `")
            ),
        }
    }
}

/// What images of these proportions often are.
fn guess(width: usize, height: usize) -> &'static str {
    let is = |across, down| width * down == height * across;
    if is(1, 1) {
        " (square ones are often light probes: mirror balls or angular maps)"
    } else if is(4, 3) || is(3, 4) {
        " (those of 4:3 are often the crosses of cube maps)"
    } else if is(6, 1) || is(1, 6) {
        " (those of 6:1 are often the faces of cube maps in a row)"
    } else {
        ""
    }
}
