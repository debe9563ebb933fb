//! A thousand random shadings.
//!
//! A picture is exposed for its light: a perfect white under the same lamp and shifts, or all
//! light of the surface where it is more, as where it glows, has Y = 1.

use super::random::Random;
use rayon::prelude::*;
use restframe::accel::Hit;
use restframe::color::cie::xyz_of;
use restframe::color::spaces::D65_XYZ;
use restframe::color::{delta_e_2000, lab_from_xyz};
use restframe::frame::{Frame, Sensor};
use restframe::image::compare::Comparison;
use restframe::scene::{
    Bsdf, Curve, Library, Lobe, LobeKind, Material, Scene, Thermal, WeightedSpectrum,
};
use restframe::shade::{Settings, ShadeScratch, Shader};
use restframe::shot::{self, Accuracy, Preset, Shot, Spectra};
use restframe::spectrum::{Beyond, Spectrum, planck};
use restframe::trace::{DirectLight, Node, Root, Seen, ShadeTrees, Surface};
use std::sync::Arc;

const SHADINGS: u64 = 1000;

/// The least luminance that an eye used to darkness sees, cd/m², about.
/// Lamps are such that white at rest has 7·10⁴, twice that of paper in the sun: what is darker than
/// this is black in any picture.
const DARK: f64 = 1e-6;

/// Everything is called for: a wall that moves, a lamp, thermal light.
const SHOT: &str = r#"
[worldline.fast]
velocity = { gamma = 20.0, direction = [1, 0, 0] }
[[model]]
file = "quad.obj"
worldline = "fast"
material = "paint"
[material.paint]
diffuse = { spectrum = 0.5 }
thermal = { temperature = 1000 }
[[light]]
kind = "sun"
direction = [0, 0, -1]
scale = 1.0
spectrum = "D65"
[camera]
"#;

fn diffuse(reflectance: WeightedSpectrum) -> Bsdf {
    Bsdf::new(vec![Lobe {
        kind: LobeKind::Diffuse,
        reflectance,
    }])
}

/// A surface under a lamp.
pub(crate) struct Shading {
    material: Material,
    lamp: Arc<Spectrum>,
    doppler: f64,
    lamp_doppler: f64,
}

impl Shading {
    /// Number `index` of those of the seed.
    fn new(index: u64) -> Self {
        let random = &mut Random(0x1990_0000 + index * 1_000_003);
        let reflectance = |spectrum| WeightedSpectrum {
            weight: 1.0,
            spectrum: Arc::new(spectrum),
        };
        let mut material = Material {
            bsdf: diffuse(reflectance(random.reflectance())),
            ..Material::default()
        };
        if random.below(4) == 0 {
            let mut emission = reflectance(random.black_body(1000.0, 20_000.0));
            emission.weight = random.ratio(1e-3, 1.0);
            material.emission = Some(emission);
        }
        if random.below(2) == 0 {
            let curve = match random.below(2) {
                0 => Curve::Absolute,
                _ => Curve::Peak(random.ratio(1e-3, 1.0)),
            };
            let emissivity = match random.below(2) {
                0 => Spectrum::Constant(1.0),
                _ => random.reflectance(),
            };
            material.thermal = Some(Thermal {
                temperature_k: random.between(1.0, 30_000.0),
                emissivity: Arc::new(emissivity),
                curve,
            });
        }
        Self {
            material,
            lamp: Arc::new(random.lamp()),
            doppler: random.ratio(0.1, 10.0),
            lamp_doppler: match random.below(2) {
                0 => 1.0,
                _ => random.ratio(0.5, 2.0),
            },
        }
    }

    /// The product of the peaks of spectra that shifts as large as this one's can bring into view,
    /// each term by itself.
    fn brightest(&self) -> f64 {
        let reach = self.doppler.ln().abs();
        let peak = |reach: f64, curve: &dyn Fn(f64) -> f64| {
            let [from, to] = [360.0 * (-reach).exp(), 830.0 * reach.exp()];
            (0..=4000)
                .map(|i| curve(from * (to / from).powf(f64::from(i) / 4000.0)))
                .fold(0.0, f64::max)
        };
        let near = |spectrum: &Spectrum| peak(reach, &|nm| spectrum.at(nm));
        let far = reach + self.lamp_doppler.ln().abs();
        let mut sum = 0.0;
        for lobe in self.material.bsdf.lobes() {
            let lamp = peak(far, &|nm| self.lamp.at(nm));
            sum += near(&lobe.reflectance.spectrum) * lamp * self.lamp_doppler.powi(3);
        }
        if let Some(emission) = &self.material.emission {
            sum += emission.weight * near(&emission.spectrum);
        }
        if let Some(thermal) = &self.material.thermal {
            let kelvin = thermal.temperature_k;
            let scale = match thermal.curve {
                Curve::Absolute => 1.0,
                Curve::Peak(strength) => strength / planck::peak_radiance(kelvin),
            };
            let body = peak(reach, &|nm| planck::radiance(nm, kelvin));
            sum += scale * near(&thermal.emissivity) * body;
        }
        sum * self.doppler.powi(5)
    }

    fn trees(&self) -> ShadeTrees {
        let hit = Hit {
            t: 1.0,
            instance: 0,
            triangle: 0,
            weights: [1.0, 0.0, 0.0],
            front: true,
        };
        let surface = Surface {
            material: 0,
            s: 1.0,
            time: 0.0,
            hit,
            lamps: 1,
            first_lamp: 0,
        };
        let root = Root {
            first: 0,
            count: 1,
            cut: 0.0,
        };
        ShadeTrees {
            roots: vec![root],
            nodes: vec![Node {
                branch: None,
                doppler: self.doppler,
                seen: Seen::Surface(surface),
            }],
            direct: vec![DirectLight {
                light: 0,
                first_weight: 0,
                doppler: self.lamp_doppler,
            }],
            weights: vec![1.0],
        }
    }
}

/// Where shadings take place.
struct Wall {
    shot: Shot,
    scene: Scene,
}

impl Wall {
    fn new() -> Self {
        // One for each thread.
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        let quad = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n";
        std::fs::write(folder.join("quad.obj"), quad).unwrap();
        let shot = shot::parse(SHOT, &folder.join("shadings.toml")).unwrap();
        let library = Library::load(&shot).unwrap();
        let scene = Scene::resolve(&Frame::new(&shot, 1).unwrap(), &library, None).unwrap();
        Self { shot, scene }
    }

    fn shader(&mut self, shading: &Shading, material: Material, accuracy: Accuracy) -> Shader {
        self.scene.materials[0] = material;
        self.scene.lights[0].spectrum = Arc::clone(&shading.lamp);
        let effects = Frame::new(&self.shot, 1)
            .unwrap()
            .active_effects(&self.shot.effects);
        let settings = Settings {
            effects: &effects,
            accuracy: &accuracy,
            sensor: &Sensor::new(&self.shot.sensor),
            reach: shading.doppler.ln().abs() + 1e-9,
            lamp_reach: shading.lamp_doppler.ln().abs() + 1e-9,
        };
        Shader::new(&self.scene, &settings)
    }

    fn xyz(&mut self, shading: &Shading, material: Material, accuracy: Accuracy) -> [f64; 3] {
        let shader = self.shader(shading, material, accuracy);
        let trees = shading.trees();
        shader.xyz(&trees, trees.roots[0], &mut ShadeScratch::default())
    }
}

fn exact() -> Accuracy {
    Accuracy {
        spectra: Spectra::Exact,
        ..Accuracy::default()
    }
}

fn grid(wavelengths: u32) -> Accuracy {
    Accuracy {
        spectra: Spectra::Grid,
        wavelengths,
        ..Accuracy::default()
    }
}

/// A grid's colour of a shading against the exact one.
struct Found {
    delta_e: f64,
    /// Largest error of a channel, over that channel of an equal-energy light as bright as the
    /// product of the peaks of spectra in reach.
    error: f64,
    /// What the shader states that to be at most.
    bound: f64,
}

/// One shading at numbers of wavelengths.
fn found<const N: usize>(wall: &mut Wall, shading: &Shading, counts: [u32; N]) -> [Found; N] {
    let white = Material {
        bsdf: diffuse(WeightedSpectrum {
            weight: 1.0,
            spectrum: Arc::new(Spectrum::Constant(1.0)),
        }),
        ..Material::default()
    };
    let all = wall.xyz(shading, shading.material.clone(), exact());
    let exposed = wall.xyz(shading, white, exact())[1].max(all[1]);
    let lab = |xyz: [f64; 3]| lab_from_xyz(xyz.map(|v| v / exposed), D65_XYZ);
    let brightest = shading.brightest();
    let equal_energy = xyz_of(|_| brightest);
    counts.map(|count| {
        let shader = wall.shader(shading, shading.material.clone(), grid(count));
        let trees = shading.trees();
        let xyz = shader.xyz(&trees, trees.roots[0], &mut ShadeScratch::default());
        Found {
            delta_e: if exposed < DARK {
                0.0
            } else {
                delta_e_2000(lab(all), lab(xyz))
            },
            error: (0..3)
                .map(|c| (xyz[c] - all[c]).abs() / equal_energy[c])
                .fold(0.0, f64::max),
            bound: shader.bound().unwrap(),
        }
    })
}

/// Every so many of the shadings that `shading` makes of their numbers.
fn of_all<const N: usize>(
    shading: impl Fn(u64) -> Shading + Sync,
    step: usize,
    counts: [u32; N],
) -> Vec<[Found; N]> {
    (0..SHADINGS)
        .step_by(step)
        .collect::<Vec<u64>>()
        .into_par_iter()
        .map_init(Wall::new, |wall, index| {
            found(wall, &shading(index), counts)
        })
        .collect()
}

/// Measured: mean 0.002, 99 % below 0.016, the worst 0.40: a lamp whose table ends in a step, where
/// little else of it is in view. Before curves through points were smoothed, 99 % were below 0.16.
/// Were light down to 1e-30 cd/m² exposed until it is seen, 99 % would be below 0.09.
#[test]
fn the_default_grid_is_within_a_tenth_of_delta_e_of_exact_spectra_and_a_draft_within_a_half() {
    let presets = [Preset::Normal, Preset::Draft].map(|preset| preset.accuracy().wavelengths);
    let all = of_all(Shading::new, 1, presets);
    let [normal, draft] =
        [0, 1].map(|i| Comparison::of(all.iter().map(|found| found[i].delta_e).collect()));
    println!("{normal:?} {draft:?}");
    // A fifth of what is allowed.
    assert!(normal.p99 < 0.02, "{normal:?}");
    assert!(normal.worst < 0.5, "{normal:?}");
    assert!(draft.p99 < 0.5, "{draft:?}");
}

/// A known weakness: a lamp's table that ends at 1 % of its peak and is 0 beyond, where all of it
/// that is in view is that end. A jump falls between two wavelengths, and the error with their
/// distance alone. 99 % are below 0.22, the worst is 0.72; before smoothing 1.4 and 3.0.
#[test]
fn a_lamp_that_ends_in_a_step_is_seen_less_exactly() {
    let stepped = |index: u64| {
        let lamp = Random(index).diode([380.0, 780.0], Beyond::Zero);
        let mut shading = Shading {
            lamp: Arc::new(lamp),
            ..Shading::new(index)
        };
        (shading.material.emission, shading.material.thermal) = (None, None);
        shading
    };
    let all = of_all(stepped, 5, [84]);
    let found = Comparison::of(all.iter().map(|[found]| found.delta_e).collect());
    println!("{found:?}");
    assert!((0.1..0.4).contains(&found.p99), "{found:?}");
    assert!(all.iter().all(|[found]| found.error <= found.bound));
}

/// Every tenth of the shadings, since fine tables take long. Of all of them at most 0.15 of the
/// bound is used at 21 wavelengths, 0.02 at 336.
#[test]
fn the_stated_bound_holds_at_every_spacing() {
    const COUNTS: [u32; 5] = [21, 42, 84, 168, 336];
    const TENTH: usize = 10;
    let all = of_all(Shading::new, TENTH, COUNTS);
    for (i, count) in COUNTS.iter().enumerate() {
        let used = |found: &[Found; 5]| found[i].error / found[i].bound;
        let greatest = all.iter().map(used).fold(0.0, f64::max);
        let mut uses: Vec<f64> = all.iter().map(used).collect();
        uses.sort_by(f64::total_cmp);
        let mut bounds: Vec<f64> = all.iter().map(|f| f[i].bound).collect();
        bounds.sort_by(f64::total_cmp);
        let worst = all.iter().map(|f| f[i].error).fold(0.0, f64::max);
        println!(
            "{count} wavelengths: at most {greatest:.3} of the bound is used, half of them {:.1e}; \
             bounds {:.1e} to {:.1e}, half {:.1e}, worst error {worst:.1e}",
            uses[uses.len() / 2],
            bounds[0],
            bounds[bounds.len() - 1],
            bounds[bounds.len() / 2],
        );
        for (index, found) in all.iter().enumerate() {
            let Found { error, bound, .. } = found[i];
            let number = TENTH * index;
            assert!(error <= bound, "{number} at {count}: {error:e} {bound:e}");
        }
        // Nor is it so loose that it says nothing: so far 0.12 to 0.01.
        assert!(greatest > 0.005, "{count}: {greatest:e}");
    }
}
