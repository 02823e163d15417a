//! Facts of the present and past, which follow from a state, from the previous facts, and from guesses.
//!
//! Each past operator has a bit: for `y(p)` whether p was true in the previous state, for `s(p, q)` whether it was true
//! itself; before the first state all are false (Lichtenstein, Pnueli, Zuck 1985). So one pass over the table yields
//! the truth of every fact. INVARIANT: a fact's operands have smaller numbers.

use crate::temporal::formula::{Arena, FormulaId};

/// The number of a fact in its table.
pub type FactId = FormulaId;

/// LIMIT: past operators of one formula, and future formulas below a past operator.
pub const MOST_BITS: usize = 128;
/// LIMIT: see [`MOST_BITS`].
pub const MOST_GUESSES: usize = 16;

/// A fact over facts of the same table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Fact {
    /// True or false.
    Constant(bool),
    /// A proposition.
    Proposition(u32),
    /// A guess, by its number.
    Guess(u32),
    /// Negation.
    Not(FactId),
    /// Conjunction.
    And(FactId, FactId),
    /// It was true in the previous state.
    Previous(FactId),
    /// The second now or before, the first since then.
    Since(FactId, FactId),
}

/// A table of facts.
#[derive(Debug, Default)]
pub struct Facts {
    arena: Arena<Fact>,
    /// The past operators, in the order of their bits.
    past: Vec<FactId>,
    guesses: u32,
    /// For each fact, the bits that its truth may depend on, now or later.
    depends: Vec<u128>,
}

impl Facts {
    /// Adds a fact that is not a past operator.
    pub fn add(&mut self, fact: Fact) -> FactId {
        let id = self.arena.add(fact);
        if id.index() == self.depends.len() {
            let own = if matches!(fact, Fact::Previous(_) | Fact::Since(..)) {
                self.past.push(id);
                // Beyond the limit, the table is not used.
                1u128.checked_shl(self.past.len() as u32 - 1).unwrap_or(0)
            } else {
                0
            };
            let parts = match fact {
                Fact::Constant(_) | Fact::Proposition(_) | Fact::Guess(_) => 0,
                Fact::Not(p) | Fact::Previous(p) => self.depends[p.index()],
                Fact::And(p, q) | Fact::Since(p, q) => self.depends[p.index()] | self.depends[q.index()],
            };
            self.depends.push(own | parts);
        }
        id
    }

    /// Adds `y`.
    pub fn previous(&mut self, fact: FactId) -> FactId {
        self.add(Fact::Previous(fact))
    }

    /// Adds `s`.
    pub fn since(&mut self, left: FactId, right: FactId) -> FactId {
        self.add(Fact::Since(left, right))
    }

    /// A new guess.
    pub fn guess(&mut self) -> FactId {
        self.guesses += 1;
        self.add(Fact::Guess(self.guesses - 1))
    }

    /// Its truth, if it is a constant.
    pub fn constant(&self, fact: FactId) -> Option<bool> {
        match self.arena.node(fact) {
            Fact::Constant(truth) => Some(truth),
            _ => None,
        }
    }

    /// The number of past operators.
    pub fn bits(&self) -> usize {
        self.past.len()
    }

    /// The number of guesses.
    pub fn guesses(&self) -> usize {
        self.guesses as usize
    }

    /// The bits that a fact's truth may depend on, now or later.
    pub fn depends(&self, fact: FactId) -> u128 {
        self.depends[fact.index()]
    }

    /// The truth of each fact in a state.
    pub fn truths(&self, proposition: impl Fn(u32) -> bool, before: u128, guesses: u32) -> Vec<bool> {
        let mut truths: Vec<bool> = Vec::with_capacity(self.arena.nodes().len());
        let mut bits = 0..;
        let mut bit = || bits.next().is_some_and(|bit: u32| before >> bit & 1 == 1);
        for fact in self.arena.nodes() {
            truths.push(match fact {
                Fact::Constant(truth) => *truth,
                Fact::Proposition(number) => proposition(*number),
                Fact::Guess(number) => guesses >> number & 1 == 1,
                Fact::Not(p) => !truths[p.index()],
                Fact::And(p, q) => truths[p.index()] && truths[q.index()],
                Fact::Previous(_) => bit(),
                Fact::Since(p, q) => {
                    let since = bit();
                    truths[q.index()] || (truths[p.index()] && since)
                }
            });
        }
        truths
    }

    /// The bits after a state with these truth values.
    pub fn after(&self, truths: &[bool]) -> u128 {
        let mut after = 0;
        for (bit, past) in self.past.iter().enumerate() {
            let tells = match self.arena.node(*past) {
                Fact::Previous(p) => p,
                _ => *past,
            };
            after |= u128::from(truths[tells.index()]) << bit;
        }
        after
    }
}
