//! Plot of a pixel's curves: in the sensor's window, and over a band wide enough for all light that
//! is shifted into or out of it.

use super::pixel::{Probe, look};
use crate::color::cie::{RANGE_NM, xyz_bar};
use crate::color::spaces::{RGB_FROM_XYZ, apply, encode};
use crate::frame::Frame;
use crate::plot::{Axis, Color, Panel, Plot, Scale, Series, Stroke, Tint};
use crate::render::View;
use crate::scene::Scene;
use crate::shade::Radiance;
use crate::spectrum::{catmull_rom, planck};

/// The band that is always shown, nm: that of the 1990 paper's curves, extended to 50 µm for the
/// thermal light of bodies at room temperature.
const USUAL_BAND: [f64; 2] = [50.0, 50_000.0];
/// Limits of any band, nm: even D of 10²² and its inverse keep the visible within.
const WIDEST_BAND: [f64; 2] = [1e-20, 1e25];
/// Spacing of wavelengths in ln λ: 0.6 nm at 600 nm.
pub(super) const SPACING: f64 = 1e-3;
/// Multiples of the peak wavelength outside of which a black body has less than 1 % of its peak.
const THERMAL: [f64; 2] = [0.328, 6.624];
/// Relative tolerance of a round wavelength.
const ROUNDING: f64 = 1e-9;

/// Share of its own peak down to which the weaker part of the light is shown.
const DEPTH: f64 = 1e-3;
/// Upper and lower limit of that share, relative to the peak of all light.
const DEPTHS: [f64; 2] = [1e-6, 1e-16];

pub(super) const UNIT: &str = "W·m⁻²·sr⁻¹·nm⁻¹";
// Three colors that are distinct in all kinds of color vision (Okabe & Ito 2008), the sum in gray.
const SUM: Color = [110, 110, 110];
pub(super) const SURFACE: Color = [0, 92, 160];
pub(super) const THERMAL_LIGHT: Color = [200, 70, 0];

/// The light of a pixel over a band wider than the sensor's window.
#[derive(Debug, Clone, PartialEq)]
pub struct WideBand {
    /// The band, nm.
    pub band_nm: [f64; 2],
    /// Wavelengths in it, nm, in the camera's rest frame.
    pub wavelengths: Vec<f64>,
    /// Spectral radiance there.
    pub light: Radiance,
}

/// The light of the pixel of `probe`, seen in the same view, over a wide band.
pub fn wide_band(frame: &Frame<'_>, probe: &Probe, view: &View<'_>, scene: &Scene) -> WideBand {
    let band_nm = band(probe, frame.sensor.window, view, scene);
    let count = ((band_nm[1] / band_nm[0]).ln() / SPACING).ceil() as u32;
    let shader = view.shader_over(band_nm, count);
    let light = match look(frame, probe.pixel, view, scene) {
        Some((trees, _)) => shader.radiance(&trees, trees.roots[0]),
        None => Radiance::new(count as usize),
    };
    WideBand {
        band_nm,
        wavelengths: shader.wavelengths_nm(),
        light,
    }
}

/// The usual band, widened by the shifted visible light of each source and by the greater part of
/// its thermal light.
fn band(probe: &Probe, window_nm: [f64; 2], view: &View<'_>, scene: &Scene) -> [f64; 2] {
    let mut band = USUAL_BAND;
    let mut widen = |range_nm: [f64; 2]| {
        band = [band[0].min(range_nm[0]), band[1].max(range_nm[1])];
    };
    widen(window_nm);
    for node in &probe.chain {
        let doppler = match (&node.hit, node.parent) {
            _ if !view.effects.doppler => 1.0,
            (Some(hit), _) => hit.doppler,
            (None, None) => node.doppler,
            (None, Some(parent)) => {
                let parent = probe.chain[parent as usize].hit.as_ref();
                node.doppler * parent.map_or(1.0, |hit| hit.doppler)
            }
        };
        widen(RANGE_NM.map(|nm| nm / doppler));
        let name = node.hit.as_ref().map(|hit| &hit.material);
        let material = scene.materials.iter().find(|m| Some(&m.name) == name);
        let thermal = material.and_then(|m| m.thermal.as_ref());
        if let Some(thermal) = thermal.filter(|_| view.effects.thermal) {
            let peak = planck::peak_nm(thermal.temperature_k) / doppler;
            widen(THERMAL.map(|share| share * peak));
        }
    }
    let [low, high] = band.map(|nm| nm.clamp(WIDEST_BAND[0], WIDEST_BAND[1]));
    [rounded_down(low), rounded_up(high)]
}

/// The next 1 or 5 times a power of ten at or below a wavelength.
fn rounded_down(nm: f64) -> f64 {
    let decade = 10f64.powf((nm * (1.0 + ROUNDING)).log10().floor());
    if nm * (1.0 + ROUNDING) >= 5.0 * decade {
        5.0 * decade
    } else {
        decade
    }
}

/// The next 1 or 5 times a power of ten at or above a wavelength.
fn rounded_up(nm: f64) -> f64 {
    let decade = 10f64.powf((nm * (1.0 - ROUNDING)).log10().floor());
    if nm * (1.0 - ROUNDING) <= 5.0 * decade {
        5.0 * decade
    } else {
        10.0 * decade
    }
}

/// The plot of a pixel, with this title.
pub fn plot(title: &str, window_nm: [f64; 2], probe: &Probe, wide: &WideBand) -> Plot {
    let [x, y] = probe.pixel;
    let doppler = probe.hit.as_ref().map_or_else(
        || "sees the background".to_owned(),
        |hit| format!("D = {}", digits(hit.doppler, 6)),
    );
    let title = format!("{title}, frame {}, pixel {x} {y}, {doppler}", probe.frame);
    let window = [&probe.surface, &probe.thermal, &probe.radiance].map(|curve| finer(curve));
    let sum = wide.light.total();
    let wide_curves = [&wide.light.surface, &wide.light.thermal, &sum];
    let label = "spectral radiance";
    let panels = [
        (
            "In the sensor's window",
            Axis::new("wavelength", "nm", Scale::Linear, window_nm),
            Axis::from_zero(label, UNIT, peak(&probe.radiance)),
            series(&finer(&probe.wavelengths), window),
        ),
        (
            "Wide band",
            Axis::new("wavelength", "nm", Scale::Log, wide.band_nm),
            Axis::decades(label, UNIT, depth(wide_curves)),
            series(&wide.wavelengths, wide_curves.map(Vec::clone)),
        ),
    ];
    let panel = |(title, x, y, series): (&str, Axis, Axis, Vec<Series>)| Panel {
        title: title.to_owned(),
        x,
        y,
        tints: visible(),
        note: dark(&series).then(|| "no light in this band".to_owned()),
        series,
    };
    Plot {
        caption: vec![title],
        panels: panels.into_iter().map(panel).collect(),
    }
}

/// A number with this many decimals, in its shorter notation.
pub(super) fn digits(value: f64, decimals: usize) -> String {
    if (1e-3..1e5).contains(&value) {
        format!("{value:.decimals$}")
    } else {
        format!("{value:.decimals$e}")
    }
}

/// The sum is wide and below, so that its parts are visible on it.
fn series(wavelengths: &[f64], [surface, thermal, sum]: [Vec<f64>; 3]) -> Vec<Series> {
    vec![
        curve("sum", SUM, Stroke::Solid(5.0), wavelengths, sum),
        curve(
            "surface light",
            SURFACE,
            Stroke::Solid(1.8),
            wavelengths,
            surface,
        ),
        curve(
            "thermal light",
            THERMAL_LIGHT,
            Stroke::Dashed(1.8),
            wavelengths,
            thermal,
        ),
    ]
}

/// A curve over wavelength.
pub(super) fn curve(
    name: &str,
    color: Color,
    stroke: Stroke,
    wavelengths: &[f64],
    values: Vec<f64>,
) -> Series {
    let points = wavelengths.iter().zip(values).map(|(x, y)| [*x, y]);
    Series {
        name: name.to_owned(),
        color,
        stroke,
        points: points.collect(),
        remarks: Vec::new(),
    }
}

/// Values between those at the sensor's wavelengths, by the cubic for which its sums are exact.
fn finer(values: &[f64]) -> Vec<f64> {
    const PARTS: usize = 4;
    let Some(last) = values.len().checked_sub(1) else {
        return Vec::new();
    };
    let between = |i: usize| {
        let (first, t) = (i / PARTS, (i % PARTS) as f64 / PARTS as f64);
        if t == 0.0 {
            return values[first];
        }
        let neighbors = [first.saturating_sub(1), first, first + 1, first + 2];
        let taps = neighbors.into_iter().zip(catmull_rom(t));
        let value: f64 = taps.map(|(j, tap)| tap * values[j.min(last)]).sum();
        // The cubic overshoots where a curve falls to 0.
        value.clamp(0.0, f64::MAX)
    };
    (0..=last * PARTS).map(between).collect()
}

fn dark(series: &[Series]) -> bool {
    series.iter().flat_map(|s| &s.points).all(|p| p[1] <= 0.0)
}

pub(super) fn peak(curve: &[f64]) -> f64 {
    curve.iter().copied().fold(0.0, f64::max)
}

/// Least and greatest value of a logarithmic axis for some curves, of which the last is the sum.
fn depth(curves: [&Vec<f64>; 3]) -> [f64; 2] {
    let largest = peak(curves[2]);
    if largest <= 0.0 {
        return [DEPTHS[0], 1.0];
    }
    let peaks = curves.map(|curve| peak(curve)).into_iter();
    let weakest = peaks.filter(|peak| *peak > 0.0).fold(largest, f64::min);
    [
        (weakest * DEPTH).clamp(largest * DEPTHS[1], largest * DEPTHS[0]),
        largest,
    ]
}

/// The colors of the visible band, faint enough to draw on.
pub(super) fn visible() -> Vec<Tint> {
    const STEP_NM: f64 = 2.5;
    let count = ((RANGE_NM[1] - RANGE_NM[0]) / STEP_NM) as usize;
    (0..count)
        .map(|i| {
            let start = RANGE_NM[0] + i as f64 * STEP_NM;
            Tint {
                range: [start, start + STEP_NM],
                color: tint(start + STEP_NM / 2.0),
            }
        })
        .collect()
}

/// The hue of a wavelength on white, fainter toward the ends of the visible.
fn tint(nm: f64) -> Color {
    const STRENGTH: f64 = 0.35;
    const FULL_FROM: f64 = 0.25;
    let xyz = xyz_bar(nm);
    let rgb = apply(&RGB_FROM_XYZ, xyz).map(|v| v.max(0.0));
    let brightest = rgb.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    let share = STRENGTH * (xyz.iter().sum::<f64>() / FULL_FROM).min(1.0);
    rgb.map(|v| {
        let hue = encode(v / brightest);
        (255.0 * (1.0 - share + share * hue)).round() as u8
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bands_end_at_round_wavelengths() {
        for (nm, below, above) in [
            (50.0, 50.0, 50.0),
            (29.0, 10.0, 50.0),
            (63_000.0, 50_000.0, 100_000.0),
            (100.0, 100.0, 100.0),
            (1e-12, 1e-12, 1e-12),
        ] {
            let near = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-12;
            assert!(near(rounded_down(nm), below), "{nm}");
            assert!(near(rounded_up(nm), above), "{nm}");
        }
    }

    #[test]
    fn the_visible_is_tinted_blue_green_and_red_and_fades_to_white() {
        let [blue, green, red] = [450.0, 540.0, 630.0].map(tint);
        assert!(blue[2] > blue[0] && blue[2] > blue[1], "{blue:?}");
        assert!(green[1] > green[0] && green[1] > green[2], "{green:?}");
        assert!(red[0] > red[1] && red[0] > red[2], "{red:?}");
        for end in [360.0, 830.0].map(tint) {
            assert!(end.iter().all(|v| *v > 253), "{end:?}");
        }
    }
}
