//! `restframe probe`.

use super::{Failed, ProbeArguments, mistaken, misused, print, print_json};
use crate::probe::{Probe, probe};
use crate::queue::Prepared;
use crate::render::{View, motion_mistake, rows, spliced};
use crate::scene::Scene;
use crate::trace::Stage;

/// Answers for the centre of one pixel, under the effects of the splice that it lies in.
pub(super) fn run(arguments: &ProbeArguments) -> Result<(), Failed> {
    let prepared = Prepared::read(&arguments.shot).map_err(|m| mistaken(&m))?;
    let shot = &prepared.shot;
    let (frame, pixel) = (arguments.frame, [arguments.pixel[0], arguments.pixel[1]]);
    if !(1..=shot.shot.frames).contains(&frame) {
        return Err(misused(&format!(
            "the shot has frames 1 to {}, not {frame}",
            shot.shot.frames
        )));
    }
    let [width, height] = shot.image.size;
    if pixel[0] >= width || pixel[1] >= height {
        return Err(misused(&format!(
            "pixel {} {} lies outside the image of {width} x {height}",
            pixel[0], pixel[1]
        )));
    }
    let (exposing, _) = prepared.exposure().map_err(|m| mistaken(&m))?;
    let scene = Scene::resolve(shot, &prepared.library, frame, None).map_err(|m| mistaken(&m))?;
    let stage = Stage::build(&scene.geometry, None);
    let splice = shot
        .splice
        .iter()
        .rev()
        .find(|s| rows(s, height).contains(&pixel[1]));
    let effects = splice.map_or(shot.effects, |splice| spliced(&shot.effects, splice));
    let view = View::new(shot, frame, &effects, &scene, &stage)
        .map_err(|error| mistaken(&motion_mistake(shot, &error)))?;
    let stops = exposing.stops(frame, shot.shot.frames);
    let answer = probe(shot, frame, pixel, &view, &scene, stops);
    if arguments.json {
        print_json(&answer)
    } else {
        print(&described(&answer))
    }
}

fn described(probe: &Probe) -> String {
    let [x, y] = probe.pixel;
    let mut lines = vec![format!("frame {}, pixel {x} {y}", probe.frame)];
    match &probe.hit {
        None if probe.direction.is_none() => {
            lines.push("sees nothing: it lies outside of the fisheye's circle".to_owned());
        }
        None => lines.push("sees the background".to_owned()),
        Some(hit) => {
            let [ex, ey, ez] = hit.event.x;
            let [nx, ny, nz] = hit.normal;
            lines.push(format!(
                "sees model \"{}\", material \"{}\", on worldline \"{}\"",
                hit.model, hit.material, hit.worldline
            ));
            lines.push(format!(
                "  emitted at  t = {:.9e}, x = ({ex:.9e}, {ey:.9e}, {ez:.9e}) m in the lab",
                hit.event.t
            ));
            lines.push(format!("  distance    {:.9e} m in the lab", hit.distance));
            lines.push(format!(
                "  normal      ({nx:.6}, {ny:.6}, {nz:.6}) in its rest frame"
            ));
            lines.push(format!("  Doppler     D = {:.12e}", hit.doppler));
        }
    }
    let peak = probe
        .wavelengths
        .iter()
        .zip(&probe.radiance)
        .max_by(|a, b| a.1.total_cmp(b.1))
        .filter(|(_, radiance)| **radiance > 0.0);
    if let Some((nm, radiance)) = peak {
        lines.push(format!(
            "  radiance    peaks at {nm:.1} nm: {radiance:.6e} W/m2/sr/nm"
        ));
    }
    let [bx, by, bz] = probe.xyz;
    let [r, g, b] = probe.rgb;
    lines.push(format!("  XYZ         {bx:.6e} {by:.6e} {bz:.6e} cd/m2"));
    lines.push(format!("  linear sRGB {r:.6} {g:.6} {b:.6} after exposure"));
    lines.join("\n")
}
