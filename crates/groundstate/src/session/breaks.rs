//! What stops a run: rules, commands of a scenario, changed locations, each with a condition; faults and violated invariants.
//!
//! In: a moment. Out: what of it is to stop the run. A condition that cannot be evaluated stops it, too: whoever wrote it wants to
//! know.

use std::collections::BTreeSet;
use std::sync::Arc;

use machine::{Change, Location, Value};
use program::{Expression, FunctionId, Program, RuleId};
use syntax::Span;

/// Where a break is.
#[derive(Debug, Clone)]
pub enum On {
    /// One of these rules ran.
    Rules(BTreeSet<RuleId>),
    /// One of these commands comes next.
    Commands(Vec<Span>),
    /// This location changed.
    Location(Location),
    /// A location of this function changed.
    Function(FunctionId),
}

/// Something that stops the run.
#[derive(Debug, Clone)]
pub struct Break {
    /// Its number.
    pub id: u64,
    /// Where.
    pub on: On,
    /// It stops only where this holds.
    pub condition: Option<Expression>,
}

/// All that stops the run.
#[derive(Debug, Clone, Default)]
pub struct Breaks {
    /// The breaks.
    pub list: Vec<Break>,
    /// The program with the conditions, if there are any.
    pub program: Option<Arc<Program>>,
    /// Whether a fault, or a command of a scenario that fails, stops it.
    pub faults: bool,
    /// Whether a violated invariant does.
    pub violations: bool,
}

/// What stopped the run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Hit {
    /// These breaks.
    Breaks(Vec<u64>),
    /// A fault, a failed check or a violated invariant.
    Wrong,
}

/// What happened, as far as it may stop a run.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Happened<'a> {
    pub ran: &'a [RuleId],
    pub changes: &'a [Change],
    pub next: Option<Span>,
    pub faults: bool,
    pub violations: bool,
}

impl Breaks {
    /// What of this stops the run. `holds` evaluates a condition; none if it cannot be evaluated.
    pub(crate) fn hit(
        &self,
        happened: Happened<'_>,
        holds: &mut dyn FnMut(&Expression) -> Option<Value>,
    ) -> Option<Hit> {
        if self.faults && happened.faults || self.violations && happened.violations {
            return Some(Hit::Wrong);
        }
        let mut hit = Vec::new();
        for Break { id, on, condition } in &self.list {
            let is_there = match on {
                On::Rules(rules) => happened.ran.iter().any(|rule| rules.contains(rule)),
                On::Commands(places) => happened.next.is_some_and(|next| places.contains(&next)),
                On::Location(location) => happened.changes.iter().any(|change| change.location == *location),
                On::Function(function) => happened.changes.iter().any(|change| change.location.function == *function),
            };
            let stops =
                |condition: &Expression| !matches!(holds(condition), Some(Value::Boolean(false) | Value::Undef));
            if is_there && condition.as_ref().is_none_or(stops) {
                hit.push(*id);
            }
        }
        (!hit.is_empty()).then_some(Hit::Breaks(hit))
    }
}
