//! A shot at one frame: what moves stands at its value there. And such a shot as TOML, from which
//! the frame can be rendered again.

use super::{
    Accuracy, Array, AutoExposure, Background, Beyond, Camera, Clock, Diffuse, Effects, Emission,
    Exposure, Filter, GammaVelocity, Gamut, Gaussian, Highlight, Image, Inset, Light, LightKind,
    LightUnits, Material, Mirror, Model, Output, Places, Projection, RapidityVelocity, Refraction,
    Scale, Sensor, SensorColor, Sequence, Shot, SpectrumTable, SpectrumValue, Splice, Stars,
    Thermal, ThermalCurve, Tone, Track, Velocity, Worldline, track::Blend,
};
use indexmap::IndexMap;
use serde_json::{Map, Value};
use std::path::PathBuf;

impl Shot {
    /// The shot of one frame that is `frame` of this one, counted from 1: every track is a constant.
    #[must_use]
    pub fn at(&self, frame: u32) -> Self {
        let when = When {
            frame,
            frames: self.shot.frames,
        };
        let mut still = self.at_frame(when);
        still.shot.frames = 1;
        still
    }

    /// Which of its sections move.
    pub fn moving(&self) -> Moving {
        Moving {
            time: self.shot.time.moves(),
            camera: self.camera.moves(),
            worldlines: self.worldline.moves(),
            models: self.model.moves(),
            materials: self.material.moves(),
            spectra: self.spectrum.moves(),
            lights: self.light.moves(),
            background: self.background.moves(),
        }
    }

    /// The shot as its author might write it: TOML without what is at its default, which reads as
    /// an equal shot.
    pub fn to_toml(&self) -> String {
        let mut value = self.to_json();
        leave_out_defaults(&mut value);
        toml::to_string(&value).expect("tables, lists, words and finite numbers are TOML")
    }

    /// The shot's keys and values, defaults included; what has none is left out.
    pub fn to_json(&self) -> Value {
        let mut value = serde_json::to_value(self).expect("all keys of a shot are text");
        leave_out_null(&mut value);
        value
    }
}

/// Which sections of a shot have a value that is not the same in all frames.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Moving {
    /// `shot.time`
    pub time: bool,
    /// `[camera]`
    pub camera: bool,
    /// `[worldline]`
    pub worldlines: bool,
    /// `[[model]]`
    pub models: bool,
    /// `[material]`
    pub materials: bool,
    /// `[spectrum]`
    pub spectra: bool,
    /// `[[light]]`
    pub lights: bool,
    /// `[background]`
    pub background: bool,
}

fn leave_out_null(value: &mut Value) {
    match value {
        Value::Object(object) => {
            object.retain(|_, value| !value.is_null());
            object.values_mut().for_each(leave_out_null);
        }
        Value::Array(items) => items.iter_mut().for_each(leave_out_null),
        _ => {}
    }
}

/// Takes the defaults out of the sections that have some, and sections that are left empty.
fn leave_out_defaults(shot: &mut Value) {
    fn default<T: Default + serde::Serialize>() -> Value {
        serde_json::to_value(T::default()).unwrap_or_default()
    }
    let defaults = [
        ("shot", default::<Clock>()),
        ("image", default::<Image>()),
        ("background", default::<Background>()),
        ("effects", default::<Effects>()),
        ("sensor", default::<Sensor>()),
        ("accuracy", default::<Accuracy>()),
        ("output", default::<Output>()),
        ("sequence", default::<Sequence>()),
    ];
    let Value::Object(shot) = shot else { return };
    for (name, default) in defaults {
        if let Some(section) = shot.get_mut(name).and_then(Value::as_object_mut) {
            section.retain(|key, value| default.get(key) != Some(value));
        }
        if shot
            .get(name)
            .and_then(Value::as_object)
            .is_some_and(Map::is_empty)
        {
            shot.shift_remove(name);
        }
    }
}

/// A frame of a shot of so many.
#[derive(Clone, Copy)]
struct When {
    frame: u32,
    frames: u32,
}

/// What has a value in each frame.
trait AtFrame {
    /// The same with every track constant.
    #[must_use]
    fn at_frame(&self, when: When) -> Self;

    /// Whether that is not the same in all frames.
    fn moves(&self) -> bool;
}

impl<T: Blend> AtFrame for Track<T> {
    fn at_frame(&self, When { frame, frames }: When) -> Self {
        Self::Constant(self.at(frame, frames))
    }

    fn moves(&self) -> bool {
        !self.is_constant()
    }
}

impl<T: AtFrame> AtFrame for Option<T> {
    fn at_frame(&self, when: When) -> Self {
        self.as_ref().map(|value| value.at_frame(when))
    }

    fn moves(&self) -> bool {
        self.as_ref().is_some_and(AtFrame::moves)
    }
}

impl<T: AtFrame> AtFrame for Box<T> {
    fn at_frame(&self, when: When) -> Self {
        Self::new(self.as_ref().at_frame(when))
    }

    fn moves(&self) -> bool {
        self.as_ref().moves()
    }
}

impl<T: AtFrame> AtFrame for Vec<T> {
    fn at_frame(&self, when: When) -> Self {
        self.iter().map(|value| value.at_frame(when)).collect()
    }

    fn moves(&self) -> bool {
        self.iter().any(AtFrame::moves)
    }
}

impl<T: AtFrame> AtFrame for IndexMap<String, T> {
    fn at_frame(&self, when: When) -> Self {
        let entry = |(name, value): (&String, &T)| (name.clone(), value.at_frame(when));
        self.iter().map(entry).collect()
    }

    fn moves(&self) -> bool {
        self.values().any(AtFrame::moves)
    }
}

impl<T: Copy, const N: usize> AtFrame for [T; N] {
    fn at_frame(&self, _: When) -> Self {
        *self
    }

    fn moves(&self) -> bool {
        false
    }
}

/// What does not move.
macro_rules! fixed {
    ($($type:ty),* $(,)?) => {$(
        impl AtFrame for $type {
            fn at_frame(&self, _: When) -> Self {
                self.clone()
            }

            fn moves(&self) -> bool {
                false
            }
        }
    )*};
}

/// Tables, by all their keys: one that is forgotten does not compile.
macro_rules! tables {
    ($($type:ident { $($key:ident),* $(,)? })*) => {$(
        impl AtFrame for $type {
            fn at_frame(&self, when: When) -> Self {
                Self { $($key: self.$key.at_frame(when)),* }
            }

            fn moves(&self) -> bool {
                false $(|| self.$key.moves())*
            }
        }
    )*};
}

/// Values of several forms.
macro_rules! forms {
    ($($type:ident { $($form:ident),* $(,)? })*) => {$(
        impl AtFrame for $type {
            fn at_frame(&self, when: When) -> Self {
                match self {
                    $(Self::$form(value) => Self::$form(value.at_frame(when)),)*
                }
            }

            fn moves(&self) -> bool {
                match self {
                    $(Self::$form(value) => value.moves(),)*
                }
            }
        }
    )*};
}

fixed! {
    f64, u32, bool, String, PathBuf, Places, Accuracy, AutoExposure, Beyond, Effects, Filter, Inset,
    LightKind, LightUnits, Output, Projection, SensorColor, Sequence, Splice, Stars, ThermalCurve,
    Tone, Gamut,
}

tables! {
    Shot {
        shot, image, worldline, model, material, spectrum, light, background, camera, effects,
        splice, sensor, accuracy, output, inset, sequence, path, places,
    }
    Clock { title, frames, fps, time, light_speed }
    Image { size, samples, filter }
    Worldline { velocity, passes, at }
    GammaVelocity { gamma, direction }
    RapidityVelocity { rapidity, direction }
    Model {
        name, file, worldline, translate, rotate, scale, array, material, materials, light_units,
    }
    Array { count, step, centered }
    Material { diffuse, highlight, mirror, refraction, emission, thermal }
    Diffuse { weight, spectrum }
    Highlight { weight, spectrum, exponent }
    Mirror { weight, spectrum }
    Refraction { weight, spectrum, ior }
    Emission { scale, spectrum }
    Thermal { temperature, emissivity, curve, strength }
    SpectrumTable {
        points, tension, constant, blackbody, unit_at, illuminant, rgb, gaussian, file, beyond,
    }
    Gaussian { center, width }
    Light {
        kind, name, worldline, position, direction, inner, outer, intensity, scale, spectrum,
    }
    Background { worldline, spectrum, image, scale, stars }
    Camera {
        worldline, position, look_at, yaw, pitch, roll, pan, tilt, hfov, vfov, projection,
    }
    Sensor { window, color, exposure, tone, gamut }
}

forms! {
    Velocity { Gamma, Rapidity, Beta }
    Scale { Uniform, PerAxis }
    SpectrumValue { Number, Name, Table }
    Exposure { Stops, Auto }
}
