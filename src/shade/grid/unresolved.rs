//! A warning about pairs of material and lamp that both have narrow bands all over the spectrum, and
//! move against each other.
//!
//! The product of two narrow curves is integrated where one shift serves both, and where one of them
//! is a few lines. Otherwise one is read by its means over the axis' spacing, which is right only as
//! far as its bands are not correlated with those of the other.

use crate::scene::{Light, Material, Scene};
use crate::shade::curves::CurveShader;
use crate::shade::integrand::Reading;
use crate::shade::material::ReflectorTables;
use crate::shade::settings::Settings;
use crate::shot::Spectra;
use crate::spectrum::{Fine, LogAxis, Spectrum};
use std::fmt;

/// Least error that is worth a warning, as a share of the light.
const WORTH_A_WARNING: f64 = 0.01;

/// A material and a lamp whose reflected light may be wrong where they move against each other.
#[derive(Debug, Clone, PartialEq)]
pub struct Unresolved {
    /// The material.
    pub material: String,
    /// The lamp.
    pub light: String,
    /// The error over the greatest channel, measured where both have the same shift.
    pub error: f64,
    /// How many wavelengths the sensor has, and how many would resolve the bands; that may be more
    /// than a shot may have.
    pub wavelengths: [f64; 2],
}

impl fmt::Display for Unresolved {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [now, enough] = self.wavelengths;
        write!(
            f,
            "material \"{}\" under \"{}\": both have bands narrower than the {now} wavelengths are \
             apart; where they move against each other their light may be off by {:.0} %; ",
            self.material,
            self.light,
            100.0 * self.error,
        )?;
        if enough <= MOST_WAVELENGTHS {
            write!(
                f,
                "`accuracy.wavelengths = {enough}` would tell them apart, "
            )?;
        }
        write!(f, "`accuracy.spectra = \"exact\"` is right")
    }
}

/// Most wavelengths that a shot may have.
const MOST_WAVELENGTHS: f64 = 4096.0;

/// All such pairs of a scene, each lamp's spectrum once. Empty if spectra do not shift or
/// `accuracy.spectra` is neither "grid" nor "spline". A lamp that rests with all bodies makes no
/// pair.
///
/// Takes microseconds where lamps or surfaces have no narrow spectra.
pub fn unresolved(scene: &Scene, settings: &Settings<'_>) -> Vec<Unresolved> {
    let axis = settings.axis();
    let grid = matches!(settings.accuracy.spectra, Spectra::Grid | Spectra::Spline);
    let is_fine = |spectrum: &Spectrum| Fine::is_worth_a_look(axis, spectrum);
    let lamps = scene.lights.iter().any(|light| is_fine(&light.spectrum));
    let surfaces = scene.materials.iter().flat_map(reflectances).any(is_fine);
    if !settings.effects.doppler || !grid || !lamps || !surfaces {
        return Vec::new();
    }
    let exact = settings.quadrature();
    let shader = CurveShader::new(scene, settings, settings.sensor(), &exact);
    let mut pairs = Vec::new();
    for (material, curves) in scene.materials.iter().zip(&shader.materials) {
        for emitter in 0..shader.emitters.len() {
            let mut own = scene.lights.iter().enumerate();
            let moving = own.find(|(index, light)| {
                shader.walk.emitter_of(*index) == emitter && moves(scene, light)
            });
            let Some((_, light)) = moving else { continue };
            let lobes = curves.reflectors().iter();
            let errors = lobes.filter_map(|lobe| shader.lost(lobe, emitter));
            let error = errors.fold(0.0, f64::max);
            if error > WORTH_A_WARNING {
                pairs.push(Unresolved {
                    material: material.name.clone(),
                    light: light.name.clone(),
                    error,
                    wavelengths: [
                        axis.count() as f64,
                        enough(axis, reflectances(material).chain([&*light.spectrum])),
                    ],
                });
            }
        }
    }
    pairs
}

/// The spectra of the lobes that reflect lamps.
fn reflectances(material: &Material) -> impl Iterator<Item = &Spectrum> {
    let lobes = material.bsdf.non_specular().iter();
    lobes.map(|lobe| &*lobe.reflectance.spectrum)
}

/// Whether some body is on another worldline than a lamp.
fn moves(scene: &Scene, light: &Light) -> bool {
    let mut bodies = scene.geometry.instances.iter();
    bodies.any(|body| body.worldline as usize != light.worldline)
}

/// How many wavelengths would be half as far apart as the closest points of spectra.
fn enough<'a>(axis: LogAxis, spectra: impl Iterator<Item = &'a Spectrum>) -> f64 {
    let width = axis.spacing() * axis.count() as f64;
    let finest = spectra.filter_map(Fine::finest).min_by(f64::total_cmp);
    finest.map_or(f64::INFINITY, |finest| (2.0 * width / finest).ceil())
}

impl CurveShader {
    /// The error of a lamp's light on a lobe where the two do not share their shift, over the greatest
    /// channel; None where their product is integrated.
    fn lost(&self, lobe: &ReflectorTables, emitter: usize) -> Option<f64> {
        let light = &self.emitters[emitter].curve;
        let readings = [&lobe.reflectance, light].map(|curve| Reading { curve, shift: 1.0 });
        if readings
            .iter()
            .any(|reading| reading.curve.narrow().is_none())
        {
            return None;
        }
        let exact = lobe.tables[emitter].as_ref()?.at(0.0);
        let found = self.apart(&readings[0], &readings[1])?;
        let greatest = exact.into_iter().fold(f64::MIN_POSITIVE, f64::max);
        let off = (0..3).map(|c| (found[c] - exact[c]).abs() / greatest);
        Some(off.fold(0.0, f64::max))
    }
}
