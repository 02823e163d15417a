//! What an inductive proof consists of: obligations, what solvers said of each, and why it is not whole.
//!
//! INVARIANT: an obligation counts as accepted only on the word of two solvers, that the formula cannot be satisfied; a check of sense (that
//! a formula can be) on that of one, if none denies it. It must not know how any of this is told.

use machine::Fault;
use solve::Outside;

use crate::why::Differs;

/// LIMIT: so many solvers must accept each obligation.
pub const SOLVERS: usize = 2;

/// What a solver said of a formula.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Said {
    /// It can be satisfied.
    Possible,
    /// It cannot.
    Impossible,
    /// It does not know.
    Unknown,
    /// It did not answer in time.
    Late,
    /// It failed: a clause.
    Broken(String),
}

/// A formula that solvers were asked about.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Obligation {
    /// A word or two: "step 1 matched".
    pub name: String,
    /// What holds if it is accepted, as a sentence.
    pub claim: String,
    /// The question, as SMT-LIB.
    pub script: String,
    /// It is a check of sense: the formula is to be satisfiable.
    pub sense: bool,
    /// What each solver said, in the order of [`Proof::solvers`].
    pub said: Vec<Said>,
}

impl Obligation {
    /// Whether it is settled as it should be.
    pub fn is_accepted(&self) -> bool {
        let count = |wanted: &Said| self.said.iter().filter(|said| *said == wanted).count();
        match self.sense {
            true => count(&Said::Possible) > 0 && count(&Said::Impossible) == 0,
            false => count(&Said::Impossible) == self.said.len() && self.said.len() >= SOLVERS,
        }
    }

    /// Whether solvers contradict each other.
    pub fn is_contradicted(&self) -> bool {
        self.said.contains(&Said::Possible) && self.said.contains(&Said::Impossible)
    }
}

/// Whose text something stands in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Origin {
    /// A machine's.
    Side(usize),
    /// The coupling's.
    Coupling,
}

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
