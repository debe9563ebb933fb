//! Shade trees as flat arrays, without spectra: what frames that differ only in colours,
//! temperatures or exposure share.
//!
//! A tree's nodes stand together, parents before children. Each keeps the one Doppler factor of
//! its whole way to the camera: shifts in a row are one shift by their product.

use crate::accel::Hit;
use glam::DVec3;

/// Shade trees of some camera rays.
#[derive(Debug, Default)]
pub struct ShadeTrees {
    /// A tree for each ray, in the order of the rays.
    pub roots: Vec<Root>,
    /// What is seen, directly or by way of mirrors and glass.
    pub nodes: Vec<Node>,
    /// Lamps that light the surfaces among them.
    pub direct: Vec<DirectLight>,
    /// Weights of lobes under those lamps: for each lamp one for each non-specular lobe of the
    /// surface's material, in the order of the lobes; see [`Lobe::reflected`].
    ///
    /// [`Lobe::reflected`]: crate::scene::Lobe::reflected
    pub weights: Vec<f64>,
}

impl ShadeTrees {
    /// Empties the trees, keeping their memory.
    pub fn clear(&mut self) {
        self.roots.clear();
        self.nodes.clear();
        self.direct.clear();
        self.weights.clear();
    }

    /// The nodes of one tree; none where a ray sees nothing.
    #[inline(always)]
    pub fn nodes_of(&self, root: Root) -> &[Node] {
        &self.nodes[root.first as usize..(root.first + root.count) as usize]
    }

    /// The lamps on a surface.
    #[inline(always)]
    pub fn lamps_on(&self, surface: &Surface) -> &[DirectLight] {
        &self.direct[surface.first_lamp as usize..(surface.first_lamp + surface.lamps) as usize]
    }

    /// The weights of the first `lobes` lobes of a surface's material under a lamp, m⁻².
    #[inline(always)]
    pub fn weights_of(&self, lamp: &DirectLight, lobes: usize) -> &[f64] {
        &self.weights[lamp.first_weight as usize..][..lobes]
    }
}

/// A camera ray's tree.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Root {
    /// Index of its first node, which the ray itself meets, into [`ShadeTrees::nodes`].
    pub first: u32,
    /// How many nodes it has; 0 where the ray sees nothing.
    pub count: u32,
    /// Share of the light that was not followed, being too faint or too deep: the sum, over the
    /// branches left out, of the reflectances on their way. What the camera lacks is at most this
    /// times the brightest light that arrives there, shifted as it would be.
    pub cut: f64,
}

/// What a ray meets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Node {
    /// How it is seen; None if by the camera itself.
    pub branch: Option<Branch>,
    /// D from here to the camera.
    pub doppler: f64,
    /// What it is.
    pub seen: Seen,
}

/// The way from a node to the surface in which it is seen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Branch {
    /// That surface: position among the tree's own nodes.
    pub parent: u32,
    /// The lobe of its material that passes the light on: position among the lobes. A refraction
    /// also reflects, where reflection is total.
    pub lobe: u32,
    /// Share of the light that the lobe is given: Fresnel's, or 1.
    pub share: f64,
    /// D from this node to that surface.
    pub doppler: f64,
}

/// What stands at the end of a ray.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Seen {
    /// The background, in this unit direction of its own axes.
    Sky(DVec3),
    /// A surface.
    Surface(Surface),
}

/// A surface in a shade tree.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Surface {
    /// Index into the scene's materials.
    pub material: u32,
    /// Length of the light path in the rest frame of the camera or surface that sees it, meters.
    pub s: f64,
    /// When the light left, in the surface's rest frame, metres of light travel.
    pub time: f64,
    /// What was hit where.
    pub hit: Hit,
    /// How many lamps light it.
    pub lamps: u32,
    /// Index of the first of them into [`ShadeTrees::direct`].
    pub first_lamp: u32,
}

/// A lamp's light on a surface. The irradiance of the surface is D³·I(Dλ)/r² times a cosine; the
/// weights of its lobes hold the factors that do not depend on wavelength or on how much beaming is
/// simulated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DirectLight {
    /// Index into the scene's lights.
    pub light: u32,
    /// Index of the first lobe's weight into [`ShadeTrees::weights`].
    pub first_weight: u32,
    /// D from the lamp to the surface.
    pub doppler: f64,
}
