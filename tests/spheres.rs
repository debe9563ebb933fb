//! Spheres found in models, and bodies with spheres of another tessellation: areas, volumes and
//! pictures go to those of exact spheres as 4^−level.

use crate::hard_cases::eye::{Eye, sphere, triangles};
use crate::hard_cases::scene::Set;
use glam::DVec3;
use restframe::accel::Aggregate;
use restframe::frame::Frame;
use restframe::model::Mesh;
use restframe::model::{Model, load};
use restframe::render::View;
use restframe::scene::{Geometry, Instance, Scene};
use restframe::study::displacement::{Displacement, displacement_of_spheres};
use restframe::study::spheres::{Sphere, spheres, tessellated};
use restframe::trace::build_aggregate;
use std::f64::consts::PI;
use std::path::Path;
use std::sync::Arc;

const PAINT: &str = "[material.paint]\ndiffuse = { weight = 0.8, spectrum = 1.0 }\n";

fn asset(name: &str) -> Model {
    load(
        &Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("assets")
            .join(name),
        &[],
    )
    .unwrap()
}

fn found(model: &Model) -> Vec<Sphere> {
    model.meshes.iter().flat_map(spheres).collect()
}

/// A mesh of an OBJ file's text.
fn mesh(text: &str) -> Mesh {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("case.obj");
    std::fs::write(&path, text).unwrap();
    load(&path, &[]).unwrap().meshes.remove(0)
}

/// Rings of `sectors` vertices each about the z axis, by height and radius, and lids of one fan.
fn turned(rings: &[(f64, f64)], sectors: usize) -> String {
    let mut text = String::new();
    for (z, radius) in rings {
        for i in 0..sectors {
            let (y, x) = (2.0 * PI * i as f64 / sectors as f64).sin_cos();
            text += &format!("v {:?} {:?} {z:?}\n", x * radius, y * radius);
        }
    }
    let at = |ring: usize, i: usize| 1 + ring * sectors + i % sectors;
    let lid = |ring: usize| -> Vec<usize> { (0..sectors).map(|i| at(ring, i)).collect() };
    let face = |corners: Vec<usize>| {
        let corners: Vec<String> = corners.iter().map(usize::to_string).collect();
        format!("f {}\n", corners.join(" "))
    };
    for ring in 1..rings.len() {
        for i in 0..sectors {
            text += &face(vec![
                at(ring - 1, i),
                at(ring - 1, i + 1),
                at(ring, i + 1),
                at(ring, i),
            ]);
        }
    }
    text += &face(lid(0).into_iter().rev().collect());
    text + &face(lid(rings.len() - 1))
}

/// The bodies of one mesh that stands as it is.
fn geometry(mesh: Mesh) -> Geometry {
    let mut geometry = Geometry::default();
    geometry.meshes.push(Arc::new(mesh));
    geometry.instances.push(Instance {
        mesh: 0,
        worldline: 0,
        model: 0,
        material: 0,
        double_sided: false,
        rest_from_mesh: glam::DAffine3::IDENTITY,
    });
    geometry
}

/// Area, and volume by Gauss's theorem.
fn measures(mesh: &Mesh) -> [f64; 2] {
    let mut sums = [0.0; 2];
    for [a, b, c] in triangles(mesh) {
        let normal = (b - a).cross(c - a);
        sums[0] += normal.length() / 2.0;
        sums[1] += a.dot(normal) / 6.0;
    }
    sums
}

fn close(sphere: &Sphere, center: DVec3, radius: f64) {
    let off = (sphere.center - center).length() + (sphere.radius - radius).abs();
    assert!(off < 1e-6 * radius.max(center.length()), "{sphere:?}");
    assert!(!sphere.inward);
}

#[test]
fn the_spheres_of_the_models_are_found_and_their_bars_are_not() {
    let one = found(&asset("sphere.obj"));
    assert_eq!(one.len(), 1);
    close(&one[0], DVec3::ZERO, 1.0);
    let cell = asset("lattice-cell.obj");
    let in_cell = found(&cell);
    assert_eq!(in_cell.len(), 1);
    close(&in_cell[0], DVec3::ZERO, 0.16);
    assert!(cell.meshes.len() > 1, "bars are meshes of their own");
    for (name, radius) in [("sphere-rows.glb", 0.5), ("sphere-array.glb", 0.35)] {
        let model = asset(name);
        let rows = found(&model);
        assert_eq!(rows.len(), model.meshes.len(), "{name}");
        for sphere in &rows {
            close(sphere, DVec3::ZERO, radius);
        }
    }
}

#[test]
fn a_sphere_is_found_among_other_parts_and_they_stay_as_they_are() {
    // Two spheres and a bar in one mesh, with and without normals.
    let ball = |at: DVec3, radius: f64, first: usize| {
        let text = sphere(12, 24);
        let moved = text.lines().map(|line| {
            let words: Vec<&str> = line.split(' ').collect();
            match words[0] {
                "v" => {
                    let v = [1, 2, 3].map(|i| words[i].parse::<f64>().unwrap());
                    let p = at + DVec3::from(v) * radius;
                    format!("v {:?} {:?} {:?}\n", p.x, p.y, p.z)
                }
                _ => {
                    let f = [1, 2, 3].map(|i| words[i].parse::<usize>().unwrap() + first);
                    format!("f {} {} {}\n", f[0], f[1], f[2])
                }
            }
        });
        moved.collect::<String>()
    };
    let vertices = sphere(12, 24)
        .lines()
        .filter(|l| l.starts_with('v'))
        .count();
    let box_text = turned(&[(-2.0, 0.1), (2.0, 0.1)], 4)
        .lines()
        .map(|line| {
            let Some(rest) = line.strip_prefix("f ") else {
                return format!("{line}\n");
            };
            let moved: Vec<String> = rest
                .split(' ')
                .map(|i| (i.parse::<usize>().unwrap() + 2 * vertices).to_string())
                .collect();
            format!("f {}\n", moved.join(" "))
        })
        .collect::<String>();
    let centers = [DVec3::new(3.0, 1.0, 2.0), DVec3::new(-100.0, 7.0, 1.0)];
    let text = ball(centers[0], 0.25, 0) + &ball(centers[1], 5.0, vertices) + &box_text;
    let plain = mesh(&text);
    let with_normals = Mesh {
        normals: Some(vec![glam::Vec3::X; plain.positions.len()]),
        ..plain.clone()
    };
    for mesh in [plain, with_normals] {
        let two = spheres(&mesh);
        assert_eq!(two.len(), 2);
        close(&two[0], centers[0], 0.25);
        close(&two[1], centers[1], 5.0);
        let bar = |m: &Mesh| -> Vec<[DVec3; 3]> {
            triangles(m)
                .filter(|t| t.iter().all(|p| p.x.hypot(p.y) < 0.11))
                .collect()
        };
        let made = tessellated(&geometry(mesh.clone()), 3).unwrap();
        let made = &made.meshes[0];
        assert_eq!(bar(made), bar(&mesh));
        assert_eq!(made.triangles.len(), bar(&mesh).len() + 2 * 20 * 64);
        let used: std::collections::HashSet<u32> =
            made.triangles.iter().flatten().copied().collect();
        assert_eq!(used.len(), made.positions.len());
        // The bar keeps the normals it had: its triangles' own where it had none.
        let normals = made.normals.as_ref().unwrap();
        for t in made.triangles.iter().take(bar(&mesh).len()) {
            let [a, b, c] = t.map(|i| made.positions[i as usize]);
            let flat = (b - a).cross(c - a).normalize();
            let expected = if mesh.normals.is_some() {
                DVec3::X
            } else {
                flat
            };
            for i in t {
                assert!((normals[*i as usize].as_dvec3() - expected).length() < 1e-7);
            }
        }
    }
}

#[test]
fn boxes_cylinders_ellipsoids_and_cut_spheres_are_no_spheres() {
    let stretched = |by: f64| {
        let mut mesh = mesh(&sphere(16, 32));
        mesh.positions.iter_mut().for_each(|p| p.z *= by);
        mesh
    };
    assert_eq!(spheres(&stretched(1.0)).len(), 1);
    let half = 0.5_f64.sqrt();
    let mut cut: Vec<(f64, f64)> = (3..=29)
        .map(|i| (PI * f64::from(i) / 32.0).sin_cos())
        .map(|(sin, cos)| (-cos, sin))
        .collect();
    let mut bodies = vec![
        ("ellipsoid", stretched(1.001)),
        ("flat ellipsoid", stretched(0.5)),
        ("cut sphere", mesh(&turned(&cut, 32))),
    ];
    cut.truncate(14);
    bodies.push(("bowl", mesh(&turned(&cut, 32))));
    // An open sphere, and one torn along an edge.
    let mut open = stretched(1.0);
    open.triangles.pop();
    bodies.push(("open sphere", open));
    for sectors in [4, 6, 12, 64] {
        for (half_length, radius) in [
            (half, half),
            (1.0, 0.3),
            (0.01, 1.0),
            (0.8, 0.6),
            (0.6, 0.8),
        ] {
            let rings = [(-half_length, radius), (half_length, radius)];
            bodies.push(("cylinder", mesh(&turned(&rings, sectors))));
        }
    }
    for (name, body) in bodies {
        assert_eq!(spheres(&body), Vec::new(), "{name}");
        assert_eq!(tessellated(&geometry(body), 2), None, "{name}");
    }
}

#[test]
fn a_sphere_whose_front_is_inside_stays_so() {
    let mut hollow = mesh(&sphere(12, 24));
    hollow.triangles.iter_mut().for_each(|t| t.reverse());
    assert!(spheres(&hollow)[0].inward);
    let made = tessellated(&geometry(hollow), 2).unwrap();
    let mesh = &made.meshes[0];
    assert!(measures(mesh)[1] < 0.0);
    for (position, normal) in mesh.positions.iter().zip(mesh.normals.as_ref().unwrap()) {
        assert!((normal.as_dvec3() + *position).length() < 1e-7);
    }
    assert!(spheres(mesh)[0].inward);
}

#[test]
fn areas_and_volumes_go_to_those_of_the_sphere_as_a_fourth_a_level() {
    let original = geometry(asset("lattice-cell.obj").meshes.remove(0));
    let radius: f64 = 0.16;
    let exact = [4.0 * PI * radius.powi(2), 4.0 / 3.0 * PI * radius.powi(3)];
    let lacking = |level: u32| {
        let made = tessellated(&original, level).unwrap();
        let mesh = &made.meshes[0];
        assert_eq!(mesh.triangles.len(), 20 << (2 * level));
        assert_eq!(mesh.positions.len(), (10 << (2 * level)) + 2);
        assert_eq!(mesh.material, original.meshes[0].material);
        let again = spheres(mesh);
        assert_eq!(again.len(), 1, "found again at level {level}");
        let of = measures(mesh);
        [0, 1].map(|i| 1.0 - of[i] / exact[i])
    };
    let mut coarser = lacking(0);
    // Area and volume of an icosahedron in a sphere.
    assert!(
        (coarser[0] - 0.238).abs() < 1e-3 && (coarser[1] - 0.395).abs() < 1e-3,
        "{coarser:?}"
    );
    for level in 1..=6_i32 {
        let finer = lacking(level as u32);
        for (coarse, fine) in coarser.iter().zip(finer) {
            let ratio = coarse / fine;
            // 4 but for terms of the next order, which fall by 4 as well. At level 6 the file's six
            // decimals have left the radius uncertain by 1 % of what is lacking.
            let order = 4.0_f64.powi(-level);
            let bound = 4.0 * order + 0.05;
            assert!((ratio - 4.0).abs() < bound, "level {level}: {ratio}");
        }
        coarser = finer;
    }
}

/// A ball that flies by, tessellated at some levels, against one of level 8.
fn displaced(levels: &[u32]) -> Vec<Displacement> {
    let set = Set::new(&format!(
        "[image]\nsize = [320, 240]\n{PAINT}[worldline.fast]\nvelocity = [0.6, 0.1, -0.5]\n\
         [[model]]\nfile = \"ball.obj\"\nmaterial = \"paint\"\nworldline = \"fast\"\nscale = [1, 1.2, 0.9]\n\
         [camera]\nposition = [0, 0, 3]\nhfov = 60\n",
    ));
    let shot = &set.prepared.shot;
    let original = set.scene();
    let of = |level: u32| {
        let geometry = Arc::new(tessellated(&original.geometry, level).unwrap());
        let scene = Scene {
            geometry,
            ..original.clone()
        };
        let aggregate = build_aggregate(&scene.geometry, None);
        (scene, aggregate)
    };
    let finest = of(8);
    let view = |of: &(Scene, Aggregate), look: &dyn Fn(&View<'_>) -> Displacement| {
        look(&View::new(
            &Frame::new(shot, 1).unwrap(),
            &shot.effects,
            &of.0,
            &of.1,
        ))
    };
    levels
        .iter()
        .map(|&level| {
            let coarse = of(level);
            view(&finest, &|reference| {
                view(&coarse, &|other| {
                    displacement_of_spheres(reference, other, shot.image.size)
                })
            })
        })
        .collect()
}

#[test]
fn spheres_are_displaced_a_fourth_as_far_a_level_and_mistaken_in_fewer_pixels() {
    let levels = displaced(&[1, 3, 6]);
    let [coarse, middle, fine] = [0, 1, 2].map(|i| &levels[i]);
    for (coarse, fine) in [
        (middle.pixels.mean, fine.pixels.mean),
        (middle.pixels.p99, fine.pixels.p99),
    ] {
        let ratio = coarse / fine;
        assert!((50.0..80.0).contains(&ratio), "{ratio}");
    }
    assert!(coarse.mistaken > 4.0 * middle.mistaken && middle.mistaken > fine.mistaken);
}

/// Where a camera is at time 0.
const EYE: DVec3 = DVec3::new(0.4, 0.7, 1.2);

/// Where a pinhole there shows a place in the rest frame of something that passes the origin
/// at time 0 with speed β along x: in tangents to the right and up. Its way through the lab is met by
/// the light that arrives at time 0.
fn shown(place: DVec3, beta: f64) -> [f64; 2] {
    let shrink = (1.0 - beta * beta).sqrt();
    let start = DVec3::new(place.x * shrink, place.y, place.z) - EYE;
    // |start + βt|² = t² and t < 0.
    let along = beta * start.x;
    let time =
        (along - (along * along + (shrink * start.length()).powi(2)).sqrt()) / shrink.powi(2);
    let seen = start + DVec3::X * (beta * time);
    [seen.x / -seen.z, seen.y / -seen.z]
}

/// In pixels, what the six decimals of the file leave of doubt about the center, as the camera sees it.
const CENTER: f64 = 2e-5;

#[test]
fn the_displacement_of_a_moving_sphere_is_that_of_its_way_through_the_lab() {
    for beta in [0.0, 0.5, -0.9] {
        let set = Set::new(&format!(
            "[image]\nsize = [9, 7]\n{PAINT}[worldline.fast]\nvelocity = [{beta:?}, 0, 0]\n\
             [[model]]\nfile = \"ball.obj\"\nmaterial = \"paint\"\nworldline = \"fast\"\nscale = 3\n\
             [camera]\nposition = {:?}\nhfov = 90\n",
            EYE.to_array()
        ));
        let mut scene = set.scene();
        scene.geometry = Arc::new(tessellated(&scene.geometry, 1).unwrap());
        let eye = Eye::of(&set, 1, scene);
        let view = eye.view();
        let mut worst = 0.0_f64;
        for pixel in 0..63 {
            let point = [f64::from(pixel % 9) + 0.5, f64::from(pixel / 9) + 0.5];
            let fraction = [point[0] / 9.0, point[1] / 7.0];
            let direction = eye.scene.camera.looks_along(fraction).unwrap();
            let hit = eye.meets(&view, &[direction])[0].unwrap().hit;
            let geometry = &eye.scene.geometry;
            let found = geometry
                .surface_point(hit.instance, hit.triangle, hit.weights)
                .position;
            let at = |place: DVec3| {
                let [right, up] = shown(place, beta);
                DVec3::new(4.5 * (1.0 + right), 3.5 - 4.5 * up, 0.0)
            };
            let center = DVec3::new(point[0], point[1], 0.0);
            // What was found is what the pixel sees; the sphere about it is elsewhere.
            assert!((at(found) - center).length() < 1e-12);
            worst = worst.max((at(found.normalize() * 3.0) - center).length());
        }
        let measured = displacement_of_spheres(&view, &view, [9, 7]);
        assert!(
            (measured.pixels.worst - worst).abs() < CENTER * (1.0 + worst),
            "{beta} {worst} {measured:?}"
        );
        assert_eq!((measured.mistaken, worst > 1e-3), (0.0, true), "{worst}");
    }
}
