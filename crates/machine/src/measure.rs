//! Counts the work of a step and compares it with the limits: see [`crate::work`].
//!
//! In: the repeated work of a rule or term, and the values that it makes. Out: a fault if that exceeds the limits, or if the
//! step is asked to stop.

use std::cmp::min;

use program::{Builtin, LooksThrough};
use syntax::Span;

use crate::execute::{Executor, Outcome};
use crate::fault::FaultKind;
use crate::value::Value;
use crate::work::INTERVAL;

/// LIMIT: collections and tuples in each other. Whatever walks through a value does so by recursion.
const NESTED: u32 = 1000;
/// Members that are copied or looked through in the time of one binding.
const MEMBERS: u64 = 8;

impl Executor<'_> {
    /// Counts work; whether it is time to look.
    #[inline]
    pub fn works(&mut self, amount: u64) -> bool {
        let work = &mut self.core.work;
        work.done += amount;
        work.done >= work.look
    }

    /// Counts work done at a place.
    #[inline]
    pub fn work(&mut self, amount: u64, span: Span) -> Outcome<()> {
        if self.works(amount) { self.look(span) } else { Ok(()) }
    }

    /// Looks whether the step is to end.
    #[cold]
    pub fn look(&mut self, span: Span) -> Outcome<()> {
        if let Some(cause) = self.limits.interrupt.cause() {
            return self.fault(span, FaultKind::Interrupted(cause));
        }
        let done = self.core.work.done;
        if done > self.limits.work {
            let limit = "bindings and calls in one step";
            return self.fault(span, FaultKind::Limit { limit, value: self.limits.work });
        }
        self.core.work.look = min(done.saturating_add(INTERVAL), self.limits.work.saturating_add(1));
        Ok(())
    }

    /// Keeps a value that was made within the limits of size, and counts the making.
    #[inline]
    pub fn check_made(&mut self, value: &Value, span: Span) -> Outcome<()> {
        if value.is_scalar() { Ok(()) } else { self.check_compound(value, span) }
    }

    #[inline(never)]
    fn check_compound(&mut self, value: &Value, span: Span) -> Outcome<()> {
        let weight = value.weight();
        self.check_size(weight.leaves, span)?;
        if weight.depth > NESTED {
            return self.fault(span, FaultKind::Limit { limit: "values inside each other", value: u64::from(NESTED) });
        }
        let members = match value {
            Value::Tuple(items) | Value::Seq(items) | Value::Set(items) => items.len() as u64,
            Value::Bag(counts) => counts.len() as u64,
            Value::Map(entries) => entries.len() as u64,
            Value::String(text) => {
                self.check_size(text.len() as u64, span)?;
                text.len() as u64 / 16
            }
            _ => 1,
        };
        self.work(members / MEMBERS, span)
    }

    /// Counts a comparison.
    #[inline]
    pub fn work_of_comparing(&mut self, left: &Value, right: &Value, span: Span) -> Outcome<()> {
        if left.is_scalar() || right.is_scalar() {
            return Ok(());
        }
        self.work(min(left.weight().leaves, right.weight().leaves) / MEMBERS, span)
    }

    /// Counts what a library function looks through without making anything of that size.
    #[inline]
    pub fn work_of_applying(&mut self, builtin: Builtin, operands: &[Value], span: Span) -> Outcome<()> {
        match (builtin.info().looks_through, operands) {
            (LooksThrough::Both, [left, right]) => self.work_of_comparing(left, right, span),
            (LooksThrough::First, [first, ..]) => self.work(first.weight().leaves / MEMBERS, span),
            (LooksThrough::Nothing | LooksThrough::First | LooksThrough::Both, _) => Ok(()),
        }
    }
}
