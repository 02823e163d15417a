//! Decides whether a model can be used; all commands share this decision.
//!
//! In: the root file's text and a [`Loader`]. Out: the texts, the faults, and the program to run. INVARIANT: there is a
//! program if and only if no fault is an error. So [`load`](crate::load) accepts a model exactly if
//! [`check`](crate::check) reports no error. An `asm` must have a main rule; a module need not. A
//! file in which nothing stands is neither.

use std::sync::Arc;

use model::{Checked, Loader, Model, PropertyKind};
use program::Program;
use syntax::ast::{self, AstNode};
use syntax::{Diagnostic, SourceFile, Sources, Span};

use crate::fault::run::{missing_main, no_model, start};
use crate::has_errors;

/// The result of reading a model's texts.
pub(crate) struct Decision {
    /// The model with its faults, including those of lowering and of temporal formulas.
    pub(crate) checked: Checked,
    /// The program to run; `None` if a fault is an error.
    pub(crate) program: Option<Program>,
}

/// Reads and checks a model, lowers it, and reads its temporal properties.
pub(crate) fn decide(root: SourceFile, loader: &mut dyn Loader) -> Decision {
    let mut checked = model::check(root, loader);
    if has_errors(&checked.diagnostics) || loader.stop().is_asked() {
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

/// Returns the program if its temporal properties have a meaning.
fn temporal(program: Program) -> Result<Program, Vec<Diagnostic>> {
    if !program.properties.iter().any(|property| matches!(property.kind, PropertyKind::Ctl | PropertyKind::Ltl)) {
        return Ok(program);
    }
    let program = Arc::new(program);
    verify::temporal::read::read(&program)?;
    Ok(Arc::unwrap_or_clone(program))
}

/// Reports an `asm` without a main rule, and a file without a model. A module needs no main rule: it is only imported.
fn no_main_rule(model: &Model, sources: &Sources) -> Option<Diagnostic> {
    if model.main.is_some() {
        return None;
    }
    let parse = syntax::parse_asmetal(model.root, &sources.file(model.root).text);
    let Some(machine) = ast::SourceFile::cast(parse.syntax())?.machine_name() else {
        return Some(no_model(model.root));
    };
    let span = machine.name().map_or_else(|| start(model.root), |name| Span::new(model.root, name.text_range()));
    (!machine.is_module()).then(|| missing_main(span))
}
