//! Shared among machines.

use super::desk::Desk;

#[test]
fn shards_in_any_order_on_any_threads_are_the_whole_byte_by_byte() {
    let desk = Desk::new();
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

#[test]
fn a_shard_without_frames_has_nothing_to_do_and_one_out_of_range_is_refused() {
    let desk = Desk::new();
    let outcome = desk.done("render passing.toml --frames 1-2 --shard 3/3");
    assert_eq!(outcome.stderr, "");
    for shard in ["0/3", "4/3", "1", "a/b"] {
        let outcome = desk.call(&format!("render passing.toml --shard {shard}"));
        assert_eq!(outcome.status, Some(2));
        assert!(outcome.stderr.contains("write K/N"), "{}", outcome.stderr);
    }
}
