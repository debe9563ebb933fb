//! Knobs: representation and resolution of spectra.

use super::Knob;
use crate::frame::{ActiveEffects, Frame};
use crate::shot::{Accuracy, Shot, Spectra, Switch};
use crate::spectrum::LineAxis;
use crate::study::start::Start;
use crate::study::timed_render::Variant;

/// Spacings of lines, nm; the paper's is 5.
const LINES_NM: [f64; 4] = [10.0, 5.0, 2.5, 1.0];
/// Wavelength counts of splines; the paper's is 81.
const SPLINE_WAVELENGTHS: [u32; 7] = [8, 11, 16, 31, 61, 81, 121];
const GRID_WAVELENGTHS: [u32; 7] = [8, 11, 21, 42, 84, 168, 336];

/// The knob `accuracy.spectra`, with its resolutions.
pub(super) fn spectra(start: &Start<'_>, active: &ActiveEffects) -> Knob {
    let mut knob = Knob::new(
        "accuracy.spectra",
        "shade",
        "how spectra are held, and how finely",
    );
    knob.reference = "adaptive quadrature of the authored curves in f64, the same rays";
    let variant = |setting: String, family: &str, accuracy: Accuracy, toml: String| Variant {
        family: family.to_owned(),
        current: accuracy == start.shot.accuracy,
        shot: Shot {
            accuracy,
            ..start.shot.clone()
        },
        ..start.variant(setting, Some(toml))
    };
    let own = start.shot.accuracy;
    let mut variants = vec![without_shift(start, active)];
    let seen = |nm: &f64| lines_seen(start.shot, *nm);
    if !LINES_NM.iter().all(seen) {
        knob.note = Some("lines that the sensor's window leaves out are not compared".to_owned());
    }
    variants.extend(LINES_NM.into_iter().filter(seen).map(|nm| {
        let accuracy = Accuracy {
            spectra: Spectra::Lines,
            line_spacing: nm,
            ..own
        };
        let toml = format!("spectra = \"lines\"\nline_spacing = {nm:?}");
        variant(format!("lines, {nm} nm"), "lines", accuracy, toml)
    }));
    for (word, held, counts) in [
        ("spline", Spectra::Spline, SPLINE_WAVELENGTHS),
        ("grid", Spectra::Grid, GRID_WAVELENGTHS),
    ] {
        variants.extend(counts.map(|wavelengths| {
            let accuracy = Accuracy {
                spectra: held,
                wavelengths,
                ..own
            };
            let toml = format!("spectra = \"{word}\"\nwavelengths = {wavelengths}");
            let setting = format!("{word}, {wavelengths} wavelengths");
            variant(setting, word, accuracy, toml)
        }));
    }
    if !variants.iter().any(|variant| variant.current) && own.spectra != Spectra::Exact {
        variants.push(start.as_it_is());
    }
    let exact = Accuracy {
        spectra: Spectra::Exact,
        ..own
    };
    let toml = "spectra = \"exact\"".to_owned();
    knob.references = vec![variant("exact".to_owned(), "exact", exact, toml)];
    knob.variants = variants;
    knob
}

/// The image with RGB colors and without shift, which RGB cannot represent.
pub(in crate::study) fn without_shift(start: &Start<'_>, active: &ActiveEffects) -> Variant {
    let mut shot = Shot {
        accuracy: Accuracy {
            spectra: Spectra::Rgb,
            ..start.shot.accuracy
        },
        ..start.shot.clone()
    };
    shot.effects.doppler = Switch::Off;
    for splice in &mut shot.splice {
        splice.effects.doppler = Some(Switch::Off);
    }
    let shifts = active.doppler || splices_shift(start);
    let setting = if shifts { "rgb, no shift" } else { "rgb" };
    let toml = (!shifts).then(|| "spectra = \"rgb\"".to_owned());
    Variant {
        family: "rgb".to_owned(),
        current: start.shot.accuracy.spectra == Spectra::Rgb,
        shot,
        ..start.variant(setting.to_owned(), toml)
    }
}

/// Whether the sensor's window contains spectral lines at this spacing.
pub(in crate::study) fn lines_seen(shot: &Shot, spacing_nm: f64) -> bool {
    LineAxis::new(spacing_nm)
        .within(shot.sensor.window)
        .next()
        .is_some()
}

fn splices_shift(start: &Start<'_>) -> bool {
    Frame::new(start.shot, start.frame).is_ok_and(|frame| {
        let mut splices = frame.splices.iter();
        splices.any(|splice| frame.active_effects(&splice.effects).doppler)
    })
}
