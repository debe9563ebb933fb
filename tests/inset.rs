//! `[[inset]]` by the program: where the plot stands, that its curves are those of
//! `restframe probe`, and that nothing else of a frame changes.
//!
//! Plots are read as a reader does: the white field between the axes is found, its edges are the ends
//! of the axes, and a curve is where its colour is.

use crate::common::desk::Desk;
use image::{Rgb32FImage, RgbImage};
use serde_json::Value;
use std::fs;
use std::path::PathBuf;

/// A sphere that reflects and glows, in a window whose decades to each side are 10 to 20000 nm.
const BALL: &str = r#"
[image]
size = [960, 720]
samples = 1
[worldline.ball]
velocity = [0, 0, 0.3]
[[model]]
file = "sphere.obj"
worldline = "ball"
material = "paint"
[material.paint]
diffuse = { weight = 0.9, spectrum = { gaussian = { center = 600, width = 200 } } }
thermal = { temperature = 2500, curve = "peak", strength = 0.12 }
[[light]]
kind = "sun"
worldline = "ball"
direction = [0, 0, -1]
intensity = 4e4
spectrum = "A"
[camera]
position = [0, 0, 5]
hfov = 90
[sensor]
exposure = -11
window = [100, 3000]
[accuracy]
wavelengths = 800
[output]
formats = ["png", "exr"]
"#;
/// Both ends of the horizontal axis for that window, nm.
const AXIS_NM: [f64; 2] = [10.0, 20_000.0];

const SURFACE: [u8; 3] = [0, 92, 160];
const THERMAL: [u8; 3] = [200, 70, 0];
const SUM: [u8; 3] = [165, 165, 165];

/// How near to its own a curve's colour is where it fills a pixel, and where it fills half of one:
/// less near than that is any other colour of the plot.
const FULL: u8 = 10;
const PALE: u8 = 80;

/// The ball with more in its shot, rendered; and what was said.
fn rendered(desk: &Desk, stem: &str, more: &str, options: &str) -> (RgbImage, String) {
    desk.write(&format!("{stem}.toml"), format!("{BALL}{more}"));
    let said = desk.done(&format!("render {stem}.toml {options}")).stderr;
    let picture = image::open(file(desk, stem, "png")).unwrap();
    (picture.to_rgb8(), said)
}

fn file(desk: &Desk, stem: &str, extension: &str) -> PathBuf {
    desk.path(&format!("renders/{stem}/{stem}.0001.{extension}"))
}

fn light(desk: &Desk, stem: &str) -> Rgb32FImage {
    image::open(file(desk, stem, "exr")).unwrap().to_rgb32f()
}

/// Columns and rows, each from its first to the one behind its last.
type Rectangle = [[u32; 2]; 2];

/// Where an inset of this size and corner stands: 4:3, 2 % of the height from the edges.
fn rectangle([width, height]: [u32; 2], size: f64, place: &str) -> Rectangle {
    let margin = (0.02 * f64::from(height)).round() as u32;
    let own = (size * f64::from(height)).floor();
    let (own_width, own_height) = ((own * 4.0 / 3.0).floor() as u32, own as u32);
    let x = if place.ends_with("left") {
        margin
    } else {
        width - margin - own_width
    };
    let y = if place.starts_with("upper") {
        margin
    } else {
        height - margin - own_height
    };
    [[x, x + own_width], [y, y + own_height]]
}

fn within(rectangle: &Rectangle, x: u32, y: u32) -> bool {
    let [columns, rows] = rectangle;
    (columns[0]..columns[1]).contains(&x) && (rows[0]..rows[1]).contains(&y)
}

/// The pixels in which two pictures differ.
fn changed(one: &RgbImage, other: &RgbImage) -> Vec<(u32, u32)> {
    assert_eq!(one.dimensions(), other.dimensions());
    let pixels = one.enumerate_pixels();
    let differ = pixels.filter(|(x, y, pixel)| *pixel != other.get_pixel(*x, *y));
    differ.map(|(x, y, _)| (x, y)).collect()
}

/// The field between the axes: all that is pure white, which the margins are not.
fn field(picture: &RgbImage, inset: &Rectangle) -> Rectangle {
    let white = picture
        .enumerate_pixels()
        .filter(|(x, y, pixel)| within(inset, *x, *y) && pixel.0 == [255; 3]);
    let places: Vec<[u32; 2]> = white.map(|(x, y, _)| [x, y]).collect();
    [0, 1].map(|axis| {
        let along = || places.iter().map(|place| place[axis]);
        [along().min().unwrap(), along().max().unwrap() + 1]
    })
}

/// Where a curve of this colour stands in a column of the field: the middle of its pixels.
fn curve_at(
    picture: &RgbImage,
    field: &Rectangle,
    x: u32,
    color: [u8; 3],
    within: u8,
) -> Option<f64> {
    let [_, rows] = *field;
    let near = |y: &u32| {
        let pixel = picture.get_pixel(x, *y).0;
        (0..3).all(|c| pixel[c].abs_diff(color[c]) < within)
    };
    let found: Vec<u32> = (rows[0]..rows[1]).filter(near).collect();
    let middle = found.iter().map(|y| f64::from(*y) + 0.5).sum::<f64>() / found.len() as f64;
    (!found.is_empty()).then_some(middle)
}

/// How many columns show a curve of this colour clearly above the axis.
fn columns_with(picture: &RgbImage, inset: &Rectangle, color: [u8; 3]) -> usize {
    let field = field(picture, inset);
    let [columns, [top, bottom]] = field;
    let above = f64::from(bottom) - 0.06 * f64::from(bottom - top);
    (columns[0]..columns[1])
        .filter(|x| curve_at(picture, &field, *x, color, PALE).is_some_and(|y| y < above))
        .count()
}

/// Next 1, 2 or 5 times a power of ten.
fn next_round(value: f64) -> f64 {
    let power = 10f64.powf(value.log10().floor());
    let digits = [1.0, 2.0, 5.0, 10.0].map(|digit| digit * power);
    digits.into_iter().find(|round| *round >= value).unwrap()
}

#[test]
fn an_inset_changes_the_png_in_its_rectangle_and_the_exr_nowhere() {
    let desk = Desk::with_sphere();
    let (plain, _) = rendered(&desk, "plain", "", "");
    let (drawn, said) = rendered(&desk, "drawn", "[[inset]]\n", "");
    assert!(!said.contains("warning"), "{said}");
    let inset = rectangle([960, 720], 0.4, "lower-left");
    let changed = changed(&plain, &drawn);
    assert!(changed.iter().all(|(x, y)| within(&inset, *x, *y)));
    // All of it: even its margins hide nearly all of what is behind.
    assert_eq!(
        changed.len() as u32,
        (inset[0][1] - inset[0][0]) * (inset[1][1] - inset[1][0])
    );
    assert_eq!(light(&desk, "plain"), light(&desk, "drawn"));
}

#[test]
fn the_curves_are_those_of_the_probe() {
    /// Of a curve's place, pixels: one for each of the field's edges, which its frame hides. The
    /// bend of a curve within the width of its stroke adds to it.
    const TOLERANCE: f64 = 2.0;
    /// Pixels upwards over two columns.
    const STEEP: f64 = 5.0;
    let desk = Desk::with_sphere();
    let (picture, _) = rendered(&desk, "ball", "[[inset]]\nsize = 0.8\n", "");
    let probe = desk
        .done("probe ball.toml --frame 1 --pixel 480 360 --json")
        .stdout;
    let probe: Value = serde_json::from_str(&probe).unwrap();
    let numbers = |key: &str| -> Vec<f64> {
        let list = probe[key].as_array().unwrap();
        list.iter().map(|v| v.as_f64().unwrap()).collect()
    };
    let nm = numbers("wavelengths");
    let [surface, thermal, sum] = ["surface", "thermal", "radiance"].map(numbers);
    let peak = sum.iter().copied().fold(0.0, f64::max);
    // The light of 100 cd/m² 2¹¹ times over, spread evenly over 106.857 nm of ȳ.
    let white = 100.0 * 2f64.powi(11) / (683.0 * 106.857);
    let top = next_round((1.03 * peak).max(white));
    let field = field(&picture, &rectangle([960, 720], 0.8, "lower-left"));
    let [columns, [top_row, below]] = field;
    let width = f64::from(columns[1] - columns[0]);
    let height = f64::from(below - top_row);
    let value = |curve: &[f64], x: f64| {
        let part = (x - f64::from(columns[0])) / width;
        let at = AXIS_NM[0] * (AXIS_NM[1] / AXIS_NM[0]).powf(part);
        let next = nm.partition_point(|nm| *nm < at);
        let inside = (1..nm.len()).contains(&next);
        let weight = |i: usize| (at - nm[i - 1]) / (nm[i] - nm[i - 1]);
        inside.then(|| curve[next - 1] + weight(next) * (curve[next] - curve[next - 1]))
    };
    let place = |curve: &[f64], x: f64| {
        value(curve, x).map(|value| f64::from(below) - value / top * height)
    };
    let mut counts = Vec::new();
    for (name, curve, color, half_stroke, above) in [
        ("sum", &sum, SUM, 5.0, [&surface, &thermal].as_slice()),
        ("surface", &surface, SURFACE, 2.0, &[&thermal]),
        ("thermal", &thermal, THERMAL, 2.0, &[]),
    ] {
        let mut read = 0;
        for x in columns[0] + 2..columns[1] - 2 {
            let middle = f64::from(x) + 0.5;
            let around = [-1.0, 0.0, 1.0].map(|dx| place(curve, middle + dx * half_stroke));
            let [Some(before), Some(expected), Some(after)] = around else {
                continue;
            };
            // Where curves meet, the one below is hidden; at the axis the frame hides all. Steep parts
            // are broad in a column.
            let apart = above
                .iter()
                .all(|other| place(other, middle).is_some_and(|y| (y - expected).abs() > 16.0));
            let steep = (after - before).abs() > STEEP * half_stroke;
            let tolerance = TOLERANCE + (after + before - 2.0 * expected).abs();
            if !apart || steep || f64::from(below) - expected < 16.0 {
                continue;
            }
            let found = curve_at(&picture, &field, x, color, FULL);
            assert!(
                found.is_some_and(|found| (found - expected).abs() < tolerance),
                "{name}, column {x}: at {found:?}, not {expected}"
            );
            read += 1;
        }
        counts.push(read);
    }
    assert!(counts.iter().all(|read| *read > 20), "columns: {counts:?}");
}

#[test]
fn axes_have_numbers_and_there_is_a_caption_as_long_as_there_is_room() {
    let desk = Desk::with_sphere();
    let inside = |scale: f64| {
        let (picture, _) = rendered(&desk, "ball", "[[inset]]\n", &format!("--scale {scale}"));
        let inset = rectangle([picture.width(), picture.height()], 0.4, "lower-left");
        let field = field(&picture, &inset);
        // Dark pixels of the margins: above the field, left of it, below it.
        let dark = |x: [u32; 2], y: [u32; 2]| {
            let pixels = picture.enumerate_pixels();
            let margin = pixels.filter(|(px, py, _)| within(&[x, y], *px, *py));
            margin
                .filter(|(_, _, pixel)| pixel.0.iter().all(|v| *v < 130))
                .count()
        };
        let [columns, rows] = inset;
        let above = dark(columns, [rows[0], field[1][0] - 2]);
        let left = dark([columns[0], field[0][0] - 2], field[1]);
        let below = dark(columns, [field[1][1] + 2, rows[1]]);
        (above, left, below)
    };
    let (caption, up, along) = inside(1.0);
    assert!(
        caption > 300 && up > 60 && along > 200,
        "{caption} {up} {along}"
    );
    // 115 pixels high: numbers and units, no caption.
    let (unit, up, along) = inside(0.4);
    assert!(unit > 20 && up > 5 && along > 20, "{unit} {up} {along}");
    assert!(unit < caption / 3, "{unit} {caption}");
    // 72 pixels: curves alone.
    assert_eq!(inside(0.25), (0, 0, 0));
}

#[test]
fn an_inset_too_small_to_be_read_is_left_out_with_a_warning() {
    let desk = Desk::with_sphere();
    let (plain, _) = rendered(&desk, "plain", "", "--scale 0.2");
    let (drawn, said) = rendered(
        &desk,
        "drawn",
        "[[inset]]\npixel = [480, 360]\n",
        "--scale 0.2",
    );
    assert!(changed(&plain, &drawn).is_empty());
    let warning = "warning: drawn.toml: frame 1: the inset of pixel 480 360 is left out: it would be 57 pixels high";
    assert!(said.contains(warning), "{said}");
}

#[test]
fn a_smaller_picture_has_the_inset_of_the_same_point() {
    let desk = Desk::with_sphere();
    // On the ball, and in the smaller picture a pixel far from it.
    let shot = "[[inset]]\npixel = [500, 400]\n";
    let share = |scale: &str| {
        let (picture, _) = rendered(&desk, "ball", shot, scale);
        let inset = rectangle([picture.width(), picture.height()], 0.4, "lower-left");
        let width = f64::from(inset[0][1] - inset[0][0]);
        columns_with(&picture, &inset, THERMAL) as f64 / width
    };
    let (full, half) = (share(""), share("--scale 0.5"));
    // Its font, and so its margins, are a little larger; strokes are thinner than a pixel.
    assert!(full > 0.08 && half > 0.03, "{full} {half}");
}

#[test]
fn an_inset_shows_its_pixel_under_the_effects_of_its_splice() {
    let desk = Desk::with_sphere();
    let splice = "[[splice]]\nrows = [0.5, 1]\neffects = { thermal = \"off\" }\n";
    let columns = |y: u32| {
        let more = format!("{splice}[[inset]]\npixel = [480, {y}]\nplace = \"upper-right\"\n");
        let (picture, _) = rendered(&desk, "ball", &more, "");
        let inset = rectangle([960, 720], 0.4, "upper-right");
        [SURFACE, THERMAL].map(|color| columns_with(&picture, &inset, color))
    };
    let [[surface, thermal], [surface_below, thermal_below]] = [359, 360].map(columns);
    assert!(surface > 5 && thermal > 20, "{surface} {thermal}");
    assert!(surface_below > 5, "{surface_below}");
    assert_eq!(thermal_below, 0);
}

#[test]
fn four_insets_stand_in_four_corners() {
    let desk = Desk::with_sphere();
    let corners = ["upper-left", "upper-right", "lower-left", "lower-right"];
    let insets: String = corners
        .map(|place| format!("[[inset]]\nplace = \"{place}\"\nsize = 0.3\n"))
        .concat();
    let (plain, _) = rendered(&desk, "plain", "", "");
    let (drawn, _) = rendered(&desk, "drawn", &insets, "");
    let mut changed = changed(&plain, &drawn);
    for place in corners {
        let inset = rectangle([960, 720], 0.3, place);
        let before = changed.len();
        changed.retain(|(x, y)| !within(&inset, *x, *y));
        assert!(before - changed.len() > 50_000, "{place}");
    }
    assert!(changed.is_empty());
}

#[test]
fn threads_change_no_byte() {
    let bytes = |threads: u32| {
        let desk = Desk::with_sphere();
        rendered(
            &desk,
            "ball",
            "[[inset]]\n",
            &format!("--scale 0.5 --threads {threads}"),
        );
        fs::read(file(&desk, "ball", "png")).unwrap()
    };
    assert!(bytes(1) == bytes(2));
}
