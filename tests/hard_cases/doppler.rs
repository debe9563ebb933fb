//! B. Doppler factor and aberration.

use crate::scene::Set;
use std::f64::consts::{PI, TAU};

cases! {
    /// On a rendered panorama, from within a box at rest in the lab: once with the motion along
    /// the axis, once obliquely, with the brightest of the sky on the seam.
    fn b9_mean_powers_of_d_over_the_sky(card) {
        const ROWS: u32 = 128;
        let oblique = [0.0, 0.5, 0.75_f64.sqrt()];
        for (beta, fourth) in [(0.5_f64, 13.0 / 9.0), (0.99, 66.66834170854)] {
            let lorentz_factor = 1.0 / ((1.0 - beta) * (1.0 + beta)).sqrt();
            for (way, direction) in [("ahead", [0.0, 0.0, -1.0]), ("obliquely", oblique)] {
                let doppler = panorama_doppler(direction.map(|v| v * beta), ROWS);
                card.holds(&format!("{beta} c {way}: nothing is left out"), doppler.iter().all(|d| *d > 0.0));
                for (power, exact) in [(2, 1.0), (3, lorentz_factor), (4, fourth)] {
                    let got = sky_mean(&doppler, ROWS, power);
                    // D at the poles, where the sky in the direction n has 1/(γ(1 − β·n)).
                    let poles = [1.0, -1.0].map(|up| {
                        (lorentz_factor * (1.0 - up * beta * direction[1])).powi(-power)
                    });
                    let bound = quadrature_error(poles, exact, ROWS) + f64::from(power) * exact * FILM;
                    card.near(&format!("{beta} c {way}: mean of D^{power}"), exact, got, bound);
                }
            }
        }
    }
}

/// Rounding of a film's number, relative.
const FILM: f64 = 0.5 * f32::EPSILON as f64;

/// D at the centres of a panorama's pixels, twice as many columns as `rows`.
fn panorama_doppler(beta: [f64; 3], rows: u32) -> Vec<f64> {
    let set = Set::new(&format!(
        "[image]\nsize = [{}, {rows}]\nsamples = 1\n\
         [worldline.ship]\nvelocity = {beta:?}\n\
         [[model]]\nfile = \"box.obj\"\nscale = 1000\nmaterial = \"m\"\n\
         [material.m]\ndiffuse = {{ weight = 0.5, spectrum = 1.0 }}\n\
         [camera]\nworldline = \"ship\"\nprojection = \"equirectangular\"\n",
        2 * rows
    ));
    let layer = set.film().layers.doppler.unwrap();
    layer.into_iter().map(f64::from).collect()
}

/// The mean over the sphere of a power of what a panorama's pixels hold, by their solid angles.
fn sky_mean(pixels: &[f64], rows: u32, power: i32) -> f64 {
    let columns = pixels.len() / rows as usize;
    let pitch = |row: usize| PI / 2.0 - row as f64 * PI / f64::from(rows);
    let row_sum = |(row, values): (usize, &[f64])| {
        let solid_angle = (pitch(row).sin() - pitch(row + 1).sin()) * TAU / columns as f64;
        values.iter().map(|d| d.powi(power)).sum::<f64>() * solid_angle
    };
    pixels.chunks(columns).enumerate().map(row_sum).sum::<f64>() / (4.0 * PI)
}

/// Bound of the error of [`sky_mean`] for the mean M of a function f that is smooth on the sphere.
///
/// Along a row the pixels are the trapezoidal rule of a periodic function. Down the rows, h apart,
/// their solid angles are cos θ times 2 sin(h/2), that is, they are the midpoint rule of
/// G = F cos θ times 1 − h²/24 + …, where F is the mean of f along a row. By Euler and Maclaurin
/// that rule is off by −h²/24 [G′] + O(h⁴) from pole to pole, and G′ there is −F(N) and F(S). Half
/// of that (the sphere has 4π) and the factor's own −h²/24 M leave h²/48 (F(N) + F(S) − 2M). What
/// neither expansion has is of the order of exp(−2π a/h), where a = arcosh(1/β) is how far D's
/// pole is from the sphere: at 0.99 c and 128 rows 1e-16.
fn quadrature_error(poles: [f64; 2], mean: f64, rows: u32) -> f64 {
    const HIGHER_ORDERS: f64 = 1.1;
    let h = PI / f64::from(rows);
    HIGHER_ORDERS * h * h / 48.0 * (poles[0] + poles[1] - 2.0 * mean).abs()
}
