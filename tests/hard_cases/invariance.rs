//! A. The whole scene moved: one boost, turn and translation of every worldline, with what stands
//! on it, changes no picture, whatever is in it.
//!
//! What limits this: origins of worldlines are rounded in the moved lab, where their coordinates
//! are γ times those here (and the translation), and each rest frame brings them back by another
//! γ: bodies are off by γ²ε·10 m = 2e-9 m at γ = 10³. Mirror balls and glass balls magnify that,
//! tenfold with each bounce or so. A sample whose ray passes an edge, of a body, a shadow, a star
//! or a facet, nearer than this may see the other side of it: of the 1536 of each picture here
//! none does.

use super::card::Card;
use super::poincare::Poincare;
use super::scene::Set;
use glam::DVec3;
use restframe::film::Film;
use restframe::frame::Frame;
use restframe::render::View;
use restframe::scene::LobeKind;
use restframe::trace::{Branch, Node, Root, Scratch, Seen, ShadeTrees, build_aggregate};

/// Light and D of each pixel may differ by this share of themselves, eight roundings of the film's
/// f32 (the greatest value of the film is 1e6 times the least and more, so it would hide all else).
const BOUND: f64 = 1e-6;

/// Four worldlines that pass, at rest in which the camera, bodies and lamps are: a shot's head. Light
/// from where they pass reaches the origin at the exposure.
const LINES: &str = r#"
[image]
size = [24, 16]
samples = 4
[sensor]
exposure = 0
[worldline.eye]
velocity = [0.25, 0.125, -0.375]
[worldline.one]
velocity = [0.375, 0.125, 0.25]
passes = [-1, 0, -6]
at = -6
[worldline.two]
velocity = [-0.25, 0.5, 0.125]
passes = [1.5, 0.5, -5]
at = -5.5
[worldline.three]
velocity = [-0.5, -0.5, -0.5]
passes = [2, 3, -3]
at = -8
[material.wall]
diffuse = { weight = 0.75, spectrum = { points = [[400, 0.1], [550, 0.5], [680, 0.2], [720, 0.9]] } }
[material.painted]
diffuse = { weight = 0.5, spectrum = { points = [[450, 0.8], [600, 0.1]] } }
highlight = { weight = 0.25, spectrum = 1.0, exponent = 20 }
thermal = { temperature = 4000, curve = "peak", strength = 0.002 }
"#;

/// A wide wall behind everything, a painted ball, and a lamp.
const ROOM: &str = r#"
[[model]]
name = "wall"
file = "wall.obj"
material = "wall"
scale = 12
translate = [0, 0, -10]
[[model]]
name = "ball"
file = "ball.obj"
worldline = "one"
material = "painted"
[[light]]
kind = "point"
worldline = "three"
position = [0, 0, 0]
scale = 1.0
spectrum = "D65"
"#;

/// The camera, by what is to be said of it beside that it moves.
fn camera(keys: &str) -> String {
    format!("[camera]\nworldline = \"eye\"\n{keys}\n")
}

fn shot(parts: &[&str]) -> String {
    format!("{LINES}{}", parts.concat())
}

/// What of a shot's picture a motion of the whole scene changes, at each Lorentz factor.
fn moved(card: &mut Card, what: &str, text: &str) -> Film {
    let set = Set::new(text);
    let scene = set.scene();
    let still = set.film_of(&scene);
    for (seed, lorentz_factor) in [(11, 1.2), (12, 10.0), (13, 1e3)] {
        let moved = Poincare::at_random(seed, lorentz_factor).scene(&scene);
        let film = set.film_of(&moved);
        card.at_most(
            &format!("{what}, γ = {lorentz_factor}: light"),
            light_apart(&still, &film).fold(0.0, f64::max),
            BOUND,
        );
        card.at_most("D, relative", doppler_apart(&still, &film), BOUND);
    }
    still
}

/// The greatest difference of X, Y or Z in each pixel, over the greatest of them there; infinite
/// where one is no number.
fn light_apart(one: &Film, other: &Film) -> impl Iterator<Item = f64> {
    one.xyz.iter().zip(&other.xyz).map(|(a, b)| {
        let [a, b] = [a, b].map(|xyz| xyz.map(f64::from));
        let top = a.into_iter().chain(b).fold(0.0, f64::max);
        let off = (0..3).map(|c| (a[c] - b[c]).abs());
        if off.clone().any(f64::is_nan) {
            return f64::INFINITY;
        }
        if top > 0.0 {
            off.fold(0.0, f64::max) / top
        } else {
            0.0
        }
    })
}

/// The greatest relative difference of the first surfaces' D; infinite where one film sees another
/// worldline than the other.
fn doppler_apart(one: &Film, other: &Film) -> f64 {
    if one.layers.worldline != other.layers.worldline {
        return f64::INFINITY;
    }
    let [one, other] = [one, other].map(|film| film.layers.doppler.as_ref().unwrap());
    let seen = one.iter().zip(other).filter(|(a, _)| **a != 0.0);
    seen.map(|(a, b)| (f64::from(*b) / f64::from(*a) - 1.0).abs())
        .fold(0.0, f64::max)
}

/// That something is there to be moved: so many pixels are others by a hundredth without it.
fn counts(card: &mut Card, what: &str, with: &Film, without: &str, least: usize) {
    let without = Set::new(without).film();
    let found = light_apart(with, &without)
        .filter(|off| *off > 0.01)
        .count();
    card.holds(
        &format!("{what}: more than {least} of 384 pixels"),
        found > least,
    );
}

/// Three mirrors, two of them moving and tinted, one round, which also see each other.
const MIRRORS: &str = r#"
[[model]]
name = "tinted"
file = "wall.obj"
worldline = "two"
material = "gold"
scale = 2.5
rotate = [10, -50, 0]
[[model]]
name = "round"
file = "ball.obj"
worldline = "one"
material = "blue"
scale = 0.75
translate = [0, 1.75, 0.5]
[[model]]
name = "resting"
file = "wall.obj"
material = "clear"
scale = 4
rotate = [0, 75, 0]
translate = [-3, 0, -7]
[material.gold]
mirror = { weight = 0.9, spectrum = { points = [[400, 0.2], [500, 0.5], [600, 0.9]] } }
[material.blue]
mirror = { weight = 0.8, spectrum = { rgb = [0.2, 0.4, 0.9] } }
diffuse = { weight = 0.1, spectrum = 1.0 }
[material.clear]
mirror = { weight = 1.0, spectrum = 1.0 }
[background]
worldline = "three"
spectrum = { points = [[400, 0.001], [560, 0.004], [700, 0.002]] }
[effects]
bounces = BOUNCES
"#;

/// A slab and a ball, Fresnel's reflection from both, and in the slab's corners total reflection.
const GLASS: &str = r#"
[[model]]
name = "slab"
file = "box.obj"
worldline = "two"
material = "glass"
scale = [2, 1.75, 0.75]
rotate = [20, 30, 10]
[[model]]
name = "lens"
file = "ball.obj"
worldline = "three"
material = "crystal"
scale = 2
translate = [-3, -5, -2]
[material.glass]
mirror = { weight = 1.0, spectrum = 1.0 }
refraction = { weight = 0.9, spectrum = { rgb = [0.6, 0.9, 0.7] }, ior = 1.5 }
[material.crystal]
refraction = { weight = 1.0, spectrum = 1.0, ior = 1.25 }
[background]
worldline = "lab"
spectrum = 0.001
[effects]
bounces = BOUNCES
"#;

/// How many pixels see, at their centres, light that was totally reflected: there alone refraction
/// is given all of it.
fn totally_reflected(text: &str) -> usize {
    let set = Set::new(text);
    let (shot, scene) = (&set.prepared.shot, set.scene());
    let aggregate = build_aggregate(&scene.geometry, None);
    let view = View::new(
        &Frame::new(shot, 1).unwrap(),
        &shot.effects,
        &scene,
        &aggregate,
    );
    let [width, height] = shot.image.size;
    let directions: Vec<DVec3> = (0..width * height)
        .map(|i| [(i % width, width), (i / width, height)])
        .map(|point| point.map(|(i, count)| (f64::from(i) + 0.5) / f64::from(count)))
        .map(|point| scene.camera.looks_along(point).unwrap())
        .collect();
    let mut trees = ShadeTrees::default();
    view.tracer()
        .trace(&directions, &mut Scratch::default(), &mut trees);
    let lobe = |nodes: &[Node], branch: &Branch| match nodes[branch.parent as usize].seen {
        Seen::Surface(surface) => {
            let lobes = scene.materials[surface.material as usize].bsdf.lobes();
            lobes[branch.lobe as usize].kind
        }
        Seen::Sky(_) => unreachable!("nothing is seen in the sky"),
    };
    let total = |nodes: &[Node], branch: &Branch| {
        matches!(lobe(nodes, branch), LobeKind::Refraction { .. }) && branch.share == 1.0
    };
    let seen = |root: &&Root| {
        let nodes = trees.nodes_of(**root);
        let mut branches = nodes.iter().filter_map(|node| node.branch.as_ref());
        branches.any(|branch| total(nodes, branch))
    };
    trees.roots.iter().filter(seen).count()
}

/// One of each kind on each worldline that matters: the surface's, the camera's, another.
fn lamp(kind: &str, on: &str) -> String {
    let [shape, amount] = match kind {
        "point" => ["position = [0.5, 2, 3]", "scale = 1.0"],
        "spot" => [
            "position = [0.5, 1, 2]\ndirection = [-0.25, -0.25, -1]\ninner = 20\nouter = 40",
            "scale = 1.0",
        ],
        _ => ["direction = [0.25, -0.5, -1]", "scale = 0.02"],
    };
    format!(
        "[[light]]\nkind = \"{kind}\"\nworldline = \"{on}\"\n{shape}\n{amount}\n\
         spectrum = {{ blackbody = 5000 }}\n"
    )
}

/// Blocks on two worldlines that are neither the wall's nor the lamps'.
const BLOCKS: &str = r#"
[[model]]
name = "block"
file = "box.obj"
worldline = "two"
material = "painted"
scale = 0.5
translate = [-0.5, 0, 0]
[[model]]
name = "rail"
file = "box.obj"
worldline = "rail"
material = "painted"
scale = [3, 0.125, 0.125]
[worldline.rail]
velocity = [0.75, 0, 0.25]
passes = [0, -1, -8]
at = -8
[[light]]
kind = "sun"
worldline = "eye"
direction = [-0.25, -0.5, -1]
scale = 0.02
spectrum = 1.0
[effects]
shadows = "SHADOWS"
"#;

/// A mirror that reflects the sky.
const POND: &str = r#"
[[model]]
name = "pond"
file = "ball.obj"
worldline = "one"
material = "silver"
scale = 1.5
[material.silver]
mirror = { weight = 0.9, spectrum = 1.0 }
"#;

/// What lies behind, on a worldline of its own.
const BEHIND: &str = "[background]\nworldline = \"three\"\n";

cases! {
    fn a11_mirrors_look_alike_from_any_frame(card) {
        let text = shot(&[MIRRORS, ROOM, &camera("hfov = 70")]);
        let film = moved(card, "three mirrors, four bounces", &text.replace("BOUNCES", "4"));
        counts(card, "seen in mirrors", &film, &text.replace("BOUNCES", "0"), 60);
        counts(card, "seen in two or more", &film, &text.replace("BOUNCES", "1"), 10);
    }

    fn a11_glass_looks_alike_from_any_frame(card) {
        let text = shot(&[GLASS, ROOM, &camera("hfov = 70")]);
        let film = moved(card, "slab and ball, six boundaries", &text.replace("BOUNCES", "6"));
        let total = totally_reflected(&text.replace("BOUNCES", "6"));
        card.holds("totally reflected: more than 40 of 384 pixels", total > 40);
        counts(card, "seen through glass", &film, &text.replace("BOUNCES", "1"), 40);
        counts(card, "after three boundaries", &film, &text.replace("BOUNCES", "2"), 10);
    }

    fn a11_lamps_look_alike_from_any_frame(card) {
        let camera = camera("hfov = 70");
        for kind in ["point", "spot", "sun"] {
            let lamps = ["lab", "two", "eye"].map(|on| lamp(kind, on));
            let room = ROOM.split("[[light]]").next().unwrap();
            let text = |lamps: &[&str]| shot(&[room, &lamps.concat(), &camera]);
            let all = [0, 1, 2].map(|i| lamps[i].as_str());
            let film = moved(card, &format!("{kind}: at rest, moving, the camera's"), &text(&all));
            for (without, rest) in [("first", [1, 2]), ("second", [0, 2]), ("third", [0, 1])] {
                let rest = rest.map(|i| all[i]);
                counts(card, &format!("lit by the {without}"), &film, &text(&rest), 30);
            }
        }
    }

    fn a11_shadows_look_alike_from_any_frame(card) {
        let text = shot(&[BLOCKS, ROOM, &camera("hfov = 70")]);
        let film = moved(card, "blocks on two worldlines before a lamp and a sun", &text.replace("SHADOWS", "auto"));
        counts(card, "in shadow", &film, &text.replace("SHADOWS", "off"), 20);
    }

    fn a11_skies_look_alike_from_any_frame(card) {
        for (what, sky) in [
            ("a spectrum", "spectrum = { points = [[400, 0.01], [500, 0.05], [650, 0.002]] }"),
            ("an image", "image = \"sky.hdr\""),
            ("stars", "stars = { count = 300, size = 10, magnitude = [-30, -28] }"),
        ] {
            let text = shot(&[POND, &camera("hfov = 100"), BEHIND, sky]);
            let film = moved(card, &format!("{what} and its reflection"), &text);
            let lit = film.xyz.iter().filter(|xyz| xyz[1] > 0.0).count();
            card.holds("lit pixels: more than 100", lit > 100);
        }
    }

    fn a11_panoramas_and_domes_look_alike_from_any_frame(card) {
        for projection in ["equirectangular", "fisheye"] {
            let text = shot(&[
                &MIRRORS.replace("BOUNCES", "2"),
                ROOM,
                &camera(&format!("projection = \"{projection}\"")),
            ]);
            moved(card, projection, &text);
        }
    }

    fn a11_bands_look_alike_from_any_frame(card) {
        for (what, window, hot) in [
            ("X-rays", "[0.05, 10]", "1e7"),
            ("microwaves", "[1e6, 1e8]", "3"),
        ] {
            let material = format!(
                "[material.hot]\nthermal = {{ temperature = {hot} }}\ndiffuse = {{ weight = 0.5, spectrum = 1.0 }}\n"
            );
            let text = shot(&[&material, &ROOM.replace("painted", "hot"), &camera("hfov = 70")]);
            let sensor = format!("[sensor]\nwindow = {window}\ncolor = \"bands\"");
            let film = moved(card, what, &text.replace("[sensor]", &sensor));
            let lit = film.xyz.iter().filter(|bands| bands.iter().all(|b| *b > 0.0)).count();
            card.holds("pixels of three bands: more than 60", lit > 60);
        }
    }
}
