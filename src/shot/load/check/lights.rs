//! Lamps (the keys of each kind, one measure of the amount, a spot's cone) and the background (one
//! kind of sky, files that exist, ascending ranges).

use super::bodies::is_zero;
use super::checks::Checks;
use crate::shot::{Light, LightKind, RandomStars, Stars, Track};

/// Outer half-angle of a spot whose author gives none, degrees.
const DEFAULT_OUTER: f64 = 45.0;

impl Checks<'_> {
    pub(super) fn lights(&mut self) {
        for (key, light) in self.each("light", &self.shot.light) {
            self.check_worldline(&format!("{key}.worldline"), light.worldline.as_ref());
            self.spectrum(&format!("{key}.spectrum"), light.spectrum.as_ref());
            self.light_keys(&key, light.kind);
            self.amount(&key);
            self.cone(&key, light);
            if let Some(direction) = &light.direction
                && let Some(at) = self.first(direction, direction, |d, _| is_zero(d))
            {
                let message = format!("the direction is zero at frame {at}");
                self.report(
                    &format!("{key}.direction"),
                    message,
                    "any length but zero will do",
                );
            }
        }
    }

    fn light_keys(&mut self, key: &str, kind: LightKind) {
        let (name, needed, foreign): (_, &[&str], &[&str]) = match kind {
            LightKind::Point => ("point", &["position"], &["direction", "inner", "outer"]),
            LightKind::Spot => ("spot", &["position", "direction"], &[]),
            LightKind::Sun => ("sun", &["direction"], &["position", "inner", "outer"]),
        };
        for needed in needed {
            if !self.given(&format!("{key}.{needed}")) {
                let message = format!("a {name} light needs `{needed}`");
                self.report(key, message, &format!("add {needed} = [x, y, z]"));
            }
        }
        for foreign in foreign {
            let path = format!("{key}.{foreign}");
            if self.given(&path) {
                let message = format!("a {name} light has no `{foreign}`");
                self.report(
                    &path,
                    message,
                    "leave it out, or choose another kind of light",
                );
            }
        }
    }

    fn amount(&mut self, key: &str) {
        let scale = format!("{key}.scale");
        match (self.given(&format!("{key}.intensity")), self.given(&scale)) {
            (true, true) => {
                let message = "`intensity` and `scale` both give the amount of light".to_owned();
                self.report(&scale, message, "leave out one of them");
            }
            (false, false) => {
                let message = "the light needs `intensity` or `scale`".to_owned();
                self.report(key, message, "add intensity = 1000: cd, or lx for a sun");
            }
            _ => {}
        }
    }

    fn cone(&mut self, key: &str, light: &Light) {
        let outer_key = format!("{key}.outer");
        let Some(inner) = &light.inner else { return };
        if light.outer.is_none() && self.given(&outer_key) {
            return; // it is mistaken by itself
        }
        let default = Track::Constant(DEFAULT_OUTER);
        let outer = light.outer.as_ref().unwrap_or(&default);
        if let Some(at) = self.first(inner, outer, |inner, outer| inner > outer) {
            let (i, o) = (
                inner.at_instant(at, self.frames()),
                outer.at_instant(at, self.frames()),
            );
            let message =
                format!("the cone's inner half-angle, {i} degrees, exceeds its outer, {o}");
            self.report(&format!("{key}.inner"), message, "inner is at most outer");
        }
    }

    pub(super) fn sky(&mut self) {
        let sky = &self.shot.background;
        self.check_worldline("background.worldline", sky.worldline.as_ref());
        self.spectrum("background.spectrum", sky.spectrum.as_ref());
        if self.given("background.spectrum") && self.given("background.image") {
            let message = "`spectrum` and `image` both say what the sky is".to_owned();
            self.report("background.image", message, "leave out one of them");
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
            self.report(
                &format!("background.stars.{key}"),
                message,
                "write the smaller first",
            );
        }
    }
}
