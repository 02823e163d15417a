//! A proof by induction in the making: what is asked first, and how an answer ends it.
//!
//! In: a coupling, options, solvers. Out: the obligations that were asked, or the [`Ended`] at which the proof does not go on. It asks about
//! the initial states, and whether the question says something; [`super::steps`] asks about the diagrams. INVARIANT: where
//! [`Prover::all`] comes to its end no solver denies an obligation, and none was left out.

use explore::Told;
use solve::Outside;
use solve::shared::{Node, Terms};

use super::proof::{Gap, Known, Stuck};
use crate::coupling::Coupling;
use crate::formulas::Begun;
use crate::formulas::ask::{Ask, Model};
use crate::formulas::diagrams::{Answer, Diagrams};
use crate::formulas::obligation::{Origin, Said};
use crate::formulas::related::Related;
use crate::formulas::symbolic::{Replacement, Store, Symbolic};
use crate::options::Options;
use crate::report::Vacuous;
use crate::{ABSTRACT, CONCRETE};

/// Why a proof ends early.
pub(super) enum Ended {
    Gap(Gap),
    Vacuous(Vacuous),
}

impl From<Gap> for Ended {
    fn from(gap: Gap) -> Ended {
        Ended::Gap(gap)
    }
}

pub(super) fn outside(origin: Origin) -> impl Fn(Outside) -> Ended {
    move |outside| Ended::Gap(Gap::Outside(origin, outside))
}

/// A proof in the making.
pub(super) struct Prover<'p, 's, 'w> {
    pub coupling: &'p Coupling,
    pub options: &'p Options,
    pub ask: &'p mut Ask<'s, 'w>,
    pub store: &'p mut Store,
    pub diagrams: Vec<(u32, u32)>,
    pub known: Vec<Known>,
    /// By side, what the first initial state took from outside.
    pub begun: [Told; 2],
    /// The condition of the last obligation.
    pub asked: Node,
}

/// Where a diagram may end: that it comes so far, and the answers then.
pub(super) type End = (u32, Node, Vec<Answer>);

impl<'p, 's, 'w> Prover<'p, 's, 'w> {
    /// A proof about the formulas of a store, and the initial states of which they were made.
    pub fn new(
        coupling: &'p Coupling,
        options: &'p Options,
        ask: &'p mut Ask<'s, 'w>,
        store: &'p mut Store,
        starts: &[Vec<Told>; 2],
    ) -> Prover<'p, 's, 'w> {
        let begun = [ABSTRACT, CONCRETE].map(|side| starts[side].first().cloned().unwrap_or_default());
        Prover { coupling, options, ask, store, diagrams: Vec::new(), known: Vec::new(), begun, asked: Terms::FALSE }
    }

    /// Asks all questions, until one of them ends the proof.
    pub fn all(&mut self, machines: [&Symbolic; 2], related: &Related, begun: &[Begun]) -> Result<(), Ended> {
        self.begin(machines, related, begun)?;
        let invariants = self.invariants(machines, related);
        let hypothesis = self.hypothesis(machines, related);
        let hypothesis = self.store.terms.and([hypothesis, invariants]);
        self.sense(machines, related, hypothesis)?;
        let ends = self.steps(machines, related, hypothesis)?;
        self.uses(&ends);
        Ok(())
    }

    /// What is known of a pair of states that diagrams begin in.
    pub fn hypothesis(&mut self, machines: [&Symbolic; 2], related: &Related) -> Node {
        let terms = &mut self.store.terms;
        let coupled = related.perhaps(terms);
        let begins = if related.ends == Terms::TRUE { Terms::TRUE } else { machines[CONCRETE].begins(terms) };
        let ends = terms.or([related.ends, related.ends_stray, begins]);
        terms.and([machines[ABSTRACT].perhaps, machines[CONCRETE].perhaps, coupled, ends])
    }

    /// An obligation; unless it is accepted, the state in which it fails if a solver has one.
    pub fn oblige(&mut self, name: &str, claim: &str, condition: Node) -> Result<(), Option<Model>> {
        self.asked = condition;
        let model = self.ask.ask(&self.store.terms, name, claim, condition, false);
        let said = &self.ask.obligations[self.ask.last()].said;
        // Whether there are enough that accept it is judged at the end.
        match said.iter().all(|said| *said == Said::Impossible) {
            true => Ok(()),
            false => Err(model),
        }
    }

    /// The gap that the last obligation leaves.
    pub fn gap(&self, stuck: Option<Stuck>) -> Ended {
        let last = self.ask.last();
        Ended::Gap(match stuck {
            _ if self.ask.obligations[last].is_contradicted() => Gap::Contradicted(last),
            Some(stuck) => Gap::Stuck(last, Box::new(stuck)),
            None => Gap::Silent(last),
        })
    }

    /// Each initial state of the concrete machine corresponds to one of the abstract machine.
    fn begin(&mut self, machines: [&Symbolic; 2], related: &Related, begun: &[Begun]) -> Result<(), Ended> {
        let terms = &mut self.store.terms;
        let mut any = Vec::new();
        for Begun { concrete, answers } in begun {
            let other = answers.first().copied();
            let sides = [(CONCRETE, Some(*concrete)), (ABSTRACT, other)];
            let mut all = Vec::new();
            for (side, start) in sides {
                let Some(start) = start else { continue };
                for (id, value) in machines[side].state.iter().zip(&machines[side].starts[start]) {
                    let variable = terms.known(*id);
                    all.push(terms.equal(variable, *value));
                }
            }
            let holds = if other.is_some() { related.surely(terms) } else { Terms::FALSE };
            all.push(terms.not(holds));
            any.push(terms.and(all));
        }
        let fails = terms.or(any);
        let claim = "each initial state of the concrete machine corresponds to one of the abstract machine";
        self.oblige("initial", claim, fails).map_err(|_| self.gap(None))
    }

    /// The question says something: the coupling holds of a pair, it tells states apart, and the concrete machine makes a step.
    fn sense(&mut self, machines: [&Symbolic; 2], related: &Related, hypothesis: Node) -> Result<(), Ended> {
        let coupling = self.coupling;
        self.makes_sense("coupled", "the coupling holds of some pair of states", hypothesis, None)?;
        let store = &mut *self.store;
        // Two pairs whose states do not correspond crosswise: else the coupling is about each state alone.
        let mut copies = Vec::new();
        for id in machines.iter().flat_map(|machine| &machine.state) {
            let variable = store.terms.variable_of(*id);
            let (name, kind, bounds) = (format!("other {}", variable.name), variable.kind, variable.bounds);
            copies.push((*id, store.terms.variable(name, kind, bounds)));
        }
        let mut both = Replacement::new(copies.iter().copied());
        let other = store.replaced(hypothesis, &mut both);
        let concrete = copies.into_iter().filter(|(id, _)| machines[CONCRETE].state.contains(id));
        let mut cross = Replacement::new(concrete);
        let surely = related.surely(&mut store.terms);
        let crosswise = store.replaced(surely, &mut cross);
        let apart = store.terms.not(crosswise);
        let node = store.terms.and([hypothesis, other, apart]);
        self.makes_sense("tells apart", "the coupling tells states apart", node, Some(Vacuous::Total))?;
        let mut diagrams = Diagrams::new(coupling, machines, related, self.store);
        let step = diagrams.step(self.store).map_err(outside(Origin::Side(ABSTRACT)))?;
        let node = self.store.terms.and([hypothesis, step.facts, step.goes, step.changed]);
        let claim = "the concrete machine makes a step that changes its state, from a pair that corresponds";
        self.makes_sense("a step", claim, node, Some(Vacuous::NoStep))
    }

    fn makes_sense(&mut self, name: &str, claim: &str, node: Node, vacuous: Option<Vacuous>) -> Result<(), Ended> {
        self.ask.ask(&self.store.terms, name, claim, node, true);
        let last = &self.ask.obligations[self.ask.last()];
        if last.is_accepted() {
            return Ok(());
        }
        let denied = last.said.contains(&Said::Impossible);
        Err(match vacuous.filter(|_| denied) {
            _ if last.is_contradicted() => Gap::Contradicted(self.ask.last()).into(),
            Some(vacuous) => Ended::Vacuous(vacuous),
            // A pair of initial states corresponds, so the first of these checks is never denied.
            None => Gap::Silent(self.ask.last()).into(),
        })
    }
}
