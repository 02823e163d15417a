//! What an inductive proof consists of: obligations that solvers were asked about, what is known of each pair, and why it is not whole.
//!
//! It is data alone. It must not know how any of this is told.

use machine::Fault;
use solve::Outside;

use crate::formulas::obligation::{Obligation, Origin};
use crate::why::Differs;

/// What the abstract machine could do in a pair of states from which the proof does not go on.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Attempt {
    /// How many steps it makes.
    pub m: u32,
    /// The parts of the coupling that do not hold then; none if its step cannot be made, or the variant does not decrease.
    pub parts: Vec<String>,
    /// All parts hold, but the variant is negative or does not decrease, or there is none.
    pub stands: bool,
}

/// A pair of states that corresponds and from which an obligation fails. It may be one that no runs reach.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Stuck {
    /// The locations of both states that matter, with their values.
    pub states: [Differs; 2],
    /// By concrete step: the inputs, and what it changes.
    pub steps: Vec<(Differs, Differs)>,
    /// What happens: a fault's kind in words, or none if nothing matches.
    pub fault: Option<String>,
    /// What the abstract machine could do.
    pub tried: Vec<Attempt>,
    /// By side, the faults that the machine comes to in this pair: the concrete one in its last step, the abstract one in its first.
    pub faults: [Vec<Fault>; 2],
}

/// Why a proof is not whole.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Gap {
    /// Something is outside of what solvers are told.
    Outside(Origin, Outside),
    /// An obligation fails, by its index: from this pair of states.
    Stuck(usize, Box<Stuck>),
    /// Solvers contradict each other about an obligation.
    Contradicted(usize),
    /// No solver said that an obligation fails, and not all accept it.
    Silent(usize),
    /// All was accepted, by one solver alone.
    Alone,
    /// The caller asked to stop.
    Stopped,
}

/// An invariant of one of the models.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Known {
    /// The model.
    pub side: usize,
    /// The invariant.
    pub name: String,
    /// Why it is no hypothesis, as a clause; none if it was proved and is one.
    pub unused: Option<String>,
}

/// A proof, or how far it came.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Proof {
    /// The solvers, with their versions.
    pub solvers: Vec<String>,
    /// In the order in which they were asked.
    pub obligations: Vec<Obligation>,
    /// The invariants of both models: what of them is known of each pair.
    pub known: Vec<Known>,
    /// The diagrams that answers use, as numbers of abstract and of concrete steps.
    pub diagrams: Vec<(u32, u32)>,
    /// Why it is not whole, if it is not.
    pub gap: Option<Gap>,
}
