//! Why a formula is not true: the values of the locations and functions that it reads.
//!
//! In: an expression and a machine in the state in which it was evaluated. Out: the parts of it that are locations
//! or derived functions without variables in their arguments, with their values. Of a conjunction only the parts
//! that are not true count.

use machine::{Environment, Machine, Value};
use program::{Builtin, Expression, Program, Term, TermId};
use syntax::Span;

/// A part of a formula and its value.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Reading {
    /// Its place.
    pub span: Span,
    /// Its value.
    pub value: Value,
}

/// LIMIT: this many readings say enough.
const READINGS: usize = 8;

/// The two sides of an equation.
pub(crate) fn sides(program: &Program, expression: &Expression) -> Option<(TermId, TermId)> {
    match program.term(expression.body) {
        Term::Builtin { builtin: Builtin::Eq, arguments } => match program.term_list(*arguments) {
            [left, right] => Some((*left, *right)),
            _ => None,
        },
        _ => None,
    }
}

/// Part of an expression, to be evaluated by itself.
pub(crate) fn part(expression: &Expression, term: TermId) -> Expression {
    Expression { body: term, ..expression.clone() }
}

/// The values of what a formula reads.
pub fn explain(machine: &mut Machine, environment: &mut dyn Environment, expression: &Expression) -> Vec<Reading> {
    let program = std::sync::Arc::clone(machine.program());
    let mut explanation = Explanation { machine, environment, program: &program, expression, readings: Vec::new() };
    explanation.formula(expression.body);
    explanation.readings
}

struct Explanation<'a> {
    machine: &'a mut Machine,
    environment: &'a mut dyn Environment,
    program: &'a Program,
    expression: &'a Expression,
    readings: Vec<Reading>,
}

impl Explanation<'_> {
    fn formula(&mut self, term: TermId) {
        if let Term::Builtin { builtin: Builtin::And, arguments } = self.program.term(term) {
            for conjunct in self.program.term_list(*arguments) {
                if self.value(*conjunct) != Some(Value::Boolean(true)) {
                    self.formula(*conjunct);
                }
            }
        } else {
            self.reads(term);
        }
    }

    fn reads(&mut self, term: TermId) {
        if self.readings.len() >= READINGS {
            return;
        }
        let shown = match self.program.term(term) {
            Term::Read { function, .. } => self.program.function(*function).element.is_none(),
            Term::Define { function, .. } => !self.program.function(*function).library,
            _ => false,
        };
        if shown && closed(self.program, term) {
            let span = self.program.term_span(term);
            if let Some(value) = self.value(term)
                && !self.readings.iter().any(|reading| reading.span == span)
            {
                self.readings.push(Reading { span, value });
            }
        }
        let mut children = Vec::new();
        self.program.each_child_of_term(term, &mut |child| children.push(child));
        children.into_iter().for_each(|child| self.reads(child));
    }

    fn value(&mut self, term: TermId) -> Option<Value> {
        let expression = part(self.expression, term);
        self.machine.evaluate(&expression, self.environment).ok()
    }
}

/// Whether a term has a value by itself: it reads no variable that is bound outside it. Bindings inside a term that is
/// shown are rare, so any variable at all counts.
fn closed(program: &Program, term: TermId) -> bool {
    let mut open = vec![term];
    while let Some(id) = open.pop() {
        if matches!(program.term(id), Term::Slot(_)) {
            return false;
        }
        program.each_child_of_term(id, &mut |child| open.push(child));
    }
    true
}
