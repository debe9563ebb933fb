//! Contents of a model file, as plain values, and measures of the whole with every instance in place.

use super::Warning;
use glam::{DAffine3, DVec3, Vec3};

/// The contents of a model file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Model {
    /// Meshes, each in its own coordinates.
    pub meshes: Vec<Mesh>,
    /// Placements: every instance of every mesh.
    pub placements: Vec<Placement>,
    /// Materials that meshes refer to by index.
    pub materials: Vec<ModelMaterial>,
    /// Lamps.
    pub lamps: Vec<Lamp>,
    /// Content of the file that the image will not show.
    pub warnings: Vec<Warning>,
}

/// Triangles of one material.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    /// Vertices, meters. Finite, and each used by a triangle.
    pub positions: Vec<DVec3>,
    /// One unit normal per position; None if the triangles are flat.
    pub normals: Option<Vec<Vec3>>,
    /// Indices into `positions`, counterclockwise seen from outside. No triangle has zero area.
    pub triangles: Vec<[u32; 3]>,
    /// Index into [`Model::materials`].
    pub material: Option<usize>,
}

/// One instance of a mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct Placement {
    /// Index into [`Model::meshes`].
    pub mesh: usize,
    /// Model space from mesh space. Invertible; a negative determinant mirrors.
    pub world: DAffine3,
    /// Name of the glTF node, or of the OBJ object or group.
    pub node: String,
}

/// A surface as the file describes it.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelMaterial {
    /// Name in the file.
    pub name: String,
    /// Linear RGB reflectance, 0 to 1.
    pub base_color: [f64; 3],
    /// Linear RGB of emission, factor × strength, in units of `emissive_unit`.
    pub emissive: [f64; 3],
    /// Luminance of an emissive white of 1, cd/m²: 683 in files by Blender, else 1.
    pub emissive_unit: f64,
    /// Whether the back is visible too.
    pub double_sided: bool,
}

/// Lumens per watt by which Blender's exporters convert the power of lamps, whatever their light.
/// They leave emission in watts, which count the same here, so that one exposure serves both.
pub(crate) const LUMENS_PER_WATT: f64 = 683.0;

/// A lamp, which points along the negative z axis of its own coordinates.
#[derive(Debug, Clone, PartialEq)]
pub struct Lamp {
    /// Name of its node in the file.
    pub name: String,
    /// Its kind.
    pub kind: LampKind,
    /// Intensity as in the file: cd for point and spot, lx for sun, unless the file uses other
    /// units.
    pub intensity: f64,
    /// Linear RGB.
    pub color: [f64; 3],
    /// Model space from lamp space: a rotation and a translation, never a scale.
    pub world: DAffine3,
}

/// Distribution of a lamp's light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LampKind {
    /// From a point, equally in all directions.
    Point,
    /// From infinity, along one direction.
    Sun,
    /// From a point into a cone.
    Spot {
        /// Half-angle of the fully lit cone, radians.
        inner: f64,
        /// Half-angle beyond which the lamp is dark, radians. At least `inner`.
        outer: f64,
    },
}

impl Model {
    /// Number of triangles, each instance counted.
    pub fn triangles(&self) -> usize {
        self.placements
            .iter()
            .map(|p| self.meshes[p.mesh].triangles.len())
            .sum()
    }

    /// The vertices of every triangle in model space, with the index of its placement.
    pub fn world_triangles(&self) -> impl Iterator<Item = (usize, [DVec3; 3])> + '_ {
        self.placements
            .iter()
            .enumerate()
            .flat_map(|(index, placement)| {
                let mesh = &self.meshes[placement.mesh];
                mesh.triangles.iter().map(move |corners| {
                    let point =
                        |i: u32| placement.world.transform_point3(mesh.positions[i as usize]);
                    (index, corners.map(point))
                })
            })
    }

    /// Area of all surfaces, m².
    pub fn area(&self) -> f64 {
        self.world_triangles()
            .map(|(_, [a, b, c])| (b - a).cross(c - a).length() / 2.0)
            .sum()
    }

    /// Signed volume within all surfaces, m³, meaningful if they are closed. Negative if the
    /// triangles are wound inward, as those of a mirrored instance are.
    pub fn volume(&self) -> f64 {
        let Some((low, high)) = self.bounds() else {
            return 0.0;
        };
        let center = (low + high) / 2.0;
        self.world_triangles()
            .map(|(_, [a, b, c])| (a - center).dot((b - center).cross(c - center)) / 6.0)
            .sum()
    }

    /// Least and greatest coordinates of all surfaces, meters; None if there are none.
    pub fn bounds(&self) -> Option<(DVec3, DVec3)> {
        self.world_triangles()
            .flat_map(|(_, corners)| corners)
            .fold(None, |bounds, point| {
                let (low, high) = bounds.unwrap_or((point, point));
                Some((low.min(point), high.max(point)))
            })
    }
}
