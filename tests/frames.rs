//! Frame lists against other tools' readings of them, against brute force, and against nonsense.

use proptest::prelude::*;
use restframe::queue::{FrameList, Resolved};
use std::collections::BTreeSet;

/// Made by tests/python/frame_lists.py, which names the tools.
const TABLE: &str = include_str!("frame-lists.tsv");

fn resolve(list: &str, frames: u32) -> Resolved {
    FrameList::parse(list).expect(list).resolve(frames)
}

fn message(list: &str) -> String {
    FrameList::parse(list).expect_err(list).to_string()
}

#[test]
fn lists_mean_what_openjd_and_fileseq_read_in_them() {
    let rows = TABLE.lines().filter(|line| !line.starts_with('#'));
    let mut count = 0;
    for (list, frames) in rows.filter_map(|row| row.split_once('\t')) {
        let frames = frames
            .split(' ')
            .map(|frame| frame.parse::<i64>().expect("a number"));
        let expected: Vec<u32> = frames
            .filter_map(|frame| u32::try_from(frame).ok())
            .collect();
        let expected: Vec<u32> = expected
            .into_iter()
            .filter(|frame| (1..=50).contains(frame))
            .collect();
        assert_eq!(resolve(list, 50).frames, expected, "{list}");
        count += 1;
    }
    assert_eq!(count, 120);
}

#[test]
fn every_spelling_is_read() {
    for (list, expected) in [
        ("7", vec![7]),
        ("1-3,9", vec![1, 2, 3, 9]),
        ("1..3", vec![1, 2, 3]),
        ("1-10:3", vec![1, 4, 7, 10]),
        ("1-10x3", vec![1, 4, 7, 10]),
        ("1..10:4", vec![1, 5, 9]),
        ("8-", vec![8, 9, 10]),
        ("8..", vec![8, 9, 10]),
        ("1-x4", vec![1, 5, 9]),
        (" 1 - 3 , 5 ", vec![1, 2, 3, 5]),
        ("3,1,2-3,001", vec![1, 2, 3]),
        ("-3-2", vec![1, 2]),
        ("-4-10:3", vec![2, 5, 8]),
        ("13-19:3,4,9-12", vec![4, 9, 10]),
    ] {
        assert_eq!(resolve(list, 10).frames, expected, "{list}");
    }
    assert_eq!(FrameList::all().resolve(3), resolve("1-", 3));
    assert_eq!(
        resolve("1-", 3),
        Resolved {
            frames: vec![1, 2, 3],
            outside: 0
        }
    );
}

#[test]
fn frames_that_the_shot_has_not_are_counted() {
    for (list, outside) in [
        ("1-10", 0),
        ("0-11", 2),
        ("-3", 1),
        ("-5--1", 5),
        ("100-", 1),
        ("11,11", 2),
        ("9-20:2", 5),
    ] {
        assert_eq!(resolve(list, 10).outside, outside, "{list}");
    }
    assert_eq!(
        resolve("1-5", 0),
        Resolved {
            frames: vec![],
            outside: 5
        }
    );
}

#[test]
fn an_absurd_range_costs_no_more_than_the_shot() {
    let absurd = resolve("1-4000000000,1-999999999999999999,-999999999999999999-", 3);
    assert_eq!(absurd.frames, [1, 2, 3]);
    assert_eq!(
        resolve("1-999999999999999999:999999999999999999", 3).frames,
        [1]
    );
    assert_eq!(
        resolve("-999999999999999998-9:999999999999999999", 9).frames,
        [1]
    );
    assert_eq!(resolve("1-4000000000", 3).outside, 3_999_999_997);
}

#[test]
fn what_cannot_be_read_is_answered_with_a_hint() {
    for (list, hint) in [
        ("1:10", "USD spelling? write 1-10"),
        ("1:10x3", "USD spelling? write 1-10x3"),
        ("10-1", "descends; write 1-10"),
        (
            "1-10:0",
            "the step of \"1-10:0\" is 0; it must be 1 or more",
        ),
        ("1-10:-2", "it must be 1 or more"),
        ("1-10x0.5", "frames are whole numbers"),
        ("2.5", "frames are whole numbers"),
        ("", "has an empty part"),
        ("1,,2", "has an empty part"),
        ("1,", "has an empty part"),
        ("1 2", "write 7, 1-10"),
        ("all", "write 7, 1-10"),
        ("1-10y3", "write 7, 1-10"),
        ("1-10:3x", "write 7, 1-10"),
        ("5x2", "write 7, 1-10"),
        ("1–10", "write 7, 1-10"),
        ("1-10:", "write 7, 1-10"),
        ("9999999999999999999", "too large"),
    ] {
        let message = message(list);
        assert!(message.contains(hint), "{list}: {message}");
        assert!(
            !message.ends_with('.') && !message.starts_with(char::is_uppercase),
            "{message}"
        );
    }
}

/// First, distance to the last (none for a single frame), step, and whether spelt the other way.
type Part = (i64, Option<(i64, i64)>, bool);

fn spell(&(first, range, other): &Part) -> String {
    match range {
        None => first.to_string(),
        Some((length, step)) if other => format!("{first}..{}x{step}", first + length),
        Some((length, step)) => format!("{first} - {}:{step}", first + length),
    }
}

fn numbers(&(first, range, _): &Part) -> impl Iterator<Item = i64> {
    let (length, step) = range.unwrap_or((0, 1));
    (0..=length)
        .filter(move |n| n % step == 0)
        .map(move |n| first + n)
}

proptest! {
    #[test]
    fn resolving_equals_writing_all_frames_out(
        parts in prop::collection::vec(
            (-50_i64..150, prop::option::of((0_i64..120, 1_i64..30)), any::<bool>()), 1..6),
        frames in 0_u32..120,
    ) {
        let list = parts.iter().map(spell).collect::<Vec<_>>().join(",");
        let all: Vec<i64> = parts.iter().flat_map(numbers).collect();
        let is_inside = |n: &i64| (1..=i64::from(frames)).contains(n);
        let inside = all.iter().copied().filter(is_inside);
        let inside: BTreeSet<u32> = inside.map(|n| n as u32).collect();
        let resolved = resolve(&list, frames);
        prop_assert_eq!(resolved.frames, inside.into_iter().collect::<Vec<_>>());
        prop_assert_eq!(resolved.outside, all.iter().filter(|n| !is_inside(n)).count() as u64);
    }

    #[test]
    fn nonsense_is_refused_or_read_but_never_a_panic(list in "[-0-9.,:x ]{0,24}|\\PC{0,12}") {
        if let Ok(list) = FrameList::parse(&list) {
            let resolved = list.resolve(40);
            prop_assert!(resolved.frames.is_sorted_by(|a, b| a < b));
            prop_assert!(resolved.frames.iter().all(|frame| (1..=40).contains(frame)));
        }
    }
}
