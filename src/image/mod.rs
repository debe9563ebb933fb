//! Image files: PNG and OpenEXR written, read back and compared.
//!
//! In: developed pixels and [`Metadata`]. Out: files as bytes in memory ([`png::encode`],
//! [`exr::encode`]); the pixels and metadata of files, also those of other programs ([`decode`],
//! [`fingerprint`]); differences of two images ([`compare`]). Pixels are row-major, top row first.
//! Equal input gives equal bytes for any number of threads, so no file holds a date, a host or a
//! duration.

pub mod compare;
pub mod decode;
mod error;
pub mod exr;
pub mod fingerprint;
mod metadata;
pub mod png;

pub use error::{EncodeError, value_count};
pub use metadata::{FINGERPRINT, Metadata, SOFTWARE, rational_rate};
