//! A small picture with a bit of everything: a wall, a ball that is painted, glossy and hot, a
//! block that shades both, a lamp, a sky. Each stands on a worldline that the case names.

use super::scene::Set;
use glam::DVec3;
use restframe::film::Film;
use restframe::frame::Frame;
use restframe::render::View;
use restframe::trace::{Root, Scratch, Seen, ShadeTrees, build_aggregate};

/// Pixels in a row of the picture; it has two thirds as many rows.
const WIDTH: u32 = 24;

/// What stands where. All numbers are dyadic, so that carrying them by whole metres rounds none.
#[derive(Debug, Clone)]
pub(crate) struct Picture {
    /// Tables that come first: the worldlines, effects.
    pub(crate) tables: String,
    /// Worldlines of wall, ball, block, lamp, sky and camera.
    pub(crate) on: [&'static str; 6],
    /// Displacement of what stands in the lab.
    pub(crate) carried: f64,
    /// Exposure, s (1 m of light travel each).
    pub(crate) time: f64,
    /// Position of the camera in its worldline's frame.
    pub(crate) camera: [f64; 3],
}

impl Picture {
    /// Everything on one worldline, that of the lab if `tables` define no other.
    pub(crate) fn on_one(worldline: &'static str, tables: &str) -> Self {
        Self {
            tables: tables.to_owned(),
            on: [worldline; 6],
            carried: 0.0,
            time: 0.0,
            camera: [0.0, 0.0, 8.0],
        }
    }

    /// Ball, block, lamp and camera on four worldlines at 0.3 to 0.9 c, which pass their places
    /// when light leaves them that arrives at the exposure; `carried` in space and time.
    pub(crate) fn on_four(carried: f64) -> Self {
        let line = |name: &str, velocity: &str, at: f64| {
            format!(
                "[worldline.{name}]\nvelocity = {velocity}\npasses = [{carried}, {}, {carried}]\nat = {}\n",
                -carried,
                at + carried
            )
        };
        let tables = [
            line("ball", "[0.375, 0.125, 0.25]", -8.0),
            line("block", "[-0.125, 0.375, 0.25]", -9.5),
            line("lamp", "[-0.5, -0.5, -0.5]", -13.0),
            line("camera_car", "[0.125, 0.0625, -0.3125]", 0.0),
        ]
        .concat();
        Self {
            carried,
            time: carried,
            on: ["lab", "ball", "block", "lamp", "lab", "camera_car"],
            ..Self::on_one("lab", &tables)
        }
    }

    /// The same picture carried by `by` metres along x, against y, along z, and forward in time.
    pub(crate) fn still_and_carried(by: f64) -> Self {
        Self {
            carried: by,
            time: by,
            ..Self::on_one("lab", "")
        }
    }

    pub(crate) fn set(&self) -> Set {
        Set::new(&self.text())
    }

    pub(crate) fn film(&self) -> Film {
        self.set().film()
    }

    fn text(&self) -> String {
        let [wall, ball, block, lamp, sky, camera] = self.on;
        let at = |on: &str, [x, y, z]: [f64; 3]| {
            let carried = if on == "lab" { self.carried } else { 0.0 };
            format!(
                "worldline = \"{on}\"\n{{}} = [{}, {}, {}]\n",
                x + carried,
                y - carried,
                z + carried
            )
        };
        let place = |on: &str, position| at(on, position).replace("{}", "translate");
        let stand = |on: &str, position| at(on, position).replace("{}", "position");
        let (time, tables) = (self.time, &self.tables);
        let height = WIDTH * 2 / 3;
        format!(
            "[shot]\ntime = {time}\n[image]\nsize = [{WIDTH}, {height}]\nsamples = 4\n[sensor]\nexposure = 0\n{tables}\
             [material.wall]\ndiffuse = {{ weight = 0.75, spectrum = {{ points = [[400, 0.1], [550, 0.5], [680, 0.2], [720, 0.9]] }} }}\n\
             [material.block]\ndiffuse = {{ weight = 0.5, spectrum = 1.0 }}\n\
             [material.ball]\ndiffuse = {{ weight = 0.5, spectrum = {{ points = [[450, 0.8], [600, 0.1]] }} }}\n\
             highlight = {{ weight = 0.25, spectrum = 1.0, exponent = 20 }}\n\
             thermal = {{ temperature = 4000, curve = \"peak\", strength = 0.002 }}\n\
             [[model]]\nfile = \"wall.obj\"\nmaterial = \"wall\"\nscale = 8\n{}\
             [[model]]\nfile = \"ball.obj\"\nmaterial = \"ball\"\n{}\
             [[model]]\nfile = \"box.obj\"\nmaterial = \"block\"\nscale = 0.375\n{}\
             [[light]]\nkind = \"point\"\nscale = 1.0\nspectrum = \"D65\"\n{}\
             [background]\nworldline = \"{sky}\"\nspectrum = 0.001\n\
             [camera]\nhfov = 60\n{}",
            place(wall, [0.0, 0.0, -4.0]),
            place(ball, [-0.25, 0.0, 0.0]),
            place(block, [1.5, 1.25, 1.5]),
            stand(lamp, [3.0, 3.0, 4.0]),
            stand(camera, self.camera),
        )
    }
}

/// The wall of half-edge 1 that glows, with these keys of its `[[model]]` and of the `[camera]`, in
/// an image whose middle pixel is [2, 2].
pub(crate) fn glow(tables: &str, model: &str, camera: &str) -> Set {
    Set::new(&format!(
        "[image]\nsize = [5, 5]\n[sensor]\nexposure = 0\n{tables}\n\
         [material.glow]\nemission = {{ scale = 1.0, spectrum = 1.0 }}\n\
         [[model]]\nfile = \"wall.obj\"\nmaterial = \"glow\"\n{model}\n[camera]\n{camera}\n"
    ))
}

/// Keys of a model that make it a wide wall at z = −1000 in the frame of `on`.
pub(crate) fn far_wall(on: &str) -> String {
    format!("worldline = \"{on}\"\nscale = 4000\ntranslate = [0, 0, -1000]")
}

/// How many pixels differ by more than this share of the greatest value of either film.
pub(crate) fn changed(one: &Film, other: &Film, share: f64) -> f64 {
    let top = greatest(one).max(greatest(other));
    let differs = |(a, b): (&[f32; 3], &[f32; 3])| {
        (0..3).any(|i| {
            let off = (f64::from(a[i]) - f64::from(b[i])).abs();
            off.is_nan() || off > share * top
        })
    };
    one.xyz
        .iter()
        .zip(&other.xyz)
        .filter(|&p| differs(p))
        .count() as f64
}

fn greatest(film: &Film) -> f64 {
    let values = film.xyz.as_flattened().iter().copied().map(f64::from);
    values.fold(0.0, f64::max)
}

/// The greatest difference of X, Y or Z over the greatest of either film.
pub(crate) fn difference(one: &Film, other: &Film) -> f64 {
    assert_eq!(one.xyz.len(), other.xyz.len());
    let top = greatest(one).max(greatest(other));
    let pairs = one.xyz.as_flattened().iter().zip(other.xyz.as_flattened());
    // f64::max would pass over NaN; here it makes the difference infinite.
    let worst = pairs.map(|(&a, &b)| {
        let off = (f64::from(a) - f64::from(b)).abs();
        if off.is_nan() { f64::INFINITY } else { off }
    });
    worst.fold(0.0, f64::max) / top
}

/// Every bit of the light, and of the Doppler factors.
pub(crate) fn bits(film: &Film) -> Vec<u32> {
    let doppler = film.layers.doppler.iter().flatten();
    let light = film.xyz.as_flattened().iter();
    light.chain(doppler).map(|v| v.to_bits()).collect()
}

/// How many pixels each worldline's bodies have, sky first.
pub(crate) fn pixels_of_worldlines(film: &Film) -> Vec<usize> {
    let mut counts = vec![0; 8];
    for worldline in film.layers.worldline.iter().flatten() {
        counts[(worldline + 1.0) as usize] += 1;
    }
    counts
}

/// What the centre of a pixel meets.
pub(crate) struct Hit {
    instance: u32,
    /// In the mesh's coordinates, scaled.
    on_mesh: DVec3,
    s: f64,
    pub(crate) doppler: f64,
}

impl Hit {
    /// By how many pixels the two lie apart, seen from the camera; infinite if on two bodies.
    pub(crate) fn pixels_from(&self, other: &Hit) -> f64 {
        if self.instance != other.instance {
            return f64::INFINITY;
        }
        // The path's length in the body's frame is s/D, and aberration scales angles by 1/D.
        let angle = (self.on_mesh - other.on_mesh).length() / self.s;
        angle * f64::from(WIDTH) / (2.0 * 30f64.to_radians().tan())
    }
}

/// What the centres of the picture's pixels meet.
pub(crate) fn hits(set: &Set) -> Vec<Option<Hit>> {
    let (shot, scene) = (&set.prepared.shot, set.scene());
    let aggregate = build_aggregate(&scene.geometry, None);
    let view = View::new(
        &Frame::new(shot, 1).unwrap(),
        &shot.effects,
        &scene,
        &aggregate,
    );
    let [width, height] = shot.image.size;
    let directions: Vec<DVec3> = (0..width * height)
        .map(|i| [i % width, i / width].map(|p| f64::from(p) + 0.5))
        .map(|[x, y]| {
            scene
                .camera
                .looks_along([x / f64::from(width), y / f64::from(height)])
                .unwrap()
        })
        .collect();
    let mut trees = ShadeTrees::default();
    view.tracer()
        .trace(&directions, &mut Scratch::default(), &mut trees);
    let hit = |root: &Root| {
        let node = trees.nodes_of(*root).first()?;
        let Seen::Surface(surface) = node.seen else {
            return None;
        };
        let instance = &scene.geometry.instances[surface.hit.instance as usize];
        let mesh = &scene.geometry.meshes[instance.mesh as usize];
        let corners = mesh.triangles[surface.hit.triangle as usize];
        let on_mesh: DVec3 = corners
            .iter()
            .zip(surface.hit.weights)
            .map(|(&corner, weight)| mesh.positions[corner as usize] * weight)
            .sum();
        Some(Hit {
            instance: surface.hit.instance,
            on_mesh: instance.rest_from_mesh.matrix3 * on_mesh,
            s: surface.s,
            doppler: node.doppler,
        })
    };
    trees.roots.iter().map(hit).collect()
}
