//! `restframe probe`: what the center of one pixel sees.

use super::{Failed, ProbeArguments, failed, mistaken, misused, print, print_json};
use crate::frame::Frame;
use crate::plot::{Page, lay_out, svg};
use crate::probe::{Probe, ProbeNode, plot, probe, wide_band};
use crate::render::{Prepared, View};
use crate::scene::Scene;
use crate::shot::SensorColor;
use crate::store::{Names, write_atomically};
use crate::trace::build_aggregate;
use std::path::Path;

/// The page of a plot: two panels side by side, fit for a page of text.
const PAGE: Page = Page {
    size: [1120.0, 460.0],
    font: 14.0,
};

/// Probes the center of one pixel, under the effects of the splice that contains it.
pub(super) fn run(arguments: &ProbeArguments) -> Result<(), Failed> {
    if arguments
        .plot
        .as_deref()
        .is_some_and(|file| same(file, &arguments.shot))
    {
        return Err(misused(
            "the plot would take the place of the shot: give --plot another file",
        ));
    }
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
    let (shot_exposure, _) = prepared.exposure().map_err(|m| mistaken(&m))?;
    let frame = &Frame::new(shot, frame).map_err(|m| mistaken(&m))?;
    let scene = Scene::resolve(frame, &prepared.library, None).map_err(|m| mistaken(&m))?;
    let aggregate = build_aggregate(&scene.geometry, None);
    let effects = frame.effects_at(pixel[1]);
    let view = View::new(frame, &effects, &scene, &aggregate);
    let stops = shot_exposure.stops(frame);
    let answer = probe(frame, pixel, &view, &scene, stops);
    if let Some(file) = &arguments.plot {
        let stem = || Names::new(shot).stem;
        let title = shot.shot.title.clone().unwrap_or_else(stem);
        let wide = wide_band(frame, &answer, &view, &scene);
        let plot = plot(&title, shot.sensor.window, &answer, &wide);
        let text = svg(&lay_out(&plot, PAGE));
        write_atomically(file, text.as_bytes()).map_err(|error| failed(&error.to_string()))?;
    }
    if arguments.json {
        print_json(&answer)
    } else {
        print(&described(&answer, shot.sensor.color))
    }
}

/// Whether two paths lead to the same existing file.
fn same(one: &Path, other: &Path) -> bool {
    matches!((one.canonicalize(), other.canonicalize()), (Ok(one), Ok(other)) if one == other)
}

fn described(probe: &Probe, color: SensorColor) -> String {
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
    if probe.chain.len() > 1 {
        lines.push("  by mirrors and glass:".to_owned());
        lines.extend(
            probe
                .chain
                .iter()
                .enumerate()
                .map(|(i, node)| link(i, node)),
        );
    }
    if probe.cut > 0.0 {
        let enough = probe.enough_bounces.map_or_else(String::new, |bounces| {
            format!("; effects.bounces = {bounces} would leave out less than 0.5 %")
        });
        lines.push(format!(
            "  not followed {:.3e} of the light that arrives there{enough}",
            probe.cut
        ));
    }
    let peak = probe
        .wavelengths
        .iter()
        .zip(&probe.radiance)
        .max_by(|a, b| a.1.total_cmp(b.1))
        .filter(|(_, radiance)| **radiance > 0.0);
    if let Some((nm, radiance)) = peak {
        lines.push(format!(
            "  radiance    peaks at {}: {radiance:.6e} W/m2/sr/nm",
            length(*nm)
        ));
    }
    let [bx, by, bz] = probe.xyz;
    let [r, g, b] = probe.rgb;
    lines.push(format!("  XYZ         {bx:.6e} {by:.6e} {bz:.6e} cd/m2"));
    let channels = match color {
        SensorColor::Cie1931 => "linear sRGB",
        SensorColor::Bands => "bands      ",
    };
    lines.push(format!("  {channels} {r:.6} {g:.6} {b:.6} after exposure"));
    lines.join("\n")
}

/// A line on one node of the shade tree.
fn link(index: usize, node: &ProbeNode) -> String {
    let what = match &node.hit {
        Some(hit) => format!("\"{}\" on \"{}\"", hit.model, hit.worldline),
        None => "the background".to_owned(),
    };
    let how = match (node.parent, node.by) {
        (Some(parent), Some(by)) => format!(
            "by {by} of {parent}: coefficient {:.6}, D = {:.12e} to it",
            node.coefficient, node.doppler
        ),
        _ => "seen directly".to_owned(),
    };
    format!("  {index:>3}  {what}, {how}")
}

/// A wavelength in nm, with an exponent if far from the visible.
fn length(nm: f64) -> String {
    if (10.0..1e5).contains(&nm) {
        format!("{nm:.1} nm")
    } else {
        format!("{nm:.4e} nm")
    }
}
