//! Images and stars under a Doppler factor.

use super::{Folder, both, moving, off, shader};
use glam::DVec3;
use restframe::frame::Frame;
use restframe::spectrum::{Uplift, illuminant};

#[test]
fn a_coloured_image_is_its_uplift_under_d65_shifted_and_beamed() {
    let folder = Folder::new();
    let d65 = illuminant("D65").unwrap();
    for color in [[0.5, 0.1, 0.3], [0.02, 0.8, 0.0], [0.0, 0.0, 6.0_f32]] {
        folder.paint("sky.exr", [2, 1], |_, _| color);
        let greatest = color.into_iter().fold(0.0, f32::max);
        let uplift = Uplift::new(color.map(|c| f64::from(0.5 * c / greatest))).unwrap();
        for (beta, yaw) in [(0.5, 0.0), (0.5, 120.0), (0.9, 0.0), (0.9, 180.0)] {
            let (probe, imaged) = folder.sees(&moving(beta, yaw, "image = \"sky.exr\""));
            // Yaw is the angle from the motion in the camera's frame: D = 1/(γ(1 − β cos θ′)).
            let lorentz_factor = 1.0 / f64::sqrt(1.0 - beta * beta);
            let d = 1.0 / (lorentz_factor * (1.0 - beta * f64::cos(yaw.to_radians())));
            let expected: Vec<f64> = probe
                .wavelengths
                .iter()
                .map(|nm| {
                    let color = 2.0 * f64::from(greatest) * uplift.at(d * nm);
                    d.powi(5) * color * d65.at(d * nm)
                })
                .collect();
            let apart = off(&probe.radiance, &expected);
            assert!(apart < 1e-3, "{color:?} {beta} {yaw}: {apart:e}");
            assert!(off(&imaged, &probe.xyz) < 1e-5);
        }
    }
}

#[test]
fn at_any_doppler_factor_light_is_finite_and_not_negative_and_both_ways_agree() {
    let folder = Folder::new();
    let wild = |x: u32, y: u32| {
        [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0, 1e-30, 0.0],
            [3e38, 0.0, 1.0],
            [0.1, 0.2, 0.3],
            [0.0, 0.0, 4.0],
        ][((x + 3 * y) % 6) as usize]
    };
    folder.paint("sky.exr", [8, 4], wild);
    let directions: Vec<DVec3> = (0..40)
        .map(|i| {
            let (turn, up) = (f64::from(i) * 2.4, (f64::from(i) - 19.5) / 20.0);
            let across = f64::sqrt(1.0 - up * up);
            DVec3::new(across * turn.cos(), up, across * turn.sin())
        })
        .collect();
    for beaming in ["full", "square", "off"] {
        for doppler in ["auto", "off"] {
            for spectra in ["grid", "spline"] {
                let rest = format!(
                    "{}stars = {{ count = 400, size = 9 }}\n\
                     [effects]\nbeaming = \"{beaming}\"\ndoppler = \"{doppler}\"\n[accuracy]\nspectra = \"{spectra}\"\n",
                    moving(0.5, 0.0, "image = \"sky.exr\"\nscale = 7")
                );
                let prepared = folder.shot(1, &rest).unwrap();
                let shader = shader(&prepared);
                for exponent in -24..=24 {
                    let d = 10f64.powf(f64::from(exponent) / 4.0);
                    for direction in &directions {
                        let [short, long] = both(&shader, d, *direction);
                        let sane = |v: &f64| v.is_finite() && *v >= 0.0;
                        assert!(short.iter().chain(&long).all(sane), "{d} {short:?}");
                        let apart = off(&short, &long);
                        let top = long.iter().fold(0.0, |t: f64, v| t.max(*v));
                        assert!(
                            apart < 1e-3 || top < 1e-200,
                            "{beaming} {doppler} {spectra} {d} {direction}: {apart:e} {short:?} {long:?}"
                        );
                    }
                }
            }
        }
    }
}

#[test]
fn a_sky_that_moves_calls_for_the_shift() {
    let folder = Folder::new();
    folder.paint("sky.hdr", [2, 1], |_, _| [1.0; 3]);
    let called = |sky: &str| {
        // Nothing but the sky moves against the camera.
        let rest = format!(
            "[worldline.sky]\nvelocity = [0, 0, 0.5]\n[camera]\n[background]\nworldline = \"sky\"\n{sky}\n"
        );
        let shot = folder.shot(1, &rest).unwrap().shot;
        Frame::new(&shot, 1)
            .unwrap()
            .active_effects(&shot.effects)
            .doppler
    };
    assert!(called("image = \"sky.hdr\""));
    assert!(called("stars = { count = 3 }"));
    assert!(called("stars = { count = 3 }\nscale = 0"));
    assert!(!called("image = \"sky.hdr\"\nscale = 0"));
    assert!(!called("spectrum = 0.0"));
    assert!(!called(""));
}
