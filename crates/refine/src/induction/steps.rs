//! The obligations about diagrams, one concrete step after the other.
//!
//! In: both machines and the coupling as formulas, what is known of a pair. Out: where diagrams may end, with the answers; or the gap. A step
//! behind which the diagram may end need be answered only if no longer diagram is: what is left goes on. INVARIANT: the last obligation
//! leaves nothing.

use explore::input_values;
use machine::{Fault, FaultClass};
use solve::shared::{Node, Terms};

use super::proof::Gap;
use super::prover::{End, Ended, Prover, outside};
use super::replay::{Scene, Stage, faults};
use super::stuck;
use crate::formulas::answers::Offered;
use crate::formulas::diagrams::{Answer, Diagrams, Step};
use crate::formulas::obligation::{Obligation, Origin, Said};
use crate::formulas::related::Related;
use crate::formulas::symbolic::{Symbolic, class_in_words, nowhere};
use crate::{ABSTRACT, CONCRETE};

/// LIMIT: so many diagrams are asked whether answers use them.
const USES: usize = 24;

impl Prover<'_, '_, '_> {
    /// The diagrams, one concrete step after the other.
    pub fn steps(&mut self, machines: [&Symbolic; 2], related: &Related, hypothesis: Node) -> Result<Vec<End>, Ended> {
        let coupling = self.coupling;
        let most = coupling.diagrams.most_concrete();
        let has_end = coupling.segment.is_some();
        let mut diagrams = Diagrams::new(coupling, machines, related, self.store);
        let mut path = hypothesis;
        let mut steps: Vec<Step> = Vec::new();
        let mut ends: Vec<End> = Vec::new();
        for n in 1..=most {
            let step = diagrams.step(self.store).map_err(outside(Origin::Side(ABSTRACT)))?;
            let here = self.store.terms.and([path, step.facts]);
            let (goes, ends_here, ends_stray) = (step.goes, step.ends, step.ends_stray);
            steps.push(step);
            self.step_is_made(machines, here, &steps)?;
            self.step_is_told(here, &steps)?;
            let gone = self.store.terms.and([here, goes]);
            if ends_stray != Terms::FALSE {
                let odd = self.store.terms.and([gone, ends_stray]);
                let claim = format!("whether a segment ends behind step {n} is what the solvers were told");
                if self.oblige(&format!("segment {n} told"), &claim, odd).is_err() {
                    let what = nowhere("the term behind `segment`, at arguments outside of their domains");
                    return Err(Gap::Outside(Origin::Coupling, what).into());
                }
            }
            let answers = diagrams.answers(self.store).map_err(outside(Origin::Side(ABSTRACT)))?;
            let answered = self.store.terms.or(answers.iter().map(|answer| answer.holds));
            let not = self.store.terms.not(answered);
            let ended = self.store.terms.and([gone, ends_here]);
            ends.push((n, ended, answers));
            if has_end {
                let unmatched = self.store.terms.and([ended, not]);
                self.step_is_answered(machines, unmatched, &steps, &ends, &diagrams.offered)?;
                let further = self.store.terms.not(ends_here);
                path = self.store.terms.and([gone, further]);
                if self.segment_is_over(machines, path, &steps, n, most)? {
                    break;
                }
            } else {
                path = self.store.terms.and([gone, not]);
                if n == most || self.is_over(path) {
                    self.step_is_answered(machines, path, &steps, &ends, &diagrams.offered)?;
                    break;
                }
            }
            if self.ask.stopped {
                return Err(Gap::Stopped.into());
            }
        }
        Ok(ends)
    }

    /// Whether nothing is left to be answered by longer diagrams; asked of one solver, to know whether the obligation is worth it.
    fn is_over(&mut self, path: Node) -> bool {
        !self.ask.possible(&self.store.terms, path) && !self.ask.stopped && self.surely_not(path)
    }

    /// All solvers say that a condition cannot hold.
    fn surely_not(&mut self, path: Node) -> bool {
        self.ask.ask(&self.store.terms, "", "", path, false);
        let asked = self.ask.obligations.pop();
        asked.is_some_and(|asked: Obligation| asked.said.iter().all(|said| *said == Said::Impossible))
    }

    fn step_is_made(&mut self, machines: [&Symbolic; 2], here: Node, steps: &[Step]) -> Result<(), Ended> {
        let n = steps.len();
        let step = &steps[n - 1];
        let faults = self.store.terms.or(step.faults.iter().map(|one| one.1));
        let fails = self.store.terms.and([here, faults]);
        let claim = format!("the concrete machine can make step {n} of a diagram, whatever its inputs and choices");
        let Err(model) = self.oblige(&format!("step {n} made"), &claim, fails) else { return Ok(()) };
        let stuck = model.map(|model| {
            let of = step.faults.iter().map(|(words, node)| (*node, words));
            let fault = stuck::which(self.store, &model, of).copied().unwrap_or("a fault");
            let scene = stuck::before(self.store, machines[CONCRETE], &model, step);
            let words = Some(fault.to_string());
            let mut stuck = stuck::tell(self.store, self.coupling, machines, &model, steps, &[], words);
            // What the solver says it comes to goes before what else the machine may come to.
            let is_said = |other: &Fault| class_in_words(FaultClass::of(other)) == fault;
            stuck.faults[CONCRETE] = self.faults(CONCRETE, scene, is_said);
            stuck
        });
        Err(self.gap(stuck))
    }

    fn step_is_told(&mut self, here: Node, steps: &[Step]) -> Result<(), Ended> {
        let n = steps.len();
        let step = &steps[n - 1];
        let strays = self.store.terms.or(step.strays.iter().map(|one| one.0));
        if strays == Terms::FALSE {
            return Ok(());
        }
        let fails = self.store.terms.and([here, strays]);
        let claim = format!("in step {n} of a diagram the concrete machine does only what the solvers were told");
        let Err(model) = self.oblige(&format!("step {n} told"), &claim, fails) else { return Ok(()) };
        let which = model.and_then(|model| {
            let of = step.strays.iter().map(|(node, outside)| (*node, outside));
            stuck::which(self.store, &model, of).cloned()
        });
        Err(match which {
            Some(what) => Gap::Outside(Origin::Side(CONCRETE), what).into(),
            None => self.gap(None),
        })
    }

    fn step_is_answered(
        &mut self,
        machines: [&Symbolic; 2],
        unmatched: Node,
        steps: &[Step],
        ends: &[End],
        offered: &Offered,
    ) -> Result<(), Ended> {
        let n = steps.len();
        let counted = if n == 1 { "one step".to_string() } else { format!("{n} steps") };
        let claim = format!("what the concrete machine does in {counted} the abstract machine answers");
        let Err(model) = self.oblige(&format!("step {n} answered"), &claim, unmatched) else { return Ok(()) };
        let stuck = model.map(|model| {
            let answers: Vec<Answer> = ends.last().map(|(.., answers)| answers.clone()).unwrap_or_default();
            let mut stuck = stuck::tell(self.store, self.coupling, machines, &model, steps, &answers, None);
            if answers.iter().any(|answer| answer.m > 0) {
                let scene = stuck::behind(self.store, machines[ABSTRACT], &model, offered);
                stuck.faults[ABSTRACT] = self.faults(ABSTRACT, scene, |_| false);
            }
            stuck
        });
        Err(self.gap(stuck))
    }

    /// The faults that a machine comes to in a state that a solver gave.
    fn faults(&self, side: usize, scene: Option<Scene>, first: impl Fn(&Fault) -> bool) -> Vec<Fault> {
        let extent = &self.options.extents[side];
        let program = &self.coupling.programs[side];
        let bounds = input_values(program, &extent.bounds, &extent.undefined);
        let stage = Stage { program, limits: &extent.limits, start: &self.begun[side], bounds: &bounds };
        scene.map_or_else(Vec::new, |scene| faults(stage, &scene, first))
    }

    /// Whether each segment has ended after so many steps. After the most it must have.
    fn segment_is_over(
        &mut self,
        machines: [&Symbolic; 2],
        path: Node,
        steps: &[Step],
        n: u32,
        most: u32,
    ) -> Result<bool, Ended> {
        if n < most && (self.ask.possible(&self.store.terms, path) || !self.surely_not(path)) {
            return Ok(false);
        }
        let counted = if n == 1 { "one step".to_string() } else { format!("{n} steps") };
        let claim = format!("a segment has at most {counted} of the concrete machine");
        let Err(model) = self.oblige("segment over", &claim, path) else { return Ok(true) };
        let fault = Some(format!("a segment that does not end within {counted}"));
        let stuck = model.map(|model| stuck::tell(self.store, self.coupling, machines, &model, steps, &[], fault));
        Err(self.gap(stuck))
    }

    /// Finds which diagrams the answers use: those that are preferred where there are several.
    pub fn uses(&mut self, ends: &[End]) {
        let mut asked = 0;
        for (n, base, answers) in ends {
            let mut left = *base;
            let mut sizes: Vec<u32> = answers.iter().map(|answer| answer.m).collect();
            sizes.dedup();
            for m in sizes {
                let holds = answers.iter().filter(|answer| answer.m == m).map(|answer| answer.holds);
                let any = self.store.terms.or(holds.collect::<Vec<_>>());
                let used = self.store.terms.and([left, any]);
                asked += 1;
                if used != Terms::FALSE && asked <= USES && self.ask.possible(&self.store.terms, used) {
                    self.diagrams.push((m, *n));
                }
                let not = self.store.terms.not(any);
                left = self.store.terms.and([left, not]);
            }
        }
    }
}
