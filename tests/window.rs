//! The observation window: bands from gamma rays to radio, against closed forms.
use crate::hard_cases::scene::Set;
use crate::hard_cases::wall::wall;
use restframe::film::{Channels, auto_exposure};

/// hc/k, nm·K, and 2hc², W·m⁻²·sr⁻¹·nm⁴ (CODATA 2018).
const C2: f64 = 1.438_776_877_503_933_8e7;
const C1: f64 = 1.191_042_972_397_188e20;

fn bands(window: [f64; 2], wavelengths: u32) -> String {
    format!(
        "[accuracy]\nwavelengths = {wavelengths}\n\
         [sensor]\nwindow = {window:?}\ncolor = \"bands\"\nexposure = 0"
    )
}

/// Ends of the long, middle and short third of a window, nm.
fn thirds([a, b]: [f64; 2]) -> [[f64; 2]; 3] {
    let end = |third: i32| a * (b / a).powf(f64::from(third) / 3.0);
    [2, 1, 0].map(|third| [end(third), end(third + 1)])
}

/// Band totals as the film has them, W·m⁻²·sr⁻¹, and as the probe sums its curve.
fn totals(set: &Set) -> [[f64; 3]; 2] {
    let film = set.film();
    assert_eq!(film.channels, Channels::Bands);
    [
        film.xyz[0].map(f64::from),
        set.probe([0, 0]).rgb.map(|value| 100.0 * value),
    ]
}

fn assert_near(found: [f64; 3], exact: [f64; 3], tolerance: f64, what: &str) {
    for (found, exact) in found.into_iter().zip(exact) {
        let error = (found / exact - 1.0).abs();
        assert!(
            error <= tolerance,
            "{what}: {found:e}, not {exact:e}: {error:e}"
        );
    }
}

/// ∫ B dλ from `a` to `b` nm, W·m⁻²·sr⁻¹: c₁ (T/c₂)⁴ ∫ x³/(eˣ − 1) dx, for x above 1 by Planck's
/// series Σ e⁻ⁿˣ (x³/n + 3x²/n² + 6x/n³ + 6/n⁴), for small x by Bernoulli's.
fn black_body([a, b]: [f64; 2], kelvin: f64) -> f64 {
    let above = |x: f64| -> f64 {
        let term = |n: f64| {
            (-n * x).exp()
                * (x.powi(3) / n + 3.0 * x * x / n.powi(2) + 6.0 * x / n.powi(3) + 6.0 / n.powi(4))
        };
        (1..60).map(|n| term(f64::from(n))).sum()
    };
    let below = |x: f64| {
        x.powi(3)
            * (1.0 / 3.0 - x / 8.0 + x.powi(2) / 60.0 - x.powi(4) / 5040.0 + x.powi(6) / 272_160.0
                - x.powi(8) / 13_305_600.0
                + x.powi(10) / 622_702_080.0)
    };
    let [long, short] = [b, a].map(|nm| C2 / nm / kelvin);
    let whole = std::f64::consts::PI.powi(4) / 15.0;
    let area = if long >= 1.0 {
        above(long) - above(short)
    } else if short < 1.0 {
        below(short) - below(long)
    } else {
        whole - above(short) - below(long)
    };
    C1 * (kelvin / C2).powi(4) * area
}

#[test]
fn the_two_series_meet_and_sum_to_stefan_and_boltzmann() {
    let kelvin = 5800.0;
    let middle = C2 / kelvin;
    let parts =
        black_body([1.0, middle * 1.001], kelvin) + black_body([middle * 1.001, 1e12], kelvin);
    assert!((parts / 20_425_553.694_837 - 1.0).abs() < 1e-11, "{parts}");
}

/// The tolerance is for 84 wavelengths: largest where they span three decades, and in Wien's part.
/// With 840 nothing but the film's f32 is left.
#[test]
fn black_bodies_fill_the_bands_that_plancks_series_says() {
    for (window, kelvin, tolerance) in [
        ([360.0, 830.0], 5800.0, 2e-7),
        ([4000.0, 14000.0], 300.0, 5e-7),
        ([0.01, 10.0], 1e7, 3e-3),
        ([1e7, 1e9], 10.0, 1e-4),
        ([1e-5, 1e-3], 1e11, 3e-5),
        ([1e12, 1e15], 300.0, 5e-4),
    ] {
        let exact = thirds(window).map(|third| black_body(third, kelvin));
        for (wavelengths, tolerance) in [(84, tolerance), (840, 5e-7)] {
            let set = wall(
                &bands(window, wavelengths),
                &format!("thermal = {{ temperature = {kelvin} }}"),
                0.0,
                0.0,
            );
            for (found, how) in totals(&set).into_iter().zip(["film", "probe"]) {
                let what = format!("{kelvin} K in {window:?} nm, {wavelengths}, {how}");
                assert_near(found, exact, tolerance, &what);
            }
        }
    }
}

/// The same through an emissivity that might vary, and so through other tables.
#[test]
fn a_moving_grey_body_is_one_at_its_shifted_temperature_in_any_window() {
    for (window, kelvin) in [
        ([4000.0, 14000.0], 200.0),
        ([0.1, 1.0], 1e7),
        ([5e6, 7e6], 3.0),
    ] {
        let step = 2.0 * f64::sqrt(window[0] * window[1]);
        let material = format!(
            "thermal = {{ temperature = {kelvin}, emissivity = {{ points = [[{step}, 0.5], [{}, 0.5]] }} }}",
            1.01 * step
        );
        let set = wall(&bands(window, 840), &material, 0.6, 0.0);
        let exact = thirds(window).map(|third| 0.5 * black_body(third, 2.0 * kelvin));
        for found in totals(&set) {
            assert_near(found, exact, 1e-6, &format!("{window:?}"));
        }
    }
}

#[test]
fn far_outside_its_points_a_curve_holds_its_end_or_is_zero() {
    for window in [[1e-3, 1e-2], [1e7, 1e8]] {
        let end = if window[0] < 400.0 { 0.25 } else { 0.75 };
        for (beyond, factor) in [("hold", 1.0), ("zero", 0.0)] {
            let curve = format!("{{ points = [[400, 0.25], [700, 0.75]], beyond = {beyond:?} }}");
            let material = format!(
                "emission = {{ scale = 3.0, spectrum = {curve} }}\ndiffuse = {{ weight = 0.5, spectrum = {curve} }}"
            );
            let set = wall(&bands(window, 84), &material, 0.0, 2.0);
            // Emission, and a sun of 2 W·m⁻²·nm⁻¹ on a diffuse wall.
            let level = factor * end * (3.0 + 0.5 * 2.0 / std::f64::consts::PI);
            let exact = thirds(window).map(|[a, b]| level * (b - a));
            for found in totals(&set) {
                if factor == 0.0 {
                    assert_eq!(found, [0.0; 3], "{window:?}");
                } else {
                    assert_near(found, exact, 1e-6, &format!("{window:?} {beyond}"));
                }
            }
        }
    }
}

/// D⁵ on the radiance of a background, D³ on a lamp's irradiance (a sun at rest, a wall that comes
/// on at D = 2 and is seen under D = 2: 2³ · 2⁵), the band as wide as ever.
#[test]
fn background_and_reflection_are_beamed_in_any_window() {
    for window in [[0.01, 10.0], [1e7, 1e9], [587.0, 591.0]] {
        let set = wall(
            &bands(window, 84),
            "diffuse = { weight = 0.5, spectrum = 1.0 }",
            0.6,
            2.0,
        );
        let level = 256.0 * 0.5 * 2.0 / std::f64::consts::PI;
        let exact = thirds(window).map(|[a, b]| level * (b - a));
        for found in totals(&set) {
            assert_near(found, exact, 1e-6, &format!("wall in {window:?}"));
        }
        let sky = format!(
            "yaw = 180\n[worldline.sky]\nvelocity = [0, 0, -0.6]\n\
             [background]\nworldline = \"sky\"\nspectrum = 0.01\n{}",
            bands(window, 84)
        );
        let exact = thirds(window).map(|[a, b]| 0.32 * (b - a));
        for found in totals(&wall(&sky, "diffuse = { spectrum = 1.0 }", 0.0, 1.0)) {
            assert_near(found, exact, 1e-6, &format!("sky in {window:?}"));
        }
    }
}

/// Where tables would be too fine, curves are summed: a line at 1178 nm, seen at D = 2.
#[test]
fn a_line_is_found_in_a_window_that_is_narrower_than_itself() {
    let line = "emission = { scale = 1.0, spectrum = { gaussian = { center = 1178, width = 3 } } }";
    let window = [588.9, 589.1];
    let exact = thirds(window).map(|[a, b]| {
        let value = |nm: f64| 32.0 * (-0.5 * ((2.0 * nm - 1178.0) / 3.0_f64).powi(2)).exp();
        // Simpson's rule, over a thirtieth of the line's width.
        (b - a) / 6.0 * (value(a) + 4.0 * value(0.5 * (a + b)) + value(b))
    });
    for found in totals(&wall(&bands(window, 84), line, 0.6, 0.0)) {
        assert_near(found, exact, 1e-6, "line");
    }
}

#[test]
fn the_eye_sees_nothing_of_other_windows_and_the_probe_tells_it_of_bands() {
    let hot = "thermal = { temperature = 6000 }";
    let shot = |sensor: &str| wall(&format!("[sensor]\nexposure = 0\n{sensor}"), hot, 0.0, 0.0);
    for window in ["window = [0.01, 10]", "window = [900, 1e9]"] {
        let dark = shot(window);
        assert_eq!(dark.film().xyz[0], [0.0; 3]);
        let bands = shot(&format!("{window}\ncolor = \"bands\"")).probe([0, 0]);
        let dark = dark.probe([0, 0]);
        assert_eq!((dark.xyz, dark.rgb), ([0.0; 3], [0.0; 3]));
        assert_eq!(
            (bands.xyz, &bands.wavelengths),
            ([0.0; 3], &dark.wavelengths)
        );
        assert!(bands.rgb.iter().any(|value| *value > 0.0));
    }
    let [eye, bands] = ["", "color = \"bands\""].map(|sensor| shot(sensor).probe([0, 0]));
    assert_eq!(eye.xyz, bands.xyz);
    assert!(eye.rgb != bands.rgb);
}

#[test]
fn automatic_exposure_brings_the_mean_of_the_bands_to_four_fifths() {
    let sensor = "[sensor]\nwindow = [4000, 14000]\ncolor = \"bands\"";
    let set = wall(sensor, "thermal = { temperature = 300 }", 0.0, 0.0);
    let mean = set.probe([0, 0]).rgb.iter().sum::<f64>() / 3.0;
    assert!((mean - 0.8).abs() < 1e-5, "{mean}");
    let whole = set.film().xyz[0].map(f64::from).iter().sum::<f64>();
    let exact = black_body([4000.0, 14000.0], 300.0);
    assert!((whole / exact - 1.0).abs() < 1e-5, "{whole} {exact}");
    let stops = auto_exposure(&set.film()).unwrap();
    assert!((whole / 3.0 / 100.0 * stops.exp2() - 0.8).abs() < 1e-6);
}
