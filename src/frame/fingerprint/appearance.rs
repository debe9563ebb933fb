//! Inputs of a fingerprint: what surfaces, lamps and the sky look like.

use super::list::List;
use crate::shot::{
    Background, Diffuse, Emission, Gaussian, Highlight, Light, Material, Mirror, RandomStars,
    Refraction, SpectrumTable, SpectrumValue, StarCatalogue, Stars, Thermal, Track,
};

impl List<'_> {
    pub(super) fn material(&mut self, material: &Material) {
        let Material {
            diffuse,
            highlight,
            mirror,
            refraction,
            emission,
            thermal,
        } = material;
        if let Some(Diffuse { weight, spectrum }) = diffuse {
            self.table("diffuse", |list| list.term("weight", weight, spectrum));
        }
        if let Some(Highlight {
            weight,
            spectrum,
            exponent,
        }) = highlight
        {
            self.table("highlight", |list| {
                list.term("weight", weight, spectrum);
                list.given_track("exponent", exponent);
            });
        }
        if let Some(Mirror { weight, spectrum }) = mirror {
            self.table("mirror", |list| list.term("weight", weight, spectrum));
        }
        if let Some(Refraction {
            weight,
            spectrum,
            ior,
        }) = refraction
        {
            self.table("refraction", |list| {
                list.term("weight", weight, spectrum);
                list.given_track("ior", ior);
            });
        }
        if let Some(Emission { scale, spectrum }) = emission {
            self.table("emission", |list| list.term("scale", scale, spectrum));
        }
        if let Some(Thermal {
            temperature,
            emissivity,
            curve,
            strength,
        }) = thermal
        {
            self.table("thermal", |list| {
                list.given_track("temperature", temperature);
                list.spectrum("emissivity", emissivity);
                list.given("curve", curve);
                list.given_track("strength", strength);
            });
        }
    }

    fn term(
        &mut self,
        factor: &str,
        weight: &Option<Track<f64>>,
        spectrum: &Option<SpectrumValue>,
    ) {
        self.given_track(factor, weight);
        self.spectrum("spectrum", spectrum);
    }

    fn spectrum(&mut self, name: &str, value: &Option<SpectrumValue>) {
        match value {
            None => {}
            Some(SpectrumValue::Number(value)) => self.track(name, value),
            Some(SpectrumValue::Name(own)) => self.leaf(name, own),
            Some(SpectrumValue::Table(table)) => {
                self.table(name, |list| list.spectrum_table(table));
            }
        }
    }

    pub(super) fn spectrum_table(&mut self, table: &SpectrumTable) {
        let SpectrumTable {
            points,
            tension,
            constant,
            blackbody,
            unit_at,
            illuminant,
            rgb,
            gaussian,
            file,
            beyond,
        } = table;
        self.given("points", points);
        self.given("tension", tension);
        self.given_track("constant", constant);
        self.given_track("blackbody", blackbody);
        self.given("unit_at", unit_at);
        self.given("illuminant", illuminant);
        self.given_track("rgb", rgb);
        if let Some(Gaussian { center, width }) = gaussian {
            self.table("gaussian", |list| {
                list.track("center", center);
                list.track("width", width);
            });
        }
        self.given("file", file);
        self.given("beyond", beyond);
    }

    pub(super) fn light(&mut self, light: &Light) {
        let Light {
            kind,
            name: _,
            worldline,
            position,
            direction,
            inner,
            outer,
            intensity,
            scale,
            spectrum,
        } = light;
        self.leaf("kind", kind);
        self.given("worldline", worldline);
        self.given_track("position", position);
        self.given_track("direction", direction);
        self.given_track("inner", inner);
        self.given_track("outer", outer);
        self.given_track("intensity", intensity);
        self.given_track("scale", scale);
        self.spectrum("spectrum", spectrum);
    }

    pub(super) fn background(&mut self, background: &Background) {
        let Background {
            worldline,
            spectrum,
            image,
            scale,
            stars,
        } = background;
        self.given("worldline", worldline);
        self.spectrum("spectrum", spectrum);
        self.given("image", image);
        self.given_track("scale", scale);
        match stars {
            None => {}
            Some(Stars::Catalogue(StarCatalogue { file, size })) => {
                self.table("stars", |list| {
                    list.leaf("file", file);
                    list.leaf("size", size);
                });
            }
            Some(Stars::Random(RandomStars {
                count,
                seed,
                size,
                temperature,
                magnitude,
            })) => self.table("stars", |list| {
                list.leaf("count", count);
                list.leaf("seed", seed);
                list.leaf("size", size);
                list.leaf("temperature", temperature);
                list.leaf("magnitude", magnitude);
            }),
        }
    }
}
