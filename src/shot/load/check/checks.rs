//! All checks of a shot, in the order of its sections, and what every check needs: the shot, the author's names, and the mistakes found so far.

use super::super::file_names;
use super::super::walk::Walk;
use crate::shot::names::{did_you_mean, short};
use crate::shot::track::Blend;
use crate::shot::{Mistake, Shot, Track};
use std::collections::HashMap;
use std::path::Path;

/// Number of frames up to which relations between moving values are checked frame by frame.
const MAX_FRAMES: u32 = 10_000;

/// The shot under check, and its mistakes.
pub(super) struct Checks<'a> {
    pub(super) shot: &'a Shot,
    pub(super) names: HashMap<String, Vec<String>>,
    pub(super) kept: HashMap<String, Vec<usize>>,
    pub(super) mistakes: Vec<Mistake>,
}

impl<'a> Checks<'a> {
    pub(super) fn report(&mut self, key: &str, message: String, help: &str) {
        self.push(key, message, Some(help.to_owned()));
    }

    pub(super) fn push(&mut self, key: &str, message: String, help: Option<String>) {
        self.mistakes
            .push(self.shot.places.mistake(key, message, help));
    }

    /// Whether the author wrote the key, even with a mistaken value.
    pub(super) fn given(&self, key: &str) -> bool {
        self.shot.places.has(key)
    }

    /// The entries of a list with their key paths in the file. Mistaken entries are absent from the
    /// list, so indices are those of the file.
    pub(super) fn each<T>(&self, key: &str, list: &'a [T]) -> Vec<(String, &'a T)> {
        let kept = self.kept.get(key);
        let index = |i: usize| kept.and_then(|kept| kept.get(i)).copied().unwrap_or(i);
        list.iter()
            .enumerate()
            .map(|(i, entry)| (format!("{key}[{}]", index(i)), entry))
            .collect()
    }

    /// The names that the author defined in a table such as `material`.
    pub(super) fn named(&self, table: &str) -> &[String] {
        self.names.get(table).map_or(&[], Vec::as_slice)
    }

    /// Reports `name` unless the author defined it in `table` or it is one of the format's `own`.
    pub(super) fn check_name(
        &mut self,
        key: &str,
        what: &str,
        name: &str,
        table: &str,
        own: &[&str],
    ) {
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

    pub(super) fn check_worldline(&mut self, key: &str, name: Option<&String>) {
        if let Some(name) = name {
            self.check_name(key, "worldline", name, "worldline", &["lab", "camera"]);
        }
    }

    /// Reports a file that does not exist, relative to the shot's folder, or is not a file.
    pub(super) fn check_file(&mut self, key: &str, file: &Path) {
        let from_here = self.shot.path.parent().unwrap_or(Path::new("")).join(file);
        let shown = short(&file.display().to_string());
        if !from_here.exists() {
            let folder = self.shot.path.parent().unwrap_or(Path::new(""));
            let help = file_names::remedy(folder, file);
            self.report(key, format!("there is no file {shown:?}"), &help);
        } else if !from_here.is_file() {
            self.report(key, format!("{shown:?} is not a file"), "name a file in it");
        }
    }

    /// Frame numbers at which relations between moving values are checked: the frames, and the keys,
    /// which may lie between or beyond them.
    pub(super) fn instants(&self, authored: impl IntoIterator<Item = Vec<f64>>) -> Vec<f64> {
        let authored: Vec<f64> = authored.into_iter().flatten().collect();
        if authored.iter().all(|instant| *instant == 1.0) {
            return vec![1.0];
        }
        authored
            .into_iter()
            .chain((1..=self.frames().min(MAX_FRAMES)).map(f64::from))
            .collect()
    }

    pub(super) fn frames(&self) -> u32 {
        self.shot.shot.frames
    }

    /// The first frame number at which two moving values are in the relation `wrong`.
    pub(super) fn first<A: Blend, B: Blend>(
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
}

/// All mistakes of a shot: those that the walk has found, and those of the checks.
pub(in super::super) fn check(shot: &Shot, walk: Walk<'_>) -> Vec<Mistake> {
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
