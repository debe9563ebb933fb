//! What the shade trees of a frame follow from, hashed section by section.
//!
//! That is what tracing reads, without what shading alone does: temperatures, emission, colors,
//! exposure, and the effects on light on its way. Of a material's term counts only that it is there,
//! of a lamp that it shines, of the sky that it is not black. Mirrors and glass count in full: their
//! reflectances decide which branches are worth following. Where presence depends on a spectrum's
//! numbers, these count as well: frames may then be traced apart that need not be, never the other
//! way round.

use super::digests::Digests;
use super::hasher::Hasher;
use super::light::{Amount, Background, Light, Shines};
use super::material::{Highlight, Material, Presence, Refraction, Term};
use super::model::{Array, Model};
use super::settings::{Resolution, Splice, aspect};
use super::values::{ChangingSections, Frame};
use super::{camera, worldline};
use crate::relativity;
use crate::shot::{Accuracy, Effects, Format, Image, Layer, Output};

/// A part of what shade trees follow from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Section {
    Time,
    Camera,
    Worldlines,
    Models,
    Materials,
    Lamps,
    Sky,
    Settings,
}

impl Section {
    /// All of them, in the order in which they are hashed.
    pub(super) const ALL: [Self; 8] = [
        Self::Time,
        Self::Camera,
        Self::Worldlines,
        Self::Models,
        Self::Materials,
        Self::Lamps,
        Self::Sky,
        Self::Settings,
    ];

    /// Whether it may be another in each frame.
    pub(super) fn moves(self, moving: ChangingSections) -> bool {
        match self {
            Self::Time => moving.time,
            Self::Camera => moving.camera,
            Self::Worldlines => moving.worldlines,
            Self::Models => moving.models,
            Self::Materials => moving.materials,
            Self::Lamps => moving.lights,
            Self::Sky => moving.background,
            Self::Settings => false,
        }
    }
}

/// What the shade trees of a frame follow from. Structs are taken apart by all their keys: one that
/// is new does not compile until it is placed.
pub(super) struct Traced<'a> {
    pub(super) frame: &'a Frame<'a>,
    pub(super) digests: &'a Digests,
    pub(super) resolution: Resolution,
}

/// Hashes by section, in the order of [`Section::ALL`].
pub(super) type Sections = [[u8; 32]; Section::ALL.len()];

impl Traced<'_> {
    /// Hashes of all sections.
    pub(super) fn sections(&self) -> Sections {
        Section::ALL.map(|section| self.hash(section))
    }

    /// The hash of one section.
    pub(super) fn hash(&self, section: Section) -> [u8; 32] {
        let mut hasher = Hasher::default();
        let Frame {
            number: _,
            title: _,
            fps: _,
            time_s: _,
            lab_time,
            worldlines,
            camera,
            models,
            body_order,
            materials,
            lights,
            background,
            effects,
            splices,
            image,
            sensor: _,
            exposure_stops: _,
            accuracy,
            output,
            insets: _,
            shot: _,
            faults: _,
        } = self.frame;
        match section {
            Section::Time => {
                hasher.number(*lab_time);
            }
            Section::Camera => self.camera(&mut hasher, camera),
            Section::Worldlines => worldlines.iter().for_each(|line| {
                // Names order bodies, which `body_order` tells.
                let worldline::Worldline { name: _, motion } = line;
                let relativity::Worldline { celerity, origin } = motion;
                hasher.vector(celerity.vector());
                hasher.number(origin.t).vector(origin.x);
            }),
            Section::Models => {
                hasher.count(body_order.len());
                body_order.iter().for_each(|place| {
                    hasher.count(*place);
                });
                models.iter().for_each(|m| self.model(&mut hasher, m));
            }
            Section::Materials => {
                let mut sorted: Vec<_> = materials.iter().collect();
                sorted.sort_unstable_by_key(|(name, _)| **name);
                for (name, material) in sorted {
                    self.material(hasher.text(name), material);
                }
            }
            Section::Lamps => lights.iter().for_each(|l| self.lamp(&mut hasher, l)),
            Section::Sky => self.sky(&mut hasher, background),
            Section::Settings => {
                self.resolution(&mut hasher, image, output);
                let Accuracy {
                    spectra: _,
                    wavelengths: _,
                    line_spacing: _,
                    cutoff,
                } = accuracy;
                hasher.number(*cutoff);
                self.effects(&mut hasher, effects);
                for Splice { rows, effects } in splices {
                    hasher.number(rows[0]).number(rows[1]);
                    self.effects(&mut hasher, effects);
                }
            }
        }
        *hasher.finish().as_bytes()
    }

    fn resolution(&self, hasher: &mut Hasher, image: &Image, output: &Output) {
        let Resolution { size, samples } = self.resolution;
        let Image {
            size: whole,
            samples: _,
            filter,
        } = image;
        let Output {
            formats,
            layers,
            depth: _,
        } = output;
        for side in size.into_iter().chain(aspect(*whole)) {
            hasher.whole(side);
        }
        hasher.whole(samples).kind(*filter as u8);
        let exr = formats.contains(&Format::Exr);
        let layers: &[Layer] = if exr { layers } else { &[] };
        hasher.flag(exr).count(layers.len());
        layers.iter().for_each(|layer| {
            hasher.kind(*layer as u8);
        });
    }

    fn effects(&self, hasher: &mut Hasher, effects: &Effects) {
        let Effects {
            geometry,
            doppler: _,
            beaming: _,
            thermal: _,
            shadows,
            bounces,
        } = effects;
        let switches = hasher.kind(*geometry as u8).kind(*shadows as u8);
        switches.whole(*bounces);
    }

    fn camera(&self, hasher: &mut Hasher, camera: &camera::Camera) {
        let camera::Camera {
            worldline,
            position,
            aim,
            roll_deg,
            pan_deg,
            tilt_deg,
            hfov_deg,
            vfov_deg,
            projection,
        } = camera;
        hasher.count(*worldline).vector(*position);
        match aim {
            camera::Aim::At(point) => hasher.kind(0).vector(*point),
            camera::Aim::Along { yaw_deg, pitch_deg } => {
                hasher.kind(1).number(*yaw_deg).number(*pitch_deg)
            }
        };
        hasher.number(*roll_deg).number(*pan_deg).number(*tilt_deg);
        hasher.given(*hfov_deg).given(*vfov_deg);
        hasher.kind(*projection as u8);
    }

    fn model(&self, hasher: &mut Hasher, model: &Model<'_>) {
        let Model {
            name: _, // it orders bodies, which `body_order` tells
            file,
            worldline,
            translate,
            rotate_deg,
            scale,
            array,
            material,
            materials,
            light_units: _,
        } = model;
        // Materials of one file are the same ones, of two files with one content they are not.
        let mut models = self.frame.models.iter();
        let first = models.position(|other| other.file == *file);
        hasher.count(first.unwrap_or_default());
        hasher.texts(&self.digests.of(file)).count(*worldline);
        hasher.vector(*translate).vector(*rotate_deg).vector(*scale);
        hasher.flag(array.is_some());
        if let Some(Array {
            count,
            step,
            centered,
        }) = array
        {
            count.iter().for_each(|copies| {
                hasher.whole(*copies);
            });
            hasher.vector(*step).flag(*centered);
        }
        let whole: Vec<&str> = material.iter().copied().collect();
        hasher.texts(&whole).count(materials.len());
        for (of_file, own) in *materials {
            hasher.text(of_file).text(own);
        }
    }

    fn material(&self, hasher: &mut Hasher, material: &Material<'_>) {
        let Material {
            diffuse,
            highlight,
            mirror,
            refraction,
            emission: _,
            thermal: _,
        } = material;
        let presence = |term: &Option<Term<'_>>| term.map(Term::presence);
        let is_there = |term: &Option<Term<'_>>| {
            presence(term).is_some_and(|presence| presence != Presence::Gone)
        };
        hasher.flag(diffuse.is_some());
        if let Some(presence) = presence(diffuse) {
            hasher.kind(presence as u8);
        }
        let highlight = highlight.filter(|h| h.term.presence() != Presence::Gone);
        hasher.flag(highlight.is_some());
        if let Some(Highlight { term, exponent }) = highlight {
            hasher.kind(term.presence() as u8).given(exponent);
        }
        hasher.flag(is_there(mirror));
        if let Some(mirror) = mirror.filter(|_| is_there(mirror)) {
            self.term(hasher, mirror);
        }
        // Without transmittance it is still a boundary, which gives a mirror its share.
        let refraction =
            refraction.filter(|r| is_there(mirror) || r.term.presence() != Presence::Gone);
        hasher.flag(refraction.is_some());
        if let Some(Refraction { term, ior }) = refraction {
            self.term(hasher, term);
            hasher.given(ior);
        }
    }

    fn term(&self, hasher: &mut Hasher, Term { weight, spectrum }: Term<'_>) {
        hasher.given(weight).flag(spectrum.is_some());
        if let Some(spectrum) = spectrum {
            spectrum.hash(hasher, self.digests);
        }
    }

    /// A lamp, if it shines.
    fn lamp(&self, hasher: &mut Hasher, light: &Light<'_>) {
        let Light {
            name: _,
            kind,
            worldline,
            position,
            direction,
            inner_deg,
            outer_deg,
            amount: _, // as far as `shines` says
            spectrum,
        } = light;
        let shines = light.shines();
        if shines == Shines::Never {
            return;
        }
        hasher.kind(*kind as u8).count(*worldline);
        hasher.vector(*position).vector(*direction);
        hasher.number(*inner_deg).number(*outer_deg);
        hasher.flag(shines == Shines::Surely);
        if let Shines::Perhaps(Amount::Photometric(amount) | Amount::Spectral(amount)) = shines {
            spectrum.hash(hasher.number(amount), self.digests);
        }
    }

    /// The sky, if it is not black.
    fn sky(&self, hasher: &mut Hasher, sky: &Background<'_>) {
        let Background {
            worldline,
            spectrum,
            image,
            scale: _, // as far as `is_black` says
            stars,
        } = sky;
        if sky.is_black() {
            return;
        }
        hasher.count(*worldline);
        let surely = stars.is_some() || image.is_some();
        if let Some(spectrum) = spectrum.filter(|s| !surely && !s.is_surely_lit()) {
            spectrum.hash(hasher, self.digests);
        }
    }
}
