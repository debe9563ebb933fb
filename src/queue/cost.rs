//! Cost of frames: seconds, from those of similar frames; memory and disk.
//!
//! Seconds are proportional to pixels × samples, so each finished frame gives a rate for the
//! effects with which it was rendered. A frame is estimated by the mean rate of this shot's frames
//! with the same effects, else of any of this shot, else of the other shots in the same folder,
//! else by a guess.

use super::memory::image_bytes;
use crate::frame::Resolution;
use crate::shot::{Format, Shot};
use crate::store::{Names, Record, ShotFolder, read_records};
use std::collections::HashMap;
use std::fs;
use std::path::Path;

/// Default rates, seconds per ray, if nothing has been measured: those of the gallery's rows.toml
/// in a release build on two cores. Other scenes take a tenth to ten times as long; estimates are
/// then marked as guesses.
const GUESSED: Rate = Rate {
    trace: 4e-7,
    shade: 7e-8,
};

/// Estimated bytes per pixel of a PNG, and bytes of its metadata.
const PNG_BYTES: [u64; 2] = [1, 4096];

/// Estimated bytes per value of an EXR: compression removes about half.
const EXR_BYTES: u64 = 2;

/// Memory of a mesh and its trees relative to the bytes of its file, estimated on the high side: a
/// triangle takes 72 bytes, its vertices and box about as much, and some 30 bytes of an indexed
/// glb.
const MESH_FACTOR: u64 = 5;

/// Memory of the program itself, of threads, tables and the allocator: 90 MiB, by which three
/// frames of 2560 x 1440 as PNG and EXR, 390 MiB, are estimated as 393.
const PROGRAM_BYTES: u64 = 90 << 20;

/// Seconds per ray, by phase.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
struct Rate {
    /// From the camera to shade trees, with preparation.
    trace: f64,
    /// From shade trees to files.
    shade: f64,
}

/// Rates of some finished frames.
#[derive(Debug, Clone, Copy, Default)]
struct Mean {
    sum: Rate,
    frames: f64,
}

impl Mean {
    fn add(&mut self, rate: Rate) {
        self.sum.trace += rate.trace;
        self.sum.shade += rate.shade;
        self.frames += 1.0;
    }

    fn rate(&self) -> Option<Rate> {
        (self.frames > 0.0).then(|| Rate {
            trace: self.sum.trace / self.frames,
            shade: self.sum.shade / self.frames,
        })
    }
}

/// Estimated cost of one frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// Wall-clock seconds until its shade trees exist; frames that share them take this once.
    pub trace: f64,
    /// Wall-clock seconds from shade trees to files.
    pub shade: f64,
    /// Whether it is based on frames finished here; otherwise it is a guess.
    pub measured: bool,
}

impl Estimate {
    /// Seconds of a frame on its own.
    pub fn seconds(&self) -> f64 {
        self.trace + self.shade
    }
}

/// Rates from finished frames.
#[derive(Debug, Clone, Default)]
pub struct Costs {
    by_effects: HashMap<Vec<String>, Mean>,
    own: Mean,
    others: Mean,
}

impl Costs {
    /// Rates from the frames of a shot or, if it has none, from those in the folders beside its
    /// own. A folder that cannot be read gives none.
    pub fn new(shot_folder: &ShotFolder) -> Self {
        let mut costs = Self::default();
        shot_folder
            .records
            .values()
            .for_each(|record| costs.learn(record));
        if shot_folder.records.is_empty()
            && let Some(out) = shot_folder.path.parent()
        {
            costs.learn_from_others(out);
        }
        costs
    }

    /// Counts a finished frame of this shot.
    pub fn learn(&mut self, record: &Record) {
        if let Some(rate) = rate_of(record) {
            let effects = record.effects.clone();
            self.by_effects.entry(effects).or_default().add(rate);
            self.own.add(rate);
        }
    }

    fn learn_from_others(&mut self, out: &Path) {
        let entries = fs::read_dir(out).into_iter().flatten();
        for entry in entries.filter_map(Result::ok) {
            let stem = entry.file_name().to_string_lossy().into_owned();
            let records = read_records(&entry.path(), &Names::of_stem(stem));
            for rate in records.unwrap_or_default().values().filter_map(rate_of) {
                self.others.add(rate);
            }
        }
    }

    /// Estimate for a frame with these effects and this size.
    pub fn estimate(&self, effects: &[String], picture: Resolution) -> Estimate {
        let same = self.by_effects.get(effects).and_then(Mean::rate);
        let known = same
            .or_else(|| self.own.rate())
            .or_else(|| self.others.rate());
        let Rate { trace, shade } = known.unwrap_or(GUESSED);
        let rays = rays(picture.size, picture.samples);
        Estimate {
            trace: trace * rays,
            shade: shade * rays,
            measured: known.is_some(),
        }
    }

    /// Seconds for a frame with these effects and this size on its own.
    pub fn seconds(&self, effects: &[String], picture: Resolution) -> f64 {
        self.estimate(effects, picture).seconds()
    }
}

fn rays([width, height]: [u32; 2], samples: u32) -> f64 {
    f64::from(width) * f64::from(height) * f64::from(samples)
}

/// The seconds per ray of a finished frame. It has only its share of a shared trace.
fn rate_of(record: &Record) -> Option<Rate> {
    let seconds = &record.seconds;
    let rays = rays(record.size, record.samples);
    let whole = f64::from(record.shared.max(1));
    let rate = Rate {
        trace: (seconds.prepare + seconds.trace) * whole / rays,
        shade: (seconds.shade + seconds.encode + seconds.write) / rays,
    };
    let sane = |seconds: f64| seconds.is_finite() && seconds >= 0.0;
    (sane(rate.trace) && sane(rate.shade)).then_some(rate)
}

/// Bytes of the files of a frame: the average of finished ones of this size, else that of typical
/// images.
pub fn frame_bytes(shot_folder: &ShotFolder) -> u64 {
    let picture = shot_folder.keys.resolution();
    let alike = |record: &&Record| record.size == picture.size;
    let sizes: Vec<u64> = shot_folder
        .records
        .values()
        .filter(alike)
        .map(|record| {
            record
                .files
                .iter()
                .map(|file| file.bytes)
                .fold(0, u64::saturating_add)
        })
        .collect();
    if let Some(mean) = sizes
        .iter()
        .fold(0, |sum: u64, bytes| sum.saturating_add(*bytes))
        .checked_div(sizes.len() as u64)
    {
        return mean;
    }
    let output = &shot_folder.shot().output;
    let pixels = pixels(picture);
    let of_format = |format: &Format| match format {
        Format::Png => PNG_BYTES[0] * pixels + PNG_BYTES[1],
        Format::Exr => EXR_BYTES * (3 + output.layers.len() as u64) * pixels,
    };
    output.formats.iter().map(of_format).sum()
}

/// Bytes of memory for rendering: the images of as many frames as are in work at once, on this many
/// threads, and the meshes.
pub fn memory_bytes(shot_folder: &ShotFolder, films: usize, threads: usize) -> u64 {
    let meshes = MESH_FACTOR.saturating_mul(model_bytes(shot_folder.shot()));
    PROGRAM_BYTES
        .saturating_add(image_bytes(&shot_folder.options, films, threads))
        .saturating_add(meshes)
}

fn pixels(picture: Resolution) -> u64 {
    picture.size.map(u64::from).iter().product()
}

/// Bytes of the model files, each counted once.
fn model_bytes(shot: &Shot) -> u64 {
    let files: std::collections::BTreeSet<&Path> = shot
        .model
        .iter()
        .map(|model| model.file.as_path())
        .collect();
    let length = |file: &Path| fs::metadata(shot.beside(file)).map_or(0, |about| about.len());
    files.into_iter().map(length).sum()
}
