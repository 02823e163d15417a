//! The terms of a report specification: checked against a model, evaluated in each state.
//!
//! In: terms with their places. Out: the values that changed, to the [`ReportBuilder`].

use std::collections::BTreeMap;
use std::sync::Arc;

use machine::{Closed, Machine, Show, Value};
use program::Expression;
use report::{ReportBuilder, TermPlace, specification_fault};
use syntax::ast::{AstNode, TermFile};
use syntax::{Diagnostic, Span};

use crate::{Overlay, has_errors};

/// The terms, lowered, and their last values.
#[derive(Debug)]
pub struct Watch {
    terms: Vec<Expression>,
    values: Vec<Value>,
}

impl Watch {
    /// Checks the terms against the model and adds them to its program. Their text stands at `places`.
    pub fn new(
        asked: &mut Overlay,
        terms: &[String],
        places: &BTreeMap<String, TermPlace>,
    ) -> Result<Watch, Vec<Diagnostic>> {
        let mut lowered = Vec::new();
        let mut faults = Vec::new();
        for text in terms {
            match lower(asked, text, &places[text]) {
                Ok(term) => lowered.push(term),
                // A term with `{}` stands for many; its faults are reported once.
                Err(found) => found.into_iter().for_each(|fault| {
                    if !faults.contains(&fault) {
                        faults.push(fault);
                    }
                }),
            }
        }
        if !faults.is_empty() {
            return Err(faults);
        }
        let values = vec![Value::Undef; lowered.len()];
        Ok(Watch { terms: lowered, values })
    }

    /// The terms.
    pub fn into_terms(self) -> Vec<Expression> {
        self.terms
    }

    /// Evaluates the terms in the present state. A term that cannot be evaluated, for want of an input, is undef.
    pub fn look(&mut self, machine: &mut Machine, builder: &mut ReportBuilder) {
        self.changed(machine, &mut |index, value| builder.set(index, value));
    }

    /// The same, with each term whose value has changed.
    pub fn changed(&mut self, machine: &mut Machine, tell: &mut dyn FnMut(usize, &str)) {
        for (index, (term, last)) in self.terms.iter().zip(&mut self.values).enumerate() {
            let value = machine.evaluate(term, &mut Closed).unwrap_or(Value::Undef);
            if value != *last {
                tell(index, &value.show(machine.program()).to_string());
                *last = value;
            }
        }
    }
}

fn lower(asked: &mut Overlay, text: &str, place: &TermPlace) -> Result<Expression, Vec<Diagnostic>> {
    let file = place.span.file;
    let parsed = syntax::parse_term(file, text);
    if has_errors(&parsed.diagnostics) {
        return Err(within(parsed.diagnostics, place));
    }
    let Some(term) = TermFile::cast(parsed.syntax()).and_then(|file| file.term()) else {
        return Err(vec![specification_fault(place.span, "a term is expected")]);
    };
    let fragment = Arc::make_mut(&mut asked.model).check_term(file, &term);
    if has_errors(&fragment.diagnostics) {
        return Err(within(fragment.diagnostics, place));
    }
    let program = Arc::make_mut(&mut asked.program);
    let lowered = program::lower_term(program, &asked.model, &fragment.item, &fragment.variables);
    lowered.map_err(|faults| within(faults, place))
}

/// Faults of a term, at their places in the file.
fn within(mut faults: Vec<Diagnostic>, place: &TermPlace) -> Vec<Diagnostic> {
    let put = |span: &mut Span| {
        if span.file == place.span.file {
            *span = place.part(span.start..span.end);
        }
    };
    for fault in &mut faults {
        put(&mut fault.primary.span);
        fault.secondary.iter_mut().for_each(|label| put(&mut label.span));
    }
    faults
}
