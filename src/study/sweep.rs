//! Measurement of one knob: times, memory and errors of its settings.

use super::errors::{color_differences, errors};
use super::interleaved_timing::{Measured, measure};
use super::knobs::Knob;
use super::results::{Errors, Point, Sweep};
use super::timed_render::{Run, Subject, Variant, phase};
use super::{StudyError, ranking};
use crate::color::spaces;
use crate::film::{Channels, Developed, Film, develop};
use crate::render::development;

/// Measures the settings of a knob in rounds. `noise` is the relative scatter of equal work.
pub(super) fn sweep(
    knob: &Knob,
    subject: &Subject,
    rounds: u32,
    noise: f64,
) -> Result<Sweep, StudyError> {
    let references = measure(&knob.references, subject, 1, |_, run| Ok(run.film.clone()))?;
    let look = |variant: &Variant, run: &Run| {
        if knob.files {
            return file_errors(variant, run, subject);
        }
        let number = knob.reference_of(variant);
        match knob.references.get(number).zip(references.get(number)) {
            Some((exact, (_, film))) => {
                compared(knob, [variant, exact], [&run.film, film], subject)
            }
            None => Ok(Errors::default()),
        }
    };
    let measured = measure(&knob.variants, subject, rounds, look)?;
    let mut points: Vec<Point> = knob
        .variants
        .iter()
        .zip(&measured)
        .map(|(variant, (own, errors))| point(knob, variant, own, Some(*errors)))
        .collect();
    ranking::mark_pareto(&mut points, noise);
    let halving = ranking::halvings(&points);
    for (variant, (own, _)) in knob.references.iter().zip(&references) {
        if points.iter().any(|point| point.setting == variant.setting) {
            continue;
        }
        points.push(point(knob, variant, own, None));
    }
    Ok(Sweep {
        knob: knob.key.to_owned(),
        what: knob.what.to_owned(),
        phase: knob.phase,
        reference: knob.reference.to_owned(),
        points,
        note: knob.note.clone(),
        halving,
    })
}

fn point(knob: &Knob, variant: &Variant, measured: &Measured, errors: Option<Errors>) -> Point {
    Point {
        setting: variant.setting.clone(),
        family: variant.family.clone(),
        toml: variant.toml.clone(),
        current: variant.current,
        frame: measured.frame(),
        phase: measured.phase(phase(knob.phase)),
        memory_mib: measured.memory_mib,
        file_bytes: knob.files.then_some(measured.file_bytes),
        errors,
        pareto: false,
    }
}

/// Errors of a setting against the pixels of its reference.
fn compared(
    knob: &Knob,
    variants: [&Variant; 2],
    films: [&Film; 2],
    subject: &Subject,
) -> Result<Errors, StudyError> {
    let [variant, exact] = variants;
    let [film, reference] = films;
    let mut errors = errors(&variant.shot, film, reference, subject.stops)?;
    if let Some(displacement) = knob.displacement {
        let size = [variant.options.width, variant.options.height];
        let moved = displacement(&exact.view(subject)?, &variant.view(subject)?, size);
        errors.displacement = Some(moved.pixels);
        errors.mistaken = Some(moved.mistaken);
    }
    if knob.phase == "shade" {
        errors.bound = variant.view(subject)?.shader().bound();
    }
    Ok(errors)
}

/// Errors of a file format: the image read back against the film.
fn file_errors(variant: &Variant, run: &Run, subject: &Subject) -> Result<Errors, StudyError> {
    let film = &run.film;
    let exact = develop(film, &development(variant.shot.sensor.color, subject.stops));
    let Some((extension, bytes)) = run.files.first() else {
        return Ok(Errors::default());
    };
    let read = image::load_from_memory(bytes)?;
    let linear = if *extension == "png" {
        let value = |byte: u8| spaces::decode(f64::from(byte) / 255.0) as f32;
        read.to_rgb8().pixels().map(|p| p.0.map(value)).collect()
    } else {
        read.to_rgb32f().pixels().map(|p| p.0).collect()
    };
    let read = Developed {
        linear,
        saturated: 0,
    };
    let as_film = |developed: &Developed| Film {
        xyz: developed.linear.clone(),
        ..Film::default()
    };
    let light = crate::image::compare::relative_rmse(&as_film(&read).xyz, &as_film(&exact).xyz)?;
    Ok(Errors {
        radiance: light,
        delta_e: (film.channels == Channels::Xyz).then(|| color_differences(&read, &exact)),
        ..Errors::default()
    })
}
