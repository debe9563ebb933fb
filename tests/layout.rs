//! The house rules of `src/`: imports point up the list of rooms, no two files of a room import each
//! other in a circle, `mod.rs` only declares, every file opens with `//!`, and files stay short.

#[path = "layout/circles.rs"]
mod circles;
#[path = "layout/paths.rs"]
mod paths;

use circles::Files;
use paths::{module_of, paths};
use proc_macro2::{TokenStream, TokenTree};
use std::path::Path;

/// The rooms, each importing only from those above it. Those on one line do not know each other,
/// so that no circle of imports can leave a room.
const ROOMS: &[&[&str]] = &[
    &["relativity", "color", "plot"],
    &["spectrum", "film"],
    &["shot", "image"],
    &["model", "frame"],
    &["accel", "scene"],
    &["trace"],
    &["shade"],
    &["render"],
    &["probe"],
    &["store", "progress"],
    &["queue"],
    &["sequence", "study"],
    &["cli"],
    &["main"],
];

/// Rooms that import nothing of ours, wherever they stand in the list.
const LEAVES: &[&str] = &["relativity", "color", "plot"];

const MAX_LINES: usize = 400;

/// Files that may be longer, each with its reason.
const LONG: &[(&str, &str)] = &[(
    "color/tables.rs",
    "tables of numbers, written by scripts/make-tables",
)];

/// Everything in the sources that breaks a rule. Paths are relative to `src`, with `/`.
fn faults(files: &[(String, String)]) -> Vec<String> {
    let mut faults = Vec::new();
    for (path, text) in files {
        if !text.starts_with("//!") {
            faults.push(format!(
                "{path}: does not open with //!, a line that says what it is"
            ));
        }
        let lines = text.lines().count();
        if lines > MAX_LINES && !LONG.iter().any(|(long, _)| long == path) {
            faults.push(format!(
                "{path}: {lines} lines, more than {MAX_LINES}; split it"
            ));
        }
        match text.parse::<TokenStream>() {
            Ok(tokens) => {
                if path.ends_with("mod.rs") && !only_declares(&tokens) {
                    faults.push(format!(
                        "{path}: holds items of its own; it should declare and re-export alone"
                    ));
                }
                faults.extend(bad_imports(path, tokens));
            }
            Err(error) => faults.push(format!("{path}: {error}")),
        }
    }
    faults.extend(Files::new(files).circles());
    for (path, _) in LONG {
        let long = |(p, text): &(String, String)| p == path && text.lines().count() > MAX_LINES;
        if !files.iter().any(long) {
            faults.push(format!(
                "{path}: no longer a long file; take it off the list"
            ));
        }
    }
    faults
}

fn bad_imports(path: &str, tokens: TokenStream) -> Vec<String> {
    let module = module_of(path);
    // The map of the crate declares the rooms and imports nothing.
    let room = module.first().map_or("lib", String::as_str);
    let rank = rank_of(room);
    if rank.is_none() && room != "lib" {
        return vec![format!(
            "{path}: {room} is no room; give it its place in tests/layout.rs"
        )];
    }
    let mut imports: Vec<String> = paths(tokens, &module)
        .into_iter()
        .filter_map(|path| path.into_iter().next())
        .collect();
    imports.dedup();
    let fault = |import: String| {
        if import == room {
            return None;
        }
        let why = match rank_of(&import) {
            None => "which is no room",
            Some(_) if LEAVES.contains(&room) => "but must import nothing of ours",
            Some(_) if room == "lib" => "but is only the map",
            other if other >= rank => "which does not stand above it",
            Some(_) => return None,
        };
        Some(format!("{path}: {room} imports {import}, {why}"))
    };
    imports.into_iter().filter_map(fault).collect()
}

fn rank_of(room: &str) -> Option<usize> {
    ROOMS.iter().position(|line| line.contains(&room))
}

/// Whether a file has no items but modules without a body, imports, constants and attributes.
fn only_declares(tokens: &TokenStream) -> bool {
    const ITEMS: [&str; 7] = [
        "fn",
        "struct",
        "enum",
        "impl",
        "trait",
        "static",
        "macro_rules",
    ];
    let is_item = |token: &TokenTree| matches!(token, TokenTree::Ident(word) if ITEMS.iter().any(|item| word == item));
    !tokens.clone().into_iter().any(|token| is_item(&token))
}

/// All sources below a folder.
fn sources(folder: &Path, root: &Path, files: &mut Vec<(String, String)>) {
    for entry in std::fs::read_dir(folder).expect("src can be read") {
        let path = entry.expect("its entries can be read").path();
        if path.is_dir() {
            sources(&path, root, files);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let name = path.strip_prefix(root).expect("below src");
            let name = name.to_string_lossy().replace('\\', "/");
            files.push((name, std::fs::read_to_string(&path).expect("UTF-8")));
        }
    }
}

#[test]
fn the_sources_keep_the_rules() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    sources(&root, &root, &mut files);
    files.sort();
    assert!(
        files.len() > 20,
        "only {} files found in {}",
        files.len(),
        root.display()
    );
    let faults = faults(&files);
    assert!(faults.is_empty(), "\n{}", faults.join("\n"));
}

/// What is wrong with one file, beside the list of long files.
fn faults_of(path: &str, text: &str) -> Vec<String> {
    let mut faults = faults(&[(path.to_owned(), text.to_owned())]);
    faults.retain(|fault| !fault.contains("take it off the list"));
    faults
}

#[test]
fn an_import_from_further_down_is_found_however_it_is_written() {
    for text in [
        "use crate::queue::FrameList;",
        "use crate::queue;",
        "use crate::{frame, queue::{FrameList, Mode}};",
        "use super::queue::FrameList;",
        "use {std::fs, super::{frame, queue}};",
        "pub use crate::queue as q;",
        "fn f(_: &crate::queue::FrameList) {}",
        "fn f() { if true { crate::queue::options(); } }",
        "mod tests { use super::super::queue::Mode; }",
        "mod tests { use super::super::{frame, queue}; }",
        "fn f() { println!(\"{}\", crate::queue::N) }",
        "#[cfg(test)] use crate::queue::Mode;",
        "impl From<f64> for crate::queue::Mode {}",
        "use restframe::queue;",
    ] {
        let found = faults_of("render.rs", &format!("//! A step.\n{text}\n"));
        assert_eq!(
            found,
            ["render.rs: render imports queue, which does not stand above it"],
            "{text}"
        );
    }
    let deep = faults_of(
        "scene/model/obj.rs",
        "//! A file.\nuse super::super::super::trace::Tracer;",
    );
    assert_eq!(
        deep,
        ["scene/model/obj.rs: scene imports trace, which does not stand above it"]
    );
}

#[test]
fn what_is_no_import_from_another_room_is_none() {
    for text in [
        "use crate::scene::Scene;\nuse super::{frame, scene::Scene};",
        "/// See [`FrameList`](crate::queue::FrameList).\nfn f() {}",
        "// use crate::queue::Mode;\n/* crate::queue */",
        "const TEXT: &str = \"crate::queue::Mode\"; const RAW: &str = r#\"super::queue\"#;",
        "pub(crate) fn f() {} pub(super) struct S; pub(in crate::render) struct T;",
        "mod tests { use super::*; use super::queue; }",
        "use std::queue; use other::crate_like::queue;",
        "use crate::render::View;",
    ] {
        assert_eq!(
            faults_of("render.rs", &format!("//! A step.\n{text}\n")),
            [""; 0],
            "{text}"
        );
    }
    let inside = "//! A file.\nuse super::super::files::Files;\nuse super::{queue, trace};";
    assert_eq!(faults_of("scene/model/obj/library.rs", inside), [""; 0]);
}

#[test]
fn a_circle_between_two_rooms_is_found() {
    let file = |path: &str, text: &str| (path.to_owned(), format!("//! A room.\n{text}"));
    let circle = [
        file("trace/mod.rs", "use crate::shade::Shader;"),
        file("shade/mod.rs", "use crate::trace::Tracer;"),
    ];
    assert!(
        faults(&circle).contains(
            &"trace/mod.rs: trace imports shade, which does not stand above it".to_owned()
        )
    );
}

#[test]
fn a_leaf_that_imports_and_two_rooms_of_one_line_are_found() {
    for import in ["shot", "spectrum", "film"] {
        let text = format!("//! A leaf.\nuse crate::{import}::X;");
        let expected = format!(
            "relativity/boost.rs: relativity imports {import}, but must import nothing of ours"
        );
        assert_eq!(faults_of("relativity/boost.rs", &text), [expected]);
    }
}

#[test]
fn a_room_without_a_place_is_found() {
    let expected = "attic/mod.rs: attic is no room; give it its place in tests/layout.rs";
    assert_eq!(faults_of("attic/mod.rs", "//! Old things."), [expected]);
    let imported = faults_of("shot/mod.rs", "//! A room.\nuse crate::Thing;");
    assert_eq!(
        imported,
        ["shot/mod.rs: shot imports Thing, which is no room"]
    );
}

#[test]
fn a_file_without_its_first_line_and_one_too_long_are_found() {
    let bare = faults_of("shot/track.rs", "// A comment.\n//! Late.\n");
    assert!(bare[0].contains("does not open with //!"), "{bare:?}");
    let long = format!("//! A file.\n{}", "\n".repeat(MAX_LINES));
    assert_eq!(
        faults_of("shot/track.rs", &long),
        ["shot/track.rs: 401 lines, more than 400; split it"]
    );
    let fits = format!("//! A file.\n{}", "\n".repeat(MAX_LINES - 1));
    assert_eq!(faults_of("shot/track.rs", &fits), [""; 0]);
    assert!(faults_of("color/tables.rs", &long).is_empty());
}

#[test]
fn an_exception_that_nothing_needs_any_more_is_found() {
    let short = [("color/tables.rs".to_owned(), "//! Tables.\n".to_owned())];
    assert_eq!(
        faults(&short),
        ["color/tables.rs: no longer a long file; take it off the list"]
    );
}

#[test]
fn a_circle_between_two_files_of_a_room_is_found_also_by_way_of_its_door() {
    let file = |path: &str, text: &str| (path.to_owned(), format!("//! A file.\n{text}"));
    let door = file(
        "trace/mod.rs",
        "mod a;\nmod b;\npub use a::A;\npub use b::B;",
    );
    let circle = "trace/a, trace/b import each other".to_owned();
    for (a, b) in [
        (
            "use super::B; pub struct A;",
            "use super::a::A; pub struct B;",
        ),
        (
            "use crate::trace::b::B; pub struct A;",
            "fn f(_: super::A) {} pub struct B;",
        ),
    ] {
        let files = [door.clone(), file("trace/a.rs", a), file("trace/b.rs", b)];
        assert!(faults(&files).contains(&circle), "{a} {b}");
    }
    let tests = "pub struct B; #[cfg(test)] mod tests { use crate::trace::A; }";
    let one_way = [
        door,
        file("trace/a.rs", "use super::B;"),
        file("trace/b.rs", tests),
    ];
    assert!(!faults(&one_way).contains(&circle));
}

#[test]
fn a_door_with_items_of_its_own_is_found() {
    let expected = "trace/mod.rs: holds items of its own; it should declare and re-export alone";
    for text in ["mod a;\npub fn f() {}", "pub struct S;", "impl S {}"] {
        let found = faults_of("trace/mod.rs", &format!("//! A room.\n{text}"));
        assert_eq!(found, [expected], "{text}");
    }
    let door = "//! A room.\nmod a;\npub use a::{A, B};\npub(crate) const N: u32 = 1;";
    assert_eq!(faults_of("trace/mod.rs", door), [""; 0]);
}
