//! What of a frame its shade trees follow from, without what shading alone reads: frames in which
//! it is equal share one trace.
//!
//! Temperatures, emission, colors, exposure and the switches of what light does on its way are
//! shading's. Of a term of a material only counts that it is there, of a lamp that it shines, of the
//! sky that it is not black. Mirrors and glass count in full: their reflectances decide which
//! branches are worth following. Where it cannot be told without a spectrum's numbers whether
//! something is there, these count as well: frames may then be traced apart that need not be, never
//! the other way round.

use super::files::Digests;
use super::key::Picture;
use super::parts::aspect;
use crate::shot::{
    Accuracy, Background, Clock, Effects, Format, Light, Material, Model, Moving, Refraction, Shot,
    SpectrumTable, SpectrumValue, Splice, SpliceEffects, Track,
};
use serde_json::{Value, json};
use std::borrow::Cow;
use std::collections::BTreeMap;

/// Lamps of fewer candela or lux may be lost in rounding.
const FAINTEST: f64 = 1e-6;

/// Spectra beyond this may make a lamp's sum overflow.
const LARGEST: f64 = 1e200;

/// Below this a black body's curve, 1 at some wavelength, is beyond all numbers at others, K.
const COLDEST: f64 = 100.0;

/// A part of what shade trees follow from, by where it stands in the shot.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Section {
    Picture,
    Film,
    Clock,
    Camera,
    Worldlines,
    Models,
    Materials,
    Lamps,
    Sky,
    Effects,
    Splices,
    Accuracy,
}

impl Section {
    /// All of them, in the order in which they are hashed.
    pub(super) const ALL: [Self; 12] = [
        Self::Picture,
        Self::Film,
        Self::Clock,
        Self::Camera,
        Self::Worldlines,
        Self::Models,
        Self::Materials,
        Self::Lamps,
        Self::Sky,
        Self::Effects,
        Self::Splices,
        Self::Accuracy,
    ];

    /// Whether it may be another in each frame of a shot that moves so.
    pub(super) fn moves(self, moving: Moving) -> bool {
        match self {
            Self::Clock => moving.time,
            Self::Camera => moving.camera,
            Self::Worldlines => moving.worldlines,
            // "camera" as a worldline is a name, which does not move.
            Self::Models => moving.models,
            Self::Materials => moving.materials || moving.spectra,
            Self::Lamps => moving.lights || moving.spectra,
            Self::Sky => moving.background || moving.spectra,
            Self::Picture | Self::Film | Self::Effects | Self::Splices | Self::Accuracy => false,
        }
    }
}

/// A value as JSON.
fn text(value: &impl serde::Serialize) -> String {
    serde_json::to_string(value).expect("all keys of a shot are text")
}

fn splice(splice: &Splice) -> Value {
    let Splice { rows, effects } = splice;
    let SpliceEffects {
        geometry,
        doppler: _,
        beaming: _,
        thermal: _,
        shadows,
        bounces,
    } = effects;
    json!([rows, geometry, shadows, bounces])
}

/// The one value of a track of a shot of one frame.
fn now(track: &Track<f64>) -> f64 {
    track.at(1, 1)
}

/// What the shade trees of a shot of one frame follow from.
pub(super) struct Traced<'a> {
    pub(super) still: &'a Shot,
    pub(super) digests: &'a Digests,
    pub(super) picture: Picture,
}

impl Traced<'_> {
    /// One section of it, as JSON.
    pub(super) fn text(&self, section: Section) -> String {
        let (still, picture) = (self.still, self.picture);
        // By all their keys: one that is new does not compile until it is placed.
        let Effects {
            geometry,
            doppler: _,
            beaming: _,
            thermal: _,
            shadows,
            bounces,
        } = still.effects;
        let Accuracy {
            spectra: _,
            wavelengths: _,
            line_spacing: _,
            cutoff,
        } = still.accuracy;
        let Clock {
            title: _,
            frames: _,
            fps: _,
            time,
            light_speed,
        } = &still.shot;
        let list = match section {
            Section::Picture => {
                json!([picture.size, [picture.samples], aspect(still.image.size)])
            }
            Section::Film => {
                let exr = still.output.formats.contains(&Format::Exr);
                json!([still.image.filter, exr.then_some(&still.output.layers)])
            }
            Section::Clock => json!([time, light_speed]),
            Section::Camera => return text(&still.camera),
            Section::Worldlines => return text(&still.worldline.iter().collect::<Vec<_>>()),
            Section::Models => still.model.iter().map(|m| self.model(m)).collect(),
            Section::Materials => {
                let materials = still.material.iter();
                let materials = materials.map(|(name, material)| (name, self.material(material)));
                json!(materials.collect::<BTreeMap<&String, Value>>())
            }
            Section::Lamps => still.light.iter().filter_map(|l| self.lamp(l)).collect(),
            Section::Sky => self.sky(&still.background),
            Section::Effects => json!([geometry, shadows, bounces]),
            Section::Splices => still.splice.iter().map(splice).collect(),
            Section::Accuracy => json!([cutoff]),
        };
        list.to_string()
    }

    fn model(&self, model: &Model) -> Value {
        let Model {
            name: _,
            file,
            worldline: _,
            translate,
            rotate,
            scale,
            array,
            material,
            materials,
            light_units: _,
        } = model;
        let models = &self.still.model;
        // Materials of one file are the same ones, of two files with one content they are not.
        let first = models.iter().position(|other| other.file == *file);
        let own = self.called(model);
        // Where two have one name, bodies are ordered by all that is said of them.
        let namesakes = models.iter().filter(|other| self.called(other) == own);
        let tie = (namesakes.count() > 1).then(|| format!("{model:?}"));
        json!([
            own,
            first,
            self.digests.of(file),
            tie,
            translate,
            rotate,
            scale,
            array,
            material,
            materials,
        ])
    }

    /// A model's worldline and name, by which bodies are ordered.
    fn called<'a>(&'a self, model: &'a Model) -> (&'a str, Cow<'a, str>) {
        let stem = || model.file.file_stem().unwrap_or_default().to_string_lossy();
        let name = model.name.as_deref().map_or_else(stem, Cow::Borrowed);
        (self.worldline(&model.worldline, "lab"), name)
    }

    fn material(&self, material: &Material) -> Value {
        let Material {
            diffuse,
            highlight,
            mirror,
            refraction,
            emission: _,
            thermal: _,
        } = material;
        let diffuse = diffuse.as_ref().map(|d| self.term(&d.weight, &d.spectrum));
        let highlight = highlight.as_ref().map(|h| {
            let term = self.term(&h.weight, &h.spectrum);
            (term != Term::Gone).then(|| (json!(term as u8), &h.exponent))
        });
        let mirror = mirror
            .as_ref()
            .filter(|m| self.term(&m.weight, &m.spectrum) != Term::Gone)
            .map(|m| json!([m.weight, self.content(&m.spectrum)]));
        let glass =
            |r: &&Refraction| mirror.is_some() || self.term(&r.weight, &r.spectrum) != Term::Gone;
        let refraction = refraction
            .as_ref()
            .filter(glass)
            .map(|r| json!([r.weight, self.content(&r.spectrum), r.ior]));
        json!([
            diffuse.map(|term| term as u8),
            highlight,
            mirror,
            refraction
        ])
    }

    /// Whether a term that its author names is left after pruning.
    fn term(&self, weight: &Option<Track<f64>>, spectrum: &Option<SpectrumValue>) -> Term {
        let zero = |value| matches!(self.curve(value), Curve::Number(v) if v == 0.0);
        match (weight, spectrum) {
            (Some(weight), _) if now(weight) <= 0.0 => Term::Gone,
            (_, Some(spectrum)) if zero(spectrum) => Term::Gone,
            (_, Some(_)) => Term::There,
            (_, None) => Term::AsInTheFile,
        }
    }

    /// The worldline that stands behind a name; "camera" is another for one of them.
    fn worldline<'a>(&'a self, name: &'a Option<String>, default: &'a str) -> &'a str {
        match name.as_deref().unwrap_or(default) {
            "camera" => self.still.camera.worldline.as_deref().unwrap_or("lab"),
            name => name,
        }
    }

    /// A lamp, if it shines.
    fn lamp(&self, light: &Light) -> Option<Value> {
        let Light {
            kind,
            name: _,
            worldline,
            position,
            direction,
            inner,
            outer,
            intensity,
            scale,
            spectrum,
        } = light;
        let amount = scale.as_ref().or(intensity.as_ref()).map_or(0.0, now);
        if amount <= 0.0 {
            return None;
        }
        let surely = scale.is_some()
            || amount >= FAINTEST && spectrum.as_ref().is_none_or(|s| self.is_tame(s));
        let perhaps = (!surely).then(|| json!([amount, self.content(spectrum)]));
        Some(json!([
            kind,
            self.worldline(worldline, "lab"),
            position,
            direction,
            inner,
            outer,
            perhaps,
        ]))
    }

    /// The sky: None where it is black.
    fn sky(&self, sky: &Background) -> Value {
        let Background {
            worldline,
            spectrum,
            image,
            scale,
            stars,
        } = sky;
        let scaled = scale.as_ref().is_none_or(|scale| now(scale) > 0.0);
        let lit = match spectrum {
            _ if stars.is_some() => json!(true),
            _ if !scaled => json!(false),
            _ if image.is_some() => json!(true),
            None => json!(false),
            Some(value) => match self.curve(value) {
                Curve::Number(v) => json!(v > 0.0),
                Curve::Table(table) if !surely_lit(table) => self.content(spectrum),
                Curve::Table(_) | Curve::Illuminant(_) => json!(true),
            },
        };
        if lit == false {
            Value::Null
        } else {
            json!([self.worldline(worldline, "camera"), lit])
        }
    }

    /// What stands behind a spectrum's name.
    fn curve<'a>(&'a self, value: &'a SpectrumValue) -> Curve<'a> {
        let of_table = |table: &'a SpectrumTable| match &table.constant {
            Some(value) if table.points.is_none() => Curve::Number(now(value)),
            _ => Curve::Table(table),
        };
        match value {
            SpectrumValue::Number(value) => Curve::Number(now(value)),
            SpectrumValue::Table(table) => of_table(table),
            SpectrumValue::Name(name) => match self.still.spectrum.get(name) {
                Some(table) => of_table(table),
                None => Curve::Illuminant(name),
            },
        }
    }

    /// A spectrum without its name and that of its file.
    fn content(&self, value: &Option<SpectrumValue>) -> Value {
        match value.as_ref().map(|value| self.curve(value)) {
            None => Value::Null,
            Some(Curve::Number(value)) => json!(value),
            Some(Curve::Illuminant(name)) => json!(name),
            Some(Curve::Table(table)) => {
                let file = table.file.as_ref().map(|file| self.digests.of(file));
                let nameless = SpectrumTable {
                    file: None,
                    ..table.clone()
                };
                json!([nameless, file])
            }
        }
    }

    /// Whether a lamp of this spectrum and an ordinary amount surely shines.
    fn is_tame(&self, value: &SpectrumValue) -> bool {
        match self.curve(value) {
            Curve::Number(value) => value < LARGEST,
            Curve::Illuminant(_) => true,
            Curve::Table(table) => {
                let tame = |points: &Vec<[f64; 2]>| points.iter().all(|p| p[1] < LARGEST);
                let hot = |kelvin: &Track<f64>| now(kelvin) >= COLDEST;
                table.file.is_none()
                    && table.unit_at.is_none()
                    && table.points.as_ref().is_none_or(tame)
                    && table.blackbody.as_ref().is_none_or(hot)
            }
        }
    }
}

/// A term of a material.
#[derive(Clone, Copy, PartialEq)]
enum Term {
    Gone,
    There,
    /// There, if the model file has a spectrum for it.
    AsInTheFile,
}

/// A spectrum, its name looked up.
enum Curve<'a> {
    Number(f64),
    Table(&'a SpectrumTable),
    Illuminant(&'a str),
}

/// Whether a spectrum surely is not black.
fn surely_lit(table: &SpectrumTable) -> bool {
    let points = table.points.iter().flatten();
    let mut values = points.map(|point| point[1]);
    let hot = table
        .blackbody
        .as_ref()
        .is_some_and(|kelvin| now(kelvin) >= COLDEST);
    values.any(|value| value > 0.0)
        || hot && table.unit_at.is_none()
        || table.gaussian.is_some()
        || table.illuminant.is_some()
        || table
            .rgb
            .as_ref()
            .is_some_and(|rgb| rgb.at(1, 1).iter().any(|v| *v > 0.01))
}
