//! What happens within steps, for whoever wants to know whether everything has happened at least once.
//!
//! In: the steps that a machine makes while it is watched. Out: [`Observation`]s, each once. A guard that connects several
//! conditions is told with the truth of each, as far as they were evaluated. INVARIANT: watching changes no step: nothing
//! is evaluated that would not be anyway, but that a step whose updates clash is made to its end to see what else does.

use program::{Builtin, DomainId, FunctionId, Program, RuleId, Term, TermId};
use rustc_hash::{FxHashMap, FxHashSet};

use crate::execute::{Core, Executor, Outcome};
use crate::fault::{Fault, FaultKind};
use crate::value::Value;

/// LIMIT: of a guard with more conditions only its branches are told.
const CONDITIONS: usize = 32;

/// The truth of the conditions of a guard and of the guard itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Truths {
    /// By condition, one bit: it was evaluated, and was true or false.
    pub known: u32,
    /// By condition, one bit: it was true.
    pub truth: u32,
    /// The guard was true.
    pub outcome: bool,
}

/// Something that happened in a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Observation {
    /// A rule ran.
    Ran(RuleId),
    /// How it went, see [`crate::Coverage`].
    Went(RuleId, u8),
    /// A guard of several conditions was decided; the conditions are those of [`conditions_of`].
    Decided(TermId, Truths),
    /// A location was read: the function and, where it is dense, the location's number.
    Read(FunctionId, Option<u32>),
    /// A location was written, perhaps with the value that it had.
    Wrote(FunctionId, Option<u32>),
    /// An update put one literal of an enum domain in the place of another, by their numbers.
    Turned(DomainId, u32, u32),
    /// Two updates clashed.
    Clashed(RuleId, RuleId),
}

/// The observations of the step being made, and those known already.
#[derive(Debug, Default)]
pub(crate) struct Observations {
    /// The main rule is running.
    pub on: bool,
    /// In the order in which they came; known ones left out.
    pub step: Vec<Observation>,
    pub known: FxHashSet<Observation>,
    conditions: FxHashMap<TermId, Vec<TermId>>,
    /// The conditions of the guard being evaluated.
    truths: Vec<(TermId, bool)>,
    /// The first clash of the step. It goes on, so that all others are seen; nothing else is from then on.
    pub clash: Option<Box<Fault>>,
}

impl Observations {
    fn note(&mut self, observation: Observation) {
        let counts = self.clash.is_none() || matches!(observation, Observation::Clashed(..));
        if self.on && counts && !self.known.contains(&observation) && !self.step.contains(&observation) {
            self.step.push(observation);
        }
    }
}

/// The conditions that a guard connects by `and`, `or`, `not`, `implies`, `xor`, `iff`, in the order of the text.
pub fn conditions_of(program: &Program, guard: TermId) -> Vec<TermId> {
    match program.term(guard) {
        Term::Builtin { builtin, arguments } if connects(*builtin) => {
            program.term_list(*arguments).iter().flat_map(|operand| conditions_of(program, *operand)).collect()
        }
        _ => vec![guard],
    }
}

fn connects(builtin: Builtin) -> bool {
    use Builtin::{And, Iff, Implies, Not, Or, Xor};
    matches!(builtin, And | Or | Implies | Not | Xor | Iff)
}

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

    /// Something happens that is to be told if somebody watches.
    #[inline]
    pub fn note(&mut self, observation: Observation) {
        if let Some(observations) = &mut self.observations {
            observations.note(observation);
        }
    }

    /// The number of a location that keeps it for good.
    fn lasting(&self, found: Option<u32>) -> Option<u32> {
        let dense = (self.store.len() - self.store.sparse_len()) as u32;
        found.filter(|index| *index < dense)
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
