//! `accuracy.spectra = "rgb"`: no spectra, so no Doppler shift. The baseline of accuracy studies.
//!
//! Light is linear Rec. 709 of its XYZ, signed, because many spectra lie outside of that gamut. A
//! reflectance is that of its product with D65 over that of D65. They multiply one by one, so greys
//! are exact under any light, and all reflectances under D65; otherwise the error grows with the
//! saturation of both. Under `sensor.color = "bands"` the three numbers are the bands, and the
//! spectrum of white is constant.

use super::coefficients::{CoefficientBasis, CoefficientShader, Coefficients, Part, Shading};
use crate::color::cie::RANGE_NM;
use crate::color::spaces::{Matrix, RGB_FROM_XYZ, XYZ_FROM_RGB, apply};
use crate::scene::sky::{SkyImage, Stars};
use crate::scene::{Background, Scene};
use crate::shade::curve::Curve;
use crate::shade::received::finite;
use crate::shade::settings::Settings;
use crate::shade::thermal::BlackbodyTable;
use crate::shot::SensorColor;
use crate::spectrum::{ColoredLight, LogAxis, Sensor, Spectrum, illuminant};
use crate::trace::{Root, ShadeTrees};
use glam::DVec3;
use std::sync::Arc;

/// Wavelengths of the sums that the numbers are made by, 0.1 nm apart in the visible: the sum of a
/// gaussian of σ = 0.2 nm is exact within 1e-7, of 1 nm within 1e-9 (`tests/held_spectra.rs`).
const WAVELENGTHS: usize = 4096;

/// Shades trees by three numbers.
pub(crate) struct RgbShader {
    shader: CoefficientShader<RgbBasis>,
}

impl RgbShader {
    /// Prepares a scene's numbers. `sensor` makes the numbers of stars.
    pub(crate) fn new(scene: &Scene, settings: &Settings<'_>, sensor: &Sensor) -> Self {
        let basis = RgbBasis::new(&scene.background, settings, sensor);
        Self {
            shader: CoefficientShader::new(scene, settings, sensor.axis(), basis),
        }
    }

    /// Memory of spectra, bytes.
    pub(crate) fn bytes(&self) -> usize {
        self.shader.held() * size_of::<[f64; 3]>() + WAVELENGTHS * size_of::<[f64; 4]>()
    }

    /// What the camera receives along a ray, in the sensor's channels.
    #[inline]
    pub(crate) fn xyz(
        &self,
        trees: &ShadeTrees,
        root: Root,
        shading: &mut Shading<[f64; 3]>,
    ) -> [f64; 3] {
        let numbers = self.shader.received(trees, root, Part::Whole, shading);
        let channels = self.shader.basis.primaries.channels(*numbers);
        channels.map(|v| finite(v.max(0.0)))
    }
}

impl Coefficients for [f64; 3] {
    #[inline(always)]
    fn add(&mut self, light: &Self, factor: f64) {
        for (sum, light) in self.iter_mut().zip(light) {
            *sum = within(*sum + within(light * factor));
        }
    }

    #[inline(always)]
    fn add_product(&mut self, light: &Self, share: &Self, factor: f64) {
        for ((sum, light), share) in self.iter_mut().zip(light).zip(share) {
            *sum = within(*sum + within(within(light * factor) * share));
        }
    }

    #[inline(always)]
    fn multiply(&mut self, by: &Self) {
        for (value, by) in self.iter_mut().zip(by) {
            *value *= by;
        }
    }
}

/// Finite: the difference of two infinities would not be a number.
#[inline(always)]
fn within(value: f64) -> f64 {
    value.clamp(-f64::MAX, f64::MAX)
}

/// What the three numbers are amounts of: primaries, or bands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Primaries {
    /// Those of Rec. 709.
    Rec709,
    /// The sensor's own channels.
    Bands,
}

impl Primaries {
    /// From the sensor's channels to numbers.
    fn numbers(self, channels: [f64; 3]) -> [f64; 3] {
        match self {
            Self::Rec709 => apply(&RGB_FROM_XYZ, channels),
            Self::Bands => channels,
        }
    }

    /// From numbers to the sensor's channels.
    #[inline(always)]
    fn channels(self, numbers: [f64; 3]) -> [f64; 3] {
        match self {
            Self::Rec709 => apply(&XYZ_FROM_RGB, numbers),
            Self::Bands => numbers,
        }
    }
}

/// Spectra as three numbers.
struct RgbBasis {
    primaries: Primaries,
    fine: DenseSensor,
    /// The light that reflectances are relative to, and its numbers.
    white: (Spectrum, [f64; 3]),
    sky: RgbSky,
}

impl RgbBasis {
    fn new(sky: &Background, settings: &Settings<'_>, sensor: &Sensor) -> Self {
        let (primaries, white) = match settings.sensor.color {
            SensorColor::Cie1931 => (Primaries::Rec709, d65()),
            SensorColor::Bands => (Primaries::Bands, Spectrum::Constant(1.0)),
        };
        let fine = DenseSensor::new(settings);
        let numbers = primaries.numbers(fine.channels(|nm| white.at(nm)));
        Self {
            sky: RgbSky::new(sky, primaries, &fine, sensor),
            primaries,
            fine,
            white: (white, numbers),
        }
    }
}

fn d65() -> Spectrum {
    illuminant("D65").expect("D65 has a table")
}

impl CoefficientBasis for RgbBasis {
    type Coefficients = [f64; 3];

    fn light(&self, curve: impl Fn(f64) -> f64) -> [f64; 3] {
        self.primaries.numbers(self.fine.channels(curve))
    }

    fn share(&self, curve: &Curve) -> [f64; 3] {
        if let Some(gray) = curve.constant() {
            return [gray; 3];
        }
        let (light, white) = &self.white;
        let colored = self.light(|nm| light.at(nm) * curve.at(nm));
        // In a window outside of the visible white is 0, and so is all light.
        [0, 1, 2].map(|i| {
            if white[i] == 0.0 {
                0.0
            } else {
                colored[i] / white[i]
            }
        })
    }

    #[inline(always)]
    fn clear(&self, coefficients: &mut [f64; 3]) {
        *coefficients = [0.0; 3];
    }

    #[inline(always)]
    fn shifted<'a>(&self, rgb: &'a [f64; 3], _: f64, _: &'a mut [f64; 3]) -> &'a [f64; 3] {
        rgb
    }

    #[inline]
    fn add_sky(&self, direction: DVec3, out: &mut [f64; 3]) {
        self.sky.add(direction, self.primaries, out);
    }
}

/// The sensor at so many wavelengths that its sums stand for integrals.
enum DenseSensor {
    Sees(Sensor, Vec<f64>),
    /// The window lies outside of the visible.
    Blind,
}

impl DenseSensor {
    fn new(settings: &Settings<'_>) -> Self {
        let [from, to] = settings.sensor.window;
        let sensor = match settings.sensor.color {
            SensorColor::Bands => Sensor::bands(LogAxis::new([from, to], WAVELENGTHS)),
            SensorColor::Cie1931 => {
                let seen = [from.max(RANGE_NM[0]), to.min(RANGE_NM[1])];
                if seen[0] >= seen[1] {
                    return Self::Blind;
                }
                Sensor::cie1931(LogAxis::new(seen, WAVELENGTHS))
            }
        };
        let wavelengths_nm = sensor.axis().wavelengths_nm();
        Self::Sees(sensor, wavelengths_nm)
    }

    /// XYZ, or band totals, of a curve.
    fn channels(&self, curve: impl Fn(f64) -> f64) -> [f64; 3] {
        match self {
            Self::Blind => [0.0; 3],
            Self::Sees(sensor, wavelengths_nm) => {
                let values: Vec<f64> = wavelengths_nm.iter().map(|nm| curve(*nm)).collect();
                sensor.xyz(&values)
            }
        }
    }
}

/// The sky in its rest frame.
struct RgbSky {
    constant: Option<[f64; 3]>,
    /// An image, and the matrix from its colours to numbers.
    image: Option<(Arc<SkyImage>, Matrix)>,
    stars: Option<(Arc<Stars>, BlackbodyTable)>,
}

impl RgbSky {
    fn new(sky: &Background, primaries: Primaries, fine: &DenseSensor, sensor: &Sensor) -> Self {
        let lit = sky.scale > 0.0;
        let scaled =
            |channels: [f64; 3]| primaries.numbers(channels.map(|v| within(v * sky.scale)));
        let constant = sky.spectrum.as_ref().filter(|_| lit);
        let image = sky.image.as_ref().filter(|_| lit);
        let stars = sky.stars.as_ref();
        Self {
            constant: constant.map(|spectrum| scaled(fine.channels(|nm| spectrum.at(nm)))),
            image: image.map(|image| {
                let [r, g, b] = of_colors(fine).map(scaled);
                let rows = [0, 1, 2].map(|i| [r[i], g[i], b[i]]);
                (Arc::clone(image), rows)
            }),
            stars: stars.map(|stars| (Arc::clone(stars), BlackbodyTable::new(sensor))),
        }
    }

    #[inline]
    fn add(&self, direction: DVec3, primaries: Primaries, out: &mut [f64; 3]) {
        if let Some(constant) = &self.constant {
            out.add(constant, 1.0);
        }
        if let Some((image, numbers_from_rgb)) = &self.image {
            out.add(
                &apply(numbers_from_rgb, image.rgb(direction)).map(within),
                1.0,
            );
        }
        if let Some((stars, bodies)) = &self.stars {
            for star in stars.seen(direction) {
                let disc = primaries.numbers(bodies.xyz(star.temperature_k));
                out.add(&disc, finite(star.scale));
            }
        }
    }
}

/// The sensor's channels of an image's red, green and blue, by the spectra that stand for them, scaled
/// so that their sum is that of D65, an image's white.
fn of_colors(fine: &DenseSensor) -> [[f64; 3]; 3] {
    let d65 = d65();
    let white = fine.channels(|nm| d65.at(nm));
    let colors = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|rgb| {
        let color = ColoredLight::new(rgb);
        fine.channels(|nm| d65.at(nm) * color.at(nm))
    });
    let scale = [0, 1, 2].map(|i| {
        let sum: f64 = colors.iter().map(|color| color[i]).sum();
        if sum > 0.0 { white[i] / sum } else { 0.0 }
    });
    colors.map(|color| [0, 1, 2].map(|i| color[i] * scale[i]))
}
