//! The values that reach a frame's pixels, each by the key that its author would change.
//!
//! Structs of the shot are taken apart by all their keys: one that is new does not compile until it
//! is placed, with those that reach pixels or with those that do not.

use super::super::at::At;
use super::super::settings::{Resolution, aspect};
use super::list::{FingerprintInputs, List};
use crate::shot::{
    Accuracy, Array, Camera, Clock, Effects, Exposure, Format, GammaVelocity, Image, Inset, Layer,
    Model, Output, RapidityVelocity, Scale, Sensor, Shot, Splice, SpliceEffects, Velocity,
    Worldline,
};

/// What the pixels are for.
#[derive(Clone, Copy)]
pub(super) enum For<'a> {
    /// For the small render that exposure is metered on.
    Metering,
    /// For the frame's files.
    Output {
        /// Their size and samples.
        resolution: Resolution,
        /// The inputs of the frame that exposure is metered on, hashed; None where it is authored.
        metered: Option<&'a str>,
    },
}

/// What the pixels of a frame are made of, its files aside.
pub(super) fn inputs(at: At<'_>, pixels: For<'_>) -> FingerprintInputs {
    let mut list = List::new(at);
    if let For::Output {
        resolution: Resolution { size, samples },
        metered,
    } = pixels
    {
        list.leaf("size", &size);
        list.leaf("samples", &samples);
        if let Some(metered) = metered {
            let key = "frame 1, on which exposure is metered";
            list.inputs.insert(key.to_owned(), metered.to_owned());
        }
    }
    list.shot(at.shot, matches!(pixels, For::Output { .. }));
    list.inputs
}

impl List<'_> {
    fn shot(&mut self, shot: &Shot, files: bool) {
        let Shot {
            shot: clock,
            image,
            worldline,
            model,
            material,
            spectrum,
            light,
            background,
            camera,
            effects,
            splice,
            sensor,
            accuracy,
            output,
            inset,
            sequence: _, // made of finished frames
            path: _,     // models and tables count by their content
            places: _,
        } = shot;
        let insets: &[Inset] = match files && output.formats.contains(&Format::Png) {
            true => inset,
            false => &[],
        };
        self.table("shot", |list| list.clock(clock));
        self.table("image", |list| list.image(image, !insets.is_empty()));
        self.named("worldline", worldline, Self::worldline);
        self.tables("model", model, Self::model);
        self.named("material", material, Self::material);
        let used = shot.used_spectra();
        let used = spectrum
            .iter()
            .filter(|(name, _)| used.contains(name.as_str()));
        self.named("spectrum", used, Self::spectrum_table);
        self.tables("light", light, Self::light);
        self.table("background", |list| list.background(background));
        self.table("camera", |list| list.camera(camera));
        self.table("effects", |list| list.effects(effects));
        self.tables("splice", splice, Self::splice);
        self.table("sensor", |list| list.sensor(sensor, files));
        self.table("accuracy", |list| list.accuracy(accuracy));
        if files && output.formats.contains(&Format::Exr) {
            self.table("output", |list| list.output(output, worldline.keys()));
        }
        self.tables("inset", insets, Self::inset);
    }

    fn clock(&mut self, clock: &Clock) {
        let Clock {
            title: _,
            frames: _, // read with the tracks
            fps: _,
            time,
            light_speed,
        } = clock;
        self.track("time", time);
        self.leaf("light_speed", light_speed);
    }

    fn image(&mut self, image: &Image, insets: bool) {
        let Image {
            size,
            samples: _, // as they are asked for
            filter,
        } = image;
        self.leaf("filter", filter);
        self.leaf("aspect", &aspect(*size));
        if insets {
            // Their pixels are those of an image of the full size.
            self.leaf("size", size);
        }
    }

    fn worldline(&mut self, line: &Worldline) {
        let Worldline {
            velocity,
            passes,
            at,
        } = line;
        match velocity {
            Velocity::Beta(beta) => self.track("velocity", beta),
            Velocity::Gamma(GammaVelocity { gamma, direction }) => {
                self.table("velocity", |list| {
                    list.track("gamma", gamma);
                    list.track("direction", direction);
                });
            }
            Velocity::Rapidity(RapidityVelocity {
                rapidity,
                direction,
            }) => self.table("velocity", |list| {
                list.track("rapidity", rapidity);
                list.track("direction", direction);
            }),
        }
        self.track("passes", passes);
        self.track("at", at);
    }

    fn model(&mut self, model: &Model) {
        let Model {
            name,
            file,
            worldline,
            translate,
            rotate,
            scale,
            array,
            material,
            materials,
            light_units,
        } = model;
        self.given("name", name);
        self.leaf("file", file);
        self.given("worldline", worldline);
        self.given_track("translate", translate);
        self.given_track("rotate", rotate);
        match scale {
            None => {}
            Some(Scale::Uniform(scale)) => self.track("scale", scale),
            Some(Scale::PerAxis(scale)) => self.track("scale", scale),
        }
        if let Some(Array {
            count,
            step,
            centered,
        }) = array
        {
            self.table("array", |list| {
                list.leaf("count", count);
                list.track("step", step);
                list.leaf("centered", centered);
            });
        }
        self.given("material", material);
        if !materials.is_empty() {
            self.table("materials", |list| {
                for (of_file, own) in materials {
                    list.leaf(of_file, own);
                }
            });
        }
        self.given("light_units", light_units);
    }

    fn camera(&mut self, camera: &Camera) {
        let Camera {
            worldline,
            position,
            look_at,
            yaw,
            pitch,
            roll,
            pan,
            tilt,
            hfov,
            vfov,
            projection,
        } = camera;
        self.given("worldline", worldline);
        self.given_track("position", position);
        self.given_track("look_at", look_at);
        self.given_track("yaw", yaw);
        self.given_track("pitch", pitch);
        self.given_track("roll", roll);
        self.given_track("pan", pan);
        self.given_track("tilt", tilt);
        self.given_track("hfov", hfov);
        self.given_track("vfov", vfov);
        self.given("projection", projection);
    }

    fn effects(&mut self, effects: &Effects) {
        let Effects {
            geometry,
            doppler,
            beaming,
            thermal,
            shadows,
            bounces,
        } = effects;
        self.leaf("geometry", geometry);
        self.leaf("doppler", doppler);
        self.leaf("beaming", beaming);
        self.leaf("thermal", thermal);
        self.leaf("shadows", shadows);
        self.leaf("bounces", bounces);
    }

    fn splice(&mut self, splice: &Splice) {
        let Splice { rows, effects } = splice;
        let SpliceEffects {
            geometry,
            doppler,
            beaming,
            thermal,
            shadows,
            bounces,
        } = effects;
        self.leaf("rows", rows);
        self.table("effects", |list| {
            list.given("geometry", geometry);
            list.given("doppler", doppler);
            list.given("beaming", beaming);
            list.given("thermal", thermal);
            list.given("shadows", shadows);
            list.given("bounces", bounces);
        });
    }

    fn sensor(&mut self, sensor: &Sensor, files: bool) {
        let Sensor {
            window,
            color,
            exposure,
            tone,
            gamut,
        } = sensor;
        self.leaf("window", window);
        self.leaf("color", color);
        // Metering knows neither.
        if files {
            self.leaf("tone", tone);
            self.leaf("gamut", gamut);
            if let Exposure::Stops(stops) = exposure {
                self.track("exposure", stops);
            }
        }
    }

    fn accuracy(&mut self, accuracy: &Accuracy) {
        let Accuracy {
            spectra,
            wavelengths,
            line_spacing,
            cutoff,
        } = accuracy;
        self.leaf("spectra", spectra);
        self.leaf("wavelengths", wavelengths);
        self.leaf("line_spacing", line_spacing);
        self.leaf("cutoff", cutoff);
    }

    /// What EXR files show.
    fn output<'t>(&mut self, output: &Output, worldlines: impl Iterator<Item = &'t String>) {
        let Output {
            formats: _, // the files are known by their names
            layers,
            depth,
        } = output;
        self.leaf("depth", depth);
        self.leaf("layers", layers);
        if layers.contains(&Layer::Worldline) {
            // The layer has their numbers.
            self.leaf("worldlines", &worldlines.collect::<Vec<_>>());
        }
    }

    /// What PNG files show.
    fn inset(&mut self, inset: &Inset) {
        let Inset { pixel, place, size } = inset;
        self.leaf("pixel", pixel);
        self.leaf("place", place);
        self.leaf("size", size);
    }
}
