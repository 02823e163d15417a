//! The explorer: from packed states to their packed successors.
//!
//! In: a program, the bounds of its inputs, the conditions that are asked for. It makes each step with a machine at first
//! and remembers what the step looked at ([`crate::memory`]), and walks trees of decisions from then on. Several explorers of one program, made with
//! the same settings and one [`Interner`], pack states alike. INVARIANT: what comes out does not depend on what was
//! remembered.

pub(crate) mod census;
mod inputs;
mod judge;
mod makers;
pub(crate) mod orbit;
pub(crate) mod paths;
pub(crate) mod sets;
pub(crate) mod sighting;
mod sights;
mod tell;

use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::ControlFlow;
use std::sync::Arc;

use machine::{EngineChoice, Fault, FaultClass, Interrupt, Location, Machine, Observation, Value};
use program::{Expression, FunctionId, FunctionKind, Program, Slot};
use rustc_hash::FxHashSet;
use syntax::Span;

use crate::alternatives::branches::{Branches, Pieces};
use crate::alternatives::expansion::Expansion;
use crate::alternatives::kind::AlternativeKind;
use crate::alternatives::successors::Successors;
use crate::alternatives::unbounded::Unbounded;
use crate::memory::condition::Condition;
use crate::memory::maker::{StepMaker, Unmade};
use crate::memory::steps::Steps;
use crate::packed::encoding::Encoding;
use crate::packed::interner::{Interner, View};
use crate::packed::kept::{Kept, is_input};
use crate::packed::widening::{TooNarrow, Widening};
use crate::packed::words::{Overwrite, REST};
use crate::settings::{Settings, Trouble, note_failures};
use crate::starts::origin::Origins;
use crate::starts::{Begun, Starts, each_start};
use makers::Makers;
use paths::Reading;
use sighting::{Refusals, Sighting};

/// What became of one alternative.
pub(super) struct Attempt {
    pub kind: AlternativeKind,
    pub fault: Option<Box<Fault>>,
    pub failed: Vec<u32>,
    pub overwrites: Vec<Overwrite>,
}

/// Reads something in a step that can be made.
pub(super) type Read<'r> = dyn FnMut(&mut Reading<'_>) -> Result<(), Fault> + 'r;

/// See the module.
#[derive(Debug)]
pub struct Explorer {
    pub(super) program: Arc<Program>,
    pub(super) machine: Machine,
    pub(super) branches: Branches,
    pub(super) encoding: Arc<Encoding>,
    pub(super) view: View,
    pub(super) settings: Settings,
    pub(super) steps: Steps,
    makers: Makers,
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
    pub(super) refusals: Refusals,
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
        let mut machine = Machine::new(Arc::clone(program), settings.limits.clone());
        machine.use_engine(EngineChoice::Interpreted);
        machine.enable_coverage();
        machine.explore();
        let mut branches = Branches::new(Arc::clone(&settings.bounds));
        let (blank, mut begun) = (machine.snapshot(), Begun::default());
        // A single start is made quickly, and the explorer that has the others relies on it.
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
        machine.mind_interrupts(&settings.limits.clone());
        let seen = match known {
            Some(known) => Arc::clone(&known.seen),
            None => Arc::new(begun.seen()),
        };
        let mut origins = Origins::of(&seen.origins);
        origins.number(&machine);
        let kept = Kept::new(program, &settings, &seen.asked);
        let steady = steady_functions(program, &settings);
        let begin = (origins.count(), !settings.numbered);
        let encoding = Encoding::new(program, &mut machine, (&seen.rows, &steady), kept, begin, widening);
        let encoding = Arc::new(encoding);
        let mut view = View::new(Arc::clone(interner));
        let starts = match known {
            Some(known) => Arc::clone(known),
            None => {
                let mut starts = Starts::new(seen, encoding.words);
                let mut words = vec![0; encoding.words].into_boxed_slice();
                let narrow = |TooNarrow(widening)| Trouble::TooNarrow(widening);
                branches.first();
                each_start(&mut machine, &blank, &mut branches, &settings.interrupt, &mut |machine, branches| {
                    let packed = match machine.changed_by_start() {
                        Some((changed, _)) => encoding.pack_changed(machine, changed, &mut words, &mut view),
                        None => Ok(false),
                    };
                    if !packed.map_err(narrow)? {
                        let (origin, inputs) = (origins.number(machine), machine.inputs());
                        words = encoding.pack(program, machine, (&inputs, origin), &mut view).map_err(narrow)?;
                    }
                    starts.push(&words, branches);
                    Ok(ControlFlow::Continue(()))
                })?;
                starts.close();
                Arc::new(starts)
            }
        };
        // Answers of the environment do not belong to the state, unless they are kept.
        let state = machine.snapshot();
        machine.restore(&state);
        branches.chosen.clear();
        for index in 0..machine.store().len() as u32 {
            if is_input(program, &machine.store().location(index)) {
                machine.store_mut().overwrite(index, Value::Undef);
            }
        }
        if !settings.unordered.is_empty() {
            machine.set_unordered(Arc::clone(&settings.unordered));
        }
        branches.fields = Arc::clone(&encoding.of_location);
        (branches.rest, branches.origin) = (encoding.rest, encoding.origin);
        branches.inputs_in_rest = encoding.kept.functions_in_rest();
        // What is observed of a step may depend on more than what it comes to.
        branches.pieces = Pieces::of(&encoding).filter(|_| !settings.observed);
        machine.keep_in_pieces(branches.pieces.is_some());
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
            steps: Steps::default(),
            makers: Makers::default(),
            conditions,
            is_loaded: false,
            starts,
            origins,
            unbounded: BTreeSet::new(),
            sightings: Vec::new(),
            in_faults: FxHashSet::default(),
            refusals: Refusals::default(),
        };
        explorer.leave_out_starts();
        if observed {
            explorer.machine.watch(Some(Box::default()));
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

    /// Whether another explorer, one with the same interner, packs states in the same way.
    pub fn packs_like(&self, other: &Explorer) -> bool {
        self.encoding.is_like(&other.encoding)
    }

    /// The initial states; one may come up several times.
    pub fn initial(&self) -> &Starts {
        &self.starts
    }

    /// Each input that a start asked for, those included that an assumption leaves out; with some value that it had.
    pub fn asked_by_starts(&self) -> &[(Location, Value)] {
        &self.starts.seen.asked
    }

    /// The same, for another explorer: see [`Explorer::like`].
    pub fn starts(&self) -> Arc<Starts> {
        Arc::clone(&self.starts)
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
        let (mut expansion, mut found) = (Expansion::default(), Successors::new(out));
        match self.steps.make(state, &self.settings.interrupt, &mut expansion, &mut found) {
            Ok(()) => return Ok(expansion),
            Err(Unmade::Interrupted) => return Ok(Expansion { interrupted: true, ..expansion }),
            Err(Unmade::Unknown) => out.truncate(start),
        }
        self.compile_if_due();
        let Explorer { makers, settings, .. } = self;
        if let Some(code) = makers.code() {
            let (mut expansion, mut found) = (Expansion::default(), Successors::new(out));
            let made = code.make(state, &settings.interrupt, &mut expansion, &mut found);
            self.count_compiled(made.is_ok());
            match made {
                Ok(()) => return Ok(expansion),
                Err(Unmade::Interrupted) => return Ok(Expansion { interrupted: true, ..expansion }),
                Err(Unmade::Unknown) => out.truncate(start),
            }
        }
        self.expand_by_machine(state, out)
    }

    pub(super) fn expand_by_machine(&mut self, state: &[u64], out: &mut Vec<u64>) -> Result<Expansion, Widening> {
        let mut expansion = Expansion::default();
        let mut found = Successors::new(out);
        self.branches.first();
        self.refusals.begin();
        loop {
            if self.settings.interrupt.is_raised() {
                return Ok(Expansion { interrupted: true, ..expansion });
            }
            let attempt = self.attempt(state, &mut |_| Ok(()))?;
            if let Some(attempt) = &attempt {
                expansion.count(attempt.kind, state, &attempt.overwrites, &mut found);
                if !attempt.failed.is_empty() {
                    expansion.fail(&attempt.failed);
                }
            }
            if !self.settings.forgetful {
                let fields = &self.encoding.looks;
                match attempt {
                    None => self.steps.learn_dead(fields, state, &self.branches),
                    Some(Attempt { kind, overwrites, failed, .. }) => {
                        self.steps.learn(fields, state, &self.branches, kind, &overwrites, failed);
                    }
                }
            }
            if !self.branches.next() {
                self.sight_refusals();
                return Ok(expansion);
            }
        }
    }

    /// Puts the machine into a state.
    pub(super) fn load(&mut self, state: &[u64]) {
        self.machine.discard();
        // Evaluation may have put initial values into locations that have no field.
        let touched = self.encoding.rest_may_change(&self.machine);
        if touched || !self.is_loaded || self.loaded != state {
            self.encoding.unpack(&self.program, state, &mut self.machine, &mut self.view);
            self.loaded.copy_from_slice(state);
            self.is_loaded = true;
        }
        self.load_origin(state);
        self.machine.forget_inputs();
        self.keep_inputs(state);
    }

    /// Gives the machine the initial state that a packed state's run began in.
    fn load_origin(&mut self, state: &[u64]) {
        let Some(field) = self.encoding.origin else { return };
        let origin = self.encoding.fields[field as usize].code(state) as usize;
        if let Some(origin) = self.origins.change(origin) {
            self.machine.set_origin(origin.clone());
        }
    }

    /// Makes the step with the alternatives that are due and takes it back; none where they are dead.
    pub(super) fn attempt(&mut self, state: &[u64], read: &mut Read<'_>) -> Result<Option<Attempt>, Widening> {
        self.load(state);
        let mut attempt =
            Attempt { kind: AlternativeKind::Next, fault: None, failed: Vec::new(), overwrites: Vec::new() };
        self.begin_watching();
        let mut outcome = self.machine.prepare(&mut self.branches);
        if let Some(clash) = self.end_watching() {
            self.branches.unbounded = None;
            outcome = Err(*clash);
        }
        if !self.branches.dead && self.branches.unbounded.is_none() {
            outcome = self.check_step(&mut attempt, outcome, read);
        }
        if self.branches.dead {
            self.note_refusal();
            return Ok(None);
        }
        match outcome {
            Ok(()) if attempt.kind == AlternativeKind::Next => {
                self.read_updates(state, &mut attempt).map_err(|narrow| narrow.0)?
            }
            Ok(()) => {}
            Err(fault) => {
                self.branches.note_limit(&fault);
                attempt.kind = match self.branches.unbounded {
                    Some(unbounded) => {
                        self.unbounded.insert(unbounded);
                        AlternativeKind::Unbounded
                    }
                    None => AlternativeKind::Fault(FaultClass::of(&fault)),
                };
                attempt.fault = Some(Box::new(fault));
            }
        }
        self.machine.discard();
        self.sight(attempt.kind);
        Ok(Some(attempt))
    }

    /// Evaluates the conditions on a step that was made or has a fault. Assumptions come first: what they exclude counts for
    /// nothing else, and where one has no value it is not known whether the step counts.
    fn check_step(&mut self, attempt: &mut Attempt, made: Result<(), Fault>, read: &mut Read<'_>) -> Result<(), Fault> {
        let Explorer { settings, machine, branches, .. } = self;
        let mut unclear = None;
        for check in settings.checks_of_steps().take_while(|check| check.assumed) {
            match machine.evaluate(check.formula, branches) {
                Ok(Value::Boolean(true)) => {}
                Ok(_) => {
                    attempt.kind = AlternativeKind::Excluded;
                    return Ok(());
                }
                Err(fault) => _ = unclear.get_or_insert(fault),
            }
        }
        if let Some(fault) = unclear {
            branches.note_unclear(&fault);
            return Err(fault);
        }
        made?;
        for check in settings.checks_of_steps().skip_while(|check| check.assumed) {
            // What cannot be evaluated is not true. The step is made all the same.
            let truth = match machine.evaluate(check.formula, branches) {
                Ok(Value::Boolean(truth)) => Some(truth),
                Err(fault) if !fault.kind.is_of_the_model() => return Err(fault),
                Ok(_) | Err(_) => None,
            };
            note_failures(truth, (check.index, check.negation), &mut attempt.failed);
        }
        read(&mut Reading { machine, branches })
    }

    /// What the prepared update set changes in the packed state.
    fn read_updates(&mut self, state: &[u64], attempt: &mut Attempt) -> Result<(), TooNarrow> {
        let Explorer { program, machine, branches, encoding, view, .. } = self;
        let mut next = state.to_vec();
        let mut written = vec![0u64; state.len()];
        let mut edits: Vec<Overwrite> = Vec::new();
        let mut rest_written = machine.creates() || !encoding.kept.in_rest.is_empty();
        encoding.drop_inputs(&mut next, &mut written, view);
        for (location, value) in machine.updates() {
            match encoding.of_location.get(location as usize) {
                Some(field) if *field < REST => {
                    let field = encoding.fields[*field as usize];
                    if let Some(edit) = branches.edit_of(location)
                        && let Some(collection) = encoding.collection(field.function)
                    {
                        let made = collection.overwrites(edit, field, state);
                        let made = made.map_err(|misfit| TooNarrow::of(field.function, misfit))?;
                        let word = &mut next[field.word as usize];
                        *word = made.of(*word);
                        assert!(field.code(&next) == encoding.code(field, value, view)?, "an edit makes another value");
                        match made.from {
                            0 => written[field.word as usize] |= made.clear,
                            _ => edits.push(made),
                        }
                        continue;
                    }
                    field.put(encoding.code(field, value, view)?, &mut next);
                    written[field.word as usize] |= field.mask();
                }
                Some(&REST) => rest_written = true,
                Some(_) => {}
                None => rest_written = true,
            }
        }
        if rest_written {
            branches.look_at(REST);
        }
        if rest_written || encoding.rest_may_change(machine) {
            let mut rest = encoding.gather_with(program, machine, true, &|location| machine.update_of(location));
            encoding.settle(machine, &mut rest);
            encoding.put_rest(rest, &mut next, view)?;
            if let Some(field) = encoding.rest {
                let field = encoding.fields[field as usize];
                if rest_written || field.code(&next) != field.code(state) {
                    branches.look_at(REST);
                    written[field.word as usize] |= field.mask();
                }
            }
        }
        let overwrites = written.iter().enumerate().filter(|(_, clear)| **clear != 0);
        attempt.overwrites = overwrites
            .map(|(word, clear)| Overwrite {
                word: word as u32,
                clear: *clear,
                set: next[word] & clear,
                from: 0,
                turn: 0,
            })
            .chain(edits)
            .collect();
        Ok(())
    }

    /// From now on these inputs have these values in every step that is told or gone through path by path, whatever the bounds; what is
    /// remembered of steps must not be used meanwhile.
    pub fn give(&mut self, inputs: BTreeMap<Location, Value>) {
        self.branches.given = inputs;
    }

    /// From now on all alternatives are gone through, however long that takes; for telling what was found. Gives what would have
    /// been looked at.
    pub fn ignore_interrupts(&mut self) -> Interrupt {
        self.machine.ignore_interrupts();
        std::mem::take(&mut self.settings.interrupt)
    }

    /// From now on this is looked at between alternatives.
    pub fn mind_interrupts(&mut self, interrupt: Interrupt) {
        self.machine.mind_interrupts(&self.settings.limits.clone());
        self.settings.interrupt = interrupt;
    }

    /// Where it was found that a fault may depend on the order of elements that are to be interchangeable.
    pub fn order_mattered(&self) -> Option<Span> {
        self.machine.order_mattered()
    }

    /// From now on steps are made as they are without interchangeable elements; only for telling them.
    pub fn look_in_order(&mut self) {
        self.machine.set_unordered(Arc::default());
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

    /// Evaluates a term with parameters in a state.
    ///
    /// # Errors
    /// What evaluation meets.
    pub fn evaluate_with(&mut self, formula: &Expression, arguments: &[Value], state: &[u64]) -> Result<Value, Fault> {
        self.branches.first();
        self.load(state);
        let bindings: Vec<(Slot, Value)> = (0..).map(Slot).zip(arguments.iter().cloned()).collect();
        self.machine.evaluate_with(formula.body, formula.frame, &bindings, &mut self.branches)
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
        self.steps.size() + parts.map(|part| part.tree.size()).sum::<usize>()
    }
}

/// The functions that no step changes, where that may be made use of. Interchangeable elements are exchanged in all that a state
/// has, so such functions are part of it then.
fn steady_functions(program: &Program, settings: &Settings) -> BTreeSet<FunctionId> {
    let updated = program.updated_functions();
    let own = |function: &FunctionId| {
        matches!(program.function(*function).kind, FunctionKind::Controlled | FunctionKind::Out)
    };
    let all = (0..program.functions.len() as u32).map(FunctionId);
    all.filter(|function| settings.unordered.is_empty() && own(function) && !updated.contains(function)).collect()
}
