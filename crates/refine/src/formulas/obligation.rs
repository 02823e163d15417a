//! What solvers were asked, and what they said of it.
//!
//! INVARIANT: an obligation counts as accepted only on the word of two solvers, that the formula cannot be satisfied; a check of sense (that
//! a formula can be) on that of one, if none denies it. It must not know how any of this is told.

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
    /// What each solver said, in the order in which they were asked.
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
