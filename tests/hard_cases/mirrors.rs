//! E. Mirrors and glass.

use super::scene::Set;
use glam::DVec3;
use restframe::frame::Frame;
use restframe::probe::{Probe, ProbeNode};
use restframe::relativity::{Boost, Celerity};
use restframe::render::View;
use restframe::trace::{Scratch, Seen, ShadeTrees, build_aggregate};

const EPSILON: f64 = f64::EPSILON;

/// Rays leave a surface 1000 roundings of its size off it (`scene::SurfacePoint::clearance`):
/// metres, for the mirrors and slabs here, whose coordinates and edges add up to less than 100.
const CLEARANCE: f64 = 1e3 * EPSILON * 100.0;

/// A mirror on a worldline of its own, and a glowing wall behind the camera, which looks along −z
/// from z = 1 with 90° over 21 pixels.
fn before_a_mirror(velocity: &str, tilt: &str) -> Set {
    Set::new(&format!(
        "[image]\nsize = [21, 21]\n[sensor]\nexposure = 0\n\
         [worldline.moving]\nvelocity = {velocity}\n\
         [[model]]\nname = \"mirror\"\nfile = \"wall.obj\"\nworldline = \"moving\"\nmaterial = \"mirror\"\n\
         scale = 20\ntranslate = [0, 0, -2]\nrotate = {tilt}\n\
         [[model]]\nname = \"lamp\"\nfile = \"wall.obj\"\nmaterial = \"lamp\"\nscale = 500\ntranslate = [0, 0, 3]\n\
         [material.mirror]\nmirror = {{ weight = 1.0, spectrum = 1.0 }}\n\
         [material.lamp]\nemission = {{ scale = 1.0, spectrum = 1.0 }}\n\
         [camera]\nposition = [0, 0, 1]\n"
    ))
}

fn event(node: &ProbeNode) -> (f64, DVec3) {
    let event = &node.hit.as_ref().unwrap().event;
    (event.t, DVec3::from(event.x))
}

fn to_camera(node: &ProbeNode) -> f64 {
    node.hit.as_ref().unwrap().doppler
}

/// Unit direction of travel of the light between two nodes.
fn travel(from: &ProbeNode, to: &ProbeNode) -> DVec3 {
    (event(to).1 - event(from).1).normalize()
}

fn seen_in_mirror(probe: &Probe) -> (&ProbeNode, &ProbeNode) {
    assert_eq!(probe.chain.len(), 2, "{probe:?}");
    (&probe.chain[0], &probe.chain[1])
}

cases! {
    /// With b the mirror's speed away from the source and θ the angles to its normal:
    /// ν_r/ν_i = (1 − 2b cos θ_i + b²)/(1 − b²) and cos θ_r = ((1+b²) cos θ_i − 2b)/(1 − 2b cos θ_i + b²)
    /// (Einstein 1905 §8). Bound: two boosts of light at 24 roundings each, and the direction from
    /// two events, 2.5 m apart or more.
    fn e7_a_mirror_moving_along_its_normal_shifts_and_turns_light(card) {
        let bound = 200.0 * EPSILON + 2.0 * CLEARANCE / 2.5;
        for (velocity, b) in [("[0, 0, -0.5]", 0.5), ("[0, 0, 0.5]", -0.5), ("[0, 0, -0.9]", 0.9)] {
            for pixel in [[10, 10], [14, 10], [15, 6]] {
                let probe = before_a_mirror(velocity, "[0, 0, 0]").probe(pixel);
                let (mirror, lamp) = seen_in_mirror(&probe);
                let cos_i = -travel(lamp, mirror).z;
                let cos_r = (DVec3::Z - event(mirror).1).normalize().z;
                let shift = 1.0 - 2.0 * b * cos_i + b * b;
                let place = format!("b = {b}, cos θ = {cos_i:.4}");
                card.relative(
                    &format!("ν_r/ν_i, {place}"),
                    shift / (1.0 - b * b),
                    to_camera(lamp),
                    bound,
                );
                card.near(
                    &format!("cos θ_r, {place}"),
                    ((1.0 + b * b) * cos_i - 2.0 * b) / shift,
                    cos_r,
                    bound,
                );
            }
        }
        let head_on = before_a_mirror("[0, 0, -0.5]", "[0, 0, 0]").probe([10, 10]);
        card.relative("ν_r/ν_i head-on, receding at 0.5 c", 1.0 / 3.0, to_camera(&head_on.chain[1]), 4.0 * EPSILON);
    }

    /// Bound of the shift: two boosts of light, at 12 roundings each and a condition of γ²(1+β)² < 20
    /// at 0.9 c. Of the place: twice the clearance, at a grazing angle of 45° or less.
    fn e8_a_mirror_sliding_in_its_plane_does_nothing(card) {
        for velocity in ["[0.6, 0, 0]", "[0.3, -0.5, 0]", "[0, 0.9, 0]"] {
            for pixel in [[10, 10], [15, 4], [2, 8]] {
                let sliding = before_a_mirror(velocity, "[0, 0, 0]").probe(pixel);
                let still = before_a_mirror("[0, 0, 0]", "[0, 0, 0]").probe(pixel);
                let (_, lamp) = seen_in_mirror(&sliding);
                let (_, same) = seen_in_mirror(&still);
                card.near(&format!("D by way of {velocity}, pixel {pixel:?}"), 1.0, to_camera(lamp), 200.0 * EPSILON);
                let off = (event(lamp).1 - event(same).1).length();
                card.at_most("where the lamp is seen, m", off, 4.0 * CLEARANCE);
                card.near("when its light left, m", event(same).0, event(lamp).0, 4.0 * CLEARANCE);
            }
        }
    }

    /// Each pair of reflections, off the closing mirror and off the resting one, is a factor of
    /// (1 + b)/(1 − b) = 3. Bound: 40 boosts of light head-on, four roundings each.
    fn e9_twenty_reflections_between_closing_mirrors_give_3_to_the_20th(card) {
        let probe = Set::new(
            "[image]\nsize = [3, 3]\n[sensor]\nexposure = 0\n[effects]\nbounces = 39\n\
             [worldline.closing]\nvelocity = [0, 0, 0.5]\n\
             [[model]]\nname = \"closing\"\nfile = \"wall.obj\"\nworldline = \"closing\"\nmaterial = \"mirror\"\ntranslate = [0, 0, -1]\n\
             [[model]]\nname = \"resting\"\nfile = \"wall.obj\"\nmaterial = \"mirror\"\ntranslate = [0, 0, 2]\n\
             [material.mirror]\nmirror = { weight = 1.0, spectrum = 1.0 }\n\
             [camera]\nposition = [0, 0, 1]\n",
        )
        .probe([1, 1]);
        card.holds("40 surfaces are seen in each other", probe.chain.len() == 40);
        let mut worst = 0.0_f64;
        for (i, node) in probe.chain.iter().enumerate() {
            let on_resting = i % 2 == 1;
            if on_resting {
                let exact = 3_f64.powi((i as i32 + 1) / 2);
                worst = worst.max((to_camera(node) / exact - 1.0).abs());
            }
        }
        card.at_most("D after 1 to 20 reflections, worst", worst, 160.0 * EPSILON);
        card.relative("D after 20", 3_486_784_401.0, to_camera(&probe.chain[39]), 160.0 * EPSILON);
    }

    /// A slab of rest thickness L = 2 and index 1.5, moving at 0.4 c towards the camera: light that
    /// travels along with it takes γL(n + β) in the lab, at the speed (1/n + β)/(1 + β/n).
    /// Bound of times and places: four clearances over ways of 2 m or more.
    fn e11_a_moving_slab_changes_neither_colour_nor_direction(card) {
        let bound = 4.0 * CLEARANCE / 2.0;
        let set = Set::new(
            "[image]\nsize = [21, 21]\n[sensor]\nexposure = 0\n[worldline.moving]\nvelocity = [0, 0, 0.4]\n\
             [[model]]\nname = \"slab\"\nfile = \"box.obj\"\nworldline = \"moving\"\nmaterial = \"glass\"\nscale = [20, 20, 1]\n\
             [[model]]\nname = \"lamp\"\nfile = \"wall.obj\"\nmaterial = \"lamp\"\nscale = 500\ntranslate = [0, 0, -30]\n\
             [material.glass]\nrefraction = { weight = 1.0, spectrum = 1.0, ior = 1.5 }\n\
             [material.lamp]\nemission = { scale = 1.0, spectrum = 1.0 }\n\
             [camera]\nposition = [0, 0, 10]\n",
        );
        let (n, beta, thickness) = (1.5, 0.4, 2.0);
        let lorentz_factor = 1.0 / f64::sqrt(1.0 - beta * beta);
        let straight = set.probe([10, 10]);
        let (near, far) = (event(&straight.chain[0]), event(&straight.chain[1]));
        card.relative("transit time, γL(n+β)", lorentz_factor * thickness * (n + beta), near.0 - far.0, bound);
        card.relative(
            "speed inside, (1/n+β)/(1+β/n)",
            0.842_105_263_157_894_7,
            (near.1.z - far.1.z) / (near.0 - far.0),
            bound,
        );
        for pixel in [[10, 10], [16, 5], [5, 16]] {
            let probe = set.probe(pixel);
            let [near, far, lamp] = [0, 1, 2].map(|i| &probe.chain[i]);
            card.near(&format!("D of the lamp, pixel {pixel:?}"), 1.0, to_camera(lamp), 200.0 * EPSILON);
            let exit = (DVec3::new(0.0, 0.0, 10.0) - event(near).1).normalize();
            card.at_most("between entry and exit direction", (travel(lamp, far) - exit).length(), bound);
        }
    }

    /// In a furnace of radiance 1 everything has radiance 1: shares of reflection and refraction
    /// add up, over all paths. Bound: what was cut off, and f32 spectra.
    fn e11_glass_in_a_furnace_is_invisible(card) {
        let set = Set::new(
            "[image]\nsize = [9, 9]\n[sensor]\nexposure = 0\n[effects]\nbounces = 64\n[accuracy]\ncutoff = 1e-6\n\
             [worldline.moving]\nvelocity = [0.3, 0.5, -0.4]\n\
             [[model]]\nfile = \"box.obj\"\nworldline = \"moving\"\nmaterial = \"glass\"\nrotate = [20, 30, 10]\n\
             [material.glass]\nmirror = { weight = 1.0, spectrum = 1.0 }\nrefraction = { weight = 1.0, spectrum = 1.0, ior = 1.5 }\n\
             [background]\nworldline = \"moving\"\nspectrum = 1.0\n\
             [camera]\nworldline = \"moving\"\nposition = [0, 0, 4]\nhfov = 60\n",
        );
        let mut glass = 0;
        let mut worst = 0.0_f64;
        for x in 0..9 {
            for y in 0..9 {
                let probe = set.probe([x, y]);
                glass += u32::from(probe.hit.is_some());
                for value in &probe.radiance {
                    worst = worst.max((value - 1.0).abs() - probe.cut);
                }
            }
        }
        card.holds("glass is looked through", glass > 20);
        card.at_most("radiance beside 1, past what was cut", worst, 1e-6);
    }

    /// The verdict is that of the glass' rest frame, whoever looks: a camera inside a glass box, at
    /// rest in it or boosted to γ = 10, its ray aberrated accordingly. The box's far face is met at
    /// the critical angle arcsin(1/1.5) ± 1e-12; a boost there and back errs by γ²·24ε = 5e-13.
    fn e12_total_reflection_is_decided_in_the_rest_frame(card) {
        let u = "{ gamma = 10, direction = [0.6, 0.2, 0.4] }";
        let inside = |camera: &str| {
            Set::new(&format!(
                "[sensor]\nexposure = 0\n[worldline.moving]\nvelocity = {u}\n\
                 [[model]]\nfile = \"box.obj\"\nworldline = \"moving\"\nmaterial = \"glass\"\n\
                 [material.glass]\nrefraction = {{ weight = 1.0, spectrum = 1.0, ior = 1.5 }}\n\
                 [camera]\nworldline = \"{camera}\"\n"
            ))
        };
        let total = |set: &Set, direction: DVec3| {
            let shot = &set.prepared.shot;
            let scene = set.scene();
            let aggregate = build_aggregate(&scene.geometry, None);
            let view = View::new(&Frame::new(shot, 1).unwrap(), &shot.effects, &scene, &aggregate);
            let mut trees = ShadeTrees::default();
            view.tracer().trace(&[direction], &mut Scratch::default(), &mut trees);
            let glass = scene.materials[0].bsdf.refraction().unwrap().0 as u32;
            let next = trees.nodes[1..].iter().find_map(|node| match (node.branch, node.seen) {
                (Some(branch), Seen::Surface(surface)) if branch.parent == 0 && branch.lobe == glass => {
                    Some(surface.hit.triangle)
                }
                _ => None,
            });
            next.is_some()
        };
        let rest_from_lab = Boost::into_rest_of(
            Celerity::from_lorentz_factor(10.0, DVec3::new(0.6, 0.2, 0.4)).unwrap(),
        );
        let lab_from_rest = Boost::into_rest_of(
            Celerity::from_lorentz_factor(10.0, -DVec3::new(0.6, 0.2, 0.4)).unwrap(),
        );
        let [comoving, resting] = ["moving", "lab"].map(inside);
        for (name, off, verdict) in [("below", -1e-12, false), ("above", 1e-12, true)] {
            let angle = (1.0_f64 / 1.5).asin() + off;
            for turn in [0.3_f64, 1.1, 2.9] {
                let d = DVec3::new(angle.sin() * turn.cos(), angle.sin() * turn.sin(), -angle.cos());
                let back = rest_from_lab.light(lab_from_rest.light(-d).direction).direction;
                assert!((back + d).length() < 1e-12);
                let seen = -lab_from_rest.light(-d).direction;
                let agree = total(&comoving, d) == verdict && total(&resting, seen) == verdict;
                card.holds(&format!("{name} the critical angle by 1e-12, turned by {turn}"), agree);
            }
        }
    }
}
