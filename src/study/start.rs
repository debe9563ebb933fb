//! What to study, and the image that every setting starts from.

use super::timed_render::{Bodies, Variant};
use crate::render::Options;
use crate::shot::Shot;
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
