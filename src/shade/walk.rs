//! The walk over a shade tree, the same whichever way spectra are held: its nodes, the surfaces
//! that pass their light on, lamps and the weights of lobes, each with its Doppler factor.
//!
//! A [`SpectralBasis`] receives the sources of one node after the other and makes light of them. It
//! knows spectra, and no tree: neither parents nor branches nor flat arrays. A lobe is a position
//! among those of its material, with a weight under each lamp; what kind it is was used up when the
//! weight was made.

use super::received::{Doppler, Received};
use crate::frame::ActiveEffects;
use crate::scene::Scene;
use crate::spectrum::Spectrum;
use crate::trace::{Branch, DirectLight, Node, Root, Seen, ShadeTrees};
use glam::DVec3;
use std::sync::Arc;

/// What light of a source is in one way of holding spectra. Each call adds the light of one source
/// of a node; a surface's sources come in the order of the functions.
///
/// `doppler` is that from the node to the camera.
pub(super) trait SpectralBasis {
    /// The sky in a unit direction of its own axes, away from the observer.
    fn sky(&mut self, direction: DVec3, doppler: Doppler);

    /// The cold light of a material, if it has any.
    fn emission(&mut self, material: usize, doppler: Doppler);

    /// The thermal light of a material, if it has any.
    fn thermal(&mut self, material: usize, doppler: Doppler);

    /// What the lobes of a material reflect of lamps, at least one.
    fn lamps(&mut self, material: usize, doppler: Doppler, lamps: Lamps<'_>);
}

/// What walks over trees need of the scene.
pub(super) struct TreeWalk {
    received: Received,
    /// For each light its emitter and its scale.
    lamps: Vec<(usize, f64)>,
    emitters: Vec<Arc<Spectrum>>,
    /// How many lobes of each material reflect lamps.
    lobes: Vec<usize>,
}

impl TreeWalk {
    /// For the trees of a scene's image.
    pub(super) fn new(scene: &Scene, effects: &ActiveEffects) -> Self {
        let mut emitters: Vec<Arc<Spectrum>> = Vec::new();
        let lamps = scene
            .lights
            .iter()
            .map(|light| {
                let known = emitters.iter().position(|s| *s == light.spectrum);
                let emitter = known.unwrap_or_else(|| {
                    emitters.push(Arc::clone(&light.spectrum));
                    emitters.len() - 1
                });
                (emitter, light.scale)
            })
            .collect();
        let lobes = scene.materials.iter().map(|m| m.bsdf.non_specular().len());
        Self {
            received: Received::new(effects),
            lamps,
            emitters,
            lobes: lobes.collect(),
        }
    }

    /// The powers of D and the shift of the image.
    pub(super) fn received(&self) -> Received {
        self.received
    }

    /// The distinct spectra of lamps; lamps name theirs by position.
    pub(super) fn emitters(&self) -> &[Arc<Spectrum>] {
        &self.emitters
    }

    /// The emitter of a light of the scene.
    pub(super) fn emitter_of(&self, light: usize) -> usize {
        self.lamps[light].0
    }

    /// The nodes of a tree, parents before children.
    #[inline(always)]
    pub(super) fn visits<'a>(
        &'a self,
        trees: &'a ShadeTrees,
        root: Root,
    ) -> impl Iterator<Item = Visit<'a>> {
        let nodes = trees.nodes_of(root);
        nodes.iter().map(move |node| Visit {
            walk: self,
            trees,
            nodes,
            node,
        })
    }
}

/// A node of a tree.
#[derive(Clone, Copy)]
pub(super) struct Visit<'a> {
    walk: &'a TreeWalk,
    trees: &'a ShadeTrees,
    nodes: &'a [Node],
    node: &'a Node,
}

/// What a node's light comes from.
pub(super) enum Origin<'a> {
    /// The sky.
    Sky,
    /// A surface of this material under these lamps.
    Surface(usize, Lamps<'a>),
}

/// A surface that passes light on, by mirror or glass.
#[derive(Debug, Clone, Copy)]
pub(super) struct Passage {
    /// Its position among the nodes of the tree.
    pub(super) parent: usize,
    /// Its material.
    pub(super) material: usize,
    /// The lobe of that material.
    pub(super) lobe: usize,
    /// Share of the light that the lobe is given.
    pub(super) share: f64,
    /// From that surface to the camera.
    pub(super) doppler: Doppler,
}

impl<'a> Visit<'a> {
    /// The last surface that the node's light passes; None where the camera sees the node directly.
    pub(super) fn passage(&self) -> Option<Passage> {
        Some(self.by(self.node.branch.as_ref()?))
    }

    /// All surfaces that the node's light passes on its way to the camera, in the order of the light.
    pub(super) fn passages(&self) -> impl Iterator<Item = Passage> {
        let branches = std::iter::successors(self.node.branch.as_ref(), |branch| {
            self.nodes[branch.parent as usize].branch.as_ref()
        });
        branches.map(|branch| self.by(branch))
    }

    fn by(&self, branch: &Branch) -> Passage {
        let parent = &self.nodes[branch.parent as usize];
        let Seen::Surface(surface) = &parent.seen else {
            unreachable!("branches leave from surfaces");
        };
        Passage {
            parent: branch.parent as usize,
            material: surface.material as usize,
            lobe: branch.lobe as usize,
            share: branch.share,
            doppler: self.walk.received.under(parent.doppler),
        }
    }

    /// From the node to the camera.
    #[inline(always)]
    pub(super) fn doppler(&self) -> Doppler {
        self.walk.received.under(self.node.doppler)
    }

    /// What the node's light comes from.
    pub(super) fn origin(&self) -> Origin<'a> {
        match &self.node.seen {
            Seen::Sky(_) => Origin::Sky,
            Seen::Surface(surface) => {
                let lights = self.trees.lamps_on(surface);
                Origin::Surface(
                    surface.material as usize,
                    self.lamps(surface.material, lights),
                )
            }
        }
    }

    /// Adds the sources of the node to the light of a basis.
    #[inline]
    pub(super) fn add_to(&self, basis: &mut impl SpectralBasis) {
        let doppler = self.doppler();
        match &self.node.seen {
            Seen::Sky(direction) => basis.sky(*direction, doppler),
            Seen::Surface(surface) => {
                let material = surface.material as usize;
                basis.emission(material, doppler);
                basis.thermal(material, doppler);
                let lights = self.trees.lamps_on(surface);
                if !lights.is_empty() {
                    basis.lamps(material, doppler, self.lamps(surface.material, lights));
                }
            }
        }
    }

    #[inline(always)]
    fn lamps(&self, material: u32, lights: &'a [DirectLight]) -> Lamps<'a> {
        Lamps {
            walk: self.walk,
            trees: self.trees,
            lobes: self.walk.lobes[material as usize],
            lights,
        }
    }
}

/// The lamps on a surface.
#[derive(Clone, Copy)]
pub(super) struct Lamps<'a> {
    walk: &'a TreeWalk,
    trees: &'a ShadeTrees,
    lobes: usize,
    lights: &'a [DirectLight],
}

/// The light of a lamp on a surface.
pub(super) struct LampLight<'a> {
    /// Position of its spectrum in [`TreeWalk::emitters`].
    pub(super) emitter: usize,
    /// The lamp's intensity over that spectrum.
    pub(super) scale: f64,
    /// From the lamp to the surface.
    pub(super) doppler: Doppler,
    /// For each lobe of the surface that reflects lamps, what it reflects of a lamp of scale 1, m⁻².
    pub(super) weights: &'a [f64],
}

impl<'a> Lamps<'a> {
    /// The lamps one after the other.
    #[inline(always)]
    pub(super) fn iter(self) -> impl Iterator<Item = LampLight<'a>> {
        self.lights.iter().map(move |light| {
            let (emitter, scale) = self.walk.lamps[light.light as usize];
            LampLight {
                emitter,
                scale,
                doppler: self.walk.received.under(light.doppler),
                weights: self.trees.weights_of(light, self.lobes),
            }
        })
    }
}
