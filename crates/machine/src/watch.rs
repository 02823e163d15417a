//! Notes what happens within a step that is watched: see [`crate::observe`].
//!
//! In: the rules, guards and locations that a step reaches. INVARIANT: a guard is evaluated as in a step that is not
//! watched: from the left, and no further than needed.

use program::{Builtin, FunctionId, RuleId, Term, TermId};

use crate::execute::{Core, Executor, Outcome};
use crate::fault::FaultKind;
use crate::observe::{CONDITIONS, Observation, Truths, conditions_of, connects};
use crate::value::Value;

impl Core {
    /// A rule runs.
    #[inline]
    pub fn ran(&mut self, rule: RuleId) {
        if let Some(coverage) = &mut self.coverage {
            coverage.ran(rule);
            self.note(Observation::Ran(rule));
        }
    }

    /// How a rule went, see [`crate::Coverage`].
    #[inline]
    pub fn went(&mut self, rule: RuleId, outcome: usize) {
        if let Some(coverage) = &mut self.coverage {
            coverage.went(rule, outcome);
            self.note(Observation::Went(rule, outcome as u8));
        }
    }

    /// Notes that something happens, if the step is watched.
    #[inline]
    pub fn note(&mut self, observation: Observation) {
        if let Some(observations) = &mut self.observations {
            observations.note(observation);
        }
    }

    /// The number of a location that keeps it for good.
    fn lasting(&self, found: Option<u32>) -> Option<u32> {
        found.filter(|index| self.store.is_lasting(*index))
    }

    /// A location is read.
    #[cold]
    pub fn note_read(&mut self, function: FunctionId, arguments: &[Value]) {
        let found = self.lasting(self.store.find(function, arguments));
        self.note(Observation::Read(function, found));
    }

    /// A location is written.
    #[cold]
    pub fn note_update(&mut self, function: FunctionId, index: u32, value: &Value) {
        self.note(Observation::Wrote(function, self.lasting(Some(index))));
        if let (Value::Enum(domain, from), Value::Enum(_, to)) = (&self.store.values[index as usize], value) {
            self.note(Observation::Turned(*domain, *from, *to));
        }
    }
}

impl Executor<'_> {
    /// The truth of a rule's guard; a fault where it is undef.
    #[inline]
    pub fn decide(&mut self, guard: TermId) -> Outcome<bool> {
        match self.core.observations {
            None => self.holds(guard),
            Some(_) => self.decide_watched(guard),
        }
    }

    #[cold]
    fn decide_watched(&mut self, guard: TermId) -> Outcome<bool> {
        let program = self.program;
        let Some(observations) = &mut self.core.observations else { return self.holds(guard) };
        observations.truths.clear();
        let conditions = observations.conditions.entry(guard).or_insert_with(|| conditions_of(program, guard)).clone();
        if conditions.len() < 2 || conditions.len() > CONDITIONS {
            return self.holds(guard);
        }
        let Value::Boolean(outcome) = self.evaluate_watched(guard)? else {
            return self.fault(program.term_span(guard), FaultKind::UndefinedGuard);
        };
        let mut truths = Truths { known: 0, truth: 0, outcome };
        if let Some(observations) = &mut self.core.observations {
            for (condition, truth) in observations.truths.drain(..) {
                let place = conditions.iter().position(|known| *known == condition).expect("a condition of the guard");
                truths.known |= 1 << place;
                truths.truth |= u32::from(truth) << place;
            }
        }
        self.core.note(Observation::Decided(guard, truths));
        Ok(outcome)
    }

    /// The value of a part of a guard, with the truth of each condition noted.
    fn evaluate_watched(&mut self, id: TermId) -> Outcome<Value> {
        let program = self.program;
        if let Term::Builtin { builtin, arguments } = program.term(id)
            && connects(*builtin)
        {
            return match (builtin, program.term_list(*arguments)) {
                (Builtin::And | Builtin::Or, [left, right]) => {
                    self.and_or(*builtin, *left, *right, Self::evaluate_watched)
                }
                (Builtin::Implies, [premise, conclusion]) => {
                    self.implication(*premise, *conclusion, Self::evaluate_watched)
                }
                (_, operands) => {
                    let values = operands.iter().map(|operand| self.evaluate_watched(*operand));
                    let values: Vec<Value> = values.collect::<Outcome<_>>()?;
                    self.apply(*builtin, &values, id)
                }
            };
        }
        let value = self.evaluate(id)?;
        if let (Value::Boolean(truth), Some(observations)) = (&value, &mut self.core.observations) {
            observations.truths.push((id, *truth));
        }
        Ok(value)
    }
}
