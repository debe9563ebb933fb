//! All tests of the program from outside, as one binary, so that the library is linked once.
//!
//! Each module is a subject; `cargo test --test suite sky::` runs one of them.

#![expect(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test's helpers fail by panicking"
)]

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
mod hard_cases;
mod held_spectra;
mod huge;
mod inset;
mod keys;
mod layout;
mod models;
mod narrow;
mod night;
mod page;
mod plan;
mod plates;
mod plot;
mod probe;
mod projections;
mod properties;
mod reference;
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
    let declared = concat!(include_str!("main.rs"), include_str!("../Cargo.toml"));
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests");
    for entry in std::fs::read_dir(folder).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        let Some(module) = name.strip_suffix(".rs") else {
            continue;
        };
        let as_module = declared.contains(&format!("\nmod {module};\n"));
        let as_binary = declared.contains(&format!("path = \"tests/{name}\""));
        assert!(as_module || as_binary, "tests/{name} is compiled nowhere");
    }
}
