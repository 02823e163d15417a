//! What a step takes from outside: values of monitored locations, choices, the clock.

use program::{DomainId, Program};
use syntax::Span;

use crate::location::LocationRef;
use crate::value::Value;

/// A unit of the clock.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum TimeUnit {
    /// 10⁻⁹ s
    Nanoseconds,
    /// 10⁻³ s
    Milliseconds,
    /// 1 s
    Seconds,
}

/// A choice to be made.
#[derive(Debug)]
pub struct Choice<'a> {
    /// The choose rule, or the term `chooseone(…)`.
    pub span: Span,
    /// The values of the bound variables, candidate after candidate, in canonical order.
    pub values: &'a [Value],
    /// How many variables are bound: the number of values of one candidate, at least one.
    pub variables: usize,
}

impl Choice<'_> {
    /// How many candidates there are, at least one.
    pub fn candidates(&self) -> usize {
        self.values.len() / self.variables
    }

    /// The values of the bound variables of one candidate.
    pub fn candidate(&self, index: usize) -> &[Value] {
        &self.values[index * self.variables..(index + 1) * self.variables]
    }
}

/// The environment of a run. Each location is asked for at most once a step.
pub trait Environment {
    /// The value of a monitored location in the coming step, or of a shared one that has none yet. An error is a
    /// sentence for the user.
    fn monitored(&mut self, program: &Program, location: LocationRef<'_>, codomain: DomainId) -> Result<Value, String>;

    /// The index of the candidate chosen.
    fn choose(&mut self, program: &Program, choice: &Choice<'_>) -> Result<usize, String>;

    /// The clock.
    fn time(&mut self, unit: TimeUnit) -> Result<i64, String>;
}

/// An environment that gives nothing: every monitored location is an error, the first candidate is chosen, the
/// clock stands at 0.
#[derive(Debug, Default, Clone, Copy)]
pub struct Closed;

impl Environment for Closed {
    fn monitored(
        &mut self,
        program: &Program,
        location: LocationRef<'_>,
        _codomain: DomainId,
    ) -> Result<Value, String> {
        Err(format!("no value is given for the monitored location {}", location.show(program)))
    }

    fn choose(&mut self, _program: &Program, _choice: &Choice<'_>) -> Result<usize, String> {
        Ok(0)
    }

    fn time(&mut self, _unit: TimeUnit) -> Result<i64, String> {
        Ok(0)
    }
}
