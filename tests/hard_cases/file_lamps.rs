//! E. Lamps and glowing surfaces of model files: how bright they are, and of which white.

use super::scene::Set;
use restframe::color::spaces::{RGB_FROM_XYZ, XYZ_FROM_RGB, apply};
use restframe::probe::Probe;
use std::f64::consts::PI;

/// What the white of D65's table differs by from that of Rec. 709, rounded to four digits, and
/// with it every colour, of its greatest component.
const WHITE: f64 = 3e-4;

/// Sums over wavelengths are exact to this.
const EXACT: f64 = 1e-9;

/// Rounding of the shapes of two curves, held in f32, and of what they are compared with.
const SHAPE: f64 = 4.0 * f32::EPSILON as f64;

/// Digits of Cycles' answers, and its noise.
const CYCLES: f64 = 1e-4;

/// Colours of lamps as files have them: bulbs, a portal, and what no bulb has.
const COLORS: [[f64; 3]; 4] = [
    [1.0, 0.85, 0.6],
    [1.0, 0.4, 0.2],
    [0.0, 0.0, 1.0],
    [0.3, 0.7, 0.02],
];

const BLENDER: &str = "Khronos glTF Blender I/O v4.5.51";

/// Corners of a triangle about the origin, (−2, −1, 0), (2, −1, 0) and (0, 3, 0).
const TRIANGLE: &str = "AAAAwAAAgL8AAAAAAAAAQAAAgL8AAAAAAAAAAAAAQEAAAAAA";

/// A glTF file of one lamp 4 m up the z axis that looks down it.
fn lamp(kind: &str, intensity: f64, [r, g, b]: [f64; 3]) -> String {
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],
"nodes":[{{"translation":[0,0,4],"extensions":{{"KHR_lights_punctual":{{"light":0}}}}}}],
"extensionsUsed":["KHR_lights_punctual"],"extensions":{{"KHR_lights_punctual":{{"lights":[
{{"type":"{kind}","intensity":{intensity:?},"color":[{r},{g},{b}],"spot":{{"innerConeAngle":0.3}}}}]}}}}}}"#
    )
}

/// A glTF file of a triangle that glows, by whatever program.
fn glow(generator: &str, [r, g, b]: [f64; 3], strength: f64) -> String {
    format!(
        r#"{{"asset":{{"version":"2.0","generator":"{generator}"}},"scene":0,"scenes":[{{"nodes":[0]}}],
"nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"material":0}}]}}],
"buffers":[{{"byteLength":36,"uri":"data:application/octet-stream;base64,{TRIANGLE}"}}],
"bufferViews":[{{"buffer":0,"byteLength":36}}],"accessors":[{{"bufferView":0,"componentType":5126,
"count":3,"type":"VEC3","min":[-2,-1,0],"max":[2,3,0]}}],"extensionsUsed":["KHR_materials_emissive_strength"],
"materials":[{{"name":"glow","pbrMetallicRoughness":{{"baseColorFactor":[0,0,0,1],"metallicFactor":0}},
"emissiveFactor":[{r},{g},{b}],"extensions":{{"KHR_materials_emissive_strength":{{"emissiveStrength":{strength}}}}}}}]}}"#
    )
}

/// One pixel that looks along −z from z = 3.
const HEAD: &str = "[image]\nsize = [1, 1]\nsamples = 1\n[camera]\nposition = [0, 0, 3]\n\
    hfov = 1e-6\n[sensor]\nexposure = 0\n[accuracy]\nspectra = \"exact\"\n";

/// A card of the lab before the camera, and `rest`, which lights it.
fn card_under(files: &[(&str, &str)], paint: &str, rest: &str) -> Probe {
    let text = format!(
        "{HEAD}[[model]]\nfile = \"wall.obj\"\nmaterial = \"card\"\n\
         [material.card]\ndiffuse = {{ spectrum = {paint} }}\n{rest}"
    );
    Set::with(files, &text).probe([0, 0])
}

/// A white card under the lamp of a file, with further `keys` of its model.
fn under_file(file: &str, keys: &str) -> Probe {
    let rest = format!("[[model]]\nfile = \"lamp.gltf\"\n{keys}");
    card_under(&[("lamp.gltf", file)], "1.0", &rest)
}

/// What is seen of a model file that is there already, or of one with its library.
fn seen(files: &[(&str, &str)], file: &str, rest: &str) -> Probe {
    let text = format!("{HEAD}[[model]]\nfile = \"{file}\"\n{rest}");
    Set::with(files, &text).probe([0, 0])
}

/// A scene that Blender wrote.
fn by_blender(name: &str) -> Probe {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/models");
    seen(&[], &format!("{folder}/{name}.glb"), "")
}

/// Linear RGB in cd/m² of white.
fn rgb(probe: &Probe) -> [f64; 3] {
    apply(&RGB_FROM_XYZ, probe.xyz)
}

/// How far the components of a color are from `exact`, over its greatest.
fn off(found: [f64; 3], exact: [f64; 3]) -> f64 {
    let greatest = exact.into_iter().fold(0.0, f64::max);
    let each = (0..3).map(|i| (found[i] - exact[i]).abs() / greatest);
    each.fold(0.0, f64::max)
}

/// The most that a ratio of radiances differs from `factor` at any wavelength.
fn unlike(one: &Probe, other: &Probe, factor: f64) -> f64 {
    let pairs = one.radiance.iter().zip(&other.radiance);
    pairs
        .map(|(a, b)| (a / b / factor - 1.0).abs())
        .fold(0.0, f64::max)
}

fn luminance(color: [f64; 3]) -> f64 {
    (0..3).map(|i| XYZ_FROM_RGB[1][i] * color[i]).sum()
}

cases! {
    /// A lamp of I cd at r = 4 m gives a white card I/(πr²) cd/m², of E lx E/π, and looks like
    /// D65 of the shot: the same sums.
    fn e13_a_white_lamp_of_a_file_is_a_lamp_of_the_shot(card) {
        for (kind, named, exact) in [
            ("point", "point", 100.0 / (16.0 * PI)),
            ("spot", "spot", 100.0 / (16.0 * PI)),
            ("directional", "sun", 100.0 / PI),
        ] {
            let place = match named {
                "point" => "position = [0, 0, 4]",
                "spot" => "position = [0, 0, 4]\ndirection = [0, 0, -1]\ninner = 17",
                _ => "direction = [0, 0, -1]",
            };
            let file = lamp(kind, 100.0, [1.0; 3]);
            let own = |velocity: &str| {
                let rest = format!("[[light]]\nkind = \"{named}\"\nworldline = \"own\"\n{place}\nintensity = 100\n[worldline.own]\nvelocity = {velocity}\n");
                card_under(&[], "1.0", &rest)
            };
            let of_file = |velocity: &str| under_file(&file, &format!("worldline = \"own\"\n[worldline.own]\nvelocity = {velocity}\n"));
            let (found, still) = (of_file("[0, 0, 0]"), "[0, 0, 0]");
            card.relative(&format!("luminance under 100 of a {named}, cd/m²"), exact, found.xyz[1], EXACT);
            card.at_most(&format!("its color from grey, {named}"), off(rgb(&found), [exact; 3]), WHITE);
            card.same(&format!("as of a {named} of the shot"), own(still).xyz[1], found.xyz[1]);
            let coming = "[0, 0, -0.6]";
            card.at_most(
                &format!("as it at every wavelength, {named} at 0.6 c"),
                unlike(&of_file(coming), &own(coming), 1.0),
                4.0 * f64::EPSILON,
            );
        }
    }

    /// Times the luminance of its colour; and what it sheds on white is what white light leaves of
    /// paint in that colour.
    fn e14_a_colored_lamp_has_its_color_and_the_luminance_of_it(card) {
        let white = lamp("point", 100.0, [1.0; 3]);
        for color in COLORS {
            let found = under_file(&lamp("point", 100.0, color), "");
            let exact = 100.0 / (16.0 * PI);
            card.relative(&format!("luminance under {color:?}, cd/m²"), exact * luminance(color), found.xyz[1], EXACT);
            card.at_most("its color", off(rgb(&found), color.map(|part| exact * part)), WHITE);
            let rest = "[[model]]\nfile = \"lamp.gltf\"\n";
            let paint = card_under(&[("lamp.gltf", &white)], &format!("{{ rgb = {color:?} }}"), rest);
            let factor = found.xyz[1] / paint.xyz[1];
            card.near("and that of paint in it", 1.0, factor, WHITE);
            card.at_most("spectrally", unlike(&found, &paint, factor), SHAPE);
        }
    }

    /// 683 lm make a watt; a point of W watts has W/4π W/sr.
    fn e15_light_units_say_what_the_numbers_are(card) {
        for (kind, unitless, raw) in [
            ("point", 683.0, 683.0 / (4.0 * PI)),
            ("spot", 683.0, 683.0 / (4.0 * PI)),
            ("directional", 683.0, 683.0),
        ] {
            let file = lamp(kind, 3.0, [1.0, 0.85, 0.6]);
            let standard = under_file(&file, "");
            for (units, factor) in [("standard", 1.0), ("unitless", unitless), ("raw", raw)] {
                let found = under_file(&file, &format!("light_units = \"{units}\"\n"));
                card.relative(
                    &format!("\"{units}\" over what is unsaid, {kind}"),
                    factor,
                    found.xyz[1] / standard.xyz[1],
                    8.0 * f64::EPSILON,
                );
            }
        }
    }

    /// Emission 1 is 683 cd/m² in Blender's files, 1 cd/m² in others, whatever its colour.
    fn e16_what_glows_in_a_file_has_factor_times_strength(card) {
        let color = [1.0, 0.5, 0.25];
        for (by, generator, unit) in [("Blender", BLENDER, 683.0), ("others", "some program", 1.0)] {
            let file = glow(generator, color, 5.0);
            let found = seen(&[("glow.gltf", &file)], "glow.gltf", "");
            let exact = color.map(|part| 5.0 * unit * part);
            card.relative(&format!("luminance of a glTF file by {by}, cd/m²"), luminance(exact), found.xyz[1], EXACT);
            card.at_most(&format!("its color, by {by}"), off(rgb(&found), exact), WHITE);
        }
        for (by, head, unit) in [
            ("Blender", "# Blender 4.5.15 LTS MTL File: 'None'\n# www.blender.org\n\n", 683.0),
            ("others", "# by hand, not by Blender\n", 1.0),
        ] {
            let library = format!("{head}newmtl glow\nKd 0 0 0\nKe 5 2.5 1.25\n");
            let model = "mtllib glow.mtl\nv -1 -1 0\nv 1 -1 0\nv 0 2 0\nusemtl glow\nf 1 2 3\n";
            let found = seen(&[("glow.obj", model), ("glow.mtl", &library)], "glow.obj", "");
            let exact = 5.0 * unit * luminance(color);
            card.relative(&format!("of an OBJ file by {by}"), exact, found.xyz[1], EXACT);
        }
        let glowing = |strength: f64, rest: &str| {
            let file = glow("", [0.5, 0.25, 0.125], strength);
            let moving = "worldline = \"own\"\n[worldline.own]\nvelocity = [0, 0, 0.5]\n";
            seen(&[("glow.gltf", &file)], "glow.gltf", &format!("{moving}{rest}"))
        };
        let once = glowing(1.0, "");
        card.at_most("8 times the strength: 8 times the light, at 0.5 c", unlike(&glowing(8.0, ""), &once, 8.0), 1e-12);
        let halved = glowing(1.0, "[material.glow]\nemission = { scale = 0.5 }\n");
        card.at_most("half of it where the shot says so", unlike(&halved, &once, 0.5), 1e-12);
    }

    /// Blender 4.5.15's path tracer, at the picture's centre: a wall of albedo ½ under 100 W at
    /// 2 m and under a sun of 1 W/m², and one that glows.
    fn e17_scenes_by_blender_are_683_times_what_cycles_renders(card) {
        for (name, cycles) in [
            ("units-point", [0.316607; 3]),
            ("units-spot", [0.316607; 3]),
            ("units-sun", [0.159155; 3]),
            ("units-emissive", [5.0, 2.5, 1.25]),
        ] {
            let found = by_blender(name);
            let exact = cycles.map(|value| 683.0 * value);
            card.relative(&format!("luminance of {name}, cd/m²"), luminance(exact), found.xyz[1], CYCLES);
            card.at_most(&format!("color of {name}"), off(rgb(&found), exact), WHITE + CYCLES);
        }
    }
}
