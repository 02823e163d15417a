//! The machine's public interface: a program and its current state, which changes step by step.

use std::sync::Arc;

use program::{DomainId, Expression, FunctionId, FunctionKind, ProcedureId, Program, Slot, TermId};
use syntax::Span;

use crate::coverage::Coverage;
use crate::engine::EngineState;
use crate::environment::{Closed, Environment};
use crate::execute::{Core, Executor, Outcome};
use crate::fault::{Fault, FaultKind};
use crate::interrupt::Interrupt;
use crate::limits::Limits;
use crate::location::{Location, LocationRef};
use crate::native;
use crate::start::AT_START;
use crate::step::Step;
use crate::store::Store;
use crate::trail::Trail;
use crate::value::Value;
use crate::work::Work;

/// One location whose value a step changed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Change {
    /// The location.
    pub location: Location,
    /// Its value before.
    pub before: Value,
    /// Its value after.
    pub after: Value,
    /// The update rule that wrote it.
    pub span: Span,
}

/// A copy of a whole state, to go back to.
#[derive(Debug, Clone)]
pub struct Snapshot {
    store: Store,
    steps: u64,
    initials: Vec<Option<u32>>,
    epoch: u32,
}

/// A machine: a program and its current state.
#[derive(Debug)]
pub struct Machine {
    pub(crate) program: Arc<Program>,
    pub(crate) limits: Limits,
    pub(crate) core: Core,
    pub(crate) steps: u64,
    /// The update set on the stack is committed: where an update changed anything it holds the value before.
    pub(crate) settled: bool,
    pub(crate) engine: EngineState,
    /// A step was committed since inputs were last forgotten.
    pub(crate) stale: bool,
}

impl Machine {
    /// A machine whose locations are all undef: see [`Machine::start`].
    pub fn new(program: Arc<Program>, limits: Limits) -> Machine {
        let core = Core::new(&program, &limits);
        let engine = EngineState::default();
        Machine { program, limits, core, steps: 0, settled: false, engine, stale: false }
    }

    /// From now on steps ignore the request to stop: to repeat what was found before.
    pub fn ignore_interrupts(&mut self) {
        self.limits.interrupt = Interrupt::default();
    }

    /// From now on steps check the request to stop of these limits.
    pub fn mind_interrupts(&mut self, limits: &Limits) {
        self.limits.interrupt = limits.interrupt.clone();
    }

    /// The program.
    pub fn program(&self) -> &Arc<Program> {
        &self.program
    }

    pub(crate) fn execute<T>(
        &mut self,
        environment: &mut dyn Environment,
        body: impl for<'a> FnOnce(&mut Executor<'a>, &'a Program) -> Outcome<T>,
    ) -> Result<T, Fault> {
        let Machine { program, core, limits, .. } = self;
        core.frames.clear();
        core.calls.clear();
        (core.base, core.depth, core.work) = (0, 0, Work::none());
        let mut executor = Executor { program, core, environment, limits };
        body(&mut executor, program).map_err(|fault| *fault)
    }

    /// Sets the initial state: contents of dynamic domains, initial values. Steps made: 0.
    ///
    /// # Errors
    /// An initial value that cannot be evaluated.
    pub fn start(&mut self, environment: &mut dyn Environment) -> Result<(), Fault> {
        let Core { exploring, unset, entered, .. } = self.core;
        let coverage = self.core.coverage.take();
        let elsewhere = std::mem::take(&mut self.core.elsewhere);
        self.core = Core { elsewhere, ..Core::new(&self.program, &self.limits) };
        // The caller may still return to an earlier state, in which locations were set to undef.
        (self.core.coverage, self.core.exploring) = (coverage, exploring);
        (self.core.unset, self.core.entered) = (unset, entered);
        self.steps = 0;
        self.settled = false;
        self.execute(environment, |executor, _| executor.start())
    }

    /// The same from a copy of the state before any start, for an explorer, which starts many times.
    ///
    /// # Errors
    /// An initial value that cannot be evaluated.
    pub fn start_from(&mut self, blank: &Snapshot, environment: &mut dyn Environment) -> Result<(), Fault> {
        self.restore(blank);
        // Inputs given now belong to the initial state, in which late initial values are evaluated.
        self.core.epoch = AT_START;
        self.core.origin = None;
        (self.core.compacted, self.core.iterations) = (0, 0);
        self.core.choices.forget();
        self.execute(environment, |executor, _| executor.start())
    }

    /// The same right after another start, with the same answers to its first questions, `kept` of them. Evaluates anew only what
    /// the other answers may change.
    ///
    /// # Errors
    /// An initial value that cannot be evaluated.
    pub fn start_again(
        &mut self,
        blank: &Snapshot,
        kept: usize,
        environment: &mut dyn Environment,
    ) -> Result<(), Fault> {
        match self.core.trail.take() {
            None => {
                self.core.trail = Some(Box::new(Trail::new(&self.program)));
                self.start_from(blank, environment)
            }
            Some(trail) if !trail.goes_on() => {
                let outcome = self.start_from(blank, environment);
                self.core.trail = Some(trail);
                outcome
            }
            trail => {
                self.core.trail = trail;
                self.core.choices.forget();
                self.execute(environment, |executor, _| executor.start_again(kept))
            }
        }
    }

    /// No start follows the last one any more.
    pub fn end_starts(&mut self) {
        self.core.trail = None;
    }

    /// How many steps have been committed since the start.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Makes one step of the main rule: [`Machine::prepare`] and [`Machine::commit`].
    ///
    /// # Errors
    /// A fault leaves the state as it was.
    pub fn step(&mut self, environment: &mut dyn Environment) -> Result<Step, Fault> {
        self.prepare(environment)?;
        Ok(self.commit())
    }

    /// Forgets the inputs of the last step if there was one since, then computes the main rule's update set
    /// without applying it. Until [`Machine::commit`] terms are evaluated in the old state with the inputs of this
    /// step.
    ///
    /// # Errors
    /// A fault leaves the state as it was.
    pub fn prepare(&mut self, environment: &mut dyn Environment) -> Result<(), Fault> {
        match self.program.main {
            Some(main) => self.prepare_procedure(main, environment),
            None => {
                let span = Span { file: syntax::FileId(0), start: 0, end: 0 };
                Err(Fault { kind: FaultKind::NoMain, span, calls: Vec::new() })
            }
        }
    }

    /// The same for another procedure without parameters (a scenario's `exec`).
    ///
    /// # Errors
    /// A fault leaves the state as it was.
    pub fn prepare_procedure(
        &mut self,
        procedure: ProcedureId,
        environment: &mut dyn Environment,
    ) -> Result<(), Fault> {
        if self.program.main != Some(procedure) && !std::mem::replace(&mut self.core.entered, true) {
            // Compiled code relies on what the main rule alone leads to.
            self.drop_code();
        }
        self.begin();
        if self.has_code(procedure) && self.runs_compiled(environment) {
            return Ok(());
        }
        self.interpret(procedure, environment)
    }

    /// Computes the update set of a step that has begun by walking over the program.
    pub(crate) fn interpret(&mut self, procedure: ProcedureId, environment: &mut dyn Environment) -> Result<(), Fault> {
        let outcome = self.execute(environment, |executor, program| {
            let span = program.procedure(procedure).span;
            executor.enter(procedure, 0, span)
        });
        if outcome.is_err() {
            self.discard();
        }
        outcome
    }

    /// Forgets the inputs of a step that was committed, and begins the next one.
    pub(crate) fn begin(&mut self) {
        self.discard();
        self.settled = false;
        if self.stale {
            self.forget_inputs();
        }
        self.core.begin_step();
    }

    /// Starts an abandoned step again: it will make the same choices.
    pub(crate) fn repeat(&mut self) {
        self.discard();
        self.core.iterations = 0;
        self.core.choices.repeat();
        self.core.updates.begin();
    }

    /// Applies the update set prepared. The inputs of the step can still be read until
    /// [`Machine::forget_inputs`].
    pub fn commit(&mut self) -> Step {
        let step = self.core.commit(&self.program);
        self.settled = true;
        self.stale = true;
        self.steps += 1;
        self.engine.count(step);
        step
    }

    /// Drops the update set prepared.
    pub fn discard(&mut self) {
        if self.settled {
            return;
        }
        let core = &mut self.core;
        if core.updates.roll_back(&mut core.store) {
            core.memo.changed();
        }
    }

    /// What the last committed step changed, in the canonical order of locations.
    pub fn changes(&self) -> Vec<Change> {
        self.changes_of(&|_| true)
    }

    /// What it changed of the functions that are `wanted`, in the same order.
    pub fn changes_of(&self, wanted: &dyn Fn(FunctionId) -> bool) -> Vec<Change> {
        if !self.settled {
            return Vec::new();
        }
        let core = &self.core;
        let changed = core.updates.stack.iter().filter_map(|update| {
            let after = &core.store.values[update.location as usize];
            let changed = update.value != *after && wanted(core.store.function_of(update.location));
            changed.then(|| Change {
                location: core.store.location(update.location),
                before: update.value.clone(),
                after: after.clone(),
                span: self.program.rule_span(update.rule),
            })
        });
        let mut changes: Vec<Change> = changed.collect();
        changes.sort_by(|a, b| a.location.cmp(&b.location));
        changes
    }

    /// Calls `visit` with the function of each location that the last committed step changed, in no order.
    pub fn each_changed_function(&self, visit: &mut dyn FnMut(FunctionId)) {
        let core = &self.core;
        if self.settled {
            for update in &core.updates.stack {
                if update.value != core.store.values[update.location as usize] {
                    visit(core.store.function_of(update.location));
                }
            }
        }
    }

    /// The values that the environment gave since inputs were last forgotten, in the order asked.
    pub fn inputs(&self) -> Vec<(Location, Value)> {
        self.inputs_from(0)
    }

    /// The same without the first ones, so many.
    pub fn inputs_from(&self, first: usize) -> Vec<(Location, Value)> {
        let (store, inputs) = (&self.core.store, &self.core.inputs[first..]);
        inputs.iter().map(|(i, _)| (store.location(*i), store.values[*i as usize].clone())).collect()
    }

    /// Forgets the values of all monitored locations and of the clock, so that a step asks for them again.
    pub fn forget_inputs(&mut self) {
        self.stale = false;
        self.core.forget_inputs(&self.program);
    }

    /// The current value of a location; of a monitored one only if this step asked for it.
    pub fn value(&self, location: &Location) -> Value {
        self.value_at(location.borrowed())
    }

    /// The same without a [`Location`] built for it.
    pub fn value_at(&self, location: LocationRef<'_>) -> Value {
        let found = self.core.store.find(location.function, location.arguments);
        found.map_or(Value::Undef, |index| self.core.store.values[index as usize].clone())
    }

    /// Sets a location from outside: an input of this step, the environment's part of a shared function, a
    /// debugger's change.
    ///
    /// # Errors
    /// A value outside the codomain.
    pub fn set(&mut self, location: &Location, value: Value) -> Result<(), Fault> {
        let Location { function, arguments } = location;
        let span = self.program.function(*function).span;
        let kind = self.program.function(*function).kind;
        let undefined = value.is_undef() || !native::is_solid(&value);
        if undefined && !self.core.unset && matches!(kind, FunctionKind::Controlled | FunctionKind::Out) {
            // Compiled code relies on locations that the program itself never sets to undef, or to what holds it.
            self.core.unset = true;
            self.drop_code();
        }
        self.execute(&mut Closed, |executor, program| {
            if !executor.is_member(*function, &value) {
                let domain = program.function(*function).codomain;
                let kind = FaultKind::OutOfDomain { location: location.clone(), value, domain };
                return executor.fault(span, kind);
            }
            let index = executor.core.store.number(*function, arguments);
            if let Some(journal) = &mut executor.core.journal {
                journal.note(&executor.core.store, index);
            }
            executor.core.store.values[index as usize] = value;
            executor.core.disturbed |= matches!(kind, FunctionKind::Controlled | FunctionKind::Out);
            executor.core.memo.changed();
            executor.core.store.given[index as usize] = executor.core.epoch;
            let input = (index, *function);
            if program.function(*function).kind == FunctionKind::Monitored && !executor.core.inputs.contains(&input) {
                executor.core.inputs.push(input);
            }
            Ok(())
        })
    }

    /// All locations of dynamic functions that have a value other than undef, in canonical order; inputs included
    /// as long as they are not forgotten.
    pub fn locations(&self) -> Vec<(Location, Value)> {
        let store = &self.core.store;
        let mut all: Vec<(Location, Value)> = (0..store.len())
            .filter(|index| !store.values[*index].is_undef())
            .map(|index| (store.location(index as u32), store.values[index].clone()))
            .collect();
        all.sort();
        all
    }

    /// Evaluates a term without parameters in the current state.
    ///
    /// # Errors
    /// What evaluation meets; the state stays as it is.
    pub fn evaluate(&mut self, expression: &Expression, environment: &mut dyn Environment) -> Result<Value, Fault> {
        self.evaluate_with(expression.body, expression.frame, &[], environment)
    }

    /// Evaluates a term in a frame of so many slots, some of which have values.
    ///
    /// # Errors
    /// What evaluation meets; the state stays as it is.
    pub fn evaluate_with(
        &mut self,
        term: TermId,
        frame: u32,
        bindings: &[(Slot, Value)],
        environment: &mut dyn Environment,
    ) -> Result<Value, Fault> {
        self.core.iterations = 0;
        self.execute(environment, |executor, program| {
            executor.in_frame(0, frame, program.term_span(term), |this| {
                bindings.iter().for_each(|(slot, value)| this.bind(*slot, value.clone()));
                this.evaluate(term)
            })
        })
    }

    /// The elements of a domain in the current state, in canonical order.
    ///
    /// # Errors
    /// A domain that is infinite or without contents.
    pub fn elements(&mut self, domain: DomainId) -> Result<Vec<Value>, Fault> {
        let span = Span { file: syntax::FileId(0), start: 0, end: 0 };
        self.execute(&mut Closed, |executor, _| executor.listed(domain, span)).map(|elements| elements.to_vec())
    }

    /// Whether a value is in a domain in the current state (undef is in every one).
    pub fn contains(&mut self, domain: DomainId, value: &Value) -> bool {
        self.execute(&mut Closed, |executor, _| Ok(executor.contains(domain, value))).unwrap_or(false)
    }

    /// A copy of the state.
    pub fn snapshot(&self) -> Snapshot {
        Snapshot {
            store: self.core.store.clone(),
            steps: self.steps,
            initials: self.core.initials.clone(),
            epoch: self.core.epoch,
        }
    }

    /// Goes back to a state copied from this machine, or from another of the same program; one with more terms is the same, too.
    pub fn restore(&mut self, snapshot: &Snapshot) {
        self.discard();
        self.core.store.clone_from(&snapshot.store);
        self.core.initials.clone_from(&snapshot.initials);
        for carrier in &mut self.core.store.carriers {
            carrier.fresh = carrier.count;
        }
        self.core.disturbed = true;
        self.core.inputs.clear();
        // No input of that state, whichever machine gave it, counts as one of this epoch.
        self.core.epoch = self.core.epoch.max(snapshot.epoch) + 1;
        self.core.clock = [None; 3];
        self.core.updates.renumbered();
        self.core.memo.changed();
        self.steps = snapshot.steps;
        self.core.updates.release();
        self.settled = false;
    }

    /// Leaves the step that is being made, and its inputs, for a state of so many steps.
    pub(crate) fn unwind(&mut self, steps: u64) {
        self.discard();
        self.forget_inputs();
        self.core.updates.release();
        (self.steps, self.settled) = (steps, false);
    }

    /// Counts from now on which rules run.
    pub fn enable_coverage(&mut self) {
        self.core.coverage = Some(Box::new(Coverage::new(&self.program)));
    }

    /// What has run since coverage was enabled.
    pub fn coverage(&self) -> Option<&Coverage> {
        self.core.coverage.as_deref()
    }

    /// The function of a name and a number of parameters.
    pub fn find_function(&self, name: &str, arity: usize) -> Option<FunctionId> {
        self.program.find_function(name, arity)
    }
}
