//! A compact plot for an inset in an image: one panel, with as much around its curves as is legible
//! at that size.
//!
//! No text is smaller than [`LEAST_TYPE`]. As an inset gets lower, it first loses its legend and
//! the names of the axes, then its caption, and last its ticks. Units stay as long as ticks do.

use super::drawing::{Anchor, Drawing, Group, Mark, Shape, Text};
use super::legend::legend;
use super::marks::{CHARACTER, PAPER, Page, Rect, label};
use super::panel::{PanelLayout, longest};
use super::{Panel, Plot};

/// Height below which not even bare curves are legible, pixels.
pub const LEAST_INSET: f64 = 60.0;
/// Size of the smallest text, pixels.
const LEAST_TYPE: f64 = 9.5;
/// Height of an inset in lines of text, if the text is not the smallest.
const LINES: f64 = 23.0;
/// Smallest height, in lines of text, for all parts of an inset; for a caption; for ticks.
const WITH: [f64; 3] = [19.0, 13.5, 9.0];
/// Opacity of the margins over the image.
const OPACITY: f64 = 0.88;

/// Lays out the first panel of a plot, and the first line of its caption, on a page of `size`
/// pixels.
pub fn lay_out_inset(plot: &Plot, size: [f64; 2]) -> Drawing {
    let font = (size[1] / LINES).max(LEAST_TYPE);
    let [all, caption, ticks] = WITH.map(|lines| size[1] >= lines * font);
    let title = plot.caption.first().cloned().unwrap_or_default();
    let mut groups = Vec::new();
    let mut base = 0.1 * font;
    if caption {
        base += 1.35 * font;
        let bold = Text {
            bold: true,
            ..Text::new([0.7 * font, base], font, &title)
        };
        groups.push(group(
            "caption",
            vec![label("caption", Anchor::Start, bold)],
        ));
    }
    if all {
        base += 1.55 * font;
        let (legend, end) = legend(plot, [0.7 * font, base], Page { size, font });
        groups.push(legend);
        base = end;
    }
    if let Some(panel) = plot.panels.first() {
        let marks = match (all, ticks) {
            (true, _) => with_names(panel, size, base, font),
            (false, true) => with_units(panel, size, base, font),
            (false, false) => bare(panel, size, font),
        };
        groups.push(group("panel-1", marks));
    }
    Drawing {
        size,
        paper: PAPER,
        opacity: OPACITY,
        title,
        groups,
    }
}

fn group(id: &str, marks: Vec<Mark>) -> Group {
    let id = id.to_owned();
    Group { id, marks }
}

/// The panel with the names of its axes, both horizontal, above the one and below the other: an
/// inset is too low for a name that runs upward.
fn with_names(panel: &Panel, size: [f64; 2], base: f64, font: f64) -> Vec<Mark> {
    let base = base + 1.5 * font;
    let layout = laid_out(panel, size, base, 3.15, font);
    let mut marks = behind(&layout);
    let name = Text::new([0.7 * font, base], font, &panel.y.title());
    marks.push(label("y-label", Anchor::Start, name));
    let below = [
        layout.area.corner[0] + layout.area.size[0] / 2.0,
        size[1] - 0.5 * font,
    ];
    let name = Text::new(below, font, &panel.x.title());
    marks.push(label("x-label", Anchor::Middle, name));
    marks
}

/// The panel with the unit of the horizontal axis at its end, in place of the labels there.
fn with_units(panel: &Panel, size: [f64; 2], base: f64, font: f64) -> Vec<Mark> {
    let base = base + 1.35 * font;
    let mut layout = laid_out(panel, size, base, 1.65, font);
    let [width, _] = layout.area.size;
    let unit = panel.x.measure();
    let taken = (unit.chars().count() as f64 + 2.5) * CHARACTER * font / width;
    for tick in &mut layout.x_ticks {
        if tick.place > 1.0 - taken {
            tick.label = None;
        }
    }
    let mut marks = behind(&layout);
    let name = Text::new([0.5 * font, base], font, &panel.y.measure());
    marks.push(label("y-label", Anchor::Start, name));
    let end = [layout.area.corner[0] + width, size[1] - 0.4 * font];
    marks.push(label("x-label", Anchor::End, Text::new(end, font, &unit)));
    marks
}

fn bare(panel: &Panel, size: [f64; 2], font: f64) -> Vec<Mark> {
    let margin = 0.5 * font;
    let layout = PanelLayout {
        panel,
        font,
        area: Rect {
            corner: [margin; 2],
            size: size.map(|side| (side - 2.0 * margin).max(1.0)),
        },
        x_ticks: Vec::new(),
        y_ticks: Vec::new(),
    };
    let mut marks = vec![ground(&layout)];
    marks.extend(layout.bare());
    marks
}

/// A panel below the line `base`, with `below` lines of text under it.
fn laid_out(panel: &Panel, size: [f64; 2], base: f64, below: f64, font: f64) -> PanelLayout<'_> {
    let top = base + 0.85 * font;
    let height = (size[1] - top - below * font).max(1.0);
    let y_ticks = panel.y.ticks((height / (2.0 * font)) as usize);
    // The same for nearly all labels, so that axes do not jump from frame to frame.
    let left = (1.0 + longest(&y_ticks).max(4.0) * CHARACTER) * font;
    let width = (size[0] - left - 1.6 * font).max(1.0);
    PanelLayout {
        panel,
        font,
        area: Rect {
            corner: [left, top],
            size: [width, height],
        },
        x_ticks: panel.x.ticks((width / (3.4 * font)) as usize),
        y_ticks,
    }
}

/// The curves between labelled ticks.
fn behind(layout: &PanelLayout<'_>) -> Vec<Mark> {
    let mut marks = vec![ground(layout)];
    marks.extend(layout.bare());
    marks.extend(layout.values());
    marks
}

/// The opaque background between the axes, so that the image does not show through the curves.
fn ground(layout: &PanelLayout<'_>) -> Mark {
    let Rect { corner, size } = layout.area;
    Mark::new("ground", PAPER, Shape::Rect { corner, size })
}

#[cfg(test)]
mod tests {
    use super::super::{Axis, Scale, Series, Stroke};
    use super::*;

    fn plot(top: f64) -> Plot {
        let series = ["surface", "thermal", "sum"].map(|name| Series {
            name: name.to_owned(),
            color: [0; 3],
            stroke: Stroke::Solid(2.0),
            points: vec![[50.0, 0.0], [500.0, top], [5000.0, 0.0]],
            remarks: Vec::new(),
        });
        Plot {
            caption: vec!["D = 1.3402e-12, T = 10000 K".to_owned()],
            panels: vec![Panel {
                title: String::new(),
                x: Axis::new("wavelength", "nm", Scale::Log, [50.0, 5000.0]),
                y: Axis::in_steps("spectral radiance", "W·m⁻²·sr⁻¹·nm⁻¹", top),
                tints: Vec::new(),
                series: series.to_vec(),
                note: None,
            }],
        }
    }

    /// Texts of a drawing, each with the first and the last point of its middle line.
    fn texts(drawing: &Drawing) -> Vec<(&str, &Text, [f64; 2])> {
        // Letters of DejaVu Sans are some 0.6 of its size wide, and what is raised 0.42.
        let width = |character: char| match character {
            '·' | '¹' | '²' | '³' | '⁰'..='⁻' => 0.42,
            _ => 0.6,
        };
        let marks = drawing.groups.iter().flat_map(|group| &group.marks);
        marks
            .filter_map(|mark| match &mark.shape {
                Shape::Text(text) => Some((mark.class.as_str(), text)),
                _ => None,
            })
            .map(|(class, text)| {
                let length = text.words.chars().map(width).sum::<f64>() * text.size;
                let begin = match text.anchor {
                    Anchor::Start => text.at[0],
                    Anchor::Middle => text.at[0] - length / 2.0,
                    Anchor::End => text.at[0] - length,
                };
                (class, text, [begin, begin + length])
            })
            .collect()
    }

    #[test]
    fn type_is_legible_and_inside_and_clear_of_other_type_at_any_size() {
        for height in (60..=1200).step_by(7).map(f64::from) {
            for top in [1.0, 50.0, 2e-3, 5e-12, 2e9] {
                let size = [(height * 4.0 / 3.0).floor(), height];
                let plot = plot(top);
                let drawing = lay_out_inset(&plot, size);
                let texts = texts(&drawing);
                for (i, (_, text, [begin, end])) in texts.iter().enumerate() {
                    let [_, base] = text.at;
                    assert!(text.size >= LEAST_TYPE, "{height}");
                    let fits = *begin >= 0.0 && *end <= size[0];
                    assert!(
                        fits && base > text.size * 0.7 && base < size[1],
                        "{height}: {}",
                        text.words
                    );
                    for (_, other, [from, to]) in &texts[..i] {
                        // A line of figures and letters is 0.73 of the type's size high.
                        let apart = (other.at[1] - base).abs() >= 0.73 * text.size;
                        assert!(
                            apart || end < from || to < begin,
                            "{height}, {top}: {} on {}",
                            text.words,
                            other.words
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn small_insets_lose_names_then_the_caption_then_ticks() {
        let has = |height: f64| {
            let plot = plot(1.0);
            let drawing = lay_out_inset(&plot, [height * 4.0 / 3.0, height]);
            let texts = texts(&drawing);
            ["legend", "caption", "x-value"]
                .map(|class| texts.iter().any(|(of, _, _)| *of == class))
        };
        assert_eq!(has(288.0), [true, true, true]);
        assert_eq!(has(144.0), [false, true, true]);
        assert_eq!(has(108.0), [false, false, true]);
        assert_eq!(has(72.0), [false, false, false]);
    }

    #[test]
    fn the_font_has_every_character_that_a_plot_can_print() {
        let mut words = String::new();
        for exponent in -300..=308 {
            for digit in [1.0, 2.0, 5.0] {
                let value = digit * 10f64.powi(exponent);
                let linear = Axis::in_steps("spectral radiance", "W·m⁻²·sr⁻¹·nm⁻¹", value);
                let log = Axis::around("D", "µm", [value / 7.0, value]);
                for axis in [linear, log] {
                    words += &axis.title();
                    let ticks = axis.ticks(6).into_iter();
                    words.extend(ticks.filter_map(|tick| tick.label));
                }
            }
        }
        words += &Axis::new("", "", Scale::Linear, [-3.0, 3.0])
            .ticks(6)
            .into_iter()
            .filter_map(|tick| tick.label)
            .collect::<String>();
        // What captions and legends say beside.
        words += "…βγλ°×±–—≤≥ΔT→²³ background, frame no light surface thermal sum";
        let mut letters: Vec<char> = words.chars().collect();
        letters.sort_unstable();
        letters.dedup();
        assert!(letters.len() > 40);
        let letters: String = letters.into_iter().collect();
        let missing = crate::plot::raster::missing(&letters);
        assert!(missing.is_empty(), "{missing:?}");
    }
}
