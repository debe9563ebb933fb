//! A plate small: its pixels as displayed, and what their centres see.

use restframe::color::spaces::{RGB_FROM_XYZ, encode};
use restframe::film::to_rgb8;
use restframe::film::{Development, Film, develop};
use restframe::frame::Frame;
use restframe::probe::{Probe, probe};
use restframe::render::Prepared;
use restframe::render::{Options, View, render};
use restframe::scene::Scene;
use restframe::trace::build_aggregate;
use std::path::Path;
use std::sync::OnceLock;

/// Pixels in a row.
pub(crate) const WIDTH: u32 = 160;
/// Rows.
pub(crate) const HEIGHT: u32 = 90;
/// Samples a pixel.
const SAMPLES: u32 = 4;
/// Neighbors whose D differs by less see the same color: no hue turns by more than 20° over it.
const ONE_COLOR: f64 = 0.04;

/// A frame of a shot at 160 × 90.
pub(crate) struct Thumbnail {
    pub(crate) film: Film,
    /// Stops.
    pub(crate) exposure: f64,
    rgb8: Vec<u8>,
    probes: Vec<Probe>,
    /// Unit vectors in the camera's rest frame.
    directions: Vec<[f64; 3]>,
}

/// A pixel that sees a surface.
#[derive(Clone, Copy)]
pub(crate) struct Pixel<'a> {
    pub(crate) x: u32,
    pub(crate) y: u32,
    /// As displayed, 0 to 255.
    pub(crate) rgb: [f64; 3],
    /// cd/m², of all its samples.
    pub(crate) luminance: f64,
    pub(crate) material: &'a str,
    /// ω_observed/ω_source at its centre.
    pub(crate) doppler: f64,
    /// Where its centre looks, in the camera's rest frame.
    pub(crate) direction: [f64; 3],
    /// What its centre sees.
    pub(crate) probe: &'a Probe,
}

/// Reads a shot of `shots/`, at the thumbnail's size.
pub(crate) fn prepared(stem: &str) -> Prepared {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("shots")
        .join(format!("{stem}.toml"));
    let mut prepared = Prepared::read(&path).unwrap_or_else(|m| panic!("{stem}: {m:?}"));
    prepared.shot.image.size = [WIDTH, HEIGHT];
    prepared
}

/// The film of one frame.
pub(crate) fn film(prepared: &Prepared, frame: u32) -> Film {
    let scene = Scene::resolve(
        &Frame::new(&prepared.shot, frame).unwrap(),
        &prepared.library,
        None,
    )
    .unwrap();
    let aggregate = build_aggregate(&scene.geometry, None);
    let options = Options {
        width: WIDTH,
        height: HEIGHT,
        samples: SAMPLES,
        layers: Vec::new(),
    };
    render(
        &Frame::new(&prepared.shot, frame).unwrap(),
        &scene,
        &aggregate,
        &options,
        &|_| (),
    )
}

impl Thumbnail {
    /// Frame `frame` of a shot of `shots/`.
    pub(crate) fn new(stem: &str, frame: u32) -> Self {
        let prepared = prepared(stem);
        let shot = &prepared.shot;
        let values = Frame::new(shot, frame).unwrap();
        let film = film(&prepared, frame);
        let exposure = prepared.exposure().unwrap().0.stops(&values);
        let development = Development {
            rgb_from_xyz: RGB_FROM_XYZ,
            exposure_stops: exposure,
            encode,
        };
        let rgb8 = to_rgb8(&develop(&film, &development), encode);
        let scene = Scene::resolve(&values, &prepared.library, None).unwrap();
        let aggregate = build_aggregate(&scene.geometry, None);
        let (mut probes, mut directions) = (Vec::new(), Vec::new());
        let effects = |y| values.effects_at(y);
        let under = |effects| View::new(&values, &effects, &scene, &aggregate);
        let mut view = under(effects(0));
        for y in 0..HEIGHT {
            if y > 0 && effects(y) != effects(y - 1) {
                view = under(effects(y));
            }
            for x in 0..WIDTH {
                probes.push(probe(&values, [x, y], &view, &scene, exposure));
                let point = [
                    (f64::from(x) + 0.5) / f64::from(WIDTH),
                    (f64::from(y) + 0.5) / f64::from(HEIGHT),
                ];
                directions.push(scene.camera.looks_along(point).unwrap().to_array());
            }
        }
        Self {
            film,
            exposure,
            rgb8,
            probes,
            directions,
        }
    }

    /// The only frame of a plate, made once for all tests.
    pub(crate) fn plate(number: usize) -> &'static Self {
        static PLATES: [OnceLock<Thumbnail>; 13] = [const { OnceLock::new() }; 13];
        PLATES[number].get_or_init(|| Self::new(&format!("plate-{number:02}"), 1))
    }

    /// The pixel at (x, y), if it sees a surface.
    pub(crate) fn pixel(&self, x: u32, y: u32) -> Option<Pixel<'_>> {
        let at = (y * WIDTH + x) as usize;
        let hit = self.probes[at].hit.as_ref()?;
        Some(Pixel {
            x,
            y,
            rgb: [0, 1, 2].map(|c| f64::from(self.rgb8[3 * at + c])),
            luminance: f64::from(self.film.xyz[at][1]),
            material: &hit.material,
            doppler: hit.doppler,
            direction: self.directions[at],
            probe: &self.probes[at],
        })
    }

    /// All pixels that see a surface.
    pub(crate) fn covered(&self) -> Vec<Pixel<'_>> {
        let all = (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| (x, y)));
        all.filter_map(|(x, y)| self.pixel(x, y)).collect()
    }

    /// Those whose four neighbors see the same material under nearly the same factor.
    pub(crate) fn pure(&self) -> Vec<Pixel<'_>> {
        let like = |pixel: &Pixel<'_>, dx: i32, dy: i32| {
            let (x, y) = (pixel.x as i32 + dx, pixel.y as i32 + dy);
            let inside = (0..WIDTH as i32).contains(&x) && (0..HEIGHT as i32).contains(&y);
            !inside
                || self.pixel(x as u32, y as u32).is_some_and(|other| {
                    other.material == pixel.material
                        && (other.doppler / pixel.doppler - 1.0).abs() < ONE_COLOR
                })
        };
        let mut pixels = self.covered();
        pixels.retain(|p| {
            [(-1, 0), (1, 0), (0, -1), (0, 1)]
                .into_iter()
                .all(|(dx, dy)| like(p, dx, dy))
        });
        pixels
    }
}

impl Pixel<'_> {
    /// The largest channel, 0 to 255.
    pub(crate) fn value(&self) -> f64 {
        self.rgb.into_iter().fold(0.0, f64::max)
    }

    /// 0 for a grey to 1 for a pure color.
    pub(crate) fn saturation(&self) -> f64 {
        let least = self.rgb.into_iter().fold(255.0, f64::min);
        if self.value() == 0.0 {
            0.0
        } else {
            1.0 - least / self.value()
        }
    }

    /// The hue, from -60 (magenta) over 0 (red), 60 (yellow), 120 (green), 180 (cyan), 240 (blue)
    /// to 300; 0 for a grey.
    pub(crate) fn hue(&self) -> f64 {
        let [r, g, b] = self.rgb;
        let span = self.value() * self.saturation();
        if span == 0.0 {
            0.0
        } else if self.value() == r {
            60.0 * (g - b) / span
        } else if self.value() == g {
            120.0 + 60.0 * (b - r) / span
        } else {
            240.0 + 60.0 * (r - g) / span
        }
    }

    /// Angle between where it looks and `axis`, degrees.
    pub(crate) fn degrees_off(&self, axis: [f64; 3]) -> f64 {
        let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        (dot(self.direction, axis) / dot(axis, axis).sqrt())
            .acos()
            .to_degrees()
    }
}

/// The mean of some property of pixels.
pub(crate) fn mean<'p, 'a: 'p>(
    pixels: impl IntoIterator<Item = &'p Pixel<'a>>,
    of: impl Fn(&Pixel<'a>) -> f64,
) -> f64 {
    let values: Vec<f64> = pixels.into_iter().map(of).collect();
    assert!(!values.is_empty(), "no such pixel");
    values.iter().sum::<f64>() / values.len() as f64
}

/// The share of pixels of which something is true.
pub(crate) fn share<'a>(pixels: &[Pixel<'a>], is: impl Fn(&Pixel<'a>) -> bool) -> f64 {
    assert!(!pixels.is_empty(), "no such pixel");
    pixels.iter().filter(|p| is(p)).count() as f64 / pixels.len() as f64
}
