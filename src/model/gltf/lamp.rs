//! Lamps of KHR_lights_punctual, with their numbers in f64.

use super::source::{Source, name_of};
use crate::model::{Lamp, LampKind, Model, ModelError, Warning};
use ::glam::{DAffine3, DMat3, DVec3};
use serde_json::Value;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

impl Source<'_> {
    /// Reads the lamp of a node with the transform `world`.
    pub(super) fn lamp(
        &self,
        light: u64,
        node: &str,
        world: &DAffine3,
        model: &mut Model,
    ) -> Result<(), ModelError> {
        let lights = self.raw["extensions"]["KHR_lights_punctual"]["lights"].as_array();
        let lights = lights.map_or(&[][..], Vec::as_slice);
        let index = usize::try_from(light).unwrap_or(usize::MAX);
        let light = lights.get(index).ok_or_else(|| {
            self.dangling(&format!("node `{node}`"), "light", index, lights.len())
        })?;
        let at = format!("lamp `{}`", name_of(light["name"].as_str(), "light", index));
        let kind = self.lamp_kind(light, &at)?;
        let Some(world) = unscaled(world, kind) else {
            model.warnings.push(Warning::Squashed {
                node: format!("node `{node}`"),
            });
            return Ok(());
        };
        if light["range"].is_number() {
            model.warnings.push(Warning::LampRange {
                lamp: node.to_owned(),
            });
        }
        let intensity = self.amount(light, "intensity", 1.0, f64::MAX, &at)?;
        let color = match light.get("color") {
            None => [1.0; 3],
            Some(color) => self.color(color, &at)?,
        };
        model.lamps.push(Lamp {
            name: node.to_owned(),
            kind,
            intensity,
            color,
            world,
        });
        Ok(())
    }

    fn lamp_kind(&self, light: &Value, at: &str) -> Result<LampKind, ModelError> {
        match light["type"].as_str().unwrap_or_default() {
            "point" => Ok(LampKind::Point),
            "directional" => Ok(LampKind::Sun),
            "spot" => {
                let spot = &light["spot"];
                let outer = self.amount(spot, "outerConeAngle", FRAC_PI_4, FRAC_PI_2, at)?;
                let inner = self.amount(spot, "innerConeAngle", 0.0, FRAC_PI_2, at)?;
                if inner > outer {
                    let problem = format!(
                        "has an inner cone of {inner} rad, expected at most the outer one's {outer}"
                    );
                    return Err(self.invalid(at, problem));
                }
                Ok(LampKind::Spot { inner, outer })
            }
            other => {
                let problem = format!("is of type `{other}`, expected point, directional or spot");
                Err(self.invalid(at, problem))
            }
        }
    }

    /// A number from 0 to `most`, with some room for rounding above.
    fn amount(
        &self,
        from: &Value,
        key: &str,
        default: f64,
        most: f64,
        at: &str,
    ) -> Result<f64, ModelError> {
        const ROUNDING: f64 = 1e-6;
        let Some(value) = from.get(key) else {
            return Ok(default);
        };
        match value.as_f64() {
            Some(number) if (0.0..=most + ROUNDING).contains(&number) => Ok(number.min(most)),
            _ => {
                let problem = format!(
                    "has {key} {value}, expected a number of 0 or more, at most {most:.4e}"
                );
                Err(self.invalid(at, problem))
            }
        }
    }

    fn color(&self, color: &Value, at: &str) -> Result<[f64; 3], ModelError> {
        let numbers: Option<Vec<f64>> = color
            .as_array()
            .and_then(|list| list.iter().map(Value::as_f64).collect());
        match numbers.as_deref() {
            Some(&[r, g, b]) if r.min(g).min(b) >= 0.0 => Ok([r, g, b]),
            _ => Err(self.invalid(
                at,
                format!("has color {color}, expected 3 numbers of 0 or more"),
            )),
        }
    }
}

/// The transform without its scale: directions of z and x kept, y at right angles to both. None if
/// a lamp that needs a direction has none.
fn unscaled(world: &DAffine3, kind: LampKind) -> Option<DAffine3> {
    let matrix = world.matrix3;
    let z = match (matrix.z_axis.try_normalize(), kind) {
        (Some(z), _) => z,
        (None, LampKind::Point) => DVec3::Z,
        (None, _) => return None,
    };
    let x = matrix.x_axis.reject_from_normalized(z);
    let x = x
        .try_normalize()
        .unwrap_or_else(|| z.any_orthonormal_vector());
    let rotation = DMat3::from_cols(x, z.cross(x), z);
    Some(DAffine3::from_mat3_translation(rotation, world.translation))
}
