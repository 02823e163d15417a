//! Encodes the ranges of binders: elements, each with the condition that it is in the range.
//!
//! LIMIT: the bindings of one rule or term.

use machine::Value;
use program::{Binder, Term, TermId};
use std::sync::Arc;
use syntax::Span;

use super::{Encoder, FaultClass, Result, elements};
use crate::shared::{Node, Terms};
use crate::symbol::{Open, Shape, Symbol};

const BINDINGS: usize = 50_000;
/// LIMIT: how many numbers a range with unknown ends may have.
const WIDE: i128 = 1000;

impl Encoder {
    /// All bindings of some binders, in canonical order.
    pub(super) fn bindings(&mut self, binders: &[Binder]) -> Result<Vec<(Node, Vec<Symbol>)>> {
        let mut all = vec![(Terms::TRUE, Vec::new())];
        for binder in binders {
            let mut longer = Vec::new();
            for (present, values) in all {
                self.bind_all(binders, &values);
                let range = self.under(present, |this| this.range(binder.range))?.unwrap_or_default();
                for (more, value) in range {
                    let both = self.terms.and([present, more]);
                    if both != Terms::FALSE {
                        let mut row = values.clone();
                        row.push(value);
                        longer.push((both, row));
                    }
                }
                if longer.len() > BINDINGS {
                    let span = self.program.term_span(binder.range);
                    return self.outside(format!("a range of more than {BINDINGS} bindings"), span);
                }
            }
            all = longer;
        }
        Ok(all)
    }

    pub(super) fn bind_all(&mut self, binders: &[Binder], values: &[Symbol]) {
        for (binder, value) in binders.iter().zip(values) {
            self.bind(binder.slot, value.clone());
        }
    }

    /// The elements of a range.
    fn range(&mut self, range: TermId) -> Result<Vec<(Node, Symbol)>> {
        let program = Arc::clone(&self.program);
        let span = program.term_span(range);
        if let Term::Domain(domain) = program.term(range) {
            let elements = match self.free {
                Some(_) => self.elements_if_closed(*domain),
                None => self.machine.elements(*domain).ok(),
            };
            return match elements {
                Some(values) => Ok(values.into_iter().map(|value| (Terms::TRUE, Symbol::Known(value))).collect()),
                None => self.outside(format!("a range over all of {}", program.domain(*domain).name), span),
            };
        }
        let value = self.evaluate(range)?;
        if let Some(elements) = elements(&value) {
            return Ok(elements);
        }
        let known = |value: &Value| (Terms::TRUE, Symbol::Known(value.clone()));
        match value {
            Symbol::Known(Value::Seq(values)) => Ok(values.iter().map(known).collect()),
            Symbol::Known(Value::Undef) => {
                self.fault(FaultClass::Undefined, Terms::TRUE);
                Ok(Vec::new())
            }
            _ => self.outside("a range over such a collection", span),
        }
    }

    /// The integers between two ends.
    pub(super) fn range_between(&mut self, low: TermId, high: TermId, span: Span) -> Result<Vec<(Node, Symbol)>> {
        let (low, high) = (self.evaluate(low)?, self.evaluate(high)?);
        let (low, high) = (self.integer_operand(&low, span)?, self.integer_operand(&high, span)?);
        let ((Some(first), _), (_, Some(last))) = (self.terms.bounds(low), self.terms.bounds(high)) else {
            return self.outside("a range without known ends", span);
        };
        if last - first >= WIDE {
            return self.outside("a range that may be very long", span);
        }
        let mut numbers = Vec::new();
        for number in first..=last {
            let value = self.terms.integer(number);
            let both = [self.terms.at_most(low, value), self.terms.at_most(value, high)];
            let present = self.terms.and(both);
            let open = Open { shape: Shape::Integer, value, defined: Terms::TRUE };
            numbers.push((present, self.symbol(open)));
        }
        numbers.retain(|(present, _)| *present != Terms::FALSE);
        Ok(numbers)
    }

    /// All elements of a domain, if they can be listed and are not too many.
    pub(super) fn elements_of(&mut self, domain: program::DomainId) -> Option<Vec<Value>> {
        if self.free.is_some() {
            return self.elements_if_closed(domain);
        }
        let known = self.machine.elements(domain).ok()?;
        (known.len() <= BINDINGS).then_some(known)
    }
}
