//! The shader of one image, by how the shot holds its spectra.

use super::bake::Settings;
use super::components::Walk;
use super::curves::CurveShader;
use super::lines::LineShader;
use super::passage::Passages;
use super::radiance::Radiance;
use super::received::finite;
use super::rgb::RgbShader;
use crate::frame;
use crate::scene::Scene;
use crate::shot::{SensorColor, Spectra};
use crate::spectrum::{Lines, LogAxis, Quadrature, Sensor};
use crate::trace::{Root, ShadeTrees};

/// Turns shade trees to light.
pub struct Shader {
    sensor: Sensor,
    held: Held,
    /// What a grid's error is stated against; None in other modes.
    reference: Option<Quadrature>,
}

/// What makes channels of shade trees.
enum Held {
    /// The scene's curves.
    Curves(CurveShader),
    /// Samples at equal distances.
    Lines(Box<LineShader>),
    /// Three numbers.
    Rgb(Box<RgbShader>),
    /// The scene's curves as their author wrote them, by quadrature.
    Exact(CurveShader, Quadrature),
}

impl Shader {
    /// Prepares the curves of a scene.
    pub fn new(scene: &Scene, settings: &Settings<'_>) -> Self {
        let axis = LogAxis::new(
            settings.sensor.window,
            settings.accuracy.wavelengths as usize,
        );
        let sensor = sensor(settings.sensor, axis);
        let exact = quadrature(settings.sensor);
        let held = match settings.accuracy.spectra {
            Spectra::Grid | Spectra::Spline => {
                Held::Curves(CurveShader::new(scene, settings, sensor.clone(), &exact))
            }
            Spectra::Exact => {
                let curves = CurveShader::new(scene, settings, sensor.clone(), &exact);
                Held::Exact(curves, exact.clone())
            }
            Spectra::Lines => Held::Lines(Box::new(LineShader::new(scene, settings, axis))),
            Spectra::Rgb => Held::Rgb(Box::new(RgbShader::new(scene, settings, &sensor))),
        };
        let grid = settings.accuracy.spectra == Spectra::Grid;
        Self {
            held,
            reference: grid.then_some(exact),
            sensor,
        }
    }

    /// The sensor's wavelengths, nm.
    pub fn wavelengths_nm(&self) -> Vec<f64> {
        self.sensor.axis().wavelengths_nm()
    }

    /// What the camera receives along a ray, in the sensor's channels: XYZ (cd/m²), or the totals of
    /// three bands (W·m⁻²·sr⁻¹); finite.
    #[inline]
    pub fn xyz(&self, trees: &ShadeTrees, root: Root, scratch: &mut ShadeScratch) -> [f64; 3] {
        let channels = match &self.held {
            Held::Curves(curves) => curves.xyz(trees, root, scratch),
            Held::Lines(lines) => lines.xyz(trees, root, &mut scratch.lines),
            Held::Rgb(rgb) => rgb.xyz(trees, root, &mut scratch.rgb),
            Held::Exact(curves, quadrature) => curves.exact(quadrature, trees, root),
        };
        channels.map(finite)
    }

    /// Spectral radiance that the camera receives along a ray, at [`Shader::wavelengths_nm`]; none
    /// where spectra are three numbers.
    pub fn radiance(&self, trees: &ShadeTrees, root: Root) -> Radiance {
        match &self.held {
            Held::Lines(lines) => lines.radiance(trees, root),
            Held::Curves(curves) | Held::Exact(curves, _) => curves.radiance(trees, root),
            Held::Rgb(_) => Radiance::new(self.sensor.axis().count()),
        }
    }

    /// The largest error of what the camera sees directly, where grids of wavelengths state one:
    /// |Δ| of a channel over that channel of an equal-energy light as bright as the product of the
    /// peaks of spectra in reach, the greatest over materials with each lamp. None in other modes.
    ///
    /// Takes some milliseconds.
    pub fn bound(&self) -> Option<f64> {
        match (&self.held, &self.reference) {
            (Held::Curves(curves), Some(reference)) => Some(curves.bound(reference)),
            _ => None,
        }
    }

    /// Memory of its curves and tables, bytes, but for what it shares with the scene.
    pub fn bytes(&self) -> usize {
        match &self.held {
            Held::Curves(curves) | Held::Exact(curves, _) => curves.bytes(),
            Held::Lines(lines) => lines.bytes(),
            Held::Rgb(rgb) => rgb.bytes(),
        }
    }

    /// The sensor's channels of spectral radiance at [`Shader::wavelengths_nm`].
    pub fn xyz_of(&self, radiance: &[f64]) -> [f64; 3] {
        self.sensor.xyz(radiance)
    }
}

/// A shot's sensor over an axis.
pub(super) fn sensor(sensor: &frame::Sensor, axis: LogAxis) -> Sensor {
    match sensor.color {
        SensorColor::Cie1931 => Sensor::cie1931(axis),
        SensorColor::Bands => Sensor::bands(axis),
    }
}

/// The integrals that a sensor's channels stand for.
pub(super) fn quadrature(sensor: &frame::Sensor) -> Quadrature {
    match sensor.color {
        SensorColor::Cie1931 => Quadrature::cie1931(sensor.window),
        SensorColor::Bands => Quadrature::bands(sensor.window),
    }
}

/// Scratch memory of a [`Shader`], to be kept from ray to ray.
#[derive(Default)]
pub struct ShadeScratch {
    pub(super) comoving: Vec<[f64; 2]>,
    light: Vec<f32>,
    reflected: Vec<f32>,
    pub(super) passages: Passages,
    pub(super) radiance: Radiance,
    lines: Walk<Lines>,
    rgb: Walk<[f64; 3]>,
}

impl ShadeScratch {
    pub(super) fn buffers(&mut self, count: usize) -> [&mut [f32]; 2] {
        self.light.resize(count, 0.0);
        self.reflected.resize(count, 0.0);
        [&mut self.light, &mut self.reflected]
    }
}
