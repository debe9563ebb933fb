//! Insets: pixels of the image, room for each, and a picture to stand in.

use super::Checks;
use crate::shot::{Format, Inset, InsetPixel};

impl Checks<'_> {
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
            self.say(&insets[0].0, message, help);
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
                self.say(&format!("{key}.place"), message, help);
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
            self.say(&format!("{key}.pixel"), message, &help);
        }
    }

    fn overlap(&self, one: &Inset, other: &Inset) -> bool {
        let [a, b] = [one, other].map(|inset| inset.place_in(self.shot.image.size));
        (0..2).all(|i| a.0[i] < b.0[i] + b.1[i] && b.0[i] < a.0[i] + a.1[i])
    }
}
