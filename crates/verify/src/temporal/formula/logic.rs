//! The common parts of all formulas: propositions, connectives, and the operators by their names in the library.

use program::TemporalOperator;

use super::arena::{Arena, FormulaId};

/// The parts of formulas that every logic has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Connective {
    /// True or false.
    Constant(bool),
    /// A proposition by its number.
    Proposition(u32),
    /// Negation.
    Not(FormulaId),
    /// Conjunction.
    And(FormulaId, FormulaId),
}

/// A formula over formulas of its table: a connective, or an operator of its logic.
pub trait Node: Copy + Ord + From<Connective> {
    /// The connective, if it is one.
    fn connective(self) -> Option<Connective>;
}

/// The interface of both logics: propositions, connectives, and operators by their names in the library.
pub trait Logic: Default {
    /// A formula.
    type Node: Node;
    /// Whether its operators are those of the CTL library.
    const BRANCHING: bool;
    /// Its formulas.
    fn arena(&self) -> &Arena<Self::Node>;
    /// The same, to add to.
    fn arena_mut(&mut self) -> &mut Arena<Self::Node>;
    /// An operator of the library applied to as many formulas as it takes; `None` for operators of the other logic and
    /// for those that count steps.
    fn operator(&mut self, operator: TemporalOperator, formulas: &[FormulaId]) -> Option<FormulaId>;
    /// After this many steps; `None` in a logic without such an operator.
    fn after_steps(&mut self, operator: TemporalOperator, formula: FormulaId, steps: u64) -> Option<FormulaId>;

    /// The truth value of a constant formula.
    fn constant_of(&self, formula: FormulaId) -> Option<bool> {
        match self.arena().node(formula).connective() {
            Some(Connective::Constant(truth)) => Some(truth),
            _ => None,
        }
    }
    /// True or false.
    fn constant(&mut self, truth: bool) -> FormulaId {
        self.arena_mut().add(Connective::Constant(truth).into())
    }
    /// A proposition by its number.
    fn proposition(&mut self, number: u32) -> FormulaId {
        self.arena_mut().add(Connective::Proposition(number).into())
    }
    /// Negation.
    fn not(&mut self, formula: FormulaId) -> FormulaId {
        match self.arena().node(formula).connective() {
            Some(Connective::Constant(truth)) => self.constant(!truth),
            Some(Connective::Not(inner)) => inner,
            _ => self.arena_mut().add(Connective::Not(formula).into()),
        }
    }
    /// Conjunction.
    fn and(&mut self, left: FormulaId, right: FormulaId) -> FormulaId {
        match (self.constant_of(left), self.constant_of(right)) {
            (Some(true), _) => right,
            (_, Some(true)) => left,
            (Some(false), _) => left,
            (_, Some(false)) => right,
            _ if left == right => left,
            _ => self.arena_mut().add(Connective::And(left.min(right), left.max(right)).into()),
        }
    }
    /// Disjunction.
    fn or(&mut self, left: FormulaId, right: FormulaId) -> FormulaId {
        let (left, right) = (self.not(left), self.not(right));
        let neither = self.and(left, right);
        self.not(neither)
    }
    /// Implication.
    fn implies(&mut self, left: FormulaId, right: FormulaId) -> FormulaId {
        let left = self.not(left);
        self.or(left, right)
    }
    /// Equivalence.
    fn iff(&mut self, left: FormulaId, right: FormulaId) -> FormulaId {
        let (there, back) = (self.implies(left, right), self.implies(right, left));
        self.and(there, back)
    }
    /// The number of formulas in the table.
    fn size(&self) -> usize {
        self.arena().nodes().len()
    }
}
