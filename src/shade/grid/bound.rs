//! The error bound of a grid: over all materials, lamps and shifts of a scene.

use crate::shade::curve::Curve;
use crate::shade::curves::CurveShader;
use crate::shade::integrand::Reading;
use crate::shade::table::XyzTable;
use crate::spectrum::{GridBound, Quadrature, Roughness, Spectrum, planck};

/// Relative error of black bodies by a table over ln T: 2e-5 where the window holds 1e-80 of their
/// light, less where it holds more.
const BLACK_BODIES: f64 = 2e-5;

impl CurveShader {
    /// The largest error of light that the camera sees directly: of each material under each lamp,
    /// of emission and thermal light, and of the sky's spectrum. See
    /// [`Shader::bound`](crate::shade::Shader::bound).
    pub(crate) fn bound(&self, quadrature: &Quadrature) -> f64 {
        let Some(seen_nm) = quadrature.seen_nm() else {
            return 0.0;
        };
        let axis = self.sensor.axis();
        let spacing = self.tabulated.then(|| XyzTable::spacing(axis));
        let grid = GridBound::new(&self.sensor, quadrature, spacing);
        let [near, far] = self
            .reach
            .map(|reach| {
                if self.walk.received().shifts() {
                    reach
                } else {
                    0.0
                }
            })
            .map(|reach| [seen_nm[0] * (-reach).exp(), seen_nm[1] * reach.exp()]);
        let rough = |curve: &Curve, range_nm: [f64; 2]| {
            if curve.constant().is_some() {
                return Roughness::CONSTANT;
            }
            let rough = Roughness::of(|nm| curve.at(nm), curve.spectrum(), range_nm, grid.step());
            match curve.narrow() {
                Some(_) => rough.narrow(),
                None => rough,
            }
        };
        let lamps: Vec<Roughness> = self.emitters.iter().map(|e| rough(&e.curve, far)).collect();
        let mut worst = 0.0f64;
        for material in &self.materials {
            for lobe in material.reflectors() {
                let own = rough(&lobe.reflectance, near);
                for (emitter, lamp) in self.emitters.iter().zip(&lamps) {
                    let reading = |curve| Reading { curve, shift: 1.0 };
                    let both = [&lobe.reflectance, &emitter.curve].map(reading);
                    let apart = both.iter().all(|r| r.curve.narrow().is_some())
                        && self.apart(&both[0], &both[1]).is_some();
                    worst = worst.max(if apart {
                        grid.all_light(&[own, *lamp])
                    } else {
                        grid.relative(&[own, *lamp])
                    });
                }
            }
            if let Some(emission) = &material.emission {
                worst = worst.max(grid.relative(&[rough(&emission.curve, near)]));
            }
            if let Some(thermal) = &material.thermal {
                let (kelvin, emissivity) = thermal.parts();
                let light = |nm| planck::radiance(nm, kelvin);
                // Planck's curve has no corners, as a constant has none.
                let body = Roughness::of(light, &Spectrum::Constant(1.0), near, grid.step());
                let factors = [body, rough(emissivity, near)];
                worst = worst.max(grid.relative(&factors) + BLACK_BODIES);
            }
        }
        if let Some(sky) = self.sky.constant() {
            worst = worst.max(grid.relative(&[rough(&sky.curve, near)]));
        }
        worst
    }
}
