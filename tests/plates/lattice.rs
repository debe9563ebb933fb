//! Plates 1 and 2: a lattice of bars and spheres at 0.99 c.

use super::thumbnail::{Pixel, Thumbnail, mean, share};

/// Below this a displayed channel is too dark for a hue.
const VISIBLE: f64 = 40.0;

fn of<'a>(plate: &'a Thumbnail, material: &str) -> Vec<Pixel<'a>> {
    plate
        .pure()
        .into_iter()
        .filter(|p| p.material == material)
        .collect()
}

#[test]
fn plate_1_distorts_without_color_change() {
    let moving = Thumbnail::plate(1);
    let still = Thumbnail::new("lattice", 1);
    for plate in [moving, &still] {
        let red: Vec<_> = of(plate, "red")
            .into_iter()
            .filter(|p| p.value() > VISIBLE)
            .collect();
        let grey: Vec<_> = of(plate, "grey")
            .into_iter()
            .filter(|p| p.value() > VISIBLE)
            .collect();
        assert!(
            red.len() > 50 && grey.len() > 500,
            "{} {}",
            red.len(),
            grey.len()
        );
        // 0.996 or more: the filter brings a bar into some spheres and a sphere into some bars.
        let pure = share(&red, |p| p.hue().abs() < 6.0 && p.saturation() > 0.6);
        assert!(pure > 0.95, "{pure}");
        let plain = share(&grey, |p| p.saturation() < 0.2);
        assert!(plain > 0.95, "{plain}");
    }
    // The same chromaticities to the last digits, of all that is lit; in the shade of the still
    // lattice are the last traces of thermal light.
    for material in ["red", "grey"] {
        let chromaticity = |plate: &Thumbnail| {
            let lit: Vec<_> = plate
                .covered()
                .into_iter()
                .filter(|p| p.material == material && p.probe.xyz[1] > 1e-3)
                .map(|p| p.probe.xyz.map(|v| v / p.probe.xyz.iter().sum::<f64>()))
                .collect();
            let reach = |c: usize| {
                let values = lit.iter().map(|xyz| xyz[c]);
                (
                    values.clone().fold(1.0, f64::min),
                    values.fold(0.0, f64::max),
                )
            };
            [reach(0), reach(1)]
        };
        let (a, b) = (chromaticity(moving), chromaticity(&still));
        for ((a0, a1), (b0, b1)) in a.into_iter().zip(b) {
            assert!(a1.max(b1) - a0.min(b0) < 1e-6, "{material}");
        }
    }
    let seen = |plate: &Thumbnail, x, y| plate.pixel(x, y).map_or("", |p| p.material).to_owned();
    let places = (0..90).flat_map(|y| (0..160).map(move |x| (x, y)));
    let differing = places
        .filter(|&(x, y)| seen(moving, x, y) != seen(&still, x, y))
        .count();
    // 5930 of 14400.
    assert!(differing > 14400 / 4);
}

#[test]
fn plate_2_bars_are_orange_at_the_edge_yellow_to_white_in_the_middle() {
    let plate = Thumbnail::plate(2);
    let bars = of(plate, "grey");
    let between = |from: f64, to: f64| -> Vec<Pixel<'_>> {
        bars.iter()
            .copied()
            .filter(|p| (from..to).contains(&p.doppler))
            .collect()
    };
    let (edge, yellow, middle) = (between(2.5, 3.5), between(4.5, 5.25), between(6.0, 15.0));
    let orange = share(&edge, |p| (15.0..42.0).contains(&p.hue()));
    assert!(orange > 0.6, "{orange}");
    let yellow = mean(&yellow, Pixel::hue);
    assert!((45.0..65.0).contains(&yellow), "{yellow}");
    let white = share(&middle, |p| p.rgb.into_iter().all(|c| c > 240.0));
    assert!(white > 0.9, "{white}");
}

#[test]
fn plate_2_spheres_go_from_black_over_brown_to_yellow() {
    let plate = Thumbnail::plate(2);
    let spheres: Vec<_> = plate
        .covered()
        .into_iter()
        .filter(|p| p.material == "red")
        .collect();
    let shown = |from: f64, to: f64, c: usize| {
        mean(
            spheres.iter().filter(|p| (from..to).contains(&p.doppler)),
            |p| p.probe.rgb[c].clamp(0.0, 1.0),
        )
    };
    let row = |from, to| [0, 1, 2].map(|c| shown(from, to, c));
    let (black, brown, yellow) = (row(2.0, 3.5), row(4.3, 5.2), row(7.5, 10.0));
    // 8e-5; (0.024, 0.003, 0); (0.99, 0.56, 0.13).
    assert!(black.iter().all(|c| *c < 0.02));
    assert!(brown[0] < 0.4 && brown[0] > 1.5 * brown[1] && brown[1] > 1.5 * brown[2]);
    assert!(yellow[0] > 0.8 && yellow[1] > 0.5 && yellow[2] < yellow[1]);
}

#[test]
fn plate_2_bars_look_8464_kelvin_hot_on_the_axis() {
    let most = Thumbnail::plate(2)
        .covered()
        .iter()
        .map(|p| p.doppler)
        .fold(0.0, f64::max);
    // sqrt(1.99/0.01) = 14.107 head-on; the camera looks through between bars, so almost.
    // 14.101.
    assert!((600.0 * most / 8464.0 - 1.0).abs() < 0.01, "{most}");
}
