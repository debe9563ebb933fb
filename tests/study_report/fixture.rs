//! A study with everything that a report can meet, in numbers as a real one has them.

use restframe::study::results::{
    EffectCost, Errors, Halving, Machine, Noise, PaperRow, Percentiles, PhaseTime, Point,
    Recommendation, Study, Sweep, Timing,
};

/// A name that must be escaped wherever it stands.
pub(crate) const AWKWARD: &str = r#"A <b>bold</b> & "quoted" title, 'twice'"#;

pub(crate) fn timing(median: f64) -> Timing {
    Timing {
        median,
        least: 0.98 * median,
        greatest: 1.03 * median,
    }
}

/// A setting: family, what is written, time of the image and ΔE2000 at 99 %, if it is no reference.
fn point(setting: &str, family: &str, seconds: f64, delta_e: Option<f64>) -> Point {
    let errors = |p99: f64| Errors {
        radiance: p99 * 4.1e-3,
        delta_e: Some(Percentiles {
            mean: p99 * 0.31,
            p99,
            worst: p99 * 2.7,
        }),
        displacement: None,
        mistaken: None,
        bound: None,
    };
    Point {
        setting: setting.to_owned(),
        family: family.to_owned(),
        toml: Some(format!("spectra = \"{family}\"")),
        current: false,
        frame: timing(seconds),
        phase: timing(1.7 * seconds - 0.05),
        memory_mib: Some(41.25),
        file_bytes: None,
        errors: delta_e.map(errors),
        pareto: false,
    }
}

fn mark(points: &mut [Point], current: usize, pareto: &[usize]) {
    points[current].current = true;
    for i in pareto {
        points[*i].pareto = true;
    }
}

fn spectra() -> Sweep {
    let mut points = vec![
        point("rgb", "rgb", 0.0812, Some(24.1)),
        point("lines, 50 nm", "lines", 0.134, Some(9.3)),
        point("lines, 20 nm", "lines", 0.197, Some(3.15)),
        point("lines, 10 nm", "lines", 0.334, Some(0.871)),
        point("lines, 5 nm", "lines", 0.612, Some(0.243)),
        point("lines, 2 nm", "lines", 1.48, Some(0.0534)),
        point("grid, 8", "grid", 0.0854, Some(6.12)),
        point("grid, 16", "grid", 0.0881, Some(1.72)),
        point("grid, 42", "grid", 0.0985, Some(0.312)),
        point("grid, 84", "grid", 0.112, Some(0.0412)),
        point("grid, 168", "grid", 0.147, Some(0.00371)),
        point("spline, 84", "spline", 0.574, Some(0.0389)),
        point("spline, 336", "spline", 2.13, Some(0.00188)),
        point("exact", "exact", 9.87, None),
    ];
    points[9].errors.as_mut().expect("has errors").bound = Some(2.4e-4);
    mark(&mut points, 9, &[0, 6, 7, 8, 9, 10, 12, 13]);
    Sweep {
        knob: "accuracy.spectra".to_owned(),
        what: "how curves of emission and reflection are held while rendering".to_owned(),
        phase: "shade",
        reference: "exact spectra, authored curves summed by quadrature to 10⁻⁹".to_owned(),
        halving: vec![
            Halving {
                family: "lines".to_owned(),
                from: "lines, 50 nm".to_owned(),
                to: "lines, 20 nm".to_owned(),
                error_ratio: 2.95,
                time_ratio: 1.47,
                per_halving: Some(1.28),
            },
            Halving {
                family: "grid".to_owned(),
                from: "grid, 84".to_owned(),
                to: "grid, 168".to_owned(),
                error_ratio: 0.97,
                time_ratio: 1.05,
                per_halving: None,
            },
        ],
        points,
        note: None,
    }
}

/// Errors without color, of displacement, zero and none at all.
fn tessellation() -> Sweep {
    let geometry = |setting: &str, seconds, radiance, displacement| Point {
        toml: Some(format!("triangles = \"{setting}\"")),
        errors: Some(Errors {
            radiance,
            displacement: Some(Percentiles {
                mean: displacement * 0.2,
                p99: displacement,
                worst: displacement * 8.0,
            }),
            mistaken: Some(2.3e-5),
            ..Errors::default()
        }),
        ..point(setting, setting, seconds, None)
    };
    let mut points = vec![
        geometry("coarse", 0.1091, 0.0, 3.2e-5),
        geometry("fine", 0.1124, 0.0, 0.0),
        point("fine, meshes twice as fine", "fine", 0.1503, None),
    ];
    points[2].memory_mib = None;
    points[2].toml = None;
    mark(&mut points, 1, &[0, 1]);
    for point in &mut points {
        point.phase = point.frame;
    }
    Sweep {
        knob: "tessellation".to_owned(),
        what: "the triangles of spheres".to_owned(),
        phase: "traverse",
        reference: "fine & meshes of <twice> the fineness".to_owned(),
        points,
        note: Some("The image has but one worldline".to_owned()),
        halving: Vec::new(),
    }
}

/// Numbers that no measurement should give.
fn broken() -> Sweep {
    let wrong = |setting: &str, seconds, value| Point {
        errors: Some(Errors {
            radiance: value,
            ..Errors::default()
        }),
        file_bytes: Some(123_456),
        ..point(setting, "a, <b> & \"c\"", seconds, None)
    };
    let mut points = vec![
        wrong("infinite", 0.1, f64::INFINITY),
        wrong("no \"number\" & <so on>", 0.2, f64::NAN),
        wrong("negative", 0.3, f64::NEG_INFINITY),
        wrong("tiny", 0.4, 5e-324),
        wrong("greatest", 0.5, f64::MAX),
        wrong("no time", f64::NAN, 0.5),
        wrong("forever", f64::INFINITY, 0.5),
        wrong("at once", 0.0, 0.5),
    ];
    points[5].current = true;
    Sweep {
        knob: "image.samples".to_owned(),
        what: "rays for each pixel, evenly spread".to_owned(),
        phase: "no <such> phase",
        reference: "nothing".to_owned(),
        points,
        note: None,
        halving: vec![Halving {
            family: "f".to_owned(),
            from: "infinite".to_owned(),
            to: "tiny".to_owned(),
            error_ratio: 0.0,
            time_ratio: f64::NAN,
            per_halving: Some(f64::INFINITY),
        }],
    }
}

fn nothing_to_sweep() -> Sweep {
    Sweep {
        knob: "accuracy.cutoff".to_owned(),
        what: "the share of mirrored light that is not followed".to_owned(),
        phase: "traverse",
        reference: "all mirrors".to_owned(),
        points: Vec::new(),
        note: Some("no surface mirrors or refracts light".to_owned()),
        halving: Vec::new(),
    }
}

fn effects() -> Vec<EffectCost> {
    let effect = |effect, called, why: &str, off: f64, cost, spread, paper| EffectCost {
        effect,
        called,
        why: why.to_owned(),
        on: timing(off * (1.0 + cost)),
        off: timing(off),
        cost,
        spread,
        paper,
    };
    let moves = "worldline \"ball\" moves at 0.6 c relative to the camera";
    vec![
        effect(
            "geometry",
            true,
            moves,
            0.1014,
            0.0213,
            0.004,
            Some("under 5 %"),
        ),
        effect(
            "doppler",
            true,
            moves,
            0.0871,
            0.2866,
            0.012,
            Some("10 to 50 %"),
        ),
        effect("beaming", true, moves, 0.1117, 0.0031, 0.0042, None),
        effect(
            "thermal",
            false,
            "nothing is above 0 K",
            0.1121,
            -0.0012,
            0.0035,
            Some("under 1 %"),
        ),
        effect(
            "mirror",
            false,
            "no surface mirrors",
            0.1120,
            0.019,
            0.0031,
            None,
        ),
    ]
}

fn phases() -> Vec<PhaseTime> {
    let phase = |phase, seconds, what| PhaseTime {
        phase,
        seconds,
        share: seconds / 0.2005,
        what,
    };
    vec![
        phase(
            "prepare",
            0.0031,
            "reads meshes, bakes spectra, builds trees",
        ),
        phase("aim", 0.0044, "camera rays as events and null four-vectors"),
        phase(
            "boost",
            0.0062,
            "rays into the rest frame of each worldline",
        ),
        phase("traverse", 0.0613, "nearest hits in the trees of triangles"),
        phase("shadow", 0.0251, "rays to lamps"),
        phase(
            "shade",
            0.0874,
            "Doppler-shifted spectra to sensor's channels",
        ),
        phase("develop", 0.0112, "exposure, tone, colors of the screen"),
        phase("write", 0.0018, "files to the disk"),
    ]
}

fn recommendations() -> Vec<Recommendation> {
    let advice = |knob: &str, delta_e, found: Option<(&str, &str, f64)>| Recommendation {
        knob: knob.to_owned(),
        delta_e,
        setting: found.map(|(setting, ..)| setting.to_owned()),
        toml: found.map(|(_, toml, _)| toml.to_owned()),
        time_ratio: found.map(|(.., ratio)| ratio),
    };
    let grid = "spectra = \"grid\"\nwavelengths = ";
    let coarse = format!("{grid}42");
    let fine = format!("{grid}84");
    vec![
        advice("accuracy.spectra", 0.5, Some(("grid, 42", &coarse, 0.879))),
        advice("accuracy.spectra", 0.1, Some(("grid, 84", &fine, 1.0))),
        advice("image.samples", 0.5, Some(("4", "samples = 4", 0.27))),
        advice("image.samples", 0.1, None),
    ]
}

/// The whole of it.
pub(crate) fn study() -> Study {
    Study {
        schema_version: 1,
        shot: "ball".to_owned(),
        title: Some(AWKWARD.to_owned()),
        frame: 12,
        size: [480, 270],
        samples: 16,
        machine: Machine {
            processor: Some("Example CPU @ 2.40GHz".to_owned()),
            threads: 2,
            version: "0.1.0",
            repeats: 5,
        },
        noise: Noise {
            spread: 0.0213,
            duplicate: 1.004,
            too_noisy: false,
        },
        phases: phases(),
        sweeps: vec![spectra(), tessellation(), broken(), nothing_to_sweep()],
        effects: effects(),
        paper: vec![
            PaperRow {
                what: "shifted spectra over unshifted ones".to_owned(),
                paper: "10 to 50 %".to_owned(),
                ours: Some(0.2866),
                how: "effect \"doppler\" on and off".to_owned(),
            },
            PaperRow {
                what: "thermal light".to_owned(),
                paper: "under 1 %".to_owned(),
                ours: None,
                how: "nothing in this shot is above 0 K".to_owned(),
            },
        ],
        recommendations: recommendations(),
    }
}

/// The same on a machine that had other things to do, without what is optional.
pub(crate) fn noisy() -> Study {
    let mut study = study();
    study.title = None;
    study.machine.processor = None;
    study.machine.repeats = 1;
    study.noise = Noise {
        spread: 0.31,
        duplicate: f64::NAN,
        too_noisy: true,
    };
    study.sweeps.truncate(1);
    study.effects.clear();
    study.paper.clear();
    study
}
