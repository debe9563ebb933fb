//! Light of the sky in one direction, for grid, spline and exact: its spectrum, its image and its
//! stars.
//!
//! A colour of the image stands for the spectrum [`ColoredLight`] times D65, which is read under the
//! shift. Outside of the visible that spectrum is extrapolated, because an image does not say more:
//! the colour's curve by its end values, D65 by those of its table (300 and 780 nm). Where the shift
//! is 1 and the sensor is the CIE's over the visible, the channels are XYZ of the colour itself,
//! without wavelengths; both ways agree within [`AGREEMENT`].

use super::bake::Bake;
use super::curve::Curve;
use super::integrand::{Reading, Source};
use super::material::EmitterTable;
use super::received::{Doppler, finite};
use super::thermal::BlackbodyTable;
use crate::color::spaces::{Matrix, RGB_FROM_XYZ, XYZ_FROM_RGB, apply};
use crate::scene::Background;
use crate::scene::sky::{SkyImage, Stars};
use crate::spectrum::{ColoredLight, LogAxis, Sensor, illuminant, planck};
use glam::DVec3;
use std::sync::Arc;

/// Largest difference between XYZ of a colour and that of its spectrum, over the greatest of X, Y
/// and Z, with which the first stands in for the second.
const AGREEMENT: f64 = 1e-3;

/// Colours at which the agreement is tested: the most saturated, and some between.
const TESTED: [[f64; 3]; 8] = [
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [0.0, 1.0, 1.0],
    [1.0, 0.0, 1.0],
    [1.0, 1.0, 0.0],
    [1.0, 1.0, 1.0],
    [0.2, 0.5, 1.0],
];

/// Spectra of the sky of one image.
pub(super) struct SkyShade {
    constant: Option<EmitterTable>,
    image: Option<SkyImageLight>,
    stars: Option<(Arc<Stars>, Arc<BlackbodyTable>)>,
}

impl SkyShade {
    /// Prepares the spectra. `bodies` is Some where the sky has stars.
    pub(super) fn new(
        sky: &Background,
        bake: &Bake<'_>,
        bodies: Option<Arc<BlackbodyTable>>,
    ) -> Self {
        let lit = sky.scale > 0.0;
        let constant = sky.spectrum.as_ref().filter(|_| lit).map(|spectrum| {
            let curve = bake.curve(spectrum, sky.scale, f64::INFINITY);
            bake.emitter_table(curve, bake.settings.reach)
        });
        let image = sky.image.as_ref().filter(|_| lit);
        Self {
            constant,
            image: image.map(|image| SkyImageLight::new(Arc::clone(image), sky.scale, bake)),
            stars: sky.stars.clone().zip(bodies),
        }
    }

    /// Memory of curves and tables, bytes.
    pub(super) fn bytes(&self) -> usize {
        self.constant.as_ref().map_or(0, EmitterTable::bytes)
            + self.image.as_ref().map_or(0, |image| image.d65.bytes())
    }

    /// The spectrum that is the same in all directions.
    pub(super) fn constant(&self) -> Option<&EmitterTable> {
        self.constant.as_ref()
    }

    /// The sensor's channels of the light received from a unit direction, in the sky's own axes and
    /// away from the observer. `scratch` has the length of the sensor's axis.
    #[inline]
    pub(super) fn xyz(
        &self,
        direction: DVec3,
        doppler: Doppler,
        sensor: &Sensor,
        scratch: &mut [f32],
    ) -> [f64; 3] {
        let mut sum = [0.0; 3];
        let mut add = |xyz: [f64; 3]| (0..3).for_each(|c| sum[c] += xyz[c]);
        if let Some(own) = &self.constant {
            add(own.xyz(doppler, sensor, scratch));
        }
        if let Some(image) = &self.image {
            add(image.xyz(direction, doppler, sensor, scratch));
        }
        if let Some((stars, bodies)) = &self.stars {
            for star in stars.seen(direction) {
                let factor = finite(star.scale * doppler.black_body());
                let kelvin = finite(doppler.shift() * star.temperature_k);
                add(bodies.xyz(kelvin).map(|v| v * factor));
            }
        }
        sum.map(finite)
    }

    /// Adds the spectral radiance (W·m⁻²·sr⁻¹·nm⁻¹) of the same light at the axis' wavelengths.
    pub(super) fn add(
        &self,
        direction: DVec3,
        doppler: Doppler,
        axis: LogAxis,
        out: &mut [f64],
        scratch: &mut [f32],
    ) {
        if let Some(own) = &self.constant {
            own.add(doppler, out, scratch);
        }
        if let Some(image) = &self.image {
            let shift = doppler.shift();
            let factor = image.read(image.image.rgb(direction), shift, scratch);
            let factor = finite(factor * doppler.radiance());
            for (out, shape) in out.iter_mut().zip(&*scratch) {
                *out += factor * f64::from(*shape);
            }
        }
        if let Some((stars, _)) = &self.stars {
            for star in stars.seen(direction) {
                let factor = finite(star.scale * doppler.black_body());
                let kelvin = finite(doppler.shift() * star.temperature_k);
                for (j, out) in out.iter_mut().enumerate() {
                    let nm = axis.wavelength_nm(j as f64);
                    *out += factor * planck::radiance(nm, kelvin);
                }
            }
        }
    }

    /// Adds the same light as functions of wavelength.
    pub(super) fn add_sources<'a>(
        &'a self,
        direction: DVec3,
        doppler: Doppler,
        sources: &mut Vec<Source<'a>>,
    ) {
        let (power, shift) = (doppler.radiance(), doppler.shift());
        let reading = |curve: &'a Curve| Reading { curve, shift };
        sources.extend(self.constant.as_ref().map(|own| Source::Curve {
            factor: power,
            reading: reading(&own.curve),
        }));
        sources.extend(self.image.as_ref().map(|image| Source::Image {
            factor: finite(image.scale * power),
            light: ColoredLight::new(image.image.rgb(direction)),
            d65: reading(&image.d65),
        }));
        let stars = self
            .stars
            .iter()
            .flat_map(|(stars, _)| stars.seen(direction));
        sources.extend(stars.map(|star| Source::BlackBody {
            factor: finite(star.scale * doppler.black_body()),
            kelvin: finite(shift * star.temperature_k),
        }));
    }
}

/// Light of a sky image.
struct SkyImageLight {
    image: Arc<SkyImage>,
    scale: f64,
    d65: Curve,
    wavelengths_nm: Vec<f32>,
    /// XYZ of a colour at scale 1 and shift 1; None if the sensor's channels of its spectrum differ.
    xyz_from_rgb: Option<Matrix>,
}

impl SkyImageLight {
    fn new(image: Arc<SkyImage>, scale: f64, bake: &Bake<'_>) -> Self {
        let sensor = bake.sensor;
        let d65 = Arc::new(illuminant("D65").expect("D65 has a table"));
        let wavelengths_nm = sensor.axis().wavelengths_nm();
        let mut made = Self {
            image,
            scale,
            d65: bake.smooth_curve(&d65, 1.0, f64::INFINITY),
            wavelengths_nm: wavelengths_nm.iter().map(|nm| *nm as f32).collect(),
            xyz_from_rgb: None,
        };
        made.xyz_from_rgb = made.own_colors(sensor);
        made
    }

    /// The matrix from colours to XYZ, relative to the sensor's white; None if the sensor's channels
    /// of their spectra differ.
    fn own_colors(&self, sensor: &Sensor) -> Option<Matrix> {
        let mut shape = vec![0.0; self.wavelengths_nm.len()];
        let mut by_curve = |rgb: [f64; 3]| {
            let factor = self.read(rgb, 1.0, &mut shape) / self.scale;
            sensor.xyz_of_shape(&shape).map(|v| v * factor)
        };
        // Channels are relative to those of D65, whose table is not quite the white of the colours.
        let white = apply(&RGB_FROM_XYZ, by_curve([1.0; 3]));
        let own = XYZ_FROM_RGB.map(|row| [0, 1, 2].map(|c| row[c] * white[c]));
        let agrees = |rgb: [f64; 3]| {
            let (curve, own) = (by_curve(rgb), apply(&own, rgb));
            let greatest = curve.into_iter().fold(0.0, f64::max);
            (0..3).all(|c| (curve[c] - own[c]).abs() <= AGREEMENT * greatest)
        };
        TESTED.into_iter().all(agrees).then_some(own)
    }

    #[inline]
    fn xyz(
        &self,
        direction: DVec3,
        doppler: Doppler,
        sensor: &Sensor,
        shape: &mut [f32],
    ) -> [f64; 3] {
        let rgb = self.image.rgb(direction);
        let shift = doppler.shift();
        let power = doppler.radiance();
        let (xyz, factor) = match &self.xyz_from_rgb {
            Some(matrix) if shift == 1.0 => (apply(matrix, rgb), self.scale),
            _ => {
                let factor = self.read(rgb, shift, shape);
                (sensor.xyz_of_shape(shape), factor)
            }
        };
        let factor = finite(factor * power);
        // Rounding may take the sensor's weights below 0.
        xyz.map(|v| finite(v.max(0.0) * factor))
    }

    /// Writes the shape of a colour's spectrum at `shift` times the axis' wavelengths. Returns its
    /// factor, finite.
    #[inline]
    fn read(&self, rgb: [f64; 3], shift: f64, out: &mut [f32]) -> f64 {
        let light = ColoredLight::new(rgb);
        let peak = self.d65.read(shift, out);
        light.multiply(shift, &self.wavelengths_nm, out);
        finite(finite(light.factor() * self.scale) * peak)
    }
}
