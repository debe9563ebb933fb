//! Shared by all formats of sky images: pixels, limits, errors.

use super::SkyWarning;
use super::image::{MOST_PIXELS, MOST_SIDES};
use super::primaries::Primaries;

/// Size of the largest file, bytes.
pub(super) const LARGEST_FILE: u64 = 2 << 30;

/// Reason why a file cannot be used as a sky.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SkyImageError {
    /// It cannot be read.
    #[error("the image cannot be read: {0}")]
    Read(#[from] std::io::Error),
    /// It has more bytes than are read.
    #[error("the image is a file of more than {LARGEST_FILE} bytes: make it smaller")]
    LongFile,
    /// It is empty.
    #[error("the image is an empty file")]
    Empty,
    /// It has an unknown format.
    #[error(
        "the image is in no format that is read: expected Radiance HDR (#?RADIANCE), OpenEXR or PNG"
    )]
    Format,
    /// The decoder failed.
    #[error("the image is broken, or not read in this form: {0}")]
    Broken(String),
    /// A line of a Radiance file's header is invalid.
    #[error("the image's header says `{line}`: expected {expected}")]
    Header {
        /// The line.
        line: String,
        /// Expected content.
        expected: &'static str,
    },
    /// An OpenEXR file has no colors.
    #[error("the image has no channels R, G and B, nor Y, but {0}")]
    NoPicture(String),
    /// An OpenEXR file has several images.
    #[error("the image has several layers of colors, of which any could be the sky: {0}")]
    Layers(String),
    /// An OpenEXR file has luminance and chroma.
    #[error(
        "the image's colors are luminance and chroma, or have fewer pixels in some channels (of {0}): that is not read"
    )]
    Subsampled(String),
    /// There are too many pixels, or none.
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
    /// An OpenEXR file has too many pixels beyond its display window.
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
    /// There is not enough memory.
    #[error("the image needs {0} bytes of memory, more than there are: make it smaller")]
    Memory(u64),
}

impl SkyImageError {
    /// An error of a decoder.
    pub(super) fn broken(error: impl ToString) -> Self {
        Self::Broken(error.to_string())
    }

    /// Remedy.
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

/// Contents of a file.
pub(super) struct Pixels {
    pub(super) width: usize,
    /// Texels by rows from the top.
    pub(super) texels: Vec<[f32; 3]>,
    /// Primaries of the colors; None if the file does not state them.
    pub(super) primaries: Option<Primaries>,
    pub(super) warnings: Vec<SkyWarning>,
}

/// Checks that an image may have this size, and that there is memory for so many bytes per pixel,
/// so that a message refuses it and not the system while pixels are unpacked.
pub(super) fn check_size([width, height]: [u64; 2], bytes: u64) -> Result<(), SkyImageError> {
    let [most_columns, most_rows] = MOST_SIDES.map(u64::from);
    let sides = (1..=most_columns).contains(&width) && (1..=most_rows).contains(&height);
    if !(sides && width * height <= MOST_PIXELS) {
        return Err(SkyImageError::Size { width, height });
    }
    check_memory(width * height * bytes)
}

/// Checks that there is memory for so many bytes.
pub(super) fn check_memory(bytes: u64) -> Result<(), SkyImageError> {
    Vec::<u8>::new()
        .try_reserve_exact(bytes as usize)
        .map_err(|_| SkyImageError::Memory(bytes))
}
