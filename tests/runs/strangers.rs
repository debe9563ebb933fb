//! What strangers put in the way: links, pipes and names that are no text.
#![cfg(unix)]

use super::desk::passing;
use crate::common::desk::Outcome;
use std::ffi::OsStr;
use std::fs;
use std::os::unix::ffi::OsStrExt;
use std::os::unix::fs::symlink;

#[test]
fn a_link_for_the_folder_of_locks_is_refused_and_what_it_leads_to_unharmed() {
    let desk = passing();
    fs::create_dir_all(desk.path("renders/passing")).unwrap();
    fs::create_dir(desk.path("victim")).unwrap();
    for name in ["0001", "sequence", "letter"] {
        desk.write(&format!("victim/{name}"), "dear");
    }
    symlink(
        desk.path("victim"),
        desk.path("renders/passing/.passing.locks"),
    )
    .unwrap();
    let outcome = desk.call("render passing.toml --frames 1-3");
    assert_eq!(outcome.status, 1, "{}", outcome.stderr);
    assert!(outcome.stderr.contains("remove it"), "{}", outcome.stderr);
    assert_eq!(desk.names("victim"), ["0001", "letter", "sequence"]);
}

#[test]
fn a_link_for_the_manifest_is_refused_and_nothing_appended_to_what_it_leads_to() {
    let desk = passing();
    fs::create_dir_all(desk.path("renders/passing")).unwrap();
    desk.write("diary", "dear");
    let manifest = desk.path("renders/passing/passing.manifest.jsonl");
    symlink(desk.path("diary"), &manifest).unwrap();
    let outcome = desk.call("render passing.toml --frames 1");
    assert_eq!(outcome.status, 1, "{}", outcome.stderr);
    assert!(
        outcome.stderr.contains("move it away"),
        "{}",
        outcome.stderr
    );
    assert_eq!(fs::read_to_string(desk.path("diary")).unwrap(), "dear");
}

/// A reader of the pipe would wait for ever.
#[test]
fn what_is_only_called_like_a_manifest_is_passed_over() {
    let desk = passing();
    let folder = desk.path("renders/passing");
    fs::create_dir_all(folder.join("passing.manifest.old.jsonl")).unwrap();
    symlink("/dev/zero", folder.join("passing.manifest.zero.jsonl")).unwrap();
    let made = desk.shell("mkfifo renders/passing/passing.manifest.pipe.jsonl");
    assert_eq!(made.status, 0, "{}", made.stderr);
    let outcome = desk.shell("exec timeout 60 $restframe render passing.toml --frames 1-2 --json");
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    assert_eq!(outcome.frames("rendered"), [1, 2]);
}

#[test]
fn names_that_are_no_text_are_rendered_and_told_with_what_of_them_is() {
    let desk = passing();
    let name = OsStr::from_bytes(b"p\xffssing.toml");
    let same = OsStr::from_bytes(b"p\xfessing.toml");
    for name in [name, same] {
        if let Err(error) = fs::copy(desk.path("passing.toml"), desk.path("").join(name)) {
            eprintln!("not tested: names here must be text: {error}");
            return;
        }
    }
    for (call, status) in [
        ("render --frames 1 --json", 0),
        ("assemble --json", 0),
        ("verify --json", 1),
        ("plan --json", 0),
        ("check --json", 0),
    ] {
        let mut command = desk.command(call);
        let outcome = Outcome::of_call(command.arg(name));
        assert_eq!(outcome.status, status, "{call}: {}", outcome.stderr);
    }
    let mut command = desk.command("render --frames 2 --json");
    let outcome = Outcome::of_call(command.arg(name));
    assert_eq!(outcome.events()[0]["shots"][0], "p\u{fffd}ssing.toml");
    // Both would write to the folder p\u{fffd}ssing.
    let mut command = desk.command("render --frames 1");
    let outcome = Outcome::of_call(command.args([name, same]));
    assert_eq!(outcome.status, 2, "{}", outcome.stderr);
}

#[test]
fn no_shot_is_called_like_the_folder_above() {
    let desk = passing();
    for name in ["..toml", "...toml"] {
        fs::copy(desk.path("passing.toml"), desk.path(name)).unwrap();
        for call in ["render --frames 1", "assemble", "plan"] {
            let outcome = desk.call(&format!("{call} {name} --out deep/renders"));
            assert_eq!(outcome.status, 2, "{call} {name}: {}", outcome.stderr);
            assert!(
                outcome.stderr.contains("rename the file"),
                "{}",
                outcome.stderr
            );
        }
    }
    assert!(desk.pictures("").is_empty(), "{:?}", desk.names(""));
}
