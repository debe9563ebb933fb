//! Knobs: samples, filter and files of an image.

use super::Knob;
use crate::render::Options;
use crate::shot::{Depth, Filter, Format};
use crate::study::start::Start;
use crate::study::timed_render::Variant;

const SAMPLES: [u32; 7] = [1, 2, 4, 8, 16, 32, 64];
const REFERENCE_SAMPLES: u32 = 256;

/// The knobs `image.samples` and `image.filter`.
pub(super) fn samples(start: &Start<'_>) -> Knob {
    let mut knob = Knob::new(
        "image.samples",
        "traverse",
        "samples a pixel, with either filter",
    );
    knob.reference = "at least 256 samples with the same filter, and four times the shot's";
    knob.note = Some(
        "the reference has an error of its own; each filter is compared with itself".to_owned(),
    );
    let (own, filter) = (start.options.samples, start.shot.image.filter);
    let variant = |count: u32, held: Filter, name: &str| {
        let mut shot = start.shot.clone();
        shot.image.filter = held;
        Variant {
            family: name.to_owned(),
            current: count == own && held == filter,
            shot,
            options: Options {
                samples: count,
                ..start.options.clone()
            },
            ..start.variant(
                format!("{count} samples, {name}"),
                Some(format!("samples = {count}\nfilter = \"{name}\"")),
            )
        }
    };
    for (held, name) in [
        (Filter::BlackmanHarris, "blackman-harris"),
        (Filter::Box, "box"),
    ] {
        let mut counts = SAMPLES.to_vec();
        if held == filter && !counts.contains(&own) {
            counts.push(own);
            counts.sort_unstable();
        }
        let variants = counts.into_iter().map(|count| variant(count, held, name));
        knob.variants.extend(variants);
        knob.references.push(variant(
            REFERENCE_SAMPLES.max(own.saturating_mul(4)),
            held,
            name,
        ));
    }
    knob
}

/// The knobs `output.formats` and `output.depth`.
pub(super) fn output(start: &Start<'_>) -> Knob {
    let mut knob = Knob::new(
        "output.formats",
        "write",
        "what the picture is written as: what is lost is measured on the file read again",
    );
    knob.reference = "the film before it is written";
    knob.files = true;
    let own = &start.shot.output;
    let variant = |format: Format, depth: Depth, setting: &str, toml: &str| {
        let mut shot = start.shot.clone();
        shot.output.formats = vec![format];
        shot.output.depth = depth;
        Variant {
            family: "files".to_owned(),
            current: own.formats == [format] && (format == Format::Png || own.depth == depth),
            shot,
            ..start.variant(setting.to_owned(), Some(toml.to_owned()))
        }
    };
    knob.variants = vec![
        variant(
            Format::Png,
            Depth::Float,
            "png, 8 bits",
            "formats = [\"png\"]",
        ),
        variant(
            Format::Exr,
            Depth::Half,
            "exr, half",
            "formats = [\"exr\"]\ndepth = \"half\"",
        ),
        variant(
            Format::Exr,
            Depth::Float,
            "exr, float",
            "formats = [\"exr\"]\ndepth = \"float\"",
        ),
    ];
    knob
}
