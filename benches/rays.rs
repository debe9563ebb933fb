//! Primary and shadow rays through the single-ray interface of the aggregate: a shell of one mesh, and
//! rows of a thousand instances.

mod shell;

use divan::{Bencher, counter::ItemsCount};
use glam::{DAffine3, DVec3};
use restframe::accel::{Aggregate, Ray};
use restframe::scene::{Geometry, Scene};
use restframe::trace::build_aggregate;
use shell::shell;
use std::sync::Arc;

fn main() {
    divan::main();
}

fn rays(origin: DVec3) -> Vec<Ray> {
    (0..4096)
        .map(|i| {
            let (x, y) = (
                f64::from(i % 64) / 32.0 - 1.0,
                f64::from(i / 64) / 32.0 - 1.0,
            );
            Ray {
                origin,
                direction: DVec3::new(x, 0.5625 * y, -1.0).normalize(),
            }
        })
        .collect()
}

/// The shell's sphere, a thousand times at a pitch of 25.
fn rows(scene: &Scene) -> (Geometry, usize) {
    let one = scene.geometry.instances[0];
    let mut geometry = Geometry::default();
    geometry.meshes.clone_from(&scene.geometry.meshes);
    for i in 0..1000 {
        let at = DVec3::new(
            f64::from(i % 10),
            f64::from(i / 10 % 10),
            f64::from(i / 100),
        ) * 25.0;
        let rest_from_mesh =
            DAffine3::from_translation(at - DVec3::new(112.0, 112.0, 300.0)) * one.rest_from_mesh;
        geometry.instances.push(restframe::scene::Instance {
            rest_from_mesh,
            ..one
        });
    }
    (geometry, one.worldline as usize)
}

fn nearest(bencher: Bencher<'_, '_>, aggregate: &Aggregate, worldline: usize) {
    let rays = rays(DVec3::ZERO);
    bencher
        .counter(ItemsCount::new(rays.len()))
        .bench_local(|| {
            rays.iter()
                .filter_map(|ray| aggregate.intersect_ray(worldline, ray, f64::INFINITY))
                .map(|hit| hit.t)
                .sum::<f64>()
        });
}

/// Shadow rays from what primary rays hit to a lamp at the origin of the shell.
fn blocked(bencher: Bencher<'_, '_>, aggregate: &Aggregate, worldline: usize) {
    let lamp = DVec3::new(0.0, 3.0, 1.0);
    let towards_lamp: Vec<(Ray, f64)> = rays(DVec3::ZERO)
        .iter()
        .filter_map(|ray| {
            let hit = aggregate.intersect_ray(worldline, ray, f64::INFINITY)?;
            let from = ray.direction * hit.t * (1.0 - 1e-9);
            let path = lamp - from;
            Some((
                Ray {
                    origin: from,
                    direction: path.normalize(),
                },
                path.length(),
            ))
        })
        .collect();
    bencher
        .counter(ItemsCount::new(towards_lamp.len()))
        .bench_local(|| {
            towards_lamp
                .iter()
                .filter(|(ray, reach)| aggregate.occludes_ray(worldline, ray, *reach))
                .count()
        });
}

#[divan::bench]
fn primary_shell(bencher: Bencher<'_, '_>) {
    let (_, scene, aggregate) = shell(0.0, "shell", "", "");
    nearest(
        bencher,
        &aggregate,
        scene.geometry.instances[0].worldline as usize,
    );
}

#[divan::bench]
fn primary_rows(bencher: Bencher<'_, '_>) {
    let (_, scene, _) = shell(0.0, "shell", "", "");
    let (geometry, worldline) = rows(&scene);
    nearest(bencher, &build_aggregate(&geometry, None), worldline);
}

#[divan::bench]
fn shadow_shell(bencher: Bencher<'_, '_>) {
    let (_, scene, aggregate) = shell(0.0, "shell", "", "");
    blocked(
        bencher,
        &aggregate,
        scene.geometry.instances[0].worldline as usize,
    );
}

#[divan::bench]
fn shadow_rows(bencher: Bencher<'_, '_>) {
    let (_, scene, _) = shell(0.0, "shell", "", "");
    let (geometry, worldline) = rows(&scene);
    blocked(bencher, &build_aggregate(&geometry, None), worldline);
}

#[divan::bench]
fn build_aggregate_of_rows(bencher: Bencher<'_, '_>) {
    let (_, scene, _) = shell(0.0, "shell", "", "");
    let geometry = Arc::new(rows(&scene).0);
    bencher.bench_local(|| build_aggregate(&geometry, None));
}
