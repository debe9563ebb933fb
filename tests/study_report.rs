//! The report of a study: the page, the table and the JSON hold what was found, whatever it is.
//!
//! To look at the pages: `cargo test --test suite study_report::`, then open study/study.html and
//! noisy/study.html in target/tmp/study-report.

mod fixture;

use fixture::{AWKWARD, noisy, study};
use restframe::study::Study;
use restframe::study::report::{csv, html, json};
use restframe::study::results::Sweep;
use roxmltree::{Document, Node, ParsingOptions};
use serde_json::Value;
use std::fs;
use std::path::Path;

const SVG: &str = "http://www.w3.org/2000/svg";

/// A page as its readers see it. Reading it as XML fails the test where a tag is not closed or a
/// text not escaped.
fn read(page: &str) -> Document<'_> {
    let options = ParsingOptions {
        allow_dtd: true,
        ..ParsingOptions::default()
    };
    Document::parse_with_options(page, options).unwrap()
}

/// All words within an element.
fn words(node: Node<'_, '_>) -> String {
    let texts = node.descendants().filter(Node::is_text);
    texts.filter_map(|text| text.text()).collect()
}

fn section<'a>(page: &'a Document<'a>, id: &str) -> Node<'a, 'a> {
    let found = page.descendants().find(|n| n.attribute("id") == Some(id));
    found.unwrap()
}

fn charts<'a>(section: Node<'a, 'a>) -> Vec<Node<'a, 'a>> {
    let svgs = section
        .descendants()
        .filter(|n| n.has_tag_name((SVG, "svg")));
    svgs.collect()
}

/// The tips of the dots of all families in a chart, in the order in which they are drawn.
fn tips(chart: Node<'_, '_>) -> Vec<String> {
    let circles = chart
        .descendants()
        .filter(|n| n.has_tag_name((SVG, "circle")));
    let titles = circles.filter_map(|circle| {
        let title = circle.parent()?.first_element_child()?;
        title.has_tag_name((SVG, "title")).then(|| words(title))
    });
    titles.collect()
}

fn rings<'a>(chart: Node<'a, 'a>, name: &str) -> Vec<Node<'a, 'a>> {
    let class = format!("curve {name}");
    let circles = chart
        .descendants()
        .filter(|n| n.has_tag_name((SVG, "circle")));
    circles
        .filter(|n| n.attribute("class") == Some(&class))
        .collect()
}

/// The cells of the table of settings.
fn rows(section: Node<'_, '_>) -> Vec<Vec<String>> {
    let table = section
        .descendants()
        .find(|n| n.attribute("class") == Some("settings"));
    let rows = table
        .unwrap()
        .descendants()
        .filter(|n| n.has_tag_name("tr"))
        .skip(1);
    let cells = |row: Node<'_, '_>| row.children().filter(Node::is_element).map(words).collect();
    rows.map(cells).collect()
}

/// The sweeps that have points, each with its section's id.
fn swept(study: &Study) -> impl Iterator<Item = (String, &Sweep)> {
    let numbered = study.sweeps.iter().enumerate();
    let swept = numbered.filter(|(_, sweep)| !sweep.points.is_empty());
    swept.map(|(i, sweep)| (format!("sweep-{}", i + 1), sweep))
}

#[test]
fn every_point_is_in_each_chart_and_in_the_table() {
    let study = study();
    let text = html(&study);
    let page = read(&text);
    for (id, sweep) in swept(&study) {
        let section = section(&page, &id);
        let charts = charts(section);
        assert!(!charts.is_empty(), "{id}");
        let rows = rows(section);
        assert_eq!(rows.len(), sweep.points.len());
        for chart in charts {
            let mut tips = tips(chart);
            tips.sort_by_key(|tip| tip.split('.').next().unwrap().parse::<usize>().unwrap());
            assert_eq!(tips.len(), sweep.points.len(), "{id}");
            for (i, (tip, point)) in tips.iter().zip(&sweep.points).enumerate() {
                let begin = format!("{}. {}: ", i + 1, point.setting);
                assert!(tip.starts_with(&begin), "{tip} against {begin}");
            }
        }
        for (i, (row, point)) in rows.iter().zip(&sweep.points).enumerate() {
            assert_eq!(row[0], (i + 1).to_string());
            assert!(row[1].starts_with(&point.setting), "{row:?}");
            let toml = point.toml.as_deref().unwrap_or("–");
            assert_eq!(row.last().unwrap(), toml);
        }
    }
}

#[test]
fn the_pareto_front_and_the_current_setting_are_marked_in_charts_and_table() {
    let study = study();
    let text = html(&study);
    let page = read(&text);
    for (id, sweep) in swept(&study) {
        let section = section(&page, &id);
        let best = sweep.points.iter().filter(|p| p.pareto).count();
        let current = sweep.points.iter().filter(|p| p.current).count();
        for chart in charts(section) {
            assert_eq!(rings(chart, "Pareto front").len(), best, "{id}");
            assert_eq!(rings(chart, "as the shot is").len(), current, "{id}");
        }
        for (row, point) in rows(section).iter().zip(&sweep.points) {
            assert_eq!(row[row.len() - 2] == "yes", point.pareto, "{row:?}");
            assert_eq!(row[1].contains("as the shot is"), point.current, "{row:?}");
        }
    }
}

/// Where a dot stands on the page.
fn center(chart: Node<'_, '_>, setting: &str) -> [f64; 2] {
    let circles = chart
        .descendants()
        .filter(|n| n.has_tag_name((SVG, "circle")));
    let ours = circles.filter(|circle| {
        let title = circle
            .parent()
            .and_then(|g| g.first_element_child())
            .unwrap();
        words(title).contains(&format!(". {setting}: "))
    });
    let found: Vec<_> = ours.collect();
    assert_eq!(found.len(), 1, "{setting}");
    ["cx", "cy"].map(|side| found[0].attribute(side).unwrap().parse().unwrap())
}

#[test]
fn dots_stand_to_the_right_for_time_and_higher_for_error_by_logarithms() {
    let study = study();
    let text = html(&study);
    let page = read(&text);
    let chart = charts(section(&page, "sweep-1"))[0];
    let at = |setting: &str| center(chart, setting);
    // Equal ratios are equal distances: 0.134 to 1.48 s and 0.0854 to 0.147 s.
    let wide = (at("lines, 2 nm")[0] - at("lines, 50 nm")[0]) / (1.48f64 / 0.134).ln();
    let narrow = (at("grid, 168")[0] - at("grid, 8")[0]) / (0.147f64 / 0.0854).ln();
    // Places are written to hundredths of a pixel.
    assert!((wide / narrow - 1.0).abs() < 1e-3, "{wide} {narrow}");
    let high = (at("lines, 2 nm")[1] - at("rgb")[1]) / (24.1f64 / 0.0534).ln();
    let low = (at("grid, 168")[1] - at("grid, 84")[1]) / (0.0412f64 / 0.00371).ln();
    assert!((high / low - 1.0).abs() < 1e-3, "{high} {low}");
    // Curves join what has an error that a logarithm has, coarse to fine.
    let joined = |family: &str| {
        let class = format!("curve {family}");
        let lines = chart
            .descendants()
            .filter(|n| n.has_tag_name((SVG, "polyline")));
        let line = lines
            .into_iter()
            .find(|n| n.attribute("class") == Some(&class));
        line.map(|line| line.attribute("points").unwrap().to_owned())
    };
    let ends = [at("spline, 84"), at("spline, 336")].map(|[x, y]| format!("{x},{y}"));
    assert_eq!(joined("spline"), Some(ends.join(" ")));
    assert_eq!(joined("exact"), None);
    // The reference has no error and stands lowest, and the caption says so.
    assert!(at("exact")[1] > at("spline, 336")[1]);
    assert!(words(section(&page, "sweep-1")).contains("Points at the lower edge of the chart"));
}

#[test]
fn every_label_in_a_chart_is_a_setting_or_its_number() {
    let study = study();
    let text = html(&study);
    let page = read(&text);
    for (id, sweep) in swept(&study) {
        for chart in charts(section(&page, &id)) {
            let labels = chart
                .descendants()
                .filter(|n| n.attribute("class") == Some("remark"));
            let labels: Vec<String> = labels.map(words).collect();
            for label in &labels {
                let number = label
                    .parse::<usize>()
                    .is_ok_and(|i| i <= sweep.points.len());
                let setting = sweep.points.iter().any(|p| p.setting == *label);
                assert!(number || setting, "{label}");
            }
            if id == "sweep-1" {
                assert_eq!(labels.len(), sweep.points.len(), "{labels:?}");
            }
        }
    }
}

#[test]
fn a_time_of_a_phase_that_is_the_images_is_charted_once() {
    let study = study();
    let text = html(&study);
    let page = read(&text);
    assert_eq!(charts(section(&page, "sweep-1")).len(), 2);
    assert_eq!(charts(section(&page, "sweep-2")).len(), 1);
    let unswept = section(&page, "sweep-4");
    assert!(charts(unswept).is_empty());
    assert!(words(unswept).contains("No surface mirrors or refracts light."));
}

#[test]
fn numbers_that_are_none_do_not_reach_a_drawing() {
    let study = study();
    let text = html(&study);
    let page = read(&text);
    let drawn = page
        .descendants()
        .filter(|n| n.tag_name().namespace() == Some(SVG));
    for node in drawn {
        for attribute in node.attributes() {
            let value = attribute.value();
            let numeric = [
                "x",
                "y",
                "cx",
                "cy",
                "r",
                "width",
                "height",
                "points",
                "stroke-width",
            ];
            if numeric.contains(&attribute.name()) {
                let mut numbers = value.split([' ', ',']);
                assert!(
                    numbers.all(|n| n.parse::<f64>().is_ok_and(f64::is_finite)),
                    "{node:?}"
                );
            }
        }
    }
    let broken = words(section(&page, "sweep-3"));
    assert!(
        broken.contains("∞") && broken.contains("no number"),
        "{broken}"
    );
    assert!(broken.contains("Points at its upper edge"), "{broken}");
    for word in ["NaN", "inf ", "infs"] {
        assert!(!text.contains(word), "{word}");
    }
}

#[test]
fn the_page_asks_for_nothing_and_runs_nothing() {
    for text in [html(&study()), html(&noisy())] {
        let page = read(&text);
        let mut ids: Vec<&str> = Vec::new();
        for node in page.descendants().filter(Node::is_element) {
            let tag = node.tag_name().name();
            let foreign = [
                "script", "link", "img", "image", "iframe", "object", "use", "base",
            ];
            assert!(!foreign.contains(&tag), "{tag}");
            for attribute in node.attributes() {
                let name = attribute.name();
                let bad = name.starts_with("on") || ["src", "href", "srcset"].contains(&name);
                assert!(!bad && !attribute.value().contains("url("), "{node:?}");
            }
            ids.extend(node.attribute("id"));
        }
        let found = ids.len();
        ids.sort_unstable();
        ids.dedup();
        assert_eq!(ids.len(), found, "an id stands for one element");
        let style = page
            .descendants()
            .find(|n| n.has_tag_name("style"))
            .unwrap();
        let style = words(style);
        assert!(!style.contains("url(") && !style.contains("@import"));
        assert!(!text.replace(SVG, "").contains("http"));
    }
}

#[test]
fn names_are_shown_as_they_are_written() {
    let study = study();
    let text = html(&study);
    let page = read(&text);
    let title = page.descendants().find(|n| n.has_tag_name("h1")).unwrap();
    assert_eq!(words(title), AWKWARD);
    assert!(
        words(section(&page, "sweep-2")).contains("against fine & meshes of <twice> the fineness.")
    );
}

#[test]
fn on_a_busy_machine_times_within_ten_percent_are_marked() {
    let (quiet, busy) = (html(&study()), html(&noisy()));
    assert!(!quiet.contains("≈"));
    let page = read(&busy);
    assert!(words(page.root_element()).contains("too busy to tell settings apart"));
    let study = noisy();
    let current = study.sweeps[0].points.iter().find(|p| p.current).unwrap();
    for (row, point) in rows(section(&page, "sweep-1"))
        .iter()
        .zip(&study.sweeps[0].points)
    {
        let ratio = point.frame.median / current.frame.median;
        let alike = ratio.max(1.0 / ratio) <= 1.1;
        assert_eq!(row[3].contains("≈"), alike, "{row:?}");
    }
}

#[test]
fn costs_within_the_spread_are_said_to_be_none() {
    let text = html(&study());
    let page = read(&text);
    let effects = section(&page, "effects");
    let row = |name: &str| {
        let rows = effects
            .descendants()
            .filter(|n| n.has_tag_name("tr"))
            .map(words);
        rows.into_iter().find(|row| row.starts_with(name)).unwrap()
    };
    assert!(
        row("thermal").contains("−0.12 % ± 0.35 %"),
        "{}",
        row("thermal")
    );
    assert!(row("thermal").contains("not called for: 0 % within the spread"));
    assert!(row("mirror").contains("but beyond the spread"));
    assert!(row("beaming").contains("yes") && row("beaming").contains("0 % within the spread"));
    assert!(row("doppler").contains("28.7 % ± 1.2 %") && !row("doppler").contains("within"));
}

#[test]
fn advice_can_be_pasted_into_a_shot() {
    let text = html(&study());
    let page = read(&text);
    let advice = section(&page, "advice");
    let pasted: Vec<String> = advice
        .descendants()
        .filter(|n| n.has_tag_name("pre"))
        .map(words)
        .collect();
    assert_eq!(pasted.len(), 3);
    for (toml, table, key) in [
        (&pasted[0], "accuracy", "wavelengths"),
        (&pasted[1], "accuracy", "wavelengths"),
        (&pasted[2], "image", "samples"),
    ] {
        let shot: toml::Table = toml.parse().unwrap();
        assert!(shot[table].get(key).is_some(), "{toml}");
    }
    assert!(words(advice).contains("none of those measured"));
}

#[test]
fn the_table_reads_back() {
    let study = study();
    let text = csv(&study);
    let mut reader = ::csv::Reader::from_reader(text.as_bytes());
    let header = reader.headers().unwrap().clone();
    let rows: Vec<::csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    let points: Vec<_> = swept(&study)
        .flat_map(|(_, sweep)| sweep.points.iter().map(move |point| (sweep, point)))
        .collect();
    assert_eq!(rows.len(), points.len());
    for (row, (sweep, point)) in rows.iter().zip(points) {
        let field = |name: &str| &row[header.iter().position(|h| h == name).unwrap()];
        let number = |name: &str| field(name).parse::<f64>().ok();
        let held = |value: Option<f64>| {
            value.map(|v| {
                if v.is_nan() {
                    f64::MAX
                } else {
                    v.clamp(-f64::MAX, f64::MAX)
                }
            })
        };
        assert_eq!(field("knob"), sweep.knob);
        assert_eq!(field("setting"), point.setting);
        assert_eq!(field("family"), point.family);
        assert_eq!(field("toml"), point.toml.as_deref().unwrap_or(""));
        assert_eq!(field("current"), point.current.to_string());
        assert_eq!(field("pareto"), point.pareto.to_string());
        assert_eq!(number("frame_median_s"), held(Some(point.frame.median)));
        assert_eq!(number("phase_greatest_s"), held(Some(point.phase.greatest)));
        assert_eq!(number("memory_mib"), point.memory_mib);
        assert_eq!(field("file_bytes").parse().ok(), point.file_bytes);
        let errors = point.errors;
        assert_eq!(number("error_radiance"), held(errors.map(|e| e.radiance)));
        let delta_e = errors.and_then(|e| e.delta_e);
        assert_eq!(number("delta_e_p99"), delta_e.map(|p| p.p99));
        let displacement = errors.and_then(|e| e.displacement);
        assert_eq!(
            number("displacement_worst_px"),
            displacement.map(|p| p.worst)
        );
        assert_eq!(number("bound"), errors.and_then(|e| e.bound));
    }
}

#[test]
fn the_json_holds_the_study_to_the_last_bit() {
    let mut study = study();
    study.sweeps.remove(2);
    let read: Value = serde_json::from_str(&json(&study)).unwrap();
    assert_eq!(read, serde_json::to_value(&study).unwrap());
    let seconds = &read["sweeps"][0]["points"][0]["frame"]["median"];
    assert_eq!(seconds.as_f64(), Some(0.0812));
    assert!(read["sweeps"][0]["points"][13]["errors"].is_null());
}

#[test]
fn what_is_no_number_is_no_null_in_the_json() {
    let mut study = study();
    study.noise.duplicate = f64::NAN;
    study.effects[0].cost = f64::NEG_INFINITY;
    study.recommendations[0].time_ratio = Some(f64::INFINITY);
    let read: Value = serde_json::from_str(&json(&study)).unwrap();
    assert_eq!(read["noise"]["duplicate"].as_f64(), Some(f64::MAX));
    assert_eq!(read["effects"][0]["cost"].as_f64(), Some(-f64::MAX));
    let ratio = &read["recommendations"][0]["time_ratio"];
    assert_eq!(ratio.as_f64(), Some(f64::MAX));
    let broken = &read["sweeps"][2];
    for point in broken["points"].as_array().unwrap() {
        assert!(point["errors"]["radiance"].is_f64(), "{point}");
        assert!(point["frame"]["median"].is_f64(), "{point}");
        assert!(point["phase"]["median"].is_f64(), "{point}");
    }
    assert!(broken["halving"][0]["time_ratio"].is_f64());
    assert!(broken["halving"][0]["per_halving"].is_f64());
}

#[test]
fn equal_studies_give_equal_bytes_and_files_to_look_at() {
    for (name, study) in [("study", study()), ("noisy", noisy())] {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("study-report");
        let folder = folder.join(name);
        fs::create_dir_all(&folder).unwrap();
        let page: fn(&Study) -> String = html;
        for (extension, text) in [("html", page), ("csv", csv), ("json", json)] {
            let first = text(&study);
            assert!(first == text(&study.clone()), "{name}.{extension}");
            fs::write(folder.join(format!("study.{extension}")), first).unwrap();
        }
    }
}
