//! Polylines: the parts of a curve that are on the axis, with as few points as they need.

use super::Axis;

/// The parts of a curve that its axis shows, each with the points just beyond its ends.
pub(super) fn visible_runs<'a>(points: &'a [[f64; 2]], y: &Axis) -> Vec<&'a [[f64; 2]]> {
    let mut runs = Vec::new();
    let mut at = 0;
    while at < points.len() {
        let shown = points[at..].iter().take_while(|p| !y.hides(p[1])).count();
        if shown > 0 {
            let end = (at + shown + 1).min(points.len());
            runs.push(&points[at.saturating_sub(1)..end]);
        }
        at += shown.max(1);
    }
    runs
}

/// Removes points that are no more than `tolerance` away from the line without them (Douglas &
/// Peucker 1973).
pub(super) fn simplified(points: &[[f64; 2]], tolerance: f64) -> Vec<[f64; 2]> {
    let Some(last) = points.len().checked_sub(1) else {
        return Vec::new();
    };
    let mut kept = vec![false; points.len()];
    kept[0] = true;
    kept[last] = true;
    let mut parts = vec![[0, last]];
    while let Some([from, to]) = parts.pop() {
        let away = |i: &usize| distance(points[*i], points[from], points[to]);
        let farthest = (from + 1..to).max_by(|a, b| away(a).total_cmp(&away(b)));
        if let Some(farthest) = farthest.filter(|i| away(i) > tolerance) {
            kept[farthest] = true;
            parts.extend([[from, farthest], [farthest, to]]);
        }
    }
    let pairs = points.iter().zip(kept);
    pairs.filter(|(_, kept)| *kept).map(|(p, _)| *p).collect()
}

/// Distance of a point from the straight line through two others, or from them if they coincide.
fn distance(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let [along, off] = [[b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]];
    let length = along[0].hypot(along[1]);
    if length > 0.0 {
        (along[0] * off[1] - along[1] * off[0]).abs() / length
    } else {
        off[0].hypot(off[1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_is_cut_where_it_sinks_below_a_logarithmic_axis() {
        let y = Axis::decades("", "", [1e-3, 1.0]);
        let points = [0.0, 0.5, 0.2, 1e-9, 0.0, 0.0, 1.0, 0.0]
            .iter()
            .enumerate()
            .map(|(i, y)| [i as f64, *y])
            .collect::<Vec<_>>();
        assert_eq!(visible_runs(&points, &y), [&points[0..4], &points[5..8]]);
        assert!(visible_runs(&[[0.0, 0.0], [1.0, 0.0]], &y).is_empty());
        let linear = Axis::from_zero("", "", 1.0);
        assert_eq!(visible_runs(&points, &linear), [&points[..]]);
    }

    #[test]
    fn what_is_left_of_a_line_is_within_the_tolerance_of_all_its_points() {
        let wave: Vec<[f64; 2]> = (0..3000)
            .map(|i| f64::from(i) / 10.0)
            .map(|x| [x, 100.0 * (x / 30.0).sin()])
            .collect();
        let fewer = simplified(&wave, 0.05);
        assert!(fewer.len() < 300, "{}", fewer.len());
        for point in wave {
            let nearest = fewer
                .windows(2)
                .filter(|pair| (pair[0][0]..=pair[1][0]).contains(&point[0]))
                .map(|pair| distance(point, pair[0], pair[1]))
                .fold(f64::INFINITY, f64::min);
            assert!(nearest <= 0.05, "{point:?}: {nearest}");
        }
        assert_eq!(simplified(&[], 1.0), [[0.0; 2]; 0]);
        assert_eq!(simplified(&[[1.0, 2.0]], 1.0), [[1.0, 2.0]]);
    }
}
