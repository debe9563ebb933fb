//! Which effects an image calls for, and the sentence why.

use super::motion::{MotionError, celerity};
use crate::relativity::Celerity;
use crate::shot::{Beaming, Effects, Material, Shot, SpectrumValue, Switch, Track};

/// The effects that are simulated in one image. What is false, or off, costs nothing.
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
    pub because: Vec<Reason>,
}

impl ActiveEffects {
    /// How many effects that is.
    pub fn count(&self) -> usize {
        let beaming = self.beaming != Beaming::Off;
        [
            self.geometry,
            self.doppler,
            beaming,
            self.thermal,
            self.shadows,
            self.mirror,
            self.refraction,
        ]
        .into_iter()
        .filter(|called| *called)
        .count()
    }
}

/// Why an effect is, or is not, simulated.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Reason {
    /// Name of the effect, as in `[effects]`.
    pub effect: &'static str,
    /// A sentence without full stop.
    pub why: String,
}

/// The effects that frame number `frame` calls for, under the author's `switches`.
///
/// # Errors
/// Where a worldline has no velocity in this frame.
pub fn active_effects(
    shot: &Shot,
    frame: u32,
    switches: &Effects,
) -> Result<ActiveEffects, MotionError> {
    let moving = relative_motion(shot, frame)?;
    let hot = hot_material(shot, frame);
    let lit = lamps(shot);
    let mut because = Vec::new();
    let mut call = |effect, allowed: bool, cause: Option<&str>, without: &str| {
        let why = match (allowed, cause) {
            (false, _) => "off in the shot".to_owned(),
            (true, Some(cause)) => cause.to_owned(),
            (true, None) => without.to_owned(),
        };
        because.push(Reason { effect, why });
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
        "there is no lamp",
    );
    let followed = switches.bounces > 0;
    let mirrors = weighted(shot, frame, |m| m.mirror.as_ref().map(|m| &m.weight));
    let mirrors = mirrors.map(|name| format!("material \"{name}\" is a mirror"));
    let mirror = call(
        "mirror",
        followed,
        mirrors.as_deref(),
        "no material is a mirror",
    );
    let glass = weighted(shot, frame, |m| m.refraction.as_ref().map(|r| &r.weight));
    let glass = glass.map(|name| format!("material \"{name}\" lets light through"));
    let refraction = call(
        "refraction",
        followed,
        glass.as_deref(),
        "no material is glass",
    );
    let beaming = if beamed {
        switches.beaming
    } else {
        Beaming::Off
    };
    Ok(ActiveEffects {
        geometry,
        doppler,
        beaming,
        thermal,
        shadows,
        mirror,
        refraction,
        because,
    })
}

/// The first two things that move relative to each other.
fn relative_motion(shot: &Shot, frame: u32) -> Result<Option<String>, MotionError> {
    let camera = celerity(shot, "camera", frame)?;
    let sky = (!is_black(shot, frame)).then(|| {
        (
            "the background".to_owned(),
            shot.background.worldline.as_deref().unwrap_or("camera"),
        )
    });
    let models = shot.model.iter().map(|model| {
        let name = model
            .name
            .clone()
            .unwrap_or_else(|| model.file.display().to_string());
        (
            format!("model \"{name}\""),
            model.worldline.as_deref().unwrap_or("lab"),
        )
    });
    let lights = shot.light.iter().enumerate().map(|(i, light)| {
        let name = light
            .name
            .as_ref()
            .map_or_else(|| format!("light {}", i + 1), Clone::clone);
        (name, light.worldline.as_deref().unwrap_or("lab"))
    });
    for (thing, worldline) in models.chain(lights).chain(sky) {
        let own = celerity(shot, worldline, frame)?;
        if own != camera {
            return Ok(Some(describe(&thing, own.seen_from(camera))));
        }
    }
    Ok(None)
}

fn describe(thing: &str, w: Celerity) -> String {
    let lorentz_factor = w.lorentz_factor();
    let beta = w.beta().length();
    if beta < 0.999 {
        format!("{thing} moves at {beta:.6} c relative to the camera")
    } else {
        format!(
            "{thing} moves relative to the camera with a Lorentz factor of {lorentz_factor:.6e}"
        )
    }
}

/// Whether the background is surely black in this frame.
pub(super) fn is_black(shot: &Shot, frame: u32) -> bool {
    let zero = |track: &Track<f64>| track.at(frame, shot.shot.frames) == 0.0;
    let background = &shot.background;
    if background.stars.is_some() {
        return false;
    }
    if background.scale.as_ref().is_some_and(zero) {
        return true;
    }
    match &background.spectrum {
        None => background.image.is_none(),
        Some(SpectrumValue::Number(track)) => zero(track),
        Some(_) => false,
    }
}

fn hot_material(shot: &Shot, frame: u32) -> Option<String> {
    let temperature = |material: &Material| {
        let track = material.thermal.as_ref()?.temperature.as_ref()?;
        Some(track.at(frame, shot.shot.frames)).filter(|t| *t > 0.0)
    };
    shot.material.iter().find_map(|(name, material)| {
        temperature(material).map(|t| format!("material \"{name}\" is at {t} K"))
    })
}

/// The first material whose term has a weight in this frame; without one of its own it is 1.
fn weighted(
    shot: &Shot,
    frame: u32,
    weight: impl Fn(&Material) -> Option<&Option<Track<f64>>>,
) -> Option<&str> {
    let has_weight = |material: &Material| {
        weight(material).is_some_and(|weight| {
            weight
                .as_ref()
                .is_none_or(|track| track.at(frame, shot.shot.frames) > 0.0)
        })
    };
    shot.material
        .iter()
        .find(|(_, material)| has_weight(material))
        .map(|(name, _)| name.as_str())
}

/// Lamps of the shot, or of model files that may hold some.
fn lamps(shot: &Shot) -> Option<String> {
    match shot.light.len() {
        0 => shot
            .model
            .iter()
            .any(|model| {
                model
                    .file
                    .extension()
                    .is_none_or(|e| !e.eq_ignore_ascii_case("obj"))
            })
            .then(|| "a model file may hold lamps".to_owned()),
        1 => Some("there is one lamp".to_owned()),
        n => Some(format!("there are {n} lamps")),
    }
}
