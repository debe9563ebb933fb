//! `accuracy.spectra = "lines"`: spectra as samples at equal distances from 50 to 5000 nm, resampled
//! at every shift. This is the method that splines replaced in 1990 (Hsiung et al. 1990 §3.2, §6),
//! for comparison of accuracy and time, so it takes no short cut but one: a shift of exactly 1
//! resamples nothing.

use super::coefficients::{CoefficientBasis, CoefficientShader, Coefficients, Part, Shading};
use crate::scene::sky::{SkyImage, Stars};
use crate::scene::{Background, Scene};
use crate::shade::curve::Curve;
use crate::shade::radiance::Radiance;
use crate::shade::received::finite;
use crate::shade::settings::Settings;
use crate::shot::SensorColor;
use crate::spectrum::{ColoredLight, LineAxis, Lines, LogAxis, illuminant, planck};
use crate::trace::{Root, ShadeTrees};
use glam::DVec3;
use std::sync::Arc;

/// Shades trees by lines.
pub(crate) struct LineShader {
    shader: CoefficientShader<LineBasis>,
    /// For each line that the sensor sees, its weight in each channel.
    weights: Vec<(usize, [f64; 3])>,
    /// The wavelengths of [`LineShader::radiance`].
    curves: LogAxis,
}

impl LineShader {
    /// Prepares a scene's lines; `curves` is the axis of [`LineShader::radiance`].
    pub(crate) fn new(scene: &Scene, settings: &Settings<'_>, curves: LogAxis) -> Self {
        let axis = LineAxis::new(settings.accuracy.line_spacing);
        let window = settings.sensor.window;
        let weights = match settings.sensor.color {
            SensorColor::Cie1931 => axis.cie1931(window),
            SensorColor::Bands => axis.bands(window),
        };
        let basis = LineBasis {
            axis,
            sky: LineSky::new(&scene.background, axis),
        };
        Self {
            shader: CoefficientShader::new(scene, settings, curves, basis),
            weights,
            curves,
        }
    }

    /// Memory of spectra, bytes.
    pub(crate) fn bytes(&self) -> usize {
        self.shader.held() * self.shader.basis.axis.count() * size_of::<f64>()
    }

    /// What the camera receives along a ray, in the sensor's channels.
    pub(crate) fn xyz(
        &self,
        trees: &ShadeTrees,
        root: Root,
        shading: &mut Shading<Lines>,
    ) -> [f64; 3] {
        self.shader
            .received(trees, root, Part::Whole, shading)
            .weigh(&self.weights)
    }

    /// Spectral radiance that the camera receives along a ray: linear between lines, 0 beyond them.
    pub(crate) fn radiance(&self, trees: &ShadeTrees, root: Root) -> Radiance {
        let wavelengths = self.curves.wavelengths_nm();
        let axis = self.shader.basis.axis;
        let mut shading = Shading::default();
        let mut part = |part| {
            let lines = self.shader.received(trees, root, part, &mut shading);
            wavelengths.iter().map(|nm| lines.at(axis, *nm)).collect()
        };
        Radiance {
            surface: part(Part::Surface),
            thermal: part(Part::Thermal),
        }
    }
}

impl Coefficients for Lines {
    fn add(&mut self, light: &Self, factor: f64) {
        Lines::add(self, light, factor);
    }

    fn add_product(&mut self, light: &Self, share: &Self, factor: f64) {
        Lines::add_product(self, light, share, factor);
    }

    fn multiply(&mut self, by: &Self) {
        Lines::multiply(self, by);
    }
}

/// Spectra as lines of one axis.
struct LineBasis {
    axis: LineAxis,
    sky: LineSky,
}

impl CoefficientBasis for LineBasis {
    type Coefficients = Lines;

    fn light(&self, curve: impl Fn(f64) -> f64) -> Lines {
        Lines::sample(self.axis, curve)
    }

    fn share(&self, curve: &Curve) -> Lines {
        Lines::sample(self.axis, |nm| curve.at(nm))
    }

    fn clear(&self, lines: &mut Lines) {
        lines.clear(self.axis);
    }

    fn shifted<'a>(&self, lines: &'a Lines, shift: f64, buffer: &'a mut Lines) -> &'a Lines {
        if shift == 1.0 {
            return lines;
        }
        lines.resample(self.axis, shift, buffer);
        buffer
    }

    fn add_sky(&self, direction: DVec3, out: &mut Lines) {
        self.sky.add(direction, self.axis, out);
    }
}

/// The sky in its rest frame.
struct LineSky {
    constant: Option<Lines>,
    /// An image, and the lines of D65 times its scale.
    image: Option<(Arc<SkyImage>, Lines)>,
    stars: Option<Arc<Stars>>,
}

impl LineSky {
    fn new(sky: &Background, axis: LineAxis) -> Self {
        let lit = sky.scale > 0.0;
        let scaled = |spectrum: &crate::spectrum::Spectrum| {
            Lines::sample(axis, |nm| finite(sky.scale * spectrum.at(nm)))
        };
        let image = sky.image.as_ref().filter(|_| lit).map(|image| {
            let d65 = illuminant("D65").expect("D65 has a table");
            (Arc::clone(image), scaled(&d65))
        });
        let constant = sky.spectrum.as_ref().filter(|_| lit);
        Self {
            constant: constant.map(|spectrum| scaled(spectrum)),
            image,
            stars: sky.stars.clone(),
        }
    }

    fn add(&self, direction: DVec3, axis: LineAxis, out: &mut Lines) {
        if let Some(constant) = &self.constant {
            out.add(constant, 1.0);
        }
        if let Some((image, d65)) = &self.image {
            let color = ColoredLight::new(image.rgb(direction));
            let curve = Lines::sample(axis, |nm| color.at(nm));
            out.add_product(d65, &curve, 1.0);
        }
        if let Some(stars) = &self.stars {
            for star in stars.seen(direction) {
                let disc = Lines::sample(axis, |nm| planck::radiance(nm, star.temperature_k));
                out.add(&disc, finite(star.scale));
            }
        }
    }
}
