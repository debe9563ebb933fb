//! Settings of the image and the sensor: the window, spectral lines in it, splices, insets.

use super::checks::Checks;
use crate::shot::{Format, Inset, InsetPixel, Spectra};
use crate::spectrum::{LINES_NM, LineAxis};

/// Least ratio of the ends of a window. An axis of 4096 wavelengths in it is still far from the
/// rounding of their logarithms.
const NARROWEST: f64 = 1.000_001;

impl Checks<'_> {
    pub(super) fn settings(&mut self) {
        let [from, to] = self.shot.sensor.window;
        if from >= to {
            let message = format!("the window ends at {to} nm, where it has not begun");
            self.report(
                "sensor.window",
                message,
                "write the shorter wavelength first",
            );
        } else if to < from * NARROWEST {
            let message = format!("the window from {from} to {to} nm is too narrow");
            self.report(
                "sensor.window",
                message,
                "let it end at least a millionth further than it begins",
            );
        } else {
            self.lines();
        }
        for (key, splice) in self.each("splice", &self.shot.splice) {
            let [top, bottom] = splice.rows;
            if top >= bottom {
                let message = format!("a splice from {top} to {bottom} has no rows");
                self.report(
                    &format!("{key}.rows"),
                    message,
                    "rows count from the top: the smaller first",
                );
            }
        }
    }

    /// With `spectra = "lines"`, a window without any line would make a black image.
    fn lines(&mut self) {
        let accuracy = &self.shot.accuracy;
        let [from, to] = self.shot.sensor.window;
        let axis = LineAxis::new(accuracy.line_spacing);
        if accuracy.spectra != Spectra::Lines || axis.within([from, to]).next().is_some() {
            return;
        }
        let [first, last] = LINES_NM;
        let message = format!("no line lies in the window from {from} to {to} nm");
        let help = format!(
            "lines stand from {first} to {last} nm, {} nm apart (`line_spacing`): use \"grid\", or another window",
            axis.spacing_nm()
        );
        self.report("accuracy.spectra", message, &help);
    }

    pub(super) fn insets(&mut self) {
        let insets = self.each("inset", &self.shot.inset);
        if insets.is_empty() {
            return;
        }
        // What the walk found mistaken has its default by now, which says nothing of insets.
        let sound = |key: &str| {
            self.mistakes
                .iter()
                .all(|mistake| !mistake.key.starts_with(key))
        };
        let [image, output, own] = ["image.size", "output.formats", "inset["].map(sound);
        if output && !self.shot.output.formats.contains(&Format::Png) {
            let message = "an inset is drawn into the PNG, and none is written".to_owned();
            let help = "add \"png\" to `output.formats`, or leave out [[inset]]";
            self.report(&insets[0].0, message, help);
        }
        if !image || !own {
            return;
        }
        for (i, (key, inset)) in insets.iter().enumerate() {
            self.inside(key, inset);
            if insets[..i]
                .iter()
                .any(|(_, other)| self.overlap(inset, other))
            {
                let message = "this inset covers an earlier one".to_owned();
                let help =
                    "give it another corner (`place`), and both a `size` that leaves room for both";
                self.report(&format!("{key}.place"), message, help);
            }
        }
    }

    fn inside(&mut self, key: &str, inset: &Inset) {
        let [width, height] = self.shot.image.size;
        if let InsetPixel::At([x, y]) = inset.pixel
            && (x >= width || y >= height)
        {
            let message = format!("pixel [{x}, {y}] lies outside the image of {width} x {height}");
            let help = format!(
                "columns are 0 to {}, rows 0 to {}; or write \"center\"",
                width - 1,
                height - 1
            );
            self.report(&format!("{key}.pixel"), message, &help);
        }
    }

    fn overlap(&self, one: &Inset, other: &Inset) -> bool {
        let [a, b] = [one, other].map(|inset| inset.place_in(self.shot.image.size));
        (0..2).all(|i| a.0[i] < b.0[i] + b.1[i] && b.0[i] < a.0[i] + a.1[i])
    }
}
