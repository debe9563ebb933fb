//! The effects that a frame calls for, and one sentence each why.

use super::light::{Light, Shines};
use super::model::Model;
use super::values::Frame;
use crate::relativity::Celerity;
use crate::shot::{Beaming, Effects, Switch};

/// The effects that are simulated. What is false, or off, costs nothing.
#[derive(Debug, Clone, PartialEq)]
pub struct ActiveEffects {
    /// Finite light speed: retardation, aberration, contraction.
    pub geometry: bool,
    /// Wavelength shift.
    pub doppler: bool,
    /// Powers of the Doppler factor on radiance and irradiance.
    pub beaming: Beaming,
    /// Thermal light.
    pub thermal: bool,
    /// Shadow rays.
    pub shadows: bool,
    /// Ideal reflection.
    pub mirror: bool,
    /// Ideal refraction.
    pub refraction: bool,
    /// One sentence an effect.
    pub reasons: Vec<Reason>,
}

/// Why an effect is, or is not, simulated.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Reason {
    /// Name of the effect, as in `[effects]`.
    pub effect: &'static str,
    /// A sentence without full stop.
    pub why: String,
}

impl ActiveEffects {
    /// How many effects that is.
    pub fn count(&self) -> usize {
        self.all().into_iter().filter(|(_, active)| *active).count()
    }

    /// Names of the effects, in the order in which they are told.
    pub fn names(&self) -> Vec<String> {
        let active = self.all().into_iter().filter(|(_, active)| *active);
        active.map(|(name, _)| name.to_owned()).collect()
    }

    /// Every effect's name, and whether it is simulated.
    fn all(&self) -> [(&'static str, bool); 7] {
        // By all their keys: one that is new does not compile until it has a name.
        let Self {
            geometry,
            doppler,
            beaming,
            thermal,
            shadows,
            mirror,
            refraction,
            reasons: _,
        } = self;
        [
            ("geometry", *geometry),
            ("doppler", *doppler),
            ("beaming", *beaming != Beaming::Off),
            ("thermal", *thermal),
            ("shadows", *shadows),
            ("mirror", *mirror),
            ("refraction", *refraction),
        ]
    }
}

impl Frame<'_> {
    /// The effects that the frame calls for under the author's `switches`: [`Frame::effects`], or
    /// those of a splice.
    pub fn active_effects(&self, switches: &Effects) -> ActiveEffects {
        let moving = self.relative_motion();
        let hot = self.hot_material();
        let lit = self.lamps();
        let mut reasons = Vec::new();
        let mut call = |effect, allowed: bool, cause: Option<&str>, without: &str| {
            let why = match (allowed, cause) {
                (false, _) => "off in the shot".to_owned(),
                (true, Some(cause)) => cause.to_owned(),
                (true, None) => without.to_owned(),
            };
            reasons.push(Reason { effect, why });
            allowed && cause.is_some()
        };
        let still = "nothing moves relative to the camera or to a lamp";
        let moving = moving.as_deref();
        let geometry = call("geometry", switches.geometry == Switch::Auto, moving, still);
        let doppler = call("doppler", switches.doppler == Switch::Auto, moving, still);
        let beamed = call("beaming", switches.beaming != Beaming::Off, moving, still);
        let thermal = call(
            "thermal",
            switches.thermal == Switch::Auto,
            hot.as_deref(),
            "no material is above 0 K",
        );
        let shadows = call(
            "shadows",
            switches.shadows == Switch::Auto,
            lit.as_deref(),
            "no lamp shines",
        );
        let followed = switches.bounces > 0;
        let mirror = call(
            "mirror",
            followed,
            self.mirror().as_deref(),
            "no material is a mirror",
        );
        let refraction = call(
            "refraction",
            followed,
            self.glass().as_deref(),
            "no material is glass",
        );
        let beaming = match beamed {
            true => switches.beaming,
            false => Beaming::Off,
        };
        ActiveEffects {
            geometry,
            doppler,
            beaming,
            thermal,
            shadows,
            mirror,
            refraction,
            reasons,
        }
    }

    /// Names of the effects that are simulated in the frame, in all of it or in a splice.
    pub fn active_names(&self) -> Vec<String> {
        let switches = self.splices.iter().map(|splice| &splice.effects);
        let mut names = self.active_effects(&self.effects).all();
        for switches in switches {
            let own = self.active_effects(switches).all();
            for ((_, active), (_, also)) in names.iter_mut().zip(own) {
                *active |= also;
            }
        }
        let active = names.into_iter().filter(|(_, active)| *active);
        active.map(|(name, _)| name.to_owned()).collect()
    }

    /// The author's switches that hold in a row of the image: those of the last splice that covers it,
    /// or the shot's.
    pub fn effects_at(&self, row: u32) -> Effects {
        let [_, height] = self.image.size;
        let mut splices = self.splices.iter().rev();
        let splice = splices.find(|splice| splice.rows_of(height).contains(&row));
        splice.map_or(self.effects, |splice| splice.effects)
    }

    /// Places of the worldlines that something to see rides on, each with what it is.
    pub(super) fn moving_things(&self) -> impl Iterator<Item = (MovingThing<'_>, usize)> {
        let models = self.models.iter();
        let models = models.map(|model| (MovingThing::Model(&model.name), model.worldline));
        let lights = self.lit_lamps();
        let lights = lights.map(|light| (MovingThing::Light(&light.name), light.worldline));
        let sky = (!self.background.is_black())
            .then_some((MovingThing::Background, self.background.worldline));
        models.chain(lights).chain(sky)
    }

    /// The first thing that moves relative to the camera, in words.
    fn relative_motion(&self) -> Option<String> {
        let camera = self.celerity(self.camera.worldline);
        self.moving_things().find_map(|(thing, worldline)| {
            let own = self.celerity(worldline);
            (own != camera).then(|| thing.describe(own.seen_from(camera)))
        })
    }

    fn hot_material(&self) -> Option<String> {
        self.materials.iter().find_map(|(name, material)| {
            let kelvin = material.thermal.map(|thermal| thermal.temperature_k);
            let kelvin = kelvin.filter(|kelvin| *kelvin > 0.0)?;
            Some(format!("material \"{name}\" is at {kelvin} K"))
        })
    }

    fn mirror(&self) -> Option<String> {
        self.materials.iter().find_map(|(name, material)| {
            let is_mirror = material.mirror?.has_weight();
            is_mirror.then(|| format!("material \"{name}\" is a mirror"))
        })
    }

    fn glass(&self) -> Option<String> {
        self.materials.iter().find_map(|(name, material)| {
            let is_glass = material.refraction?.term.has_weight();
            is_glass.then(|| format!("material \"{name}\" lets light through"))
        })
    }

    /// Lamps of the shot that are not dark at this frame.
    fn lit_lamps(&self) -> impl Iterator<Item = &Light<'_>> {
        let lights = self.lights.iter();
        lights.filter(|light| light.shines() != Shines::Never)
    }

    /// Lamps of the shot, or of model files that may hold some.
    fn lamps(&self) -> Option<String> {
        match self.lit_lamps().count() {
            0 => {
                let some = self.models.iter().any(Model::may_hold_lamps);
                some.then(|| "a model file may hold lamps".to_owned())
            }
            1 => Some("there is one lamp".to_owned()),
            n => Some(format!("there are {n} lamps")),
        }
    }
}

/// A thing that rides on a worldline.
#[derive(Debug, Clone, Copy)]
pub(super) enum MovingThing<'a> {
    Model(&'a str),
    Light(&'a str),
    Background,
}

impl MovingThing<'_> {
    /// A sentence about its celerity as the camera sees it.
    fn describe(self, relative: Celerity) -> String {
        let thing = match self {
            Self::Model(name) => format!("model \"{name}\""),
            Self::Light(name) => name.to_owned(),
            Self::Background => "the background".to_owned(),
        };
        let lorentz_factor = relative.lorentz_factor();
        let beta = relative.beta().length();
        if beta < 0.999 {
            format!("{thing} moves at {beta:.6} c relative to the camera")
        } else {
            format!(
                "{thing} moves relative to the camera with a Lorentz factor of {lorentz_factor:.6e}"
            )
        }
    }
}
