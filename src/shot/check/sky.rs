//! The background: one sky, its files there, ranges that ascend.

use super::Checks;
use crate::shot::{RandomStars, Stars};

impl Checks<'_> {
    pub(super) fn sky(&mut self) {
        let sky = &self.shot.background;
        self.check_worldline("background.worldline", sky.worldline.as_ref());
        self.spectrum("background.spectrum", sky.spectrum.as_ref());
        if self.given("background.spectrum") && self.given("background.image") {
            let message = "`spectrum` and `image` both say what the sky is".to_owned();
            self.say("background.image", message, "leave out one of them");
        }
        if let Some(file) = &sky.image {
            self.check_file("background.image", file);
        }
        match &sky.stars {
            Some(Stars::Catalogue(stars)) => self.check_file("background.stars.file", &stars.file),
            Some(Stars::Random(stars)) => self.random_stars(stars),
            None => {}
        }
    }

    fn random_stars(&mut self, stars: &RandomStars) {
        let ranges = [
            ("temperature", stars.temperature),
            ("magnitude", stars.magnitude),
        ];
        for (key, [from, to]) in ranges.into_iter().filter(|(_, [from, to])| from > to) {
            let message = format!("the range of {key} begins at {from} and ends at {to}, below it");
            self.say(
                &format!("background.stars.{key}"),
                message,
                "write the smaller first",
            );
        }
    }
}
