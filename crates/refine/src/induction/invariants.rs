//! Invariants of the two machines as hypotheses of a proof, each proved before it is used.
//!
//! In: both machines and the coupling as formulas. Out: what holds of all pairs of states that runs come to, because the models' invariants
//! say so. Those that are not kept by every step are left out, until all that are left keep each other: they are inductive together, and
//! where a diagram has one concrete step, together with the coupling. INVARIANT: a machine's invariant is a hypothesis only if each initial
//! state surely has it, and each step that a run may make surely keeps it; two solvers must accept that like every other obligation.

use solve::shared::{Node, Terms};

use super::proof::Known;
use super::prover::Prover;
use crate::formulas::obligation::Said;
use crate::formulas::related::Related;
use crate::formulas::symbolic::{Replacement, Symbolic};
use crate::{ABSTRACT, CONCRETE, SIDES};

/// LIMIT: so long each solver may think about an invariant, in seconds.
const SECONDS: u32 = 10;

/// An invariant that may be used.
struct Candidate {
    side: usize,
    name: String,
    /// It surely holds of the state.
    holds: Node,
}

impl Prover<'_, '_, '_> {
    /// What the invariants say of every pair of states that is met, as far as that is proved; and `known` tells of each.
    pub fn invariants(&mut self, machines: [&Symbolic; 2], related: &Related) -> Node {
        let mut left: Vec<Candidate> = Vec::new();
        for side in [ABSTRACT, CONCRETE] {
            for (name, encoded) in &machines[side].invariants {
                match encoded {
                    Ok(holds) if !self.is_of_state(machines[side], *holds) => {
                        let why = "it depends on more than the state".to_string();
                        self.known.push(Known { side, name: name.clone(), unused: Some(why) });
                    }
                    Ok(holds) => left.push(Candidate { side, name: name.clone(), holds: *holds }),
                    Err(why) => self.known.push(Known { side, name: name.clone(), unused: Some(why.clone()) }),
                }
            }
        }
        let before = self.ask.obligations.len();
        let seconds = self.ask.seconds;
        self.ask.seconds = seconds.min(SECONDS);
        while !left.is_empty() && !self.ask.stopped {
            self.ask.obligations.truncate(before);
            let mut kept = Vec::new();
            let (mut fallen, all) = (false, self.all_of(&left));
            for candidate in left {
                let condition = self.fails(machines, related, &candidate, all);
                let claim = format!(
                    "the invariant {} holds of each initial state of the {} machine, and each step keeps it",
                    candidate.name, SIDES[candidate.side]
                );
                let name = format!("{} kept", candidate.name);
                self.ask.ask(&self.store.terms, &name, &claim, condition, false);
                let said = &self.ask.obligations[self.ask.last()].said;
                if !said.is_empty() && said.iter().all(|said| *said == Said::Impossible) {
                    kept.push(candidate);
                    continue;
                }
                fallen = true;
                let why = match said.contains(&Said::Possible) {
                    true => "the induction does not prove it",
                    false => "not all solvers decide whether it is kept",
                };
                self.known.push(Known { side: candidate.side, name: candidate.name, unused: Some(why.to_string()) });
            }
            left = kept;
            if !fallen {
                break;
            }
        }
        self.ask.seconds = seconds;
        if left.is_empty() || self.ask.stopped {
            self.ask.obligations.truncate(before);
            return Terms::TRUE;
        }
        let all = self.all_of(&left);
        self.known.extend(left.into_iter().map(|one| Known { side: one.side, name: one.name, unused: None }));
        all
    }

    /// A formula over more than the state would say nothing of a state.
    fn is_of_state(&self, machine: &Symbolic, holds: Node) -> bool {
        self.store.terms.variables_of([holds]).iter().all(|id| machine.state.contains(id))
    }

    fn all_of(&mut self, candidates: &[Candidate]) -> Node {
        self.store.terms.and(candidates.iter().map(|candidate| candidate.holds))
    }

    /// An initial state does not have an invariant, or a step from a state that has `all` does not keep it.
    fn fails(&mut self, machines: [&Symbolic; 2], related: &Related, candidate: &Candidate, all: Node) -> Node {
        let machine = machines[candidate.side];
        let mut any = Vec::new();
        for start in &machine.starts {
            let mut by = Replacement::new(machine.state.iter().copied().zip(start.iter().copied()));
            let there = self.store.replaced(candidate.holds, &mut by);
            any.push(self.store.terms.not(there));
        }
        let mut by = Replacement::new(machine.state.iter().copied().zip(machine.next.iter().copied()));
        let there = self.store.replaced(candidate.holds, &mut by);
        let lost = self.store.terms.not(there);
        let mut step = vec![machine.perhaps, all, machine.goes, lost];
        if candidate.side == CONCRETE {
            // A state that the assumptions do not admit is none that a run comes to.
            step.push(self.store.replaced(machine.perhaps, &mut by));
            step.extend(machine.given.iter().copied());
            if self.coupling.diagrams.most_concrete() == 1 {
                // Each state of a run is then one of a pair that corresponds.
                step.push(self.hypothesis(machines, related));
            }
        }
        any.push(self.store.terms.and(step));
        self.store.terms.or(any)
    }
}
