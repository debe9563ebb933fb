//! Rays of a set's camera by their directions, the round bodies that they meet, and numbers to
//! draw them from.

use super::scene::Set;
use glam::DVec3;
use restframe::accel::Aggregate;
use restframe::accel::Hit;
use restframe::frame::Frame;
use restframe::model::Mesh;
use restframe::probe::{Probe, probe};
use restframe::render::View;
use restframe::scene::Scene;
use restframe::trace::{Root, Scratch, Seen, ShadeTrees, build_aggregate};

/// A frame of a set, ready for rays.
pub(crate) struct Eye<'a> {
    set: &'a Set,
    frame: u32,
    pub(crate) scene: Scene,
    pub(crate) aggregate: Aggregate,
}

/// What a ray meets first.
#[derive(Clone, Copy)]
pub(crate) struct Met {
    /// Length of the light path in the camera's rest frame.
    pub(crate) s: f64,
    pub(crate) hit: Hit,
    pub(crate) worldline: usize,
}

impl<'a> Eye<'a> {
    pub(crate) fn new(set: &'a Set) -> Self {
        Self::of(set, 1, set.scene())
    }

    /// Another frame than the first.
    pub(crate) fn in_frame(set: &'a Set, frame: u32) -> Self {
        let prepared = &set.prepared;
        let scene = Scene::resolve(
            &Frame::new(&prepared.shot, frame).unwrap(),
            &prepared.library,
            None,
        )
        .unwrap();
        Self::of(set, frame, scene)
    }

    /// A scene that stands in for the set's own.
    pub(crate) fn of(set: &'a Set, frame: u32, scene: Scene) -> Self {
        let aggregate = build_aggregate(&scene.geometry, None);
        Self {
            set,
            frame,
            scene,
            aggregate,
        }
    }

    pub(crate) fn view(&self) -> View<'_> {
        let shot = &self.set.prepared.shot;
        View::new(
            &Frame::new(shot, self.frame).unwrap(),
            &shot.effects,
            &self.scene,
            &self.aggregate,
        )
    }

    /// What the centres of all pixels see, row by row, at exposure 0.
    pub(crate) fn probes(&self) -> Vec<Probe> {
        let shot = &self.set.prepared.shot;
        let view = self.view();
        let [width, height] = shot.image.size;
        (0..width * height)
            .map(|i| {
                let pixel = [i % width, i / width];
                probe(
                    &Frame::new(shot, self.frame).unwrap(),
                    pixel,
                    &view,
                    &self.scene,
                    0.0,
                )
            })
            .collect()
    }

    /// What rays of these unit directions (camera's rest frame) meet.
    pub(crate) fn meets(&self, view: &View<'_>, directions: &[DVec3]) -> Vec<Option<Met>> {
        let mut trees = ShadeTrees::default();
        view.tracer()
            .trace(directions, &mut Scratch::default(), &mut trees);
        let met = |root: &Root| match trees.nodes_of(*root).first()?.seen {
            Seen::Sky(_) => None,
            Seen::Surface(surface) => {
                let instance = &self.scene.geometry.instances[surface.hit.instance as usize];
                Some(Met {
                    s: surface.s,
                    hit: surface.hit,
                    worldline: instance.worldline as usize,
                })
            }
        };
        trees.roots.iter().map(met).collect()
    }

    /// The border of what `within` accepts, between a direction that it does and one that it does
    /// not: the last accepted direction, and what is met there.
    pub(crate) fn border(
        &self,
        [mut inside, mut outside]: [DVec3; 2],
        within: impl Fn(&Met) -> bool,
    ) -> (DVec3, Met) {
        let view = self.view();
        let look = |direction: DVec3| self.meets(&view, &[direction])[0].filter(|met| within(met));
        let mut last = look(inside.normalize()).unwrap();
        assert!(look(outside.normalize()).is_none());
        // Until the two are neighbours in f64, whatever the angle between them was.
        for _ in 0..100 {
            let middle = inside / 2.0 + outside / 2.0;
            match look(middle.normalize()) {
                Some(met) => (inside, last) = (middle, met),
                None => outside = middle,
            }
        }
        (inside.normalize(), last)
    }
}

/// A sphere of radius 1 about the z axis as an OBJ file, of flat facets within it: `bands` (an even
/// number) from pole to pole, `sectors` around. Its equator stands on the sphere at each sector.
pub(crate) fn sphere(bands: u32, sectors: u32) -> String {
    use std::f64::consts::PI;
    let mut text = String::from("v 0 0 1\nv 0 0 -1\n");
    for band in 1..bands {
        let (sin, cos) = (PI * f64::from(band) / f64::from(bands)).sin_cos();
        let (z, level) = if 2 * band == bands {
            (0.0, 1.0)
        } else {
            (cos, sin)
        };
        for sector in 0..sectors {
            let (y, x) = (2.0 * PI * f64::from(sector) / f64::from(sectors)).sin_cos();
            text += &format!("v {:?} {:?} {z:?}\n", level * x, level * y);
        }
    }
    let at = |band: u32, sector: u32| 3 + (band - 1) * sectors + sector % sectors;
    for sector in 0..sectors {
        text += &format!("f 1 {} {}\n", at(1, sector), at(1, sector + 1));
        for band in 1..bands - 1 {
            let [a, b] = [band, band + 1].map(|band| at(band, sector));
            let [c, d] = [band + 1, band].map(|band| at(band, sector + 1));
            text += &format!("f {a} {b} {c}\nf {a} {c} {d}\n");
        }
        text += &format!(
            "f 2 {} {}\n",
            at(bands - 1, sector + 1),
            at(bands - 1, sector)
        );
    }
    text
}

/// The corners of a mesh's triangles.
pub(crate) fn triangles(mesh: &Mesh) -> impl Iterator<Item = [DVec3; 3]> + '_ {
    let corners = |t: &[u32; 3]| t.map(|i| mesh.positions[i as usize]);
    mesh.triangles.iter().map(corners)
}

/// Unit normal and distance from the origin of a triangle's plane.
pub(crate) fn plane([a, b, c]: [DVec3; 3]) -> (DVec3, f64) {
    let normal = (b - a).cross(c - a).normalize();
    (normal, normal.dot(a + b + c) / 3.0)
}

/// The radius of the sphere that a [`sphere`] encloses.
pub(crate) fn inner_radius(mesh: &Mesh) -> f64 {
    triangles(mesh)
        .map(|t| plane(t).1)
        .fold(f64::INFINITY, f64::min)
}

/// Two unit vectors across a unit vector and each other.
pub(crate) fn across(n: DVec3) -> [DVec3; 2] {
    let first = n.any_orthonormal_vector();
    [first, n.cross(first)]
}

/// Numbers that are the same everywhere (Steele, Lea & Flood 2014, SplitMix64).
pub(crate) struct Dice(pub(crate) u64);

impl Dice {
    /// Between 0 and 1.
    pub(crate) fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let a = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let b = (a ^ (a >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((b ^ (b >> 31)) >> 11) as f64 / 2f64.powi(53)
    }

    /// Between −1 and 1.
    pub(crate) fn signed(&mut self) -> f64 {
        2.0 * self.unit() - 1.0
    }

    /// A point of the cube of half-edge 1.
    pub(crate) fn point(&mut self) -> DVec3 {
        DVec3::new(self.signed(), self.signed(), self.signed())
    }

    /// A direction, all equally likely.
    pub(crate) fn direction(&mut self) -> DVec3 {
        loop {
            let point = self.point();
            let squared = point.length_squared();
            if squared > 1e-6 && squared < 1.0 {
                return point / squared.sqrt();
            }
        }
    }
}
