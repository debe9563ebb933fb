//! D. Geometry: where and when moving things are seen. What hides what is in `visibility`.

use super::eye::{Dice, Eye, Met, across, inner_radius, sphere};
use super::scene::Set;
use glam::DVec3;
use restframe::probe::ProbeHit;
use restframe::relativity::{Boost, Celerity, Event, FourVector, light_arriving};

/// One pixel, looking straight ahead, and what bodies are made of.
const HEAD: &str = "[image]\nsize = [1, 1]\n[sensor]\nexposure = 0\n\
    [material.paint]\nemission = { scale = 1.0, spectrum = 1.0 }\n";

/// What stands straight ahead of a camera.
fn ahead(text: &str) -> Option<ProbeHit> {
    Set::new(&format!("{HEAD}{text}")).probe([0, 0]).hit
}

/// A four-vector in a frame in which its own moves at celerity u: t = γt′ + u·x′,
/// x = x′ + u((u·x′)/(γ+1) + t′), as the textbooks have it.
fn moving(u: Celerity, v: FourVector) -> FourVector {
    let (lorentz_factor, u) = (u.lorentz_factor(), u.vector());
    let along = u.dot(v.x);
    FourVector::new(
        lorentz_factor * v.t + along,
        v.x + u * (along / (lorentz_factor + 1.0) + v.t),
    )
}

cases! {
    /// A resting sphere of angular radius ρ about c is grazed by the past-pointing k = (−1, n) with
    /// n·c = cos ρ, that is k·S = 0 with S = (−cos ρ, c). So, seen moving, n·S_x + S_t = 0.
    fn d1_a_moving_sphere_has_a_circular_outline(card) {
        let c = DVec3::new(0.6, 0.0, 0.8);
        let [e, f] = across(c);
        for lorentz_factor in [1.0 + 1e-12, 2.0, 10.0, 1e3] {
            let u = Celerity::from_lorentz_factor(lorentz_factor, DVec3::new(1.0, 2.0, -2.0)).unwrap();
            let to_camera = Boost::into_rest_of(u.reversed());
            let mut worst = 0.0_f64;
            for rho in [0.01, 0.5, 1.5, 3.0_f64] {
                let s = moving(u, FourVector::new(-rho.cos(), c));
                for i in 0..360 {
                    let (sin, cos) = f64::from(i).to_radians().sin_cos();
                    let n = c * rho.cos() + (e * cos + f * sin) * rho.sin();
                    let seen = -to_camera.light(-n).direction;
                    worst = worst.max((seen.dot(s.x) + s.t).abs() / s.x.length());
                }
            }
            card.at_most(&format!("off the circle at γ = {lorentz_factor}"), worst, 1e-12);
        }
        let set = Set::with(&[("round.obj", &sphere(96, 192))], &format!(
            "{HEAD}[worldline.fast]\nvelocity = {{ gamma = 3, direction = [1, 0.3, 0.4] }}\n\
             [[model]]\nfile = \"round.obj\"\nmaterial = \"paint\"\nworldline = \"fast\"\n\
             [camera]\nposition = [1, 2, 5]\n"
        ));
        outline_of_a_mesh(card, &Eye::new(&set));
    }

    /// Coordinates are up to 100: 1e-12 is 50 roundings of them, on the shorter rod.
    fn d2_rods_along_and_across_the_line_of_sight(card) {
        let end = |z: f64, velocity: f64| ahead(&format!(
            "[worldline.rod]\nvelocity = [0, 0, {velocity}]\n[[model]]\nfile = \"wall.obj\"\n\
             material = \"paint\"\nworldline = \"rod\"\ntranslate = [0, 0, {z}]\n\
             [camera]\nposition = [0.3, 0.1, 10]\n"
        )).unwrap().event.x[2];
        for (way, velocity, exact) in [("approaching", 0.8, 3.0), ("receding", -0.8, 1.0 / 3.0)] {
            let length = (end(0.0, velocity) - end(-2.0, velocity)) / 2.0;
            card.relative(&format!("rod {way} at 0.8 c, in its own length"), exact, length, 1e-12);
        }
        // A cube of edge 2, seen at 90 degrees to its motion from 1e6 away: its back shows by
        // sin α = β, its front by cos α = 1/γ. The two are 1e-6 of the distance, so as much off
        // parallel light.
        const PARALLEL: f64 = 4e-6;
        let set = Set::new(&format!(
            "{HEAD}[worldline.cube]\nvelocity = [0.8, 0, 0]\nat = -1e6\n[[model]]\nfile = \"box.obj\"\n\
             material = \"paint\"\nworldline = \"cube\"\n[camera]\nposition = [0, 0, 1000000]\n"
        ));
        let eye = Eye::new(&set);
        let towards = |x: f64| DVec3::new(x * 1e-6, 0.0, -1.0);
        let front = |met: &Met| {
            let point = eye.scene.geometry.surface_point(met.hit.instance, met.hit.triangle, met.hit.weights);
            point.flat_normal.z > 0.5
        };
        let x = |(direction, _): (DVec3, Met)| -direction.x / direction.z * 1e6;
        let right = x(eye.border([towards(0.0), towards(9.0)], |_| true));
        let left = x(eye.border([towards(0.0), towards(-9.0)], |_| true));
        let middle = x(eye.border([towards(0.8), towards(left + 1e-3)], front));
        card.relative("length of the front at 0.8 c, L/γ", 1.2, right - middle, PARALLEL);
        let angle = (middle - left).atan2(right - middle);
        card.near("sine of the cube's rotation", 0.8, angle.sin(), PARALLEL);
    }

    /// 0.2 m apart in time the edge has moved 1.4 m of 1e5: its apparent speed along x changes by
    /// 7 times the angle, to first order alike before and after, (5e-5)² to the second.
    fn d3_apparent_speed_exceeds_light(card) {
        let sine = (1.0 - 0.99_f64 * 0.99).sqrt();
        let set = Set::new(&format!(
            "{HEAD}[shot]\nframes = 2\ntime = {{ from = -0.1, to = 0.1 }}\n[worldline.jet]\n\
             velocity = [{:?}, 0, {:?}]\nat = -1e5\n[[model]]\nfile = \"wall.obj\"\nmaterial = \"paint\"\n\
             worldline = \"jet\"\ntranslate = [-1, 0, 0]\n[camera]\nposition = [0, 0, 100000]\n",
            0.99 * sine, 0.99 * 0.99
        ));
        let edge = |frame: u32| {
            let eye = Eye::in_frame(&set, frame);
            let event = eye.view().spacetime().camera_event(1);
            // From what is surely on the wall, a tenth of its width inside of the edge.
            let seen = light_arriving(event, DVec3::new(-0.2, 0.0, 0.0)).unwrap();
            let inside = -eye.view().spacetime().link(0, 1).light(seen.direction).direction;
            let (direction, met) = eye.border([inside, DVec3::new(1e-3, 0.0, -1.0)], |_| true);
            direction.x * met.s
        };
        let speed = (edge(2) - edge(1)) / 0.2;
        card.relative("γβ at cos = β = 0.99", 7.0179239276, speed, 1e-8);
    }

    /// −r/(1−β) = −rγ(γ+u) and −r/(1+β) = −rγ/(γ+u), in which nothing cancels.
    fn d4_retarded_times_of_constant_velocity(card) {
        let seen = |velocity: &str| ahead(&format!(
            "[worldline.fast]\nvelocity = {velocity}\npasses = [0, 0, -3]\n[[model]]\nfile = \"wall.obj\"\n\
             material = \"paint\"\nworldline = \"fast\"\n[camera]\nposition = [0, 0, 0]\n"
        )).unwrap().event.t;
        card.relative("approaching at 0.99 c", -3.0 / (1.0 - 0.99), seen("[0, 0, 0.99]"), 1e-14);
        card.relative("receding at 0.99 c", -3.0 / (1.0 + 0.99), seen("[0, 0, -0.99]"), 1e-14);
        for lorentz_factor in [1.0 + 1e-12, 2.0, 10.0, 1e3, 1e6, 1e8_f64] {
            let u = ((lorentz_factor - 1.0) * (lorentz_factor + 1.0)).sqrt();
            let along = |z: i32| format!("{{ gamma = {lorentz_factor:?}, direction = [0, 0, {z}] }}");
            let exact = -3.0 * lorentz_factor * (lorentz_factor + u);
            card.relative(&format!("approaching at γ = {lorentz_factor}"), exact, seen(&along(1)), 1e-14);
            let exact = -3.0 * lorentz_factor / (lorentz_factor + u);
            card.relative(&format!("receding at γ = {lorentz_factor}"), exact, seen(&along(-1)), 1e-14);
        }
    }

    /// The event found is on the past cone to two roundings of the times that it is a difference of.
    fn d5_there_is_one_retarded_event(card) {
        let mut dice = Dice(5);
        let (mut found, mut off) = (0, 0.0_f64);
        for _ in 0..100_000 {
            let u = Celerity::from_lorentz_factor(10f64.powf(6.0 * dice.unit()), dice.direction()).unwrap();
            let event = Boost::into_rest_of(u).event(Event::new(dice.signed(), dice.point()));
            let arrival = light_arriving(event, dice.point()).unwrap();
            let path = event - arrival.emission;
            let size = event.t.abs().max(arrival.distance);
            found += u32::from(path.t > 0.0);
            off = off.max((path.t - path.x.length()).abs() / size);
        }
        card.same("retarded events of 1e5 moving points", 1e5, f64::from(found));
        card.at_most("off the past cone, relative", off, 4.0 * f64::EPSILON);
        let here = Event::new(2.0, DVec3::new(0.1, -0.3, 0.7));
        card.holds("none is seen of a point at the observer", light_arriving(here, here.x).is_none());
        let near = light_arriving(here, here.x + DVec3::X * 1e-17 + DVec3::Z * f64::EPSILON).unwrap();
        card.near("t_r next to the observer", here.t, near.emission.t, f64::EPSILON);
        for lorentz_factor in [1.0, 10.0, 1e3] {
            let wall = |z: f64| ahead(&format!(
                "[worldline.fast]\nvelocity = {{ gamma = {lorentz_factor}, direction = [0, 0, 1] }}\n[[model]]\n\
                 file = \"wall.obj\"\nmaterial = \"paint\"\nworldline = \"fast\"\n[camera]\nposition = [0.3, 0.2, {z:?}]\n"
            ));
            card.holds(&format!("a wall that passes the camera is unseen, γ = {lorentz_factor}"), wall(0.0).is_none());
            let u = ((lorentz_factor - 1.0) * (lorentz_factor + 1.0_f64)).sqrt();
            let exact = 1e-9 * lorentz_factor * (lorentz_factor + u);
            let distance = wall(1e-9).unwrap().distance;
            card.relative(&format!("and seen from 1e-9 before it, γ = {lorentz_factor}"), exact, distance, 1e-14);
        }
    }

    /// What is R/d is seen where the equator of the mesh has a vertex, exactly on the sphere: the
    /// line of sight is along the mesh's axis, in its rest frame. R/d is the tangent there, and the
    /// angle of a circle; they differ by (R/d)² at rest. The rest frame's distance is as uncertain
    /// as the camera's place is there: γ·ε·d, of a distance that is down to d/(2γ).
    fn d11_a_distant_sphere_keeps_its_size(card) {
        let round = sphere(8, 16);
        for lorentz_factor in [1.0, 2.0, 100.0_f64] {
            let beta = (1.0 - 1.0 / (lorentz_factor * lorentz_factor)).sqrt();
            // Towards the camera, in the rest frame of what moves across: (−β, 0, 1/γ).
            let turn = (-beta).atan2(1.0 / lorentz_factor).to_degrees();
            for (way, direction, turn) in [
                ("approaching", "[0, 0, 1]", 0.0), ("receding", "[0, 0, -1]", 0.0), ("across", "[1, 0, 0]", turn),
            ] {
                let set = Set::with(&[("round.obj", &round)], &format!(
                    "{HEAD}[worldline.fast]\nvelocity = {{ gamma = {lorentz_factor}, direction = {direction} }}\n\
                     at = -1e7\n[[model]]\nfile = \"round.obj\"\nmaterial = \"paint\"\nworldline = \"fast\"\n\
                     rotate = [0, {turn:?}, 0]\n[camera]\nposition = [0, 0, 10000000]\n"
                ));
                let eye = Eye::new(&set);
                let worst = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y].map(|side| {
                    let outside = DVec3::NEG_Z + side * 3e-7;
                    let (edge, _) = eye.border([DVec3::NEG_Z, outside], |_| true);
                    (edge.dot(side) / -edge.z * 1e7 - 1.0).abs()
                });
                let worst = worst.into_iter().fold(0.0, f64::max);
                card.at_most(&format!("radius of a sphere {way}, 1e7 off, γ = {lorentz_factor}"), worst, 1e-6);
            }
        }
    }
}

/// A mesh's outline stands between the circles of the spheres that it encloses and is enclosed by.
fn outline_of_a_mesh(card: &mut super::card::Card, eye: &Eye<'_>) {
    let (u, event) = (
        eye.scene.worldlines[1].celerity,
        eye.view().spacetime().camera_event(1),
    );
    let (c, distance) = (-event.x.normalize(), event.x.length());
    // k·C/k·T is the cosine of the angle to c in the rest frame, whichever frame k = (−1, n) is
    // given in.
    let (middle, rest) = (
        moving(u, FourVector::new(0.0, c)),
        moving(u, FourVector::new(1.0, DVec3::ZERO)),
    );
    let towards = -eye.view().spacetime().link(0, 1).light(-c).direction;
    let [e, f] = across(towards);
    let inner = (inner_radius(&eye.scene.geometry.meshes[0]) / distance).asin();
    let outer = (1.0 / distance).asin();
    let mut worst = 0.0_f64;
    for i in 0..48 {
        let (sin, cos) = (f64::from(i) * 7.5).to_radians().sin_cos();
        let (n, _) = eye.border([towards, e * cos + f * sin], |_| true);
        let rho = ((n.dot(middle.x) + middle.t) / (n.dot(rest.x) + rest.t)).acos();
        worst = worst.max((inner - rho).max(rho - outer) / outer);
    }
    let what = format!(
        "outline of a mesh at γ = 3, off the ring between those circles, {:.0e} wide",
        outer / inner - 1.0
    );
    // The rounding of acos at small angles.
    card.at_most(&what, worst.max(0.0), 1e-12);
}
