//! `restframe render`.

use super::{Failed, RenderArguments, failed, mistaken, misused, say};
use crate::queue::{
    Exposing, FrameList, Prepared, Progress, Request, Resolved, options, render_shot,
};
use crate::shot::LARGEST_SIDE;
use std::collections::HashMap;

/// Reads all shots before the first is rendered, so that a mistake in the last one shows at once
/// and not in the morning.
pub(super) fn run(arguments: &RenderArguments) -> Result<(), Failed> {
    let request = Request {
        out: arguments.out.clone(),
        frames: arguments.frames.clone().unwrap_or_else(FrameList::all),
        scale: arguments.scale,
        samples: arguments.samples,
    };
    pool(arguments.threads)?.install(|| {
        let shots = read_all(arguments)?;
        let work = plan_work(&shots, &request)?;
        render_all(&shots, &work, &request, arguments)
    })
}

/// So many threads; 0 for one a processor.
pub(super) fn pool(threads: u16) -> Result<rayon::ThreadPool, Failed> {
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads.into())
        .build()
        .map_err(|error| failed(&error.to_string()))
}

fn read_all(arguments: &RenderArguments) -> Result<Vec<Prepared>, Failed> {
    let mut shots = Vec::new();
    let mut wrong = None;
    for path in &arguments.shots {
        match Prepared::read(path) {
            Ok(prepared) => shots.push(prepared),
            Err(mistakes) => wrong = Some(mistaken(&mistakes)),
        }
    }
    for prepared in &shots {
        warn(prepared);
    }
    match wrong.or_else(|| same_folder(&shots)) {
        Some(wrong) => Err(wrong),
        None => Ok(shots),
    }
}

/// Two shots whose images would have the same names.
fn same_folder(shots: &[Prepared]) -> Option<Failed> {
    let mut seen = HashMap::new();
    shots.iter().find_map(|prepared| {
        let path = prepared.shot.path.display().to_string();
        let other = seen.insert(prepared.stem(), path.clone())?;
        Some(misused(&format!(
            "{other} and {path} would write the same images; rename one, or render them apart with --out"
        )))
    })
}

/// What the shot's files ask for and the picture will not show.
pub(super) fn warn(prepared: &Prepared) {
    let mut seen: Vec<(&std::path::Path, String)> = Vec::new();
    for warning in prepared.library.warnings(&prepared.shot) {
        if !seen.contains(&warning) {
            say(&format!("warning: {}: {}", warning.0.display(), warning.1));
            seen.push(warning);
        }
    }
}

fn plan_work(shots: &[Prepared], request: &Request) -> Result<Vec<Vec<u32>>, Failed> {
    shots
        .iter()
        .map(|prepared| {
            let frames = prepared.shot.shot.frames;
            let Resolved {
                frames: chosen,
                outside,
            } = request.frames.resolve(frames);
            let path = prepared.shot.path.display();
            check_scale(prepared, request)?;
            if chosen.is_empty() {
                return Err(misused(&format!(
                    "{path} has frames 1 to {frames}; none was chosen"
                )));
            }
            if outside > 0 {
                say(&format!(
                    "warning: {path} has frames 1 to {frames}; {outside} others are left out"
                ));
            }
            Ok(chosen)
        })
        .collect()
}

/// A scale that makes an image larger than any may be.
pub(super) fn check_scale(prepared: &Prepared, request: &Request) -> Result<(), Failed> {
    let [width, height] = prepared
        .shot
        .image
        .size
        .map(|side| f64::from(side) * request.scale);
    if width.max(height).round() <= f64::from(LARGEST_SIDE) {
        return Ok(());
    }
    Err(misused(&format!(
        "--scale {} makes {width:.0} x {height:.0} pixels of {}; a side has at most {LARGEST_SIDE}",
        request.scale,
        prepared.shot.path.display()
    )))
}

fn render_all(
    shots: &[Prepared],
    work: &[Vec<u32>],
    request: &Request,
    arguments: &RenderArguments,
) -> Result<(), Failed> {
    let rays = |(prepared, frames): (&Prepared, &Vec<u32>)| {
        let options = options(&prepared.shot, request);
        let pixels = u64::from(options.width) * u64::from(options.height);
        pixels * u64::from(options.samples) * frames.len() as u64
    };
    let total = shots.iter().zip(work).map(rays).sum();
    let frames = work.iter().map(|frames| frames.len() as u64).sum();
    let progress = Progress::new(arguments.progress.into(), total, frames);
    let mut failures = 0;
    for (prepared, frames) in shots.iter().zip(work) {
        let (exposing, kept) = prepared.exposure().map_err(|m| mistaken(&m))?;
        let path = prepared.shot.path.display();
        if matches!(exposing, Exposing::Black) {
            progress.note(&format!(
                "warning: {path}: frame 1 is black, so exposure is 0 stops; give sensor.exposure"
            ));
        }
        for (frame, error) in render_shot(prepared, &exposing, request, frames, kept, &progress) {
            progress.note(&format!("error: {path}: frame {frame}: {error}"));
            failures += 1;
        }
    }
    progress.finish();
    match failures {
        0 => Ok(()),
        1 => Err(failed("1 frame is missing")),
        n => Err(failed(&format!("{n} frames are missing"))),
    }
}
