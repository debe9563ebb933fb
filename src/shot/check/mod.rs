//! The checks that need more than one key, the author's names or the disk.
//!
//! Each file here looks at one part of the shot and says what is wrong with it. What the walk
//! found mistaken is absent from the shot by now: whether its author gave a key is asked of
//! the file's places, which names there are of the walk.

mod bodies;
mod camera;
mod insets;
mod lights;
mod materials;
mod sky;
mod spectra;

use super::file_names;
use super::mistake::Mistake;
use super::names::{did_you_mean, short};
use super::track::Blend;
use super::walk::Walk;
use super::{Shot, Spectra, Track};
use crate::spectrum::{LINES_NM, LineAxis};
use std::collections::HashMap;
use std::path::Path;

pub use bodies::MAX_INSTANCES;
pub use spectra::ILLUMINANTS;

/// Least ratio of a window's ends: an axis of 4096 wavelengths in it is still far from the rounding
/// of their logarithms.
const NARROWEST: f64 = 1.000_001;

/// Most frames of which relations between moving values are checked one by one.
const MAX_FRAMES: u32 = 10_000;

/// All mistakes of a shot: those that the walk has found and those that follow here.
pub(super) fn check(shot: &Shot, walk: Walk<'_>) -> Vec<Mistake> {
    let Walk {
        mistakes,
        names,
        kept,
        ..
    } = walk;
    let mut checks = Checks {
        shot,
        names,
        kept,
        mistakes,
    };
    checks.settings();
    checks.worldlines();
    checks.models();
    checks.spectra();
    checks.materials();
    checks.lights();
    checks.sky();
    checks.camera();
    checks.insets();
    checks.mistakes
}

struct Checks<'a> {
    shot: &'a Shot,
    names: HashMap<String, Vec<String>>,
    kept: HashMap<String, Vec<usize>>,
    mistakes: Vec<Mistake>,
}

impl<'a> Checks<'a> {
    fn say(&mut self, key: &str, message: String, help: &str) {
        self.push(key, message, Some(help.to_owned()));
    }

    fn push(&mut self, key: &str, message: String, help: Option<String>) {
        self.mistakes
            .push(self.shot.places.mistake(key, message, help));
    }

    /// Whether the author wrote the key, be its value mistaken or not.
    fn given(&self, key: &str) -> bool {
        self.shot.places.has(key)
    }

    /// The entries of a list with their key paths in the file.
    fn each<T>(&self, key: &str, list: &'a [T]) -> Vec<(String, &'a T)> {
        let kept = self.kept.get(key);
        let index = |i: usize| kept.and_then(|kept| kept.get(i)).copied().unwrap_or(i);
        list.iter()
            .enumerate()
            .map(|(i, entry)| (format!("{key}[{}]", index(i)), entry))
            .collect()
    }

    /// The author's names in a table of names.
    fn named(&self, table: &str) -> &[String] {
        self.names.get(table).map_or(&[], Vec::as_slice)
    }

    /// Says that `name` is none of those in `table` nor of the format's own.
    fn check_name(&mut self, key: &str, what: &str, name: &str, table: &str, own: &[&str]) {
        let known = self.named(table);
        if own.contains(&name) || known.iter().any(|known| known == name) {
            return;
        }
        let message = format!("there is no {what} {:?}", short(name));
        let names = known.iter().map(String::as_str).chain(own.iter().copied());
        let help = did_you_mean(name, names, "there are")
            .unwrap_or_else(|| format!("define it in [{table}.{:?}]", short(name)));
        self.push(key, message, Some(help));
    }

    fn check_worldline(&mut self, key: &str, name: Option<&String>) {
        if let Some(name) = name {
            self.check_name(key, "worldline", name, "worldline", &["lab", "camera"]);
        }
    }

    /// The file's path from the shot's folder, if it is one that exists.
    fn check_file(&mut self, key: &str, file: &Path) {
        let from_here = self.shot.path.parent().unwrap_or(Path::new("")).join(file);
        let shown = short(&file.display().to_string());
        if !from_here.exists() {
            let folder = self.shot.path.parent().unwrap_or(Path::new(""));
            let help = file_names::remedy(folder, file);
            self.say(key, format!("there is no file {shown:?}"), &help);
        } else if !from_here.is_file() {
            self.say(key, format!("{shown:?} is not a file"), "name a file in it");
        }
    }

    /// The instants at which relations between moving values are checked: the frames, and
    /// where their authors fixed them, whether a frame reaches it or not.
    fn instants(&self, authored: impl IntoIterator<Item = Vec<f64>>) -> Vec<f64> {
        let authored: Vec<f64> = authored.into_iter().flatten().collect();
        if authored.iter().all(|instant| *instant == 1.0) {
            return vec![1.0];
        }
        authored
            .into_iter()
            .chain((1..=self.frames().min(MAX_FRAMES)).map(f64::from))
            .collect()
    }

    fn frames(&self) -> u32 {
        self.shot.shot.frames
    }

    /// The first instant at which two moving values are in a relation that they must not be in.
    fn first<A: Blend, B: Blend>(
        &self,
        a: &Track<A>,
        b: &Track<B>,
        wrong: impl Fn(A, B) -> bool,
    ) -> Option<f64> {
        let frames = self.frames();
        self.instants([a.authored_frames(frames), b.authored_frames(frames)])
            .into_iter()
            .find(|instant| {
                wrong(
                    a.at_instant(*instant, frames),
                    b.at_instant(*instant, frames),
                )
            })
    }

    fn settings(&mut self) {
        let [from, to] = self.shot.sensor.window;
        if from >= to {
            let message = format!("the window ends at {to} nm, where it has not begun");
            self.say(
                "sensor.window",
                message,
                "write the shorter wavelength first",
            );
        } else if to < from * NARROWEST {
            let message = format!("the window from {from} to {to} nm is too narrow");
            self.say(
                "sensor.window",
                message,
                "let it end at least a millionth further than it begins",
            );
        } else {
            self.lines();
        }
        for (key, splice) in self.each("splice", &self.shot.splice) {
            let [top, bottom] = splice.rows;
            if top >= bottom {
                let message = format!("a splice from {top} to {bottom} has no rows");
                self.say(
                    &format!("{key}.rows"),
                    message,
                    "rows count from the top: the smaller first",
                );
            }
        }
    }
    /// Lines that a window leaves none of would make a black picture.
    fn lines(&mut self) {
        let accuracy = &self.shot.accuracy;
        let [from, to] = self.shot.sensor.window;
        let axis = LineAxis::new(accuracy.line_spacing);
        if accuracy.spectra != Spectra::Lines || axis.within([from, to]).next().is_some() {
            return;
        }
        let [first, last] = LINES_NM;
        let message = format!("no line lies in the window from {from} to {to} nm");
        let help = format!(
            "lines stand from {first} to {last} nm, {} nm apart (`line_spacing`): use \"grid\", or another window",
            axis.spacing_nm()
        );
        self.say("accuracy.spectra", message, &help);
    }
}
