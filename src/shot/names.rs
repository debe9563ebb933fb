//! Words and names in messages: quoted, shortened, and with the name that was perhaps meant, also among a
//! folder's files.

use std::fs;
use std::path::{Component, Path, PathBuf};

/// Number of characters of the author's text that a message repeats at most.
const MAX_QUOTED: usize = 60;
/// Number of names that are compared with a misspelled one.
const MAX_COMPARED: usize = 1000;
/// Number of names that a message lists if none is near.
const MAX_LISTED: usize = 16;
/// Jaro-Winkler similarity above which a name counts as perhaps meant.
const SIMILAR: f64 = 0.78;

/// The author's text, cut to a length that fits a message, with control characters escaped.
pub(super) fn short(text: &str) -> String {
    let mut cut: String = text.chars().take(MAX_QUOTED).flat_map(visible).collect();
    if text.chars().nth(MAX_QUOTED).is_some() {
        cut.push('…');
    }
    cut
}

fn visible(c: char) -> impl Iterator<Item = char> {
    let escaped = c.is_control().then(|| c.escape_default());
    let plain = (!c.is_control()).then_some(c);
    plain.into_iter().chain(escaped.into_iter().flatten())
}

/// The name among `known` that `word` was perhaps meant to be.
pub(super) fn nearest<'a>(word: &str, known: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    if word.len() > MAX_QUOTED {
        return None;
    }
    let lower = word.to_lowercase();
    known
        .take(MAX_COMPARED)
        .map(|name| (strsim::jaro_winkler(&lower, &name.to_lowercase()), name))
        .filter(|(similarity, _)| *similarity >= SIMILAR)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, name)| name)
}

/// Remedy for an unknown name: "did you mean …?", or the names to choose from after `what`.
pub(super) fn did_you_mean<'a>(
    word: &str,
    known: impl Iterator<Item = &'a str> + Clone,
    what: &str,
) -> Option<String> {
    if let Some(name) = nearest(word, known.clone()) {
        return Some(format!("did you mean {:?}?", short(name)));
    }
    let mut listed: Vec<String> = known
        .clone()
        .take(MAX_LISTED)
        .map(|name| format!("{:?}", short(name)))
        .collect();
    if known.clone().nth(MAX_LISTED).is_some() {
        listed.push("…".into());
    }
    (!listed.is_empty()).then(|| format!("{what}: {}", listed.join(", ")))
}

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_misspelt_name_finds_its_neighbor() {
        let known = ["velocity", "passes", "at"];
        assert_eq!(nearest("velocty", known.into_iter()), Some("velocity"));
        assert_eq!(nearest("Velocity", known.into_iter()), Some("velocity"));
        assert_eq!(nearest("mass", ["velocity", "at"].into_iter()), None);
    }

    #[test]
    fn long_text_is_cut_and_control_characters_are_escaped() {
        assert_eq!(short("a\u{1b}[31m"), "a\\u{1b}[31m");
        assert_eq!(short(&"x".repeat(1000)).chars().count(), MAX_QUOTED + 1);
    }
}
