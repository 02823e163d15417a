//! Formulas of linear temporal logic with past: X, U, Y, S, and the others made from them.

use program::TemporalOperator;

use super::{Arena, FormulaId, Logic};

/// A formula over formulas of the same table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Ltl {
    /// True or false.
    Constant(bool),
    /// A proposition.
    Proposition(u32),
    /// Not.
    Not(FormulaId),
    /// Both.
    And(FormulaId, FormulaId),
    /// In the next state.
    Next(FormulaId),
    /// The second now or later, the first until then.
    Until(FormulaId, FormulaId),
    /// In the state before; false in the first.
    Previous(FormulaId),
    /// The second now or before, the first since then.
    Since(FormulaId, FormulaId),
}

impl Ltl {
    /// The formulas directly in it.
    pub fn parts(self) -> impl Iterator<Item = FormulaId> {
        let (first, second) = match self {
            Ltl::Constant(_) | Ltl::Proposition(_) => (None, None),
            Ltl::Not(p) | Ltl::Next(p) | Ltl::Previous(p) => (Some(p), None),
            Ltl::And(p, q) | Ltl::Until(p, q) | Ltl::Since(p, q) => (Some(p), Some(q)),
        };
        first.into_iter().chain(second)
    }
}

/// A table of formulas of linear temporal logic.
#[derive(Debug, Clone, Default)]
pub struct LtlFormulas {
    arena: Arena<Ltl>,
}

impl LtlFormulas {
    /// The formula of a number.
    pub fn node(&self, id: FormulaId) -> Ltl {
        self.arena.node(id)
    }

    /// All formulas, parts before wholes.
    pub fn nodes(&self) -> &[Ltl] {
        self.arena.nodes()
    }

    fn constant_of(&self, id: FormulaId) -> Option<bool> {
        match self.node(id) {
            Ltl::Constant(truth) => Some(truth),
            _ => None,
        }
    }

    /// In the next state.
    pub fn next(&mut self, formula: FormulaId) -> FormulaId {
        match self.constant_of(formula) {
            Some(_) => formula,
            None => self.arena.add(Ltl::Next(formula)),
        }
    }

    /// The right now or later, the left until then.
    pub fn until(&mut self, left: FormulaId, right: FormulaId) -> FormulaId {
        match (self.constant_of(left), self.constant_of(right)) {
            (_, Some(_)) | (Some(false), _) => right,
            _ => self.arena.add(Ltl::Until(left, right)),
        }
    }

    /// The right until and including when the left holds, or always: ¬(¬left U ¬right).
    pub fn releases(&mut self, left: FormulaId, right: FormulaId) -> FormulaId {
        let (left, right) = (self.not(left), self.not(right));
        let until = self.until(left, right);
        self.not(until)
    }

    /// Now or later.
    pub fn finally(&mut self, formula: FormulaId) -> FormulaId {
        let always = self.constant(true);
        self.until(always, formula)
    }

    /// From now on always.
    pub fn globally(&mut self, formula: FormulaId) -> FormulaId {
        let not = self.not(formula);
        let some_time = self.finally(not);
        self.not(some_time)
    }

    /// In the state before; false in the first.
    pub fn previous(&mut self, formula: FormulaId) -> FormulaId {
        match self.constant_of(formula) {
            Some(false) => formula,
            _ => self.arena.add(Ltl::Previous(formula)),
        }
    }

    /// In the state before; true in the first.
    pub fn weak_previous(&mut self, formula: FormulaId) -> FormulaId {
        let not = self.not(formula);
        let before = self.previous(not);
        self.not(before)
    }

    /// The right now or before, the left since then.
    pub fn since(&mut self, left: FormulaId, right: FormulaId) -> FormulaId {
        match (self.constant_of(left), self.constant_of(right)) {
            (_, Some(_)) | (Some(false), _) => right,
            _ => self.arena.add(Ltl::Since(left, right)),
        }
    }

    /// The right since and including when the left held, or always so far: ¬(¬left S ¬right).
    pub fn triggered(&mut self, left: FormulaId, right: FormulaId) -> FormulaId {
        let (left, right) = (self.not(left), self.not(right));
        let since = self.since(left, right);
        self.not(since)
    }

    /// Now or before.
    pub fn once(&mut self, formula: FormulaId) -> FormulaId {
        let always = self.constant(true);
        self.since(always, formula)
    }

    /// Always so far.
    pub fn historically(&mut self, formula: FormulaId) -> FormulaId {
        let not = self.not(formula);
        let some_time = self.once(not);
        self.not(some_time)
    }
}

impl Logic for LtlFormulas {
    const BRANCHING: bool = false;

    fn constant(&mut self, truth: bool) -> FormulaId {
        self.arena.add(Ltl::Constant(truth))
    }

    fn proposition(&mut self, number: u32) -> FormulaId {
        self.arena.add(Ltl::Proposition(number))
    }

    fn not(&mut self, formula: FormulaId) -> FormulaId {
        match self.node(formula) {
            Ltl::Constant(truth) => self.constant(!truth),
            Ltl::Not(inner) => inner,
            _ => self.arena.add(Ltl::Not(formula)),
        }
    }

    fn and(&mut self, left: FormulaId, right: FormulaId) -> FormulaId {
        match (self.constant_of(left), self.constant_of(right)) {
            (Some(true), _) => right,
            (_, Some(true)) => left,
            (Some(false), _) => left,
            (_, Some(false)) => right,
            _ if left == right => left,
            _ => self.arena.add(Ltl::And(left.min(right), left.max(right))),
        }
    }

    fn operator(&mut self, operator: TemporalOperator, formulas: &[FormulaId]) -> Option<FormulaId> {
        use TemporalOperator::*;
        Some(match (operator, formulas) {
            (Next, [p]) => self.next(*p),
            (Globally, [p]) => self.globally(*p),
            (Finally, [p]) => self.finally(*p),
            (Until, [p, q]) => self.until(*p, *q),
            (Releases, [p, q]) => self.releases(*p, *q),
            (Previous, [p]) => self.previous(*p),
            (WeakPrevious, [p]) => self.weak_previous(*p),
            (Historically, [p]) => self.historically(*p),
            (Once, [p]) => self.once(*p),
            (Since, [p, q]) => self.since(*p, *q),
            (Triggered, [p, q]) => self.triggered(*p, *q),
            _ => return None,
        })
    }

    fn after_steps(&mut self, _: TemporalOperator, _: FormulaId, _: u64) -> Option<FormulaId> {
        None
    }

    fn size(&self) -> usize {
        self.arena.nodes().len()
    }
}
