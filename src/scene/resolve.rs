//! A shot and its files to the scene of one image.

use super::body::{Arrangement, Geometry, placings};
use super::camera::Camera;
use super::library::Library;
use super::light::Light;
use super::material::Material;
use super::model::ModelMaterial;
use super::sky::Background;
use super::spectra::Spectra;
use crate::frame;
use crate::relativity::Worldline;
use crate::shot::{Mistake, Mistakes, Shot};
use glam::DMat3;
use indexmap::IndexSet;
use std::collections::HashMap;
use std::sync::Arc;

/// Most lamps a scene may have, those of arrayed model files counted one by one.
const MOST_LIGHTS: usize = 10_000;

/// Everything that one image shows.
#[derive(Debug, Clone)]
pub struct Scene {
    /// Worldlines; the first is the lab.
    pub worldlines: Vec<Worldline>,
    /// Their names.
    pub worldline_names: Vec<String>,
    /// Names of the models.
    pub model_names: Vec<String>,
    /// Lab time of the exposure, in metres of light travel.
    pub lab_time: f64,
    /// The camera.
    pub camera: Camera,
    /// Bodies; the same allocation as the previous image's where nothing moved in its rest frame.
    pub geometry: Arc<Geometry>,
    /// Materials.
    pub materials: Vec<Material>,
    /// Lamps.
    pub lights: Vec<Light>,
    /// What is seen where no surface is.
    pub background: Background,
}

impl Scene {
    /// Resolves frame number `frame` of a shot, taking bodies over from `earlier` where they
    /// stand as they stood.
    ///
    /// # Errors
    /// What only shows when the shot's files are known, or between the keys of a ramp.
    pub fn resolve(
        shot: &Shot,
        library: &Library,
        frame: u32,
        earlier: Option<&Scene>,
    ) -> Result<Self, Mistakes> {
        Resolver::new(shot, library, frame).run(|arrangement| match earlier {
            Some(earlier) if earlier.geometry.arrangement == arrangement => {
                Arc::clone(&earlier.geometry)
            }
            _ => Arc::new(Geometry::new(library, arrangement)),
        })
    }

    /// Whether a frame can be resolved; places no body.
    ///
    /// # Errors
    /// As [`Scene::resolve`].
    pub fn check(shot: &Shot, library: &Library, frame: u32) -> Result<(), Mistakes> {
        Resolver::new(shot, library, frame)
            .run(|_| Arc::default())
            .map(|_| ())
    }
}

pub(super) struct Resolver<'a> {
    pub(super) shot: &'a Shot,
    pub(super) library: &'a Library,
    pub(super) frame: u32,
    mistakes: Vec<Mistake>,
    /// Numbers of the materials made so far, by the file's own material, if there is one, and
    /// name.
    pub(super) numbers: HashMap<(Option<*const ModelMaterial>, String), u32>,
}

impl<'a> Resolver<'a> {
    fn new(shot: &'a Shot, library: &'a Library, frame: u32) -> Self {
        Self {
            shot,
            library,
            frame,
            mistakes: Vec::new(),
            numbers: HashMap::new(),
        }
    }
}

impl Resolver<'_> {
    fn run(mut self, bodies: impl FnOnce(Arrangement) -> Arc<Geometry>) -> Result<Scene, Mistakes> {
        let shot = self.shot;
        let names = worldline_names(shot);
        let index =
            |name: Option<&str>, default: &str| worldline_index(shot, &names, name, default);
        let worldlines = self.worldlines(&names);
        let lab_time = shot.shot.time.at(self.frame, shot.shot.frames) * shot.shot.light_speed;
        let camera = self.camera(
            &worldlines,
            index(shot.camera.worldline.as_deref(), "lab"),
            lab_time,
        );
        let of_models: Vec<u32> = shot
            .model
            .iter()
            .map(|m| index(m.worldline.as_deref(), "lab") as u32)
            .collect();
        let (materials, own_materials) = self.materials();
        let placing = placings(shot, self.frame);
        for (i, place) in placing.iter().enumerate() {
            self.check_placing(i, place.rest_from_model);
        }
        let arrangement = Arrangement {
            placing,
            order: model_order(&shot.at(self.frame), &of_models, &names),
            worldlines: of_models,
            materials: own_materials,
            glass: materials.iter().map(|m| m.refraction.is_some()).collect(),
        };
        let lights = self.lights(&arrangement, &names);
        let background = self.background(index(shot.background.worldline.as_deref(), "camera"));
        let (Some(camera), true) = (camera, self.mistakes.is_empty()) else {
            return Err(Mistakes::new(&shot.places, self.mistakes));
        };
        let geometry = bodies(arrangement);
        Ok(Scene {
            worldlines,
            worldline_names: names.into_iter().collect(),
            model_names: shot.model.iter().map(model_name).collect(),
            lab_time,
            camera,
            geometry,
            materials,
            lights,
            background,
        })
    }

    fn worldlines(&mut self, names: &IndexSet<String>) -> Vec<Worldline> {
        let mut lines = Vec::new();
        for name in names {
            match frame::worldline(self.shot, name, self.frame) {
                Ok(line) => lines.push(line),
                Err(error) => {
                    let key = format!("worldline.{name}.velocity");
                    let help = "keep direction and speed valid in every frame between the keys";
                    self.mistake(&key, error.to_string(), Some(help));
                    lines.push(Worldline::LAB);
                }
            }
        }
        lines
    }

    fn camera(&mut self, worldlines: &[Worldline], index: usize, lab_time: f64) -> Option<Camera> {
        let camera = Camera::new(self.shot, self.frame, (index, &worldlines[index]), lab_time);
        if camera.is_none() {
            let message = format!(
                "the camera looks at its own position in frame {}",
                self.frame
            );
            self.mistake(
                "camera.look_at",
                message,
                Some("move look_at or position apart"),
            );
        }
        camera
    }

    fn check_placing(&mut self, index: usize, rest_from_model: glam::DAffine3) {
        let determinant = rest_from_model.matrix3.determinant();
        if !(determinant.is_normal() && rest_from_model.is_finite()) {
            let message = format!("the model has no size in frame {}", self.frame);
            let help = "give each axis a scale that is not zero in any frame";
            self.mistake(&format!("model[{index}].scale"), message, Some(help));
        }
    }

    fn lights(&mut self, arrangement: &Arrangement, names: &IndexSet<String>) -> Vec<Light> {
        let spectra = Spectra {
            shot: self.shot,
            library: self.library,
            frame: self.frame,
        };
        let mut lights = Vec::new();
        for (i, light) in self.shot.light.iter().enumerate() {
            let worldline = worldline_index(self.shot, names, light.worldline.as_deref(), "lab");
            match Light::authored(light, i, worldline, &spectra) {
                Ok(light) => lights.push(light),
                Err(error) => {
                    self.mistake(&format!("light[{i}].spectrum"), error.to_string(), None)
                }
            }
        }
        for &i in &arrangement.order {
            let (place, worldline) = (&arrangement.placing[i], arrangement.worldlines[i]);
            let units = self.shot.model[i].light_units.unwrap_or_default();
            let mut lamps = Vec::new();
            for lamp in &self.library.model(i).file.lamps {
                match Light::imported(lamp, units, worldline as usize, &place.rest_from_model) {
                    Ok(light) => lamps.push(light),
                    Err(error) => {
                        let message = format!("lamp \"{}\": {error}", lamp.name);
                        self.mistake(&format!("model[{i}].file"), message, None);
                    }
                }
            }
            for copy in place
                .copies()
                .take(if lamps.is_empty() { 0 } else { MOST_LIGHTS + 1 })
            {
                lights.extend(lamps.iter().map(|lamp| lamp.displaced(copy)));
                if lights.len() > MOST_LIGHTS {
                    let message = format!("more than {MOST_LIGHTS} lamps");
                    let help = "leave the lamps out of a file that is arrayed";
                    self.mistake(&format!("model[{i}].array"), message, Some(help));
                    return lights;
                }
            }
        }
        lights.retain(|light| light.scale > 0.0);
        lights
    }

    fn background(&mut self, worldline: usize) -> Background {
        let spectra = Spectra {
            shot: self.shot,
            library: self.library,
            frame: self.frame,
        };
        let sky = &self.shot.background;
        let spectrum = match sky.spectrum.as_ref().map(|v| spectra.curve(v)) {
            None => None,
            Some(Ok(curve)) => Some(curve).filter(|c| c.peak() > 0.0),
            Some(Err(error)) => {
                self.mistake("background.spectrum", error.to_string(), None);
                None
            }
        };
        Background {
            worldline,
            axes: DMat3::IDENTITY,
            scale: sky.scale.as_ref().map_or(1.0, |scale| spectra.at(scale)),
            spectrum,
            image: self.library.sky(),
            stars: self.library.stars(),
        }
    }

    pub(super) fn mistake(&mut self, key: &str, message: String, help: Option<&str>) {
        let mistake = self
            .shot
            .places
            .mistake(key, message, help.map(str::to_owned));
        if !self.mistakes.contains(&mistake) {
            self.mistakes.push(mistake);
        }
    }
}

/// The lab first, then the shot's own; "camera" is another name for one of them.
fn worldline_names(shot: &Shot) -> IndexSet<String> {
    std::iter::once("lab".to_owned())
        .chain(shot.worldline.keys().cloned())
        .collect()
}

fn worldline_index(
    shot: &Shot,
    names: &IndexSet<String>,
    name: Option<&str>,
    default: &str,
) -> usize {
    let name = match name.unwrap_or(default) {
        "camera" => shot.camera.worldline.as_deref().unwrap_or("lab"),
        name => name,
    };
    names.get_index_of(name).unwrap_or(0)
}

/// The models in an order that does not depend on that of the shot, of one frame: by their
/// worldlines' names, their own, and, where two share the name of one file, by all else that is said
/// of them.
fn model_order(shot: &Shot, worldlines: &[u32], names: &IndexSet<String>) -> Vec<usize> {
    let mut order: Vec<usize> = (0..shot.model.len()).collect();
    order.sort_by_cached_key(|&i| {
        let model = &shot.model[i];
        let worldline = &names[worldlines[i] as usize];
        (worldline, model_name(model), format!("{model:?}"))
    });
    order
}

/// The model's name, or its file's stem.
pub(super) fn model_name(model: &crate::shot::Model) -> String {
    model.name.clone().unwrap_or_else(|| {
        model
            .file
            .file_stem()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned()
    })
}
