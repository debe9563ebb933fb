//! A drawing as SVG 1.1 text.

use super::Color;
use super::drawing::{Anchor, Drawing, Mark, Shape, Text};

/// Writes a drawing as a standalone SVG file. Equal drawings give equal bytes.
pub fn svg(drawing: &Drawing) -> String {
    let [width, height] = drawing.size.map(number);
    let opacity = if drawing.opacity < 1.0 {
        format!(" fill-opacity=\"{}\"", number(drawing.opacity))
    } else {
        String::new()
    };
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\" font-family=\"Helvetica, Arial, 'Liberation Sans', \
         'DejaVu Sans', sans-serif\">\n<title>{}</title>\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"{}\"{opacity}/>\n",
        escaped(&drawing.title),
        hex(drawing.paper),
    );
    for group in &drawing.groups {
        text += &format!("<g id=\"{}\">\n", escaped(&group.id));
        for mark in &group.marks {
            text += &match &mark.tip {
                Some(tip) => format!("<g><title>{}</title>{}</g>\n", escaped(tip), element(mark)),
                None => element(mark) + "\n",
            };
        }
        text += "</g>\n";
    }
    text += "</svg>\n";
    text
}

fn element(mark: &Mark) -> String {
    let class = escaped(&mark.class);
    let color = hex(mark.color);
    match &mark.shape {
        Shape::Rect { corner, size } => format!(
            "<rect class=\"{class}\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{color}\"/>",
            number(corner[0]),
            number(corner[1]),
            number(size[0]),
            number(size[1]),
        ),
        Shape::Line {
            points,
            width,
            dash,
        } => {
            let points: Vec<String> = points
                .iter()
                .map(|[x, y]| format!("{},{}", number(*x), number(*y)))
                .collect();
            let dash = dash.map_or(String::new(), |dash| {
                format!(" stroke-dasharray=\"{}\"", number(dash))
            });
            format!(
                "<polyline class=\"{class}\" points=\"{}\" fill=\"none\" stroke=\"{color}\" \
                 stroke-width=\"{}\" stroke-linejoin=\"round\"{dash}/>",
                points.join(" "),
                number(*width),
            )
        }
        Shape::Dot { center, radius } => format!(
            "<circle class=\"{class}\" cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{color}\"/>",
            number(center[0]),
            number(center[1]),
            number(*radius),
        ),
        Shape::Ring {
            center,
            radius,
            width,
        } => format!(
            "<circle class=\"{class}\" cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"none\" \
             stroke=\"{color}\" stroke-width=\"{}\"/>",
            number(center[0]),
            number(center[1]),
            number(*radius),
            number(*width),
        ),
        Shape::Text(text) => text_element(&class, &color, text),
    }
}

fn text_element(class: &str, color: &str, text: &Text) -> String {
    let anchor = match text.anchor {
        Anchor::Start => "start",
        Anchor::Middle => "middle",
        Anchor::End => "end",
    };
    let [x, y] = text.at.map(number);
    let turn = if text.upwards {
        format!(" transform=\"rotate(-90 {x} {y})\"")
    } else {
        String::new()
    };
    let weight = if text.bold {
        " font-weight=\"bold\""
    } else {
        ""
    };
    format!(
        "<text class=\"{class}\" x=\"{x}\" y=\"{y}\" font-size=\"{}\" \
         text-anchor=\"{anchor}\" fill=\"{color}\"{weight}{turn}>{}</text>",
        number(text.size),
        escaped(&text.words),
    )
}

/// A number to hundredths of a pixel; 0 if it is not finite.
fn number(value: f64) -> String {
    let text = format!("{:.2}", if value.is_finite() { value } else { 0.0 });
    match text.trim_end_matches('0').trim_end_matches('.') {
        "-0" => "0".to_owned(),
        short => short.to_owned(),
    }
}

fn hex([r, g, b]: Color) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// Text for XML 1.0: markup is escaped, control characters, which XML cannot hold, become U+FFFD.
pub fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\t' | '\n' | '\r' => out.push(' '),
            '\0'..='\x1f' | '\u{fffe}' | '\u{ffff}' => out.push('\u{fffd}'),
            _ => out.push(character),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_finite() {
        for (value, text) in [
            (12.0, "12"),
            (100.0, "100"),
            (0.125, "0.12"),
            (-0.001, "0"),
            (1.5, "1.5"),
            (f64::NAN, "0"),
            (f64::INFINITY, "0"),
        ] {
            assert_eq!(number(value), text);
        }
    }

    #[test]
    fn text_is_escaped_whatever_it_holds() {
        assert_eq!(
            escaped("a<b> & \"c\"\n\u{1}é"),
            "a&lt;b&gt; &amp; &quot;c&quot; \u{fffd}é"
        );
    }
}
