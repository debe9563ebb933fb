//! What programs are told.

use super::desk::{events, passing};

#[test]
fn each_event_is_a_line_of_json_and_the_last_is_the_summary() {
    let desk = passing();
    desk.done("render glowing.toml --frames 2");
    let outcome = desk.done("render glowing.toml passing.toml --frames 1-3 --json");
    let told = outcome.events();
    assert_eq!(told[0]["event"], "start");
    assert_eq!(told[0]["schema_version"], 1);
    assert_eq!(
        told[0]["shots"],
        serde_json::json!(["glowing.toml", "passing.toml"])
    );
    assert_eq!(told[0]["frames"], 6);
    assert_eq!(told[1]["status"], "kept");
    assert_eq!(told[1]["frame"], 2);
    let files = [
        "renders/glowing/glowing.0002.png",
        "renders/glowing/glowing.0002.exr",
    ];
    assert_eq!(told[1]["files"], serde_json::json!(files));
    let rendered = told.iter().filter(|event| event["status"] == "rendered");
    for event in rendered.clone() {
        assert!(event["seconds"].as_f64().unwrap() > 0.0, "{event}");
        assert!(event["because"].is_null(), "{event}");
    }
    assert_eq!(rendered.count(), 5);
    let last = told.last().unwrap();
    assert_eq!(last["event"], "summary");
    assert_eq!(
        (&last["rendered"], &last["kept"], &last["exit"]),
        (&5.into(), &1.into(), &0.into())
    );
}

#[test]
fn progress_as_json_is_on_standard_error_alone() {
    let desk = passing();
    let outcome = desk.done("render passing.toml --frames 1-2 --progress json");
    assert_eq!(outcome.stdout, "");
    let kinds: Vec<_> = events(&outcome.stderr)
        .iter()
        .map(|event| event["event"].as_str().unwrap().to_owned())
        .collect();
    assert_eq!(kinds, ["start", "frame", "frame", "assembled", "summary"]);
}

#[test]
fn open_job_description_is_told_per_cents_that_rise_to_100_and_frames() {
    let desk = passing();
    let outcome = desk.done("render passing.toml --frames 1-5 --progress openjd");
    let mut percents = Vec::new();
    let mut frames = 0;
    for line in outcome.stdout.lines() {
        if let Some(percent) = line.strip_prefix("openjd_progress: ") {
            percents.push(percent.parse::<f64>().unwrap());
        } else {
            frames += 1;
            assert!(
                line.starts_with(&format!("openjd_status: frame {frames}/5  rendered  ")),
                "{line}"
            );
        }
    }
    assert_eq!(frames, 5);
    assert!(
        percents.is_sorted() && percents.last() == Some(&100.0),
        "{percents:?}"
    );
    let both = desk.call("render passing.toml --json --progress openjd");
    assert_eq!(both.status, 2);
}

#[cfg(target_os = "linux")]
#[test]
fn events_that_are_lost_for_want_of_room_make_a_failure_of_a_finished_run() {
    let desk = passing();
    for mode in ["--json", "--progress openjd"] {
        let outcome = desk.shell(&format!(
            "exec $restframe render passing.toml --frames 1-3 {mode} > /dev/full"
        ));
        assert_eq!(outcome.status, 1, "{mode}: {}", outcome.stderr);
        let told = outcome.stderr.contains("error: standard output: ");
        assert!(told, "{mode}: {}", outcome.stderr);
        assert_eq!(desk.pictures("renders").len(), 3);
    }
}

#[test]
fn readers_who_go_away_do_no_harm() {
    let desk = passing();
    let line = "($restframe render passing.toml --json 2>&1; echo $? > status) | head -c 1";
    desk.shell(line);
    assert_eq!(std::fs::read_to_string(desk.path("status")).unwrap(), "0\n");
    assert_eq!(desk.pictures("renders").len(), 20);
}
