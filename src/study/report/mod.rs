//! shim
use super::Study;
/// shim
pub fn html(study: &Study) -> String {
    json(study)
}
/// shim
pub fn csv(study: &Study) -> String {
    json(study)
}
/// shim
pub fn json(study: &Study) -> String {
    serde_json::to_string_pretty(study).unwrap_or_default()
}
