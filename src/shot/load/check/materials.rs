//! Materials: reflectance and emissivity within [0, 1], thermal keys that belong together.

use super::checks::Checks;
use crate::shot::{Material, SpectrumValue, Thermal, ThermalCurve, Track};

/// A term that reflects, transmits or emits a share of something: its name, weight, spectrum.
type Share<'a> = (&'a str, Option<&'a Track<f64>>, Option<&'a SpectrumValue>);

impl Checks<'_> {
    pub(super) fn materials(&mut self) {
        for (name, material) in &self.shot.material {
            let key = format!("material.{name}");
            for share in shares(material) {
                self.share(&key, share);
            }
            if let Some(emission) = &material.emission {
                self.spectrum(
                    &format!("{key}.emission.spectrum"),
                    emission.spectrum.as_ref(),
                );
            }
            if let Some(thermal) = &material.thermal {
                self.thermal(&format!("{key}.thermal"), thermal);
            }
        }
    }

    /// One term: its spectrum, and weight × spectrum within [0, 1].
    fn share(&mut self, material: &str, (term, weight, spectrum): Share<'_>) {
        let name = if term == "thermal" {
            "emissivity"
        } else {
            "spectrum"
        };
        let key = format!("{material}.{term}.{name}");
        self.spectrum(&key, spectrum);
        let whole = Track::Constant(1.0);
        let weight_track = weight.unwrap_or(&whole);
        let values = spectrum.map_or(Track::Constant(1.0), |value| self.authored_values(value));
        let too_much = |weight: f64, value: f64| weight * value > 1.0;
        let Some(instant) = self.first(weight_track, &values, too_much) else {
            return;
        };
        let frames = self.frames();
        let (factor, value) = (
            weight_track.at_instant(instant, frames),
            values.at_instant(instant, frames),
        );
        let (what, product) = match (term, weight) {
            ("thermal", _) => ("emissivity", format!("{value}")),
            (_, Some(_)) => (
                "reflectance",
                format!("weight {factor} × {value} = {}", factor * value),
            ),
            (_, None) => ("reflectance", format!("{value}")),
        };
        let at = if weight.is_some() {
            format!("{material}.{term}.weight")
        } else {
            key
        };
        let message = format!("`{material}.{term}` has an {what} above 1: {product}");
        let message = message.replace("an reflectance", "a reflectance");
        self.report(
            &at,
            message,
            "nothing gives back more light than it gets: stay within 0 and 1",
        );
    }

    fn thermal(&mut self, key: &str, thermal: &Thermal) {
        let strength = format!("{key}.strength");
        let curve = format!("{key}.curve");
        let absolute = thermal.curve == Some(ThermalCurve::Absolute) || !self.given(&curve);
        if self.given(&strength) && absolute {
            let message = "`strength` has no meaning where the curve is absolute".to_owned();
            self.report(
                &strength,
                message,
                "write curve = \"peak\" beside it, or leave it out",
            );
        }
    }
}

fn shares(material: &Material) -> Vec<Share<'_>> {
    let Material {
        diffuse,
        highlight,
        mirror,
        refraction,
        thermal,
        emission: _, // no share: it may exceed 1
    } = material;
    let terms = [
        diffuse
            .as_ref()
            .map(|t| ("diffuse", t.weight.as_ref(), t.spectrum.as_ref())),
        highlight
            .as_ref()
            .map(|t| ("highlight", t.weight.as_ref(), t.spectrum.as_ref())),
        mirror
            .as_ref()
            .map(|t| ("mirror", t.weight.as_ref(), t.spectrum.as_ref())),
        refraction
            .as_ref()
            .map(|t| ("refraction", t.weight.as_ref(), t.spectrum.as_ref())),
        thermal
            .as_ref()
            .map(|t| ("thermal", None, t.emissivity.as_ref())),
    ];
    terms.into_iter().flatten().collect()
}
