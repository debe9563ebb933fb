//! A knob of accuracy before it is measured.

use crate::render::View;
use crate::study::displacement::Displacement;
use crate::study::timed_render::Variant;

/// Displacement between the views of a reference and of a setting, for an image of this size.
type Displaced = fn(&View<'_>, &View<'_>, [u32; 2]) -> Displacement;

/// A knob before it is measured.
pub(in crate::study) struct Knob {
    pub(in crate::study) key: &'static str,
    pub(in crate::study) what: &'static str,
    pub(in crate::study) phase: &'static str,
    pub(in crate::study) reference: &'static str,
    pub(in crate::study) note: Option<String>,
    pub(in crate::study) variants: Vec<Variant>,
    /// References, one per family or one for all.
    pub(in crate::study) references: Vec<Variant>,
    /// How displacements are measured, if surfaces move.
    pub(in crate::study) displacement: Option<Displaced>,
    /// Whether the settings differ in the files only.
    pub(in crate::study) files: bool,
}

impl Knob {
    pub(in crate::study) fn new(
        key: &'static str,
        phase: &'static str,
        what: &'static str,
    ) -> Self {
        Self {
            key,
            what,
            phase,
            reference: "",
            note: None,
            variants: Vec::new(),
            references: Vec::new(),
            displacement: None,
            files: false,
        }
    }

    /// The index of the reference against which a variant is measured.
    pub(in crate::study) fn reference_of(&self, variant: &Variant) -> usize {
        let same = |reference: &Variant| reference.family == variant.family;
        self.references.iter().position(same).unwrap_or(0)
    }
}
