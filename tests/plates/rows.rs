//! Plates 7 to 12: rows of red spheres at 0.5 c.

use super::thumbnail::{Pixel, Thumbnail, WIDTH, mean, share};

const BETA: f64 = 0.5;
/// Seen head-on where the rows come from: the right edge.
const APPROACH: [f64; 3] = [1.0, 0.0, 0.0];
/// Below this a displayed channel is too dark for a hue.
const VISIBLE: f64 = 40.0;

/// D at an angle off the motion.
fn doppler(degrees: f64) -> f64 {
    (1.0 - BETA * BETA).sqrt() / (1.0 - BETA * degrees.to_radians().cos())
}

/// Plates 8 to 12.
fn moving() -> [&'static Thumbnail; 5] {
    [8, 9, 10, 11, 12].map(Thumbnail::plate)
}

#[test]
fn plate_7_is_static() {
    let plate = Thumbnail::plate(7);
    assert!(plate.covered().len() > 2000);
    assert!(plate.covered().iter().all(|p| p.doppler == 1.0));
    let lit: Vec<_> = plate
        .pure()
        .into_iter()
        .filter(|p| p.value() > VISIBLE)
        .collect();
    assert!(lit.len() > 800);
    // Up to 4.7° where the filter brings a little of the grey background in.
    assert!(
        lit.iter()
            .all(|p| p.hue().abs() < 6.0 && p.saturation() > 0.9)
    );
}

#[test]
fn plates_8_to_12_come_in_from_the_right_and_leave_at_the_left() {
    let plate = Thumbnail::plate(8);
    for pixel in plate.covered() {
        // Facets are flat and spheres far: D is the angle's alone, to rounding.
        let angle = pixel.degrees_off(APPROACH);
        assert!((pixel.doppler / doppler(angle) - 1.0).abs() < 1e-9);
    }
    let edge = |x: fn(&Pixel<'_>) -> bool| {
        let pixels: Vec<_> = plate.covered().into_iter().filter(x).collect();
        mean(&pixels, |p| p.doppler)
    };
    // 1.732 and 0.866 at the edges' very middle.
    let (left, right) = (edge(|p| p.x < 8), edge(|p| p.x > 144));
    // Found 0.878 and 1.726.
    assert!(left < 0.9 && right > 1.68);
}

#[test]
fn plate_8_shows_the_original_red_29_5_degrees_left_of_centre() {
    let crossover = ((1.0 - (1.0f64 - BETA * BETA).sqrt()) / BETA)
        .acos()
        .to_degrees();
    assert!((crossover - 45.0 - 29.5).abs() < 0.1);
    let plate = Thumbnail::plate(8);
    let original: Vec<_> = plate
        .pure()
        .into_iter()
        .filter(|p| (p.doppler - 1.0).abs() < 0.01)
        .collect();
    assert!(original.len() > 20);
    let left_of_centre = |p: &Pixel<'_>| {
        (1.0 - 2.0 * (f64::from(p.x) + 0.5) / f64::from(WIDTH))
            .atan()
            .to_degrees()
    };
    for pixel in &original {
        assert!((pixel.degrees_off(APPROACH) - crossover).abs() < 1.5);
        assert!(pixel.hue().abs() < 4.0, "{}", pixel.hue());
    }
    // In the row of spheres that the middle line cuts.
    let middle: Vec<_> = original
        .iter()
        .filter(|p| (f64::from(p.y) + 0.5 - 45.0).abs() < 8.0)
        .collect();
    let angle = mean(middle.iter().copied(), left_of_centre);
    // 28.9 in 19 pixels; D = 1 ± 0.01 is ± 1.2 degrees wide.
    assert!((angle - 29.5).abs() < 1.5, "{angle}");
}

#[test]
fn plate_8_goes_from_blue_to_black_towards_the_right() {
    let plate = Thumbnail::plate(8);
    let blue: Vec<_> = plate
        .pure()
        .into_iter()
        .filter(|p| (1.38..1.5).contains(&p.doppler))
        .collect();
    // 244.6.
    assert!((220.0..265.0).contains(&mean(&blue, Pixel::hue)));
    assert!(mean(&blue, Pixel::value) > 100.0);
    let luminance = |from: f64, to: f64| {
        let pixels = plate.covered();
        mean(
            pixels.iter().filter(|p| (from..to).contains(&p.doppler)),
            |p| p.probe.xyz[1],
        )
    };
    let falling = [
        luminance(1.3, 1.4),
        luminance(1.4, 1.5),
        luminance(1.5, 1.6),
        luminance(1.6, 1.7),
        luminance(1.7, 1.74),
    ];
    // Each tenth in D costs more than half of the light, from the green's height to 375 nm.
    assert!(
        falling.windows(2).all(|pair| pair[1] < 0.5 * pair[0]),
        "{falling:?}"
    );
    // About 59, 17, 4.3, 0.33 and 0.05 cd/m2.
    assert!(falling[4] < 1e-3 * falling[0], "{falling:?}");
    let end: Vec<_> = plate
        .covered()
        .into_iter()
        .filter(|p| p.doppler > 1.7)
        .collect();
    // 35, of which the background, seen between the spheres, has 23.
    assert!(mean(&end, Pixel::value) < 45.0);
}

#[test]
fn plate_8_packs_the_rows_closer_than_plate_7() {
    // The rows' far ends at rest are 3° off the motion at the most, aberration carries them to 1.5°.
    let right = |plate: &Thumbnail| plate.covered().iter().filter(|p| p.x >= 150).count();
    let (moving, still) = (right(Thumbnail::plate(8)), right(Thumbnail::plate(7)));
    // 6 pixels against none.
    assert!(moving > still);
}

#[test]
fn plates_9_to_11_glow_spreads_from_the_approaching_side_until_plate_11_washes_out() {
    let [cold, plates @ ..] = moving();
    // A pixel glows where its thermal light is a twentieth of the display's white or more.
    let white = 100.0 / cold.exposure.exp2();
    let glows = |hot: &Thumbnail, p: &Pixel<'_>| {
        let at = (p.y * WIDTH + p.x) as usize;
        f64::from(hot.film.xyz[at][1] - cold.film.xyz[at][1]) > 0.05 * white
    };
    let third = |hot: &Thumbnail, i: u32| {
        let pixels: Vec<_> = cold
            .covered()
            .into_iter()
            .filter(|p| p.x * 3 / WIDTH == i)
            .collect();
        share(&pixels, |p| glows(hot, p))
    };
    let spread: Vec<[f64; 3]> = plates[..3]
        .iter()
        .map(|hot| [0, 1, 2].map(|i| third(hot, i)))
        .collect();
    for [left, middle, right] in &spread {
        assert!(left <= middle && middle <= right);
    }
    let [nine, ten, eleven] = [0, 1, 2].map(|i| spread[i].iter().sum::<f64>());
    assert!(nine < ten && ten < eleven);
    assert!(
        spread[0][2] > 0.8 && spread[0][0] == 0.0,
        "only the right glows in plate 9"
    );
    assert!(spread[2][0] > 0.8, "all glows in plate 11");
    let pale = |plate: &Thumbnail| share(&plate.pure(), |p| p.saturation() < 0.4);
    let washed = [cold, plates[0], plates[1], plates[2]].map(pale);
    assert!(
        washed.windows(2).all(|pair| pair[0] < pair[1]),
        "{washed:?}"
    );
    // 0.64: all but the farthest left, which is tan.
    assert!(washed[3] > 0.55, "{washed:?}");
    let white = share(&plates[2].pure(), |p| {
        p.doppler < 1.2 || p.saturation() < 0.1
    });
    // 0.976.
    assert!(white > 0.95, "the right is white, {white}");
    let left = [plates[0], plates[1], plates[2]].map(|hot| surface(cold, hot));
    // 0.74, 0.56, 0.18.
    assert!(left[0] > left[1] && left[1] > left[2], "{left:?}");
}

/// The surface's share of the luminance from the crossover to the violet.
fn surface(cold: &Thumbnail, hot: &Thumbnail) -> f64 {
    let seen = cold.pure();
    mean(
        seen.iter().filter(|p| (0.97..1.5).contains(&p.doppler)),
        |p| p.luminance / f64::from(hot.film.xyz[(p.y * WIDTH + p.x) as usize][1]),
    )
}

#[test]
fn plate_12_shows_surface_color_again() {
    let [cold, _, _, washed, hot] = moving();
    // Of the surface's light there is something to see from the crossover to the violet: as pure
    // as a color can be in plate 8, 0.21 of it in plate 11 and 0.42 in plate 12.
    let colorful = |plate: &Thumbnail| {
        let seen = plate.pure();
        mean(
            seen.iter().filter(|p| (0.97..1.5).contains(&p.doppler)),
            Pixel::saturation,
        )
    };
    let [before, without, again] = [cold, washed, hot].map(colorful);
    assert!(
        before > 0.95 && again > 1.5 * without,
        "{before} {without} {again}"
    );
    let [without, again] = [washed, hot].map(|hot| surface(cold, hot));
    // 0.18 and 0.33.
    assert!(without < 0.25 && again > 1.5 * without, "{without} {again}");
    // And it is the surface's: the hue of plate 8 at the same place.
    let pairs: Vec<_> = hot
        .pure()
        .into_iter()
        .filter(|p| p.saturation() > 0.4)
        .filter_map(|p| Some((p, cold.pixel(p.x, p.y)?)))
        .filter(|(_, p)| p.value() > VISIBLE)
        .collect();
    let turn = |a: f64, b: f64| ((a - b + 540.0).rem_euclid(360.0) - 180.0).abs();
    let near = pairs
        .iter()
        .filter(|(a, b)| turn(a.hue(), b.hue()) < 30.0)
        .count();
    // 519 of 618.
    assert!(near as f64 > 0.75 * pairs.len() as f64);
}

#[test]
fn plates_7_to_12_share_one_exposure() {
    let stops = [7, 8, 9, 10, 11, 12].map(|n| Thumbnail::plate(n).exposure);
    assert!(stops.iter().all(|s| *s == stops[0]), "{stops:?}");
}
