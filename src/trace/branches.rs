//! The branches of a shade tree: what is seen in mirrors and through glass.
//!
//! Of each tree the branch that may carry the most light is followed first, until none is left that
//! carries more than the cut-off, is not too deep, and fits the tree. So what is left out is the
//! least, and its share is known.

use super::interaction::Interaction;
use super::optics::{Boundary, boundary, reflected};
use super::secondary_ray::SecondaryRay;
use super::tracer::Tracer;
use super::tree::{Branch, Root};
use crate::scene::Material;
use glam::DVec3;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// Most nodes of one tree: what two facing mirrors and glass between them may fill.
const MOST_NODES: u32 = 1000;

/// A branch that is still to be followed.
pub(super) struct PendingBranch {
    /// At most this share of the light that arrives by it reaches the camera.
    bound: f64,
    /// How many were found before it: of equal ones the first is followed first.
    number: u32,
    depth: u32,
    /// The ray against its light.
    pub(super) ray: SecondaryRay,
    parent: u32,
    lobe: u32,
    share: f64,
    /// D from the surface it leaves to the camera.
    doppler: f64,
}

impl PendingBranch {
    /// The branch to a surface that sees light at `frequency_ratio` times its frequency where the
    /// branch leaves; and D from there to the camera.
    pub(super) fn to_surface(&self, frequency_ratio: f64) -> (Branch, f64) {
        let doppler = held(self.doppler / frequency_ratio);
        (self.with(1.0 / frequency_ratio), doppler)
    }

    /// The branch to the background, D from which to the surface that the branch leaves is given;
    /// and D from there to the camera.
    pub(super) fn to_sky(&self, doppler: f64) -> (Branch, f64) {
        (self.with(doppler), held(self.doppler * doppler))
    }

    fn with(&self, doppler: f64) -> Branch {
        Branch {
            parent: self.parent,
            lobe: self.lobe,
            share: self.share,
            doppler,
        }
    }

    /// Where branches leave from the surface at its end, which is the tree's node of this number.
    pub(super) fn origin_at(&self, surface: &Interaction, node: u32, doppler: f64) -> BranchOrigin {
        BranchOrigin {
            bound: self.bound,
            depth: self.depth,
            node,
            doppler,
            slowness: if surface.worldline == self.ray.worldline {
                self.ray.slowness
            } else {
                1.0
            },
        }
    }
}

/// Where branches leave from.
pub(super) struct BranchOrigin {
    /// At most this share of the light that arrives there reaches the camera.
    bound: f64,
    depth: u32,
    /// Position among the tree's nodes.
    node: u32,
    /// D to the camera.
    doppler: f64,
    /// Of the medium in front of the surface.
    slowness: f64,
}

impl BranchOrigin {
    /// The surface that a camera ray meets, D from which to the camera is given.
    pub(super) fn first(doppler: f64) -> Self {
        Self {
            bound: 1.0,
            depth: 0,
            node: 0,
            doppler,
            slowness: 1.0,
        }
    }
}

/// The branches of one tree that are still to be followed.
#[derive(Default)]
pub(super) struct BranchQueue {
    waiting: BinaryHeap<PendingBranch>,
    found: u32,
}

impl BranchQueue {
    /// Empties the queue, keeping its memory.
    pub(super) fn clear(&mut self) {
        self.waiting.clear();
        self.found = 0;
    }

    /// Adds the branches of a surface that are worth following, and the share of the others to what
    /// is cut off the tree.
    pub(super) fn push_branches(
        &mut self,
        tracer: &Tracer<'_>,
        surface: &Interaction,
        material: &Material,
        origin: &BranchOrigin,
        root: &mut Root,
    ) {
        let mut cut = 0.0;
        for light in scattered(surface, material, origin.slowness) {
            let bound = origin.bound * light.most;
            if bound <= tracer.cutoff || origin.depth >= tracer.bounces {
                cut += bound;
                continue;
            }
            self.waiting.push(PendingBranch {
                bound,
                number: self.found,
                depth: origin.depth + 1,
                ray: SecondaryRay {
                    worldline: surface.worldline,
                    start: surface.beside(light.beyond),
                    direction: light.direction,
                    slowness: light.slowness,
                },
                parent: origin.node,
                lobe: light.lobe,
                share: light.share,
                doppler: origin.doppler,
            });
            self.found += 1;
        }
        root.cut += cut;
    }

    /// Takes the branch that may carry the most light. When the tree is full, all are cut off.
    pub(super) fn next(&mut self, root: &mut Root) -> Option<PendingBranch> {
        while let Some(branch) = self.waiting.pop() {
            if root.count < MOST_NODES {
                return Some(branch);
            }
            root.cut += branch.bound;
        }
        None
    }
}

/// A Doppler factor of many surfaces, held finite and above 0: infinitely much of nothing would be
/// no number.
fn held(doppler: f64) -> f64 {
    doppler.clamp(f64::MIN_POSITIVE, f64::MAX)
}

/// Light that a surface passes on.
struct Scattered {
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
fn scattered(
    surface: &Interaction,
    material: &Material,
    slowness: f64,
) -> impl Iterator<Item = Scattered> {
    let d = -surface.to_viewer;
    let flat = surface.geometric_normal;
    let glass = material.bsdf.refraction();
    let ior = glass.map(|(.., ior)| ior);
    // On the viewer's side and beyond. Behind a boundary is its glass, however the ray came there.
    let [slowness, slowness_beyond] = match ior {
        Some(ior) if !surface.hit.front => [ior, 1.0],
        Some(ior) => [slowness, ior],
        None => [slowness; 2],
    };
    let at_boundary = |n: DVec3| {
        let outwards = |ior: f64| if surface.hit.front { 1.0 / ior } else { ior };
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
    let normal = if usable(surface.shading_normal) {
        surface.shading_normal
    } else {
        flat
    };
    let mirrored = |lobe: usize, share, most| Scattered {
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
            let through = Scattered {
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

impl Ord for PendingBranch {
    fn cmp(&self, other: &Self) -> Ordering {
        self.bound
            .total_cmp(&other.bound)
            .then(other.number.cmp(&self.number))
    }
}

impl PartialOrd for PendingBranch {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for PendingBranch {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for PendingBranch {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accel::Hit;
    use crate::relativity::Event;
    use crate::scene::{Bsdf, Lobe, LobeKind, WeightedSpectrum};
    use crate::spectrum::Spectrum;
    use proptest::prelude::*;
    use std::sync::Arc;

    /// A surface of flat normal +z that is met from `front` or behind.
    fn surface(incoming: DVec3, normal: DVec3, front: bool) -> Interaction {
        Interaction {
            worldline: 0,
            event: Event::new(0.0, DVec3::ZERO),
            geometric_normal: DVec3::Z,
            shading_normal: normal,
            bulge: DVec3::ZERO,
            clearance: 1e-13,
            to_viewer: -incoming,
            hit: Hit {
                t: 1.0,
                instance: 0,
                triangle: 0,
                weights: [1.0, 0.0, 0.0],
                front,
            },
        }
    }

    fn glass(ior: f64) -> Material {
        let all = WeightedSpectrum {
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
        let rays: Vec<Scattered> =
            scattered(&surface(steep, DVec3::Z, false), &glass(1.5), 1.0).collect();
        assert_eq!(rays.len(), 1, "total reflection");
        assert_eq!(rays[0].slowness, 1.5);
        let outside: Vec<f64> = scattered(&surface(steep, DVec3::Z, true), &glass(1.5), 1.0)
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
            for ray in scattered(&surface(incoming, normal, front), &glass(ior), 1.0) {
                prop_assert_eq!(ray.direction.z < 0.0, ray.beyond, "{:?}", ray.direction);
            }
        }
    }
}
