//! Broken shots: what each is told, and that nothing in a shot file makes the reader panic.
//!
//! Every `tests/bad-shots/*.toml` has one mistake (`six-mistakes.toml` has six); the report on
//! it is the snapshot beside it. `INSTA_UPDATE=always cargo test --test suite bad_shots::` renews them.

use proptest::prelude::*;
use restframe::render::Prepared;
use restframe::shot::{Mistakes, load, parse};
use std::fs;
use std::path::{Path, PathBuf};

const FOLDER: &str = "tests/bad-shots";

/// A shot that uses most of the format; it lies beside the broken ones for its relative paths.
const VALID: &str = include_str!("bad-shots/models/valid.toml");

fn bad_shots() -> Vec<PathBuf> {
    let mut files: Vec<PathBuf> = fs::read_dir(FOLDER)
        .expect("the folder of bad shots is there")
        .map(|entry| entry.expect("its entries can be read").path())
        .filter(|path| {
            path.extension()
                .is_some_and(|extension| extension == "toml")
        })
        .collect();
    files.sort();
    files
}

/// Mistakes of the shot itself or, if there are none, of its files and frames.
fn mistakes_in(path: &Path) -> Mistakes {
    let read = Prepared::read(path).map(drop);
    read.expect_err(&path.display().to_string())
}

#[test]
fn every_bad_shot_is_told_what_is_wrong() {
    let files = bad_shots();
    assert!(files.len() >= 25, "only {} bad shots", files.len());
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path("bad-shots/snapshots");
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| {
        for file in files {
            let name = file.file_stem().unwrap().to_string_lossy().into_owned();
            insta::assert_snapshot!(name, mistakes_in(&file).report(false));
        }
    });
}

#[test]
fn each_bad_shot_has_one_mistake_and_the_one_with_six_has_six() {
    for file in bad_shots() {
        let expected = if file.ends_with("six-mistakes.toml") {
            6
        } else {
            1
        };
        assert_eq!(mistakes_in(&file).len(), expected, "{}", mistakes_in(&file));
    }
}

#[test]
fn a_shot_without_mistakes_passes() {
    let path = Path::new("tests/bad-shots/models/valid.toml");
    if let Err(mistakes) = load(path) {
        panic!("{mistakes}");
    }
}

/// UTF-16 as Windows writes it.
fn wide(text: &str) -> Vec<u8> {
    let marked = format!("\u{feff}{text}");
    marked.encode_utf16().flat_map(u16::to_le_bytes).collect()
}

#[test]
fn a_table_in_another_encoding_is_told_with_what_to_do() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, bytes: &[u8]| fs::write(folder.path().join(name), bytes).unwrap();
    write("a.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    write(
        "shot.toml",
        b"[[model]]\nfile = \"a.obj\"\nmaterial = \"m\"\n[camera]\n[material.m]\n\
          diffuse = { spectrum = { file = \"paint.csv\" } }\n",
    );
    let utf16 = wide("nm;R\n400;0,5\n");
    for (bytes, words) in [
        (&utf16[..], "is UTF-16 text"),
        (b"date\nnm,T (\xb0C)\n400,1\n", "line 2 has the byte 0xB0"),
        (b"nm,R\n400,1\n500,one\n", "line 3: expected a number"),
        (b"wavelength (inch),R\n400,1\n", "`inch`, is not known"),
    ] {
        write("paint.csv", bytes);
        let mistakes = mistakes_in(&folder.path().join("shot.toml"));
        let keys: Vec<&str> = mistakes.iter().map(|m| m.key.as_str()).collect();
        assert_eq!(keys, ["material.m.diffuse.spectrum.file"]);
        let message = &mistakes.iter().next().unwrap().message;
        assert!(
            message.contains("paint.csv") && message.contains(words),
            "{message}"
        );
    }
    write("paint.csv", b"nm,R\r400,1\r");
    assert!(Prepared::read(&folder.path().join("shot.toml")).is_ok());
}

#[test]
fn what_is_no_text_file_is_named_and_refused() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, bytes: &[u8]| {
        let path = folder.path().join(name);
        fs::write(&path, bytes).unwrap();
        path
    };
    let big = folder.path().join("big.toml");
    fs::File::create(&big).unwrap().set_len(100 << 20).unwrap();
    let cases = [
        (folder.path().join("none.toml"), "no such file"),
        (folder.path().to_owned(), "this is a folder"),
        (
            write("latin1.toml", b"[shot]\ntitle = \"caf\xe9\"\n"),
            "line 2 has the byte 0xE9",
        ),
        (
            write("utf16.toml", &wide("[shot]\nframes = 2\n")),
            "is UTF-16 text",
        ),
        (
            write("mac.toml", b"[shot]\rframes = 2\r[camera]\r"),
            "lines end in CR alone",
        ),
        (big, "larger than 4 MiB"),
    ];
    for (path, reason) in cases {
        let mistakes = mistakes_in(&path);
        let file = path.file_name().unwrap().to_string_lossy();
        let report = mistakes.report(false).replace("\n  │ ", "");
        assert!(
            report.contains(reason) && report.contains(&*file),
            "{report}"
        );
    }
}

#[test]
fn an_empty_file_lacks_a_model_and_a_camera() {
    let mistakes = parse("", Path::new("empty.toml")).unwrap_err();
    let keys: Vec<&str> = mistakes
        .iter()
        .map(|mistake| mistake.key.as_str())
        .collect();
    assert_eq!(keys, ["model", "camera"]);
}

#[test]
fn deep_nesting_does_not_overflow_the_stack() {
    let dotted = format!("{} = 1", vec!["a"; 100_000].join("."));
    let arrays = format!("a = {}{}", "[".repeat(100_000), "]".repeat(100_000));
    let part = vec!["a"; 79].join(".");
    let tables = format!("{}1{}", format!("{part} = {{").repeat(79), "}".repeat(79));
    let header = format!("[{}]\n", vec!["camera"; 100_000].join("."));
    for source in [dotted, arrays, tables, header] {
        let mistakes = parse(&source, Path::new("deep.toml")).unwrap_err();
        assert!(mistakes.report(false).len() < 100_000);
    }
}

#[test]
fn many_mistakes_are_reported_in_short_time() {
    let many: String = (0..20_000).map(|i| format!("key{i} = 1\n")).collect();
    let mistakes = parse(&many, Path::new("many.toml")).unwrap_err();
    assert!(mistakes.len() > 20_000);
    assert!(mistakes.report(false).contains("more mistakes"));
}

/// Deletes, inserts and doubles pieces of a text.
fn mutated(source: &str, edits: &[(prop::sample::Index, u8, String)]) -> String {
    let mut chars: Vec<char> = source.chars().collect();
    for (index, length, inserted) in edits {
        let at = index.index(chars.len() + 1);
        let end = (at + usize::from(*length)).min(chars.len());
        chars.splice(at..end, inserted.chars());
    }
    chars.into_iter().collect()
}

fn survives(source: &str) {
    if let Err(mistakes) = parse(source, Path::new("tests/bad-shots/models/fuzz.toml")) {
        assert!(!mistakes.is_empty());
        assert!(!mistakes.report(false).is_empty());
        assert!(mistakes.json().is_array());
    }
}

const TOKENS: &[&str] = &[
    "[",
    "]",
    "[[",
    "]]",
    "{",
    "}",
    "=",
    ",",
    ".",
    "\n",
    "\"",
    "'",
    "\"\"\"",
    "#",
    "\\",
    "\0",
    "\u{85}",
    "é",
    "nan",
    "inf",
    "-",
    "1e999",
    "0xff",
    "99999999999999999999",
    "-0.0",
    "true",
    "1979-05-27",
    "model",
    "camera",
    "keys",
    "from",
    "to",
    "ease",
    "velocity",
    "gamma",
    "window",
    "points",
    "shot",
    "frames",
    "worldline",
    "material",
    "spectrum",
    "mirror",
    "weight",
    " ",
];

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(400) })]

    #[test]
    fn no_mutation_of_a_valid_shot_makes_the_reader_panic(
        edits in prop::collection::vec((any::<prop::sample::Index>(), 0u8..12, ".{0,4}"), 1..8),
    ) {
        survives(&mutated(VALID, &edits));
    }

    #[test]
    fn no_token_put_into_a_valid_shot_makes_the_reader_panic(
        edits in prop::collection::vec(
            (any::<prop::sample::Index>(), 0u8..6, prop::sample::select(TOKENS).prop_map(String::from)),
            1..6,
        ),
    ) {
        survives(&mutated(VALID, &edits));
    }

    #[test]
    fn no_sequence_of_tokens_makes_the_reader_panic(
        tokens in prop::collection::vec(prop::sample::select(TOKENS), 0..60),
    ) {
        survives(&tokens.concat());
    }
}
