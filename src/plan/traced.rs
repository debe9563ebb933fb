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
    Accuracy, Background, Clock, Effects, Format, Light, Material, Model, Refraction, Shot,
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

/// What the shade trees of `still`, a shot of one frame, follow from, hashed: 16 hexadecimal digits.
pub(super) fn trace_key(still: &Shot, digests: &Digests, picture: Picture) -> String {
    let traced = Traced { still, digests };
    let models: Vec<Value> = still.model.iter().map(|m| traced.model(m)).collect();
    let materials: BTreeMap<&String, Value> = still
        .material
        .iter()
        .map(|(name, material)| (name, traced.material(material)))
        .collect();
    let lamps: Vec<Value> = still
        .light
        .iter()
        .filter_map(|light| traced.lamp(light))
        .collect();
    let splices: Vec<Value> = still.splice.iter().map(splice).collect();
    let exr = still.output.formats.contains(&Format::Exr);
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
        tracing,
        cutoff,
    } = still.accuracy;
    let Clock {
        title: _,
        frames: _,
        fps: _,
        time,
        light_speed,
    } = &still.shot;
    let traced = json!([
        [picture.size, [picture.samples], aspect(still.image.size)],
        [
            json!(still.image.filter),
            json!(exr.then_some(&still.output.layers))
        ],
        [json!(time), json!(light_speed)],
        still.camera,
        still.worldline.iter().collect::<Vec<_>>(),
        models,
        materials,
        lamps,
        traced.sky(&still.background),
        [json!(geometry), json!(shadows), json!(bounces)],
        splices,
        [json!(tracing), json!(cutoff)],
    ]);
    blake3::hash(traced.to_string().as_bytes()).to_hex()[..16].to_owned()
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

struct Traced<'a> {
    still: &'a Shot,
    digests: &'a Digests,
}

impl Traced<'_> {
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
