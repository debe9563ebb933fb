//! `restframe verify`: checks finished frames.

use super::messages::Answer;
use super::open::{open, worse};
use super::{FAILURE, Failed, FinishedArguments, print};
use crate::sequence::{Finding, Report, verify};
use crate::store::ShotFolder;
use serde::{Serialize, Serializer};
use std::borrow::Cow;
use std::path::Path;

/// Checks the frames of every shot. If one has a mistake, the others are still checked.
pub(super) fn run(arguments: &FinishedArguments) -> Result<(), Failed> {
    let mut worst = None;
    let mut list = arguments.json.then(List::new);
    for path in &arguments.shots {
        let shot_folder = match open(path, &arguments.pictures) {
            Ok(shot_folder) => shot_folder,
            Err(unopened) => {
                if let Some(list) = &mut list {
                    list.add(&unopened.as_json(path))?;
                }
                worst = worse(worst, unopened.failed);
                continue;
            }
        };
        let report = verify(&shot_folder);
        if !report.findings.is_empty() {
            worst = worse(worst, Failed(FAILURE));
        }
        match &mut list {
            Some(list) => list.add(&Answered {
                shot: path.to_string_lossy(),
                folder: shot_folder.path.to_string_lossy(),
                frames: report.frames,
                sound: report.sound(),
                findings: Each(&shot_folder, &report.findings),
            })?,
            None => tell(path, &report)?,
        }
    }
    list.map_or(Ok(()), List::end)?;
    worst.map_or(Ok(()), Err)
}

/// The result as JSON, written shot by shot.
struct List {
    answer: Answer,
    before: &'static str,
}

impl List {
    fn new() -> Self {
        let answer = Answer::new();
        let before = "{\"shots\": [\n";
        Self { answer, before }
    }

    fn add(&mut self, shot: &impl Serialize) -> Result<(), Failed> {
        self.answer.write(self.before)?;
        self.before = ",\n";
        self.answer.json(shot).map(|_| ())
    }

    fn end(mut self) -> Result<(), Failed> {
        self.answer.write("\n]}\n")?;
        self.answer.end()
    }
}

/// The entry of a shot in the JSON output.
#[derive(Serialize)]
struct Answered<'a> {
    shot: Cow<'a, str>,
    folder: Cow<'a, str>,
    frames: u32,
    sound: u32,
    findings: Each<'a>,
}

/// Findings, with each frame of a range listed by itself.
struct Each<'a>(&'a ShotFolder, &'a [Finding]);

impl Serialize for Each<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self(shot_folder, findings) = *self;
        let file = |frame| {
            shot_folder
                .files(frame)
                .into_iter()
                .next()
                .unwrap_or_default()
        };
        let one = |finding: &Finding, frame: u32| Finding {
            frame: Some(frame),
            last: None,
            file: file(frame),
            why: "missing".to_owned(),
            ..finding.clone()
        };
        serializer.collect_seq(findings.iter().flat_map(|finding| {
            let run = finding.last.and_then(|_| finding.frames());
            let alone = run.is_none().then(|| finding.clone());
            let each = run.into_iter().flatten();
            each.map(move |frame| one(finding, frame)).chain(alone)
        }))
    }
}

fn tell(path: &Path, report: &Report) -> Result<(), Failed> {
    for finding in &report.findings {
        print(&finding.to_string())?;
    }
    print(&format!("{}: {}", path.display(), report.summary()))
}
