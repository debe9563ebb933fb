//! B and D. The whole sky at once.

use super::scene::Set;
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

    /// A ball far behind a camera that flies along −z, in a panorama; and the walls of a room
    /// around it, in a perspective view.
    fn d12_what_lies_behind_the_camera_folds_into_its_view(card) {
        const BETA: f64 = 0.99;
        // Of a panorama's column, degrees; its pixel (766, 255) is at +90° exactly.
        const SIZE: [u32; 2] = [1022, 511];
        const COLUMN: f64 = 360.0 / SIZE[0] as f64;
        const RADIUS: f64 = 0.05;
        const FACETS: f64 = 0.005;
        let lorentz_factor = 1.0 / (1.0 - BETA * BETA).sqrt();
        let behind = (-BETA).acos();
        let [x, z] = [10.0 * behind.sin(), -10.0 * behind.cos()];
        let ball = Set::new(&ship(&format!(
            "[image]\nsize = {SIZE:?}\nsamples = 1\n\
             [[model]]\nfile = \"ball.obj\"\nmaterial = \"m\"\nscale = {RADIUS}\ntranslate = [{x}, 0, {z}]\n"
        ), "projection = \"equirectangular\""));
        let hit = ball.probe([766, 255]).hit.unwrap();
        card.near("seen at 90°: degrees from the motion", 171.8903855, from_motion(hit.event.x), 1e-7);
        card.relative("D there, 1/γ", 1.0 / lorentz_factor, hit.doppler, 1e-12);
        // Its outline is a cone about the lab's direction, of which both sides aberrate.
        let half = (RADIUS / 10.0).asin();
        let columns = seen_in_row(&ball, 255);
        for (side, edge, found) in [
            ("first", behind - half, columns[0]),
            ("last", behind + half, columns[columns.len() - 1]),
        ] {
            let exact = appears_at(edge, BETA).to_degrees();
            let got = (f64::from(found) + 0.5) * COLUMN - 180.0;
            // Columns see it whose centres lie in it, and its facets lie within the sphere.
            let bound = COLUMN + FACETS * (exact - 90.0).abs();
            card.near(&format!("{side} column that sees the ball, degrees"), exact, got, bound);
        }
        let room = Set::new(&ship(
            "[image]\nsize = [101, 51]\nsamples = 1\n\
             [[model]]\nfile = \"box.obj\"\nmaterial = \"m\"\nscale = 10\n",
            "hfov = 90",
        ));
        let hit = room.probe([100, 25]).hit.unwrap();
        // tan of its angle is 100/101; the lab's by tan(θ/2) times e^η.
        let angle = 2.0 * (((1.0 + BETA) / (1.0 - BETA)).sqrt() * ((100.0_f64 / 101.0).atan() / 2.0).tan()).atan();
        card.near("last column of a 90° view: degrees from the motion", angle.to_degrees(), from_motion(hit.event.x), 1e-9);
        // In the lab 90° is where D = γ, and cos = β in the picture: 7.2 columns from its middle.
        let doppler = room.film().layers.doppler.unwrap();
        let past = doppler[25 * 101..26 * 101].iter().filter(|d| f64::from(**d) < lorentz_factor);
        card.same("of its 101 columns, those that see what is behind", 86.0, past.count() as f64);
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

/// A camera that flies along −z at 0.99 c, and what else is in the shot.
fn ship(rest: &str, camera: &str) -> String {
    format!(
        "{rest}[worldline.ship]\nvelocity = [0, 0, -0.99]\n\
         [material.m]\ndiffuse = {{ weight = 0.5, spectrum = 1.0 }}\n\
         [camera]\nworldline = \"ship\"\n{camera}\n"
    )
}

/// The angle in degrees between −z and a place in the lab, seen from the lab's origin.
fn from_motion([x, y, z]: [f64; 3]) -> f64 {
    x.hypot(y).atan2(-z).to_degrees()
}

/// Where the camera has what is at an angle from its motion in the lab: tan(θ/2) is e^−η times
/// the lab's (Penrose 1959).
fn appears_at(angle: f64, beta: f64) -> f64 {
    2.0 * (((1.0 - beta) / (1.0 + beta)).sqrt() * (angle / 2.0).tan()).atan()
}

/// The columns of a row that see a surface.
fn seen_in_row(set: &Set, row: u32) -> Vec<u32> {
    let film = set.film();
    let doppler = film.layers.doppler.unwrap();
    let of = |x: u32| doppler[(row * film.width + x) as usize];
    (0..film.width).filter(|x| of(*x) > 0.0).collect()
}
