//! A folder with shots, in which the program is called.

use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use tempfile::TempDir;

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

/// The folder.
pub(crate) struct Desk(TempDir);

impl Desk {
    /// With `passing.toml`, `glowing.toml` and their model.
    pub(crate) fn new() -> Self {
        let desk = Self(tempfile::tempdir().unwrap());
        let assets = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets");
        for name in ["sphere.obj", "sphere.mtl"] {
            fs::copy(assets.join(name), desk.path(name)).unwrap();
        }
        desk.write("passing.toml", PASSING);
        desk.write("glowing.toml", GLOWING);
        desk
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub(crate) fn write(&self, name: &str, text: &str) {
        fs::write(self.path(name), text).unwrap();
    }

    /// The program, to be called with arguments that blanks part.
    pub(crate) fn command(&self, arguments: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_restframe"));
        command
            .args(arguments.split_whitespace())
            .current_dir(self.0.path())
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        command
    }

    pub(crate) fn spawn(&self, arguments: &str) -> Child {
        self.command(arguments).spawn().unwrap()
    }

    pub(crate) fn call(&self, arguments: &str) -> Outcome {
        Outcome::of(self.command(arguments).output().unwrap())
    }

    /// Runs a line of shell, in which `$restframe` is the program.
    pub(crate) fn shell(&self, line: &str) -> Outcome {
        let mut command = Command::new("bash");
        command
            .args(["-c", line])
            .current_dir(self.0.path())
            .env("restframe", env!("CARGO_BIN_EXE_restframe"));
        Outcome::of(command.output().unwrap())
    }

    /// A call that must succeed.
    pub(crate) fn done(&self, arguments: &str) -> Outcome {
        let outcome = self.call(arguments);
        assert_eq!(outcome.status, Some(0), "{}", outcome.stderr);
        outcome
    }

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

/// How a call ended, and what it said.
pub(crate) struct Outcome {
    pub(crate) status: Option<i32>,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

impl Outcome {
    pub(crate) fn of(output: Output) -> Self {
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert!(!stderr.contains("panicked"), "{stderr}");
        Self {
            status: output.status.code(),
            stdout: String::from_utf8(output.stdout).unwrap(),
            stderr,
        }
    }

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
