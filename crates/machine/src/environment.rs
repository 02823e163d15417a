//! What a step gets from outside: values of monitored locations, choices, the clock.

use program::{DomainId, Program};
use syntax::Span;

use crate::alternatives::Alternatives;
use crate::location::LocationRef;
use crate::value::{Real, Value};

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
        match self.variables {
            1 => self.values.len(),
            many => self.values.len() / many,
        }
    }

    /// The values of the bound variables of one candidate.
    pub fn candidate(&self, index: usize) -> &[Value] {
        &self.values[index * self.variables..(index + 1) * self.variables]
    }
}

/// A number to be drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Draw {
    /// The choose rule.
    pub span: Span,
    /// Which of the variables it binds the number is for, from 0.
    pub variable: usize,
    /// Integer, Natural or Real.
    pub basic: model::Basic,
}

impl Draw {
    /// A number of the domain: 0, 1, −1, 2, −2 …; of the Naturals 0, 1, 2 ….
    pub fn number(&self, index: u32) -> Value {
        let index = i64::from(index);
        let number = match self.basic {
            model::Basic::Natural => index,
            _ if index % 2 == 0 => -index / 2,
            _ => index / 2 + 1,
        };
        match self.basic {
            model::Basic::Real => Real::new(number as f64).map_or(Value::Undef, Value::Real),
            _ => Value::Integer(number),
        }
    }

    /// Whether a value is a number of the domain.
    pub fn admits(&self, value: &Value) -> bool {
        match (self.basic, value) {
            (model::Basic::Natural, Value::Integer(number)) => *number >= 0,
            (model::Basic::Integer, Value::Integer(_)) | (model::Basic::Real, Value::Real(_)) => true,
            _ => false,
        }
    }
}

/// The environment of a run. A step asks for each location at most once.
pub trait Environment {
    /// The value of a monitored location in the coming step, or of a shared one that has none yet. An error is a
    /// sentence for the user.
    fn monitored(&mut self, program: &Program, location: LocationRef<'_>, codomain: DomainId) -> Result<Value, String>;

    /// Whether a monitored location that has an initial value keeps it instead of being asked for. In a run it does
    /// not; in a scenario it does until it is set.
    fn keeps_initial(&self, _location: LocationRef<'_>) -> bool {
        false
    }

    /// The index of the candidate chosen.
    fn choose(&mut self, program: &Program, choice: &Choice<'_>) -> Result<usize, String>;

    /// A number for a variable that a choose rule without a guard binds over all Integers, Naturals or Reals. The
    /// [`Choice`] that follows has it in each candidate. This one is always 0.
    fn number(&mut self, _program: &Program, draw: &Draw) -> Result<Value, String> {
        Ok(draw.number(0))
    }

    /// Whether this number is fixed beforehand, so that even one that a guard would have to be searched for is given.
    fn picks(&self, _draw: &Draw) -> bool {
        false
    }

    /// A choose rule has no candidate. An error is a sentence for the user, who had one in mind.
    fn no_candidate(&mut self, _program: &Program, _choose: Span) -> Result<(), String> {
        Ok(())
    }

    /// A step of [`crate::Machine::pass`] was made; what is asked next belongs to the one after it.
    fn step_made(&mut self) {}

    /// The clock.
    fn time(&mut self, unit: TimeUnit) -> Result<i64, String>;

    /// The explorer, if every alternative is wanted, not one.
    fn alternatives(&mut self) -> Option<&mut dyn Alternatives> {
        None
    }
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
