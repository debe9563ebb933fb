//! The frames of a ramp's keys: they ascend, and are frames of the shot.

use super::value::as_number;
use super::{At, Walk};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

impl Walk<'_> {
    /// The frames of a ramp's keys: ascending, and frames of the shot.
    pub(super) fn check_keys(&mut self, table: &DeTable<'_>, at: &At) {
        let Some(DeValue::Array(keys)) = table.get("keys").map(Spanned::get_ref) else {
            return;
        };
        let mut previous = f64::NEG_INFINITY;
        for (i, key) in keys.iter().enumerate() {
            let Some(frame) = key
                .get_ref()
                .as_array()
                .and_then(|pair| as_number(pair.first()?.get_ref()))
            else {
                continue;
            };
            let here = at.key("keys").index(i).index(0);
            if let Some(last) = self.last_frame
                && !(1.0..=last).contains(&frame)
            {
                let message =
                    format!("key at frame {frame}, but the shot's frames are 1 to {last}");
                self.say(
                    &here,
                    message,
                    Some("move the key or change `shot.frames`".into()),
                );
            } else if frame <= previous {
                let message = format!("key at frame {frame} after one at frame {previous}");
                self.say(
                    &here,
                    message,
                    Some("frames of keys must strictly ascend".into()),
                );
            }
            previous = frame;
        }
    }
}

/// The number of frames as authored, if that can be said: keys are held against it.
pub(super) fn last_frame(tree: &DeTable<'_>) -> Option<f64> {
    match tree
        .get("shot")
        .and_then(|shot| shot.get_ref().get("frames"))
    {
        None => Some(1.0),
        Some(frames) => as_number(frames.get_ref()).filter(|frames| *frames >= 1.0),
    }
}
