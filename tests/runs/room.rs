//! No room, or no way to write.

use super::desk::passing;
use std::fs;

/// Without a handler the signal that goes with the limit would end the process.
#[test]
fn a_limit_on_file_sizes_fails_one_shot_with_a_sentence_and_tears_nothing() {
    let desk = passing();
    // Blocks of a KiB: pictures of `glowing` fit while they are dark, its manifest while it is short.
    let outcome = desk.shell("ulimit -f 4; exec $restframe render glowing.toml --json");
    assert_eq!(outcome.status, 1, "{}", outcome.stderr);
    assert!(
        outcome.stderr.contains("raise the limit on file sizes"),
        "{}",
        outcome.stderr
    );
    assert!(
        outcome.stderr.contains("its other frames are left"),
        "{}",
        outcome.stderr
    );
    let summary = outcome.events().pop().unwrap();
    assert_eq!(
        (&summary["event"], &summary["exit"]),
        (&"summary".into(), &1.into())
    );
    // A line of the manifest or an EXR was the first not to fit.
    assert_eq!(summary["failed"], 1);
    assert!(summary["left"].as_u64() > Some(0), "{summary}");
    for name in desk.pictures("renders").keys() {
        assert!(
            image::open(desk.path("renders").join(name)).is_ok(),
            "{name}"
        );
    }
    assert!(
        !desk.has_leftovers("renders"),
        "{:?}",
        desk.names("renders")
    );
    let again = desk.done("render glowing.toml --json");
    assert!(!again.frames("rendered").is_empty());
    desk.done("render glowing.toml --out whole");
    assert!(desk.pictures("renders") == desk.pictures("whole"));
}

#[test]
fn work_that_there_is_no_room_for_is_not_waited_for() {
    let desk = passing();
    let outcome = desk.shell("ulimit -f 4; exec $restframe render glowing.toml --progress openjd");
    assert_eq!(outcome.status, 1, "{}", outcome.stderr);
    let mut percents = outcome.stdout.lines().rev();
    let last = percents.find_map(|line| line.strip_prefix("openjd_progress: "));
    assert_eq!(last, Some("100.0"), "{}", outcome.stdout);
}

#[test]
fn a_full_disk_ends_its_shot_and_what_is_there_is_whole_and_kept_later() {
    let desk = passing();
    fs::create_dir(desk.path("disk")).unwrap();
    let line = "mount -t tmpfs -o size=64k tmpfs disk || exit 77
        $restframe render passing.toml --out disk --json; echo $? > status
        rm -rf found; cp -r disk/passing found";
    let outcome = desk.shell(&format!("unshare -rm bash -c '{line}'"));
    let Ok(status) = fs::read_to_string(desk.path("status")) else {
        eprintln!(
            "not tested: nothing can be mounted here: {}",
            outcome.stderr
        );
        return;
    };
    assert_eq!(status.trim(), "1", "{}", outcome.stderr);
    assert!(
        outcome.stderr.contains("No space left"),
        "{}",
        outcome.stderr
    );
    assert!(
        outcome.stderr.contains("free some space"),
        "{}",
        outcome.stderr
    );
    let found = desk.pictures("found");
    assert!(
        !found.is_empty() && found.len() < 20,
        "{:?}",
        desk.names("found")
    );
    for name in found.keys() {
        assert!(image::open(desk.path("found").join(name)).is_ok(), "{name}");
    }
    assert!(!desk.has_leftovers("found"), "{:?}", desk.names("found"));
}

#[test]
fn a_shot_that_cannot_be_written_leaves_the_rest_of_the_queue_unharmed() {
    let desk = passing();
    fs::create_dir(desk.path("renders")).unwrap();
    desk.write("renders/passing", "a file");
    let outcome = desk.call("render passing.toml glowing.toml --json");
    assert_eq!(outcome.status, 1);
    assert!(
        outcome.stderr.contains("error: passing.toml: "),
        "{}",
        outcome.stderr
    );
    assert_eq!(outcome.frames("rendered").len(), 6);
    assert_eq!(desk.pictures("renders").len(), 12);
}

#[test]
fn a_read_only_folder_is_found_before_its_first_frame() {
    let desk = passing();
    desk.done("render glowing.toml --frames 1");
    let line = "mount --bind renders renders && mount -o remount,ro,bind renders || exit 77
        $restframe render glowing.toml --json; echo $? > status";
    let outcome = desk.shell(&format!("unshare -rm bash -c '{line}'"));
    let Ok(status) = fs::read_to_string(desk.path("status")) else {
        eprintln!(
            "not tested: nothing can be mounted here: {}",
            outcome.stderr
        );
        return;
    };
    assert_eq!(status.trim(), "1", "{}", outcome.stderr);
    assert!(outcome.stderr.contains("read-only"), "{}", outcome.stderr);
    assert_eq!(outcome.frames("kept"), [1]);
    assert_eq!(outcome.frames("failed"), [0_u64; 0]);
}
