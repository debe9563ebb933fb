//! Celerities and worldlines of a shot's named reference frames in one image.

use crate::relativity::{Celerity, CelerityError, Event, Worldline};
use crate::shot::{Shot, Velocity};
use glam::DVec3;

/// A velocity that is none in some frame, though its keys are.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("worldline \"{worldline}\" has no velocity in frame {frame}: {source}")]
pub struct MotionError {
    /// Name of the worldline.
    pub worldline: String,
    /// Number of the frame.
    pub frame: u32,
    /// What is wrong.
    pub source: CelerityError,
}

/// The celerity in the lab of the worldline `name` ("lab", "camera" or one of the shot's).
///
/// # Errors
/// Where a direction passes through zero, or a speed leaves the numbers, between two keys.
pub fn celerity(shot: &Shot, name: &str, frame: u32) -> Result<Celerity, MotionError> {
    let name = own_name(shot, name);
    let Some(line) = shot.worldline.get(name) else {
        return Ok(Celerity::REST); // "lab"; other names were checked when the shot was read
    };
    let frames = shot.shot.frames;
    let celerity = match &line.velocity {
        Velocity::Beta(beta) => Celerity::from_beta(DVec3::from(beta.at(frame, frames))),
        Velocity::Gamma(v) => Celerity::from_lorentz_factor(
            v.gamma.at(frame, frames),
            DVec3::from(v.direction.at(frame, frames)),
        ),
        Velocity::Rapidity(v) => Celerity::from_rapidity(
            v.rapidity.at(frame, frames),
            DVec3::from(v.direction.at(frame, frames)),
        ),
    };
    celerity.map_err(|source| MotionError {
        worldline: name.to_owned(),
        frame,
        source,
    })
}

/// The worldline `name` in one image, times turned to metres of light travel.
///
/// # Errors
/// As [`celerity`].
pub fn worldline(shot: &Shot, name: &str, frame: u32) -> Result<Worldline, MotionError> {
    let celerity = celerity(shot, name, frame)?;
    let Some(line) = shot.worldline.get(own_name(shot, name)) else {
        return Ok(Worldline::LAB);
    };
    let frames = shot.shot.frames;
    let origin = Event::new(
        line.at.at(frame, frames) * shot.shot.light_speed,
        DVec3::from(line.passes.at(frame, frames)),
    );
    Ok(Worldline { celerity, origin })
}

/// "camera" is another name for the worldline that the camera rides on.
fn own_name<'a>(shot: &'a Shot, name: &'a str) -> &'a str {
    match name {
        "camera" => shot.camera.worldline.as_deref().unwrap_or("lab"),
        name => name,
    }
}
