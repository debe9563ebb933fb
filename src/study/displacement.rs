//! shim
use super::StudyError;
use super::findings::Percentiles;
use super::subject::{Subject, Variant};
pub(super) fn displacement(
    _: &Variant,
    _: &Variant,
    _: &Subject,
) -> Result<(Percentiles, f64), StudyError> {
    Ok((Percentiles::default(), 0.0))
}
