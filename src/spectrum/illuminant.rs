//! The CIE's illuminants, by name.
//!
//! Relative power per nm, 1 at 560 nm. The tables cover 300 or 380 to 780 nm in steps of 5 nm, as
//! published; between entries the curve is linear, beyond them it is constant.

use super::daylight::relative;
use super::planck::C2;

pub use super::daylight::UNIT_AT_NM;
use super::{PlanckShape, Spectrum};
use crate::color::tables;

/// The names that [`illuminant`] knows.
pub const NAMES: &[&str] = &["A", "C", "D50", "D55", "D65", "D75", "E", "F2", "F7", "F11"];

/// Temperature of illuminant A, K.
///
/// It is defined by Planck's law at 2848 K with c₂ = 1.435e-2 m·K, a value since replaced (CIE
/// S 014-2:2006): by ours the same curve is at 2855.5 K, known as 2856 K.
pub const A_KELVIN: f64 = 2848.0 * C2 / 1.435e7;

/// An illuminant of the CIE; None if there is none of that name.
///
/// A is Planck's curve and E is constant at every wavelength; the others are [`Sampled`](super::Sampled).
pub fn illuminant(name: &str) -> Option<Spectrum> {
    let table = match name {
        "A" => {
            let shape = PlanckShape {
                temperature_k: A_KELVIN,
                unit_at_nm: UNIT_AT_NM,
            };
            return Some(Spectrum::Planck(shape));
        }
        "E" => return Some(Spectrum::Constant(1.0)),
        "C" => tables::C,
        "D50" => tables::D50,
        "D55" => tables::D55,
        "D65" => tables::D65,
        "D75" => tables::D75,
        "F2" => tables::F2,
        "F7" => tables::F7,
        "F11" => tables::F11,
        _ => return None,
    };
    Some(Spectrum::Sampled(relative(&table)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::cie;

    #[test]
    fn every_illuminant_is_one_at_560_nm_and_holds_its_end() {
        for name in NAMES {
            let curve = illuminant(name).unwrap();
            assert_eq!(curve.at(560.0), 1.0, "{name}");
            if let Spectrum::Sampled(_) = curve {
                assert_eq!(curve.at(780.0), curve.at(1e300), "{name}");
            }
        }
        assert!(illuminant("d65").is_none());
    }

    /// Values of the CIE's own table of illuminant A, relative to 100 at 560 nm.
    #[test]
    fn illuminant_a_is_a_black_body_at_2856_kelvin() {
        let a = illuminant("A").unwrap();
        for (nm, published) in [
            (300.0, 0.930483),
            (380.0, 9.79510),
            (500.0, 59.8611),
            (780.0, 241.675),
        ] {
            assert!(
                (100.0 * a.at(nm) / published - 1.0).abs() < 1e-5,
                "{nm} {}",
                a.at(nm)
            );
        }
        assert!((A_KELVIN - 2856.0).abs() < 1.0);
    }

    /// CIE 15:2004, table T.3 (1931 2°), to the four digits printed there.
    #[test]
    fn illuminants_have_their_published_chromaticities() {
        for (name, x, y) in [
            ("A", 0.44758, 0.40745),
            ("C", 0.31006, 0.31616),
            ("D50", 0.34567, 0.35851),
            ("D55", 0.33243, 0.34744),
            ("D65", 0.31272, 0.32903),
            ("D75", 0.29903, 0.31488),
            ("F2", 0.3721, 0.3751),
            ("F7", 0.3129, 0.3292),
            ("F11", 0.3805, 0.3769),
        ] {
            let curve = illuminant(name).unwrap();
            let [big_x, big_y, big_z] = cie::xyz_of(|nm| curve.at(nm));
            let sum = big_x + big_y + big_z;
            let error = (big_x / sum - x).abs().max((big_y / sum - y).abs());
            // Published are sums at 5 nm; F11's mercury lines add up otherwise at 1 nm.
            assert!(error < 3e-4, "{name} {error}");
        }
    }
}
