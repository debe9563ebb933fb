//! What to study, and the image that every setting starts from.

use super::timed_render::{Bodies, Variant};
use crate::image::EncodeError;
use crate::image::compare::CompareError;
use crate::render::Options;
use crate::shot::{Mistakes, Shot};
use std::path::PathBuf;
use std::sync::Arc;

/// What to study.
#[derive(Debug, Clone)]
pub struct Request {
    /// Frame number, one of those of the shot.
    pub frame: u32,
    /// Size and samples of the image.
    pub options: Options,
    /// Number of renders of each setting, at least 1.
    pub repeats: u32,
    /// Scratch folder; its files are written only to time writing.
    pub scratch: PathBuf,
}

/// Reason why a study failed.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    /// The shot has a mistake that shows in this frame.
    #[error("the shot has mistakes")]
    Mistakes(#[from] Mistakes),
    /// An image could not be encoded.
    #[error(transparent)]
    Encode(#[from] EncodeError),
    /// A file could not be written.
    #[error("{0}")]
    Write(#[from] std::io::Error),
    /// A file that was written could not be read back.
    #[error("a picture just written cannot be read: {0}")]
    Read(#[from] image::ImageError),
    /// Two images could not be compared.
    #[error(transparent)]
    Compare(#[from] CompareError),
}

/// The image with the settings of the shot, from which every variant starts.
#[derive(Clone)]
pub(crate) struct Start<'a> {
    pub(super) shot: &'a Shot,
    pub(super) frame: u32,
    pub(super) options: Options,
    pub(super) bodies: Arc<Bodies>,
}

impl Start<'_> {
    /// A variant that does not differ yet.
    pub(super) fn variant(&self, setting: String, toml: Option<String>) -> Variant {
        Variant {
            setting,
            family: String::new(),
            toml,
            current: false,
            shot: self.shot.clone(),
            bodies: Arc::clone(&self.bodies),
            options: self.options.clone(),
        }
    }

    /// The shot unchanged.
    pub(super) fn as_it_is(&self) -> Variant {
        Variant {
            family: "as it is".to_owned(),
            current: true,
            ..self.variant("as it is".to_owned(), None)
        }
    }
}
