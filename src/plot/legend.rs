//! Caption and legend: the lines above the panels.

use super::drawing::{Anchor, Group, Mark, Shape, Text};
use super::marks::{CHARACTER, INK, Page, label, strokes};
use super::{Plot, Series, Stroke};

/// The caption, and the height at which it ends.
pub(super) fn caption(plot: &Plot, page: Page) -> (Group, f64) {
    let size = page.font * 1.1;
    // Bold text is a little wider.
    let most = ((page.size[0] - 2.0 * page.font) / (size * CHARACTER * 1.05)) as usize;
    let mut base = 0.4 * page.font;
    let mut marks = Vec::new();
    for (i, line) in plot.caption.iter().enumerate() {
        base += 1.45 * size;
        let at = [page.font, base];
        let text = Text {
            bold: i == 0,
            ..Text::new(at, size, &shortened(line, most))
        };
        marks.push(Mark::new("caption", INK, Shape::Text(text)));
    }
    let id = "caption".to_owned();
    (Group { id, marks }, base)
}

/// The line, shortened in the middle, since both ends may matter.
fn shortened(line: &str, most: usize) -> String {
    let characters: Vec<char> = line.chars().collect();
    if characters.len() <= most {
        return line.to_owned();
    }
    let tail = most / 2;
    let head = most.saturating_sub(tail + 1);
    let end = &characters[characters.len() - tail..];
    characters[..head].iter().chain(&['…']).chain(end).collect()
}

/// The legend, each name once, in rows of the page's width; and the height at which it ends.
pub(super) fn legend(plot: &Plot, start: [f64; 2], page: Page) -> (Group, f64) {
    let font = page.font;
    let mut named: Vec<&Series> = Vec::new();
    for series in plot.panels.iter().flat_map(|panel| &panel.series) {
        if named.iter().all(|known| known.name != series.name) {
            named.push(series);
        }
    }
    let sample = 2.2 * font;
    let mut marks = Vec::new();
    let [mut x, mut base] = start;
    for series in named {
        let length = sample + (0.5 + series.name.chars().count() as f64 * CHARACTER) * font;
        if x > start[0] && x + length > page.size[0] {
            x = start[0];
            base += 1.6 * font;
        }
        let y = base - 0.32 * font;
        let class = format!("sample {}", series.name);
        let ends = match series.stroke {
            Stroke::Dots(_) | Stroke::Rings(_) => vec![[x + sample / 2.0, y]],
            _ => vec![[x, y], [x + sample, y]],
        };
        marks.extend(strokes(&class, series, &ends, font));
        let at = [x + sample + 0.5 * font, base];
        marks.push(label(
            "legend",
            Anchor::Start,
            Text::new(at, font, &series.name),
        ));
        x += length + 1.7 * font;
    }
    let id = "legend".to_owned();
    (Group { id, marks }, base)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_caption_keeps_its_beginning_and_its_end() {
        assert_eq!(shortened("0123456789", 10), "0123456789");
        assert_eq!(shortened("0123456789", 7), "012…789");
        assert_eq!(shortened("0123456789", 2), "…9");
    }
}
