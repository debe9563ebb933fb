//! The background: a spectrum or an image all around, and stars in front of it.
//!
//! Directions are unit vectors away from the observer, in the sky's own axes: −z in the middle of
//! an image, +y up; columns and azimuths increase to the right.

mod background;
mod catalogue;
mod decode;
mod file;
mod image;
mod openexr;
mod primaries;
mod radiance;
mod random;
mod stars;
mod warning;

pub use background::Background;
pub use catalogue::{CatalogueError, Star};
pub use file::SkyImageError;
pub use image::{MOST_PIXELS, MOST_SIDES, SkyImage};
pub use random::random_stars;
pub use stars::{StarLight, Stars};
pub use warning::SkyWarning;
