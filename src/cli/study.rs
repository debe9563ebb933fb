//! `restframe study`: time and error of the accuracy settings.

use super::{Failed, StudyArguments, failed, mistaken, misused, pool, print, say, warn};
use crate::render::{Options, Prepared};
use crate::store::{Names, write_atomically};
use crate::study::{self, StudyError, default_frame, default_size, report};
use std::path::Path;

/// Studies one image and writes the report.
pub(super) fn run(arguments: &StudyArguments) -> Result<(), Failed> {
    pool(arguments.threads)?.install(|| {
        let prepared = Prepared::read(&arguments.shot).map_err(|m| mistaken(&m))?;
        warn(&prepared);
        let frame = frame(&prepared, arguments.frame)?;
        let options = size(&prepared, arguments)?;
        let folder = arguments.out.join(Names::new(&prepared.shot).stem);
        let scratch = scratch(&folder)?;
        let request = study::Request {
            frame,
            options,
            repeats: arguments.repeats,
            scratch: scratch.path().to_owned(),
        };
        let found = study::study(&prepared, &request, &|news| {
            say(&format!("studying {news}"))
        })
        .map_err(|error| match error {
            StudyError::Mistakes(mistakes) => mistaken(&mistakes),
            error => failed(&error.to_string()),
        })?;
        if found.noise.too_noisy {
            say("warning: the machine was too busy: times of equal work differ by more than 10 %");
        }
        let json = report::json(&found);
        write(&folder.join("study.html"), &report::html(&found))?;
        write(&folder.join("study.csv"), &report::csv(&found))?;
        write(&folder.join("study.json"), &json)?;
        if arguments.json {
            print(&json)
        } else {
            print(&folder.join("study.html").display().to_string())
        }
    })
}

/// Scratch folder on the disk that images go to; its files are written only to time writing.
fn scratch(folder: &Path) -> Result<tempfile::TempDir, Failed> {
    std::fs::create_dir_all(folder)
        .and_then(|()| tempfile::tempdir_in(folder))
        .map_err(|error| {
            failed(&format!(
                "cannot make {}: {error}; name another folder with --out",
                folder.display()
            ))
        })
}

fn write(file: &Path, text: &str) -> Result<(), Failed> {
    write_atomically(file, text.as_bytes()).map_err(|error| failed(&error.to_string()))
}

/// The frame asked for, or the default.
fn frame(prepared: &Prepared, asked: Option<u32>) -> Result<u32, Failed> {
    let frames = prepared.shot.shot.frames;
    match asked {
        None => default_frame(&prepared.shot).map_err(|m| mistaken(&m)),
        Some(frame) if (1..=frames).contains(&frame) => Ok(frame),
        Some(frame) => Err(misused(&format!(
            "the shot has frames 1 to {frames}, not {frame}"
        ))),
    }
    let mut most = (0, 1);
    let mut all = Frames::new(shot);
    for number in 1..=frames {
        let frame = all.at(number).map_err(|m| mistaken(&m))?;
        let effects = frame.active_effects(&frame.effects);
        most = most.max((effects.count(), number));
    }
    Ok(most.1)
}

/// Size and samples asked for, or the default, without layers.
fn size(prepared: &Prepared, arguments: &StudyArguments) -> Result<Options, Failed> {
    let shot = &prepared.shot;
    let request = default_size(shot, arguments.scale, arguments.samples);
    request.check(shot).map_err(|why| misused(&why))?;
    Ok(Options {
        layers: Vec::new(),
        ..request.options(shot)
    })
}
