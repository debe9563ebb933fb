//! The frame numbers in the `keys` of a track: they ascend, and are frames of the shot.

use super::value::as_number;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A key whose frame number is wrong.
pub(super) struct MistakenKey {
    /// Its index in `keys`, from 0.
    pub(super) index: usize,
    pub(super) message: String,
    pub(super) help: &'static str,
}

/// The keys of a track whose frame is not one of the shot's, or not after that of the key before.
pub(super) fn mistaken_keys(table: &DeTable<'_>, last_frame: Option<f64>) -> Vec<MistakenKey> {
    let Some(DeValue::Array(keys)) = table.get("keys").map(Spanned::get_ref) else {
        return Vec::new();
    };
    let mut mistaken = Vec::new();
    let mut previous = f64::NEG_INFINITY;
    for (index, key) in keys.iter().enumerate() {
        let Some(frame) = key
            .get_ref()
            .as_array()
            .and_then(|pair| as_number(pair.first()?.get_ref()))
        else {
            continue; // the walk reports it
        };
        if let Some(last) = last_frame
            && !(1.0..=last).contains(&frame)
        {
            mistaken.push(MistakenKey {
                index,
                message: format!("key at frame {frame}, but the shot's frames are 1 to {last}"),
                help: "move the key or change `shot.frames`",
            });
        } else if frame <= previous {
            mistaken.push(MistakenKey {
                index,
                message: format!("key at frame {frame} after one at frame {previous}"),
                help: "frames of keys must strictly ascend",
            });
        }
        previous = frame;
    }
    mistaken
}

/// The shot's number of frames as authored; None if it is mistaken itself, since keys cannot be
/// checked against it then.
pub(super) fn last_frame(tree: &DeTable<'_>) -> Option<f64> {
    match tree
        .get("shot")
        .and_then(|shot| shot.get_ref().get("frames"))
    {
        None => Some(1.0),
        Some(frames) => as_number(frames.get_ref()).filter(|frames| *frames >= 1.0),
    }
}
