//! Plates 3 to 6: an array of red spheres at 0.25 c.

use super::thumbnail::{HEIGHT, Pixel, Thumbnail, WIDTH, mean, share};

const BETA: f64 = 0.25;
/// Seen head-on where the array comes from.
const APPROACH: [f64; 3] = [0.0, 0.0, -1.0];
/// Where a pixel's center may look off the direction of an exact angle, degrees: a sphere's facets
/// and D's tolerance of 0.005 (0.9° where D changes by 0.0044 a degree) together.
const DIRECTION: f64 = 1.2;
/// Below this a displayed channel is too dark for a hue.
const VISIBLE: f64 = 40.0;

fn head_on() -> f64 {
    ((1.0 + BETA) / (1.0 - BETA)).sqrt()
}

#[test]
fn plate_3_is_red_everywhere() {
    let plate = Thumbnail::plate(3);
    let pixels = plate.covered();
    assert!(pixels.len() > 8000, "{}", pixels.len());
    assert!(pixels.iter().all(|p| p.doppler == 1.0));
    let lit: Vec<_> = plate
        .pure()
        .into_iter()
        .filter(|p| p.value() > VISIBLE)
        .collect();
    assert!(lit.len() > 2000, "{}", lit.len());
    assert!(
        lit.iter()
            .all(|p| p.hue().abs() < 2.0 && p.saturation() > 0.9)
    );
}

#[test]
fn plate_4_axis_spheres_are_green_650_nm_seen_at_503_nm() {
    let plate = Thumbnail::plate(4);
    let near: Vec<_> = plate
        .pure()
        .into_iter()
        .filter(|p| p.degrees_off(APPROACH) < 6.0)
        .collect();
    // 284 pixels of hues 154.7 to 158.6.
    assert!(near.len() > 20, "{}", near.len());
    for pixel in &near {
        // D falls by 0.2 % over 6°.
        assert!(
            (pixel.doppler / head_on() - 1.0).abs() < 2.5e-3,
            "{}",
            pixel.doppler
        );
        assert!((120.0..170.0).contains(&pixel.hue()), "{}", pixel.hue());
        // The lamps' light is the same at all wavelengths: the band peaks where it is seen,
        // to the grid's step of 1 %.
        let probe = pixel.probe;
        let peak = probe
            .wavelengths
            .iter()
            .zip(&probe.radiance)
            .max_by(|a, b| a.1.total_cmp(b.1));
        assert!((peak.unwrap().0 - 503.5).abs() < 4.0, "{peak:?}");
    }
}

#[test]
fn plate_4_lower_half_is_far_brighter() {
    let plate = Thumbnail::plate(4);
    let (mut upper, mut lower) = (0.0, 0.0);
    for y in 0..HEIGHT / 2 {
        for x in 0..WIDTH {
            let (Some(above), Some(below)) = (plate.pixel(x, y), plate.pixel(x, HEIGHT - 1 - y))
            else {
                continue;
            };
            upper += above.luminance;
            lower += below.luminance;
            // The array is its own mirror image, but for the turn of the mesh's facets.
            let ratio = below.probe.xyz[1] / above.probe.xyz[1];
            let beaming = below.doppler.powi(5);
            if (below.doppler - above.doppler).abs() < 1e-4 && above.probe.xyz[1] > 100.0 {
                assert!((ratio / beaming - 1.0).abs() < 0.05, "{ratio} {beaming}");
            }
        }
    }
    // 3.17 over the field; on the axis 3.58.
    assert!(lower > 2.5 * upper, "{}", lower / upper);
}

#[test]
fn plate_5_runs_from_green_to_orange() {
    let plate = Thumbnail::plate(5);
    let lit: Vec<_> = plate
        .pure()
        .into_iter()
        .filter(|p| p.value() > VISIBLE)
        .collect();
    let factors = lit.iter().map(|p| p.doppler);
    let (least, most) = (
        factors.clone().fold(9.0, f64::min),
        factors.fold(0.0, f64::max),
    );
    // Between 21° and 81° off the motion in the middle row: 1.263 and 1.008.
    // Found: 1.262 and 1.006 (off the middle row).
    assert!(most > 1.25 && least < 1.02);
    let strips = strips(&lit, 6);
    // 127, 120, 89, 46, 21, 1.
    assert!(
        strips.windows(2).all(|pair| pair[0] > pair[1]),
        "{strips:?}"
    );
    assert!(strips[0] > 110.0, "green, {strips:?}");
    assert!(
        strips.iter().any(|hue| (60.0..90.0).contains(hue)),
        "lime, {strips:?}"
    );
    assert!(
        strips.iter().any(|hue| (30.0..50.0).contains(hue)),
        "yellow, {strips:?}"
    );
    let orange = share(&lit, |p| (12.0..40.0).contains(&p.hue()));
    assert!(orange > 0.1, "orange, {orange}");
}

#[test]
fn plate_6_has_an_orange_sphere_in_the_foreground() {
    let plate = Thumbnail::plate(6);
    // What the middle line sees within 3 m on this side of the crossover; all else is beyond 4 m.
    let foreground: Vec<_> = plate
        .pure()
        .into_iter()
        .filter(|p| (f64::from(p.y) + 0.5 - 45.0).abs() < 3.0 && p.value() > VISIBLE)
        .filter(|p| distance(p) < 3.0 && (1.02..1.09).contains(&p.doppler))
        .collect();
    let hue = mean(&foreground, Pixel::hue);
    assert!(foreground.len() > 50, "{}", foreground.len());
    // Mean 17.8, from 3.8 at its far limb to 28.1.
    assert!((12.0..40.0).contains(&hue), "{hue}");
}

#[test]
fn plate_6_shows_the_original_red_at_the_crossover_82_7_degrees_off_the_motion() {
    let angle = ((1.0 - (1.0f64 - BETA * BETA).sqrt()) / BETA)
        .acos()
        .to_degrees();
    assert!((angle - 82.7).abs() < 0.05);
    let plate = Thumbnail::plate(6);
    let original: Vec<_> = plate
        .pure()
        .into_iter()
        .filter(|p| (p.doppler - 1.0).abs() < 0.005)
        .collect();
    // 316 pixels, all of hue 0.
    assert!(original.len() > 30, "{}", original.len());
    for pixel in original {
        assert!((pixel.degrees_off(APPROACH) - angle).abs() < DIRECTION);
        // Plate 3's red, where it is lit.
        assert!(
            pixel.value() < VISIBLE || pixel.hue().abs() < 3.0,
            "{}",
            pixel.hue()
        );
    }
    // On its two sides: yellow and beyond, and what sinks into the infrared.
    let lit: Vec<_> = plate
        .pure()
        .into_iter()
        .filter(|p| p.value() > VISIBLE)
        .collect();
    assert!(mean(lit.iter().filter(|p| p.doppler > 1.1), Pixel::hue) > 40.0);
    let dark: Vec<_> = plate
        .covered()
        .into_iter()
        .filter(|p| p.doppler < 0.96)
        .collect();
    assert!(mean(&dark, Pixel::value) < 100.0);
}

fn distance(pixel: &Pixel<'_>) -> f64 {
    pixel.probe.hit.as_ref().unwrap().distance
}

/// Mean hue of equally wide strips from left to right.
fn strips(pixels: &[Pixel<'_>], count: u32) -> Vec<f64> {
    (0..count)
        .map(|i| {
            mean(
                pixels.iter().filter(|p| p.x * count / WIDTH == i),
                Pixel::hue,
            )
        })
        .collect()
}
