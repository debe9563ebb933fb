//! Cost of each effect: the image with and without it, rendered alternately.

use super::interleaved_timing::{median, most_rounds as pairs, timing};
use super::results::EffectCost;
use super::start::Start;
use super::timed_render::StudyError;
use super::timed_render::{Bodies, Subject, Variant};
use crate::frame::{ActiveEffects, Frame, Splice};
use crate::scene::{Library, Scene};
use crate::shot::{Beaming, Effects, Shot, Switch};
use crate::trace::build_aggregate;
use std::sync::Arc;

/// An effect: its name, whether the image needs it, how a shot is changed to be without it, and
/// what the 1990 paper says of it.
struct Effect {
    name: &'static str,
    called: bool,
    off: fn(&mut Effects),
    paper: Option<&'static str>,
}

fn effects(active: &ActiveEffects) -> [Effect; 6] {
    let effect = |name, called, off| Effect {
        name,
        called,
        off,
        paper: None,
    };
    [
        Effect {
            paper: Some("under 5 %"),
            ..effect("geometry", active.geometry, |e| e.geometry = Switch::Off)
        },
        Effect {
            paper: Some("about 2 % by splines, over 100 % by lines"),
            ..effect("doppler", active.doppler, |e| e.doppler = Switch::Off)
        },
        effect("beaming", active.beaming != Beaming::Off, |e| {
            e.beaming = Beaming::Off;
        }),
        effect("thermal", active.thermal, |e| e.thermal = Switch::Off),
        effect("shadows", active.shadows, |e| e.shadows = Switch::Off),
        effect("mirror", active.mirror || active.refraction, |e| {
            e.bounces = 0;
        }),
    ]
}

/// Pairs of renders per round. The cost of an effect can be less than the scatter of times.
const PAIRS: u32 = 3;

/// Costs of all effects, each timed by [`PAIRS`] pairs per round.
pub(super) fn costs(
    start: &Start<'_>,
    library: &Library,
    active: &ActiveEffects,
    subject: &Subject,
    rounds: u32,
) -> Result<Vec<EffectCost>, StudyError> {
    let on = start.as_it_is();
    let mut costs = Vec::new();
    for effect in effects(active) {
        let off = Variant {
            shot: without(start.shot, effect.off),
            ..on.clone()
        };
        let named = match effect.name {
            // The two are switched off together.
            "mirror" if !active.mirror && active.refraction => "refraction",
            name => name,
        };
        let why = active.reasons.iter().find(|reason| reason.effect == named);
        let why = why.map_or_else(String::new, |reason| reason.why.clone());
        costs.push(EffectCost {
            effect: effect.name,
            called: effect.called,
            why,
            paper: effect.paper,
            ..cost([&on, &off], subject, rounds)?
        });
    }
    costs.push(second_worldline(start, library, subject, rounds)?);
    Ok(costs)
}

/// The shot with an effect switched off, in its splices too.
fn without(shot: &Shot, off: fn(&mut Effects)) -> Shot {
    let mut shot = shot.clone();
    for splice in &mut shot.splice {
        let mut effects = Splice::new(splice, &shot.effects).effects;
        off(&mut effects);
        let over = &mut splice.effects;
        over.geometry = Some(effects.geometry);
        over.doppler = Some(effects.doppler);
        over.beaming = Some(effects.beaming);
        over.thermal = Some(effects.thermal);
        over.shadows = Some(effects.shadows);
        over.bounces = Some(effects.bounces);
    }
    off(&mut shot.effects);
    shot
}

/// Cost of bodies and lamps on worldlines of their own, compared with all of them on that of the
/// first model.
fn second_worldline(
    start: &Start<'_>,
    library: &Library,
    subject: &Subject,
    rounds: u32,
) -> Result<EffectCost, StudyError> {
    let mut shot = start.shot.clone();
    let first = shot.model.first().and_then(|model| model.worldline.clone());
    let mut others = 0;
    for worldline in (shot.model.iter_mut().map(|model| &mut model.worldline))
        .chain(shot.light.iter_mut().map(|light| &mut light.worldline))
    {
        others += u32::from(*worldline != first);
        worldline.clone_from(&first);
    }
    let on = start.as_it_is();
    let called = others > 0;
    let off = if called {
        let scene = Scene::resolve(&Frame::new(&shot, start.frame)?, library, None)?;
        let aggregate = build_aggregate(&scene.geometry, None);
        Variant {
            shot,
            bodies: Arc::new(Bodies { scene, aggregate }),
            ..on.clone()
        }
    } else {
        on.clone()
    };
    let why = match others {
        0 => "all bodies and lamps share one".to_owned(),
        1 => "1 model or lamp is on another than the first model; without, it moves along and another image is seen".to_owned(),
        n => format!("{n} models and lamps are on others than the first model; without, they move along and another image is seen"),
    };
    Ok(EffectCost {
        effect: "second worldline",
        called,
        why,
        ..cost([&on, &off], subject, rounds)?
    })
}

/// Times of two variants, rendered alternately, and the cost of the first over the second.
fn cost(
    [on, off]: [&Variant; 2],
    subject: &Subject,
    rounds: u32,
) -> Result<EffectCost, StudyError> {
    let (mut with, mut without) = (Vec::new(), Vec::new());
    let mut round = 0;
    while round < pairs(PAIRS * rounds, with.first().copied()) {
        // The second of a pair finds warmer caches, so the order alternates.
        let pair = if round % 2 == 0 {
            [(on, &mut with), (off, &mut without)]
        } else {
            [(off, &mut without), (on, &mut with)]
        };
        for (variant, seconds) in pair {
            seconds.push(variant.run(subject)?.seconds);
        }
        round += 1;
    }
    let mut ratios: Vec<f64> = with
        .iter()
        .zip(&without)
        .map(|(a, b)| a / b - 1.0)
        .collect();
    ratios.sort_by(f64::total_cmp);
    // Without the outer tenth at either end.
    let tenth = ratios.len().div_ceil(10).min((ratios.len() - 1) / 2);
    Ok(EffectCost {
        effect: "",
        called: false,
        why: String::new(),
        cost: median(&ratios),
        spread: (ratios[ratios.len() - 1 - tenth] - ratios[tenth]) / 2.0,
        on: timing(with),
        off: timing(without),
        paper: None,
    })
}
