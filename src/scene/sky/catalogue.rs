//! Star catalogs, as tables in text.

use crate::shot::{MOST_STARS, STAR_KELVIN, STAR_MAGNITUDE};
use crate::spectrum::csv::Table;
use glam::DVec3;

/// A star of a catalog.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Star {
    /// Direction to the star: a unit vector.
    pub direction: DVec3,
    /// Temperature, K.
    pub temperature_k: f64,
    /// Visual magnitude.
    pub magnitude: f64,
}

/// Reason why a catalog cannot be used. Lines are counted from 1.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CatalogueError {
    /// There is no star.
    #[error("there is no star in it: expected rows of azimuth, elevation, temperature, magnitude")]
    NoStars,
    /// There are more than [`MOST_STARS`].
    #[error("there are more than {MOST_STARS} stars")]
    TooMany,
    /// A row does not have four fields.
    #[error(
        "line {line}: expected four columns, azimuth and elevation in degrees, temperature in K, visual magnitude; found {found}"
    )]
    Columns {
        /// Line number.
        line: usize,
        /// Number of fields.
        found: usize,
    },
    /// A field is not a number, or not in its range.
    #[error("line {line}: the {what} is `{found}`, expected a number from {from} to {to}")]
    Value {
        /// Line number.
        line: usize,
        /// The column.
        what: &'static str,
        /// The text there.
        found: String,
        /// Least value.
        from: f64,
        /// Greatest value.
        to: f64,
    },
}

impl Star {
    /// Reads a catalog: a [`Table`] of azimuth (degrees, 0 is −z, positive to the right), elevation
    /// (degrees), temperature (K) and visual magnitude.
    ///
    /// # Errors
    /// The first fault.
    pub fn from_csv(text: &str) -> Result<Vec<Self>, CatalogueError> {
        let mut stars = Vec::new();
        let table = Table::new(text);
        for (line, fields) in table.rows() {
            if stars.len() >= MOST_STARS as usize {
                return Err(CatalogueError::TooMany);
            }
            let [azimuth, elevation, kelvin, magnitude] = fields[..] else {
                let found = fields.len();
                return Err(CatalogueError::Columns { line, found });
            };
            let value = |what, field: &str, [from, to]: [f64; 2]| {
                let number = table.number(field).unwrap_or(f64::NAN);
                (from..=to)
                    .contains(&number)
                    .then_some(number)
                    .ok_or_else(|| {
                        let found = field.chars().take(40).collect();
                        CatalogueError::Value {
                            line,
                            what,
                            found,
                            from,
                            to,
                        }
                    })
            };
            let azimuth = value("azimuth", azimuth, [-360.0, 360.0])?.to_radians();
            let elevation = value("elevation", elevation, [-90.0, 90.0])?.to_radians();
            let (sin, cos) = elevation.sin_cos();
            stars.push(Self {
                direction: DVec3::new(azimuth.sin() * cos, sin, -azimuth.cos() * cos).normalize(),
                temperature_k: value("temperature", kelvin, STAR_KELVIN)?,
                magnitude: value("magnitude", magnitude, STAR_MAGNITUDE)?,
            });
        }
        if stars.is_empty() {
            return Err(CatalogueError::NoStars);
        }
        Ok(stars)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn azimuth_is_yaw_and_elevation_is_up() {
        let text = "azimuth_deg, elevation_deg, temperature_K, magnitude\n# nearby\n\n0,0,5772,-26.7\n90,0,3000,1 # red\n-45,30,1e4,2\n0,-90,500,50\n";
        let stars = Star::from_csv(text).unwrap();
        let half = 0.5f64.sqrt();
        let expected = [
            DVec3::NEG_Z,
            DVec3::X,
            DVec3::new(-half * 0.75f64.sqrt(), 0.5, -half * 0.75f64.sqrt()),
            DVec3::NEG_Y,
        ];
        assert_eq!(stars.len(), expected.len());
        for (star, expected) in stars.iter().zip(expected) {
            assert!(star.direction.distance(expected) < 1e-15, "{star:?}");
        }
        assert_eq!(
            (stars[0].temperature_k, stars[0].magnitude),
            (5772.0, -26.7)
        );
    }

    #[test]
    fn a_bad_row_is_told_by_line_and_column() {
        for (text, message) in [
            ("", "there is no star"),
            ("az,el,T,m\n", "there is no star"),
            ("1,2,3000\n", "line 1: expected four columns"),
            (
                "0,0,5000,1\n\n1,2,3000,4,5\n",
                "line 3: expected four columns",
            ),
            (
                "0,91,5000,1",
                "line 1: the elevation is `91`, expected a number from -90 to 90",
            ),
            ("0,0,5000,bright", "line 1: the magnitude is `bright`"),
            (
                "0,0,499,1",
                "line 1: the temperature is `499`, expected a number from 500",
            ),
            ("0,0,inf,1", "line 1: the temperature is `inf`"),
            ("1,0,5000,1\n1,nan,5000,1", "line 2: the elevation is `nan`"),
            ("361;0;5000;1", "line 1: the azimuth is `361`"),
        ] {
            let found = Star::from_csv(text).unwrap_err().to_string();
            assert!(found.starts_with(message), "{found}");
        }
    }
}
