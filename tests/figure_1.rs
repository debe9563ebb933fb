//! Figure 1 of the 1990 paper: the Doppler factor over the viewing angle, as shots/figure-1.toml
//! is seen, against the closed form.
//!
//! The paper's angle is 0° where the view is across the motion, and its crossover D = 1 lies at a
//! negative angle for every speed. So it is the angle in the observer's frame: there light from
//! straight across has D = 1/γ. By the angle in the source's frame it would have D = γ, and the
//! crossover would lie on the other side.
//!
//! `RESTFRAME_FIGURE=write cargo test --test suite figure_1::` (scripts/figure-1) renews the figure.

use restframe::frame::Frame;
use restframe::plot::{Axis, Color, Page, Panel, Plot, Scale, Series, Stroke, lay_out, svg};
use restframe::probe::{Probe, probe};
use restframe::render::Prepared;
use restframe::render::View;
use restframe::scene::Scene;
use restframe::trace::build_aggregate;
use std::path::{Path, PathBuf};

/// Of D, relative.
const DOPPLER: f64 = 1e-9;

const SPEEDS: [(f64, Color); 3] = [
    (0.5, [0, 92, 160]),
    (0.9, [0, 130, 90]),
    (0.99, [200, 70, 0]),
];
const ANGLES: u32 = 25;
const TEMPERATURE_K: f64 = 6000.0;

fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

/// D of light that is seen at an angle (degrees, observer's frame) from across the motion of its
/// source, positive where that recedes: √(1 − β²)/(1 + β sin φ), equation 1 of the paper.
fn closed_form(beta: f64, angle_deg: f64) -> f64 {
    (1.0 - beta * beta).sqrt() / (1.0 + beta * angle_deg.to_radians().sin())
}

/// D as the light itself tells it: a black body's temperature, as seen over what it is, by Planck's
/// law at the wavelength of the greatest radiance.
fn from_light(probe: &Probe) -> f64 {
    let (h, c, k) = (6.626_070_15e-34, 299_792_458.0, 1.380_649e-23);
    let seen = probe.wavelengths.iter().zip(&probe.radiance);
    let (nm, radiance) = seen.max_by(|a, b| a.1.total_cmp(b.1)).unwrap();
    let lambda = nm * 1e-9;
    let per_meter = radiance * 1e9;
    let quantum = (2.0 * h * c * c / lambda.powi(5) / per_meter).ln_1p();
    h * c / (lambda * k * quantum) / TEMPERATURE_K
}

/// What the pixel sees in every frame.
fn probes() -> Vec<Probe> {
    let prepared = Prepared::read(&path("shots/figure-1.toml")).unwrap();
    let shot = &prepared.shot;
    (1..=shot.shot.frames)
        .map(|frame| {
            let values = Frame::new(shot, frame).unwrap();
            let scene = Scene::resolve(&values, &prepared.library, None).unwrap();
            let aggregate = build_aggregate(&scene.geometry, None);
            let view = View::new(&values, &shot.effects, &scene, &aggregate);
            probe(&values, [0, 0], &view, &scene, 0.0)
        })
        .collect()
}

/// Speed, angle in degrees and what was seen there.
fn readings() -> Vec<(f64, f64, Probe)> {
    let probes = probes().into_iter().enumerate();
    probes
        .map(|(i, probe)| {
            let (beta, _) = SPEEDS[i / ANGLES as usize];
            let angle = -90.0 + 7.5 * (i % ANGLES as usize) as f64;
            (beta, angle, probe)
        })
        .collect()
}

fn figure(readings: &[(f64, f64, Probe)]) -> String {
    let mut series: Vec<Series> = SPEEDS
        .iter()
        .map(|(beta, color)| Series {
            name: format!("{beta} c"),
            color: *color,
            stroke: Stroke::Solid(2.0),
            points: (-360..=360)
                .map(|quarter| f64::from(quarter) / 4.0)
                .map(|angle| [angle, closed_form(*beta, angle)])
                .collect(),
            remarks: Vec::new(),
        })
        .collect();
    series.push(Series {
        name: "read from rendered light".to_owned(),
        color: [34, 34, 34],
        stroke: Stroke::Dots(3.6),
        points: readings
            .iter()
            .map(|(_, angle, probe)| [*angle, from_light(probe)])
            .collect(),
        remarks: Vec::new(),
    });
    let angle = Axis::new("viewing angle φ", "°", Scale::Linear, [-90.0, 90.0]);
    let plot = Plot {
        caption: [
            "The Doppler factor over the viewing angle",
            "Figure 1 of the 1990 paper. φ is the angle in the observer's frame: at 0° the view is",
            "across the motion of what is seen, at −90° that comes head-on, at 90° it recedes.",
            "Lines: D = √(1 − β²) / (1 + β sin φ). Dots: T seen / T of a black body at 6000 K.",
        ]
        .map(str::to_owned)
        .to_vec(),
        panels: vec![Panel {
            title: String::new(),
            x: Axis {
                step: Some(15.0),
                ..angle
            },
            y: Axis::new(
                "D = frequency observed / frequency emitted",
                "",
                Scale::Log,
                [0.05, 20.0],
            ),
            tints: Vec::new(),
            series,
            note: None,
        }],
    };
    let page = Page {
        size: [900.0, 640.0],
        font: 15.0,
    };
    svg(&lay_out(&plot, page))
}

#[test]
fn the_doppler_factor_of_every_render_is_on_the_closed_form() {
    let readings = readings();
    assert_eq!(readings.len(), SPEEDS.len() * ANGLES as usize);
    for (beta, angle, probe) in &readings {
        let exact = closed_form(*beta, *angle);
        let traced = probe.hit.as_ref().unwrap().doppler;
        for found in [traced, from_light(probe)] {
            assert!(
                (found / exact - 1.0).abs() < DOPPLER,
                "{beta} c, {angle}°: {found} where {exact} is exact"
            );
        }
    }
}

#[test]
fn the_figure_is_current() {
    let path = path("docs/figure-1.svg");
    let figure = figure(&readings());
    if std::env::var("RESTFRAME_FIGURE").as_deref() == Ok("write") {
        std::fs::write(&path, &figure).unwrap();
    }
    let kept = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(
        kept == figure,
        "docs/figure-1.svg is not current: run scripts/figure-1"
    );
}
