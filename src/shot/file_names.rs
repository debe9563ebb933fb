//! Names of files as people and other systems write them: what is meant by one that is not there.

use super::names::{nearest, short};
use std::fs;
use std::path::{Component, Path, PathBuf};

/// What to do about `\\` in double quotes.
pub(super) const ESCAPES: &str =
    "write / in paths, on every system: in double quotes \\ begins an escape";

/// Most parts of a path that are looked for where the others lead nowhere.
const MOST_PARTS: usize = 8;

/// Most names of a folder that are looked at.
const MOST_NAMES: usize = 10_000;

/// The file that a name leads to whose `\\` stand for `/`, as on Windows; None where the name leads
/// to a file as it stands, or to none either way. `folder` is what paths are relative to.
pub(super) fn settled(folder: &Path, file: &Path) -> Option<PathBuf> {
    let name = file.to_str().filter(|name| name.contains('\\'))?;
    let settled = PathBuf::from(name.replace('\\', "/"));
    (!folder.join(file).exists() && folder.join(&settled).is_file()).then_some(settled)
}

/// What to do about the name of a file that is not there.
pub(super) fn remedy(folder: &Path, file: &Path) -> String {
    const RELATIVE: &str = "paths are relative to the shot file";
    let Some(name) = file.to_str() else {
        return RELATIVE.to_owned();
    };
    // Such as the \n of "models\new.obj".
    if name.chars().any(char::is_control) {
        return format!("{ESCAPES}, such as that of a line break or tab");
    }
    if let Some((scheme, rest)) = name.split_once("://") {
        return of_url(folder, scheme, rest);
    }
    let plain = name.strip_prefix("file:").unwrap_or(name);
    let plain = plain.trim().replace('\\', "/");
    let meant = meant(folder, Path::new(&plain)).or_else(|| beside(folder, Path::new(&plain)));
    match meant {
        Some(meant) if are_composed_differently(&meant.to_string_lossy(), &plain) => format!(
            "did you mean {:?}? there letters and accents are composed differently (Unicode NFC or NFD): copy the name from the folder",
            shown(&meant)
        ),
        Some(meant) => format!("did you mean {:?}?", shown(&meant)),
        None if name.starts_with("file:") => format!("write a path, not a URL; {RELATIVE}"),
        None if name.contains('\\') => format!("write / in paths; {RELATIVE}"),
        None => RELATIVE.to_owned(),
    }
}

/// As a message has it.
fn shown(path: &Path) -> String {
    short(&path.display().to_string())
}

fn of_url(folder: &Path, scheme: &str, rest: &str) -> String {
    if !scheme.eq_ignore_ascii_case("file") {
        return "write the path of a file of this machine, not a URL".to_owned();
    }
    // file://HOST/PATH, of which HOST is empty or localhost.
    let path = rest.find('/').map_or(rest, |at| &rest[at..]);
    let path = urlencoding::decode(path).unwrap_or_else(|_| path.into());
    let path = Path::new(&*path);
    let meant = meant(folder, path).or_else(|| beside(folder, path));
    let meant = meant.unwrap_or_else(|| path.to_owned());
    format!("write a path, not a URL: {:?}", shown(&meant))
}

/// The file that a name was perhaps meant to lead to, each part of it found in its folder.
fn meant(folder: &Path, file: &Path) -> Option<PathBuf> {
    let mut found = PathBuf::new();
    let parts: Vec<Component<'_>> = file.components().collect();
    for (i, part) in parts.iter().enumerate() {
        let here = folder.join(&found);
        match part {
            Component::Normal(name) if !here.join(name).exists() => {
                let last = i + 1 == parts.len();
                found.push(near(&here, name.to_str()?, last)?);
            }
            part => found.push(part),
        }
    }
    folder.join(&found).is_file().then_some(found)
}

/// The name in a folder that is nearest to another: one that differs in case, accents or blanks
/// alone, else one that is spelt alike. Of files only those of the same extension.
fn near(folder: &Path, name: &str, is_file: bool) -> Option<String> {
    let extension = |name: &str| {
        let extension = Path::new(name.trim()).extension();
        extension.map(|e| e.to_string_lossy().to_lowercase())
    };
    let entries = fs::read_dir(if folder == Path::new("") {
        Path::new(".")
    } else {
        folder
    });
    let names = entries.ok()?.take(MOST_NAMES).filter_map(|entry| {
        let entry = entry.ok()?;
        let other = entry.file_name().into_string().ok()?;
        let fits = !is_file || extension(&other) == extension(name);
        (entry.path().is_file() == is_file && fits).then_some(other)
    });
    let mut names: Vec<String> = names.collect();
    names.sort_unstable();
    let alike = names.iter().find(|other| are_alike(other, name));
    let spelt = || nearest(name, names.iter().map(String::as_str)).map(str::to_owned);
    alike.cloned().or_else(spelt)
}

/// The file whose path is the end of another, the longest that there is: what was left beside the shot when it moved.
fn beside(folder: &Path, file: &Path) -> Option<PathBuf> {
    let parts: Vec<Component<'_>> = file.components().collect();
    let longest = parts.len().saturating_sub(MOST_PARTS).max(1);
    let ends = (longest..parts.len()).map(|from| parts[from..].iter().collect::<PathBuf>());
    ends.into_iter().find_map(|end| meant(folder, &end))
}

/// Whether two names differ in case, accents or blanks around them alone.
fn are_alike(one: &str, other: &str) -> bool {
    let folded = |name: &str| letters(&name.trim().to_lowercase());
    let (one, other) = (folded(one), folded(other));
    let same = |(a, b): (&Letter, &Letter)| a == b || are_one_letter(*a, *b);
    one.len() == other.len() && one.iter().zip(&other).all(same)
}

/// Whether two names that are not the same may look the same: accents are letters' own (NFC) here,
/// and follow them (NFD) there.
fn are_composed_differently(one: &str, other: &str) -> bool {
    let (one, other) = (letters(one), letters(other));
    one.iter().zip(&other).any(|(a, b)| are_one_letter(*a, *b))
}

/// A letter, and how many accents follow it.
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

/// Combining marks: diacritical ones, and those of kana.
fn is_accent(c: char) -> bool {
    matches!(c, '\u{300}'..='\u{36f}' | '\u{3099}' | '\u{309a}')
}

/// Whether one is composed, and the other a letter with accents that follow.
fn are_one_letter(a: Letter, b: Letter) -> bool {
    let composed = |(c, accents): Letter| !c.is_ascii() && accents == 0;
    composed(a) && b.1 > 0 || composed(b) && a.1 > 0
}
