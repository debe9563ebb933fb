//! D. Geometry and visibility.

use crate::scene::Set;

cases! {
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
