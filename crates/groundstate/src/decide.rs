//! Whether a model can be used: the one decision that all commands share.
//!
//! In: the root file's text and a [`Loader`]. Out: what was read, its faults, and the program that runs. INVARIANT: there is
//! a program if and only if no fault is an error; so a model of which [`check`](crate::check) tells no error is one that
//! [`load`](crate::load) gives, and the other way round. A module has no main rule and need not have one; an `asm` must.

use std::sync::Arc;

use model::{Checked, Loader, Model, PropertyKind};
use program::Program;
use syntax::ast::{self, AstNode};
use syntax::{Diagnostic, SourceFile, Sources, Span};

use crate::fault::run::{missing_main, start};
use crate::has_errors;

/// What the texts of a model come to.
pub(crate) struct Decision {
    /// The model with its faults, those of lowering and of temporal formulas included.
    pub(crate) checked: Checked,
    /// What the machine runs; none where a fault is an error.
    pub(crate) program: Option<Program>,
}

/// Reads and checks a model, lowers it, and reads its temporal properties.
pub(crate) fn decide(root: SourceFile, loader: &mut dyn Loader) -> Decision {
    let mut checked = model::check(root, loader);
    if has_errors(&checked.diagnostics) {
        return Decision { checked, program: None };
    }
    let mut faults: Vec<Diagnostic> = no_main_rule(&checked.model, &checked.sources).into_iter().collect();
    let program = match program::lower(&checked.model) {
        Ok(program) => temporal(program).map_err(|found| faults.extend(found)).ok(),
        Err(found) => {
            faults.extend(found);
            None
        }
    };
    let program = program.filter(|_| faults.is_empty());
    if !faults.is_empty() {
        checked.diagnostics.extend(faults);
        checked.diagnostics.sort_by_key(|fault| (fault.primary.span.file, fault.primary.span.start));
    }
    Decision { checked, program }
}

/// The program again, if its temporal properties have a meaning.
fn temporal(program: Program) -> Result<Program, Vec<Diagnostic>> {
    if !program.properties.iter().any(|property| matches!(property.kind, PropertyKind::Ctl | PropertyKind::Ltl)) {
        return Ok(program);
    }
    let program = Arc::new(program);
    verify::temporal::read::read(&program)?;
    Ok(Arc::unwrap_or_clone(program))
}

/// An `asm` is there to be run; a module to be imported.
fn no_main_rule(model: &Model, sources: &Sources) -> Option<Diagnostic> {
    if model.main.is_some() {
        return None;
    }
    let parse = syntax::parse_asmetal(model.root, &sources.file(model.root).text);
    let machine = ast::SourceFile::cast(parse.syntax())?.machine_name()?;
    let span = machine.name().map_or_else(|| start(model.root), |name| Span::new(model.root, name.text_range()));
    (!machine.is_module()).then(|| missing_main(span))
}
