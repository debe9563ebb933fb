//! D. Visibility: what hides what, and that nothing is missed.

use super::eye::{Dice, Eye, Met, across, inner_radius, plane, sphere, triangles};
use super::scene::Set;
use glam::DVec3;
use rayon::prelude::*;
use restframe::accel::{Hit, Ray};
use restframe::relativity::Event;
use restframe::scene::Scene;
use restframe::trace::{Spacetime, boost_directions, build_aggregate};

/// One pixel, and what bodies are made of.
const HEAD: &str = "[image]\nsize = [1, 1]\n[sensor]\nexposure = 0\n\
    [material.paint]\nemission = { scale = 1.0, spectrum = 1.0 }\n";

/// A body at γ = `lorentz_factor` that holds the camera at (0.3, 0.1, −0.2) of it, or at its centre.
fn around_the_camera(file: &str, lorentz_factor: f64, centered: bool) -> Set {
    let place = if centered {
        "[0, 0, 0]"
    } else {
        "[-0.3, -0.1, 0.2]"
    };
    Set::with(
        &[("round.obj", &sphere(12, 24))],
        &format!(
            "{HEAD}[worldline.fast]\nvelocity = {{ gamma = {lorentz_factor}, direction = [1, 2, 3] }}\n\
         [[model]]\nfile = \"{file}\"\nmaterial = \"paint\"\nworldline = \"fast\"\ntranslate = {place}\n[camera]\n"
        ),
    )
}

/// Directions in the rest frame of worldline 1 as the camera sees them.
fn as_seen(eye: &Eye<'_>, in_rest: &[DVec3]) -> Vec<DVec3> {
    directions(eye, 0, 1, in_rest)
}

/// The camera's directions in the rest frame of worldline 1.
fn in_rest(eye: &Eye<'_>, seen: &[DVec3]) -> Vec<DVec3> {
    directions(eye, 1, 0, seen)
}

fn directions(eye: &Eye<'_>, to: usize, from: usize, given: &[DVec3]) -> Vec<DVec3> {
    boosted(eye.view().spacetime(), to, from, given)
        .0
        .iter()
        .map(|direction| direction.normalize())
        .collect()
}

/// Boosted directions, and ratios of frequencies.
fn boosted(
    spacetime: &Spacetime,
    to: usize,
    from: usize,
    given: &[DVec3],
) -> (Vec<DVec3>, Vec<f64>) {
    let (mut directions, mut ratios) = (Vec::new(), Vec::new());
    boost_directions(
        spacetime.link(to, from),
        given,
        &mut directions,
        &mut ratios,
    );
    (directions, ratios)
}

/// How many of `millions` of rays miss: half of them evenly over the camera's sky, half over the
/// body's.
fn misses(eye: &Eye<'_>, millions: u64) -> u64 {
    const CHUNK: u64 = 4000;
    let view = eye.view();
    (0..millions * 1_000_000 / CHUNK)
        .into_par_iter()
        .map(|chunk| {
            let mut dice = Dice(chunk << 32);
            let drawn: Vec<DVec3> = (0..CHUNK).map(|_| dice.direction()).collect();
            let rays = if chunk % 2 == 0 {
                drawn
            } else {
                as_seen(eye, &drawn)
            };
            eye.meets(&view, &rays)
                .iter()
                .filter(|met| met.is_none())
                .count() as u64
        })
        .sum()
}

/// Rays that miss, of those at the vertices and along the edges of a mesh about the camera.
fn leaks(eye: &Eye<'_>) -> usize {
    let instance = &eye.scene.geometry.instances[0];
    let mesh = &eye.scene.geometry.meshes[instance.mesh as usize];
    let eye_at = eye.view().spacetime().camera_event(1).x;
    let aims: Vec<DVec3> = triangles(mesh)
        .flat_map(|[a, b, _]| (0..=12).map(move |i| a + (b - a) * (f64::from(i) / 12.0)))
        .map(|point| (instance.rest_from_mesh.transform_point3(point) - eye_at).normalize())
        .collect();
    let met = eye.meets(&eye.view(), &as_seen(eye, &aims));
    met.iter().filter(|met| met.is_none()).count()
}

/// What a camera ray meets on one worldline alone: the hit, and its lab time.
fn alone(eye: &Eye<'_>, spacetime: &Spacetime, worldline: usize, direction: DVec3) -> Option<f64> {
    let (directions, _) = boosted(spacetime, worldline, 0, &[direction]);
    let event = spacetime.camera_event(worldline);
    let ray = Ray {
        origin: event.x,
        direction: directions[0],
    };
    let hit = eye
        .aggregate
        .intersect_ray(worldline, &ray, f64::INFINITY)?;
    let emission = Event::new(event.t - hit.t, event.x + ray.direction * hit.t);
    Some(spacetime.link(0, worldline).event(emission).t)
}

cases! {
    /// The nearest is what shone last. Lab times are rounded at γ = 10: where two are as close as
    /// that, either may be it.
    fn d7_the_nearest_hit_by_ray_parameter_shone_last(card) {
        const ROUNDING: f64 = 1e-12;
        let set = Set::new(&format!(
            "{HEAD}[worldline.a]\nvelocity = [0.6, 0, 0.3]\nat = -5\n[worldline.b]\n\
             velocity = {{ gamma = 10, direction = [-1, 0.5, 0.2] }}\nat = -5\n{}\
             [camera]\nposition = [0, 0, 5]\n",
            ["lab", "a", "b"].map(|name| format!(
                "[[model]]\nname = \"{name}\"\nfile = \"ball.obj\"\nmaterial = \"paint\"\nworldline = \"{name}\"\n"
            )).concat()
        ));
        let eye = Eye::new(&set);
        let rays: Vec<DVec3> = (0..10_000)
            .map(|i| DVec3::new(f64::from(i % 100) * 0.01 - 0.5, f64::from(i / 100) * 0.01 - 0.5, -1.0).normalize())
            .collect();
        let view = eye.view();
        let spacetime = view.spacetime();
        let nearest = eye.meets(&view, &rays);
        let (mut contested, mut wrong) = (0, 0);
        for (direction, met) in rays.iter().zip(nearest) {
            let times: Vec<(usize, f64)> =
                (0..3).filter_map(|w| Some((w, alone(&eye, spacetime, w, *direction)?))).collect();
            contested += u32::from(times.len() > 1);
            let last = times.iter().map(|(_, t)| *t).fold(f64::NEG_INFINITY, f64::max);
            let right = match met {
                None => times.is_empty(),
                Some(Met { worldline, .. }) => times.iter().any(|&(w, t)| w == worldline && t >= last - ROUNDING),
            };
            wrong += u32::from(!right);
        }
        card.holds("bodies of three frames overlap", contested > 1000);
        card.same("hits that did not shine last, of 1e4", 0.0, f64::from(wrong));

        let set = Set::with(&[("round.obj", &sphere(24, 48))], &format!(
            "{HEAD}[worldline.fast]\nvelocity = {{ gamma = 1e3, direction = [1, 0.5, 0.2] }}\n[[model]]\n\
             file = \"round.obj\"\nmaterial = \"paint\"\nworldline = \"fast\"\n[camera]\nposition = [0.5, 3, 4]\n"
        ));
        let eye = Eye::new(&set);
        let event = eye.view().spacetime().camera_event(1).x;
        let inner = inner_radius(&eye.scene.geometry.meshes[0]);
        let [e, f] = across(-event.normalize());
        // Past the sphere's centre by `off`: sin ρ = off/distance.
        let ring = |off: f64| -> Vec<DVec3> {
            let rho = (off / event.length()).asin();
            let aim = |i: i32| {
                let (sin, cos) = (f64::from(i) * 0.01).sin_cos();
                -event.normalize() * rho.cos() + (e * cos + f * sin) * rho.sin()
            };
            as_seen(&eye, &(0..628).map(aim).collect::<Vec<_>>())
        };
        // A direction rounded in the camera's frame is off by up to 2γε in the other.
        let slack = 4e3 * f64::EPSILON * event.length();
        let count = |off: f64| {
            let met = eye.meets(&eye.view(), &ring(off));
            met.iter().filter(|met| met.is_some()).count() as f64
        };
        let hits: f64 = (0..32).map(|i| count((inner - slack) * f64::from(i) / 31.0)).sum();
        card.same("hits of 32·628 rays at a sphere of γ = 1e3", 32.0 * 628.0, hits);
        card.same("hits of 628 rays that just pass it", 0.0, count(1.0 + slack));
    }

    fn d8_the_inside_of_a_sphere_at_lorentz_factor_1000_has_no_gap(card) {
        let set = around_the_camera("round.obj", 1e3, true);
        let eye = Eye::new(&set);
        card.same("misses of 1e7 rays at γ = 1e3", 0.0, misses(&eye, 10) as f64);
        let mesh = &eye.scene.geometry.meshes[0];
        let seen = as_seen(&eye, &mesh.positions);
        let far = eye.meets(&eye.view(), &seen).iter().map(|met| (met.unwrap().hit.t - 1.0).abs()).fold(0.0, f64::max);
        card.at_most("rest-frame distance of the vertices, off R", far, 1e-12);
        let planes: Vec<(DVec3, f64)> = triangles(mesh).map(plane).collect();
        let mut dice = Dice(8);
        let drawn: Vec<DVec3> = (0..100_000).map(|_| dice.direction()).collect();
        let seen = as_seen(&eye, &drawn);
        let (mut off, mut twice) = (0.0_f64, 0);
        for (direction, met) in in_rest(&eye, &seen).into_iter().zip(eye.meets(&eye.view(), &seen)) {
            let hit = met.unwrap().hit;
            let (normal, distance) = planes[hit.triangle as usize];
            off = off.max((hit.t - distance / normal.dot(direction)).abs());
            let beyond = Ray { origin: direction * (hit.t + 1e-12), direction };
            twice += u32::from(eye.aggregate.occludes_ray(1, &beyond, f64::INFINITY));
        }
        card.at_most("rest-frame distance of 1e5 points, off their facets", off, 1e-12);
        card.same("second hits of these rays", 0.0, f64::from(twice));
    }

    /// A camera that rides on a wall, anywhere on it, however large the wall and however far. Of one
    /// that a fast wall passes it is not asked: there its place is rounded to γ·ε of its coordinates,
    /// so it stands on this side of the wall or on that.
    fn d9_a_camera_on_a_surface_does_not_see_it(card) {
        for (scale, place, lorentz_factor) in [
            (1.0, 0.0, 1.0), (1e-6, 0.0, 1.0), (1e6, 0.0, 1.0), (1.0, 1e6, 1.0), (1.0, 1e6, 1e3), (1e-3, 3e3, 1e3),
        ] {
            let set = Set::new(&format!(
                "{HEAD}[worldline.fast]\nvelocity = {{ gamma = {lorentz_factor}, direction = [1, 2, 3] }}\n[[model]]\n\
                 file = \"wall.obj\"\nmaterial = \"paint\"\nworldline = \"fast\"\nrotate = [20, 50, -70]\n\
                 scale = {scale:?}\ntranslate = [{place:?}, {:?}, 0]\n[camera]\nworldline = \"fast\"\n", place * 0.3
            ));
            let mut eye = Eye::new(&set);
            let rest_from_mesh = eye.scene.geometry.instances[0].rest_from_mesh;
            let mut dice = Dice(9);
            let (mut own, mut ahead) = (0, 0);
            for _ in 0..100 {
                let on_wall = DVec3::new(dice.signed(), dice.signed(), 0.0) * 0.99;
                let rays: Vec<DVec3> = (0..20).map(|_| dice.direction()).collect();
                eye.scene.camera.event.x = rest_from_mesh.transform_point3(on_wall);
                let met = eye.meets(&eye.view(), &rays);
                own += met.iter().filter(|met| met.is_some()).count();
                // From a thousandth of its size in front, all of it is seen.
                eye.scene.camera.event.x = rest_from_mesh.transform_point3(on_wall + DVec3::Z * 1e-3);
                let down = -rest_from_mesh.matrix3.z_axis.normalize();
                ahead += usize::from(eye.meets(&eye.view(), &[down])[0].is_some());
            }
            let case = format!("wall of {scale} m, {place} m off, γ = {lorentz_factor}");
            card.same(&format!("hits of 2000 rays from it, {case}"), 0.0, own as f64);
            card.same(&format!("hits of 100 rays at it, {case}"), 100.0, ahead as f64);
        }
    }

    fn d10_closed_meshes_do_not_leak_at_edges_and_vertices(card) {
        let set = around_the_camera("box.obj", 1e3, false);
        card.same("misses of 1e6 rays in a cube, γ = 1e3", 0.0, misses(&Eye::new(&set), 1) as f64);
        for (file, centered) in [("box.obj", true), ("box.obj", false), ("round.obj", true), ("round.obj", false)] {
            for lorentz_factor in [1.0, 1e3, 1e6] {
                let set = around_the_camera(file, lorentz_factor, centered);
                let place = if centered { "centre" } else { "side" };
                let what = format!("leaks at edges of {file}, γ = {lorentz_factor}, from the {place}");
                card.same(&what, 0.0, leaks(&Eye::new(&set)) as f64);
            }
        }
        // The camera stands in the wall's plane, beside it, and the wall moves in that plane.
        for lorentz_factor in [1.0, 2.0, 1e3] {
            let set = Set::new(&format!(
                "{HEAD}[worldline.fast]\nvelocity = {{ gamma = {lorentz_factor}, direction = [1, 0.5, 0] }}\n[[model]]\n\
                 file = \"wall.obj\"\nmaterial = \"paint\"\nworldline = \"fast\"\n[camera]\nposition = [0, 3, 0]\n"
            ));
            let eye = Eye::new(&set);
            let rays: Vec<DVec3> = (0..3600)
                .map(|i| (f64::from(i) * 0.1).to_radians().sin_cos())
                .map(|(x, y)| DVec3::new(x, y, 0.0))
                .collect();
            let hits = eye.meets(&eye.view(), &rays).iter().filter(|met| met.is_some()).count();
            card.same(&format!("hits of rays in a wall's plane, γ = {lorentz_factor}"), 0.0, hits as f64);
        }
    }

    fn d13_trees_change_no_bit_of_a_hit(card) {
        let set = Set::with(&[("round.obj", &sphere(12, 24))], &format!(
            "{HEAD}[worldline.fast]\nvelocity = [0.6, 0.3, 0]\n{}[camera]\nposition = [0, 0, 9]\n",
            [
                "round.obj\"\nname = \"a\"", "round.obj\"\nname = \"b\"\nscale = [-1.5, 1, 0.4]\nrotate = [30, 40, 50]",
                "box.obj\"\nname = \"c\"\nscale = [0.5, 2, -0.5]\ntranslate = [0.5, 0, 0]",
                "box.obj\"\nname = \"d\"\ntranslate = [2, 0, 0]", "box.obj\"\nname = \"e\"\ntranslate = [4, 0, 0]",
                "wall.obj\"\nname = \"f\"\nscale = 1e-6\ntranslate = [0, 0, 2]",
                "wall.obj\"\nname = \"g\"\nscale = 1e3\ntranslate = [0, 0, -700]",
            ].map(|model| format!("[[model]]\nmaterial = \"paint\"\nworldline = \"fast\"\nfile = \"{model}\n")).concat()
        ));
        let mut geometry = (*set.scene().geometry).clone();
        for instance in geometry.instances.iter_mut().step_by(2) {
            instance.double_sided = false;
        }
        let aggregate = build_aggregate(&geometry, None);
        let targets: Vec<DVec3> = geometry.instances.iter().flat_map(|instance| {
            let place = instance.rest_from_mesh;
            triangles(&geometry.meshes[instance.mesh as usize])
                .flat_map(move |[a, b, c]| [a, a / 2.0 + b / 2.0, (a + b + c) / 3.0].map(|p| place.transform_point3(p)))
        }).collect();
        let bits = |hit: Option<Hit>| hit.map(|h| {
            (h.t.to_bits(), h.instance, h.triangle, h.weights.map(f64::to_bits))
        });
        let compare = |i: u64| -> [u32; 2] {
            let mut dice = Dice(i << 32);
            let target = targets[(dice.unit() * targets.len() as f64) as usize];
            // From afar, from among the bodies, from another body's surface, and anywhere.
            let origin = match i % 4 {
                0 => dice.direction() * 10f64.powf(1.0 + 8.0 * dice.unit()),
                1 => dice.point() * 3.0,
                _ => targets[(dice.unit() * targets.len() as f64) as usize],
            };
            let aim = target - origin;
            let direction = if i % 4 == 3 || aim == DVec3::ZERO { dice.direction() } else { aim.normalize() };
            let ray = Ray { origin, direction };
            let first = aggregate.intersect_without_trees(1, &ray, f64::INFINITY);
            let reach = first.map_or(1.0, |hit| hit.t);
            // Also just as far as that, and not as far.
            let differ = [f64::INFINITY, reach, reach * 0.999].map(|reach| {
                bits(aggregate.intersect_ray(1, &ray, reach)) != bits(aggregate.intersect_without_trees(1, &ray, reach))
            });
            [u32::from(differ.contains(&true)), u32::from(first.is_some())]
        };
        let [differ, hits] = (0..24_000).into_par_iter().map(compare)
            .reduce(|| [0, 0], |a, b| [a[0] + b[0], a[1] + b[1]]);
        card.holds("most of 24 000 rays meet something", hits > 12_000);
        card.same("rays that differ from brute force", 0.0, f64::from(differ));
    }

    /// Walls that stand in each other, and one that slides in the same plane at 0.6 c.
    fn d14_crossing_worldlines_are_seen_alike_in_any_order_and_number_of_threads(card) {
        let worldlines = ["slow", "fast"].map(|name| {
            let speed = if name == "fast" { 0.6 } else { -0.3 };
            format!("[worldline.{name}]\nvelocity = [{speed}, 0, 0]\nat = -3\n")
        });
        let models = [("north", "fast"), ("east", "slow"), ("west", "slow"), ("south", "lab"), ("", "lab"), ("", "lab")];
        let models: Vec<String> = models.iter().enumerate().map(|(i, (name, worldline))| {
            let name = if name.is_empty() { String::new() } else { format!("name = \"{name}\"\n") };
            format!("[[model]]\n{name}file = \"wall.obj\"\nworldline = \"{worldline}\"\nmaterial = \"paint{i}\"\n")
        }).collect();
        let paints: String = (0..6).map(|i| format!(
            "[material.paint{i}]\nemission = {{ scale = {}, spectrum = 1.0 }}\n", i + 1
        )).collect();
        let shot = |order: &[usize], lines: [usize; 2]| {
            let models: String = order.iter().map(|&i| models[i].as_str()).collect();
            Set::new(&format!(
                "[image]\nsize = [64, 64]\nsamples = 2\n[sensor]\nexposure = 0\n{paints}{}{models}\
                 [camera]\nposition = [0.1, 0.2, 3]\n", lines.map(|i| worldlines[i].as_str()).concat()
            ))
        };
        let film = |set: &Set, threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| set.film()).xyz
        };
        let first = shot(&[0, 1, 2, 3, 4, 5], [0, 1]);
        card.holds("surfaces of two worldlines are met at one event", ties(&first.scene()) > 100);
        let seen = film(&first, 1);
        for (order, lines, threads) in [
            ([0, 1, 2, 3, 4, 5], [0, 1], 4), ([5, 4, 3, 2, 1, 0], [1, 0], 1), ([2, 5, 1, 4, 0, 3], [1, 0], 3),
        ] {
            let same = film(&shot(&order, lines), threads) == seen;
            card.holds(&format!("same film with models {order:?}, worldlines {lines:?}, {threads} threads"), same);
        }
    }
}

/// Rays that meet bodies of the lab and of worldline 2 at the same parameter, to the bit.
fn ties(scene: &Scene) -> usize {
    let spacetime = Spacetime::new(scene, true);
    let aggregate = build_aggregate(&scene.geometry, None);
    let meets = |worldline: usize, direction: DVec3| {
        let (directions, ratios) = boosted(&spacetime, worldline, 0, &[direction]);
        let ray = Ray {
            origin: spacetime.camera_event(worldline).x,
            direction: directions[0],
        };
        Some(aggregate.intersect_ray(worldline, &ray, f64::INFINITY)?.t / ratios[0])
    };
    let tied = |i: &i32| {
        let direction = scene
            .camera
            .looks_along([f64::from(i % 128) / 128.0, f64::from(i / 128) / 128.0])
            .unwrap();
        let [a, b] = [0, 2].map(|worldline| meets(worldline, direction));
        a.is_some() && a == b
    };
    (0..128 * 128).filter(tied).count()
}
