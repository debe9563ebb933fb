//! Worldlines and models: speeds below c, directions, arrays, files.

use super::checks::Checks;
use crate::shot::names::short;
use crate::shot::{Model, Scale, Track, Velocity, Worldline};
use std::collections::HashSet;
use std::path::Path;

/// Largest number of instances in one array.
pub const MAX_INSTANCES: u128 = 10_000_000;

const DIRECTION_HELP: &str = "only what is at rest needs no direction; its length does not matter";

impl Checks<'_> {
    pub(super) fn worldlines(&mut self) {
        for own in ["lab", "camera"] {
            let key = format!("worldline.{own}");
            if self.given(&key) {
                let message = format!("the worldline {own:?} exists already and cannot be defined");
                self.report(&key, message, "give this one another name");
            }
        }
        for (name, worldline) in &self.shot.worldline {
            self.worldline(&format!("worldline.{name}.velocity"), worldline);
        }
    }

    fn worldline(&mut self, key: &str, worldline: &Worldline) {
        match &worldline.velocity {
            Velocity::Beta(velocity) => self.speeds(key, velocity),
            Velocity::Gamma(v) => self.direction(key, &v.gamma, 1.0, &v.direction),
            Velocity::Rapidity(v) => self.direction(key, &v.rapidity, 0.0, &v.direction),
        }
    }

    fn speeds(&mut self, key: &str, velocity: &Track<[f64; 3]>) {
        for (end, beta) in velocity.authored() {
            let speed = length(beta);
            if speed >= 1.0 {
                let message = format!(
                    "a speed of {speed} c: nothing moves at the speed of light or above it"
                );
                let help = "velocities are in units of c, below 1; very near to 1 write { gamma, direction }";
                self.report(&format!("{key}{end}"), message, help);
            }
        }
    }

    /// Reports a direction of zero, unless the speed is zero too: `measure` (a Lorentz factor or a
    /// rapidity) then has the value `rest`.
    fn direction(
        &mut self,
        key: &str,
        measure: &Track<f64>,
        rest: f64,
        direction: &Track<[f64; 3]>,
    ) {
        let wrong = |measure: f64, direction: [f64; 3]| measure != rest && is_zero(direction);
        if let Some(instant) = self.first(measure, direction, wrong) {
            let message = format!("the direction is zero at frame {instant}, where it moves");
            self.report(&format!("{key}.direction"), message, DIRECTION_HELP);
        }
    }

    pub(super) fn models(&mut self) {
        let mut names = HashSet::new();
        for (key, model) in self.each("model", &self.shot.model) {
            if let Some(name) = &model.name
                && !names.insert(name)
            {
                let message = format!("a second model is named {:?}", short(name));
                self.report(
                    &format!("{key}.name"),
                    message,
                    "give each model a name of its own",
                );
            }
            self.model(&key, model);
        }
    }

    fn model(&mut self, key: &str, model: &Model) {
        self.model_file(&format!("{key}.file"), model);
        self.check_worldline(&format!("{key}.worldline"), model.worldline.as_ref());
        let own = [("material".to_owned(), model.material.as_ref())];
        let by_name = model
            .materials
            .iter()
            .map(|(name, m)| (format!("materials.{name}"), Some(m)));
        for (end, material) in own.into_iter().chain(by_name) {
            if let Some(material) = material {
                self.check_name(
                    &format!("{key}.{end}"),
                    "material",
                    material,
                    "material",
                    &[],
                );
            }
        }
        if let Some(scale) = &model.scale {
            self.scale(&format!("{key}.scale"), scale);
        }
        if let Some(array) = &model.array {
            let instances: u128 = array.count.iter().map(|count| u128::from(*count)).product();
            if instances > MAX_INSTANCES {
                let message = format!("an array of {instances} instances");
                let help = format!("an array may have {MAX_INSTANCES} at most");
                self.report(&format!("{key}.array.count"), message, &help);
            }
        }
    }

    fn model_file(&mut self, key: &str, model: &Model) {
        // Blanks at the end of a name get a message of their own, from `check_file`.
        let file = model.file.to_string_lossy();
        let extension = Path::new(file.trim())
            .extension()
            .map(|extension| extension.to_string_lossy().to_lowercase());
        if matches!(extension.as_deref(), Some("obj" | "gltf" | "glb")) {
            self.check_file(key, &model.file);
        } else {
            let file = short(&model.file.display().to_string());
            let message = format!("{file:?} is not a kind of model file that is read");
            self.report(key, message, "models are .obj, .gltf or .glb files");
        }
    }

    fn scale(&mut self, key: &str, scale: &Scale) {
        let zero = |end: &String, is_zero: bool| is_zero.then(|| end.clone());
        let ends: Vec<String> = match scale {
            Scale::Uniform(scale) => scale
                .authored()
                .iter()
                .filter_map(|(end, s)| zero(end, *s == 0.0))
                .collect(),
            Scale::PerAxis(scale) => scale
                .authored()
                .iter()
                .filter_map(|(end, s)| zero(end, s.contains(&0.0)))
                .collect(),
        };
        for end in ends {
            let message = "a scale of 0 leaves nothing of the model".to_owned();
            self.report(
                &format!("{key}{end}"),
                message,
                "leave the model out, or scale by a small number",
            );
        }
    }
}

/// The length of a vector; no square of a component overflows or underflows on the way.
fn length(v: [f64; 3]) -> f64 {
    v[0].hypot(v[1]).hypot(v[2])
}

pub(super) fn is_zero(v: [f64; 3]) -> bool {
    v == [0.0; 3]
}
