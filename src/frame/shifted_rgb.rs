//! Shots that hold spectra as three numbers, and frames whose light is shifted, which three numbers
//! cannot be.

use super::values::{Frame, Frames};
use crate::shot::{Effects, Mistake, Mistakes, Shot, Spectra};
use rayon::prelude::*;

/// Refuses the first frame that calls for the Doppler shift of three numbers, in all of the image
/// or in a splice. Frames without a velocity are left to [`Frame::new`].
///
/// # Errors
/// The frame and the key.
pub fn refuse_shifted_rgb(shot: &Shot) -> Result<(), Mistakes> {
    if shot.accuracy.spectra != Spectra::Rgb {
        return Ok(());
    }
    let numbers = (1..=shot.shot.frames).into_par_iter();
    let mistakes = numbers.map_init(
        || Frames::new(shot),
        |frames, number| mistake(frames.at(number).ok()?),
    );
    match mistakes.find_map_first(|mistake| mistake) {
        None => Ok(()),
        Some(mistake) => Err(Mistakes::new(&shot.places, vec![mistake])),
    }
}

fn mistake(frame: &Frame<'_>) -> Option<Mistake> {
    let whole = (String::new(), "[effects]", &frame.effects);
    let splices = frame.splices.iter().map(|splice| {
        let [top, bottom] = splice.rows;
        (
            format!(" in rows {top} to {bottom}"),
            "`effects` of [[splice]]",
            &splice.effects,
        )
    });
    let mut parts = std::iter::once(whole).chain(splices);
    parts.find_map(|(place, table, switches)| {
        let why = why_shifted(frame, switches)?;
        let number = frame.number;
        let message = format!(
            "frame {number} calls for the Doppler shift{place} ({why}), and three numbers cannot be shifted"
        );
        let help = format!("use \"grid\", or doppler = \"off\" under {table}");
        Some(frame.mistake("accuracy.spectra", message, Some(&help)))
    })
}

/// Why light is shifted under these switches, if it is.
fn why_shifted(frame: &Frame<'_>, switches: &Effects) -> Option<String> {
    let effects = frame.active_effects(switches);
    let mut reasons = effects.reasons.into_iter().filter(|_| effects.doppler);
    let reason = reasons.find(|reason| reason.effect == "doppler")?;
    Some(reason.why)
}
