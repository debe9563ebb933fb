//! The shot at one frame, evaluated once: every track is a number, every name of a worldline or
//! spectrum is resolved. Files are not yet opened.

use super::at::At;
use super::camera::Camera;
use super::light::{Background, Light};
use super::material::Material;
use super::model::{Model, body_order};
use super::settings::{Sensor, Splice};
use super::worldline::Worldline;
use crate::relativity::{Celerity, CelerityError};
use crate::shot::{Accuracy, Effects, Exposure, Image, Inset, Mistake, Mistakes, Output, Shot};
use indexmap::IndexMap;

/// A shot at one frame.
///
/// ```
/// # use restframe::{frame::Frame, shot};
/// let text = r#"
/// shot.frames = 5
/// worldline.car.velocity = { from = [0, 0, 0], to = [0.8, 0, 0] }
/// model = [{ file = "assets/sphere.obj", worldline = "car" }]
/// camera.position = [0, 0, 4]
/// "#;
/// let shot = shot::parse(text, "pass.toml".as_ref())?;
/// let frame = Frame::new(&shot, 3)?;
/// let car = &frame.worldlines[frame.models[0].worldline];
/// assert_eq!(car.name, "car");
/// assert!((car.motion.celerity.beta().x - 0.4).abs() < 1e-15);
/// assert!(frame.active_effects(&frame.effects).doppler);
/// # Ok::<(), shot::Mistakes>(())
/// ```
#[derive(Debug, Clone)]
pub struct Frame<'a> {
    /// Its number, from 1.
    pub number: u32,
    /// Title of the shot.
    pub title: Option<&'a str>,
    /// Images per second of the shot.
    pub fps: f64,
    /// Lab time of the exposure, s.
    pub time_s: f64,
    /// The same in meters of light travel.
    pub lab_time: f64,
    /// Reference frames; the first is the lab. All names of worldlines are places in this list.
    pub worldlines: Vec<Worldline<'a>>,
    /// The camera.
    pub camera: Camera,
    /// Models, in the order of the shot.
    pub models: Vec<Model<'a>>,
    /// Places of the models in the order of their bodies, which does not depend on the order of the
    /// shot. Where two bodies are met at one place, the first of them is seen.
    pub body_order: Vec<usize>,
    /// Materials that the shot gives, by name.
    pub materials: IndexMap<&'a str, Material<'a>>,
    /// Lamps of the shot.
    pub lights: Vec<Light<'a>>,
    /// What is seen where no surface is.
    pub background: Background<'a>,
    /// Which effects may be simulated.
    pub effects: Effects,
    /// Rows of the image with effects of their own.
    pub splices: Vec<Splice>,
    /// Size and sampling of the whole image.
    pub image: &'a Image,
    /// From spectral radiance to pixel values.
    pub sensor: Sensor,
    /// Exposure, stops; None where it is metered on frame 1.
    pub exposure_stops: Option<f64>,
    /// What is approximated, and how finely.
    pub accuracy: Accuracy,
    /// Files and layers that are written.
    pub output: &'a Output,
    /// Plots of single pixels' curves.
    pub insets: &'a [Inset],
    /// For mistakes that need the files, and for what holds of all frames.
    pub(super) shot: &'a Shot,
    /// What is refused of it.
    pub(super) faults: Faults,
}

/// Values that are refused.
#[derive(Debug, Clone, Default)]
pub(super) struct Faults {
    /// Worldlines that have no velocity, by place, and why.
    no_velocity: Vec<(usize, CelerityError)>,
    /// Places of models that have no size.
    no_size: Vec<usize>,
}

impl<'a> Frame<'a> {
    /// Evaluates frame number `number`, from 1, of a shot.
    ///
    /// # Errors
    /// Tracks whose values between two keys are none: of a velocity, a scale, or a camera that looks
    /// at its own position.
    pub fn new(shot: &'a Shot, number: u32) -> Result<Self, Mistakes> {
        let frame = Self::unchecked(shot, number);
        frame.check()?;
        Ok(frame)
    }

    /// The same, with worldlines at rest that have no velocity.
    pub(super) fn unchecked(shot: &'a Shot, number: u32) -> Self {
        let at = At { shot, number };
        let time_s = at.value(&shot.shot.time);
        let (worldlines, no_velocity) = Worldline::all(at);
        let models: Vec<Model<'a>> = models(at);
        Self {
            number,
            title: shot.shot.title.as_deref(),
            fps: shot.shot.fps,
            time_s,
            lab_time: time_s * shot.shot.light_speed,
            camera: Camera::new(at),
            body_order: body_order(&models, &worldlines),
            faults: Faults {
                no_velocity,
                no_size: no_size(&models),
            },
            models,
            worldlines,
            materials: materials(at),
            lights: lights(at),
            background: Background::new(at),
            effects: shot.effects,
            splices: Splice::all(shot),
            image: &shot.image,
            sensor: Sensor::new(&shot.sensor),
            exposure_stops: exposure_stops(at),
            accuracy: shot.accuracy,
            output: &shot.output,
            insets: &shot.inset,
            shot,
        }
    }

    /// Refuses values that are none.
    fn check(&self) -> Result<(), Mistakes> {
        let itself = self.camera.looks_at_itself();
        if self.faults.no_velocity.is_empty() && self.faults.no_size.is_empty() && !itself {
            return Ok(());
        }
        let number = self.number;
        let velocity = |(place, fault): &(usize, CelerityError)| {
            let name = self.worldlines[*place].name;
            self.mistake(
                &format!("worldline.{name}.velocity"),
                format!("worldline \"{name}\" has no velocity in frame {number}: {fault}"),
                Some("keep direction and speed valid in every frame between the keys"),
            )
        };
        let size = |place: &usize| {
            self.mistake(
                &format!("model[{place}].scale"),
                format!("the model has no size in frame {number}"),
                Some("give each axis a scale that is not zero in any frame"),
            )
        };
        let mut mistakes: Vec<Mistake> = self.faults.no_velocity.iter().map(velocity).collect();
        mistakes.extend(self.faults.no_size.iter().map(size));
        if itself {
            mistakes.push(self.mistake(
                "camera.look_at",
                format!("the camera looks at its own position in frame {number}"),
                Some("move look_at or position apart"),
            ));
        }
        Err(self.mistakes(mistakes))
    }

    /// The shot of this frame alone, from which it is rendered again: every track is a constant.
    pub fn alone(&self) -> Shot {
        self.shot.at(self.number)
    }

    /// A mistake of the shot that shows in this frame, at a key.
    pub fn mistake(&self, key: &str, message: String, help: Option<&str>) -> Mistake {
        let help = help.map(str::to_owned);
        self.shot.places.mistake(key, message, help)
    }

    /// Mistakes of the shot together.
    pub fn mistakes(&self, mistakes: Vec<Mistake>) -> Mistakes {
        Mistakes::new(&self.shot.places, mistakes)
    }

    /// Celerity, in the lab, of the worldline at a place.
    pub(super) fn celerity(&self, worldline: usize) -> Celerity {
        self.worldlines[worldline].motion.celerity
    }
}

fn models(at: At<'_>) -> Vec<Model<'_>> {
    let models = at.shot.model.iter();
    models.map(|model| Model::new(model, at)).collect()
}

fn no_size(models: &[Model<'_>]) -> Vec<usize> {
    let places = 0..models.len();
    places.filter(|&i| !models[i].has_size()).collect()
}

fn materials(at: At<'_>) -> IndexMap<&str, Material<'_>> {
    let materials = at.shot.material.iter();
    let material = |(name, material)| (String::as_str(name), Material::new(material, at));
    materials.map(material).collect()
}

fn lights(at: At<'_>) -> Vec<Light<'_>> {
    let lights = at.shot.light.iter().enumerate();
    lights
        .map(|(place, light)| Light::new(place, light, at))
        .collect()
}

fn exposure_stops(at: At<'_>) -> Option<f64> {
    match &at.shot.sensor.exposure {
        Exposure::Stops(stops) => Some(at.value(stops)),
        Exposure::Auto(_) => None,
    }
}

/// The frames of a shot one after the other: of each, only the sections that move are evaluated
/// again. A microsecond or a few each.
#[derive(Debug, Clone)]
pub struct Frames<'a> {
    frame: Frame<'a>,
    moving: ChangingSections,
}

/// Which sections of a shot are not the same in all frames.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct ChangingSections {
    pub(super) time: bool,
    pub(super) camera: bool,
    pub(super) worldlines: bool,
    pub(super) models: bool,
    pub(super) materials: bool,
    pub(super) lights: bool,
    pub(super) background: bool,
}

impl ChangingSections {
    fn new(shot: &Shot) -> Self {
        let own = shot.moving();
        // Names of spectra are resolved where they are used.
        Self {
            time: own.time,
            camera: own.camera,
            worldlines: own.worldlines,
            models: own.models,
            materials: own.materials || own.spectra,
            lights: own.lights || own.spectra,
            background: own.background || own.spectra,
        }
    }
}

impl<'a> Frames<'a> {
    /// The frames of a shot.
    pub fn new(shot: &'a Shot) -> Self {
        Self {
            frame: Frame::unchecked(shot, 1),
            moving: ChangingSections::new(shot),
        }
    }

    /// Frame number `number`, from 1.
    ///
    /// # Errors
    /// As [`Frame::new`].
    pub fn at(&mut self, number: u32) -> Result<&Frame<'a>, Mistakes> {
        self.move_to(number);
        self.frame.check()?;
        Ok(&self.frame)
    }

    /// The same, with worldlines at rest that have no velocity.
    pub(super) fn unchecked(&mut self, number: u32) -> &Frame<'a> {
        self.move_to(number);
        &self.frame
    }

    /// Which sections may be others in each frame.
    pub(super) fn moving(&self) -> ChangingSections {
        self.moving
    }

    /// By all fields of a frame: one that is new does not compile until it is said whether it moves.
    fn move_to(&mut self, to: u32) {
        let moving = self.moving;
        let Frame {
            number,
            title: _,
            fps: _,
            time_s,
            lab_time,
            worldlines,
            camera,
            models,
            body_order,
            materials,
            lights,
            background,
            effects: _,
            splices: _,
            image: _,
            sensor: _,
            exposure_stops,
            accuracy: _,
            output: _,
            insets: _,
            shot,
            faults,
        } = &mut self.frame;
        let at = At { shot, number: to };
        *number = to;
        *exposure_stops = self::exposure_stops(at);
        if moving.time {
            *time_s = at.value(&shot.shot.time);
            *lab_time = *time_s * shot.shot.light_speed;
        }
        if moving.camera {
            *camera = Camera::new(at);
        }
        if moving.worldlines {
            (*worldlines, faults.no_velocity) = Worldline::all(at);
        }
        if moving.models {
            *models = self::models(at);
            faults.no_size = no_size(models);
            *body_order = self::body_order(models, worldlines);
        }
        if moving.materials {
            *materials = self::materials(at);
        }
        if moving.lights {
            *lights = self::lights(at);
        }
        if moving.background {
            *background = Background::new(at);
        }
    }
}
