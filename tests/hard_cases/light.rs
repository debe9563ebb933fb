//! C. Radiometry and spectra.

use super::files::Files;
use super::scene::Set;
use restframe::film::Film;
use restframe::probe::Probe;
use restframe::spectrum::{Beyond, Cardinal, PlanckShape, Spectrum, planck};
use std::path::Path;

const EPSILON: f64 = f64::EPSILON;

/// Relative rounding of a curve that is held in f32: the value, its two weights, their sum.
const BAKED: f64 = 4.0 * (f32::EPSILON / 2.0) as f64;

/// Rounding of D⁵: D to 4 ε, times five, and four products.
const FIFTH_POWER: f64 = 24.0 * EPSILON;

/// √((1 + β)/(1 − β)) at 0.5 and 0.99, to 60 digits by mpmath.
const D_HALF: f64 = 1.732_050_807_568_877_3;
const D_099: f64 = 14.106_735_979_665_885;

/// A shot of a wall that moves along the line of sight, which meets it at its origin: the one pixel
/// is seen through its centre. `rest` goes on after `[sensor]`.
fn wall(velocity: &str, paint: &str, rest: &str) -> String {
    format!(
        "[image]\nsize = [1, 1]\nsamples = 1\n\
         [worldline.fast]\nvelocity = {velocity}\n\
         [[model]]\nfile = \"wall.obj\"\nworldline = \"fast\"\nmaterial = \"paint\"\n\
         translate = [0.3, 0.2, 0]\n\
         [material.paint]\n{paint}\n\
         [camera]\nposition = [0, 0, 3]\n\
         [sensor]\nexposure = 0\n{rest}"
    )
}

/// What the pixel of [`wall`] receives.
fn seen(velocity: &str, paint: &str, rest: &str) -> Probe {
    Set::new(&wall(velocity, paint, rest)).probe([0, 0])
}

/// What it receives at `wavelengths` from `from` to `to`, nm. No shot can ask for a window other than
/// the eye's yet; the renderer can be asked.
fn seen_within(
    [from, to]: [f64; 2],
    wavelengths: u32,
    velocity: &str,
    paint: &str,
    rest: &str,
) -> Probe {
    let mut set = Set::new(&wall(velocity, paint, rest));
    set.prepared.shot.sensor.window = [from, to];
    set.prepared.shot.accuracy.wavelengths = wavelengths;
    set.probe([0, 0])
}

/// A window in whose middle lies `nm`.
fn around(nm: f64, factor: f64) -> [f64; 2] {
    [nm / factor, nm * factor]
}

/// ∫ L (λ/nm)ᵖ dλ over the sensor's wavelengths, which are equally spaced in ln λ.
fn total(probe: &Probe, power: i32) -> f64 {
    let nm = &probe.wavelengths;
    let spacing = (nm[nm.len() - 1] / nm[0]).ln() / (nm.len() - 1) as f64;
    let terms = probe.radiance.iter().zip(nm);
    spacing * terms.map(|(l, nm)| l * nm.powi(power + 1)).sum::<f64>()
}

/// The temperature of the black body that has a spectral radiance, from Planck's law solved for T.
fn brightness_temperature(nm: f64, radiance: f64) -> f64 {
    planck::C2 / (nm * (planck::C1 / (nm.powi(5) * radiance)).ln_1p())
}

/// The largest |found/exact − 1|.
fn worst(found: &[f64], exact: impl Fn(usize) -> f64) -> f64 {
    let off = |(j, found): (usize, &f64)| (found / exact(j) - 1.0).abs();
    found.iter().enumerate().map(off).fold(0.0, f64::max)
}

fn is_black(film: &Film) -> bool {
    film.xyz.as_flattened().iter().all(|v| v.to_bits() == 0)
}

cases! {
    /// At β = ±0.28, D is 4/3 or 3/4. One emitter: a line at 560 nm of σ = 5 nm and peak 1, read at
    /// its peak for the spectral radiance. Sums over its wavelengths converge faster than any power
    /// (σ is 70 of their spacings), and a linear reading between 32 phases errs by
    /// (h/32)²/8·(560/5)² = 1.4e-8 at the peak, by as much again but of either sign over the line.
    fn c1_radiance_grows_with_the_fifth_fourth_and_third_power(card) {
        for (velocity, d) in [("[0, 0, 0.28]", 4.0 / 3.0_f64), ("[0, 0, -0.28]", 0.75)] {
            let paint = "emission = { spectrum = { gaussian = { center = 560, width = 5 } } }";
            let line = |beaming: &str| {
                let rest = format!("[effects]\nbeaming = \"{beaming}\"\n");
                seen_within(around(560.0 / d, 1.1), 2047, velocity, paint, &rest)
            };
            let full = line("full");
            let peak = |probe: &Probe| probe.radiance[1023];
            let bound = BAKED + 2e-8;
            card.relative(
                &format!("spectral radiance of a line, D = {d:.4}: D⁵"),
                d.powi(5),
                peak(&full),
                bound,
            );
            card.relative(
                "under \"square\": D²",
                d.powi(2),
                peak(&line("square")),
                bound,
            );
            card.relative("under \"off\": 1", 1.0, peak(&line("off")), bound);
            // √(2π)·5 and, over hc, √(2π)·5·560.
            let flux = 12.533_141_373_155_003;
            card.relative("its total: D⁴", d.powi(4) * flux, total(&full, 0), bound);
            card.relative(
                "its photons: D³",
                d.powi(3) * flux * 560.0,
                total(&full, 1),
                bound,
            );
            for (beaming, power) in [("full", 5), ("square", 2), ("off", 0)] {
                let rest = format!("[effects]\nbeaming = \"{beaming}\"\n");
                let flat = seen(velocity, "emission = { spectrum = 1.0 }", &rest).radiance;
                let quantity =
                    format!("flat spectral radiance of 1 under \"{beaming}\" against D^{power}");
                card.at_most(&quantity, worst(&flat, |_| d.powi(power)), FIFTH_POWER);
            }
        }
    }

    /// In log space: each of ln B has the error ε(5 |ln λ| + 2x) that its doc gives, which is less
    /// than 1e-13 of |ln B| or of 1. Then rendered: as thermal light, which is a black body at D·T,
    /// to D's own rounding; and as a curve of Planck's form that is shifted and given its D⁵, to
    /// that of f32.
    fn c2_a_moving_black_body_is_one_at_d_times_its_temperature(card) {
        let mut off = 0f64;
        for nm in (-30..=120).map(|e| 10_f64.powf(0.1 * f64::from(e))) {
            for kelvin in (-3..=9).map(|e| 10_f64.powi(e)) {
                for d in (-18..=18).map(|e| 10_f64.powf(0.5 * f64::from(e))) {
                    let at_dt = planck::ln_radiance(nm, d * kelvin);
                    let shifted = 5.0 * d.ln() + planck::ln_radiance(d * nm, kelvin);
                    off = off.max((at_dt - shifted).abs() / at_dt.abs().max(1.0));
                }
            }
        }
        card.at_most(
            "ln B(λ, DT) − ln D⁵B(Dλ, T), 1e-12 m to 1e3 m, 1e-3 K to 1e9 K, D 1e-9 to 1e9",
            off,
            1e-13,
        );
        for (beta, kelvin, expected) in [
            (0.99, 300.0, 4_232.020_793_899_765),
            (0.99, 600.0, 8_464.041_587_799_53),
            (0.5, 1663.0, 2_880.400_492_987_043),
            (0.5, 2000.0, 3_464.101_615_137_754_6),
            (0.5, 4000.0, 6_928.203_230_275_509),
            (0.5, 10000.0, 17_320.508_075_688_773),
        ] {
            let velocity = format!("[0, 0, {beta}]");
            let hot = seen(
                &velocity,
                &format!("thermal = {{ temperature = {kelvin} }}"),
                "",
            );
            let seen_as = brightness_temperature(hot.wavelengths[42], hot.radiance[42]);
            card.relative(
                &format!("{kelvin} K at {beta} c head-on, K"),
                expected,
                seen_as,
                16.0 * EPSILON,
            );
            let unit = planck::radiance(560.0, kelvin);
            let paint =
                format!("emission = {{ scale = {unit:e}, spectrum = {{ blackbody = {kelvin} }} }}");
            let curve = seen(&velocity, &paint, "[accuracy]\nspectra = \"spline\"\n");
            let exact = |j: usize| planck::radiance(curve.wavelengths[j], expected);
            card.at_most(
                "the same by shifting its curve, at every wavelength",
                worst(&curve.radiance, exact),
                BAKED,
            );
            card.relative("and of the two luminances", hot.xyz[1], curve.xyz[1], BAKED);
        }
    }

    fn c3_at_absolute_zero_nothing_shines(card) {
        let kelvins = [0.0, -0.0];
        let dark = |nm: f64| {
            kelvins
                .iter()
                .all(|&k| planck::radiance(nm, k).to_bits() == 0)
        };
        card.holds(
            "B(λ, 0) is 0 from 1e-300 nm to 1e300 nm",
            (-300..=300).all(|e| dark(10_f64.powi(e))),
        );
        let rays = [
            "[0, 0, 0]",
            "[0, 0, 0.5]",
            "[0, 0, -0.5]",
            "{ gamma = 1e8, direction = [0, 0, 1] }",
        ];
        let black = rays.iter().all(|velocity| {
            let set = Set::new(&wall(velocity, "thermal = { temperature = 0 }", ""));
            let probe = set.probe([0, 0]);
            probe.hit.is_some()
                && probe.radiance.iter().all(|l| l.to_bits() == 0)
                && is_black(&set.film())
        });
        card.holds(
            "a wall at 0 K is black at rest, D = √3, 1/√3 and 2e8",
            black,
        );
        for kelvin in ["-1e-300", "-5", "nan", "inf", "-inf"] {
            let text = wall(
                "[0, 0, 0]",
                &format!("thermal = {{ temperature = {kelvin} }}"),
                "",
            );
            let refused = restframe::shot::parse(&text, Path::new("case.toml"))
                .is_err_and(|mistakes| mistakes.to_string().contains("temperature"));
            let shape = PlanckShape::new(kelvin.parse().unwrap(), 560.0);
            card.holds(
                &format!("a temperature of {kelvin} is refused by name"),
                refused && shape.is_err(),
            );
        }
    }

    /// ln B to ε(5 |ln λ| + 2x) = 4e-13, x being 872.
    fn c4_deep_in_wiens_tail_nothing_overflows(card) {
        card.same("B(550 nm, 30 K)", 0.0, planck::radiance(550.0, 30.0));
        let ln = planck::ln_radiance(550.0, 30.0);
        // By mpmath, at 40 digits; a metre is 1e9 nm.
        card.near("ln B per nm", -857.309_046_526_612, ln, 4e-13);
        card.near(
            "ln B per metre",
            -836.585_780_689_665_5,
            ln + 9.0 * 10_f64.ln(),
            4e-13,
        );
        let probe = seen_within(
            around(550.0, 2.0),
            85,
            "[0, 0, 0]",
            "thermal = { temperature = 30 }",
            "",
        );
        card.same("a wall at 30 K, at 550 nm", 0.0, probe.radiance[42]);
        card.holds(
            "finite from 275 nm to 1100 nm",
            probe.radiance.iter().all(|l| l.is_finite()),
        );
        let dark = wall("[0, 0, 0]", "thermal = { temperature = 30 }", "");
        card.holds("and black on the film", is_black(&Set::new(&dark).film()));
    }

    /// The error of B is 16 ε while x < 4; that of the sensor's middle wavelength, 4 ε, counts four
    /// times.
    fn c5_radio_waves_follow_rayleigh_and_jeans(card) {
        let found = planck::radiance(1e10, 1e4);
        // 2ckT/λ⁴ at 10 m, 1e4 K is 8.27816314690484e-24 W·m⁻²·sr⁻¹·nm⁻¹, exactly; the
        // rest by mpmath.
        let (leading, exact) = (8.278_163_146_904_84e-24, 8.278_162_551_383_368e-24);
        card.relative("B(10 m, 1e4 K)", exact, found, 16.0 * EPSILON);
        let lacking = 1.0 - found / leading;
        let quantity = "what it lacks to 2ckT/λ⁴, relative, against 7.1938842e-8";
        card.at_most(
            quantity,
            (lacking - 7.193_884_215_001_309e-8).abs(),
            16.0 * EPSILON,
        );
        let radio = seen_within(
            around(1e10, 2.0),
            85,
            "[0, 0, 0]",
            "thermal = { temperature = 1e4 }",
            "",
        );
        card.relative(
            "seen by a sensor for 5 m to 20 m",
            exact,
            radio.radiance[42],
            32.0 * EPSILON,
        );
        card.holds("which is dark to the eye", radio.xyz == [0.0; 3]);
    }

    /// 4 ε x with x = 14.4; λ's rounding, 4 ε, counts x − 5 = 10 times.
    fn c6_x_rays_do_not_underflow_the_fifth_power(card) {
        // By mpmath: 6.7204613861351746619e27 per metre.
        let exact = 6.720_461_386_135_175e18;
        card.relative(
            "B(0.1 nm, 1e7 K), per nm",
            exact,
            planck::radiance(0.1, 1e7),
            60.0 * EPSILON,
        );
        let rays = seen_within(
            around(0.1, 2.0),
            85,
            "[0, 0, 0]",
            "thermal = { temperature = 1e7 }",
            "",
        );
        card.relative(
            "seen by a sensor for X-rays",
            exact,
            rays.radiance[42],
            120.0 * EPSILON,
        );
    }

    /// 128 wavelengths equally spaced in ln λ from 1 nm to 1 m sum a curve that is analytic there
    /// for |Im ln λ| < π/2 to e^−(π²/0.16) = 1e-27; below 1 nm lies e^−175 of it, beyond 1 m 1e-17.
    fn c7_all_wavelengths_together_follow_stefan_and_boltzmann(card) {
        // 2π⁴k⁴T⁴/(15h³c²) at 5800 K, by mpmath.
        let exact = 20_425_553.694_836_73;
        card.relative(
            "∫ B(λ, 5800 K) dλ",
            exact,
            planck::total(5800.0),
            16.0 * EPSILON,
        );
        for (velocity, d) in [
            ("[0, 0, 0]", 1.0_f64),
            ("[0, 0, 0.5]", D_HALF),
            ("[0, 0, -0.5]", 1.0 / D_HALF),
            ("[0, 0, 0.99]", D_099),
        ] {
            let probe = seen_within(
                [1.0, 1e9],
                128,
                velocity,
                "thermal = { temperature = 5800 }",
                "",
            );
            card.relative(
                &format!("of a wall with D = {d:.4}: times D⁴"),
                exact * d.powi(4),
                total(&probe, 0),
                1e-13,
            );
        }
    }

    /// B to 4 ε max(x, 4), x being 15.1 and 0.7, at places where it changes 10 and 4 times as fast as
    /// λ: 6 ε and 4 ε, and as much for the peak's wavelength and radiance. The peak of a rendered
    /// curve: the vertex of a parabola through three wavelengths h = 7.4e-4 apart in ln λ, which errs
    /// by the order of h² = 6e-7, measured 1.02e-7.
    fn c8_the_peak_follows_wien_and_moves_by_the_doppler_factor(card) {
        card.relative(
            "peak wavelength times T, nm K",
            2_897_771.955_185_172_7,
            planck::peak_nm(1.0),
            4.0 * EPSILON,
        );
        let peak = planck::peak_nm(5800.0);
        let part =
            |ratio: f64| planck::radiance(ratio * peak, 5800.0) / planck::peak_radiance(5800.0);
        for (exact, [mut below, mut above]) in [
            (0.328_017_859_857_527_1, [0.1, 1.0]),
            (6.623_935_265_632_753, [20.0, 1.0]),
        ] {
            for _ in 0..60 {
                let middle = 0.5 * (below + above);
                *if part(middle) < 0.01 {
                    &mut below
                } else {
                    &mut above
                } = middle;
            }
            card.relative(
                "where B is 1 % of its peak, in peak wavelengths",
                exact,
                above,
                16.0 * EPSILON,
            );
        }
        for (velocity, d) in [
            ("[0, 0, 0]", 1.0),
            ("[0, 0, 0.5]", D_HALF),
            ("[0, 0, -0.99]", 1.0 / D_099),
        ] {
            let exact = 2_897_771.955_185_172_7 / (5800.0 * d);
            let probe = seen_within(
                around(exact, 1.1),
                257,
                velocity,
                "thermal = { temperature = 5800 }",
                "",
            );
            let l = &probe.radiance;
            let top = (0..l.len()).max_by(|&a, &b| l[a].total_cmp(&l[b])).unwrap();
            let vertex = 0.5 * (l[top - 1] - l[top + 1]) / (l[top - 1] - 2.0 * l[top] + l[top + 1]);
            let spacing = (probe.wavelengths[1] / probe.wavelengths[0]).ln();
            let found = probe.wavelengths[top] * (vertex * spacing).exp();
            card.relative(
                &format!("peak of a wall at 5800 K with D = {d:.4}, nm"),
                exact,
                found,
                3e-7,
            );
        }
    }

    /// A reflectance is held in f32 relative to its peak, which is exactly 1 here. Light of a lamp
    /// that moves with the wall: E/π, with π and the product rounded.
    fn c9_reflectance_stays_between_0_and_1_and_white_stays_white(card) {
        let points = [
            (400.0, 0.0),
            (450.0, 0.0),
            (500.0, 1.0),
            (550.0, 0.0),
            (600.0, 0.0),
        ];
        let spline = Cardinal::new(&points, 0.0, Beyond::Hold).unwrap();
        card.near(
            "the spline's lowest, −2/27",
            -2.0 / 27.0,
            spline.unclamped(400.0 + 100.0 / 3.0),
            2.0 * EPSILON,
        );
        card.same("which is held", 0.0, spline.at(400.0 + 100.0 / 3.0));
        // Between two points at 1 and next to two at 0 the spline rises to 1.125.
        let paint = "diffuse = { spectrum = { \
                     points = [[450, 0], [500, 0], [550, 1], [600, 1], [650, 0], [700, 0]] } }";
        let sun = "[[light]]\nkind = \"sun\"\ndirection = [0, 0, -1]\nspectrum = 1.0\n";
        for spectra in ["grid", "spline"] {
            let rest =
                format!("[accuracy]\nspectra = \"{spectra}\"\n{sun}scale = 3.141592653589793\n");
            let lit = seen("[0, 0, 0]", paint, &rest).radiance;
            let [least, most] = [f64::min, f64::max]
                .map(|f: fn(f64, f64) -> f64| lit.iter().copied().fold(lit[0], f));
            card.same(
                &format!("least reflectance of such a wall, held as \"{spectra}\""),
                0.0,
                least,
            );
            card.near("and the greatest", 1.0, most, 2.0 * EPSILON);
        }
        let white = |velocity: &str| {
            let shared = wall(velocity, "diffuse = { spectrum = 1.0 }", sun)
                .replace("[camera]\n", "[camera]\nworldline = \"fast\"\n");
            let set = Set::new(&format!("{shared}worldline = \"fast\"\nscale = 1\n"));
            (set.probe([0, 0]).radiance, set.film().xyz)
        };
        let (at_rest, filmed) = white("[0, 0, 0]");
        card.at_most(
            "E/π of a white wall, at every wavelength",
            worst(&at_rest, |_| std::f64::consts::FRAC_1_PI),
            2.0 * EPSILON,
        );
        for velocity in [
            "[0, 0, 0.5]",
            "[0.3, -0.6, 0.2]",
            "{ gamma = 1e4, direction = [1, 2, 3] }",
            "{ gamma = 1e8, direction = [0, 0, -1] }",
        ] {
            let same = white(velocity) == (at_rest.clone(), filmed.clone());
            card.holds(&format!("to the bit so where all move at {velocity}"), same);
        }
        // Seen from rest, the wall and its sun move: D⁵ of it.
        let rest = format!("{sun}worldline = \"fast\"\nscale = 1\n");
        let passing = seen("[0, 0, 0.5]", "diffuse = { spectrum = 1.0 }", &rest).radiance;
        let exact = D_HALF.powi(5) * std::f64::consts::FRAC_1_PI;
        card.at_most(
            "E D⁵/π where wall and sun approach at 0.5 c",
            worst(&passing, |_| exact),
            FIFTH_POWER + 2.0 * EPSILON,
        );
    }

    /// D = e^(±η), η = ln 1e6, so that visible light comes from 0.4 m or 0.4 pm to 0.8 m or 0.8 pm:
    /// the curves' declared ends. Rounding of η and its exponential, 2η ε, counts five times.
    fn c10_shifts_beyond_the_table_read_its_declared_ends(card) {
        let velocity =
            |sign: i32| format!("{{ rapidity = 13.815510557964274, direction = [0, 0, {sign}] }}");
        let bound = BAKED + 10.0 * 14.0 * EPSILON;
        for spectra in ["grid", "spline"] {
            let rest = format!("[accuracy]\nspectra = \"{spectra}\"\n");
            let ends = |beyond: &str, sign: i32| {
                let paint = format!(
                    "emission = {{ spectrum = {{ \
                     points = [[400, 0.25], [550, 0.1], [700, 0.75]], beyond = \"{beyond}\" }} }}"
                );
                seen(&velocity(sign), &paint, &rest).radiance
            };
            card.at_most(
                &format!("D = 1e6, a curve that holds, \"{spectra}\": 0.75 D⁵"),
                worst(&ends("hold", 1), |_| 0.75e30),
                bound,
            );
            card.at_most(
                "D = 1e-6: 0.25 D⁵",
                worst(&ends("hold", -1), |_| 0.25e-30),
                bound,
            );
            let dark = [1, -1]
                .iter()
                .all(|&sign| ends("zero", sign).iter().all(|l| *l == 0.0));
            card.holds("a curve that ends is 0 at both", dark);
        }
        let curves = [
            "\"D65\"",
            "\"A\"",
            "{ rgb = [0.8, 0.1, 0.1] }",
            "{ rgb = [0.8, 0.1, 0.1], beyond = \"zero\" }",
            "{ gaussian = { center = 589, width = 5 } }",
            "{ blackbody = 5800 }",
            "{ blackbody = 30 }",
            "1.0",
        ];
        let sane = |curve: &&str| {
            [1, -1].iter().all(|&sign| {
                let set = Set::new(&wall(
                    &velocity(sign),
                    &format!("emission = {{ spectrum = {curve} }}"),
                    "",
                ));
                let film = set.film();
                let values = film.xyz.as_flattened().iter().map(|v| f64::from(*v));
                set.probe([0, 0])
                    .radiance
                    .into_iter()
                    .chain(values)
                    .all(|v| v.is_finite() && v >= 0.0)
            })
        };
        card.holds(
            "illuminants, colours, lines and black bodies: finite and not negative",
            curves.iter().all(sane),
        );
    }

    /// Halves are exact, down to the least f64.
    fn c11_stacked_filters_multiply(card) {
        let points = [(400.0, 0.5), (500.0, 0.5), (510.0, 0.5)];
        let filters = [
            Spectrum::Constant(0.5),
            Spectrum::Cardinal(Cardinal::new(&points, 0.0, Beyond::Hold).unwrap()),
        ];
        for (filter, name) in filters.iter().zip(["constant", "spline"]) {
            let through = |count: i32| {
                (0..count).fold(1.0, |light, i| light * filter.at(300.0 + f64::from(i)))
            };
            let exact =
                (0..=1074).all(|count| through(count).to_bits() == 0.5_f64.powi(count).to_bits());
            card.holds(&format!("0.5ⁿ to the bit, n to 1074, of a {name}"), exact);
            card.same("n = 1075, below the least f64", 0.0, through(1075));
        }
        let sun = "[[light]]\nkind = \"sun\"\ndirection = [0, 0, -1]\n\
                   scale = 3.141592653589793\nspectrum = 0.5\n";
        let lit = seen(
            "[0, 0, 0]",
            "diffuse = { weight = 0.5, spectrum = 0.5 }",
            sun,
        )
        .radiance;
        card.at_most(
            "a lamp, a weight and a paint of a half each: 1/8",
            worst(&lit, |_| 0.125),
            2.0 * EPSILON,
        );
    }

    /// D = 2e8: D⁵ = 3.2e41 is beyond f32. There is no channel of 16-bit floats that would end at
    /// 65504: the EXR's are all of 32 bits, the PNG's bytes end at white.
    fn c12_what_no_file_can_hold_is_clamped_and_counted(card) {
        let fast = |sign: i32| format!("{{ gamma = 1e8, direction = [0, 0, {sign}] }}");
        let paint = "emission = { spectrum = 1.0 }";
        let set = Set::new(&wall(&fast(1), paint, ""));
        let probe = set.probe([0, 0]);
        card.at_most(
            "spectral radiance against D⁵ = 3.2e41",
            worst(&probe.radiance, |_| 3.2e41),
            FIFTH_POWER,
        );
        let film = set.film();
        let files = Files::of(&film);
        card.near(
            "values beyond f32 that were counted: X, Y, Z",
            3.0,
            files.saturated as f64,
            0.0,
        );
        card.holds(
            "no NaN on the film",
            film.xyz.as_flattened().iter().all(|v| !v.is_nan()),
        );
        card.holds(
            "the EXR read back is finite, and what was developed",
            files.exr_is_finite_and_true(),
        );
        let brightest = files
            .linear
            .as_flattened()
            .iter()
            .fold(0f32, |m, v| m.max(*v));
        card.holds(
            "at the end of f32, over 100 cd/m²",
            brightest > 0.99 * f32::MAX / 100.0,
        );
        card.holds("the PNG read back is white", files.rgb8 == [255; 3]);
        let away = Set::new(&wall(&fast(-1), paint, "")).film();
        let files = Files::of(&away);
        card.holds(
            "receding, D = 5e-9: finite, nothing to clamp",
            files.saturated == 0 && files.exr_is_finite_and_true(),
        );
        let doppler = film.layers.doppler.unwrap()[0];
        card.relative(
            "D as the EXR's layer has it",
            2e8,
            f64::from(doppler),
            f64::from(f32::EPSILON),
        );
    }

    /// A black body is as bright at its limb as in its middle: exactly, as no angle is looked at.
    fn c13_a_black_ball_is_an_even_disc(card) {
        let set = Set::new(
            "[image]\nsize = [48, 48]\nsamples = 1\n[[model]]\nfile = \"ball.obj\"\nmaterial = \"paint\"\n\
             [material.paint]\nthermal = { temperature = 5800 }\n\
             [camera]\nposition = [0, 0, 4]\nhfov = 32\n[sensor]\nexposure = 0\n",
        );
        let film = set.film();
        let worldline = film.layers.worldline.as_ref().unwrap();
        let disc: Vec<[f32; 3]> = film
            .xyz
            .iter()
            .zip(worldline)
            .filter(|(_, w)| **w >= 0.0)
            .map(|(xyz, _)| *xyz)
            .collect();
        card.holds("half the picture is disc", disc.len() > 48 * 48 / 2);
        let off = disc
            .iter()
            .map(|xyz| (f64::from(xyz[1]) / f64::from(disc[0][1]) - 1.0).abs());
        card.at_most(
            "luminance over the disc of a film, relative",
            off.fold(0.0, f64::max),
            1e-12,
        );
        let middle = set.probe([24, 24]).radiance;
        let limb = (0..48)
            .map(|x| set.probe([x, 24]))
            .filter(|probe| probe.hit.is_some());
        let off = limb.map(|probe| worst(&probe.radiance, |j| middle[j]));
        card.at_most(
            "spectral radiance from limb to limb, relative",
            off.fold(0.0, f64::max),
            1e-12,
        );
    }
}
