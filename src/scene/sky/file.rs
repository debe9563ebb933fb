//! What every format of sky images has in common: pixels, limits, and why a file is no sky.

use super::SkyWarning;
use super::image::{MOST_PIXELS, MOST_SIDES};
use super::primaries::Primaries;

/// Longest file, bytes.
pub(super) const LARGEST_FILE: u64 = 2 << 30;

/// Why a file is no sky.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SkyImageError {
    /// It could not be read.
    #[error("the image cannot be read: {0}")]
    Read(#[from] std::io::Error),
    /// More bytes than are read.
    #[error("the image is a file of more than {LARGEST_FILE} bytes: make it smaller")]
    LongFile,
    /// Nothing is in it.
    #[error("the image is an empty file")]
    Empty,
    /// It does not begin as any format that is read.
    #[error(
        "the image is in no format that is read: expected Radiance HDR (#?RADIANCE), OpenEXR or PNG"
    )]
    Format,
    /// The decoder refused.
    #[error("the image is broken, or not read in this form: {0}")]
    Broken(String),
    /// A line of a Radiance file's header.
    #[error("the image's header says `{line}`: expected {expected}")]
    Header {
        /// The line.
        line: String,
        /// What should stand in it.
        expected: &'static str,
    },
    /// An OpenEXR file without colors.
    #[error("the image has no channels R, G and B, nor Y, but {0}")]
    NoPicture(String),
    /// An OpenEXR file with more pictures than one.
    #[error("the image has several layers of colors, of which any could be the sky: {0}")]
    Layers(String),
    /// An OpenEXR file of luminance and chroma.
    #[error(
        "the image's colors are luminance and chroma, or have fewer pixels in some channels (of {0}): that is not read"
    )]
    Subsampled(String),
    /// Too many pixels, or none.
    #[error(
        "the image says it has {width} x {height} pixels: expected at least 1 x 1, at most {} x {} and {MOST_PIXELS} in all",
        MOST_SIDES[0], MOST_SIDES[1]
    )]
    Size {
        /// Columns.
        width: u64,
        /// Rows.
        height: u64,
    },
    /// An OpenEXR file that has too many pixels beyond its display window.
    #[error(
        "the image's data window is of {width} x {height} pixels: expected at most {} x {} and {MOST_PIXELS} in all",
        MOST_SIDES[0], MOST_SIDES[1]
    )]
    DataWindow {
        /// Columns.
        width: u64,
        /// Rows.
        height: u64,
    },
    /// Memory is short.
    #[error("the image needs {0} bytes of memory, more than there are: make it smaller")]
    Memory(u64),
}

impl SkyImageError {
    /// What a decoder refuses.
    pub(super) fn broken(error: impl ToString) -> Self {
        Self::Broken(error.to_string())
    }

    /// What to do about it.
    pub fn remedy(&self) -> &'static str {
        match self {
            Self::Read(_) => "see that the file may be read",
            Self::Empty | Self::Format => "name a panorama as Radiance HDR, OpenEXR or PNG",
            Self::LongFile | Self::Size { .. } | Self::Memory(_) => {
                "save the panorama with fewer pixels"
            }
            Self::DataWindow { .. } => "save it cropped to its display window",
            Self::Broken(_) => "copy the file again, or save it as a flat OpenEXR of R, G and B",
            Self::Header { .. } => "save the file again, or mend that line in it",
            Self::NoPicture(_) | Self::Layers(_) => {
                "save the picture alone, as R, G and B (in Blender \"OpenEXR\", not \"OpenEXR MultiLayer\")"
            }
            Self::Subsampled(_) => "save it as R, G and B",
        }
    }
}

/// What a file holds.
pub(super) struct Pixels {
    pub(super) width: usize,
    /// By rows from the top.
    pub(super) texels: Vec<[f32; 3]>,
    /// What the colors are; None where the file does not say.
    pub(super) primaries: Option<Primaries>,
    pub(super) warnings: Vec<SkyWarning>,
}

/// That a picture may have so many columns and rows, and that there is memory for as many bytes a
/// pixel: refused here with a message, rather than by the system when pixels are unpacked.
pub(super) fn check_size([width, height]: [u64; 2], bytes: u64) -> Result<(), SkyImageError> {
    let [most_columns, most_rows] = MOST_SIDES.map(u64::from);
    let sides = (1..=most_columns).contains(&width) && (1..=most_rows).contains(&height);
    if !(sides && width * height <= MOST_PIXELS) {
        return Err(SkyImageError::Size { width, height });
    }
    check_memory(width * height * bytes)
}

/// That there is memory for so many bytes.
pub(super) fn check_memory(bytes: u64) -> Result<(), SkyImageError> {
    Vec::<u8>::new()
        .try_reserve_exact(bytes as usize)
        .map_err(|_| SkyImageError::Memory(bytes))
}
