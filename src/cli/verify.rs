//! `restframe verify`.

use super::answer::Answer;
use super::render::check_scale;
use super::{FAILURE, Failed, FinishedArguments, MISTAKE, failed, mistaken, misused, print};
use crate::queue::{Reel, ReelError};
use crate::sequence::{Finding, Report, verify};
use crate::shot::{self, Mistakes};
use serde::{Serialize, Serializer};
use serde_json::{Value, json};
use std::borrow::Cow;
use std::path::Path;

/// Looks at the frames of every shot; one with a mistake does not keep the others from it.
pub(super) fn run(arguments: &FinishedArguments) -> Result<(), Failed> {
    let mut worst = None;
    let mut list = arguments.json.then(List::new);
    for path in &arguments.shots {
        let reel = match open(path, arguments) {
            Ok(reel) => reel,
            Err(unopened) => {
                if let Some(list) = &mut list {
                    list.add(&unopened.as_json(path))?;
                }
                worst = worse(worst, unopened.failed);
                continue;
            }
        };
        let report = verify(&reel);
        if !report.findings.is_empty() {
            worst = worse(worst, Failed(FAILURE));
        }
        match &mut list {
            Some(list) => list.add(&Answered {
                shot: path.to_string_lossy(),
                folder: reel.folder.to_string_lossy(),
                frames: report.frames,
                sound: report.sound(),
                findings: Each(&reel, &report.findings),
            })?,
            None => tell(path, &report)?,
        }
    }
    list.map_or(Ok(()), List::end)?;
    worst.map_or(Ok(()), Err)
}

/// The answer as JSON, shot by shot.
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

/// What is told of a shot.
#[derive(Serialize)]
struct Answered<'a> {
    shot: Cow<'a, str>,
    folder: Cow<'a, str>,
    frames: u32,
    sound: u32,
    findings: Each<'a>,
}

/// Findings, each frame of a run by itself.
struct Each<'a>(&'a Reel, &'a [Finding]);

impl Serialize for Each<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self(reel, findings) = *self;
        let file = |frame| reel.files(frame).into_iter().next().unwrap_or_default();
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

/// A shot whose frames cannot be looked at; why, has been said.
pub(super) struct Unopened {
    pub(super) failed: Failed,
    why: Why,
}

/// As it stands in an answer.
enum Why {
    Mistakes(Value),
    Words(String),
}

impl Unopened {
    /// Says why.
    pub(super) fn say(why: &str) -> Self {
        Self {
            failed: failed(why),
            why: Why::Words(why.to_owned()),
        }
    }

    fn mistaken(mistakes: &Mistakes) -> Self {
        Self {
            failed: mistaken(mistakes),
            why: Why::Mistakes(mistakes.json()),
        }
    }

    /// What stands in the answer for the shot.
    pub(super) fn as_json(&self, shot: &Path) -> Value {
        let shot = shot.to_string_lossy();
        match &self.why {
            Why::Mistakes(mistakes) => json!({"shot": shot, "mistakes": mistakes}),
            Why::Words(words) => json!({"shot": shot, "error": words}),
        }
    }
}

/// The finished frames of a shot.
pub(super) fn open(path: &Path, arguments: &FinishedArguments) -> Result<Reel, Unopened> {
    let shot = shot::load(path).map_err(|m| Unopened::mistaken(&m))?;
    let request = arguments.pictures.request(None);
    if let Err(why) = check_scale(&shot, &request) {
        let failed = misused(&why);
        let why = Why::Words(why);
        return Err(Unopened { failed, why });
    }
    Reel::open(&shot, &request).map_err(|error| match error {
        ReelError::Mistakes(mistakes) => Unopened::mistaken(&mistakes),
        error @ ReelError::Folder { .. } => Unopened::say(&error.to_string()),
    })
}

/// Of two failures the one that no further try will help.
pub(super) fn worse(old: Option<Failed>, new: Failed) -> Option<Failed> {
    Some(match old {
        Some(Failed(MISTAKE)) => Failed(MISTAKE),
        _ => new,
    })
}
