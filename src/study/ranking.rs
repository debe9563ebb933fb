//! Which settings are worth their time: the Pareto front, the price of half the error, and the
//! cheapest setting within a limit.

use super::results::{Halving, Point, Recommendation, Sweep};

/// Color differences (CIEDE2000; about 1 is just visible) for recommendations: one that nobody sees
/// side by side, and a stricter one for images that are processed further.
pub(super) const LIMITS: [f64; 2] = [0.5, 0.1];

/// Smallest ratio by which an error must fall to count as falling; the price of half of it would be
/// noise otherwise.
const FALLS: f64 = 1.1;

/// Marks the points for which no other point is at least as exact and faster by more than `noise`,
/// the relative scatter of equal work.
pub(super) fn mark_pareto(points: &mut [Point], noise: f64) {
    let placed: Vec<Option<[f64; 2]>> = points
        .iter()
        .map(|point| Some([point.frame.median, error(point)?]))
        .collect();
    for (point, own) in points.iter_mut().zip(&placed) {
        let Some([time, error]) = own else { continue };
        let told_apart = time * (1.0 - noise);
        let mut others = placed.iter().flatten();
        let beaten = others.any(|[t, e]| *t < told_apart && e <= error);
        point.pareto = !beaten;
    }
}

/// The error that a sweep is about: of color at the 99th percentile, or else of radiance.
pub(super) fn error(point: &Point) -> Option<f64> {
    let errors = point.errors.as_ref()?;
    Some(errors.delta_e.map_or(errors.radiance, |e| e.p99))
}

/// Cost and gain of each step to the next finer setting of a family.
pub(super) fn halvings(points: &[Point]) -> Vec<Halving> {
    let step = |pair: &[&Point]| {
        let (error_before, error_after) = (error(pair[0])?, error(pair[1])?);
        let time_ratio = pair[1].frame.median / pair[0].frame.median;
        let error_ratio = error_before / error_after;
        let falls = error_ratio > FALLS && error_ratio.is_finite();
        (error_before > 0.0 && error_after > 0.0).then(|| Halving {
            family: pair[0].family.clone(),
            from: pair[0].setting.clone(),
            to: pair[1].setting.clone(),
            error_ratio,
            time_ratio,
            per_halving: falls.then(|| time_ratio.powf(1.0 / error_ratio.log2())),
        })
    };
    let mut families: Vec<&str> = Vec::new();
    for point in points {
        if !families.contains(&point.family.as_str()) {
            families.push(&point.family);
        }
    }
    families
        .into_iter()
        .flat_map(|family| {
            let own: Vec<&Point> = points.iter().filter(|p| p.family == family).collect();
            own.windows(2).filter_map(step).collect::<Vec<_>>()
        })
        .collect()
}

/// The cheapest setting of a sweep whose colors stay within each of the [`LIMITS`]. Among settings
/// that `noise` does not tell apart, the shot's own, or else the most exact.
pub(super) fn recommendations(sweep: &Sweep, noise: f64) -> Vec<Recommendation> {
    let delta_e = |point: &Point| Some(point.errors?.delta_e?.p99);
    if !sweep.points.iter().any(|point| delta_e(point).is_some()) {
        return Vec::new();
    }
    let current = sweep.points.iter().find(|point| point.current);
    let recommend = |limit: f64| {
        let found = cheapest(sweep, limit, noise);
        Recommendation {
            knob: sweep.knob.clone(),
            delta_e: limit,
            setting: found.map(|point| point.setting.clone()),
            toml: found.and_then(|point| point.toml.clone()),
            time_ratio: found
                .zip(current)
                .map(|(point, current)| point.frame.median / current.frame.median),
        }
    };
    LIMITS.map(recommend).to_vec()
}

fn cheapest(sweep: &Sweep, limit: f64, noise: f64) -> Option<&Point> {
    let points = &sweep.points;
    // Filters make images of their own, each measured against itself.
    let own = points.iter().find(|point| point.current);
    let same_picture = |point: &&Point| {
        sweep.knob != "image.samples" || own.is_none_or(|own| own.family == point.family)
    };
    let within: Vec<(&Point, f64)> = points
        .iter()
        .filter(|point| point.toml.is_some() || point.current)
        .filter(same_picture)
        .filter_map(|point| Some((point, point.errors?.delta_e?.p99)))
        .filter(|(_, error)| *error < limit)
        .collect();
    let least = within
        .iter()
        .map(|(point, _)| point.frame.median)
        .fold(f64::INFINITY, f64::min);
    within
        .into_iter()
        .filter(|(point, _)| point.frame.median <= least * (1.0 + noise))
        .min_by(|(a, e), (b, f)| b.current.cmp(&a.current).then(e.total_cmp(f)))
        .map(|(point, _)| point)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::results::{Errors, Percentiles, Timing};

    fn point(setting: &str, seconds: f64, error: f64) -> Point {
        let delta_e = Percentiles {
            p99: error,
            ..Percentiles::default()
        };
        Point {
            setting: setting.to_owned(),
            family: "one".to_owned(),
            toml: Some(setting.to_owned()),
            current: setting == "current",
            frame: Timing {
                median: seconds,
                least: seconds,
                greatest: seconds,
            },
            phase: Timing::default(),
            memory_mib: None,
            file_bytes: None,
            errors: Some(Errors {
                delta_e: Some(delta_e),
                ..Errors::default()
            }),
            pareto: false,
        }
    }

    fn sweep(points: Vec<Point>) -> Sweep {
        Sweep {
            knob: "knob".to_owned(),
            what: String::new(),
            phase: "shade",
            reference: String::new(),
            points,
            note: None,
            halving: Vec::new(),
        }
    }

    #[test]
    fn the_front_is_what_nothing_else_beats_by_more_than_noise() {
        let mut points = vec![
            point("coarse", 1.0, 0.4),
            point("slow and coarse", 2.0, 0.4),
            point("fine", 1.5, 0.01),
            point("as fine within noise", 1.52, 0.01),
            point("finest", 9.0, 0.0),
        ];
        mark_pareto(&mut points, 0.05);
        let on_it: Vec<bool> = points.iter().map(|point| point.pareto).collect();
        assert_eq!(on_it, [true, false, true, true, true]);
    }

    #[test]
    fn a_quarter_of_the_error_for_twice_the_time_is_root_two_a_halving() {
        let steps = halvings(&[point("a", 1.0, 0.4), point("b", 2.0, 0.1)]);
        let [step] = steps.as_slice() else {
            panic!("{steps:?}")
        };
        assert!((step.error_ratio - 4.0).abs() < 1e-12);
        assert!((step.per_halving.unwrap() - 2f64.sqrt()).abs() < 1e-12);
        let worse = halvings(&[point("a", 1.0, 0.1), point("b", 2.0, 0.4)]);
        assert_eq!(worse[0].per_halving, None);
        assert_eq!(halvings(&[point("a", 1.0, 0.1), point("b", 2.0, 0.0)]), []);
    }

    #[test]
    fn the_cheapest_within_the_limit_is_recommended_and_the_shot_s_own_where_noise_hides_it() {
        let chosen = |points: Vec<Point>| {
            let found = recommendations(&sweep(points), 0.05);
            found.into_iter().map(|r| r.setting).collect::<Vec<_>>()
        };
        let fast = || point("fast", 1.0, 0.3);
        assert_eq!(
            chosen(vec![fast(), point("current", 1.3, 0.01)]),
            [Some("fast".to_owned()), Some("current".to_owned())]
        );
        assert_eq!(
            chosen(vec![fast(), point("current", 1.03, 0.2)]),
            [Some("current".to_owned()), None]
        );
        assert_eq!(
            chosen(vec![fast(), point("finer", 1.03, 0.2)]),
            [Some("finer".to_owned()), None]
        );
    }
}
