//! A folder with a shot of ten frames, rendered by the command itself, to be tampered with.

use crate::common::desk::{self as common, Outcome};
use restframe::film::{Developed, Layers};
use restframe::image::Metadata;
use restframe::image::exr::Depth;
use restframe::shot;
use restframe::store::{FileRecord, Record, Request, Seconds, ShotFolder};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};

/// Frames of the shot.
pub(crate) const FRAMES: u32 = 10;

/// A lit square that passes before a grey ground; HEAD and TAIL are what tests add.
const SHOT: &str = r#"
[shot]
title = "A square <passes> & goes"
frames = 10
fps = 24
HEAD
[worldline.square]
velocity = { from = [0, 0, 0], to = [0.1, 0, 0] }
[[model]]
file = "square.obj"
worldline = "square"
translate = { from = [-0.5, 0, 0], to = [0.5, 0.2, 0] }
material = "paint"
[material.paint]
diffuse = { weight = 1, spectrum = { rgb = [0.8, 0.3, 0.1] } }
[[light]]
kind = "sun"
direction = [0, 0, -1]
intensity = 250
[background]
spectrum = 0.0003
[camera]
position = [0, 0, 3]
[sensor]
exposure = 0
TAIL
"#;

/// The usual size and sampling.
pub(crate) const SMALL: &str = "[image]\nsize = [64, 64]\nsamples = 2";

/// A folder in which restframe is called.
pub(crate) struct Desk(common::Desk);

impl Desk {
    /// The shot with additions, rendered.
    pub(crate) fn new(head: &str, tail: &str) -> Self {
        let desk = Self(common::Desk::new());
        let square = "v -0.5 -0.5 0\nv 0.5 -0.5 0\nv 0.5 0.5 0\nv -0.5 0.5 0\nf 1 2 3 4\n";
        fs::write(desk.path("square.obj"), square).unwrap();
        // Nothing is assembled yet.
        let (before, _) = tail.split_once("[sequence]").unwrap_or((tail, ""));
        desk.write_shot(head, &format!("{before}\n[sequence]\npage = false\n"));
        let rendered = desk.call(&["render", "passing.toml", "--progress", "none"]);
        assert_eq!(rendered.status, 0, "{}", rendered.stderr);
        desk.write_shot(head, tail);
        desk
    }

    /// Small frames in PNG, assembled as told.
    pub(crate) fn small(sequence: &str) -> Self {
        Self::new(SMALL, &format!("[sequence]\n{sequence}"))
    }

    pub(crate) fn write_shot(&self, head: &str, tail: &str) {
        let text = SHOT.replace("HEAD", head).replace("TAIL", tail);
        fs::write(self.path("passing.toml"), text).unwrap();
    }

    /// A file of the desk.
    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path(name)
    }

    /// A file beside the frames.
    pub(crate) fn file(&self, name: &str) -> PathBuf {
        self.path("renders/passing").join(name)
    }

    /// The names beside the frames of what begins like it.
    pub(crate) fn names(&self, suffix: &str) -> Vec<String> {
        let entries = fs::read_dir(self.path("renders/passing")).unwrap();
        let mut names: Vec<String> = entries
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .filter(|name| name.ends_with(suffix))
            .collect();
        names.sort();
        names
    }

    /// Calls restframe in the folder.
    pub(crate) fn call(&self, arguments: &[&str]) -> Outcome {
        self.call_with_path(arguments, &std::env::var("PATH").unwrap_or_default())
    }

    /// Calls restframe with programs looked for in other folders.
    pub(crate) fn call_with_path(&self, arguments: &[&str], path: &str) -> Outcome {
        let mut command = self.0.command("");
        Outcome::of_call(command.args(arguments).env("PATH", path))
    }

    /// Puts a program called ffmpeg into a folder, which gets first in the path that is returned.
    #[cfg(unix)]
    pub(crate) fn with_ffmpeg(&self, script: &str) -> String {
        use std::os::unix::fs::PermissionsExt;
        let folder = self.path("bin");
        fs::create_dir_all(&folder).unwrap();
        let program = folder.join("ffmpeg");
        fs::write(&program, script).unwrap();
        fs::set_permissions(&program, fs::Permissions::from_mode(0o755)).unwrap();
        let path = std::env::var("PATH").unwrap_or_default();
        format!("{}:{path}", folder.display())
    }

    pub(crate) fn verify(&self) -> Outcome {
        self.call(&["verify", "passing.toml"])
    }

    pub(crate) fn assemble(&self) -> Outcome {
        self.call(&["assemble", "passing.toml"])
    }

    /// What verify finds, as `kind file`, all of it.
    pub(crate) fn findings(&self) -> Vec<String> {
        let told = self.call(&["verify", "passing.toml", "--json"]);
        let report: Value = serde_json::from_str(&told.stdout).unwrap();
        let findings = report["shots"][0]["findings"].as_array().unwrap();
        assert_eq!(told.status, i32::from(!findings.is_empty()));
        let word = |finding: &Value, key: &str| finding[key].as_str().unwrap().to_owned();
        findings
            .iter()
            .map(|finding| format!("{} {}", word(finding, "kind"), word(finding, "file")))
            .collect()
    }

    /// The shot's frames.
    pub(crate) fn shot_folder(&self) -> ShotFolder {
        let shot = shot::load(&self.path("passing.toml")).unwrap();
        let request = Request {
            out: self.path("renders"),
            scale: 1.0,
            samples: None,
        };
        ShotFolder::open(&shot, &request).unwrap()
    }

    /// Records every frame as it is now, as if it had been rendered so.
    pub(crate) fn record(&self) {
        record(&self.shot_folder());
    }

    /// The 8-bit values of a frame's PNG.
    pub(crate) fn frame(&self, frame: u32) -> image::RgbImage {
        open(&self.file(&format!("passing.{frame:04}.png")))
    }

    /// Writes an EXR in place of a frame's, of one value everywhere but in its first pixel.
    pub(crate) fn put_exr(&self, frame: u32, size: [u32; 2], first: f32) {
        let mut linear = vec![[0.25; 3]; (size[0] * size[1]) as usize];
        linear[0][1] = first;
        let developed = Developed {
            linear,
            saturated: 0,
        };
        let (layers, metadata) = (Layers::default(), self.metadata(frame));
        let [width, height] = size;
        let bytes = restframe::image::exr::encode(
            width,
            height,
            &developed,
            Depth::Float,
            &layers,
            &metadata,
        )
        .unwrap();
        fs::write(self.file(&format!("passing.{frame:04}.exr")), bytes).unwrap();
    }

    /// Writes a PNG in place of a frame's.
    pub(crate) fn put_png(&self, frame: u32, picture: &image::RgbImage) {
        let path = self.file(&format!("passing.{frame:04}.png"));
        let (width, height) = picture.dimensions();
        let metadata = self.metadata(frame);
        let bytes =
            restframe::image::png::encode(width, height, picture.as_raw(), &metadata).unwrap();
        fs::write(path, bytes).unwrap();
    }

    /// What a picture says of itself that is of this frame, as the shot stands.
    fn metadata(&self, frame: u32) -> Metadata {
        Metadata {
            fingerprint: Some(self.shot_folder().keys.frame(frame).fingerprint),
            ..Metadata::default()
        }
    }

    /// Cuts a file off after a share of its bytes.
    pub(crate) fn cut(&self, name: &str, share: f64) {
        let bytes = fs::read(self.file(name)).unwrap();
        let length = (bytes.len() as f64 * share) as usize;
        fs::write(self.file(name), &bytes[..length]).unwrap();
    }
}

/// A picture of 8 bits a channel, by a decoder of the `image` crate.
pub(crate) fn open(path: &Path) -> image::RgbImage {
    image::ImageReader::open(path)
        .unwrap()
        .with_guessed_format()
        .unwrap()
        .decode()
        .unwrap()
        .into_rgb8()
}

/// Root mean square of the difference of two pictures, levels.
pub(crate) fn apart(a: &[u8], b: &[u8]) -> f64 {
    assert_eq!(a.len(), b.len());
    let squares = a
        .iter()
        .zip(b)
        .map(|(a, b)| f64::from(a.abs_diff(*b)).powi(2));
    (squares.sum::<f64>() / a.len() as f64).sqrt()
}

/// Records every frame of a shot_folder as it is now, as if it had been rendered so.
pub(crate) fn record(shot_folder: &ShotFolder) {
    let mut lines = String::new();
    for frame in 1..=shot_folder.shot().shot.frames {
        let key = shot_folder.keys.frame(frame);
        let files = shot_folder.files(frame).into_iter().filter_map(|name| {
            let bytes = fs::read(shot_folder.path.join(&name)).ok()?;
            Some(FileRecord {
                name,
                bytes: bytes.len() as u64,
                blake3: blake3::hash(&bytes).to_hex().to_string(),
            })
        });
        let record = Record {
            frame,
            fingerprint: key.fingerprint,
            parts: key.inputs,
            files: files.collect(),
            size: shot_folder.keys.resolution().size,
            samples: shot_folder.keys.resolution().samples,
            effects: Vec::new(),
            trace: key.trace,
            shared: 1,
            exposure: 0.0,
            seconds: Seconds::default(),
            warnings: Vec::new(),
            cut: 0.0,
            memory_mib: None,
            threads: 1,
            host: "desk".to_owned(),
            version: "0".to_owned(),
            // Later than any other record.
            finished: "9999-01-01T00:00:00Z".to_owned(),
        };
        lines += &serde_json::to_string(&record).unwrap();
        lines.push('\n');
    }
    let name = shot_folder.names.manifest(Some([9, 9]));
    fs::write(shot_folder.path.join(name), lines).unwrap();
}
