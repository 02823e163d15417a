//! `MODEL.verify.yaml` against its model: the form of the file, its bounds, its terms.
//!
//! In: an [`Overlay`] of the model, and the text. Out: all faults. The overlay holds the file and its terms afterwards.

use inputs::{bound, verification};
use program::PropertyKind;
use syntax::{Diagnostic, SourceFile, Span};

use crate::Overlay;

/// The faults of a text against its model: its own, and those of its terms; `name` is what its texts are shown under.
pub fn check_verification(asked: &mut Overlay, name: &str, text: &str) -> Vec<Diagnostic> {
    let file = asked.add(SourceFile::new(name, text));
    let wanted = match verification::read(file, text) {
        Ok(wanted) => wanted,
        Err(fault) => return vec![*fault],
    };
    // LIMIT: the lines of bounds and of `fair` are not kept.
    let whole = |message: String| *verification::fault(Span { file, start: 0, end: 0 }, message);
    let mut faults = Vec::new();
    if let Err(refused) = bound::read(&asked.program, &wanted.bounds) {
        faults.push(whole(format!("--bound {refused}")));
    }
    if wanted.fair.as_deref().is_some_and(|fair| !["weak", "strong"].contains(&fair)) {
        faults.push(whole("`fair` is neither weak nor strong".to_string()));
    }
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
