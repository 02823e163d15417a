//! The explorer: from packed states to their packed successors.
//!
//! In: a program, the bounds of its inputs, the conditions that are asked for. It makes each step with a machine at first
//! and remembers what the step looked at, and walks [`Tree`]s from then on. Several explorers of one program, made with
//! the same settings and one [`Interner`], pack states alike. INVARIANT: what comes out does not depend on what was
//! remembered.

use std::cmp::Ordering;
use std::collections::BTreeSet;
use std::sync::Arc;

use hashbrown::HashMap;
use program::{Expression, Program};
use rustc_hash::{FxBuildHasher, FxHashSet};
use syntax::Span;

use crate::coverage::Coverage;
use crate::explore::branches::{Bounds, Branches, REST, Unbounded, UnboundedKind};
use crate::explore::conditions::Condition;
use crate::explore::encoding::{Encoding, TooNarrow, Widening};
use crate::explore::interner::{Interner, View};
use crate::explore::paths::Told;
use crate::explore::sets::Overwrite;
use crate::explore::sighted::Sighting;
use crate::explore::tree::{DEAD, End, Tree};
use crate::fault::{Fault, FaultKind};
use crate::limits::Limits;
use crate::location::Location;
use crate::machine::{EngineChoice, Machine};
use crate::observe::Observation;
use crate::value::Value;

/// What an explorer is made with.
#[derive(Debug, Clone, Default)]
pub struct Settings {
    /// The machine's limits.
    pub limits: Limits,
    /// The values of inputs that are not all those of their domains.
    pub bounds: Arc<Bounds>,
    /// Conditions on states.
    pub conditions: Vec<Expression>,
    /// Conditions on a state with the inputs of its step; whether each is an assumption, by which alternatives are left
    /// out.
    pub step_conditions: Vec<(Expression, bool)>,
    /// Nothing is remembered.
    pub forgetful: bool,
    /// What happens within steps is told: see [`Explorer::sightings`].
    pub observed: bool,
    /// By term, where any is: a range whose elements are to be interchangeable. Quantifiers look at all of them, and where a
    /// fault may depend on their order [`Explorer::order_mattered`] tells.
    pub unordered: Arc<[bool]>,
}

/// Why there is no explorer.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Trouble {
    /// An initial state cannot be made.
    Fault(Box<Fault>),
    /// The initial states cannot be gone through.
    Unbounded(Unbounded),
    /// The states do not fit: try again with this.
    TooNarrow(Widening),
}

/// What the alternatives of a state came to, all together.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Expansion {
    /// Alternatives that change the state.
    pub moved: u32,
    /// Alternatives that leave it as it is.
    pub stayed: u32,
    /// Alternatives that are faults, by [`FaultClass`].
    pub faults: [u32; 3],
    /// Alternatives that cannot be gone through.
    pub unbounded: u32,
    /// Alternatives in which a condition on the step does not hold.
    pub failed: u32,
    /// Alternatives that an assumption leaves out.
    pub excluded: u32,
}

/// What an end of the tree of steps means.
#[derive(Debug, Clone, Copy)]
pub(super) struct Effect {
    pub kind: Kind,
    /// A condition on the step does not hold.
    pub failed: bool,
    /// Which of the overwrites are its own.
    first: u32,
    len: u32,
}

/// What kind of fault a step met, as far as a search tells them apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum FaultClass {
    /// An inconsistent update.
    Inconsistent,
    /// A value outside its domain.
    OutOfDomain,
    /// Anything else that has no meaning: an undefined guard, a division by zero.
    Undefined,
}

impl FaultClass {
    /// The class of a fault.
    pub fn of(fault: &Fault) -> FaultClass {
        match fault.kind {
            FaultKind::InconsistentUpdate { .. } => FaultClass::Inconsistent,
            FaultKind::OutOfDomain { .. } => FaultClass::OutOfDomain,
            _ => FaultClass::Undefined,
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Next,
    Fault(FaultClass),
    Unbounded,
    Excluded,
}

/// What became of one alternative.
pub(super) struct Attempt {
    pub kind: Kind,
    pub fault: Option<Box<Fault>>,
    pub failed: Vec<u32>,
    pub overwrites: Vec<Overwrite>,
}

/// See the module.
#[derive(Debug)]
pub struct Explorer {
    pub(super) program: Arc<Program>,
    pub(super) machine: Machine,
    pub(super) branches: Branches,
    pub(super) encoding: Encoding,
    pub(super) view: View,
    pub(super) settings: Settings,
    pub(super) steps: Tree,
    pub(super) effects: Vec<Effect>,
    overwrites: Vec<Overwrite>,
    /// By end, the conditions on the step that do not hold, where there are any.
    failures: HashMap<End, Box<[u32]>, FxBuildHasher>,
    pub(super) conditions: Vec<Condition>,
    /// The packed state that the machine is in.
    loaded: Vec<u64>,
    is_loaded: bool,
    initial: Vec<(Box<[u64]>, Told)>,
    /// What could not be gone through.
    pub(super) unbounded: BTreeSet<Unbounded>,
    pub(super) sightings: Vec<Sighting>,
    /// What was seen in steps that are faults.
    pub(super) in_faults: FxHashSet<Observation>,
}

impl Explorer {
    /// An explorer of a program's states.
    ///
    /// # Errors
    /// See [`Trouble`].
    pub fn new(
        program: &Arc<Program>,
        settings: Settings,
        widening: &Widening,
        interner: &Arc<Interner>,
    ) -> Result<Explorer, Trouble> {
        let mut machine = Machine::new(Arc::clone(program), settings.limits);
        machine.use_engine(EngineChoice::Interpreted);
        machine.enable_coverage();
        machine.core.exploring = true;
        let mut branches = Branches::new(Arc::clone(&settings.bounds));
        let mut starts = Vec::new();
        branches.first();
        loop {
            if let Err(fault) = machine.start(&mut branches) {
                return Err(match branches.unbounded {
                    Some(unbounded) => Trouble::Unbounded(unbounded),
                    None => Trouble::Fault(Box::new(fault)),
                });
            }
            let told =
                Told { inputs: machine.inputs(), choices: std::mem::take(&mut branches.chosen), ..Told::default() };
            starts.push((machine.snapshot(), told));
            if !branches.next() {
                break;
            }
        }
        let values: Vec<Vec<Value>> = starts
            .iter()
            .map(|(snapshot, _)| {
                machine.restore(snapshot);
                machine.core.store.values.clone()
            })
            .collect();
        let encoding = Encoding::new(program, &mut machine, &values, widening);
        let mut view = View::new(Arc::clone(interner));
        let mut initial = Vec::new();
        for (snapshot, told) in starts {
            machine.restore(&snapshot);
            let words = encoding.pack(program, &mut machine, &mut view);
            initial.push((words.map_err(|TooNarrow(widening)| Trouble::TooNarrow(widening))?, told));
        }
        if !settings.unordered.is_empty() {
            machine.core.unordered = Arc::clone(&settings.unordered);
            // Values that were kept may come from quantifiers that did not look at all elements.
            machine.core.memo.forget();
        }
        branches.fields = Arc::clone(&encoding.of_location);
        branches.rest = encoding.rest;
        let conditions =
            settings.conditions.iter().map(|formula| Condition::new(program, &mut machine, formula)).collect();
        let observed = settings.observed;
        let mut explorer = Explorer {
            program: Arc::clone(program),
            machine,
            branches,
            loaded: vec![0; encoding.words],
            encoding,
            view,
            settings,
            steps: Tree::default(),
            // The first end is that of the dead.
            effects: vec![Effect { kind: Kind::Excluded, failed: false, first: 0, len: 0 }],
            overwrites: Vec::new(),
            failures: HashMap::default(),
            conditions,
            is_loaded: false,
            initial,
            unbounded: BTreeSet::new(),
            sightings: Vec::new(),
            in_faults: FxHashSet::default(),
        };
        if observed {
            explorer.watch();
        }
        Ok(explorer)
    }

    /// How many words a state has.
    pub fn words(&self) -> usize {
        self.encoding.words
    }

    /// How many bits of them are used.
    pub fn bits(&self) -> usize {
        self.encoding.fields.iter().map(|field| usize::from(field.bits)).sum()
    }

    /// The initial states, with the inputs and choices they come from; one may come up several times.
    pub fn initial(&self) -> &[(Box<[u64]>, Told)] {
        &self.initial
    }

    /// Which rules ran, in all steps that a machine has made.
    pub fn coverage(&self) -> &Coverage {
        self.machine.coverage().expect("counted from the beginning")
    }

    /// What could not be gone through, in all steps and conditions so far.
    pub fn unbounded(&self) -> &BTreeSet<Unbounded> {
        &self.unbounded
    }

    /// The canonical order of states, which depends on the values of their locations alone.
    pub fn compare(&mut self, a: &[u64], b: &[u64]) -> Ordering {
        self.encoding.compare(a, b, &mut self.view)
    }

    /// Adds the states that a step leads to from this one and that differ from it, in the order of the alternatives;
    /// one may come up several times.
    ///
    /// # Errors
    /// A successor does not fit.
    pub fn expand(&mut self, state: &[u64], out: &mut Vec<u64>) -> Result<Expansion, Widening> {
        let start = out.len();
        if self.steps.is_used() {
            let Explorer { steps, effects, overwrites, .. } = self;
            let mut expansion = Expansion::default();
            let walked = steps.walk(state, &mut |end| {
                let effect = effects[end as usize];
                let overwrites = &overwrites[effect.first as usize..(effect.first + effect.len) as usize];
                expansion.count(effect.kind, effect.failed, state, overwrites, out);
            });
            if walked.is_ok() {
                return Ok(expansion);
            }
            out.truncate(start);
        }
        self.expand_by_machine(state, out)
    }

    /// How the next state differs from the state, at an end of the tree of steps.
    pub(super) fn overwrites_of(&self, end: End) -> &[Overwrite] {
        let effect = self.effects[end as usize];
        &self.overwrites[effect.first as usize..(effect.first + effect.len) as usize]
    }

    /// The conditions on the step that do not hold at an end.
    pub(super) fn failures_of(&self, end: End) -> &[u32] {
        self.failures.get(&end).map_or(&[], |failed| failed)
    }

    pub(super) fn expand_by_machine(&mut self, state: &[u64], out: &mut Vec<u64>) -> Result<Expansion, Widening> {
        let mut expansion = Expansion::default();
        self.branches.first();
        loop {
            match self.attempt(state)? {
                None => self.learn(state, DEAD),
                Some(attempt) => {
                    let failed = !attempt.failed.is_empty();
                    expansion.count(attempt.kind, failed, state, &attempt.overwrites, out);
                    if self.steps.is_used() && !self.settings.forgetful {
                        let first = self.overwrites.len() as u32;
                        self.overwrites.extend(&attempt.overwrites);
                        let len = attempt.overwrites.len() as u32;
                        self.effects.push(Effect { kind: attempt.kind, failed, first, len });
                        let end = self.effects.len() as End - 1;
                        if failed {
                            self.failures.insert(end, attempt.failed.into());
                        }
                        self.learn(state, end);
                    }
                }
            }
            if !self.branches.next() {
                return Ok(expansion);
            }
        }
    }

    fn learn(&mut self, state: &[u64], end: End) {
        if !self.settings.forgetful {
            let branches = &self.branches;
            self.steps.learn(&self.encoding.fields, state, &branches.events, branches.answers(), end);
        }
    }

    /// Puts the machine into a state.
    pub(super) fn load(&mut self, state: &[u64]) {
        self.machine.discard();
        // Evaluation may have put initial values into locations that have no field.
        let touched = self.encoding.rest_may_change(&self.machine.core);
        if touched || !self.is_loaded || self.loaded != state {
            self.encoding.unpack(&self.program, state, &mut self.machine.core, &mut self.view);
            self.loaded.copy_from_slice(state);
            self.is_loaded = true;
        }
        self.machine.forget_inputs();
    }

    /// Makes the step with the alternatives that are due and takes it back; none where they are dead.
    pub(super) fn attempt(&mut self, state: &[u64]) -> Result<Option<Attempt>, Widening> {
        self.load(state);
        let mut attempt = Attempt { kind: Kind::Next, fault: None, failed: Vec::new(), overwrites: Vec::new() };
        self.begin_watching();
        let mut outcome = self.machine.prepare(&mut self.branches);
        self.end_watching();
        if outcome.is_ok() {
            outcome = self.check_step(&mut attempt);
        }
        if self.branches.dead {
            return Ok(None);
        }
        match outcome {
            Ok(()) if attempt.kind == Kind::Next => {
                self.read_updates(state, &mut attempt).map_err(|narrow| narrow.0)?
            }
            Ok(()) => {}
            Err(fault) => {
                if let FaultKind::Limit { .. } = fault.kind {
                    self.branches.endless(UnboundedKind::Limit, fault.span);
                }
                attempt.kind = match self.branches.unbounded {
                    Some(unbounded) => {
                        self.unbounded.insert(unbounded);
                        Kind::Unbounded
                    }
                    None => Kind::Fault(FaultClass::of(&fault)),
                };
                attempt.fault = Some(Box::new(fault));
            }
        }
        self.machine.discard();
        self.sight(attempt.kind);
        Ok(Some(attempt))
    }

    fn check_step(&mut self, attempt: &mut Attempt) -> Result<(), Fault> {
        for (index, (formula, assumed)) in self.settings.step_conditions.iter().enumerate() {
            let holds = self.machine.evaluate(formula, &mut self.branches)? == Value::Boolean(true);
            if !holds && *assumed {
                attempt.kind = Kind::Excluded;
                attempt.failed.clear();
                return Ok(());
            }
            if !holds {
                attempt.failed.push(index as u32);
            }
        }
        Ok(())
    }

    /// What the prepared update set changes in the packed state.
    fn read_updates(&mut self, state: &[u64], attempt: &mut Attempt) -> Result<(), TooNarrow> {
        let Explorer { program, machine, branches, encoding, view, .. } = self;
        let mut next = state.to_vec();
        let mut written = vec![0u64; state.len()];
        let mut rest_written = !machine.core.updates.created().is_empty();
        for update in &machine.core.updates.stack {
            match encoding.of_location.get(update.location as usize) {
                Some(field) if *field < REST => {
                    let field = encoding.fields[*field as usize];
                    Encoding::put(field, encoding.code(field, &update.value, view)?, &mut next);
                    written[field.word as usize] |= field.mask();
                }
                Some(&REST) => rest_written = true,
                Some(_) => {}
                None => rest_written = true,
            }
        }
        if rest_written {
            branches.look(REST);
        }
        if rest_written || encoding.rest_may_change(&machine.core) {
            let mut rest = encoding.gather(program, &machine.core, true);
            encoding.settle(machine, &mut rest);
            encoding.put_rest(rest, &mut next, view)?;
            if let Some(field) = encoding.rest {
                let field = encoding.fields[field as usize];
                if rest_written || field.code(&next) != field.code(state) {
                    branches.look(REST);
                    written[field.word as usize] |= field.mask();
                }
            }
        }
        let overwrites = written.iter().enumerate().filter(|(_, clear)| **clear != 0);
        attempt.overwrites = overwrites
            .map(|(word, clear)| Overwrite { word: word as u32, clear: *clear, set: next[word] & clear })
            .collect();
        Ok(())
    }

    /// Tells of the step that these answers lead to.
    pub fn tell(&mut self, state: &[u64], picks: &[u32]) -> Told {
        self.load(state);
        self.branches.follow(picks);
        let mut told = Told::default();
        let prepared = self.machine.prepare(&mut self.branches);
        told.inputs = self.machine.inputs();
        match prepared {
            Ok(()) => {
                // Conditions may ask for more inputs.
                for (formula, _) in &self.settings.step_conditions {
                    let _ = self.machine.evaluate(formula, &mut self.branches);
                }
                told.inputs = self.machine.inputs();
                self.machine.commit();
                told.changes = self.machine.changes();
            }
            Err(fault) => told.fault = Some(Box::new(fault)),
        }
        told.choices = std::mem::take(&mut self.branches.chosen);
        self.is_loaded = false;
        told
    }

    /// Where it was found that a fault may depend on the order of elements that are to be interchangeable.
    pub fn order_mattered(&self) -> Option<Span> {
        self.machine.core.order_mattered
    }

    /// From now on steps are made as they are without interchangeable elements; only for telling them.
    pub fn look_in_order(&mut self) {
        self.machine.core.unordered = Arc::default();
        self.machine.core.memo.forget();
    }

    /// Evaluates a term in a state.
    ///
    /// # Errors
    /// What evaluation meets.
    pub fn evaluate(&mut self, formula: &Expression, state: &[u64]) -> Result<Value, Fault> {
        self.branches.first();
        self.load(state);
        self.machine.evaluate(formula, &mut self.branches)
    }

    /// The locations of a state that have a value, in canonical order.
    pub fn values(&mut self, state: &[u64]) -> Vec<(Location, Value)> {
        self.load(state);
        self.machine.locations()
    }

    /// How many nodes and links are remembered.
    pub fn remembered(&self) -> usize {
        let parts = self.conditions.iter().flat_map(|condition| &condition.parts);
        self.steps.size() + self.overwrites.len() + parts.map(|part| part.tree.size()).sum::<usize>()
    }
}

impl Expansion {
    #[inline]
    fn count(&mut self, kind: Kind, failed: bool, state: &[u64], overwrites: &[Overwrite], out: &mut Vec<u64>) {
        self.failed += u32::from(failed);
        match kind {
            Kind::Next => {
                let start = out.len();
                out.extend_from_slice(state);
                apply(overwrites, &mut out[start..]);
                // Word by word: a call to compare memory takes longer than a state of few words.
                if out[start..].iter().zip(state).all(|(next, word)| next == word) {
                    out.truncate(start);
                    self.stayed += 1;
                } else {
                    self.moved += 1;
                }
            }
            Kind::Fault(class) => self.faults[class as usize] += 1,
            Kind::Unbounded => self.unbounded += 1,
            Kind::Excluded => self.excluded += 1,
        }
    }
}

#[inline]
pub(super) fn apply(overwrites: &[Overwrite], words: &mut [u64]) {
    for Overwrite { word, clear, set } in overwrites {
        let word = &mut words[*word as usize];
        *word = *word & !clear | set;
    }
}
