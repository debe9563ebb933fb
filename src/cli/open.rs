//! Opening of shots' folders for a command, and the combined exit status of several shots.

use super::{Failed, MISTAKE, PictureArguments, failed, mistaken, misused};
use crate::shot::{self, Mistakes};
use crate::store::{FolderError, ShotFolder};
use serde_json::{Value, json};
use std::path::Path;

/// A shot whose folder could not be opened. The reason has been printed.
pub(super) struct Unopened {
    pub(super) failed: Failed,
    why: Why,
}

/// The reason, for the JSON output.
enum Why {
    Mistakes(Value),
    Words(String),
}

impl Unopened {
    /// Prints the reason.
    pub(super) fn say(why: &str) -> Self {
        Self {
            failed: failed(why),
            why: Why::Words(why.to_owned()),
        }
    }

    fn mistaken(mistakes: &Mistakes) -> Self {
        Self {
            failed: mistaken(mistakes),
            why: Why::Mistakes(mistakes.json()),
        }
    }

    /// The entry of the shot in the JSON output.
    pub(super) fn as_json(&self, shot: &Path) -> Value {
        let shot = shot.to_string_lossy();
        match &self.why {
            Why::Mistakes(mistakes) => json!({"shot": shot, "mistakes": mistakes}),
            Why::Words(words) => json!({"shot": shot, "error": words}),
        }
    }
}

/// Opens the folder of a shot's finished frames.
pub(super) fn open(path: &Path, pictures: &PictureArguments) -> Result<ShotFolder, Unopened> {
    let shot = shot::load(path).map_err(|m| Unopened::mistaken(&m))?;
    let request = pictures.request();
    if let Err(why) = request.check(&shot) {
        let failed = misused(&why);
        let why = Why::Words(why);
        return Err(Unopened { failed, why });
    }
    ShotFolder::open(&shot, &request).map_err(|error| match error {
        FolderError::Mistakes(mistakes) => Unopened::mistaken(&mistakes),
        error @ FolderError::Folder { .. } => Unopened::say(&error.to_string()),
    })
}

/// The worse of two failures: a mistake, which no retry will help.
pub(super) fn worse(old: Option<Failed>, new: Failed) -> Option<Failed> {
    Some(match old {
        Some(Failed(MISTAKE)) => Failed(MISTAKE),
        _ => new,
    })
}
