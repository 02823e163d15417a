//! Normalises a formula: its future part in negation normal form over facts of the present and past.
//!
//! In: a formula. Out: [`Wants`], formulas without negation over [`Fact`]s. The truth of a fact follows from the state
//! and from a bit for each past operator, which records the previous step ([`super::facts`]). If a future operator is
//! below a past operator (`o(g(p))`), its truth is guessed in each state, and the guess becomes an obligation.

use super::facts::{Fact, FactId, Facts};
use crate::temporal::formula::{Arena, FormulaId, Ltl, LtlFormulas};

/// An obligation over others of the same table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Want {
    /// True or false.
    Constant(bool),
    /// A fact has this truth value.
    Fact(FactId, bool),
    /// Conjunction.
    And(FormulaId, FormulaId),
    /// Disjunction.
    Or(FormulaId, FormulaId),
    /// In the next state.
    Next(FormulaId),
    /// The second now or later, the first until then.
    Until(FormulaId, FormulaId),
    /// The second up to and including the time when the first holds, or always.
    Release(FormulaId, FormulaId),
}

/// A table of obligations.
#[derive(Debug, Default)]
pub struct Wants {
    arena: Arena<Want>,
}

/// A normalised formula: a run must satisfy all of `roots`.
#[derive(Debug)]
pub struct Normal {
    /// The formulas.
    pub wants: Wants,
    /// The facts in them.
    pub facts: Facts,
    /// The obligations in the first state.
    pub roots: Vec<FormulaId>,
}

impl Normal {
    /// The obligations of a run on which a formula has this truth value in the first state.
    pub fn of(formulas: &LtlFormulas, root: FormulaId, truth: bool) -> Normal {
        let mut reading = Reading::new(formulas, root);
        for index in 0..=root.index() {
            if reading.reachable[index] {
                reading.read(FormulaId(index as u32));
            }
        }
        let Reading { mut wants, facts, known, guesses, .. } = reading;
        let mut roots = vec![known[root.index()].of(truth)];
        for (formula, guess) in guesses {
            let both = known[formula.index()];
            let (yes, no) = (wants.fact(guess, true), wants.fact(guess, false));
            let (right, wrong) = (wants.and(yes, both.holds), wants.and(no, both.fails));
            let comes_true = wants.or(right, wrong);
            let never = wants.constant(false);
            roots.push(wants.release(never, comes_true));
        }
        Normal { wants, facts, roots }
    }
}

/// The obligations for a formula to hold, and to fail.
#[derive(Debug, Clone, Copy)]
struct Both {
    holds: FormulaId,
    fails: FormulaId,
}

impl Both {
    fn of(self, truth: bool) -> FormulaId {
        if truth { self.holds } else { self.fails }
    }
}

struct Reading<'f> {
    formulas: &'f LtlFormulas,
    reachable: Vec<bool>,
    wants: Wants,
    facts: Facts,
    /// For each formula read so far.
    known: Vec<Both>,
    /// For each formula, its fact, if it is only about present and past.
    fact: Vec<Option<FactId>>,
    guesses: Vec<(FormulaId, FactId)>,
}

impl<'f> Reading<'f> {
    fn new(formulas: &'f LtlFormulas, root: FormulaId) -> Reading<'f> {
        let mut reachable = vec![false; root.index() + 1];
        reachable[root.index()] = true;
        for index in (0..=root.index()).rev() {
            if reachable[index] {
                formulas.nodes()[index].parts().for_each(|part| reachable[part.index()] = true);
            }
        }
        let mut wants = Wants::default();
        let unknown = wants.constant(false);
        let known = vec![Both { holds: unknown, fails: unknown }; root.index() + 1];
        let fact = vec![None; root.index() + 1];
        Reading { formulas, reachable, wants, facts: Facts::default(), known, fact, guesses: Vec::new() }
    }

    fn read(&mut self, id: FormulaId) {
        let node = self.formulas.node(id);
        self.fact[id.index()] = self.fact_of(node);
        let of = |formula: FormulaId| self.known[formula.index()];
        let wants = &mut self.wants;
        self.known[id.index()] = if let Some(fact) = self.fact[id.index()] {
            match self.facts.constant(fact) {
                Some(truth) => Both { holds: wants.constant(truth), fails: wants.constant(!truth) },
                None => Both { holds: wants.fact(fact, true), fails: wants.fact(fact, false) },
            }
        } else {
            match node {
                Ltl::Not(p) => Both { holds: of(p).fails, fails: of(p).holds },
                Ltl::And(p, q) => {
                    let (p, q) = (of(p), of(q));
                    Both { holds: wants.and(p.holds, q.holds), fails: wants.or(p.fails, q.fails) }
                }
                Ltl::Next(p) => Both { holds: wants.next(of(p).holds), fails: wants.next(of(p).fails) },
                Ltl::Until(p, q) => {
                    let (p, q) = (of(p), of(q));
                    Both { holds: wants.until(p.holds, q.holds), fails: wants.release(p.fails, q.fails) }
                }
                Ltl::Constant(_) | Ltl::Proposition(_) | Ltl::Previous(_) | Ltl::Since(..) => {
                    unreachable!("these are facts")
                }
            }
        };
    }

    /// A formula as a fact; `None` if it is about the future.
    fn fact_of(&mut self, node: Ltl) -> Option<FactId> {
        let of = |formula: FormulaId| self.fact[formula.index()];
        Some(match node {
            Ltl::Constant(truth) => self.facts.add(Fact::Constant(truth)),
            Ltl::Proposition(number) => self.facts.add(Fact::Proposition(number)),
            Ltl::Not(p) => {
                let p = of(p)?;
                self.facts.add(Fact::Not(p))
            }
            Ltl::And(p, q) => {
                let (p, q) = (of(p)?, of(q)?);
                self.facts.add(Fact::And(p, q))
            }
            Ltl::Previous(p) => {
                let p = self.guessed(p);
                self.facts.previous(p)
            }
            Ltl::Since(p, q) => {
                let (p, q) = (self.guessed(p), self.guessed(q));
                self.facts.since(p, q)
            }
            Ltl::Next(_) | Ltl::Until(..) => return None,
        })
    }

    /// A formula as a fact, or a guess of its truth.
    fn guessed(&mut self, formula: FormulaId) -> FactId {
        if let Some(fact) = self.fact[formula.index()] {
            return fact;
        }
        if let Some((_, guess)) = self.guesses.iter().find(|(guessed, _)| *guessed == formula) {
            return *guess;
        }
        let guess = self.facts.guess();
        self.guesses.push((formula, guess));
        guess
    }
}

impl Wants {
    /// The formula of a number.
    pub fn node(&self, id: FormulaId) -> Want {
        self.arena.node(id)
    }

    /// All formulas, operands first.
    pub fn nodes(&self) -> &[Want] {
        self.arena.nodes()
    }

    fn constant(&mut self, truth: bool) -> FormulaId {
        self.arena.add(Want::Constant(truth))
    }

    fn fact(&mut self, fact: FactId, truth: bool) -> FormulaId {
        self.arena.add(Want::Fact(fact, truth))
    }

    fn constant_of(&self, id: FormulaId) -> Option<bool> {
        match self.node(id) {
            Want::Constant(truth) => Some(truth),
            _ => None,
        }
    }

    /// `p` if this is F p.
    fn finally_of(&self, id: FormulaId) -> Option<FormulaId> {
        match self.node(id) {
            Want::Until(left, right) if self.constant_of(left) == Some(true) => Some(right),
            _ => None,
        }
    }

    /// `p` if this is G p.
    fn globally_of(&self, id: FormulaId) -> Option<FormulaId> {
        match self.node(id) {
            Want::Release(left, right) if self.constant_of(left) == Some(false) => Some(right),
            _ => None,
        }
    }

    /// Whether this is G F p or F G p, whose truth is the same in all states of a run.
    fn is_of_the_tail(&self, id: FormulaId) -> bool {
        let again = self.globally_of(id).and_then(|inner| self.finally_of(inner));
        let at_last = self.finally_of(id).and_then(|inner| self.globally_of(inner));
        again.is_some() || at_last.is_some()
    }

    fn opposite(&self, left: FormulaId, right: FormulaId) -> bool {
        match (self.node(left), self.node(right)) {
            (Want::Fact(a, is), Want::Fact(b, is_not)) => a == b && is != is_not,
            _ => false,
        }
    }

    fn and(&mut self, left: FormulaId, right: FormulaId) -> FormulaId {
        match (self.constant_of(left), self.constant_of(right)) {
            (Some(true), _) => return right,
            (_, Some(true)) => return left,
            (Some(false), _) => return left,
            (_, Some(false)) => return right,
            _ if left == right => return left,
            _ if self.opposite(left, right) => return self.constant(false),
            _ => {}
        }
        if let (Some(p), Some(q)) = (self.globally_of(left), self.globally_of(right)) {
            let both = self.and(p, q);
            let never = self.constant(false);
            return self.release(never, both);
        }
        self.arena.add(Want::And(left.min(right), left.max(right)))
    }

    fn or(&mut self, left: FormulaId, right: FormulaId) -> FormulaId {
        match (self.constant_of(left), self.constant_of(right)) {
            (Some(false), _) => return right,
            (_, Some(false)) => return left,
            (Some(true), _) => return left,
            (_, Some(true)) => return right,
            _ if left == right => return left,
            _ if self.opposite(left, right) => return self.constant(true),
            _ => {}
        }
        if let (Some(p), Some(q)) = (self.finally_of(left), self.finally_of(right)) {
            let either = self.or(p, q);
            let always = self.constant(true);
            return self.until(always, either);
        }
        self.arena.add(Want::Or(left.min(right), left.max(right)))
    }

    fn next(&mut self, formula: FormulaId) -> FormulaId {
        if self.constant_of(formula).is_some() || self.is_of_the_tail(formula) {
            return formula;
        }
        self.arena.add(Want::Next(formula))
    }

    fn until(&mut self, left: FormulaId, right: FormulaId) -> FormulaId {
        if self.constant_of(right).is_some() || self.constant_of(left) == Some(false) || self.is_of_the_tail(right) {
            return right;
        }
        match self.node(right) {
            // p U (p U q) and F(p U q)
            Want::Until(first, _) if first == left => right,
            Want::Until(_, goal) if self.constant_of(left) == Some(true) => self.until(left, goal),
            _ => self.arena.add(Want::Until(left, right)),
        }
    }

    fn release(&mut self, left: FormulaId, right: FormulaId) -> FormulaId {
        if self.constant_of(right).is_some() || self.constant_of(left) == Some(true) || self.is_of_the_tail(right) {
            return right;
        }
        match self.node(right) {
            // p R (p R q) and G(p R q)
            Want::Release(first, _) if first == left => right,
            Want::Release(_, kept) if self.constant_of(left) == Some(false) => self.release(left, kept),
            _ => self.arena.add(Want::Release(left, right)),
        }
    }
}
