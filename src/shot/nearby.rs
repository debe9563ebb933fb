//! The file that was perhaps meant where there is none of the name given.

use super::names::nearest;
use std::fs;
use std::path::{Path, PathBuf};

/// Most entries of a folder that are looked at.
const MAX_ENTRIES: usize = 1000;

/// The path from `folder`, its parts parted by `/`, of a file whose name is near to `name`: of
/// another case, or misspelt. Looks into those folders alone that `may_list` allows.
pub(super) fn nearby(
    folder: &Path,
    name: &str,
    may_list: impl Fn(&Path) -> bool,
) -> Option<String> {
    let mut meant = PathBuf::new();
    for part in name.split(['/', '\\']).filter(|part| !part.is_empty()) {
        let here = folder.join(&meant);
        if !may_list(&here.canonicalize().ok()?) {
            return None;
        }
        if here.join(part).exists() {
            meant.push(part);
            continue;
        }
        let entries = fs::read_dir(&here).ok()?.take(MAX_ENTRIES).flatten();
        let mut names: Vec<String> = entries
            .filter_map(|entry| entry.file_name().into_string().ok())
            .collect();
        names.sort_unstable();
        meant.push(nearest(part, names.iter().map(String::as_str))?);
    }
    let is_file = folder.join(&meant).is_file();
    is_file.then(|| meant.display().to_string().replace('\\', "/"))
}
