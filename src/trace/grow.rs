//! Shade trees beyond their first surface: what is seen in mirrors and through glass.
//!
//! The branch that may carry the most light is followed first, until none is left that carries
//! more than the cut-off, is not too deep, and fits the tree. So what is left out is the least,
//! and its share is known.

use super::flight::Flight;
use super::optics::{Boundary, boundary, reflected};
use super::surface::Place;
use super::tree::{Branch, Node, Seen};
use super::{Nearest, ShadeTrees, Tracer};
use crate::scene::Material;
use glam::DVec3;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// Most nodes of one tree: what two facing mirrors and glass between them may fill.
const MOST_NODES: u32 = 1000;

/// A branch that is still to be followed.
struct Bud {
    /// At most this share of the light that arrives by it reaches the camera.
    bound: f64,
    /// How many were found before it: of equal ones the first is followed first.
    number: u32,
    depth: u32,
    flight: Flight,
    parent: u32,
    lobe: u32,
    share: f64,
    /// D from the surface it leaves to the camera.
    doppler: f64,
}

/// Buds of one tree.
#[derive(Default)]
pub(super) struct Buds {
    waiting: BinaryHeap<Bud>,
    found: u32,
}

/// Follows the branches of the surface at `place`, the tree's first node. Returns the share of
/// light that was cut off.
pub(super) fn grow(
    tracer: &Tracer<'_>,
    place: &Place,
    material: &Material,
    buds: &mut Buds,
    trees: &mut ShadeTrees,
) -> f64 {
    let first = trees.nodes.len() - 1;
    let mut cut = 0.0;
    let camera = Stem {
        bound: 1.0,
        depth: 0,
        node: 0,
        doppler: trees.nodes[first].doppler,
        slowness: 1.0,
    };
    cut += buds.sprout(tracer, place, material, &camera);
    while let Some(bud) = buds.waiting.pop() {
        let node = (trees.nodes.len() - first) as u32;
        if node >= MOST_NODES {
            cut += bud.bound;
            continue;
        }
        let Some(nearest) = tracer.nearest(&bud.flight) else {
            add_sky(tracer, &bud, trees);
            continue;
        };
        let doppler = held(bud.doppler / nearest.frequency_ratio);
        let branch = Branch {
            parent: bud.parent,
            lobe: bud.lobe,
            share: bud.share,
            doppler: 1.0 / nearest.frequency_ratio,
        };
        let material = tracer.material(&nearest);
        let place = tracer.place(&nearest, material);
        tracer.add_surface(&nearest, place.as_ref(), Some(branch), doppler, trees);
        if let Some(place) = place.filter(|_| material.passes_light_on()) {
            let stem = Stem {
                bound: bud.bound,
                depth: bud.depth,
                node,
                doppler,
                slowness: if place.worldline == bud.flight.worldline {
                    bud.flight.slowness
                } else {
                    1.0
                },
            };
            cut += buds.sprout(tracer, &place, material, &stem);
        }
    }
    buds.found = 0;
    cut
}

fn add_sky(tracer: &Tracer<'_>, bud: &Bud, trees: &mut ShadeTrees) {
    if let Some((direction, to_surface)) = tracer.sky(bud.flight.worldline, bud.flight.direction) {
        trees.nodes.push(Node {
            branch: Some(Branch {
                parent: bud.parent,
                lobe: bud.lobe,
                share: bud.share,
                doppler: to_surface,
            }),
            doppler: held(bud.doppler * to_surface),
            seen: Seen::Sky(direction),
        });
    }
}

/// A Doppler factor of many surfaces, held finite and above 0: infinitely much of nothing would be
/// no number.
fn held(doppler: f64) -> f64 {
    doppler.clamp(f64::MIN_POSITIVE, f64::MAX)
}

/// Where branches leave from.
struct Stem {
    bound: f64,
    depth: u32,
    node: u32,
    doppler: f64,
    /// Of the medium in front of the surface.
    slowness: f64,
}

impl Buds {
    /// Adds the branches of a surface that are worth following; returns the share of the others.
    fn sprout(
        &mut self,
        tracer: &Tracer<'_>,
        place: &Place,
        material: &Material,
        stem: &Stem,
    ) -> f64 {
        let mut cut = 0.0;
        for ray in passed_on(place, material, stem.slowness) {
            let bound = stem.bound * ray.most;
            if bound <= tracer.cutoff || stem.depth >= tracer.bounces {
                cut += bound;
                continue;
            }
            self.waiting.push(Bud {
                bound,
                number: self.found,
                depth: stem.depth + 1,
                flight: Flight {
                    worldline: place.worldline,
                    start: place.beside(ray.beyond),
                    direction: ray.direction,
                    slowness: ray.slowness,
                },
                parent: stem.node,
                lobe: ray.lobe,
                share: ray.share,
                doppler: stem.doppler,
            });
            self.found += 1;
        }
        cut
    }
}

/// Light that a surface passes on.
struct Passed {
    /// Position of the lobe among the material's.
    lobe: u32,
    /// Share that the lobe is given.
    share: f64,
    /// The share times the lobe's reflectance or transmittance at its highest.
    most: f64,
    direction: DVec3,
    /// Whether it comes from the other side of the surface.
    beyond: bool,
    slowness: f64,
}

/// The branches of a surface: by Fresnel's shares where it has an index of refraction. Where
/// reflection is total, the refraction's own light is what is reflected.
fn passed_on(place: &Place, material: &Material, slowness: f64) -> impl Iterator<Item = Passed> {
    let d = place.incoming;
    let flat = place.point.flat_normal;
    let glass = material.bsdf.refraction();
    let ior = glass.map(|(.., ior)| ior);
    // On the viewer's side and beyond. Behind a boundary is its glass, however the ray came there.
    let [slowness, slowness_beyond] = match ior {
        Some(ior) if !place.front => [ior, 1.0],
        Some(ior) => [slowness, ior],
        None => [slowness; 2],
    };
    let at_boundary = |n: DVec3| {
        let outwards = |ior: f64| if place.front { 1.0 / ior } else { ior };
        ior.map(|ior| boundary(d, n, outwards(ior)))
    };
    // Interpolated normals may turn away from the viewer, or send light to the wrong side.
    let usable = |n: DVec3| {
        let stays = d.dot(n) < 0.0 && reflected(d, n).dot(flat) > 0.0;
        stays
            && match at_boundary(n) {
                Some(Boundary::Passing { direction, .. }) => direction.dot(flat) < 0.0,
                Some(Boundary::Total) | None => true,
            }
    };
    let normal = if usable(place.point.normal) {
        place.point.normal
    } else {
        flat
    };
    let mirrored = |lobe: usize, share, most| Passed {
        lobe: lobe as u32,
        share,
        most: share * most,
        direction: reflected(d, normal),
        beyond: false,
        slowness,
    };
    let mirror = |share| {
        let (lobe, mirror) = material.bsdf.mirror()?;
        Some(mirrored(lobe, share, mirror.reflectance.most()))
    };
    let Some((boundary, (lobe, glass, _))) = at_boundary(normal).zip(glass) else {
        return [mirror(1.0), None].into_iter().flatten();
    };
    let most = glass.reflectance.most();
    match boundary {
        Boundary::Total => [Some(mirrored(lobe, 1.0, most)), None],
        Boundary::Passing {
            direction,
            reflected,
        } => {
            let through = Passed {
                lobe: lobe as u32,
                share: 1.0 - reflected,
                most: (1.0 - reflected) * most,
                direction,
                beyond: true,
                slowness: slowness_beyond,
            };
            [Some(through), mirror(reflected)]
        }
    }
    .into_iter()
    .flatten()
}

impl Ord for Bud {
    fn cmp(&self, other: &Self) -> Ordering {
        self.bound
            .total_cmp(&other.bound)
            .then(other.number.cmp(&self.number))
    }
}

impl PartialOrd for Bud {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Bud {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Bud {}

impl Tracer<'_> {
    /// What a ray from a surface meets first.
    fn nearest(&self, flight: &Flight) -> Option<Nearest> {
        let mut best: Option<Nearest> = None;
        for worldline in self.stage.worldlines() {
            let Some(rest) = flight.among(worldline, self.spacetime) else {
                continue;
            };
            let reach = best.as_ref().map_or(f64::INFINITY, |n| n.s * rest.stretch);
            if let Some(hit) = self.stage.nearest(worldline, &rest.ray, reach) {
                let s = hit.t / rest.stretch;
                if best.as_ref().is_none_or(|n| s < n.s) {
                    best = Some(Nearest {
                        s,
                        hit,
                        time: rest.time_at(hit.t, self.spacetime),
                        direction: rest.ray.direction,
                        frequency_ratio: rest.frequency_ratio,
                    });
                }
            }
        }
        best
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::relativity::Event;
    use crate::scene::{Bsdf, Lobe, LobeKind, Reflectance, SurfacePoint};
    use crate::spectrum::Spectrum;
    use proptest::prelude::*;
    use std::sync::Arc;

    /// A surface of flat normal +z that is met from `front` or behind.
    fn place(incoming: DVec3, normal: DVec3, front: bool) -> Place {
        Place {
            worldline: 0,
            event: Event::new(0.0, DVec3::ZERO),
            point: SurfacePoint {
                position: DVec3::ZERO,
                flat_normal: DVec3::Z,
                normal,
                bulge: DVec3::ZERO,
                clearance: 1e-13,
            },
            incoming,
            front,
        }
    }

    fn glass(ior: f64) -> Material {
        let all = Reflectance {
            weight: 1.0,
            spectrum: Arc::new(Spectrum::Constant(1.0)),
        };
        let lobe = |kind| Lobe {
            kind,
            reflectance: all.clone(),
        };
        let lobes = [LobeKind::Mirror, LobeKind::Refraction { ior }].map(lobe);
        Material {
            bsdf: Bsdf::new(lobes.to_vec()),
            ..Material::default()
        }
    }

    #[test]
    fn light_reflected_inside_glass_is_slow_however_it_came_there() {
        // From a camera inside, whose rays are those of light in vacuum.
        let steep = DVec3::new(0.9, 0.0, -0.19_f64.sqrt());
        let rays: Vec<Passed> =
            passed_on(&place(steep, DVec3::Z, false), &glass(1.5), 1.0).collect();
        assert_eq!(rays.len(), 1, "total reflection");
        assert_eq!(rays[0].slowness, 1.5);
        let outside: Vec<f64> = passed_on(&place(steep, DVec3::Z, true), &glass(1.5), 1.0)
            .map(|ray| ray.slowness)
            .collect();
        assert_eq!(outside, [1.5, 1.0]);
    }

    proptest! {
        /// Corners of coarse round bodies have normals far from their triangles'.
        #[test]
        fn light_goes_on_to_its_own_side_whatever_the_vertex_normals(
            way in prop::array::uniform3(-1.0..1.0_f64),
            normal in prop::array::uniform3(-1.0..1.0_f64),
            front in any::<bool>(),
            ior in 1.0..4.0_f64,
        ) {
            let incoming = DVec3::from(way).normalize_or(DVec3::NEG_Z);
            let normal = DVec3::from(normal).normalize_or(DVec3::Z);
            prop_assume!(incoming.z < -1e-6);
            for ray in passed_on(&place(incoming, normal, front), &glass(ior), 1.0) {
                prop_assert_eq!(ray.direction.z < 0.0, ray.beyond, "{:?}", ray.direction);
            }
        }
    }
}
