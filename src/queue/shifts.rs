//! Frames whose light is shifted, though the shot holds spectra as three numbers.

use crate::frame;
use crate::render::spliced;
use crate::shot::{Effects, Mistake, Mistakes, Shot, Spectra};
use rayon::prelude::*;

/// Refuses the first frame that calls for the Doppler shift of three numbers, in all of the image
/// or in a splice. Frames without a velocity are left to those who resolve them.
///
/// # Errors
/// The frame and the key.
pub fn refuse_shifted_numbers(shot: &Shot) -> Result<(), Mistakes> {
    if shot.accuracy.spectra != Spectra::Rgb {
        return Ok(());
    }
    let parts = parts(shot);
    let frames = (1..=shot.shot.frames).into_par_iter();
    let mistake =
        frames.find_map_first(|frame| parts.iter().find_map(|part| part.mistake(shot, frame)));
    mistake.map_or(Ok(()), |mistake| {
        Err(Mistakes::new(&shot.places, vec![mistake]))
    })
}

/// A part of the image under its own effects.
struct Part {
    /// As a message continues with it.
    place: String,
    /// Table of the file that switches its effects.
    table: &'static str,
    effects: Effects,
}

fn parts(shot: &Shot) -> Vec<Part> {
    let whole = Part {
        place: String::new(),
        table: "[effects]",
        effects: shot.effects,
    };
    let splices = shot.splice.iter().map(|splice| {
        let [top, bottom] = splice.rows;
        Part {
            place: format!(" in rows {top} to {bottom}"),
            table: "`effects` of [[splice]]",
            effects: spliced(&shot.effects, splice),
        }
    });
    std::iter::once(whole).chain(splices).collect()
}

impl Part {
    fn mistake(&self, shot: &Shot, frame: u32) -> Option<Mistake> {
        let called = frame::active_effects(shot, frame, &self.effects).ok()?;
        if !called.doppler {
            return None;
        }
        let reasons = called.because.iter();
        let why = reasons
            .filter(|reason| reason.effect == "doppler")
            .map(|reason| reason.why.as_str())
            .collect::<String>();
        let message = format!(
            "frame {frame} calls for the Doppler shift{} ({why}), and three numbers cannot be shifted",
            self.place
        );
        let help = format!("use \"grid\", or doppler = \"off\" under {}", self.table);
        Some(shot.places.mistake("accuracy.spectra", message, help))
    }
}
