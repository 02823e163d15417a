//! What is said of a refinement: the verdict, how far the search came, what was assumed.

use std::collections::BTreeMap;

use explore::Unbounded;
use machine::Cause;
use program::FunctionId;
use solve::Outside;
use syntax::Span;

use crate::evidence::Refutation;
use crate::formulas::obligation::{Origin, Said};
use crate::induction::proof::Proof;
use crate::preserve::Preserved;

/// How far the search is.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Progress {
    /// Pairs found.
    pub pairs: u64,
    /// Pairs that have to be looked at.
    pub queue: u64,
    /// States of the abstract and of the concrete machine.
    pub states: [u64; 2],
    /// Different steps of the abstract and of the concrete machine.
    pub steps: [u64; 2],
}

/// Why it is not known.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Why {
    /// The limit of pairs was reached.
    Pairs(u64),
    /// The limit of steps was reached.
    Steps(u64),
    /// The caller asked to stop, or memory is full.
    Stopped(Cause),
    /// A step of a machine cannot be gone through.
    Unbounded(usize, Unbounded),
    /// A segment has more steps than diagrams may have.
    Long(u32),
    /// An input that the concrete machine does not look at has too many values.
    Valuations,
    /// The relation holds of so many pairs of states that were compared, and perhaps of every two states.
    Undistinguished(usize),
    /// A machine looks at an input, of which bounds leave out values.
    Bounded(usize, FunctionId),
    /// An inductive proof is not whole; its gap says why.
    Unproved,
    /// Solvers found no run that refutes; [`Runs`] says how far they looked.
    NoRun,
}

/// Why the answer would say nothing.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Vacuous {
    /// No initial states correspond; the parts of the relation that fail of the best pair.
    NoInitialPair(Box<Refutation>),
    /// The concrete machine makes no step that changes its state.
    NoStep,
    /// No run of the concrete machine is fair.
    NoFairRun,
    /// The assumptions leave the concrete machine no step.
    NoneLeft,
    /// The relation holds of every two states.
    Total,
    /// A machine has no initial state that its assumptions admit.
    NoStart(usize),
}

/// Why solvers did not look at longer runs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Left {
    /// Something is outside of what solvers are told, or there are too many answers of the abstract machine.
    Outside(Origin, Outside),
    /// In a run of so many steps the concrete machine may do what solvers are not told of.
    Beyond(u64, Outside),
    /// Not all solvers decide about runs of so many steps: what each said.
    Silent(u64, Vec<Said>),
    /// A solver found a run of so many steps that the machines do not make, or that refutes nothing.
    Odd(u64),
    /// A solver found a run of so many steps that the machines could not make again, for this reason.
    Unclear(u64, Why),
    /// The caller asked to stop.
    Stopped,
}

/// What solvers looked at of runs from the initial states.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Runs {
    /// The solvers, with their versions.
    pub solvers: Vec<String>,
    /// All of them say that no run of at most so many concrete steps is refuted.
    pub depth: u64,
    /// The steps of a run that is refuted and was made again, and the solver that found it.
    pub found: Option<(u64, String)>,
    /// If a proof fails at an obligation: a run of so many steps comes to a pair from which it fails, in the word of this solver.
    pub reached: Option<(u64, String)>,
    /// All solvers say that no run of at most so many steps comes to such a pair.
    pub apart: Option<u64>,
    /// Why longer runs were not looked at; none if the limit of steps was reached.
    pub left: Option<Left>,
}

/// The verdict.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Verdict {
    /// Every run of the concrete machine corresponds to one of the abstract machine.
    Refines,
    /// It does not, by this relation and these diagrams.
    DoesNot(Box<Refutation>),
    /// Not known.
    Unknown(Vec<Why>),
    /// The question says nothing.
    Vacuous(Vacuous),
}

/// What the verdict relies on: an assumption about one of the machines.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Assumed {
    /// The machine.
    pub side: usize,
    /// The name of the INVAR or its text, or what is assumed of an input.
    pub name: String,
    /// Where it is said.
    pub from: From,
}

/// Where an assumption is said.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum From {
    /// There, in the texts of the machine.
    Text(Span),
    /// In a file of this name.
    File(String),
}

/// See the module.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Report {
    /// The verdict.
    pub verdict: Verdict,
    /// How far the search came.
    pub progress: Progress,
    /// How often each diagram, of so many abstract and concrete steps, was used by the answers found.
    pub diagrams: BTreeMap<(u32, u32), u64>,
    /// The assumptions.
    pub assumed: Vec<Assumed>,
    /// The abstract machine makes no step that changes its state.
    pub idle: bool,
    /// In so many concrete states that were met the assumptions leave no step: a run ends there.
    pub dead_ends: u64,
    /// If it refines: the properties of the abstract machine, and whether they come along.
    pub properties: Vec<Preserved>,
    /// If it was to be proved by induction: how far the proof came.
    pub proof: Option<Box<Proof>>,
    /// If solvers looked for runs that refute: how far.
    pub runs: Option<Box<Runs>>,
}
