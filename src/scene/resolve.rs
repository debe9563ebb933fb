//! A frame and its shot's files to the scene of one image.

use super::body::{Arrangement, Geometry, Placing};
use super::camera::Camera;
use super::library::Library;
use super::light::Light;
use super::material::Material;
use super::sky::Background;
use super::spectra::Spectra;
use crate::frame::Frame;
use crate::model::ModelMaterial;
use crate::relativity::Worldline;
use crate::shot::{Mistake, Mistakes};
use glam::DMat3;
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
    /// Resolves a frame. Bodies are taken over from `earlier` if they have not moved in their rest
    /// frames.
    ///
    /// # Errors
    /// Mistakes that are known only with the shot's files.
    ///
    /// # Example
    /// ```
    /// use restframe::{frame::Frame, scene::{Library, Scene}, shot};
    /// use std::path::Path;
    ///
    /// let shot = shot::load(Path::new("shots/plate-08.toml"))?;
    /// let library = Library::load(&shot)?;
    /// let scene = Scene::resolve(&Frame::new(&shot, 1)?, &library, None)?;
    /// let fastest = scene.worldlines.iter().map(|w| w.celerity.beta().length());
    /// assert!((fastest.fold(0.0, f64::max) - 0.5).abs() < 1e-15);
    /// # Ok::<(), shot::Mistakes>(())
    /// ```
    pub fn resolve(
        frame: &Frame<'_>,
        library: &Library,
        earlier: Option<&Scene>,
    ) -> Result<Self, Mistakes> {
        Resolver::new(frame, library).run(|arrangement| match earlier {
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
    pub fn check(frame: &Frame<'_>, library: &Library) -> Result<(), Mistakes> {
        Resolver::new(frame, library)
            .run(|_| Arc::default())
            .map(|_| ())
    }
}

pub(super) struct Resolver<'a> {
    pub(super) frame: &'a Frame<'a>,
    pub(super) library: &'a Library,
    mistakes: Vec<Mistake>,
    /// Numbers of the materials made so far, by the file's own material, if there is one, and
    /// name.
    pub(super) numbers: HashMap<(Option<*const ModelMaterial>, String), u32>,
}

impl<'a> Resolver<'a> {
    fn new(frame: &'a Frame<'a>, library: &'a Library) -> Self {
        Self {
            frame,
            library,
            mistakes: Vec::new(),
            numbers: HashMap::new(),
        }
    }
}

impl Resolver<'_> {
    fn run(mut self, bodies: impl FnOnce(Arrangement) -> Arc<Geometry>) -> Result<Scene, Mistakes> {
        let frame = self.frame;
        let (materials, own_materials) = self.materials();
        let arrangement = Arrangement {
            placing: frame.models.iter().map(Placing::new).collect(),
            order: frame.body_order.clone(),
            worldlines: frame.models.iter().map(|m| m.worldline as u32).collect(),
            materials: own_materials,
            glass: materials
                .iter()
                .map(|m| m.bsdf.refraction().is_some())
                .collect(),
        };
        let lights = self.lights(&arrangement);
        let background = self.background();
        if !self.mistakes.is_empty() {
            return Err(frame.mistakes(self.mistakes));
        }
        Ok(Scene {
            worldlines: frame.worldlines.iter().map(|line| line.motion).collect(),
            worldline_names: frame.worldlines.iter().map(|l| l.name.to_owned()).collect(),
            model_names: frame.models.iter().map(|m| m.name.to_string()).collect(),
            lab_time: frame.lab_time,
            camera: Camera::new(frame),
            geometry: bodies(arrangement),
            materials,
            lights,
            background,
        })
    }

    fn lights(&mut self, arrangement: &Arrangement) -> Vec<Light> {
        let spectra = Spectra {
            library: self.library,
        };
        let mut lights = Vec::new();
        for (i, light) in self.frame.lights.iter().enumerate() {
            match Light::authored(light, &spectra) {
                Ok(light) => lights.push(light),
                Err(error) => {
                    self.mistake(&format!("light[{i}].spectrum"), error.to_string(), None)
                }
            }
        }
        for &i in &arrangement.order {
            let (place, worldline) = (&arrangement.placing[i], arrangement.worldlines[i]);
            let units = self.frame.models[i].light_units;
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

    fn background(&mut self) -> Background {
        let spectra = Spectra {
            library: self.library,
        };
        let sky = self.frame.background;
        let spectrum = match sky.spectrum.map(|spectrum| spectra.curve(spectrum)) {
            None => None,
            Some(Ok(curve)) => Some(curve).filter(|c| c.peak() > 0.0),
            Some(Err(error)) => {
                self.mistake("background.spectrum", error.to_string(), None);
                None
            }
        };
        Background {
            worldline: sky.worldline,
            axes: DMat3::IDENTITY,
            scale: sky.scale,
            spectrum,
            image: self.library.sky(),
            stars: self.library.stars(),
        }
    }

    pub(super) fn mistake(&mut self, key: &str, message: String, help: Option<&str>) {
        let mistake = self.frame.mistake(key, message, help);
        if !self.mistakes.contains(&mistake) {
            self.mistakes.push(mistake);
        }
    }
}
