//! Plot of a pixel's curves for an inset in the image itself.
//!
//! Both axes stay the same from frame to frame as far as possible, so that the curves are seen to
//! move. Wavelengths cover a decade to each side of the sensor's window (for an eye: 50 to 5000 nm,
//! the range of the paper's curves), on a logarithmic axis, on which a Doppler shift moves a curve
//! and keeps its shape. Spectral radiance is linear, so that the sum is visible as one; its axis
//! ends at the radiance of a flat spectrum whose luminance (for bands, whose mean) the frame's
//! exposure brings to 1 or, if the curves are higher, at a higher round value. Both ends are
//! rounded to 1, 2 or 5. Curves are evaluated as their author wrote them, however
//! `accuracy.spectra` represents them for the image.

use super::pixel::look;
use super::plot::{SPACING, SURFACE, THERMAL_LIGHT, UNIT, curve, digits, peak, visible};
use crate::accel::Aggregate;
use crate::color::cie;
use crate::film::Channels;
use crate::frame::{Frame, Sensor};
use crate::plot::{Axis, Color, LEAST_INSET, Panel, Plot, Scale, Stroke, round_up};
use crate::render::{self, InsetTooSmall, Member, View};
use crate::scene::{Scene, Thermal};
use crate::shade::Radiance;
use crate::shot::Effects;
use crate::trace::{Seen, ShadeTrees};

/// Gray, which is distinct from the others without color vision.
const SUM: Color = [165, 165, 165];
/// Room above the highest point of a curve.
const HEADROOM: f64 = 1.03;
/// Ratio of the ends of the axis to those of the window.
const BESIDE: f64 = 10.0;
/// Number of wavelengths of a curve at most: more than any image has columns for it.
const MOST: f64 = 8192.0;

/// What the insets of an image of `size` pixels show, in the order of the shot's. Exposure is in stops.
pub fn insets(
    member: Member<'_>,
    aggregate: &Aggregate,
    exposure: f64,
    size: [u32; 2],
) -> Vec<Result<Plot, InsetTooSmall>> {
    let Member { frame, scene } = member;
    let seen: Vec<Result<([u32; 2], Effects), InsetTooSmall>> = frame
        .insets
        .iter()
        .map(|inset| {
            let pixel = inset.pixel_of(frame.image.size);
            let (_, [_, height]) = inset.place_in(size);
            match f64::from(height) < LEAST_INSET {
                true => Err(InsetTooSmall { pixel, height }),
                false => Ok((pixel, frame.effects_at(pixel[1]))),
            }
        })
        .collect();
    // One view at a time: insets under the same effects share it.
    let mut plots: Vec<Option<Plot>> = vec![None; seen.len()];
    for first in 0..seen.len() {
        let (Ok((_, effects)), None) = (&seen[first], &plots[first]) else {
            continue;
        };
        let view = View::new(frame, effects, scene, aggregate);
        for (plot, seen) in plots.iter_mut().zip(&seen) {
            if let Ok((pixel, under)) = seen
                && under == effects
            {
                *plot = Some(inset(frame, *pixel, &view, scene, exposure));
            }
        }
    }
    let plot = |(seen, plot): (Result<_, _>, Option<Plot>)| {
        seen.map(|_| plot.expect("every inset that is not too small was looked up"))
    };
    seen.into_iter().zip(plots).map(plot).collect()
}

/// The plot of what the center of `pixel`, which lies in the frame's image, sees in `view`. Exposure
/// is in stops.
pub fn inset(
    frame: &Frame<'_>,
    pixel: [u32; 2],
    view: &View<'_>,
    scene: &Scene,
    exposure: f64,
) -> Plot {
    let band = band(frame.sensor.window);
    let count = ((band[1] / band[0]).ln() / SPACING).ceil().min(MOST);
    let shader = view.shader_over(band, count as u32);
    let (light, caption) = match look(frame, pixel, view, scene) {
        Some((trees, _)) => (
            shader.radiance(&trees, trees.roots[0]),
            caption(&trees, view, scene),
        ),
        None => (Radiance::new(count as usize), "nothing is seen".to_owned()),
    };
    let sum = light.total();
    let largest = (peak(&sum) * HEADROOM).max(white(frame, exposure));
    let nm = shader.wavelengths_nm();
    let line = |name: &str, color, width: f64, values| {
        curve(name, color, Stroke::Solid(width), &nm, values)
    };
    // The sum is wide, pale and below, so that its parts are visible on it.
    let series = vec![
        line("sum", SUM, 6.5, sum),
        line("surface", SURFACE, 2.4, light.surface),
        line("thermal", THERMAL_LIGHT, 2.4, light.thermal),
    ];
    Plot {
        caption: vec![caption],
        panels: vec![Panel {
            title: String::new(),
            x: Axis::new("wavelength", "nm", Scale::Log, band),
            y: Axis::in_steps("spectral radiance", UNIT, largest),
            tints: visible(),
            series,
            note: None,
        }],
    }
}

/// Doppler factor and temperature of the first surface.
fn caption(trees: &ShadeTrees, view: &View<'_>, scene: &Scene) -> String {
    let root = trees.roots[0];
    let Some(node) = trees.nodes_of(root).first() else {
        return String::new();
    };
    let doppler = format!("D = {}", digits(node.doppler, 4));
    let Seen::Surface(surface) = &node.seen else {
        return format!("background, {doppler}");
    };
    let thermal = scene.materials[surface.material as usize].thermal.as_ref();
    match thermal.filter(|_| view.effects.thermal) {
        Some(Thermal { temperature_k, .. }) => {
            let decimals = usize::from(*temperature_k < 100.0);
            format!("{doppler}, T = {} K", digits(*temperature_k, decimals))
        }
        None => doppler,
    }
}

/// Spectral radiance of the flat spectrum that is just white in the image, W·m⁻²·sr⁻¹·nm⁻¹; 0 if
/// there is none.
fn white(frame: &Frame<'_>, exposure: f64) -> f64 {
    let Sensor { window, .. } = frame.sensor;
    let of_one = match render::channels(frame.sensor.color) {
        Channels::Xyz => {
            let inside = |nm| f64::from((window[0]..=window[1]).contains(&nm));
            cie::xyz_of(inside)[1]
        }
        Channels::Bands => (window[1] - window[0]) / 3.0,
    };
    let white = 100.0 * (-exposure).exp2() / of_one;
    if white.is_finite() { white } else { 0.0 }
}

/// A decade to each side of a window, rounded inward.
fn band([from, to]: [f64; 2]) -> [f64; 2] {
    // 1, 2 and 5 are their own inverses up to a power of ten.
    [round_up(from / BESIDE), 1.0 / round_up(1.0 / BESIDE / to)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_band_is_a_decade_to_each_side_between_round_wavelengths() {
        for (window, expected) in [
            ([360.0, 830.0], [50.0, 5000.0]),
            ([500.0, 500.001], [50.0, 5000.0]),
            ([1e-6, 2e-6], [1e-7, 2e-5]),
            ([8000.0, 14_000.0], [1000.0, 100_000.0]),
        ] {
            let band = band(window);
            for (found, expected) in band.into_iter().zip(expected) {
                assert!(
                    (found / expected - 1.0).abs() < 1e-12,
                    "{window:?}: {band:?}"
                );
            }
        }
    }
}
