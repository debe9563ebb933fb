//! Spectra, by name or inline: one kind each, ascending points, files and illuminants that exist.

use super::checks::Checks;
use crate::shot::names::{did_you_mean, short};
use crate::shot::{SpectrumTable, SpectrumValue, Track};

/// Names of the illuminants: spectra that every shot has without defining them.
pub const ILLUMINANTS: &[&str] = &["A", "C", "D50", "D55", "D65", "D75", "E", "F2", "F7", "F11"];

const KINDS: [&str; 7] = [
    "points",
    "constant",
    "blackbody",
    "illuminant",
    "rgb",
    "gaussian",
    "file",
];

/// Keys that have a meaning only with certain kinds, and those kinds.
const COMPANIONS: [(&str, &[&str]); 3] = [
    ("tension", &["points"]),
    ("unit_at", &["blackbody"]),
    ("beyond", &["points", "file", "rgb", "illuminant"]),
];

impl Checks<'_> {
    pub(super) fn spectra(&mut self) {
        for (name, table) in &self.shot.spectrum {
            self.spectrum_table(&format!("spectrum.{name}"), table);
        }
    }

    /// Checks a spectrum in any place where one can stand.
    pub(super) fn spectrum(&mut self, key: &str, value: Option<&SpectrumValue>) {
        match value {
            Some(SpectrumValue::Name(name)) => {
                self.check_name(key, "spectrum", name, "spectrum", ILLUMINANTS);
            }
            Some(SpectrumValue::Table(table)) => self.spectrum_table(key, table),
            Some(SpectrumValue::Number(_)) | None => {}
        }
    }

    fn spectrum_table(&mut self, key: &str, table: &SpectrumTable) {
        self.kinds(key);
        if let Some(points) = &table.points {
            self.points(&format!("{key}.points"), points);
        }
        if let Some(name) = &table.illuminant
            && !ILLUMINANTS.contains(&name.as_str())
        {
            let message = format!("there is no illuminant {:?}", short(name));
            let help = did_you_mean(name, ILLUMINANTS.iter().copied(), "there are");
            self.push(&format!("{key}.illuminant"), message, help);
        }
        if let Some(file) = &table.file {
            self.check_file(&format!("{key}.file"), file);
        }
    }

    fn kinds(&mut self, key: &str) {
        let given = |kind: &&&str| self.given(&format!("{key}.{kind}"));
        let kinds: Vec<&str> = KINDS.iter().filter(given).copied().collect();
        let help = format!("a spectrum is one of {}", KINDS.join(", "));
        match kinds.as_slice() {
            [] => self.report(
                key,
                format!("`{}` says nothing of its values", short(key)),
                &help,
            ),
            [_] => {}
            [.., last] => {
                let message = format!("`{}` is {} at once", short(key), kinds.join(" and "));
                self.report(&format!("{key}.{last}"), message, &help);
            }
        }
        for (companion, owners) in COMPANIONS {
            let path = format!("{key}.{companion}");
            if self.given(&path) && !owners.iter().any(|owner| kinds.contains(owner)) {
                let message = format!("`{companion}` has no meaning here");
                self.report(
                    &path,
                    message,
                    &format!("it belongs to {}", owners.join(", ")),
                );
            }
        }
    }

    fn points(&mut self, key: &str, points: &[[f64; 2]]) {
        let mut previous = 0.0;
        for (i, [nm, value]) in points.iter().enumerate() {
            if *nm <= 0.0 {
                let message = format!("a point at {nm} nm");
                self.report(
                    &format!("{key}[{i}][0]"),
                    message,
                    "wavelengths are above 0",
                );
            } else if *nm <= previous {
                let message = format!("a point at {nm} nm after one at {previous} nm");
                self.report(
                    &format!("{key}[{i}][0]"),
                    message,
                    "wavelengths must strictly ascend",
                );
            }
            if *value < 0.0 {
                let message = format!("a spectrum of {value} at {nm} nm");
                self.report(&format!("{key}[{i}][1]"), message, "values are at least 0");
            }
            previous = *nm;
        }
    }

    /// The largest value that the author of a spectrum wrote, as a track if it moves.
    pub(super) fn authored_values(&self, value: &SpectrumValue) -> Track<f64> {
        match value {
            SpectrumValue::Number(track) => track.clone(),
            SpectrumValue::Table(table) => values_of(table),
            SpectrumValue::Name(name) => match self.shot.spectrum.get(name) {
                Some(table) => values_of(table),
                None => Track::Constant(0.0),
            },
        }
    }
}

/// The largest authored value; 0 if there is none, as for a black body.
fn values_of(table: &SpectrumTable) -> Track<f64> {
    let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
    if let Some(track) = &table.constant {
        return track.clone();
    }
    let points = table.points.iter().flatten().map(|point| point[1]);
    let rgb = table.rgb.iter().flat_map(Track::values).flatten();
    let peak = table.gaussian.iter().map(|_| 1.0);
    Track::Constant(largest(&mut points.chain(rgb).chain(peak)))
}
