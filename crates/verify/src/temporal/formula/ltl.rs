//! Formulas of linear temporal logic with past: X, U, Y, S, and the derived operators.

use program::TemporalOperator;

use super::arena::{Arena, FormulaId};
use super::logic::{Connective, Logic, Node};

/// A formula over formulas of the same table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Ltl {
    /// True or false.
    Constant(bool),
    /// A proposition.
    Proposition(u32),
    /// Negation.
    Not(FormulaId),
    /// Conjunction.
    And(FormulaId, FormulaId),
    /// In the next state.
    Next(FormulaId),
    /// The second now or later, the first until then.
    Until(FormulaId, FormulaId),
    /// In the previous state; false in the first.
    Previous(FormulaId),
    /// The second now or before, the first since then.
    Since(FormulaId, FormulaId),
}

impl Ltl {
    /// The operands.
    pub fn parts(self) -> impl Iterator<Item = FormulaId> {
        let (first, second) = match self {
            Ltl::Constant(_) | Ltl::Proposition(_) => (None, None),
            Ltl::Not(p) | Ltl::Next(p) | Ltl::Previous(p) => (Some(p), None),
            Ltl::And(p, q) | Ltl::Until(p, q) | Ltl::Since(p, q) => (Some(p), Some(q)),
        };
        first.into_iter().chain(second)
    }
}

impl From<Connective> for Ltl {
    fn from(connective: Connective) -> Ltl {
        match connective {
            Connective::Constant(truth) => Ltl::Constant(truth),
            Connective::Proposition(number) => Ltl::Proposition(number),
            Connective::Not(p) => Ltl::Not(p),
            Connective::And(p, q) => Ltl::And(p, q),
        }
    }
}

impl Node for Ltl {
    fn connective(self) -> Option<Connective> {
        Some(match self {
            Ltl::Constant(truth) => Connective::Constant(truth),
            Ltl::Proposition(number) => Connective::Proposition(number),
            Ltl::Not(p) => Connective::Not(p),
            Ltl::And(p, q) => Connective::And(p, q),
            Ltl::Next(_) | Ltl::Until(..) | Ltl::Previous(_) | Ltl::Since(..) => return None,
        })
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

    /// All formulas, operands first.
    pub fn nodes(&self) -> &[Ltl] {
        self.arena.nodes()
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

    /// The right up to and including the time when the left holds, or always: ¬(¬left U ¬right).
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

    /// Always from now on.
    pub fn globally(&mut self, formula: FormulaId) -> FormulaId {
        let not = self.not(formula);
        let some_time = self.finally(not);
        self.not(some_time)
    }

    /// In the previous state; false in the first.
    pub fn previous(&mut self, formula: FormulaId) -> FormulaId {
        match self.constant_of(formula) {
            Some(false) => formula,
            _ => self.arena.add(Ltl::Previous(formula)),
        }
    }

    /// In the previous state; true in the first.
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

    /// The right since (and including) the time when the left held, or always so far: ¬(¬left S ¬right).
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
    type Node = Ltl;
    const BRANCHING: bool = false;

    fn arena(&self) -> &Arena<Ltl> {
        &self.arena
    }

    fn arena_mut(&mut self) -> &mut Arena<Ltl> {
        &mut self.arena
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
            // Operators of the other logic.
            (
                Eg | Ex | Ef | Ag | Ax | Af | Eu | Au | Ew | Aw | ExN | AxN | AbsenceGlobally | AbsenceBefore
                | AbsenceAfter | AbsenceBetween | AbsenceAfterUntil | Precedence | PrecedenceBefore,
                _,
            ) => return None,
            (
                Next | Globally | Finally | Until | Releases | Previous | WeakPrevious | Historically | Once | Since
                | Triggered,
                _,
            ) => unreachable!("the verifier of programs counts arguments"),
        })
    }

    fn after_steps(&mut self, _: TemporalOperator, _: FormulaId, _: u64) -> Option<FormulaId> {
        None
    }
}
