//! Shared among machines.

use super::desk::{PASSING, passing};
use crate::common::desk::Outcome;
use std::fs;

#[test]
fn shards_in_any_order_on_any_threads_are_the_whole_byte_by_byte() {
    let desk = passing();
    desk.done("render passing.toml glowing.toml --out whole");
    let whole = desk.pictures("whole");
    assert_eq!(whole.len(), 20 + 2 * 6);
    for (out, order, threads) in [
        ("a", [1, 2, 3], 1),
        ("b", [3, 1, 2], 2),
        ("c", [2, 3, 1], 1),
    ] {
        let mut rendered = 0;
        for k in order {
            let call = format!(
                "render passing.toml glowing.toml --out {out} --threads {threads} --shard {k}/3 --json"
            );
            let frames = desk.done(&call).frames("rendered");
            assert!((6..=13).contains(&frames.len()), "shard {k}: {frames:?}");
            rendered += frames.len();
        }
        assert_eq!(rendered, 26, "no frame in two shards");
        assert!(desk.pictures(out) == whole, "{out}");
    }
}

/// Else each machine would deal out what is left after the folders that it cannot read.
#[test]
fn machines_deal_alike_though_one_cannot_read_a_folder() {
    let desk = passing();
    let other = PASSING.replace("[0.8, 0, 0]", "[0.7, 0, 0]");
    desk.write("other.toml", &other);
    fs::create_dir(desk.path("one")).unwrap();
    desk.write("one/passing", "a file");
    let call = |out: &str, k: u32| {
        let call = "render passing.toml other.toml --frames 1-3 --json";
        desk.call(&format!("{call} --out {out} --shard {k}/2"))
    };
    let [one, two] = [call("one", 1), call("two", 2)];
    assert_eq!((one.status, two.status), (1, 0));
    let told = |outcome: &Outcome| {
        let events = outcome.events().into_iter();
        let of_other = events.filter(|event| event["shot"] == "other.toml");
        of_other
            .filter_map(|event| event["frame"].as_u64())
            .collect()
    };
    let mut frames: Vec<u64> = told(&one);
    frames.extend::<Vec<u64>>(told(&two));
    frames.sort_unstable();
    assert_eq!(frames, [1, 2, 3]);
}

#[test]
fn a_shard_without_frames_says_so_and_one_out_of_range_is_refused() {
    let desk = passing();
    let outcome = desk.done("render passing.toml --frames 1-2 --shard 3/3");
    let warning = "warning: no frame falls to shard 3/3: there are fewer traces than shards\n";
    assert_eq!(outcome.stderr, warning);
    for shard in ["0/3", "4/3", "1", "a/b"] {
        let outcome = desk.call(&format!("render passing.toml --shard {shard}"));
        assert_eq!(outcome.status, 2);
        assert!(outcome.stderr.contains("write K/N"), "{}", outcome.stderr);
    }
}
