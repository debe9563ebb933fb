//! The report as a page and as JSON.

use super::{advice, costs, head, sweep};
use crate::study::results::{Errors, Percentiles, Study, Timing};
use maud::DOCTYPE;
use maud::html as markup;

/// The page as a whole HTML file.
pub fn html(study: &Study) -> String {
    let page = markup! {
        (DOCTYPE)
        html lang="en" {
            (head::head(study))
            body {
                main {
                    (head::opening(study))
                    (advice::section(study))
                    (costs::phases(study))
                    @for (i, sweep) in study.sweeps.iter().enumerate() {
                        (sweep::section(study, sweep, i + 1))
                    }
                    (costs::effects(study))
                    (costs::paper(study))
                    (head::legend())
                }
            }
        }
    };
    page.into_string()
}

/// All results as JSON, with the names of [`Study`]'s fields. Numbers that are not finite are
/// written as the greatest f64, since JSON has no word for them; `null` means only that there is no
/// value.
pub fn json(study: &Study) -> String {
    let study = finite(study);
    let mut text =
        serde_json::to_string_pretty(&study).expect("a study has no maps, and nothing to fail");
    text.push('\n');
    text
}

/// The study with [`f64::MAX`] in place of infinity and NaN, and its negative in place of
/// −infinity: an error that cannot be determined counts as the worst.
pub(super) fn finite(study: &Study) -> Study {
    let mut study = study.clone();
    let Study {
        noise,
        phases,
        sweeps,
        effects,
        paper,
        recommendations,
        ..
    } = &mut study;
    settle([&mut noise.spread, &mut noise.duplicate]);
    for phase in phases {
        settle([&mut phase.seconds, &mut phase.share]);
    }
    for sweep in sweeps {
        for point in &mut sweep.points {
            settle_timing(&mut point.frame);
            settle_timing(&mut point.phase);
            settle(&mut point.memory_mib);
            if let Some(errors) = &mut point.errors {
                settle_errors(errors);
            }
        }
        for step in &mut sweep.halving {
            settle([&mut step.error_ratio, &mut step.time_ratio]);
            settle(&mut step.per_halving);
        }
    }
    for effect in effects {
        settle_timing(&mut effect.on);
        settle_timing(&mut effect.off);
        settle([&mut effect.cost, &mut effect.spread]);
    }
    settle(paper.iter_mut().filter_map(|row| row.ours.as_mut()));
    for advice in recommendations {
        settle([&mut advice.delta_e]);
        settle(&mut advice.time_ratio);
    }
    study
}

fn settle_timing(timing: &mut Timing) {
    settle([&mut timing.median, &mut timing.least, &mut timing.greatest]);
}

fn settle_errors(errors: &mut Errors) {
    settle([&mut errors.radiance]);
    settle(&mut errors.mistaken);
    settle(&mut errors.bound);
    let percentiles = [&mut errors.delta_e, &mut errors.displacement];
    for Percentiles { mean, p99, worst } in percentiles.into_iter().flatten() {
        settle([mean, p99, worst]);
    }
}

fn settle<'a>(values: impl IntoIterator<Item = &'a mut f64>) {
    for value in values {
        *value = if value.is_nan() {
            f64::MAX
        } else {
            value.clamp(-f64::MAX, f64::MAX)
        };
    }
}
