//! Checks `MODEL.verify.yaml` against its model: the file's form, its bounds, its terms.
//!
//! In: an [`Overlay`] of the model, and the text. Out: all faults. Afterwards the overlay holds the file and its terms.

use inputs::{Scalar, verification};
use program::{Expression, Program, PropertyKind};
use syntax::{Diagnostic, SourceFile};

use crate::Overlay;

/// The faults of a specification's text and of its terms; messages show the text under `name`.
pub fn check_verification(asked: &mut Overlay, name: &str, text: &str) -> Vec<Diagnostic> {
    check_terms(asked, name, text, &|_, _| None)
}

/// The same, where a term may be refused although it has no faults; `refusal` then says why.
pub(crate) fn check_terms(
    asked: &mut Overlay,
    name: &str,
    text: &str,
    refusal: &dyn Fn(&Program, &Expression) -> Option<String>,
) -> Vec<Diagnostic> {
    let file = asked.add(SourceFile::new(name, text));
    let wanted = match verification::read(file, text) {
        Ok(wanted) => wanted,
        Err(fault) => return vec![*fault],
    };
    let mut faults = wanted.faults(&asked.program);
    let refuse = |scalar: &Scalar, program: &Program, expression: &Expression| {
        refusal(program, expression).map(|reason| *verification::fault(scalar.span(), format!("this {reason}")))
    };
    let kinds = [PropertyKind::Invariant, PropertyKind::Ctl, PropertyKind::Ltl];
    let properties =
        kinds.iter().zip(&wanted.properties).flat_map(|(kind, texts)| texts.iter().map(|text| (*kind, text)));
    for (kind, text) in wanted.assumptions.iter().map(|text| (PropertyKind::Invar, text)).chain(properties) {
        match asked.property(kind, name, text) {
            Ok(()) => {
                let added = asked.program.properties.last();
                faults.extend(added.and_then(|property| refuse(text, &asked.program, &property.formula)));
            }
            Err(found) => faults.extend(found),
        }
    }
    if let Some(text) = &wanted.terminal {
        match asked.ask(name, text) {
            Ok(term) => faults.extend(refuse(text, &asked.program, &term)),
            Err(found) => faults.extend(found),
        }
    }
    faults
}
