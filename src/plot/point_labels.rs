//! Labels beside dots, each placed where it covers no dot, no other label, and as little of the
//! lines as possible. If there is no room even for the short form, the label is left out; the
//! tooltip remains.

use super::Remark;
use super::drawing::{Anchor, Mark, Shape, Text};
use super::marks::{CHARACTER, Rect, label};

/// Font size of labels, relative to that of the axes.
const SIZE: f64 = 0.86;
/// Distances between the center of a dot and its label, in font sizes of the label.
const GAPS: [f64; 2] = [0.95, 1.4];
/// Directions from a dot to its label, the best first.
const SIDES: [[f64; 2]; 8] = [
    [1.0, 0.0],
    [1.0, -0.9],
    [1.0, 0.9],
    [-1.0, 0.0],
    [-1.0, -0.9],
    [-1.0, 0.9],
    [0.0, -1.0],
    [0.0, 1.0],
];

/// Labels of dots at places on the page, inside `area` and around the marks `drawn` there.
pub(super) fn place_labels(
    dots: &[([f64; 2], &Remark)],
    drawn: &[Mark],
    area: Rect,
    font: f64,
) -> Vec<Mark> {
    let mut taken: Vec<Extent> = drawn.iter().filter_map(round).collect();
    let lines: Vec<[f64; 2]> = drawn.iter().flat_map(|mark| along(mark, font)).collect();
    let inside = Extent {
        low: area.corner,
        high: [0, 1].map(|i| area.corner[i] + area.size[i]),
    };
    let mut marks = Vec::new();
    for (at, remark) in dots {
        let free = |words: &str| {
            let places = places(*at, words, font * SIZE);
            let free = places.into_iter().filter(|(_, extent)| {
                extent.is_within(&inside) && !taken.iter().any(|other| extent.overlaps(other))
            });
            let covered = |extent: &Extent| lines.iter().filter(|p| extent.holds(p)).count();
            free.min_by_key(|(_, extent)| covered(extent))
        };
        let words = [&remark.label, &remark.short];
        let found = words
            .into_iter()
            .find_map(|words| Some((words, free(words)?)));
        if let Some((words, ((base, anchor), extent))) = found {
            let text = Text::new(base, font * SIZE, words);
            marks.push(label("remark", anchor, text));
            taken.push(extent);
        }
    }
    marks
}

/// A rectangle on the page.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Extent {
    low: [f64; 2],
    high: [f64; 2],
}

impl Extent {
    fn is_within(&self, other: &Self) -> bool {
        (0..2).all(|i| self.low[i] >= other.low[i] && self.high[i] <= other.high[i])
    }

    fn overlaps(&self, other: &Self) -> bool {
        (0..2).all(|i| self.low[i] < other.high[i] && other.low[i] < self.high[i])
    }

    fn holds(&self, point: &[f64; 2]) -> bool {
        (0..2).all(|i| (self.low[i]..=self.high[i]).contains(&point[i]))
    }
}

/// The extent of a dot or a ring.
fn round(mark: &Mark) -> Option<Extent> {
    match mark.shape {
        Shape::Dot { center, radius } | Shape::Ring { center, radius, .. } => Some(Extent {
            low: center.map(|v| v - radius),
            high: center.map(|v| v + radius),
        }),
        _ => None,
    }
}

/// Points along a line, so close that no label fits between them.
fn along(mark: &Mark, font: f64) -> Vec<[f64; 2]> {
    let Shape::Line { points, .. } = &mark.shape else {
        return Vec::new();
    };
    let pairs = points.windows(2);
    pairs
        .flat_map(|pair| {
            let [from, to] = [pair[0], pair[1]];
            let length = (to[0] - from[0]).hypot(to[1] - from[1]);
            let count = (length / (0.3 * font)).ceil().max(1.0) as u32;
            (0..=count).map(move |i| {
                let part = f64::from(i) / f64::from(count);
                [0, 1].map(|axis| from[axis] + part * (to[axis] - from[axis]))
            })
        })
        .collect()
}

/// Possible places of a text beside a dot, with their extents.
fn places(at: [f64; 2], words: &str, size: f64) -> Vec<(([f64; 2], Anchor), Extent)> {
    let length = words.chars().count() as f64 * CHARACTER * size;
    let place = |gap: f64, [right, below]: [f64; 2]| {
        let middle = [at[0] + right * gap * size, at[1] + below * gap * size];
        let (anchor, before) = match right {
            right if right > 0.0 => (Anchor::Start, 0.0),
            right if right < 0.0 => (Anchor::End, length),
            _ => (Anchor::Middle, length / 2.0),
        };
        let low = [middle[0] - before, middle[1] - 0.5 * size];
        let extent = Extent {
            low,
            high: [low[0] + length, low[1] + size],
        };
        (([middle[0], middle[1] + 0.35 * size], anchor), extent)
    };
    GAPS.iter()
        .flat_map(|gap| SIDES.map(|side| place(*gap, side)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn remark(label: &str, short: &str) -> Remark {
        Remark {
            label: label.to_owned(),
            short: short.to_owned(),
            tip: String::new(),
        }
    }

    fn said(dots: &[[f64; 2]], remark: &Remark, size: [f64; 2]) -> Vec<String> {
        let dot = |center: &[f64; 2]| {
            let (center, radius) = (*center, 4.0);
            Mark::new("curve", [0; 3], Shape::Dot { center, radius })
        };
        let drawn: Vec<Mark> = dots.iter().map(dot).collect();
        let dots: Vec<_> = dots.iter().map(|at| (*at, remark)).collect();
        let corner = [0.0, 0.0];
        let marks = place_labels(&dots, &drawn, Rect { corner, size }, 14.0);
        let words = marks.into_iter().map(|mark| match mark.shape {
            Shape::Text(text) => text.words,
            other => format!("{other:?}"),
        });
        words.collect()
    }

    #[test]
    fn labels_are_long_where_there_is_room_short_where_less_and_none_where_none() {
        let remark = remark("lines, 5 nm", "7");
        assert_eq!(
            said(&[[150.0, 50.0]], &remark, [300.0, 100.0]),
            ["lines, 5 nm"]
        );
        assert_eq!(said(&[[30.0, 50.0]], &remark, [60.0, 100.0]), ["7"]);
        assert!(said(&[[5.0, 5.0]], &remark, [10.0, 10.0]).is_empty());
    }

    #[test]
    fn labels_of_crowded_dots_do_not_cover_each_other() {
        let dots: Vec<_> = (0..12)
            .map(|i| [100.0 + 9.0 * f64::from(i), 100.0])
            .collect();
        let remark = remark("grid, 84", "5");
        let marks: Vec<Extent> = {
            let dots: Vec<_> = dots.iter().map(|at| (*at, &remark)).collect();
            let area = Rect {
                corner: [0.0, 0.0],
                size: [400.0, 200.0],
            };
            let texts = place_labels(&dots, &[], area, 14.0);
            let extent = |mark: Mark| match mark.shape {
                Shape::Text(text) => {
                    let length = text.words.chars().count() as f64 * CHARACTER * text.size;
                    let before = match text.anchor {
                        Anchor::Start => 0.0,
                        Anchor::Middle => length / 2.0,
                        Anchor::End => length,
                    };
                    let low = [text.at[0] - before, text.at[1] - 0.84 * text.size];
                    Some(Extent {
                        low,
                        high: [low[0] + length, low[1] + 0.98 * text.size],
                    })
                }
                _ => None,
            };
            texts.into_iter().filter_map(extent).collect()
        };
        assert!(marks.len() >= 6, "{}", marks.len());
        for (i, a) in marks.iter().enumerate() {
            assert!(marks[i + 1..].iter().all(|b| !a.overlaps(b)), "{i}");
        }
    }
}
