//! The starting point of all variants: the image with the settings of the shot.

use super::timed_render::{Bodies, Variant};
use crate::render::Options;
use crate::shot::Shot;
use std::sync::Arc;

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
