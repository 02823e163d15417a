//! The library functions on values (spec/standard-library.md).
//!
//! In: a builtin and its operands. Out: a value, or a fault where the function is not defined: an undefined
//! operand, an index outside, a result beyond 64 bits. Each file owns the functions of a few domains.

mod collection;
mod number;
mod sequence;
mod text;

use std::sync::Arc;

use model::Basic;
use program::{Builtin, DomainKind, TermId};
use syntax::Span;

use crate::environment::{Choice, TimeUnit};
use crate::execute::{Executor, Outcome};
use crate::fault::FaultKind;
use crate::print::Show;
use crate::value::{Real, Value};

/// Why a builtin has no value, before its place is known.
pub(crate) enum Trouble {
    Undefined,
    Bad(String),
    Zero,
    Overflow(String),
    NotANumber(String),
}

/// What a builtin gives.
pub(crate) type Result<T = Value> = std::result::Result<T, Trouble>;

/// A function of its operands' values alone; none where the builtin is none of these.
fn of_values(builtin: Builtin, operands: &[Value]) -> Option<Result> {
    number::apply(builtin, operands)
        .or_else(|| text::apply(builtin, operands))
        .or_else(|| sequence::apply(builtin, operands))
        .or_else(|| collection::apply(builtin, operands))
}

impl<'a> Executor<'a> {
    /// Applies a builtin to values.
    #[inline(never)]
    pub fn apply(&mut self, builtin: Builtin, operands: &[Value], id: TermId) -> Outcome<Value> {
        let span = self.program.term_span(id);
        self.work_of_applying(builtin, operands, span)?;
        let outcome = match builtin {
            Builtin::Eq => Ok(Value::Boolean(operands[0] == operands[1])),
            Builtin::Neq => Ok(Value::Boolean(operands[0] != operands[1])),
            Builtin::IsDef => Ok(Value::Boolean(!operands[0].is_undef())),
            Builtin::IsUndef => Ok(Value::Boolean(operands[0].is_undef())),
            // Printing is the shells' business; the value of `print` is 1.
            Builtin::Print => Ok(Value::Integer(1)),
            Builtin::ToString => Ok(Value::string(match &operands[0] {
                Value::String(text) => text.to_string(),
                Value::Char(c) => c.to_string(),
                other => other.show(self.program).to_string(),
            })),
            Builtin::Not => Ok(match &operands[0] {
                Value::Boolean(b) => Value::Boolean(!b),
                _ => Value::Undef,
            }),
            Builtin::Xor | Builtin::Iff => match (&operands[0], &operands[1]) {
                (Value::Boolean(a), Value::Boolean(b)) => Ok(Value::Boolean((a == b) == (builtin == Builtin::Iff))),
                _ => Err(Trouble::Undefined),
            },
            Builtin::Program => {
                return Ok(self.agent_program(&operands[0]).map_or(Value::Undef, Value::Rule));
            }
            Builtin::AgentId => match &operands[0] {
                Value::Undef => Err(Trouble::Undefined),
                agent => Ok(Value::string(agent.show(self.program).to_string())),
            },
            Builtin::GetAgent => Ok(self.agent_named(&operands[0])),
            Builtin::ChooseOne => return self.choose_one(&operands[0], span),
            Builtin::TimeNanoseconds => return self.clock(TimeUnit::Nanoseconds, span),
            Builtin::TimeMilliseconds => return self.clock(TimeUnit::Milliseconds, span),
            Builtin::TimeSeconds => return self.clock(TimeUnit::Seconds, span),
            Builtin::Temporal(_) => return self.fault(span, FaultKind::Temporal),
            Builtin::SetSum | Builtin::SeqSum | Builtin::BagSum if collection::is_empty(&operands[0]) => {
                Ok(self.zero(id))
            }
            _ => of_values(builtin, operands).unwrap_or(Err(Trouble::Undefined)),
        };
        match outcome {
            Ok(value) => {
                self.check_made(&value, span)?;
                Ok(value)
            }
            Err(trouble) => self.trouble(trouble, builtin, operands, span),
        }
    }

    /// The zero of the domain of a term: the sum of no numbers.
    fn zero(&self, id: TermId) -> Value {
        let domain = self.program.base_domain(self.program.term_domain(id));
        match self.program.domain(domain).kind {
            DomainKind::Basic(Basic::Real) => Real::new(0.0).map_or(Value::Undef, Value::Real),
            DomainKind::Basic(Basic::Complex) => {
                Real::new(0.0).map_or(Value::Undef, |zero| Value::Complex(Arc::new((zero, zero))))
            }
            _ => Value::Integer(0),
        }
    }

    #[cold]
    fn trouble(&self, trouble: Trouble, builtin: Builtin, operands: &[Value], span: Span) -> Outcome<Value> {
        let name = builtin.name();
        let kind = match trouble {
            Trouble::Undefined if operands.iter().any(Value::is_undef) => {
                FaultKind::UndefinedOperand { operation: format!("`{name}`") }
            }
            Trouble::Undefined => {
                let shown: Vec<String> =
                    operands.iter().map(|value| value.show(self.program).briefly().to_string()).collect();
                FaultKind::BadOperand { reason: format!("`{name}` is not defined on ({})", shown.join(", ")) }
            }
            Trouble::Bad(reason) => FaultKind::BadOperand { reason },
            Trouble::Zero => FaultKind::DivisionByZero,
            Trouble::Overflow(operation) => FaultKind::Overflow { operation },
            Trouble::NotANumber(operation) => FaultKind::NotANumber { operation },
        };
        self.fault(span, kind)
    }

    /// The agent that is declared under the name: an element of `Agent` or of a subset of it.
    fn agent_named(&self, name: &Value) -> Value {
        let Value::String(name) = name else { return Value::Undef };
        let agents = self.program.functions.iter().filter_map(|function| {
            let base = self.program.base_domain(function.codomain);
            let element = function.element.filter(|_| self.program.domain(base).name == "Agent")?;
            Some((&function.name, Value::Element(base, element)))
        });
        agents.filter(|(known, _)| *known == &**name).map(|(_, agent)| agent).next().unwrap_or(Value::Undef)
    }

    /// `chooseone(S)`: an element chosen by the environment; undef of an empty set.
    fn choose_one(&mut self, set: &Value, span: Span) -> Outcome<Value> {
        let Value::Set(elements) = set else { return self.undefined_operand("`chooseone`", span) };
        if elements.is_empty() {
            return Ok(Value::Undef);
        }
        let choice = Choice { span, values: elements, variables: 1 };
        match self.core.choices.choose(self.environment, self.program, &choice) {
            Ok(chosen) if chosen < elements.len() => Ok(elements[chosen].clone()),
            Ok(chosen) => {
                let reason = format!("choice {chosen} of {} candidates does not exist", elements.len());
                self.fault(span, FaultKind::Environment { reason })
            }
            Err(reason) => self.fault(span, FaultKind::Environment { reason }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_builtin_is_computed_somewhere() {
        use Builtin::*;
        for builtin in Builtin::ALL.iter().copied().filter(|builtin| builtin.info().effect.is_none()) {
            let above =
                matches!(builtin, Eq | Neq | IsDef | IsUndef | Print | ToString | Not | Xor | Iff | AgentId | GetAgent);
            // Their operands are evaluated one after the other.
            let lazy = matches!(builtin, And | Or | Implies);
            let operands = vec![Value::Undef; builtin.arity().unwrap_or(1)];
            let found = of_values(builtin, &operands).is_some();
            assert!(found || above || lazy, "{builtin:?} is computed nowhere");
        }
    }
}
