//! Two processes at work on one folder.

use super::desk::{PASSING, passing};
use crate::common::desk::Outcome;

#[test]
fn of_two_processes_at_once_each_frame_is_rendered_by_one() {
    let desk = passing();
    // Long enough for both to be at work.
    desk.write(
        "passing.toml",
        PASSING.replace("samples = 4", "samples = 60"),
    );
    desk.done("render passing.toml --out whole");
    let call = "render passing.toml --out both --threads 1 --json";
    let children = [desk.spawn(call), desk.spawn(call)];
    let outcomes = children.map(|child| Outcome::of(child.wait_with_output().unwrap()));
    let mut rendered = Vec::new();
    for outcome in &outcomes {
        assert_eq!(outcome.status, 0, "{}", outcome.stderr);
        let all = [outcome.frames("rendered"), outcome.frames("kept")].concat();
        assert_eq!(all.len(), 20, "each tells of every frame");
        let own = outcome.frames("rendered");
        assert!(!own.is_empty(), "one came when the other had done all");
        rendered.extend(own);
    }
    let mut recorded = desk.recorded("both");
    recorded.sort_unstable();
    rendered.sort_unstable();
    assert_eq!(rendered, (1..=20).collect::<Vec<_>>());
    assert_eq!(recorded, rendered);
    assert!(desk.pictures("both") == desk.pictures("whole"));
    assert!(!desk.has_leftovers("both"), "{:?}", desk.names("both"));
}

/// The file of a lock alone, as a killed process leaves it, claims nothing.
#[test]
fn locks_and_files_that_a_killed_process_left_block_nothing_and_are_swept() {
    let desk = passing();
    std::fs::create_dir_all(desk.path("renders/passing/.passing.locks")).unwrap();
    desk.write("renders/passing/.passing.locks/0001", "");
    desk.write("renders/passing/.passing.locks/sequence", "");
    desk.write(
        "renders/passing/passing.0001.png.restframe-q7Rs0T.tmp",
        "half a pic",
    );
    desk.done("render passing.toml --frames 1-2");
    assert!(
        !desk.has_leftovers("renders"),
        "{:?}",
        desk.names("renders")
    );
    assert_eq!(desk.pictures("renders").len(), 2);
}
