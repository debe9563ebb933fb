//! Stars: how bright they are, where motion puts them, what colour it gives them.

use super::{Folder, looking, moving, off};
use restframe::color::cie;
use restframe::film::Film;
use restframe::spectrum::planck;

/// Illuminance (lx) of what a square image of 1° shows, on a surface that faces it, and the solid
/// angle of what shines.
fn received(film: &Film) -> [f64; 2] {
    let side = f64::from(film.width);
    let step = 2.0 * 0.5_f64.to_radians().tan() / side;
    let mut sums = [0.0; 2];
    for (i, xyz) in film.xyz.iter().enumerate() {
        let [x, y] =
            [i as f64 % side, (i as f64 / side).floor()].map(|i| (i + 0.5 - side / 2.0) * step);
        let cos = 1.0 / (1.0 + x * x + y * y).sqrt();
        let angle = step * step * cos.powi(3);
        sums[0] += f64::from(xyz[1]) * cos * angle;
        sums[1] += if xyz[1] > 0.0 { angle } else { 0.0 };
    }
    sums
}

fn luminance(kelvin: f64) -> f64 {
    cie::xyz_of(|nm| planck::radiance(nm, kelvin))[1]
}

/// Error of a disc of 200 pixels, most of it from its edge.
const PIXELS: f64 = 4e-3;

#[test]
fn a_star_lights_as_its_magnitude_says_whatever_its_size_and_temperature() {
    let folder = Folder::new();
    for (magnitude, kelvin, size) in [
        (0.0, 5772.0, 0.5),
        (-26.74, 3000.0, 0.7),
        (6.0, 30000.0, 0.9),
    ] {
        folder.write("stars.csv", format!("20, 10, {kelvin}, {magnitude}\n"));
        let sky = format!("stars = {{ file = \"stars.csv\", size = {size} }}");
        let [lux, angle] = received(&folder.film(400, &looking(20.0, 10.0, &sky)));
        let expected = 10f64.powf(-0.4 * (magnitude + 13.98));
        assert!(
            (lux / expected - 1.0).abs() < PIXELS,
            "{magnitude}: {lux:e} {expected:e}"
        );
        let disc = std::f64::consts::PI * f64::to_radians(0.5 * size).powi(2);
        assert!((angle / disc - 1.0).abs() < PIXELS);
    }
}

#[test]
fn a_star_abeam_of_a_camera_at_half_c_stands_60_degrees_from_ahead() {
    let folder = Folder::new();
    folder.write(
        "stars.csv",
        "90, 0, 6000, 1\n-90, 0, 6000, 1\n0, 90, 6000, 1\n",
    );
    let sky = "stars = { file = \"stars.csv\", size = 0.1 }";
    let lit = |yaw: f64| folder.sees(&moving(0.5, yaw, sky)).0.xyz[1] > 0.0;
    // cos θ′ = (cos θ + β)/(1 + β cos θ) = β; discs shrink by D = γ(1 + β cos θ) = γ.
    let radius = 0.05 * 0.75f64.sqrt();
    for side in [1.0, -1.0] {
        assert!(lit(60.0 * side));
        for edge in [radius, -radius] {
            assert!(lit(60.0 * side + 0.98 * edge));
            assert!(!lit(60.0 * side + 1.02 * edge));
        }
        assert!(!lit(90.0 * side));
    }
}

#[test]
fn a_star_ahead_becomes_one_of_d_times_the_temperature_on_a_disc_smaller_by_d_squared() {
    let folder = Folder::new();
    let (kelvin, magnitude) = (4000.0, 2.0);
    let rest_lux = 10f64.powf(-0.4_f64 * (magnitude + 13.98));
    // D of a star ahead: 2 at 0.6 c towards it, ½ away from it.
    for (azimuth, d, size) in [(0, 2.0, 1.6), (180, 0.5, 0.4)] {
        folder.write(
            "stars.csv",
            format!("{azimuth}, 0, {kelvin}, {magnitude}\n"),
        );
        let sky = format!("stars = {{ file = \"stars.csv\", size = {size} }}");
        let rest = moving(0.6, f64::from(azimuth), &sky);
        let [lux, angle] = received(&folder.film(400, &rest));
        let disc = std::f64::consts::PI * f64::to_radians(0.5 * size).powi(2);
        assert!((angle * d * d / disc - 1.0).abs() < PIXELS, "{azimuth}");
        // D⁵ B(Dλ, T) = B(λ, DT), on a solid angle smaller by D².
        let expected = rest_lux * luminance(d * kelvin) / luminance(kelvin) / (d * d);
        assert!(
            (lux / expected - 1.0).abs() < PIXELS,
            "{azimuth}: {lux:e} {expected:e}"
        );

        let (probe, imaged) = folder.sees(&rest);
        let scale = rest_lux / disc / luminance(kelvin);
        let curve: Vec<f64> = probe
            .wavelengths
            .iter()
            .map(|nm| scale * d.powi(5) * planck::radiance(d * nm, kelvin))
            .collect();
        // sin² of the disc's radius is its square but for 7e-5.
        assert!(off(&probe.radiance, &curve) < 1e-4);
        let hotter = cie::xyz_of(|nm| scale * planck::radiance(nm, d * kelvin));
        assert!(off(&probe.xyz, &hotter) < 1e-3 && off(&imaged, &hotter) < 1e-3);

        // Irradiance at λ is D³ that at Dλ at rest; all of it together D² (D⁴ on the radiance).
        let at = 40;
        let nm = probe.wavelengths[at];
        let irradiance = probe.radiance[at] * disc / (d * d);
        let at_rest = scale * planck::radiance(d * nm, kelvin) * disc;
        assert!((irradiance / (d.powi(3) * at_rest) - 1.0).abs() < 1e-4);
        let total = planck::total(d * kelvin) / (d * d) / planck::total(kelvin);
        assert!((total / d.powi(2) - 1.0).abs() < 1e-12);
    }
}

#[test]
fn stars_of_one_place_add() {
    let folder = Folder::new();
    let sees = |stars: &str| {
        folder.write("stars.csv", stars);
        folder.sees(&looking(0.0, 0.0, "stars = { file = \"stars.csv\" }"))
    };
    let (one, _) = sees("0, 0, 4000, 2\n");
    let (other, _) = sees("0, 0.01, 9000, 3\n");
    let (both, imaged) = sees("0, 0, 4000, 2\n0, 0.01, 9000, 3\n1, 0, 9000, -3\n");
    let sum: Vec<f64> = one
        .radiance
        .iter()
        .zip(&other.radiance)
        .map(|(a, b)| a + b)
        .collect();
    assert!(off(&both.radiance, &sum) < 1e-14);
    assert!(off(&imaged, &both.xyz) < 1e-5);
    assert!(other.xyz[1] > 0.0);
}
