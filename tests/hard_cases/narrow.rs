//! C. Lines and filters narrower than the sensor's wavelengths are apart.

use super::scene::Set;
use restframe::color::cie::{EFFICACY, xyz_bar};
use restframe::spectrum::illuminant;
use std::f64::consts::PI;

/// Standard deviations as seen, nm.
const WIDTHS_NM: [f64; 6] = [0.01, 0.1, 0.5, 1.0, 3.0, 10.0];

const DOPPLERS: [f64; 5] = [0.1, 0.5, 1.0, 2.0, 10.0];

/// Where lines are seen: between two of the 84 wavelengths, where the eye's weight is steep, and on
/// the longest that is seen at all well.
const SEEN_NM: [f64; 3] = [487.1, 560.0, 640.3];

/// What is promised is 1e-2. Straight lines between nodes 0.17 nm apart leave 4e-5 of the eye's
/// weight at its steepest, f32 sums 1e-6; a wide line, of which the grid itself takes care, 1e-4.
const BOUND: f64 = 2e-4;

/// ∫ of 683 ȳ times a curve over ±12 widths about a wavelength, by 24000 trapezoids.
fn luminance(center_nm: f64, width_nm: f64, curve: impl Fn(f64) -> f64) -> f64 {
    let step = width_nm / 1000.0;
    let terms = (-12_000..=12_000).map(|i| {
        let nm = center_nm + f64::from(i) * step;
        EFFICACY * xyz_bar(nm)[1] * curve(nm)
    });
    step * terms.sum::<f64>()
}

fn bell(nm: f64, center_nm: f64, width_nm: f64) -> f64 {
    (-0.5 * ((nm - center_nm) / width_nm).powi(2)).exp()
}

/// Y of a wall that comes nearer under D, or goes away, of a material and with what else there is.
fn luminance_of(doppler: f64, material: &str, rest: &str) -> f64 {
    let rapidity = f64::ln(doppler);
    let text = format!(
        "[image]\nsize = [1, 1]\nsamples = 1\n\
         [worldline.fast]\nvelocity = {{ rapidity = {:?}, direction = [0, 0, {:?}] }}\n\
         [[model]]\nfile = \"wall.obj\"\nworldline = \"fast\"\nmaterial = \"paint\"\n\
         translate = [0.3, 0.2, 0]\n\
         [material.paint]\n{material}\n\
         [camera]\nposition = [0, 0, 3]\n\
         [sensor]\nexposure = 0\n{rest}",
        rapidity.abs(),
        1f64.copysign(rapidity),
    );
    Set::new(&text).probe([0, 0]).xyz[1]
}

fn sun(worldline: &str, amount: &str, spectrum: &str) -> String {
    format!(
        "[[light]]\nkind = \"sun\"\nworldline = \"{worldline}\"\ndirection = [0, 0, -1]\n\
         {amount}\nspectrum = {spectrum}\n"
    )
}

fn gaussian(center_nm: f64, width_nm: f64) -> String {
    format!("{{ gaussian = {{ center = {center_nm:?}, width = {width_nm:?} }} }}")
}

cases! {
    fn c15_lines_of_any_width_keep_their_luminance(card) {
        for width in WIDTHS_NM {
            for (i, doppler) in DOPPLERS.into_iter().enumerate() {
                let seen = SEEN_NM[i % SEEN_NM.len()];
                let spectrum = gaussian(seen * doppler, width * doppler);
                let material = format!("emission = {{ scale = 1.0, spectrum = {spectrum} }}");
                let exact = luminance(seen, width, |nm| bell(nm, seen, width)) * doppler.powi(5);
                let what = format!("Y of σ = {width} nm seen at {seen} nm, D = {doppler}, cd/m2");
                card.relative(&what, exact, luminance_of(doppler, &material, ""), BOUND);
            }
        }
    }

    fn c15_a_lamp_of_one_line_lights_with_the_lux_it_is_given(card) {
        for width in [0.001, 0.01, 0.1, 1.0, 3.0] {
            let lamp = sun("fast", "intensity = 100", &gaussian(589.3, width));
            let white = "diffuse = { spectrum = 1.0 }";
            let what = format!("white under 100 lx of σ = {width} nm, cd/m2");
            card.relative(&what, 100.0 / PI, luminance_of(1.0, white, &lamp), BOUND);
        }
    }

    fn c15_a_narrow_filter_takes_its_share_of_daylight_that_moves_against_it(card) {
        let d65 = illuminant("D65").unwrap();
        for width in [0.01, 0.1, 1.0, 3.0] {
            for doppler in [0.7, 1.0, 1.4] {
                let seen = 560.0;
                let filter = gaussian(seen * doppler, width * doppler);
                let material = format!("diffuse = {{ spectrum = {filter} }}");
                let lamp = sun("lab", "scale = 1.0", "\"D65\"");
                // The wall meets the lamp's light as fast as its own light meets the camera.
                let lit = |nm: f64| d65.at(nm * doppler * doppler) * bell(nm, seen, width);
                let exact = luminance(seen, width, lit) * doppler.powi(8) / PI;
                let what = format!("Y of σ = {width} nm under D65, D = {doppler} twice, cd/m2");
                card.relative(&what, exact, luminance_of(doppler, &material, &lamp), 1e-3);
            }
        }
    }

    fn c15_a_line_on_a_narrow_filter_is_the_integral_of_both(card) {
        for (line, filter, apart) in [(0.01, 0.5, 0.3), (0.5, 0.5, 1.0), (0.2, 0.01, 0.1), (2.0, 1.0, 3.0)] {
            for worldline in ["fast", "lab"] {
                let doppler = 1.2;
                let lamp_doppler: f64 = if worldline == "fast" { 1.0 } else { doppler };
                let seen = 560.0;
                let material = format!(
                    "diffuse = {{ spectrum = {} }}",
                    gaussian(seen * doppler, filter * doppler)
                );
                let shift = doppler * lamp_doppler;
                let spectrum = gaussian((seen + apart) * shift, line * shift);
                let lamp = sun(worldline, "scale = 1.0", &spectrum);
                let both = |nm: f64| bell(nm, seen, filter) * bell(nm, seen + apart, line);
                let exact = luminance(seen, filter.max(line), both) * doppler.powi(5) * lamp_doppler.powi(3) / PI;
                let what = format!("Y of σ = {line} nm on {filter} nm, {apart} nm apart, lamp in {worldline}");
                card.relative(&what, exact, luminance_of(doppler, &material, &lamp), BOUND);
            }
        }
    }
}
