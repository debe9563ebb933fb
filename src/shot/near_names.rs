//! Search of a folder for the file that was perhaps meant by a name that does not exist.

use super::names::nearest;
use std::fs;
use std::path::{Component, Path, PathBuf};

/// Number of entries of one folder that are looked at.
const MOST_NAMES: usize = 10_000;

/// The existing file that `file`, a path relative to `folder`, was perhaps meant to name. Each part
/// of the path is taken as it is if it exists, and otherwise replaced by the nearest name.
///
/// Only folders that `may_list` allows are read, so that a message cannot reveal other names.
pub(super) fn nearest_file(
    folder: &Path,
    file: &Path,
    may_list: impl Fn(&Path) -> bool,
) -> Option<PathBuf> {
    let mut found = PathBuf::new();
    let parts: Vec<Component<'_>> = file.components().collect();
    for (i, part) in parts.iter().enumerate() {
        let here = folder.join(&found);
        match part {
            Component::Normal(name) => {
                let name = name.to_str()?;
                if !may_list(&here) {
                    return None;
                }
                if here.join(name).exists() {
                    found.push(name);
                } else {
                    let is_last = i + 1 == parts.len();
                    found.push(nearest_entry(&here, name, is_last)?);
                }
            }
            part => found.push(part),
        }
    }
    folder.join(&found).is_file().then_some(found)
}

/// The entry of a folder nearest to `name`: one that differs only in case, accents or blanks, or
/// else one that is spelled alike. A file must have the same extension.
fn nearest_entry(folder: &Path, name: &str, is_file: bool) -> Option<String> {
    let extension = |name: &str| {
        let extension = Path::new(name.trim()).extension();
        extension.map(|e| e.to_string_lossy().to_lowercase())
    };
    let fits = |other: &String| {
        folder.join(other).is_file() == is_file && (!is_file || extension(other) == extension(name))
    };
    let mut names = names_in(folder)?;
    names.retain(fits);
    let alike = names.iter().find(|other| are_alike(other, name));
    let spelled = || nearest(name, names.iter().map(String::as_str)).map(str::to_owned);
    alike.cloned().or_else(spelled)
}

/// The names in a folder, sorted, so that answers do not depend on the file system's order.
pub(super) fn names_in(folder: &Path) -> Option<Vec<String>> {
    let here = match folder.components().next() {
        None => Path::new("."),
        Some(_) => folder,
    };
    let entries = fs::read_dir(here).ok()?.take(MOST_NAMES).flatten();
    let mut names: Vec<String> = entries
        .filter_map(|entry| entry.file_name().into_string().ok())
        .collect();
    names.sort_unstable();
    Some(names)
}

/// Whether two names differ only in case, in accents or in blanks around them.
fn are_alike(one: &str, other: &str) -> bool {
    let folded = |name: &str| letters(&name.trim().to_lowercase());
    let (one, other) = (folded(one), folded(other));
    let same = |(a, b): (&Letter, &Letter)| a == b || are_one_letter(*a, *b);
    one.len() == other.len() && one.iter().zip(&other).all(same)
}

/// Whether two different names may look the same, because Unicode can write a letter with an accent
/// as one character (NFC) or as two (NFD).
pub(super) fn are_composed_differently(one: &str, other: &str) -> bool {
    let (one, other) = (letters(one), letters(other));
    one.iter().zip(&other).any(|(a, b)| are_one_letter(*a, *b))
}

/// A letter, and the number of combining accents that follow it.
type Letter = (char, usize);

fn letters(name: &str) -> Vec<Letter> {
    let mut letters: Vec<Letter> = Vec::new();
    for c in name.chars() {
        match letters.last_mut() {
            Some((_, accents)) if is_accent(c) => *accents += 1,
            _ => letters.push((c, 0)),
        }
    }
    letters
}

/// Whether a character is a combining mark: diacritical, or of kana.
fn is_accent(c: char) -> bool {
    matches!(c, '\u{300}'..='\u{36f}' | '\u{3099}' | '\u{309a}')
}

/// Whether one of the two is a composed letter, and the other a letter followed by accents.
fn are_one_letter(a: Letter, b: Letter) -> bool {
    let composed = |(c, accents): Letter| !c.is_ascii() && accents == 0;
    composed(a) && b.1 > 0 || composed(b) && a.1 > 0
}
