//! Observes what happens within steps, to find out whether everything happens at least once.
//!
//! In: the steps that a machine makes while it is watched. Out: [`Observation`]s, each once. For a guard that connects
//! several conditions, the observation has the truth of each that was evaluated. INVARIANT: watching evaluates nothing
//! else. There is one exception: a step whose updates clash goes on to its end, to see what else clashes. Evaluation and
//! rules report through [`crate::watch`].

use program::{Builtin, DomainId, FunctionId, Program, RuleId, Term, TermId};
use rustc_hash::{FxHashMap, FxHashSet};

use crate::fault::Fault;

/// LIMIT: for a guard with more conditions, only its branches are observed.
pub const CONDITIONS: usize = 32;

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
pub struct Observations {
    /// The main rule is running.
    on: bool,
    /// In the order in which they came; known ones left out.
    step: Vec<Observation>,
    known: FxHashSet<Observation>,
    pub(crate) conditions: FxHashMap<TermId, Vec<TermId>>,
    /// The conditions of the guard being evaluated.
    pub(crate) truths: Vec<(TermId, bool)>,
    /// The first clash of the step. The step goes on to find all other clashes; nothing else is observed from then on.
    pub(crate) clash: Option<Box<Fault>>,
}

impl Observations {
    /// Whether a step is being watched.
    pub(crate) fn is_on(&self) -> bool {
        self.on
    }

    /// A step begins.
    pub fn begin(&mut self) {
        self.step.clear();
        (self.clash, self.on) = (None, true);
    }

    /// It ends; gives the first clash of one that has gone on after it.
    pub fn end(&mut self) -> Option<Box<Fault>> {
        self.on = false;
        self.clash.take()
    }

    /// What was seen in it, and was not known.
    pub fn take(&mut self) -> Vec<Observation> {
        std::mem::take(&mut self.step)
    }

    /// Marks something as observed, so that it is not reported again; true if it was new.
    pub fn learn(&mut self, observation: Observation) -> bool {
        self.known.insert(observation)
    }

    pub(crate) fn note(&mut self, observation: Observation) {
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

pub(crate) fn connects(builtin: Builtin) -> bool {
    use Builtin::{And, Iff, Implies, Not, Or, Xor};
    matches!(builtin, And | Or | Implies | Not | Xor | Iff)
}
