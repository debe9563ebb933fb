//! A folder with shots, in which the program is called.

use crate::common::desk::{Desk, Outcome};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// A sphere that speeds up: no two frames share a trace.
pub(crate) const PASSING: &str = r#"
[shot]
frames = 20
[image]
size = [64, 36]
samples = 4
[worldline.passing]
velocity = { from = [0, 0, 0], to = [0.8, 0, 0] }
[[model]]
file = "sphere.obj"
worldline = "passing"
[[light]]
kind = "point"
position = [0, 2, 4]
intensity = 1000
[camera]
position = [0, 0, 5]
look_at = [0, 0, 0]
"#;

/// A sphere that grows hot at rest: all frames share a trace.
pub(crate) const GLOWING: &str = r#"
[shot]
frames = 6
[image]
size = [48, 27]
samples = 2
[[model]]
file = "sphere.obj"
[material.red]
thermal = { temperature = { from = 1000, to = 3000 } }
[camera]
position = [0, 0, 5]
look_at = [0, 0, 0]
[sensor]
exposure = -4
[output]
formats = ["png", "exr"]
"#;

/// A folder with `passing.toml`, `glowing.toml` and their model.
pub(crate) fn passing() -> Desk {
    let desk = Desk::with_sphere();
    desk.write("passing.toml", PASSING);
    desk.write("glowing.toml", GLOWING);
    desk
}

impl Desk {
    /// Names of all files below a folder, hidden ones too.
    pub(crate) fn names(&self, folder: &str) -> Vec<String> {
        let mut names = Vec::new();
        walk(&self.path(folder), &mut names);
        let root = self.path(folder);
        let name = |path: PathBuf| path.strip_prefix(&root).unwrap().display().to_string();
        let mut names: Vec<String> = names.into_iter().map(name).collect();
        names.sort();
        names
    }

    /// Pictures below a folder with their bytes.
    pub(crate) fn pictures(&self, folder: &str) -> BTreeMap<String, Vec<u8>> {
        let names = self.names(folder).into_iter();
        names
            .filter(|name| name.ends_with(".png") || name.ends_with(".exr"))
            .map(|name| {
                (
                    name.clone(),
                    fs::read(self.path(folder).join(name)).unwrap(),
                )
            })
            .collect()
    }

    /// Whether any file below a folder is one that was being written, or a lock.
    pub(crate) fn has_leftovers(&self, folder: &str) -> bool {
        let names = self.names(folder).into_iter();
        names
            .into_iter()
            .any(|name| name.ends_with(".tmp") || name.contains(".locks"))
    }

    /// Frames in all records of a shot's manifests, in their order.
    pub(crate) fn recorded(&self, folder: &str) -> Vec<u64> {
        let mut frames = Vec::new();
        for name in self.names(folder) {
            if name.ends_with(".jsonl") && name.contains(".manifest.") {
                let text = fs::read_to_string(self.path(folder).join(name)).unwrap();
                let lines = text
                    .lines()
                    .filter_map(|l| serde_json::from_str::<Value>(l).ok());
                frames.extend(lines.filter_map(|line| line["frame"].as_u64()));
            }
        }
        frames
    }
}

fn walk(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).into_iter().flatten() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            walk(&path, files);
        } else {
            files.push(path);
        }
    }
}

impl Outcome {
    /// The events on standard output.
    pub(crate) fn events(&self) -> Vec<Value> {
        events(&self.stdout)
    }

    /// Frames that events tell of with this status.
    pub(crate) fn frames(&self, status: &str) -> Vec<u64> {
        let events = self.events().into_iter();
        events
            .filter(|event| event["event"] == "frame" && event["status"] == status)
            .map(|event| event["frame"].as_u64().unwrap())
            .collect()
    }
}

/// Each line an object of JSON with its kind.
pub(crate) fn events(text: &str) -> Vec<Value> {
    text.lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .inspect(|event: &Value| assert!(event["event"].is_string(), "{event}"))
        .collect()
}
