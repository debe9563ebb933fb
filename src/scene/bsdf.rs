//! Reflection and transmission at a surface: a sum of lobes, each a geometry times a spectrum.
//!
//! Geometry is a number without wavelength and is evaluated while rays are traced
//! ([`Lobe::reflected`]); the spectrum is read when the tree is shaded. A new lobe is a variant of
//! [`LobeKind`] with its arms here and its key in the shot's materials: tracing and shading iterate
//! over lobes and their weights. Only ideal mirrors and boundaries, which make rays, are named in
//! tracing.

use crate::spectrum::Spectrum;
use glam::DVec3;
use std::f64::consts::PI;
use std::sync::Arc;

/// The lobes of a surface; those that are not specular come first, in the order of [`LobeKind`].
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Bsdf {
    lobes: Vec<Lobe>,
    /// How many are not specular.
    non_specular: usize,
}

/// A lobe: geometry times reflectance.
#[derive(Debug, Clone, PartialEq)]
pub struct Lobe {
    /// Its geometry.
    pub kind: LobeKind,
    /// Share of light that it reflects; of a refraction, that it transmits.
    pub reflectance: WeightedSpectrum,
}

/// The geometry of a lobe.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LobeKind {
    /// Lambert: L = ρE/π.
    Diffuse,
    /// Blinn–Phong: L = ρE (n+8)/(8π) (N·H)ⁿ.
    Highlight {
        /// n, at least 0.
        exponent: f64,
    },
    /// Ideal reflection.
    Mirror,
    /// Ideal refraction at a boundary: outside, where triangles show their front, is vacuum.
    Refraction {
        /// Index of refraction inside, at least 1.
        ior: f64,
    },
}

/// weight × spectrum.
///
/// The spectrum is one for the whole material. Spectra that change over a surface would replace
/// this field by a reference that is resolved with the point's uv, and the readers of this field
/// are the places to change.
#[derive(Debug, Clone, PartialEq)]
pub struct WeightedSpectrum {
    /// Factor, at least 0.
    pub weight: f64,
    /// Shape.
    pub spectrum: Arc<Spectrum>,
}

impl Bsdf {
    /// A surface of these lobes, at most one of each kind.
    pub fn new(mut lobes: Vec<Lobe>) -> Self {
        lobes.sort_by_key(|lobe| lobe.kind.rank());
        let non_specular = lobes.partition_point(|lobe| !lobe.kind.is_specular());
        Self {
            lobes,
            non_specular,
        }
    }

    /// All lobes.
    pub fn lobes(&self) -> &[Lobe] {
        &self.lobes
    }

    /// The lobes that reflect lamps: the first ones of [`Bsdf::lobes`].
    #[inline(always)]
    pub fn non_specular(&self) -> &[Lobe] {
        &self.lobes[..self.non_specular]
    }

    /// The ideal reflection, and its position among the lobes.
    pub fn mirror(&self) -> Option<(usize, &Lobe)> {
        self.find(|kind| kind == LobeKind::Mirror)
    }

    /// The ideal refraction, its position among the lobes and its index of refraction.
    pub fn refraction(&self) -> Option<(usize, &Lobe, f64)> {
        self.lobes.iter().enumerate().find_map(|(i, lobe)| {
            let LobeKind::Refraction { ior } = lobe.kind else {
                return None;
            };
            Some((i, lobe, ior))
        })
    }

    fn find(&self, is_it: impl Fn(LobeKind) -> bool) -> Option<(usize, &Lobe)> {
        let mut lobes = self.lobes.iter().enumerate();
        lobes.find(|(_, lobe)| is_it(lobe.kind))
    }

    /// The lobe of the key of a kind, see [`LobeKind::key`].
    pub fn of_key(&self, key: &str) -> Option<&Lobe> {
        self.lobes.iter().find(|lobe| lobe.kind.key() == key)
    }

    /// The same with `lobe` in place of the one of its kind, or beside the others.
    pub(super) fn with(self, lobe: Lobe) -> Self {
        let mut lobes = self.lobes;
        lobes.retain(|other| other.kind.key() != lobe.kind.key());
        lobes.push(lobe);
        Self::new(lobes)
    }

    /// The same without lobes that contribute nothing.
    pub(super) fn pruned(self) -> Self {
        let mut lobes = self.lobes;
        let is_mirror = |lobe: &Lobe| lobe.kind == LobeKind::Mirror && lobe.reflectance.is_seen();
        let mirror = lobes.iter().any(is_mirror);
        lobes.retain(|lobe| {
            // Without transmittance it is still a boundary, which gives a mirror its share.
            let boundary = matches!(lobe.kind, LobeKind::Refraction { .. }) && mirror;
            boundary || lobe.reflectance.is_seen()
        });
        Self::new(lobes)
    }
}

impl Lobe {
    /// The radiance that the lobe sends to the viewer, over its reflectance, under a lamp of this
    /// irradiance (in any unit; radiance is in the same per steradian). Directions are unit vectors
    /// in the surface's rest frame and leave the surface; the normal is on the viewer's side. 0 for
    /// specular lobes, which lamps of no size do not show in.
    #[inline]
    pub fn reflected(
        &self,
        irradiance: f64,
        normal: DVec3,
        to_light: DVec3,
        to_viewer: DVec3,
    ) -> f64 {
        match self.kind {
            LobeKind::Diffuse => irradiance / PI,
            LobeKind::Highlight { exponent: n } => {
                let half = (to_light + to_viewer).normalize_or(normal);
                let lobe = normal.dot(half).max(0.0).powf(n);
                irradiance * (n + 8.0) / (8.0 * PI) * lobe
            }
            LobeKind::Mirror | LobeKind::Refraction { .. } => 0.0,
        }
    }
}

impl LobeKind {
    /// Its key in a shot's materials.
    pub fn key(self) -> &'static str {
        match self {
            Self::Diffuse => "diffuse",
            Self::Highlight { .. } => "highlight",
            Self::Mirror => "mirror",
            Self::Refraction { .. } => "refraction",
        }
    }

    /// Whether it reflects or transmits in one direction alone, so that other bodies are seen in it.
    pub fn is_specular(self) -> bool {
        match self {
            Self::Diffuse | Self::Highlight { .. } => false,
            Self::Mirror | Self::Refraction { .. } => true,
        }
    }

    /// Order among lobes. Sums over lobes are made in it: those that are not specular come first.
    fn rank(self) -> u8 {
        match self {
            Self::Diffuse => 0,
            Self::Highlight { .. } => 1,
            Self::Mirror => 2,
            Self::Refraction { .. } => 3,
        }
    }
}

impl WeightedSpectrum {
    /// The largest share of light that it lets go on, at any wavelength.
    pub fn most(&self) -> f64 {
        (self.weight * self.spectrum.peak()).min(1.0)
    }

    /// Whether there is any.
    pub(super) fn is_seen(&self) -> bool {
        self.weight > 0.0 && *self.spectrum != Spectrum::Constant(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lobe(kind: LobeKind, weight: f64) -> Lobe {
        let spectrum = Arc::new(Spectrum::Constant(1.0));
        Lobe {
            kind,
            reflectance: WeightedSpectrum { weight, spectrum },
        }
    }

    fn keys(bsdf: &Bsdf) -> Vec<&'static str> {
        bsdf.lobes().iter().map(|lobe| lobe.kind.key()).collect()
    }

    #[test]
    fn lobes_that_reflect_lamps_come_first_whatever_the_order_they_are_given_in() {
        let glass = LobeKind::Refraction { ior: 1.5 };
        let highlight = LobeKind::Highlight { exponent: 10.0 };
        let kinds = [glass, LobeKind::Mirror, highlight, LobeKind::Diffuse];
        let bsdf = Bsdf::new(kinds.map(|kind| lobe(kind, 0.2)).to_vec());
        assert_eq!(
            keys(&bsdf),
            ["diffuse", "highlight", "mirror", "refraction"]
        );
        assert_eq!(bsdf.non_specular(), &bsdf.lobes()[..2]);
        let only = Bsdf::new(vec![lobe(LobeKind::Mirror, 0.2), lobe(highlight, 0.2)]);
        assert_eq!(only.non_specular(), &only.lobes()[..1]);
        assert_eq!(only.mirror().map(|(position, _)| position), Some(1));
    }

    #[test]
    fn a_lobe_replaces_the_one_of_its_kind() {
        let bsdf = Bsdf::new(vec![lobe(LobeKind::Refraction { ior: 1.5 }, 1.0)]);
        let bsdf = bsdf.with(lobe(LobeKind::Refraction { ior: 2.0 }, 0.5));
        assert_eq!(bsdf.lobes(), [lobe(LobeKind::Refraction { ior: 2.0 }, 0.5)]);
    }

    #[test]
    fn a_boundary_that_transmits_nothing_stays_beside_a_mirror_alone() {
        let black = lobe(LobeKind::Refraction { ior: 1.5 }, 0.0);
        let mirror = |weight| lobe(LobeKind::Mirror, weight);
        let beside = |weight| Bsdf::new(vec![black.clone(), mirror(weight)]).pruned();
        assert_eq!(keys(&beside(0.5)), ["mirror", "refraction"]);
        assert_eq!(keys(&beside(0.0)), [""; 0]);
    }

    /// Head-on, where N·H = 1: ρE/π of a diffuse lobe, ρE(n+8)/(8π) of a highlight, nothing of a
    /// mirror; at right angles to H, a highlight of n > 0 reflects nothing.
    #[test]
    fn lobes_reflect_by_their_formulas() {
        let [z, x] = [DVec3::Z, DVec3::X];
        let head_on = |kind| lobe(kind, 1.0).reflected(3.0, z, z, z);
        assert_eq!(head_on(LobeKind::Diffuse), 3.0 / PI);
        let highlight = LobeKind::Highlight { exponent: 16.0 };
        assert!((head_on(highlight) - 3.0 * 24.0 / (8.0 * PI)).abs() < 1e-15);
        assert_eq!(head_on(LobeKind::Mirror), 0.0);
        assert_eq!(lobe(highlight, 1.0).reflected(3.0, z, x, x), 0.0);
    }
}
