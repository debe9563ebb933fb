//! Measures of a whole model with every instance in place: triangles, area, volume, bounds.

use super::Model;
use ::glam::DVec3;

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
        let centre = (low + high) / 2.0;
        self.world_triangles()
            .map(|(_, [a, b, c])| (a - centre).dot((b - centre).cross(c - centre)) / 6.0)
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
