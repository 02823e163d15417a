//! The coupling of two machines: which pairs of states correspond, which inputs are the same, where segments end.
//!
//! In: two programs, the statements of a coupling file. Out: a [`Coupling`], or the faults of the file. Terms are checked in the joint
//! model ([`crate::joint`]) as if the file were blank around them, so that faults stand at their places. INVARIANT: a coupling relates
//! states alone, never inputs; each input that the abstract machine reads has a counterpart, a value, or is free.

use std::sync::Arc;

use program::{Expression, FunctionId, Program, Property};
use rustc_hash::FxHashMap;
use syntax::{Diagnostic, FileId, Sources, Span};

use crate::ABSTRACT;
use crate::diagram::Diagrams;
use crate::joint::Joint;

/// A part of the coupling relation.
#[derive(Debug, Clone)]
pub(crate) enum Conjunct {
    /// A function of both machines that has the same values in both.
    Same {
        name: String,
        functions: [FunctionId; 2],
        /// The arguments, in the joint model, if they can be listed.
        arguments: Option<Vec<Vec<machine::Value>>>,
    },
    /// A term.
    Term { text: String, formula: Expression },
}

/// A condition that is true in infinitely many steps of the runs that count.
#[derive(Debug, Clone)]
pub(crate) struct Fair {
    pub term: FairTerm,
    /// It looks at inputs of the step.
    pub in_step: bool,
}

/// What a [`Fair`] condition is.
#[derive(Debug, Clone)]
pub(crate) enum FairTerm {
    /// A term of the joint model over the concrete machine, and its text in the coupling.
    Said(String, Expression),
    /// A `JUSTICE` of the concrete model.
    Own(Property),
}

/// From this number on conditions of fairness are numbered as if they were inputs of the abstract machine.
const FAIR: u32 = 1 << 31;

/// The number of a condition where inputs have theirs.
pub(crate) fn number_of_fair(index: usize) -> u32 {
    FAIR + index as u32
}

/// Whether the number of an input is that of a condition of fairness.
pub(crate) fn is_fair(input: u32) -> bool {
    input >= FAIR
}

/// A function of both machines that is not compared where the coupling says nothing.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LeftOut {
    /// Its name.
    pub name: String,
    /// Why.
    pub why: Incomparable,
}

/// Why functions of one name are not compared by default.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Incomparable {
    /// The abstract and the concrete one have so many arguments.
    Arguments([usize; 2]),
    /// A domain of the abstract one, and what the concrete one has there.
    Domains([String; 2]),
    /// Arguments are in this domain, of which a machine makes elements.
    Made(String),
}

/// Why a text is no coupling of two machines.
#[derive(Debug)]
pub struct Faulty {
    /// The texts that the faults stand in.
    pub sources: Sources,
    /// At least one.
    pub faults: Vec<Diagnostic>,
}

/// See the module.
pub struct Coupling {
    /// The two programs, with terms that read what the coupling reads.
    pub(crate) programs: [Arc<Program>; 2],
    pub(crate) joint: Joint,
    pub(crate) conjuncts: Vec<Conjunct>,
    pub(crate) segment: Option<Expression>,
    /// The diagrams that are allowed.
    pub diagrams: Diagrams,
    /// By side and input: the inputs of the abstract machine that have its value.
    pub(crate) shared: [FxHashMap<FunctionId, Vec<u32>>; 2],
    /// Inputs of the abstract machine that are terms over the concrete state.
    pub(crate) given: Vec<(u32, Expression)>,
    /// Inputs of the abstract machine that are terms over the concrete state and the concrete machine's inputs.
    pub(crate) computed: Vec<(u32, Expression)>,
    pub(crate) readers: [FxHashMap<FunctionId, Expression>; 2],
    /// The concrete machine may go on for ever without a step of the abstract one.
    pub waiting: bool,
    /// Runs of the concrete machine are looked at as far as its numbers have 64 bits.
    pub overflow: bool,
    /// What is true again and again in the runs of the concrete machine by which it is asked whether the abstract one stands still.
    pub(crate) fair: Vec<Fair>,
    /// What decreases with each diagram without an abstract step, as the file has it.
    pub(crate) variant: Option<(String, Expression)>,
    /// The functions that have equal values by default or by `same`.
    pub same: Vec<String>,
    /// The functions of both machines that are not compared by default.
    pub left_out: Vec<LeftOut>,
    /// Inputs that are free, and inputs that have the same value in both.
    pub free: Vec<String>,
    /// The inputs that have the same value in both machines.
    pub inputs: Vec<String>,
    /// The file, which faults of the whole point to.
    pub file: FileId,
}

impl std::fmt::Debug for Coupling {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Coupling").field("conjuncts", &self.conjuncts).finish_non_exhaustive()
    }
}

impl Coupling {
    /// The texts that faults of the coupling stand in.
    pub fn sources(&self) -> &Sources {
        &self.joint.sources
    }

    /// A conjunct of the relation as a user would write it.
    pub fn conjunct(&self, index: usize) -> String {
        match &self.conjuncts[index] {
            Conjunct::Same { name, functions, .. } => {
                let of = |other: &&Conjunct| matches!(other, Conjunct::Same { name: other, .. } if other == name);
                let program = &self.programs[ABSTRACT];
                let domains = program.function(functions[ABSTRACT]).parameters.iter();
                let domains: Vec<&str> = domains.map(|domain| &*program.domain(*domain).name).collect();
                match self.conjuncts.iter().filter(of).count() > 1 && !domains.is_empty() {
                    true => format!("abstract.{name} = concrete.{name}, of {}", domains.join(", ")),
                    false => format!("abstract.{name} = concrete.{name}"),
                }
            }
            Conjunct::Term { text, .. } => in_a_line(text),
        }
    }

    /// The variant as a user would write it.
    pub fn variant(&self) -> Option<String> {
        self.variant.as_ref().map(|(text, _)| in_a_line(text))
    }

    /// A condition of fairness in words, and where it is said.
    pub(crate) fn fairness(&self, fair: usize) -> (String, Span) {
        match &self.fair[fair].term {
            FairTerm::Said(text, _) => (format!("again and again: {}", in_a_line(text)), start(self.file)),
            FairTerm::Own(justice) => (justice.name.clone(), justice.span),
        }
    }

    /// How many conjuncts there are.
    pub fn conjuncts(&self) -> usize {
        self.conjuncts.len()
    }
}

fn in_a_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The beginning of a file.
pub(crate) fn start(file: FileId) -> Span {
    Span { file, start: 0, end: 0 }
}
