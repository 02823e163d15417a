//! Checks `MODEL.verify.yaml` against its model: the file's form, its bounds, its terms.
//!
//! In: an [`Overlay`] of the model, and the text. Out: all faults. Afterwards the overlay holds the file and its terms.

use inputs::verification;
use program::PropertyKind;
use syntax::{Diagnostic, SourceFile};

use crate::Overlay;

/// The faults of a specification's text and of its terms; messages show the text under `name`.
pub fn check_verification(asked: &mut Overlay, name: &str, text: &str) -> Vec<Diagnostic> {
    let file = asked.add(SourceFile::new(name, text));
    let wanted = match verification::read(file, text) {
        Ok(wanted) => wanted,
        Err(fault) => return vec![*fault],
    };
    let mut faults = wanted.faults(&asked.program);
    let kinds = [PropertyKind::Invariant, PropertyKind::Ctl, PropertyKind::Ltl];
    let properties =
        kinds.iter().zip(&wanted.properties).flat_map(|(kind, texts)| texts.iter().map(|text| (*kind, text)));
    for (kind, text) in wanted.assumptions.iter().map(|text| (PropertyKind::Invar, text)).chain(properties) {
        faults.extend(asked.property(kind, name, text).err().into_iter().flatten());
    }
    if let Some(text) = &wanted.terminal {
        faults.extend(asked.ask(name, text).err().into_iter().flatten());
    }
    faults
}
