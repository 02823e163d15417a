//! The automaton of a formula: a transition-based generalised Büchi automaton, built on demand.
//!
//! A state is the set of obligations (wanted formulas) and the remembered past. On a letter (the set of propositions
//! that hold), each way to satisfy the obligations gives a transition to the next obligations. It carries the mark of
//! each until that it does not postpone (Couvreur, *On-the-fly verification of linear temporal logic*, 1999, after
//! Gerth, Peled, Vardi, Wolper, 1995). A run of the automaton is accepting if every mark occurs infinitely often.
//!
//! A way is dropped if it has more obligations and fulfils less than another: a state simulates every state with more
//! obligations. A formula implied by another obligation is not stored.

use std::rc::Rc;

use hashbrown::HashMap;
use rustc_hash::FxBuildHasher;

use super::facts::{MOST_BITS, MOST_GUESSES};
use super::normal::{Normal, Want};
use super::truths::Truths;
use crate::temporal::budget::{Budget, Spent};
use crate::temporal::component::Marks;
use crate::temporal::formula::FormulaId;

/// LIMIT: the untils of one formula.
pub const MOST_UNTILS: usize = 64;
/// LIMIT: the most ways that are compared to drop superfluous ones.
const COMPARED: usize = 2000;

/// Identifies a state.
pub type StateNumber = u32;

/// A transition.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Transition {
    /// The target state.
    pub target: StateNumber,
    /// The untils that are fulfilled, or not postponed.
    pub marks: Marks,
}

#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct State {
    /// Ascending, none implied by another.
    wanted: Vec<FormulaId>,
    /// The bits of the past that the obligations depend on.
    past: u128,
}

/// An automaton, built on demand.
#[derive(Debug)]
pub struct Automaton {
    normal: Normal,
    /// For each formula, its mark if it is an until.
    until: Vec<Option<Marks>>,
    /// All marks.
    all: Marks,
    /// For each formula, the bits of the past that it depends on, now or later.
    depends: Vec<u128>,
    states: Vec<State>,
    truths: Truths,
    known: HashMap<State, StateNumber, FxBuildHasher>,
    transitions: HashMap<(StateNumber, u32), Rc<[Transition]>, FxBuildHasher>,
}

impl Automaton {
    /// The automaton; its initial state has number 0.
    ///
    /// # Errors
    /// There are more untils, past operators or guesses than the limits allow.
    pub fn new(normal: Normal) -> Result<Automaton, Spent> {
        let limits = [
            (normal.facts.bits(), MOST_BITS, "past operators in a formula"),
            (normal.facts.guesses(), MOST_GUESSES, "formulas of the future under past operators"),
        ];
        for (number, limit, of) in limits {
            if number > limit {
                return Err(Spent::Limit { of, value: limit as u64 });
            }
        }
        let mut until = Vec::new();
        let mut untils = 0;
        let mut depends: Vec<u128> = Vec::new();
        for node in normal.wants.nodes() {
            let is_until = matches!(node, Want::Until(..));
            until.push(is_until.then(|| Marks::one(untils)));
            untils += usize::from(is_until);
            if untils > MOST_UNTILS {
                return Err(Spent::Limit { of: "untils in a formula", value: MOST_UNTILS as u64 });
            }
            depends.push(match node {
                Want::Constant(_) => 0,
                Want::Fact(fact, _) => normal.facts.depends(*fact),
                Want::Next(p) => depends[p.index()],
                Want::And(p, q) | Want::Or(p, q) | Want::Until(p, q) | Want::Release(p, q) => {
                    depends[p.index()] | depends[q.index()]
                }
            });
        }
        let all = Marks::below(untils);
        let mut automaton = Automaton {
            normal,
            until,
            all,
            depends,
            states: Vec::new(),
            truths: Truths::default(),
            known: HashMap::default(),
            transitions: HashMap::default(),
        };
        let mut wanted = Vec::new();
        for root in automaton.normal.roots.clone() {
            automaton.want(root, &mut wanted);
        }
        let first = automaton.state(wanted, 0);
        automaton.number(first);
        Ok(automaton)
    }

    /// The marks that an accepting run has infinitely often.
    pub fn marks(&self) -> Marks {
        self.all
    }

    /// Whether there are no obligations: every run from here on is accepted.
    pub fn wants_nothing(&self, state: StateNumber) -> bool {
        self.states[state as usize].wanted.is_empty()
    }

    /// The transitions of a state on a letter. `holds` tells which propositions hold; the same number stands for the
    /// same ones.
    ///
    /// # Errors
    /// The caller asked to stop, or a limit was reached.
    pub fn transitions(
        &mut self,
        state: StateNumber,
        letter: u32,
        holds: impl Fn(u32) -> bool,
        budget: &mut Budget<'_>,
    ) -> Result<Rc<[Transition]>, Spent> {
        if let Some(known) = self.transitions.get(&(state, letter)) {
            return Ok(Rc::clone(known));
        }
        let State { wanted, past } = self.states[state as usize].clone();
        let mut ways: Vec<(State, Marks)> = Vec::new();
        let mut truths = std::mem::take(&mut self.truths);
        // Without obligations, guesses need not come true.
        let guesses = if wanted.is_empty() { 1 } else { 1 << self.normal.facts.guesses() };
        for guess in 0..guesses {
            let facts = self.normal.facts.truths(&holds, past, guess);
            let after = self.normal.facts.after(&facts);
            let covers = self.covers(&wanted, &facts, &mut truths, budget)?;
            for (wanted, put_off) in covers {
                let way = (self.state(wanted, after), put_off);
                if !ways.contains(&way) {
                    ways.push(way);
                }
            }
        }
        self.truths = truths;
        let kept = self.best(ways, budget)?;
        let mut transitions = Vec::with_capacity(kept.len());
        for (target, put_off) in kept {
            let marks = self.all.without(put_off);
            transitions.push(Transition { target: self.number(target), marks });
        }
        budget.within(self.states.len(), budget.limits.automaton_states, "states of the formula's automaton")?;
        let transitions: Rc<[Transition]> = transitions.into();
        self.transitions.insert((state, letter), Rc::clone(&transitions));
        Ok(transitions)
    }

    fn number(&mut self, state: State) -> StateNumber {
        let next = self.states.len() as StateNumber;
        let number = *self.known.entry(state.clone()).or_insert(next);
        if number == next {
            self.states.push(state);
        }
        number
    }

    /// Adds a formula to a list of obligations; `false` if it can never hold.
    fn want(&self, formula: FormulaId, wanted: &mut Vec<FormulaId>) -> bool {
        let mut open = vec![formula];
        while let Some(formula) = open.pop() {
            match self.normal.wants.node(formula) {
                Want::Constant(true) => {}
                Want::And(p, q) => open.extend([p, q]),
                Want::Constant(false) => {
                    wanted.push(formula);
                    return false;
                }
                _ => wanted.push(formula),
            }
        }
        true
    }

    /// A state: the obligations without those implied by others, and the past that they depend on.
    fn state(&self, mut wanted: Vec<FormulaId>, past: u128) -> State {
        wanted.sort_unstable();
        wanted.dedup();
        let mut brought: Vec<FormulaId> = Vec::new();
        let mut open: Vec<FormulaId> = Vec::new();
        for formula in &wanted {
            if let Want::Release(_, kept) = self.normal.wants.node(*formula) {
                open.push(kept);
            }
        }
        while let Some(formula) = open.pop() {
            if brought.contains(&formula) {
                continue;
            }
            brought.push(formula);
            match self.normal.wants.node(formula) {
                Want::And(p, q) => open.extend([p, q]),
                Want::Release(_, kept) => open.push(kept),
                _ => {}
            }
        }
        let has = |formula: FormulaId, wanted: &[FormulaId]| wanted.contains(&formula) || brought.contains(&formula);
        let all = wanted.clone();
        wanted.retain(|formula| {
            !brought.contains(formula)
                && match self.normal.wants.node(*formula) {
                    Want::Until(_, goal) => !has(goal, &all),
                    Want::Or(p, q) => !has(p, &all) && !has(q, &all),
                    _ => true,
                }
        });
        let mask = wanted.iter().fold(0, |mask, formula| mask | self.depends[formula.index()]);
        State { wanted, past: past & mask }
    }

    /// The ways to satisfy formulas in a state: the next obligations, and which untils are postponed.
    fn covers(
        &self,
        wanted: &[FormulaId],
        facts: &[bool],
        truths: &mut Truths,
        budget: &mut Budget<'_>,
    ) -> Result<Vec<(Vec<FormulaId>, Marks)>, Spent> {
        let wants = &self.normal.wants;
        truths.begin(wants.nodes().len());
        let mut of = |formula: FormulaId| truths.of(wants, facts, formula);
        let mut covers = Vec::new();
        let mut open = vec![Way { todo: wanted.to_vec(), ..Way::default() }];
        'ways: while let Some(mut way) = open.pop() {
            budget.within(covers.len() + open.len(), budget.limits.covers, "ways to satisfy a formula in one state")?;
            while let Some(formula) = way.todo.pop() {
                budget.work()?;
                match of(formula) {
                    Some(true) => continue,
                    Some(false) => continue 'ways,
                    None if way.done.contains(&formula) => continue,
                    None => way.done.push(formula),
                }
                match wants.node(formula) {
                    // Their truth is already known.
                    Want::Constant(_) | Want::Fact(..) => {}
                    Want::And(p, q) => way.todo.extend([p, q]),
                    Want::Or(p, q) if of(p) == Some(false) => way.todo.push(q),
                    Want::Or(p, q) if of(q) == Some(false) => way.todo.push(p),
                    Want::Or(p, q) => {
                        open.push(way.clone().with(q));
                        way.todo.push(p);
                    }
                    Want::Next(p) => {
                        if !self.want(p, &mut way.next) {
                            continue 'ways;
                        }
                    }
                    Want::Until(p, q) => {
                        if of(q) != Some(false) && of(p) != Some(false) {
                            open.push(way.clone().with(q));
                        }
                        if of(p) == Some(false) {
                            way.todo.push(q);
                        } else {
                            way.todo.push(p);
                            way.next.push(formula);
                            way.put_off |= self.until[formula.index()].unwrap_or_default();
                        }
                    }
                    Want::Release(p, q) => {
                        if of(p).is_none() {
                            open.push(way.clone().with(p).with(q));
                        }
                        way.todo.push(q);
                        if of(p) != Some(true) {
                            way.next.push(formula);
                        }
                    }
                }
            }
            covers.push((way.next, way.put_off));
        }
        Ok(covers)
    }

    /// Drops each way that another makes superfluous.
    fn best(&self, ways: Vec<(State, Marks)>, budget: &mut Budget<'_>) -> Result<Vec<(State, Marks)>, Spent> {
        if ways.len() > COMPARED {
            return Ok(ways);
        }
        let mut kept: Vec<(State, Marks)> = Vec::new();
        for way in ways {
            budget.work()?;
            if kept.iter().any(|other| self.serves(other, &way)) {
                continue;
            }
            kept.retain(|other| !self.serves(&way, other));
            kept.push(way);
        }
        Ok(kept)
    }

    /// Whether the first has no more obligations, postpones no more, and remembers the same relevant past.
    fn serves(&self, first: &(State, Marks), second: &(State, Marks)) -> bool {
        let mask = first.0.wanted.iter().fold(0, |mask, formula| mask | self.depends[formula.index()]);
        second.1.has(first.1)
            && first.0.past == second.0.past & mask
            && first.0.wanted.iter().all(|formula| second.0.wanted.binary_search(formula).is_ok())
    }
}

/// An incomplete way to satisfy formulas.
#[derive(Debug, Clone, Default)]
struct Way {
    todo: Vec<FormulaId>,
    done: Vec<FormulaId>,
    next: Vec<FormulaId>,
    put_off: Marks,
}

impl Way {
    fn with(mut self, formula: FormulaId) -> Way {
        self.todo.push(formula);
        self
    }
}
