//! The shader of one image, by how the shot holds its spectra (`accuracy.spectra`).

use super::compare::{LineShader, RgbShader};
use super::curves::CurveShader;
use super::radiance::Radiance;
use super::received::finite;
use super::scratch::ShadeScratch;
use super::settings::Settings;
use crate::scene::Scene;
use crate::shot::Spectra;
use crate::spectrum::{Quadrature, Sensor};
use crate::trace::{Root, ShadeTrees};

/// Turns shade trees to light.
pub struct Shader {
    sensor: Sensor,
    mode: Mode,
}

/// How spectra are held.
enum Mode {
    /// Grid: curves baked on the sensor's axis, and tables. The quadrature is what the grid's error is
    /// stated against.
    Grid(CurveShader, Quadrature),
    /// Curves as their author wrote them, read at the sensor's wavelengths.
    Spline(CurveShader),
    /// Curves as their author wrote them, integrated.
    Exact(CurveShader, Quadrature),
    /// Samples at equal distances in wavelength.
    Lines(Box<LineShader>),
    /// Three numbers.
    Rgb(Box<RgbShader>),
}

impl Shader {
    /// Prepares the spectra of a scene.
    pub fn new(scene: &Scene, settings: &Settings<'_>) -> Self {
        let sensor = settings.sensor();
        let exact = settings.quadrature();
        let curves = || CurveShader::new(scene, settings, sensor.clone(), &exact);
        let mode = match settings.accuracy.spectra {
            Spectra::Grid => Mode::Grid(curves(), exact.clone()),
            Spectra::Spline => Mode::Spline(curves()),
            Spectra::Exact => Mode::Exact(curves(), exact.clone()),
            Spectra::Lines => {
                Mode::Lines(Box::new(LineShader::new(scene, settings, sensor.axis())))
            }
            Spectra::Rgb => Mode::Rgb(Box::new(RgbShader::new(scene, settings, &sensor))),
        };
        Self { mode, sensor }
    }

    /// The sensor's wavelengths, nm.
    pub fn wavelengths_nm(&self) -> Vec<f64> {
        self.sensor.axis().wavelengths_nm()
    }

    /// What the camera receives along a ray, in the sensor's channels: XYZ (cd/m²), or under
    /// `sensor.color = "bands"` the totals of three bands (W·m⁻²·sr⁻¹); finite.
    #[inline]
    pub fn xyz(&self, trees: &ShadeTrees, root: Root, scratch: &mut ShadeScratch) -> [f64; 3] {
        let channels = match &self.mode {
            Mode::Grid(curves, _) | Mode::Spline(curves) => curves.xyz(trees, root, scratch),
            Mode::Exact(curves, quadrature) => curves.exact(quadrature, trees, root),
            Mode::Lines(lines) => lines.xyz(trees, root, &mut scratch.lines),
            Mode::Rgb(rgb) => rgb.xyz(trees, root, &mut scratch.rgb),
        };
        channels.map(finite)
    }

    /// Spectral radiance that the camera receives along a ray, at [`Shader::wavelengths_nm`]; 0 in
    /// RGB, which has no spectra.
    pub fn radiance(&self, trees: &ShadeTrees, root: Root) -> Radiance {
        match &self.mode {
            Mode::Grid(curves, _) | Mode::Spline(curves) | Mode::Exact(curves, _) => {
                curves.radiance(trees, root)
            }
            Mode::Lines(lines) => lines.radiance(trees, root),
            Mode::Rgb(_) => Radiance::new(self.sensor.axis().count()),
        }
    }

    /// The largest error that a grid states for what the camera sees directly: |Δ| of a channel over
    /// that channel of an equal-energy light as bright as the product of the peaks of spectra in
    /// reach, the greatest over materials with each lamp. None in other modes.
    ///
    /// Takes some milliseconds.
    pub fn bound(&self) -> Option<f64> {
        match &self.mode {
            Mode::Grid(curves, reference) => Some(curves.bound(reference)),
            _ => None,
        }
    }

    /// Memory of its curves and tables, bytes, but for what it shares with the scene.
    pub fn bytes(&self) -> usize {
        match &self.mode {
            Mode::Grid(curves, _) | Mode::Spline(curves) | Mode::Exact(curves, _) => curves.bytes(),
            Mode::Lines(lines) => lines.bytes(),
            Mode::Rgb(rgb) => rgb.bytes(),
        }
    }

    /// The sensor's channels of spectral radiance at [`Shader::wavelengths_nm`].
    pub fn xyz_of(&self, radiance: &[f64]) -> [f64; 3] {
        self.sensor.xyz(radiance)
    }
}
