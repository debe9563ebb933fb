//! Units of the first column of a measured table, as headers name them.

use std::fmt;

/// Planck's constant times the speed of light over the elementary charge, nm·eV (SI Brochure, 9th
/// edition, 2019: all three are exact).
const NM_EV: f64 = 6.626_070_15e-34 * 299_792_458.0 / 1.602_176_634e-19 * 1e9;

/// The speed of light, nm·THz (SI Brochure).
const NM_THZ: f64 = 299_792.458;

/// A quantity that determines a wavelength.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    name: &'static str,
    /// Whether the unit is one over the length of that name.
    is_inverse: bool,
    to_nm: ToNm,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum ToNm {
    /// λ = a · x
    Times(f64),
    /// λ = a / x
    Over(f64),
}

/// Words for units, in lower case with the micro sign; those of 5 letters or more also match the
/// beginning of a word.
const WORDS: [(&[&str], &str, ToNm); 14] = [
    (
        &["nm", "nanom", "mµ", "millimicron"],
        "nm",
        ToNm::Times(1.0),
    ),
    (
        &["µm", "um", "microm", "mikrom", "micron"],
        "µm",
        ToNm::Times(1e3),
    ),
    (&["å", "angstr", "ångstr"], "Å", ToNm::Times(0.1)),
    (&["pm", "picom"], "pm", ToNm::Times(1e-3)),
    (&["mm", "millim"], "mm", ToNm::Times(1e6)),
    (&["cm", "centim", "zentim"], "cm", ToNm::Times(1e7)),
    (&["meter", "metre"], "m", ToNm::Times(1e9)),
    (&["ev", "electronv", "elektronenv"], "eV", ToNm::Over(NM_EV)),
    (&["kev"], "keV", ToNm::Over(NM_EV * 1e-3)),
    (&["hz", "hertz"], "Hz", ToNm::Over(NM_THZ * 1e12)),
    (&["khz"], "kHz", ToNm::Over(NM_THZ * 1e9)),
    (&["mhz", "megah"], "MHz", ToNm::Over(NM_THZ * 1e6)),
    (&["ghz", "gigah"], "GHz", ToNm::Over(NM_THZ * 1e3)),
    (&["thz", "terah"], "THz", ToNm::Over(NM_THZ)),
];

/// Symbols that have another meaning in another case.
const SYMBOLS: [(&str, ToNm); 3] = [
    ("m", ToNm::Times(1e9)),
    ("meV", ToNm::Over(NM_EV * 1e3)),
    ("MeV", ToNm::Over(NM_EV * 1e-6)),
];

/// Digits of exponents, from 0.
const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];

/// Signs between the factors of a unit.
const TIMES: [char; 6] = [' ', '·', '⋅', '*', '.', '_'];

/// Words that need no unit.
const WAVENUMBERS: [&str; 4] = ["wavenumber", "wave number", "wellenzahl", "kayser"];

impl Unit {
    /// The wavelength of a number in this unit, nm.
    pub fn nm(&self, number: f64) -> f64 {
        match self.to_nm {
            ToNm::Times(factor) => number * factor,
            ToNm::Over(factor) => factor / number,
        }
    }

    /// Whether the unit is the nm.
    pub fn is_nm(&self) -> bool {
        self.to_nm == ToNm::Times(1.0)
    }

    /// The unit in the name of a column, if there is one.
    pub(super) fn of(name: &str) -> Option<Self> {
        // A power of ten belongs to the unit.
        if name.contains("10") {
            return None;
        }
        let found = words(name).find_map(|word| word.unit());
        let lower = name.to_lowercase();
        if WAVENUMBERS.iter().any(|word| lower.contains(word)) {
            let length = found.unwrap_or(Self::plain("cm", ToNm::Times(1e7)));
            return length.inverse();
        }
        // In other places A is area, ampere or absorbance.
        let alone = name.trim_matches(|c: char| !c.is_alphanumeric()) == "A";
        let angstrom = || alone || ["(A)", "[A]", "/ A", "/A"].iter().any(|a| name.contains(a));
        found.or_else(|| angstrom().then(|| Self::plain("Å", ToNm::Times(0.1))))
    }

    /// Whether a column's values are per unit of something other than nm; per volume counts, since
    /// it is per area and per wavelength.
    pub(super) fn divides(name: &str) -> bool {
        words(name).any(|word| {
            let unit = word.plain_unit().or_else(|| word.angstrom());
            let Some(unit) = unit.filter(|unit| unit.name != "nm") else {
                return false;
            };
            // Lumens per meter are those of a strip of light.
            let length = ["m", "cm", "mm"].contains(&unit.name);
            match word.power() {
                -3 => true,
                1 => word.is_inverted() || word.is_divisor() && !length,
                3 => word.is_divisor(),
                _ => word.is_inverted(),
            }
        })
    }

    fn plain(name: &'static str, to_nm: ToNm) -> Self {
        Self {
            name,
            is_inverse: false,
            to_nm,
        }
    }

    /// One over a length; None for one over anything else.
    fn inverse(self) -> Option<Self> {
        match self.to_nm {
            ToNm::Times(factor) => Some(Self {
                is_inverse: true,
                to_nm: ToNm::Over(factor),
                ..self
            }),
            ToNm::Over(_) => self.is_inverse.then_some(self),
        }
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)?;
        f.write_str(if self.is_inverse { "⁻¹" } else { "" })
    }
}

/// A run of letters, and the text around it.
struct Word<'a> {
    before: &'a str,
    text: &'a str,
    after: &'a str,
}

/// The runs of letters of a text.
fn words(text: &str) -> impl Iterator<Item = Word<'_>> {
    let mut at = 0;
    std::iter::from_fn(move || {
        let from = at + text[at..].find(char::is_alphabetic)?;
        let length = text[from..].find(|c: char| !c.is_alphabetic());
        at = length.map_or(text.len(), |length| from + length);
        Some(Word {
            before: &text[..from],
            text: &text[from..at],
            after: &text[at..],
        })
    })
}

impl Word<'_> {
    /// The unit of this word, inverted if it is written so.
    fn unit(&self) -> Option<Unit> {
        let unit = self.plain_unit()?;
        if self.is_inverted() {
            unit.inverse()
        } else {
            Some(unit)
        }
    }

    /// The unit of this word, or of the last word of its `camelCase`.
    fn plain_unit(&self) -> Option<Unit> {
        let last = self.text.rfind(char::is_uppercase).unwrap_or(0);
        called(self.text).or_else(|| called(&self.text[last..]))
    }

    /// The ångström, for an A among other units.
    fn angstrom(&self) -> Option<Unit> {
        let before = self.before.trim_end_matches(TIMES);
        let follows = self.is_inverted() && before.ends_with(char::is_numeric);
        let is = self.text == "A" && (follows || self.is_divisor());
        is.then(|| Unit::plain("Å", ToNm::Times(0.1)))
    }

    fn is_inverted(&self) -> bool {
        let one_over = self.before.trim_end().strip_suffix('/');
        one_over.is_some_and(|before| before.trim_end().ends_with('1')) || self.power() == -1
    }

    /// Whether the word is behind a slash or `per`, alone or after other units, in brackets or not.
    fn is_divisor(&self) -> bool {
        let stroke = self.before.rsplit_once('/');
        let stroke = stroke.filter(|(_, between)| {
            let mut words = between.split(|c: char| !c.is_alphabetic());
            !between.contains([')', ']', ',', ';']) && words.all(|word| word.chars().count() <= 3)
        });
        stroke.is_some() || self.before.ends_with("per ")
    }

    /// Its exponent; 1 if there is none.
    fn power(&self) -> i32 {
        let after = self.after.trim_start_matches(['^', '*', '{', '(']);
        let (sign, after) = match after.strip_prefix(['-', '−', '⁻']) {
            Some(after) => (-1, after),
            None => (1, after),
        };
        let raised = |c: char| RAISED.iter().position(|digit| *digit == c);
        let digit = after.chars().next();
        let digit = digit.and_then(|c| c.to_digit(10).or(raised(c).map(|d| d as u32)));
        digit.map_or(1, |digit| sign * digit as i32)
    }
}

/// The unit of that name.
fn called(word: &str) -> Option<Unit> {
    if let Some((name, to_nm)) = SYMBOLS.iter().find(|(symbol, _)| *symbol == word) {
        return Some(Unit::plain(name, *to_nm));
    }
    // The Greek letter counts as the micro sign.
    let lower = word.to_lowercase().replace('\u{3bc}', "\u{b5}");
    let is = |own: &&&str| lower == **own || own.len() >= 5 && lower.starts_with(**own);
    let found = WORDS
        .iter()
        .find(|(own, ..)| own.iter().any(|own| is(&own)));
    found.map(|(_, name, to_nm)| Unit::plain(name, *to_nm))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn nm(name: &str, number: f64) -> f64 {
        Unit::of(name).map_or(f64::NAN, |unit| unit.nm(number))
    }

    /// 500 nm are 0.5 µm, 5000 Å, 20000 cm⁻¹, 2.479684 eV and 599.584916 THz.
    #[test]
    fn five_hundred_nanometers_are_met_in_every_unit() {
        for (name, number) in [
            ("wavelength (nm)", 500.0),
            ("WAVELENGTH (NM)", 500.0),
            ("WavelengthNm", 500.0),
            ("wl_nm", 500.0),
            ("Wellenlänge in nm", 500.0),
            ("Wavelength / nanometers", 500.0),
            ("lambda [mµ]", 500.0),
            ("wavelength (um)", 0.5),
            ("Wavelength [\u{3bc}m]", 0.5),
            ("Wavelength [\u{b5}m]", 0.5),
            ("microns", 0.5),
            ("wavelength_micrometers", 0.5),
            ("Wavelength (Å)", 5000.0),
            ("Wavelength (A)", 5000.0),
            ("Wavelength (\u{212b})", 5000.0),
            ("Angstroms", 5000.0),
            ("wavelength (m)", 5e-7),
            ("wavelength_mm", 5e-4),
            ("Wavenumber (cm-1)", 2e4),
            ("cm^-1", 2e4),
            ("wavenumber [cm⁻¹]", 2e4),
            ("1/cm", 2e4),
            ("Wavenumber", 2e4),
            ("Wavenumber (cm)", 2e4),
            ("wavenumber (1/µm)", 2.0),
            ("Energy (eV)", 2.479_683_968_664),
            ("photonEnergy_eV", 2.479_683_968_664),
            ("E [meV]", 2_479.683_968_664),
            ("frequency (THz)", 599.584_916),
            ("nu_Hz", 599.584_916e12),
        ] {
            let found = nm(name, number);
            assert!((found / 500.0 - 1.0).abs() < 1e-9, "{name}: {found}");
        }
    }

    #[test]
    fn what_names_no_unit_has_none() {
        for name in [
            "wavelength",
            "lambda",
            "λ",
            "frequency",
            "Energy",
            "A1",
            "wavelength (10^-9 m)",
            "Sample",
        ] {
            assert_eq!(Unit::of(name), None, "{name}");
        }
    }

    #[test]
    fn densities_per_another_unit_are_seen() {
        for name in [
            "radiance (W/m2/sr/um)",
            "W m^-2 sr^-1 µm^-1",
            "per eV",
            "W/m2/Hz",
            "W·sr⁻¹·m⁻³",
            "W sr^-1 m^-3",
            "W m-3",
            "W m^{-3}",
            "W/m3/sr",
            "W/m³",
            "W/(sr m^3)",
            "W m-2 sr-1 um-1",
            "W/(m2 sr um)",
            "W/(m²·sr·µm)",
            "W/m² sr µm",
            "erg/s/cm2/A",
            "erg/s/cm2/Å",
            "erg/(s cm^2 A)",
            "erg s-1 cm-2 A-1",
            "erg s⁻¹ cm⁻² Å⁻¹",
            "erg/s/cm³",
        ] {
            assert!(Unit::divides(name), "{name}");
        }
        for name in [
            "radiance (W/m2/sr/nm)",
            "W·m⁻²·sr⁻¹·nm⁻¹",
            "R",
            "uW/cm2/nm",
            "lm/m",
            "mm",
            "W/(m2 sr nm)",
            "W/m² sr",
            "m3",
            "A",
            "Sample A-1",
            "illuminant A",
            "lm/(sr m)",
            "R/T of a film, 5 um",
        ] {
            assert!(!Unit::divides(name), "{name}");
        }
    }
}
