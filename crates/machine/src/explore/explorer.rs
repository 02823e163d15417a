//! The explorer: from packed states to their packed successors.
//!
//! In: a program, the bounds of its inputs, the conditions that are asked for. It makes each step with a machine at first
//! and remembers what the step looked at, and walks [`Tree`]s from then on. Several explorers of one program, made with
//! the same settings and one [`Interner`], pack states alike. INVARIANT: what comes out does not depend on what was
//! remembered.

use std::cmp::Ordering;
use std::collections::BTreeSet;
use std::ops::ControlFlow;
use std::sync::Arc;

use hashbrown::HashMap;
use program::{Expression, Program};
use rustc_hash::{FxBuildHasher, FxHashSet};
use syntax::Span;

use crate::coverage::Coverage;
use crate::explore::branches::{Bounds, Branches, REST, Unbounded, UnboundedKind};
use crate::explore::conditions::Condition;
use crate::explore::encoding::{Encoding, TooNarrow, Widening};
use crate::explore::expansion::Expansion;
use crate::explore::interner::{Interner, View};
use crate::explore::kept::{Kept, is_input};
use crate::explore::origin::Origins;
use crate::explore::paths::Told;
use crate::explore::sets::Overwrite;
use crate::explore::sighted::Sighting;
use crate::explore::starts::{Begun, Start, Starts, each_start};
use crate::explore::successors::Successors;
use crate::explore::tree::{DEAD, End, Tree, Unwalked};
use crate::fault::{Fault, FaultKind};
use crate::interrupt::{Cause, Interrupt};
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
    /// Looked at between the alternatives of a state, of which there may be many.
    pub interrupt: Interrupt,
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
    /// Whoever waits has had enough before all initial states were made.
    Interrupted(Cause),
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
    pub(super) starts: Arc<Starts>,
    pub(super) origins: Origins,
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
        Explorer::like(program, settings, widening, interner, None)
    }

    /// The same with the initial states of another one, which was made with the same settings, widening and interner.
    ///
    /// # Errors
    /// See [`Trouble`].
    pub fn like(
        program: &Arc<Program>,
        settings: Settings,
        widening: &Widening,
        interner: &Arc<Interner>,
        known: Option<&Arc<Starts>>,
    ) -> Result<Explorer, Trouble> {
        let mut machine = Machine::new(Arc::clone(program), settings.limits);
        machine.use_engine(EngineChoice::Interpreted);
        machine.enable_coverage();
        machine.core.exploring = true;
        let mut branches = Branches::new(Arc::clone(&settings.bounds));
        let (blank, mut begun) = (machine.snapshot(), Begun::default());
        // One alone is soon made, and whoever has the others relies on it.
        let interrupt = match known {
            Some(_) => Interrupt::default(),
            None => settings.interrupt.clone(),
        };
        if known.is_some() {
            machine.ignore_interrupts();
        }
        branches.first();
        each_start(&mut machine, &blank, &mut branches, &interrupt, &mut |machine, _| {
            begun.add(machine);
            Ok(if known.is_some() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) })
        })?;
        machine.mind_interrupts(&settings.limits);
        let seen = match known {
            Some(known) => Arc::clone(&known.seen),
            None => Arc::new(begun.seen()),
        };
        let mut origins = Origins::of(&seen.origins);
        origins.number(&machine);
        let kept = Kept::new(program, &settings, std::iter::once(&seen.asked));
        let encoding = Encoding::new(program, &mut machine, &seen.rows, kept, origins.count(), widening);
        let mut view = View::new(Arc::clone(interner));
        let starts = match known {
            Some(known) => Arc::clone(known),
            None => {
                let mut starts = Starts::new(seen);
                branches.first();
                each_start(&mut machine, &blank, &mut branches, &settings.interrupt, &mut |machine, branches| {
                    let told = Told { inputs: machine.inputs(), ..Told::default() };
                    let origin = origins.number(machine);
                    let words = encoding.pack(program, machine, (&told, origin), &mut view);
                    starts.push(words.map_err(|TooNarrow(widening)| Trouble::TooNarrow(widening))?, branches);
                    Ok(ControlFlow::Continue(()))
                })?;
                Arc::new(starts)
            }
        };
        // Nothing that was asked for belongs to the state, but where it is kept.
        let state = machine.snapshot();
        machine.restore(&state);
        branches.chosen.clear();
        for index in 0..machine.core.store.len() {
            if is_input(program, &machine.core.store.location(index as u32)) {
                machine.core.store.values[index] = Value::Undef;
            }
        }
        if !settings.unordered.is_empty() {
            machine.core.unordered = Arc::clone(&settings.unordered);
            // Values that were kept may come from quantifiers that did not look at all elements.
            machine.core.memo.forget();
        }
        branches.fields = Arc::clone(&encoding.of_location);
        (branches.rest, branches.origin) = (encoding.rest, encoding.origin);
        branches.inputs_in_rest = encoding.kept.functions_in_rest();
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
            starts,
            origins,
            unbounded: BTreeSet::new(),
            sightings: Vec::new(),
            in_faults: FxHashSet::default(),
        };
        explorer.leave_out_starts();
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

    /// The initial states; one may come up several times.
    pub fn initial(&self) -> &[(Box<[u64]>, Start)] {
        &self.starts.states
    }

    /// The same, for another explorer: see [`Explorer::like`].
    pub fn starts(&self) -> Arc<Starts> {
        Arc::clone(&self.starts)
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
            let Explorer { steps, effects, overwrites, failures, settings, .. } = self;
            let mut expansion = Expansion::default();
            let mut found = Successors::new(out);
            let walked = steps.walk(state, &settings.interrupt, &mut |end| {
                let effect = effects[end as usize];
                let overwrites = &overwrites[effect.first as usize..(effect.first + effect.len) as usize];
                expansion.count(effect.kind, state, overwrites, &mut found);
                if effect.failed {
                    expansion.fail(failures.get(&end).map_or(&[], |failed| failed));
                }
            });
            match walked {
                Ok(()) => return Ok(expansion),
                Err(Unwalked::Interrupted) => return Ok(Expansion { interrupted: true, ..expansion }),
                Err(Unwalked::Unknown) => out.truncate(start),
            }
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
        let mut found = Successors::new(out);
        self.branches.first();
        loop {
            if self.settings.interrupt.is_raised() {
                return Ok(Expansion { interrupted: true, ..expansion });
            }
            match self.attempt(state)? {
                None => self.learn(state, DEAD),
                Some(attempt) => {
                    let failed = !attempt.failed.is_empty();
                    expansion.count(attempt.kind, state, &attempt.overwrites, &mut found);
                    if failed {
                        expansion.fail(&attempt.failed);
                    }
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
        self.load_origin(state);
        self.machine.forget_inputs();
        self.keep_inputs(state);
    }

    /// Makes the step with the alternatives that are due and takes it back; none where they are dead.
    pub(super) fn attempt(&mut self, state: &[u64]) -> Result<Option<Attempt>, Widening> {
        self.load(state);
        let mut attempt = Attempt { kind: Kind::Next, fault: None, failed: Vec::new(), overwrites: Vec::new() };
        self.begin_watching();
        let mut outcome = self.machine.prepare(&mut self.branches);
        if let Some(clash) = self.end_watching() {
            self.branches.unbounded = None;
            outcome = Err(*clash);
        }
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
                note_limit(&mut self.branches, &fault);
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
        let mut rest_written = !machine.core.updates.created().is_empty() || !encoding.kept.in_rest.is_empty();
        encoding.drop_inputs(&mut next, &mut written, view);
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

    /// From now on all alternatives are gone through, however long that takes; for telling what was found. Gives what would have
    /// been looked at.
    pub fn ignore_interrupts(&mut self) -> Interrupt {
        self.machine.ignore_interrupts();
        std::mem::take(&mut self.settings.interrupt)
    }

    /// From now on this is looked at between alternatives.
    pub fn mind_interrupts(&mut self, interrupt: Interrupt) {
        self.machine.mind_interrupts(&self.settings.limits);
        self.settings.interrupt = interrupt;
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
        let mut values = self.values_and_inputs(state);
        values.retain(|(location, _)| !is_input(&self.program, location));
        values
    }

    /// The same with the inputs that an initial state keeps.
    pub fn values_and_inputs(&mut self, state: &[u64]) -> Vec<(Location, Value)> {
        self.load(state);
        self.machine.locations()
    }

    /// How many nodes and links are remembered.
    pub fn remembered(&self) -> usize {
        let parts = self.conditions.iter().flat_map(|condition| &condition.parts);
        self.steps.size() + self.overwrites.len() + parts.map(|part| part.tree.size()).sum::<usize>()
    }
}

/// A step, or the value of a condition, was not computed to its end: what it would come to is not known.
pub(super) fn note_limit(branches: &mut Branches, fault: &Fault) {
    if let FaultKind::Limit { .. } | FaultKind::Interrupted(_) = fault.kind {
        branches.endless(UnboundedKind::Limit, fault.span);
    }
}
