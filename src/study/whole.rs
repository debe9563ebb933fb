//! A study of one image: every knob, every effect, the phases of its time.

use super::compare_1990::Compared;
use super::interleaved_timing::{Measured, measure, median};
use super::knobs::KNOBS;
use super::results::Study;
use super::results::{Machine, Noise, PhaseTime};
use super::start::{Request, Start};
use super::timed_render::StudyError;
use super::timed_render::{Bodies, PHASES, Subject, Variant};
use super::{effects, knobs, ranking, sweep};
use crate::frame::{ActiveEffects, Frame};
use crate::render::Prepared;
use crate::scene::Scene;
use crate::shot::{Accuracy, Shot, Spectra};
use crate::store::Names;
use crate::trace::build_aggregate;
use std::sync::Arc;

/// Studies one image. `news` receives a line on each step.
///
/// # Errors
/// Mistakes of the frame; files that cannot be written or read.
pub fn study(
    prepared: &Prepared,
    request: &Request,
    news: &dyn Fn(&str),
) -> Result<Study, StudyError> {
    let shot = &prepared.shot;
    let frame = Frame::new(shot, request.frame)?;
    let active = frame.active_effects(&frame.effects);
    let (shot_exposure, _) = prepared.exposure()?;
    let subject = Subject::new(&frame, &shot_exposure, request.scratch.clone());
    let scene = Scene::resolve(&frame, &prepared.library, None)?;
    let aggregate = build_aggregate(&scene.geometry, None);
    let start = Start {
        shot,
        frame: frame.number,
        options: request.options.clone(),
        bodies: Arc::new(Bodies { scene, aggregate }),
    };
    news("what is compared with the paper, and how much equal work differs");
    let compared = compare(&start, &active, &subject, request.repeats)?;
    let noise = noise(&compared);
    let mut sweeps = Vec::new();
    let quick = by_grid(shot);
    let quick = Start {
        shot: &quick,
        ..start.clone()
    };
    for (number, knob) in KNOBS.into_iter().enumerate() {
        // Spectra are the first knob.
        let start = if number == 0 { &start } else { &quick };
        let knob = knob(start, &active);
        news(&format!("{}: {} settings", knob.key, knob.variants.len()));
        sweeps.push(sweep::sweep(
            &knob,
            &subject,
            request.repeats,
            noise.tolerance(),
        )?);
    }
    news("effects, off and on");
    let effects = effects::costs(
        &quick,
        &prepared.library,
        &active,
        &subject,
        request.repeats,
    )?;
    let [current, _, rgb, lines, spline, grid] = &compared;
    let paper = Compared {
        current,
        rgb,
        lines,
        spline,
        grid,
        lines_seen: knobs::lines_seen(shot, 5.0),
        geometry: active.geometry,
        doppler: active.doppler,
    };
    Ok(Study {
        schema_version: 1,
        shot: Names::new(&prepared.shot).stem,
        title: shot.shot.title.clone(),
        frame: frame.number,
        size: [request.options.width, request.options.height],
        samples: request.options.samples,
        machine: Machine {
            processor: processor(),
            threads: rayon::current_num_threads(),
            version: env!("CARGO_PKG_VERSION"),
            repeats: request.repeats,
        },
        noise,
        phases: phases(current),
        recommendations: sweeps
            .iter()
            .flat_map(|sweep| ranking::recommendations(sweep, noise.tolerance()))
            .collect(),
        paper: paper.rows(),
        sweeps,
        effects,
    })
}

/// The shot for knobs other than spectra. Exact spectra would take hours, and do not change the
/// error of another knob.
fn by_grid(shot: &Shot) -> Shot {
    let mut shot = shot.clone();
    if shot.accuracy.spectra == Spectra::Exact {
        shot.accuracy.spectra = Spectra::Grid;
    }
    shot
}

/// The renders to compare: the shot twice; without shift; by lines, splines and the grid.
fn compare(
    start: &Start<'_>,
    active: &ActiveEffects,
    subject: &Subject,
    rounds: u32,
) -> Result<[Measured; 6], StudyError> {
    let held = |spectra: Spectra, wavelengths: u32| Variant {
        shot: Shot {
            accuracy: Accuracy {
                spectra,
                wavelengths,
                line_spacing: 5.0,
                ..start.shot.accuracy
            },
            ..start.shot.clone()
        },
        ..start.as_it_is()
    };
    let variants = [
        start.as_it_is(),
        start.as_it_is(),
        knobs::without_shift(start, active),
        if knobs::lines_seen(start.shot, 5.0) {
            held(Spectra::Lines, 84)
        } else {
            start.as_it_is()
        },
        held(Spectra::Spline, 81),
        held(Spectra::Grid, 84),
    ];
    let mut measured = measure(&variants, subject, rounds, |_, _| Ok(()))?.into_iter();
    Ok(variants.map(|_| measured.next().expect("one is measured for each variant").0))
}

/// Noise above which settings within a tenth of each other cannot be told apart.
const NOISY: f64 = 0.1;

/// Scatter of equal work, from the unchanged shot measured twice.
fn noise(compared: &[Measured; 6]) -> Noise {
    let [one, other, ..] = compared;
    let mut spreads: Vec<f64> = compared
        .iter()
        .map(|measured| {
            let frame = measured.frame();
            (frame.greatest - frame.least) / frame.median
        })
        .collect();
    spreads.sort_by(f64::total_cmp);
    let spread = median(&spreads);
    let duplicate = other.frame().median / one.frame().median;
    Noise {
        spread,
        duplicate,
        too_noisy: spread.max((duplicate - 1.0).abs()) > NOISY,
    }
}

fn phases(measured: &Measured) -> Vec<PhaseTime> {
    let seconds: Vec<f64> = (0..PHASES.len())
        .map(|i| measured.phase(i).median)
        .collect();
    let all: f64 = seconds.iter().sum();
    PHASES
        .iter()
        .zip(&seconds)
        .map(|((phase, what), &seconds)| PhaseTime {
            phase,
            seconds,
            share: seconds / all,
            what,
        })
        .collect()
}

/// Model of the processor, if the system states it.
fn processor() -> Option<String> {
    let text = std::fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = text.lines().find(|line| line.starts_with("model name"))?;
    Some(line.split_once(':')?.1.trim().to_owned())
}
