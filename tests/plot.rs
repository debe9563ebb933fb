//! `restframe probe --plot`: what a reader of the plot measures with its ticks is what the probe
//! says, and what Planck's law says.

use crate::common::desk::{Desk, Outcome};
use roxmltree::{Document, Node};
use serde_json::Value;
use std::fs;

/// One pixel that sees a sphere which shines by a lamp, and one that may glow.
const BALL: &str = r#"
[shot]
title = "A <ball> & its lamp"
[image]
size = [3, 3]
[worldline.ball]
velocity = VELOCITY
[[model]]
file = "sphere.obj"
worldline = "ball"
material = "paint"
[material.paint]
diffuse = { weight = 0.9, spectrum = { gaussian = { center = 600, width = 30 } } }
thermal = { temperature = TEMPERATURE }
[[light]]
kind = "sun"
worldline = "ball"
direction = [0, 0, -1]
intensity = 1e5
spectrum = "D65"
[camera]
position = [0, 0, 5]
hfov = 90
[sensor]
exposure = 0
"#;

/// A folder with `ball.toml`.
fn ball(velocity: &str, temperature: &str) -> Desk {
    let desk = Desk::with_sphere();
    let shot = BALL.replace("VELOCITY", velocity);
    desk.write("ball.toml", shot.replace("TEMPERATURE", temperature));
    desk
}

/// The plot of a pixel, and its probe.
fn plot(desk: &Desk, pixel: &str) -> (String, Value) {
    let told = desk.call(&format!(
        "probe ball.toml --pixel {pixel} --plot plot.svg --json"
    ));
    assert_eq!((told.status, told.stderr.as_str()), (0, ""));
    (
        desk.read("plot.svg"),
        serde_json::from_str(&told.stdout).unwrap(),
    )
}

fn numbers(list: &Value) -> Vec<f64> {
    let list = list.as_array().unwrap();
    list.iter().map(|value| value.as_f64().unwrap()).collect()
}

/// A panel as its reader sees it.
struct Reader<'a>(Node<'a, 'a>);

/// From pixels to values.
struct Ruler {
    pixels: [f64; 2],
    values: [f64; 2],
    logarithmic: bool,
}

impl<'a> Reader<'a> {
    fn new(document: &'a Document<'a>, id: &str) -> Self {
        let group = |node: &Node<'_, '_>| node.attribute("id") == Some(id);
        Self(document.descendants().find(group).unwrap())
    }

    fn of_class(&self, class: &str) -> Vec<Node<'a, 'a>> {
        let ours = |node: &Node<'_, '_>| node.attribute("class") == Some(class);
        self.0.children().filter(ours).collect()
    }

    fn text(&self, class: &str) -> String {
        let texts = self.of_class(class);
        assert_eq!(texts.len(), 1, "{class}");
        texts[0].text().unwrap().to_owned()
    }

    /// The first and the last labelled tick of the axis `x` or `y`, each tick the one nearest to
    /// its label.
    fn ruler(&self, axis: &str) -> Ruler {
        let ticks: Vec<f64> = self
            .of_class(&format!("{axis}-tick"))
            .iter()
            .map(|tick| {
                let [x, y] = points(tick)[0];
                if axis == "x" { x } else { y }
            })
            .collect();
        let labels: Vec<(f64, f64)> = self
            .of_class(&format!("{axis}-value"))
            .iter()
            .map(|label| {
                let at: f64 = label.attribute(axis).unwrap().parse().unwrap();
                let away = |tick: &&f64| (**tick - at).abs();
                let nearest = ticks.iter().min_by(|a, b| away(a).total_cmp(&away(b)));
                (*nearest.unwrap(), value_of(label.text().unwrap()))
            })
            .collect();
        let (first, middle, last) = (
            labels[0],
            labels[labels.len() / 2],
            labels[labels.len() - 1],
        );
        let evenly = (first.1 + last.1) / 2.0 - middle.1;
        let logarithmic = first.1 > 0.0 && evenly.abs() > 0.2 * (last.1 - first.1);
        let title = self.text(&format!("{axis}-label"));
        let factor = title
            .split_once('(')
            .and_then(|(_, unit)| unit.split(' ').next())
            .filter(|word| word.starts_with("10"))
            .map_or(1.0, value_of);
        Ruler {
            pixels: [first.0, last.0],
            values: [first.1 * factor, last.1 * factor],
            logarithmic,
        }
    }

    /// Height of a curve in pixels at a horizontal place in pixels; None where it is not drawn.
    fn height(&self, name: &str, x: f64) -> Option<f64> {
        let runs = self.of_class(&format!("curve {name}"));
        runs.iter().find_map(|run| {
            let line = points(run);
            let around = |pair: &&[[f64; 2]]| pair[0][0] <= x && x <= pair[1][0];
            let pair = line.windows(2).find(around)?;
            let part = (x - pair[0][0]) / (pair[1][0] - pair[0][0]).max(1e-9);
            Some(pair[0][1] + part * (pair[1][1] - pair[0][1]))
        })
    }
}

impl Ruler {
    fn pixel(&self, value: f64) -> f64 {
        let [from, to] = self.pixels;
        let scale = |v: f64| if self.logarithmic { v.log10() } else { v };
        let [low, high] = self.values.map(scale);
        from + (scale(value) - low) / (high - low) * (to - from)
    }
}

fn points(line: &Node<'_, '_>) -> Vec<[f64; 2]> {
    let pair = |pair: &str| {
        let (x, y) = pair.split_once(',').unwrap();
        [x.parse().unwrap(), y.parse().unwrap()]
    };
    let text = line.attribute("points").unwrap();
    text.split(' ').map(pair).collect()
}

/// The number that a label shows, such as 0.25, −3 or 10⁻³.
fn value_of(label: &str) -> f64 {
    const RAISED: &str = "⁰¹²³⁴⁵⁶⁷⁸⁹";
    if let Some(exponent) = label.strip_prefix("10")
        && exponent.chars().any(|c| RAISED.contains(c))
    {
        let plain = |c: char| match RAISED.chars().position(|raised| raised == c) {
            Some(digit) => digit.to_string(),
            None => "-".to_owned(),
        };
        let exponent: String = exponent.chars().map(plain).collect();
        return 10f64.powi(exponent.parse().unwrap());
    }
    label.replace('−', "-").parse().unwrap()
}

#[test]
fn curves_in_the_window_are_the_probes_to_a_pixel() {
    let desk = ball("[0, 0, 0.3]", "2600");
    let (text, probe) = plot(&desk, "1 1");
    let document = Document::parse(&text).unwrap();
    let panel = Reader::new(&document, "panel-1");
    assert_eq!(panel.text("x-label"), "wavelength (nm)");
    assert!(panel.text("y-label").starts_with("spectral radiance ("));
    assert!(panel.text("y-label").ends_with("W·m⁻²·sr⁻¹·nm⁻¹)"));
    let (x, y) = (panel.ruler("x"), panel.ruler("y"));
    assert!(!x.logarithmic && !y.logarithmic);
    let wavelengths = numbers(&probe["wavelengths"]);
    for (key, name) in [
        ("radiance", "sum"),
        ("surface", "surface light"),
        ("thermal", "thermal light"),
    ] {
        let curve = numbers(&probe[key]);
        assert!(curve.iter().any(|value| *value > 0.0), "{name}");
        for (nm, value) in wavelengths.iter().zip(curve) {
            // The axis' first and last wavelengths are rounded to hundredths of a pixel.
            let at = x.pixel(*nm).clamp(
                x.pixel(wavelengths[0]) + 0.02,
                x.pixel(wavelengths[83]) - 0.02,
            );
            let height = panel.height(name, at).unwrap();
            let error = (height - y.pixel(value)).abs();
            assert!(error < 1.0, "{name} at {nm} nm: {error} pixels");
        }
    }
}

#[test]
fn thermal_light_in_the_wide_band_is_a_black_body_at_d_times_t() {
    let (h, c, k) = (6.626_070_15e-34, 299_792_458.0, 1.380_649e-23);
    for (velocity, temperature) in [("[0, 0, 0.3]", 2600.0), ("[0, 0, -0.9]", 300.0)] {
        let desk = ball(velocity, &temperature.to_string());
        let (text, probe) = plot(&desk, "1 1");
        let document = Document::parse(&text).unwrap();
        let panel = Reader::new(&document, "panel-2");
        let (x, y) = (panel.ruler("x"), panel.ruler("y"));
        assert!(x.logarithmic && y.logarithmic);
        let seen = temperature * probe["hit"]["doppler"].as_f64().unwrap();
        let planck = |nm: f64| {
            let lambda = nm * 1e-9;
            let quantum = (h * c / (lambda * k * seen)).exp_m1();
            2.0 * h * c * c / lambda.powi(5) / quantum * 1e-9
        };
        let peak = 2.897_771_955e6 / seen;
        for share in [0.4, 0.7, 1.0, 1.5, 3.0, 6.0] {
            let nm = share * peak;
            let height = panel.height("thermal light", x.pixel(nm)).unwrap();
            let error = (height - y.pixel(planck(nm))).abs();
            assert!(error < 1.0, "{velocity} at {nm} nm: {error} pixels");
        }
    }
}

#[test]
fn the_caption_names_shot_frame_pixel_and_doppler_factor() {
    let desk = ball("[0, 0, 0.6]", "0");
    let (text, _) = plot(&desk, "1 1");
    let document = Document::parse(&text).unwrap();
    let caption = Reader::new(&document, "caption").text("caption");
    assert_eq!(
        caption,
        "A <ball> & its lamp, frame 1, pixel 1 1, D = 2.000000"
    );
    let legend = Reader::new(&document, "legend").of_class("legend");
    let names: Vec<_> = legend.iter().filter_map(Node::text).collect();
    assert_eq!(names, ["sum", "surface light", "thermal light"]);
}

#[test]
fn the_same_pixel_gives_the_same_bytes() {
    let desk = ball("[0, 0, 0.3]", "2600");
    assert!(plot(&desk, "1 1").0 == plot(&desk, "1 1").0);
}

/// Numbers are finite, and everything stands on the page.
fn is_sane(text: &str) {
    let document = Document::parse(text).unwrap();
    let page = ["width", "height"].map(|side| {
        let side = document.root_element().attribute(side).unwrap();
        side.parse::<f64>().unwrap()
    });
    for node in document.descendants() {
        for attribute in node.attributes() {
            let limit = match attribute.name() {
                "x" | "cx" | "width" => page[0],
                "y" | "cy" | "height" => page[1],
                _ => continue,
            };
            let value: f64 = attribute.value().parse().unwrap();
            assert!((0.0..=limit).contains(&value), "{node:?}");
        }
        if node.has_tag_name("polyline") {
            let on_page = |p: &[f64; 2]| (0..2).all(|i| (0.0..=page[i]).contains(&p[i]));
            assert!(points(&node).iter().all(on_page), "{node:?}");
        }
        let words = node.text().unwrap_or_default();
        assert!(!words.contains("NaN") && !words.contains("inf"), "{words}");
    }
}

#[test]
fn pixels_without_light_and_of_any_range_are_drawn() {
    let still = ball("[0, 0, 0]", "0");
    let (black, _) = plot(&still, "0 0");
    is_sane(&black);
    assert!(black.contains("no light in this band") && black.contains("sees the background"));
    for (velocity, temperature) in [
        ("{ gamma = 1e4, direction = [0, 0, 1] }", "3000"),
        ("{ gamma = 1e4, direction = [0, 0, -1] }", "3000"),
        ("{ gamma = 1e12, direction = [0, 0, 1] }", "1e5"),
        ("{ gamma = 1e12, direction = [0, 0, -1] }", "100"),
    ] {
        let desk = ball(velocity, temperature);
        let (text, probe) = plot(&desk, "1 1");
        assert!(probe["hit"].is_object(), "{velocity}");
        is_sane(&text);
        // What is shifted out of the window is found in the wide band.
        let document = Document::parse(&text).unwrap();
        let panel = Reader::new(&document, "panel-2");
        for name in ["sum", "surface light", "thermal light"] {
            assert!(
                !panel.of_class(&format!("curve {name}")).is_empty(),
                "{velocity}: {name}"
            );
        }
    }
}

#[test]
fn a_plot_that_cannot_be_written_is_a_failure_with_a_reason() {
    let desk = ball("[0, 0, 0]", "0");
    let Outcome {
        status,
        stdout,
        stderr,
    } = desk.call("probe ball.toml --pixel 1 1 --plot no/such/plot.svg");
    assert_eq!((status, stdout.as_str()), (1, ""));
    assert!(
        stderr.starts_with("error: cannot write no/such/plot.svg: "),
        "{stderr}"
    );
    assert!(
        stderr
            .trim_end()
            .ends_with("no/such must be an existing folder"),
        "{stderr}"
    );
    let Outcome { status, .. } = desk.call("probe ball.toml --pixel 9 9 --plot plot.svg");
    assert_eq!(status, 2);
    let left: Vec<_> = fs::read_dir(desk.path("")).unwrap().collect();
    assert_eq!(left.len(), 3, "{left:?}");
    let shot = fs::read(desk.path("ball.toml")).unwrap();
    let Outcome { status, stderr, .. } =
        desk.call("probe ball.toml --pixel 1 1 --plot ./ball.toml");
    assert_eq!(status, 2, "{stderr}");
    assert!(stderr.contains("the plot would take the place of the shot"));
    assert!(fs::read(desk.path("ball.toml")).unwrap() == shot);
}
