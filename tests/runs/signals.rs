//! Stopped by a signal.
#![cfg(unix)]

use super::desk::{PASSING, passing};
use crate::common::desk::{Desk, Outcome};
use std::io::{BufRead, BufReader, Read};
use std::process::{Child, Command};
use std::time::{Duration, Instant};

/// Promised from the signal to the end; and what this machine may add when it is busy.
const PROMISED: Duration = Duration::from_secs(2);
const BUSY: Duration = Duration::from_millis(500);

fn signal(child: &Child, name: &str) {
    let kill = Command::new("kill")
        .args([name, &child.id().to_string()])
        .status();
    assert!(kill.unwrap().success());
}

#[test]
fn a_signal_in_mid_frame_ends_the_run_in_two_seconds_and_the_next_goes_on() {
    for (name, status) in [("-TERM", 143), ("-INT", 130)] {
        let desk = passing();
        let slow = PASSING
            .replace("samples = 4", "samples = 300")
            .replace("frames = 20", "frames = 8");
        desk.write("slow.toml", &slow);
        let call = "render slow.toml --json --progress none";
        let mut child = desk.spawn(call);
        let mut lines = BufReader::new(child.stdout.take().unwrap()).lines();
        let rendered = lines
            .by_ref()
            .find(|line| line.as_ref().unwrap().contains("rendered"));
        assert!(rendered.is_some());
        std::thread::sleep(Duration::from_millis(20));
        signal(&child, name);
        let begun = Instant::now();
        let rest: Vec<String> = lines.map(Result::unwrap).collect();
        let mut stderr = String::new();
        child
            .stderr
            .take()
            .unwrap()
            .read_to_string(&mut stderr)
            .unwrap();
        assert_eq!(child.wait().unwrap().code(), Some(status), "{stderr}");
        assert!(begun.elapsed() < PROMISED + BUSY, "{:?}", begun.elapsed());
        let summary: serde_json::Value = serde_json::from_str(rest.last().unwrap()).unwrap();
        assert_eq!(
            (&summary["event"], &summary["exit"]),
            (&"summary".into(), &status.into())
        );
        let finished = summary["rendered"].as_u64().unwrap();
        let told = format!(
            "stopped: {finished} frame{} finished, {} left; the same call goes on from there\n",
            if finished == 1 { "" } else { "s" },
            8 - finished
        );
        assert_eq!(stderr, told);
        assert!(
            !desk.has_leftovers("renders"),
            "{:?}",
            desk.names("renders")
        );
        assert_eq!(desk.recorded("renders").len() as u64, finished);
        let next = desk.done(call);
        assert_eq!(next.frames("kept").len() as u64, finished);
        assert_eq!(next.frames("rendered").len() as u64, 8 - finished);
        desk.done("render slow.toml --out whole");
        assert!(desk.pictures("renders") == desk.pictures("whole"));
    }
}

/// Work that cannot stop: it waits for a reader of its events, who never comes. (A pipe holds 64
/// KiB; a frame's event is longer by the folder's name.)
fn stuck(desk: &Desk) -> Child {
    let shot = PASSING
        .replace("frames = 20", "frames = 400")
        .replace("[64, 36]", "[2, 2]");
    desk.write("stuck.toml", &shot);
    let deep = ["f".repeat(250), "g".repeat(250), "h".repeat(250)].join("/");
    let child = desk.spawn(&format!(
        "render stuck.toml --json --progress none --out {deep}"
    ));
    let begun = Instant::now();
    let (mut last, mut now) = (0, 0);
    // Until no frame has been added for a while.
    while (now == 0 || now != last) && begun.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(400));
        (last, now) = (now, desk.pictures(&deep).len());
    }
    child
}

#[test]
fn a_run_that_cannot_stop_is_ended_in_two_seconds() {
    let desk = passing();
    let mut child = stuck(&desk);
    let begun = Instant::now();
    signal(&child, "-TERM");
    assert_eq!(child.wait().unwrap().code(), Some(143));
    let took = begun.elapsed();
    assert!(took < PROMISED + BUSY, "{took:?}");
    assert!(took > Duration::from_secs(1), "it was not stuck: {took:?}");
}

#[test]
fn a_second_signal_ends_the_run_at_once() {
    let desk = passing();
    let mut child = stuck(&desk);
    let begun = Instant::now();
    signal(&child, "-INT");
    std::thread::sleep(Duration::from_millis(100));
    signal(&child, "-INT");
    assert_eq!(child.wait().unwrap().code(), Some(130));
    let took = begun.elapsed();
    assert!(took < Duration::from_secs(1), "{took:?}");
}

#[test]
fn an_interrupt_that_the_caller_ignores_stays_ignored() {
    let desk = passing();
    desk.write(
        "passing.toml",
        PASSING.replace("samples = 4", "samples = 60"),
    );
    let line = "trap '' INT
        $restframe render passing.toml --json --progress none > events &
        until grep -qs rendered events; do sleep 0.01; done
        kill -INT $!; grep -c summary events > ended; wait $!; status=$?
        cat events; exit $status";
    let outcome: Outcome = desk.shell(line);
    let ended = std::fs::read_to_string(desk.path("ended")).unwrap();
    assert_eq!(ended, "0\n", "the signal came after the end");
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    assert_eq!(outcome.frames("rendered").len(), 20);
}
