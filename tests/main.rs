//! All tests of the program from outside, as one binary, so that the library is linked once.
//!
//! Each module is a subject; `cargo test --test suite sky::` runs one of them.

#![expect(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test's helpers fail by panicking"
)]

use std::path::{Path, PathBuf};

mod accuracy;
mod bad_shots;
mod branches;
mod cli;
mod common;
mod drive_by;
mod exact;
mod figure_1;
mod file_names;
mod film;
mod finished;
mod frames;
mod gamut;
mod hard_cases;
mod held_spectra;
mod huge;
mod inset;
mod keys;
mod layout;
mod models;
mod narrow;
mod page;
mod plan;
mod plates;
mod plot;
mod probe;
mod projections;
mod properties;
mod reference;
mod runs;
mod sequence;
mod shading;
#[cfg(target_os = "linux")]
mod shared_memory;
mod shared_traces;
mod sky;
mod spheres;
mod study;
mod study_report;
mod window;

#[test]
fn every_file_of_tests_is_part_of_a_binary() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests");
    let forgotten = forgotten(&folder, include_str!("main.rs"));
    let others = include_str!("../Cargo.toml");
    let is_binary = |path: &PathBuf| {
        let name = path.file_name().unwrap().to_str().unwrap();
        name == "main.rs" || others.contains(&format!("path = \"tests/{name}\""))
    };
    let forgotten: Vec<PathBuf> = forgotten.into_iter().filter(|p| !is_binary(p)).collect();
    assert!(forgotten.is_empty(), "compiled nowhere: {forgotten:?}");
}

/// The source files below a folder that are no modules of `parent`, the text of the folder's own module,
/// nor of one of those.
fn forgotten(folder: &Path, parent: &str) -> Vec<PathBuf> {
    let is_declared = |module: &str| {
        parent.lines().any(|line| {
            let before = line.strip_suffix(&format!("mod {module};"));
            before.is_some_and(|before| before.is_empty() || before.starts_with("pub"))
        })
    };
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let stem = path.file_stem().unwrap().to_str().unwrap();
        if path.is_dir() {
            let files = [path.with_extension("rs"), path.join("mod.rs")];
            let text = files
                .iter()
                .find_map(|file| std::fs::read_to_string(file).ok());
            found.extend(forgotten(&path, &text.unwrap_or_default()));
            if files[1].is_file() && !is_declared(stem) {
                found.push(files[1].clone());
            }
        } else if path.extension().is_some_and(|e| e == "rs") && stem != "mod" && !is_declared(stem)
        {
            found.push(path);
        }
    }
    found
}
