//! E. Moving lamps.

use super::scene::Set;
use glam::DVec3;
use restframe::relativity::{Event, light_arriving};
use restframe::trace::Spacetime;
use std::f64::consts::PI;

/// Width of the lamps' line, nm.
const WIDTH_NM: f64 = 10.0;
/// The wall's reflectance.
const PAINT: f64 = 0.5;

/// A lamp in the origin of a frame of celerity `u` that is at `passes` at the lab time `at`: the
/// light of it that arrives at an event, from the lab's algebra alone.
struct Passing {
    u: DVec3,
    passes: DVec3,
    at: f64,
}

impl Passing {
    fn lorentz_factor(&self) -> f64 {
        (1.0 + self.u.length_squared()).sqrt()
    }

    /// Unit direction of travel and length of the light path in the lab. With q from the lamp to
    /// the event when it arrives, |q + βr| = r: r = γ(γ β·q + √(γ²(β·q)² + q²)).
    fn light_at(&self, t: f64, x: DVec3) -> (DVec3, f64) {
        let lorentz_factor = self.lorentz_factor();
        let beta = self.u / lorentz_factor;
        let q = x - (self.passes + beta * (t - self.at));
        let along = self.u.dot(q);
        let r = lorentz_factor * (along + (along * along + q.length_squared()).sqrt());
        ((q + beta * r) / r, r)
    }

    /// D from the lamp to a receiver at rest in the lab, for light of direction n.
    fn doppler(&self, n: DVec3) -> f64 {
        1.0 / (self.lorentz_factor() - self.u.dot(n))
    }

    /// A wall at z = 0 in the lab, lit by a line of the lamp at `center_nm`.
    fn lights_a_wall(&self, center_nm: f64, accuracy: &str) -> Set {
        let [u, p] = [self.u, self.passes].map(|v| format!("[{:e}, {:e}, {:e}]", v.x, v.y, v.z));
        let lorentz_factor = self.lorentz_factor();
        Set::new(&format!(
            "[image]\nsize = [5, 5]\n[sensor]\nexposure = 0\n[accuracy]\n{accuracy}\n\
             [worldline.lamp]\nvelocity = {{ gamma = {lorentz_factor:e}, direction = {u} }}\npasses = {p}\nat = {:e}\n\
             [[model]]\nfile = \"wall.obj\"\nscale = 10\nmaterial = \"paint\"\n\
             [material.paint]\ndiffuse = {{ spectrum = {PAINT} }}\n\
             [[light]]\nkind = \"point\"\nworldline = \"lamp\"\nposition = [0, 0, 0]\nscale = 1.0\n\
             spectrum = {{ gaussian = {{ center = {center_nm:e}, width = {WIDTH_NM} }} }}\n\
             [camera]\nposition = [0, 0, 4]\n",
            self.at
        ))
    }
}

fn lamps() -> [(&'static str, Passing); 3] {
    let passing = |u: [f64; 3], passes: [f64; 3], at| Passing {
        u: DVec3::from(u),
        passes: DVec3::from(passes),
        at,
    };
    [
        ("at rest", passing([0.0; 3], [1.0, 2.0, 3.0], 0.0)),
        (
            "crossing at 0.6 c",
            passing([0.75, 0.0, 0.0], [1.0, 0.5, 2.0], -5.0),
        ),
        (
            "coming at γ = 10",
            passing([0.0, 3.0, -9.486_832_980_505_138], [0.0, 0.0, 3.0], -6.0),
        ),
    ]
}

cases! {
    /// Spectral: L = ρ/π · D³ I(Dλ) cos θ / r′², r = D r′. Over all wavelengths one D less, since
    /// the line is narrower by it: E = D² I cos θ / r′² = D⁴ I cos θ / r². Bound of the curve: f32
    /// spectra (6e-8) and r, D at γ = 10. Of the sum: midpoints a fortieth of the line apart.
    fn e1_a_moving_lamp_lights_a_wall_by_the_fourth_power_over_all_wavelengths(card) {
        for (name, lamp) in lamps() {
            let spot = lamp.lights_a_wall(550.0, "").probe([2, 2]).hit.unwrap();
            let (n, r) = lamp.light_at(spot.event.t, DVec3::from(spot.event.x));
            let (doppler, cos) = (lamp.doppler(n), -n.z);
            // Where the camera sees the line in the middle of its window.
            let center_nm = 560.0 * doppler;
            let seen = lamp
                .lights_a_wall(center_nm, "wavelengths = 4096\nspectra = \"spline\"")
                .probe([2, 2]);
            let rest_distance = r / doppler;
            let curve = |nm: f64| {
                let widths = (doppler * nm - center_nm) / WIDTH_NM;
                PAINT / PI * doppler.powi(3) * (-0.5 * widths * widths).exp() * cos
                    / (rest_distance * rest_distance)
            };
            let pairs = || seen.wavelengths.iter().zip(&seen.radiance);
            let worst = pairs().map(|(nm, l)| (l / curve(560.0) - curve(*nm) / curve(560.0)).abs());
            card.at_most(&format!("D³ I(Dλ)/r′², lamp {name}, of the peak"), worst.fold(0.0, f64::max), 1e-6);
            let spacing = (830.0_f64 / 360.0).ln() / 4096.0;
            let total: f64 = pairs().map(|(nm, l)| l * 2.0 * nm * (spacing / 2.0).sinh()).sum();
            let all = WIDTH_NM * (2.0 * PI).sqrt();
            card.relative(
                &format!("irradiance, W/m², lamp {name}"),
                all * doppler.powi(4) * cos / (r * r),
                total * PI / PAINT,
                1e-6,
            );
        }
    }

    /// The direction of light on a wall at rest in the lab, and from where: the program's light cone
    /// in the lamp's frame against the quadratic in the lab. Bound: that of the row.
    fn e2_a_lamp_stands_on_the_past_cone_of_the_surface_event(card) {
        for (name, lamp) in lamps() {
            let scene = lamp.lights_a_wall(550.0, "").scene();
            let spacetime = Spacetime::new(&scene, true);
            let own = scene.lights[0].worldline;
            assert_eq!(scene.worldlines[own].celerity.lorentz_factor() > 1.0, lamp.u != DVec3::ZERO);
            let (mut worst, mut off) = (0.0_f64, 0.0_f64);
            for (t, x) in [(-4.0, DVec3::ZERO), (0.0, DVec3::new(3.0, -2.0, 0.0)), (7.0, DVec3::new(-1.0, 0.5, 0.0))] {
                let event = spacetime.link(own, 0).event(Event::new(t, x));
                let arrival = light_arriving(event, DVec3::ZERO).unwrap();
                let n = spacetime.link(0, own).light(arrival.direction).direction;
                let emission = spacetime.link(0, own).event(arrival.emission);
                let (exact, r) = lamp.light_at(t, x);
                worst = worst.max((n - exact).length());
                // A terminator's normals are those at right angles to the light.
                let normal = exact.any_orthonormal_vector();
                off = off.max(((emission.x - x) / r).dot(normal).abs());
            }
            card.at_most(&format!("direction of the light, lamp {name}"), worst, 1e-12);
            card.at_most(&format!("terminator's normal · the lamp's direction, {name}"), off, 1e-12);
        }
    }
}
