//! Formulas of computation tree logic: EX, EU, EG, and the derived operators.
//!
//! The weak operators and the patterns are those in the comments of the public library, after Dwyer, Avrunin, Corbett,
//! *Patterns in property specifications*, 1999.

use program::TemporalOperator;

use super::arena::{Arena, FormulaId};
use super::logic::{Connective, Logic, Node};

/// A formula over formulas of the same table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Ctl {
    /// True or false.
    Constant(bool),
    /// A proposition.
    Proposition(u32),
    /// Negation.
    Not(FormulaId),
    /// Conjunction.
    And(FormulaId, FormulaId),
    /// On some path, in the next state.
    ExistsNext(FormulaId),
    /// On some path, the second eventually, the first until then.
    ExistsUntil(FormulaId, FormulaId),
    /// On some path, always.
    ExistsGlobally(FormulaId),
}

impl From<Connective> for Ctl {
    fn from(connective: Connective) -> Ctl {
        match connective {
            Connective::Constant(truth) => Ctl::Constant(truth),
            Connective::Proposition(number) => Ctl::Proposition(number),
            Connective::Not(p) => Ctl::Not(p),
            Connective::And(p, q) => Ctl::And(p, q),
        }
    }
}

impl Node for Ctl {
    fn connective(self) -> Option<Connective> {
        Some(match self {
            Ctl::Constant(truth) => Connective::Constant(truth),
            Ctl::Proposition(number) => Connective::Proposition(number),
            Ctl::Not(p) => Connective::Not(p),
            Ctl::And(p, q) => Connective::And(p, q),
            Ctl::ExistsNext(_) | Ctl::ExistsUntil(..) | Ctl::ExistsGlobally(_) => return None,
        })
    }
}

/// A table of formulas of computation tree logic.
#[derive(Debug, Clone, Default)]
pub struct CtlFormulas {
    arena: Arena<Ctl>,
}

impl CtlFormulas {
    /// The formula of a number.
    pub fn node(&self, id: FormulaId) -> Ctl {
        self.arena.node(id)
    }

    /// All formulas, operands first.
    pub fn nodes(&self) -> &[Ctl] {
        self.arena.nodes()
    }

    /// On some path, in the next state. EX false is false. EX true is no constant: under fairness a state may be on no
    /// fair path.
    pub fn exists_next(&mut self, formula: FormulaId) -> FormulaId {
        match self.constant_of(formula) {
            Some(false) => formula,
            _ => self.arena.add(Ctl::ExistsNext(formula)),
        }
    }

    /// On some path, the right eventually, the left until then.
    pub fn exists_until(&mut self, left: FormulaId, right: FormulaId) -> FormulaId {
        match self.constant_of(right) {
            Some(false) => right,
            _ => self.arena.add(Ctl::ExistsUntil(left, right)),
        }
    }

    /// On some path, always.
    pub fn exists_globally(&mut self, formula: FormulaId) -> FormulaId {
        match self.constant_of(formula) {
            Some(false) => formula,
            _ => self.arena.add(Ctl::ExistsGlobally(formula)),
        }
    }

    /// On some path, eventually.
    pub fn exists_finally(&mut self, formula: FormulaId) -> FormulaId {
        let always = self.constant(true);
        self.exists_until(always, formula)
    }

    /// On all paths, in the next state.
    pub fn all_next(&mut self, formula: FormulaId) -> FormulaId {
        let not = self.not(formula);
        let some = self.exists_next(not);
        self.not(some)
    }

    /// On all paths, eventually.
    pub fn all_finally(&mut self, formula: FormulaId) -> FormulaId {
        let not = self.not(formula);
        let never = self.exists_globally(not);
        self.not(never)
    }

    /// On all paths, always.
    pub fn all_globally(&mut self, formula: FormulaId) -> FormulaId {
        let not = self.not(formula);
        let some = self.exists_finally(not);
        self.not(some)
    }

    /// On all paths, the left until the right, or the left always: ¬E[¬right U ¬(left ∨ right)].
    pub fn all_weak_until(&mut self, left: FormulaId, right: FormulaId) -> FormulaId {
        let either = self.or(left, right);
        let (neither, open) = (self.not(either), self.not(right));
        let broken = self.exists_until(open, neither);
        self.not(broken)
    }

    /// On all paths, the right eventually, the left until then.
    pub fn all_until(&mut self, left: FormulaId, right: FormulaId) -> FormulaId {
        let (weak, happens) = (self.all_weak_until(left, right), self.all_finally(right));
        self.and(weak, happens)
    }

    /// On some path, the left until the right, or the left always.
    pub fn exists_weak_until(&mut self, left: FormulaId, right: FormulaId) -> FormulaId {
        let (until, always) = (self.exists_until(left, right), self.exists_globally(left));
        self.or(until, always)
    }

    /// `formula`, or `end` never again.
    fn or_never(&mut self, formula: FormulaId, end: FormulaId) -> FormulaId {
        let no_end = self.not(end);
        let never = self.all_globally(no_end);
        self.or(formula, never)
    }

    /// Whenever `begin` and not `end`: `then`.
    fn whenever_open(&mut self, begin: FormulaId, end: FormulaId, then: FormulaId) -> FormulaId {
        let no_end = self.not(end);
        let open = self.and(begin, no_end);
        let holds = self.implies(open, then);
        self.all_globally(holds)
    }
}

impl Logic for CtlFormulas {
    type Node = Ctl;
    const BRANCHING: bool = true;

    fn arena(&self) -> &Arena<Ctl> {
        &self.arena
    }

    fn arena_mut(&mut self) -> &mut Arena<Ctl> {
        &mut self.arena
    }

    fn operator(&mut self, operator: TemporalOperator, formulas: &[FormulaId]) -> Option<FormulaId> {
        use TemporalOperator::*;
        Some(match (operator, formulas) {
            (Ex, [p]) => self.exists_next(*p),
            (Ef, [p]) => self.exists_finally(*p),
            (Eg, [p]) => self.exists_globally(*p),
            (Eu, [p, q]) => self.exists_until(*p, *q),
            (Ew, [p, q]) => self.exists_weak_until(*p, *q),
            (Ax, [p]) => self.all_next(*p),
            (Af, [p]) => self.all_finally(*p),
            (Ag, [p]) => self.all_globally(*p),
            (Au, [p, q]) => self.all_until(*p, *q),
            (Aw, [p, q]) => self.all_weak_until(*p, *q),
            (AbsenceGlobally, [p]) => {
                let absent = self.not(*p);
                self.all_globally(absent)
            }
            (AbsenceBefore, [p, r]) => {
                let absent = self.not(*p);
                let excused = self.or_never(absent, *r);
                self.all_weak_until(excused, *r)
            }
            (AbsenceAfter, [p, q]) => {
                let absent = self.not(*p);
                let for_ever = self.all_globally(absent);
                let after = self.implies(*q, for_ever);
                self.all_globally(after)
            }
            (AbsenceBetween, [p, q, r]) => {
                let absent = self.not(*p);
                let excused = self.or_never(absent, *r);
                let then = self.all_weak_until(excused, *r);
                self.whenever_open(*q, *r, then)
            }
            (AbsenceAfterUntil, [p, q, r]) => {
                let absent = self.not(*p);
                let then = self.all_weak_until(absent, *r);
                self.whenever_open(*q, *r, then)
            }
            (Precedence, [p, s]) => {
                let absent = self.not(*p);
                self.all_weak_until(absent, *s)
            }
            (PrecedenceBefore, [p, s, r]) => {
                let absent = self.not(*p);
                let excused = self.or_never(absent, *r);
                let end = self.or(*s, *r);
                self.all_weak_until(excused, end)
            }
            // Operators of the other logic, and those that count steps.
            (
                ExN | AxN | Next | Globally | Finally | Until | Releases | Previous | WeakPrevious | Historically
                | Once | Since | Triggered,
                _,
            ) => return None,
            (
                Eg | Ex | Ef | Ag | Ax | Af | Eu | Au | Ew | Aw | AbsenceGlobally | AbsenceBefore | AbsenceAfter
                | AbsenceBetween | AbsenceAfterUntil | Precedence | PrecedenceBefore,
                _,
            ) => unreachable!("the verifier of programs counts arguments"),
        })
    }

    fn after_steps(&mut self, operator: TemporalOperator, formula: FormulaId, steps: u64) -> Option<FormulaId> {
        let mut formula = formula;
        for _ in 0..steps {
            let after = match operator {
                TemporalOperator::ExN => self.exists_next(formula),
                TemporalOperator::AxN => self.all_next(formula),
                _ => return None,
            };
            if after == formula {
                break;
            }
            formula = after;
        }
        matches!(operator, TemporalOperator::ExN | TemporalOperator::AxN).then_some(formula)
    }
}
