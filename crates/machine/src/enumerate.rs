//! Ranging over domains and collections: the binders of quantifiers, comprehensions, choose and forall.
//!
//! The order is canonical: enum literals and numbers ascend; elements come in the order in which they were made, the
//! members of sets in the order of values, those of sequences in theirs. Of several binders the leftmost varies slowest.

use std::ops::ControlFlow;
use std::sync::Arc;

use program::{Binder, DomainId, DomainKind, Term, TermId};
use syntax::Span;

use crate::execute::{Executor, Outcome};
use crate::fault::FaultKind;
use crate::value::Value;
use crate::weighed::Items;

/// What is done for each binding.
pub(crate) type Visit<'v, 'a> = dyn FnMut(&mut Executor<'a>) -> Outcome<ControlFlow<()>> + 'v;

/// The elements of a range, not necessarily built.
enum Elements {
    Booleans,
    Enum(DomainId, u32),
    /// Elements `0..count` of an abstract domain, then those of the intermediate state.
    Counted(DomainId, u32, Vec<Value>),
    Listed(Arc<Items>),
}

impl Elements {
    fn len(&self) -> u64 {
        match self {
            Elements::Booleans => 2,
            Elements::Enum(_, count) => u64::from(*count),
            Elements::Counted(_, count, more) => u64::from(*count) + more.len() as u64,
            Elements::Listed(values) => values.len() as u64,
        }
    }

    fn get(&self, index: u64) -> Value {
        match self {
            Elements::Booleans => Value::Boolean(index == 1),
            Elements::Enum(domain, _) => Value::Enum(*domain, index as u32),
            Elements::Counted(domain, count, _) if index < u64::from(*count) => Value::Element(*domain, index as u32),
            Elements::Counted(_, count, more) => more[(index - u64::from(*count)) as usize].clone(),
            Elements::Listed(values) => values[index as usize].clone(),
        }
    }
}

/// The bindings of binders whose ranges do not depend on each other, without building them.
pub(crate) struct Grid {
    /// By binder, how many elements each, the last varying fastest.
    ranges: Vec<Elements>,
    /// How many bindings there are.
    pub len: u64,
}

impl<'a> Executor<'a> {
    /// The bindings of binders, where they can be counted without making them.
    pub fn grid(&mut self, binders: &[Binder]) -> Option<Outcome<Grid>> {
        let domain = |binder: &Binder| matches!(self.program.term(binder.range), Term::Domain(_));
        if !binders.iter().skip(1).all(domain) || binders.iter().any(|binder| self.is_unordered(binder.range)) {
            return None;
        }
        let mut grid = Grid { ranges: Vec::with_capacity(binders.len()), len: 1 };
        for binder in binders {
            // If a range is empty, those after it are not read.
            if grid.len == 0 {
                break;
            }
            match self.range_elements(binder.range) {
                Ok(elements) => {
                    grid.len = grid.len.saturating_mul(elements.len());
                    grid.ranges.push(elements);
                }
                Err(fault) => return Some(Err(fault)),
            }
        }
        Some(Ok(grid))
    }

    /// Binds the binders of a grid as in one of its bindings, by its number.
    pub fn bind_from(&mut self, grid: &Grid, binders: &[Binder], number: u64) {
        let mut rest = number;
        for (binder, range) in binders.iter().zip(&grid.ranges).rev() {
            self.bind(binder.slot, range.get(rest % range.len()));
            rest /= range.len();
        }
    }

    /// Visits every binding of the binders until a visit breaks off.
    pub fn for_each_binding(&mut self, binders: &[Binder], visit: &mut Visit<'_, 'a>) -> Outcome<ControlFlow<()>> {
        let Some((binder, rest)) = binders.split_first() else { return visit(self) };
        let elements = self.range_elements(binder.range)?;
        let visited = self.for_each_element(elements, binder, rest, visit);
        if visited.is_err() && self.is_unordered(binder.range) {
            self.note_order(binder.range);
        }
        visited
    }

    fn for_each_element(
        &mut self,
        elements: Elements,
        binder: &Binder,
        rest: &[Binder],
        visit: &mut Visit<'_, 'a>,
    ) -> Outcome<ControlFlow<()>> {
        let visit_one = |this: &mut Self, visit: &mut Visit<'_, 'a>, value: Value| {
            if this.works(1) {
                this.look(this.program.term_span(binder.range))?;
            }
            this.bind(binder.slot, value);
            if rest.is_empty() { visit(this) } else { this.for_each_binding(rest, visit) }
        };
        match elements {
            Elements::Booleans => {
                for value in [false, true] {
                    if visit_one(self, visit, Value::Boolean(value))?.is_break() {
                        return Ok(ControlFlow::Break(()));
                    }
                }
            }
            Elements::Enum(domain, count) => {
                for index in 0..count {
                    if visit_one(self, visit, Value::Enum(domain, index))?.is_break() {
                        return Ok(ControlFlow::Break(()));
                    }
                }
            }
            Elements::Counted(domain, count, more) => {
                for index in 0..count {
                    if visit_one(self, visit, Value::Element(domain, index))?.is_break() {
                        return Ok(ControlFlow::Break(()));
                    }
                }
                for value in more {
                    if visit_one(self, visit, value)?.is_break() {
                        return Ok(ControlFlow::Break(()));
                    }
                }
            }
            Elements::Listed(values) => {
                for value in values.iter() {
                    if visit_one(self, visit, value.clone())?.is_break() {
                        return Ok(ControlFlow::Break(()));
                    }
                }
            }
        }
        Ok(ControlFlow::Continue(()))
    }

    /// Whether the elements of a range are to be interchangeable.
    #[inline]
    pub fn is_unordered(&self, range: TermId) -> bool {
        self.core.unordered.get(range.0 as usize).is_some_and(|unordered| *unordered)
    }

    /// A fault was met among elements that are to be interchangeable: in another order it might have been another one, or
    /// none. An alternative that is dead has met none.
    #[cold]
    fn note_order(&mut self, range: TermId) {
        if !self.environment.alternatives().is_some_and(|alternatives| alternatives.is_dead()) {
            self.core.order_mattered.get_or_insert(self.program.term_span(range));
        }
    }

    fn range_elements(&mut self, range: TermId) -> Outcome<Elements> {
        let span = self.program.term_span(range);
        if let Term::Domain(domain) = self.program.term(range) {
            return self.domain_elements(*domain, span);
        }
        let value = self.evaluate(range)?;
        match value {
            Value::Set(elements) | Value::Seq(elements) => Ok(Elements::Listed(elements)),
            Value::Bag(counts) => {
                let all = counts.iter().flat_map(|(value, count)| std::iter::repeat_n(value.clone(), *count as usize));
                Ok(Elements::Listed(listed(all.collect())))
            }
            Value::Map(entries) => {
                let pairs = entries.iter().map(|(key, value)| Value::tuple(vec![key.clone(), value.clone()]));
                Ok(Elements::Listed(listed(pairs.collect())))
            }
            Value::Undef => {
                self.fault(span, FaultKind::UndefinedOperand { operation: "ranging over the elements".into() })
            }
            _ => self.fault(span, FaultKind::BadOperand { reason: "only a collection can be ranged over".into() }),
        }
    }

    fn domain_elements(&mut self, domain: DomainId, span: Span) -> Outcome<Elements> {
        let program = self.program;
        match &program.domain(domain).kind {
            DomainKind::Basic(model::Basic::Boolean) => Ok(Elements::Booleans),
            DomainKind::Enum { literals } => Ok(Elements::Enum(domain, literals.len() as u32)),
            DomainKind::Abstract { dynamic, .. } => {
                if self.core.exploring && *dynamic {
                    self.note_carriers();
                }
                let carrier = &self.core.store.carriers[domain.0 as usize];
                Ok(Elements::Counted(domain, carrier.count, carrier.intermediate.clone()))
            }
            DomainKind::Concrete { dynamic: true, .. } => {
                if self.core.exploring {
                    self.note_carriers();
                }
                let carrier = &self.core.store.carriers[domain.0 as usize];
                let elements = carrier.elements.iter().chain(&carrier.intermediate).cloned().collect();
                Ok(Elements::Listed(listed(elements)))
            }
            DomainKind::Concrete { .. } => match &self.core.contents[domain.0 as usize] {
                Some(elements) => Ok(Elements::Listed(Arc::clone(elements))),
                None => self.fault(span, FaultKind::NotEnumerable { domain }),
            },
            DomainKind::Prod(parts) => {
                let mut columns = Vec::new();
                let mut size = 1u64;
                for part in parts {
                    let column = self.listed(*part, span)?;
                    size = size.saturating_mul(column.len() as u64);
                    columns.push(column);
                }
                self.check_size(size, span)?;
                Ok(Elements::Listed(listed(product(&columns))))
            }
            DomainKind::Powerset(of) => {
                let elements = self.listed(*of, span)?;
                let size = 1u64.checked_shl(elements.len() as u32).unwrap_or(u64::MAX);
                // Each element is in half of the subsets.
                let leaves = size.saturating_mul(elements.len() as u64 / 2);
                self.check_size(if elements.len() >= 64 { u64::MAX } else { size.max(leaves) }, span)?;
                Ok(Elements::Listed(listed(subsets(&elements))))
            }
            _ => self.fault(span, FaultKind::NotEnumerable { domain }),
        }
    }

    /// The elements of a domain, built, in canonical order.
    pub fn listed(&mut self, domain: DomainId, span: Span) -> Outcome<Arc<Items>> {
        Ok(match self.domain_elements(domain, span)? {
            Elements::Booleans => listed(vec![Value::Boolean(false), Value::Boolean(true)]),
            Elements::Enum(domain, count) => listed((0..count).map(|index| Value::Enum(domain, index)).collect()),
            Elements::Counted(domain, count, more) => {
                self.check_size(u64::from(count), span)?;
                listed((0..count).map(|index| Value::Element(domain, index)).chain(more).collect())
            }
            Elements::Listed(values) => values,
        })
    }
}

fn listed(values: Vec<Value>) -> Arc<Items> {
    Arc::new(Items::new(values))
}

fn product(columns: &[Arc<Items>]) -> Vec<Value> {
    let mut rows = vec![Vec::with_capacity(columns.len())];
    for column in columns {
        rows = extended(rows, column);
    }
    rows.into_iter().map(Value::tuple).collect()
}

/// Each row with each value of one more column, the last column fastest.
pub fn extended<T: Clone>(rows: Vec<Vec<T>>, column: &[T]) -> Vec<Vec<T>> {
    let longer = |row: Vec<T>| {
        column.iter().map(move |value| {
            let mut longer = row.clone();
            longer.push(value.clone());
            longer
        })
    };
    rows.into_iter().flat_map(longer).collect()
}

fn subsets(elements: &[Value]) -> Vec<Value> {
    let mut sets: Vec<Value> = (0..1u64 << elements.len())
        .map(|mask| {
            let chosen = elements.iter().enumerate().filter(|(i, _)| mask >> i & 1 == 1);
            Value::set(chosen.map(|(_, value)| value.clone()).collect())
        })
        .collect();
    sets.sort_unstable();
    sets
}
