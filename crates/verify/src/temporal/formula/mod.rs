//! Formulas of temporal logic over numbered propositions.
//!
//! Each logic has a few operators of its own; the others are built from them as the books define them: Clarke, Grumberg,
//! Peled, *Model Checking*, chapter 3; Baier, Katoen, *Principles of Model Checking*, chapters 5 and 6; for the past
//! Lichtenstein, Pnueli, Zuck, *The glory of the past*, 1985. INVARIANT: double negations and constants do not stand in a
//! formula other than as the whole of it.

mod arena;
mod ctl;
mod ltl;

pub use arena::{Arena, FormulaId};
pub use ctl::{Ctl, CtlFormulas};
pub use ltl::{Ltl, LtlFormulas};

use program::TemporalOperator;

/// What the two logics share: propositions and connectives; and the operators by their names in the library.
pub trait Logic: Default {
    /// Its operators are those of the CTL library.
    const BRANCHING: bool;
    /// True or false.
    fn constant(&mut self, truth: bool) -> FormulaId;
    /// A proposition by its number.
    fn proposition(&mut self, number: u32) -> FormulaId;
    /// Not.
    fn not(&mut self, formula: FormulaId) -> FormulaId;
    /// Both.
    fn and(&mut self, left: FormulaId, right: FormulaId) -> FormulaId;
    /// At least one.
    fn or(&mut self, left: FormulaId, right: FormulaId) -> FormulaId {
        let (left, right) = (self.not(left), self.not(right));
        let neither = self.and(left, right);
        self.not(neither)
    }
    /// If the left, then the right.
    fn implies(&mut self, left: FormulaId, right: FormulaId) -> FormulaId {
        let left = self.not(left);
        self.or(left, right)
    }
    /// Both or neither.
    fn iff(&mut self, left: FormulaId, right: FormulaId) -> FormulaId {
        let (there, back) = (self.implies(left, right), self.implies(right, left));
        self.and(there, back)
    }
    /// An operator of the library with as many formulas as it takes; none for one of the other logic, and for those
    /// that count steps.
    fn operator(&mut self, operator: TemporalOperator, formulas: &[FormulaId]) -> Option<FormulaId>;
    /// After so many steps; none in a logic without such an operator.
    fn after_steps(&mut self, operator: TemporalOperator, formula: FormulaId, steps: u64) -> Option<FormulaId>;
    /// How many different formulas there are in the table.
    fn size(&self) -> usize;
}
