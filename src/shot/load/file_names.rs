//! File names in a shot: other systems' separators, and remedies for a name that does not exist.

use crate::shot::names::short;
use crate::shot::names::{are_composed_differently, nearest_file};
use std::path::{Component, Path, PathBuf};

/// Remedy for `\\` in double quotes.
pub(super) const ESCAPES: &str =
    "write / in paths, on every system: in double quotes \\ begins an escape";

/// Number of parts at the end of a path that are searched for if the whole path leads nowhere.
const MOST_PARTS: usize = 8;

/// The name with `/` in place of `\\`, as Windows writes paths, if only that one leads to a file.
/// None if the name leads to a file as it is, or to none either way. Paths are relative to `folder`.
pub(in crate::shot) fn with_slashes(folder: &Path, file: &Path) -> Option<PathBuf> {
    let name = file.to_str().filter(|name| name.contains('\\'))?;
    let slashed = PathBuf::from(name.replace('\\', "/"));
    (!folder.join(file).exists() && folder.join(&slashed).is_file()).then_some(slashed)
}

/// Remedy for the name of a file that does not exist.
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

/// The path as a message shows it.
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

/// The longest end of a path that leads to a file from `folder`: a file that was left beside the shot
/// when both moved.
fn beside(folder: &Path, file: &Path) -> Option<PathBuf> {
    let parts: Vec<Component<'_>> = file.components().collect();
    let longest = parts.len().saturating_sub(MOST_PARTS).max(1);
    let ends = (longest..parts.len()).map(|from| parts[from..].iter().collect::<PathBuf>());
    ends.into_iter().find_map(|end| meant(folder, &end))
}

/// The existing file that a path was perhaps meant to name. The author's own shot may look anywhere.
fn meant(folder: &Path, file: &Path) -> Option<PathBuf> {
    nearest_file(folder, file, |_| true)
}
