//! Symbolic reachability: all reachable states as one binary decision diagram.
//!
//! In: a program and the targets, as for [`crate::explicit`]. Out: a [`Reach`] with its findings. The steps of a set
//! are the machine's own, learned as they are reached ([`explore::StateSets`]). The closure applies one part of the
//! step after another (chaining: O. Roig, J. Cortadella, E. Pastor, *Verification of asynchronous circuits by BDD-based
//! model checking of Petri nets*, 1995), which needs fewer rounds than going level by level. Levels are computed only
//! after a finding, for a shortest run to it.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use explore::{
    Alternative, AlternativeKind, Explorer, Interner, SetTrouble, StateSets, Trouble, Truth, Unbounded, Widening,
};
use machine::EngineChoice;
use program::Program;
use rustc_hash::FxHashSet;

use crate::plan::Plan;
use crate::progress::{Progress, Stop};
use crate::symbolic::bdd::{Diagrams, Full, Set};
use crate::symbolic::order::force;
use crate::target::{Found, Target};
use crate::trace::{Trace, tell};

/// LIMIT: how many states are first explored one by one, to see what steps read.
const SAMPLE: usize = 2000;
/// Bytes per node, with its share of the tables.
const NODE: u64 = 40;
/// LIMIT: the most nodes.
const NODES: u64 = 1 << 24;

/// A symbolic search that has ended.
pub(crate) struct Reach {
    explorer: Explorer,
    diagrams: Diagrams,
    /// The states by distance, as far as computed.
    rings: Vec<Set>,
    /// The findings, at most one per target.
    pub found: Vec<Found>,
    /// Why it ended early; `None` if all states were explored.
    pub stop: Option<Stop>,
    /// How far it came.
    pub progress: Progress,
    /// What could not be enumerated.
    pub unbounded: BTreeSet<Unbounded>,
    /// Conditions whose truth is unknown in some state.
    pub unknown: BTreeSet<usize>,
}

/// Why the search ends.
enum Halt {
    Narrow(Widening),
    Stopped(Stop),
}

impl From<Full> for Halt {
    fn from(_: Full) -> Halt {
        Halt::Stopped(Stop::Memory)
    }
}

impl From<SetTrouble<Full>> for Halt {
    fn from(trouble: SetTrouble<Full>) -> Halt {
        match trouble {
            SetTrouble::Narrow(widening) => Halt::Narrow(widening),
            SetTrouble::Crowded | SetTrouble::Failed(Full) => Halt::Stopped(Stop::Memory),
            // The caller may have asked to stop instead; that is checked later.
            SetTrouble::Interrupted => Halt::Stopped(Stop::Memory),
        }
    }
}

/// The steps of a set of states.
struct Steps {
    next: Set,
    /// The states with an alternative that changes them, with one that does not, with one that faults …
    moved: Set,
    stayed: Set,
    faults: [Set; 3],
    unbounded: Set,
    /// For each condition on steps, the states with an alternative that violates it.
    failing: BTreeMap<usize, Set>,
}

impl Reach {
    /// Explores all states of a program. The thread must never have had other diagrams ([`super::apart`]).
    ///
    /// # Errors
    /// There is no initial state, or the states do not fit.
    pub fn attempt(
        program: &Arc<Program>,
        plan: &Plan,
        widening: &Widening,
        watch: &mut dyn FnMut(&Progress) -> bool,
    ) -> Result<Reach, Trouble> {
        let interner = Arc::new(Interner::default());
        let mut settings = plan.settings.clone();
        settings.forgetful = false;
        // Sets are walked over the tree of decisions.
        settings.engine = EngineChoice::Interpreted;
        settings.numbered = true;
        let mut explorer = Explorer::new(program, settings, widening, &interner)?;
        sample(&mut explorer, &plan.assumed).map_err(Trouble::TooNarrow)?;
        let fields = explorer.fields();
        let order = force(fields.len(), &explorer.dependencies());
        let order: Vec<_> = order.into_iter().map(|field| fields[field]).collect();
        let nodes = (plan.max_bytes / NODE).clamp(1 << 12, NODES) as usize;
        let diagrams = Diagrams::new(&order, explorer.words(), nodes).expect("room for the variables");
        let mut reach = Reach {
            explorer,
            diagrams,
            rings: Vec::new(),
            found: Vec::new(),
            stop: None,
            progress: Progress::default(),
            unbounded: BTreeSet::new(),
            unknown: BTreeSet::new(),
        };
        match reach.search(plan, watch) {
            Ok(()) => {}
            Err(Halt::Narrow(widening)) => return Err(Trouble::TooNarrow(widening)),
            Err(Halt::Stopped(stop)) => {
                reach.stop = Some(plan.settings.interrupt.cause().map_or(stop, Stop::from));
            }
        }
        reach.unbounded = reach.explorer.unbounded().clone();
        Ok(reach)
    }

    fn search(&mut self, plan: &Plan, watch: &mut dyn FnMut(&Progress) -> bool) -> Result<(), Halt> {
        let initial = self.initial(plan)?;
        let reached = self.close(plan, &initial, watch)?;
        self.count_blocked(plan, &reached)?;
        let targets = self.targets(plan, &reached)?;
        self.locate(plan, initial, targets, watch)
    }

    /// The initial states.
    fn initial(&mut self, plan: &Plan) -> Result<Set, Halt> {
        let mut set = self.diagrams.empty();
        let states: Vec<Box<[u64]>> = self.explorer.initial().iter().map(|(state, _)| state.into()).collect();
        for state in states {
            let state = self.diagrams.state(&state)?;
            set = self.diagrams.union(&set, &state)?;
        }
        self.admit(plan, set)
    }

    /// Removes states that violate an assumption.
    fn admit(&mut self, plan: &Plan, set: Set) -> Result<Set, Halt> {
        let mut admitted = set.clone();
        for condition in &plan.assumed {
            for (truth, states) in self.explorer.truths(*condition, &mut self.diagrams, &set)? {
                admitted = self.diagrams.minus(&admitted, &states)?;
                if matches!(truth, Truth::Fault | Truth::Unknown) {
                    self.unknown.insert(*condition);
                }
            }
        }
        Ok(admitted)
    }

    /// All reachable states.
    fn close(&mut self, plan: &Plan, initial: &Set, watch: &mut dyn FnMut(&Progress) -> bool) -> Result<Set, Halt> {
        let mut reached = initial.clone();
        let mut frontier = initial.clone();
        while !self.diagrams.is_empty(&frontier) {
            while !self.diagrams.is_empty(&frontier) {
                self.report(plan, &reached, &frontier, watch)?;
                let mut open = std::mem::replace(&mut frontier, self.diagrams.empty());
                for part in 0..self.explorer.parts() {
                    self.go_on(plan, &mut |_| true)?;
                    let steps = self.expand(&open, Some(part))?;
                    let new = self.diagrams.minus(&steps.next, &reached)?;
                    let new = self.admit(plan, new)?;
                    reached = self.diagrams.union(&reached, &new)?;
                    frontier = self.diagrams.union(&frontier, &new)?;
                    open = self.diagrams.union(&open, &new)?;
                }
            }
            // If no single part adds states, all parts together still may.
            let steps = self.expand(&reached, None)?;
            let new = self.diagrams.minus(&steps.next, &reached)?;
            frontier = self.admit(plan, new)?;
            reached = self.diagrams.union(&reached, &frontier)?;
        }
        self.report(plan, &reached, &frontier, watch)?;
        Ok(reached)
    }

    fn go_on(&self, plan: &Plan, watch: &mut dyn FnMut(&Progress) -> bool) -> Result<(), Halt> {
        match plan.settings.interrupt.cause() {
            Some(cause) => Err(Halt::Stopped(cause.into())),
            None if watch(&self.progress) => Ok(()),
            None => Err(Halt::Stopped(Stop::Asked)),
        }
    }

    fn report(
        &mut self,
        plan: &Plan,
        reached: &Set,
        frontier: &Set,
        watch: &mut dyn FnMut(&Progress) -> bool,
    ) -> Result<(), Halt> {
        self.progress = Progress {
            states: self.diagrams.count(reached) as u64,
            transitions: 0,
            queue: self.diagrams.count(frontier) as u64,
            depth: self.progress.depth + 1,
            bytes: self.diagrams.nodes() as u64 * NODE,
            ..Progress::default()
        };
        self.go_on(plan, watch)
    }

    /// The steps of a set: of one part, or of all.
    fn expand(&mut self, set: &Set, part: Option<usize>) -> Result<Steps, Halt> {
        let empty = || self.diagrams.empty();
        let mut steps = Steps {
            next: empty(),
            moved: empty(),
            stayed: empty(),
            faults: [empty(), empty(), empty()],
            unbounded: empty(),
            failing: BTreeMap::new(),
        };
        let whole = part.is_none();
        let mut visit = |sets: &mut Diagrams, alternative: &Alternative<'_>, states: &Set| -> Result<(), Full> {
            if whole {
                for condition in alternative.failed {
                    let failing = steps.failing.entry(*condition as usize).or_insert_with(|| sets.empty());
                    *failing = sets.union(failing, states)?;
                }
            }
            let kind = match alternative.kind {
                AlternativeKind::Next => {
                    let image = sets.image(states, alternative.overwrites)?;
                    steps.next = sets.union(&steps.next, &image)?;
                    if whole {
                        let unmoved = sets.unmoved(states, alternative.overwrites)?;
                        let moved = sets.minus(states, &unmoved)?;
                        steps.moved = sets.union(&steps.moved, &moved)?;
                        steps.stayed = sets.union(&steps.stayed, &unmoved)?;
                    }
                    return Ok(());
                }
                AlternativeKind::Fault(class) => &mut steps.faults[class as usize],
                AlternativeKind::Unbounded => &mut steps.unbounded,
                AlternativeKind::Excluded => return Ok(()),
            };
            *kind = sets.union(kind, states)?;
            Ok(())
        };
        if let Some(part) = part {
            self.explorer.expand_part(part, &mut self.diagrams, set, &mut visit)?;
            return Ok(steps);
        }
        self.each_alternative(set, &mut visit)?;
        Ok(steps)
    }

    /// Visits the alternatives of all steps of a set.
    fn each_alternative(
        &mut self,
        set: &Set,
        visit: &mut dyn FnMut(&mut Diagrams, &Alternative<'_>, &Set) -> Result<(), Full>,
    ) -> Result<(), Halt> {
        let mut none = set.clone();
        for part in 0..self.explorer.parts() {
            if let Some(alive) = self.explorer.expand_part(part, &mut self.diagrams, set, visit)? {
                none = self.diagrams.minus(&none, &alive)?;
            }
        }
        self.explorer.expand_otherwise(&mut self.diagrams, &none, visit)?;
        Ok(())
    }

    /// Counts the states of which the assumptions leave no step, among all that are reachable: no alternative leads to one of these.
    fn count_blocked(&mut self, plan: &Plan, reached: &Set) -> Result<(), Halt> {
        let assumes = !plan.assumed.is_empty() || plan.settings.step_conditions.iter().any(|(_, assumed)| *assumed);
        if !assumes {
            return Ok(());
        }
        let mut alive = self.diagrams.empty();
        let mut visit = |sets: &mut Diagrams, alternative: &Alternative<'_>, states: &Set| -> Result<(), Full> {
            let goes_on = match alternative.kind {
                AlternativeKind::Next => sets.preimage(states, alternative.overwrites, reached)?,
                AlternativeKind::Fault(_) | AlternativeKind::Unbounded => states.clone(),
                AlternativeKind::Excluded => return Ok(()),
            };
            alive = sets.union(&alive, &goes_on)?;
            Ok(())
        };
        self.each_alternative(reached, &mut visit)?;
        let blocked = self.diagrams.minus(reached, &alive)?;
        let count = self.diagrams.count(&blocked) as u64;
        // The counts of large sets are rounded.
        let most = self.progress.states - u64::from(!self.diagrams.is_empty(&alive));
        self.progress.blocked = count.min(most);
        Ok(())
    }

    /// The targets found in a set of states, and the states with each.
    fn targets(&mut self, plan: &Plan, set: &Set) -> Result<BTreeMap<Target, Set>, Halt> {
        let mut targets = BTreeMap::new();
        let steps = self.expand(set, None)?;
        let mut rest = self.diagrams.minus(&steps.stayed, &steps.moved)?;
        for (class, states) in steps.faults.iter().enumerate() {
            rest = self.diagrams.minus(&rest, states)?;
            targets.insert(Target::Fault(class), states.clone());
        }
        rest = self.diagrams.minus(&rest, &steps.unbounded)?;
        if let Some(terminal) = plan.terminal {
            let mut stuck = self.diagrams.empty();
            for (truth, states) in self.explorer.truths(terminal, &mut self.diagrams, &rest)? {
                if matches!(truth, Truth::Fault | Truth::Unknown) {
                    self.unknown.insert(terminal);
                } else {
                    stuck = self.diagrams.union(&stuck, &states)?;
                }
            }
            rest = stuck;
        }
        targets.insert(Target::Rest, rest);
        for (condition, states) in steps.failing {
            if plan.wanted_steps.contains(&condition) {
                targets.insert(Target::StepCondition(condition), states);
            }
        }
        for condition in &plan.wanted {
            let mut violating = self.diagrams.empty();
            for (truth, states) in self.explorer.truths(*condition, &mut self.diagrams, set)? {
                if truth == Truth::Unknown {
                    self.unknown.insert(*condition);
                } else {
                    violating = self.diagrams.union(&violating, &states)?;
                }
            }
            targets.insert(Target::Condition(*condition), violating);
        }
        targets.retain(|_, states| !self.diagrams.is_empty(states));
        Ok(targets)
    }

    /// Computes the levels until each target is found.
    fn locate(
        &mut self,
        plan: &Plan,
        initial: Set,
        mut targets: BTreeMap<Target, Set>,
        watch: &mut dyn FnMut(&Progress) -> bool,
    ) -> Result<(), Halt> {
        let mut reached = initial.clone();
        let mut ring = initial;
        while !targets.is_empty() && !self.diagrams.is_empty(&ring) {
            let depth = self.rings.len();
            let mut met = Vec::new();
            for (target, states) in &targets {
                let here = self.diagrams.and(states, &ring)?;
                if !self.diagrams.is_empty(&here) {
                    met.push(Found { target: *target, depth, state: self.diagrams.member(&here) });
                }
            }
            for found in met {
                targets.remove(&found.target);
                self.found.push(found);
            }
            self.rings.push(ring.clone());
            if targets.is_empty() {
                break;
            }
            self.go_on(plan, watch)?;
            let steps = self.expand(&ring, None)?;
            let new = self.diagrams.minus(&steps.next, &reached)?;
            ring = self.admit(plan, new)?;
            reached = self.diagrams.union(&reached, &ring)?;
        }
        self.found.sort_by_key(|found| found.target);
        Ok(())
    }

    /// A shortest run to each finding, in the order of `found`. A finding whose run needs too much memory is dropped.
    pub fn traces(&mut self) -> Vec<Trace> {
        // Findings are reported however long that takes.
        self.explorer.ignore_interrupts();
        let mut traces = Vec::new();
        for found in std::mem::take(&mut self.found) {
            match self.chain(&found) {
                Ok(chain) => {
                    traces.push(tell(&mut self.explorer, &chain, &found));
                    self.found.push(found);
                }
                Err(Halt::Stopped(stop)) => self.stop = Some(stop),
                Err(Halt::Narrow(_)) => self.stop = Some(Stop::Memory),
            }
        }
        traces
    }

    /// The states on the way to a finding.
    fn chain(&mut self, found: &Found) -> Result<Vec<Box<[u64]>>, Halt> {
        let mut chain = vec![found.state.clone()];
        for level in (0..found.depth).rev() {
            let last = chain[chain.len() - 1].clone();
            chain.push(self.parent(level, &last)?);
        }
        chain.reverse();
        Ok(chain)
    }

    /// A state of a level that leads to a state of the next one.
    fn parent(&mut self, level: usize, of: &[u64]) -> Result<Box<[u64]>, Halt> {
        let ring = self.rings[level].clone();
        let of = self.diagrams.state(of)?;
        let mut parents = self.diagrams.empty();
        let mut visit = |sets: &mut Diagrams, alternative: &Alternative<'_>, states: &Set| -> Result<(), Full> {
            if alternative.kind == AlternativeKind::Next {
                let some = sets.preimage(states, alternative.overwrites, &of)?;
                parents = sets.union(&parents, &some)?;
            }
            Ok(())
        };
        self.each_alternative(&ring, &mut visit)?;
        Ok(self.diagrams.member(&parents))
    }

    /// For each rule, whether some step ran it.
    pub fn executed(&self) -> Vec<bool> {
        self.explorer.executed()
    }

    /// How many words a state has, and how many bits of them are used.
    pub fn width(&self) -> (usize, usize) {
        (self.explorer.words(), self.explorer.bits())
    }
}

/// Expands some states one by one, to see what steps read; only those that the assumptions admit, since what cannot be gone through in
/// another one is no concern of the search.
fn sample(explorer: &mut Explorer, assumed: &[usize]) -> Result<(), Widening> {
    let admits = |explorer: &mut Explorer, state: &[u64]| {
        assumed.iter().all(|condition| explorer.truth(*condition, state) == Truth::True)
    };
    let words = explorer.words();
    let mut states: Vec<Box<[u64]>> = explorer.initial().iter().map(|(state, _)| state.into()).collect();
    states.retain(|state| admits(explorer, state));
    let mut met: FxHashSet<Box<[u64]>> = states.iter().cloned().collect();
    let mut successors = Vec::new();
    let mut next = 0;
    while next < states.len().min(SAMPLE) {
        successors.clear();
        explorer.expand(&states[next], &mut successors)?;
        for successor in successors.chunks_exact(words) {
            if states.len() < SAMPLE && met.insert(successor.into()) && admits(explorer, successor) {
                states.push(successor.into());
            }
        }
        next += 1;
    }
    Ok(())
}
