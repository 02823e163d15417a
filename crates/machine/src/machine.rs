//! The machine's public interface: a program and its current state, which changes step by step.

use std::sync::Arc;

use program::{DomainId, Expression, FunctionId, FunctionKind, ProcedureId, Program, Slot, TermId};
use syntax::Span;

use crate::coverage::Coverage;
use crate::environment::{Closed, Environment};
use crate::execute::{Core, Executor, Outcome};
use crate::fault::{Fault, FaultKind};
use crate::interrupt::Interrupt;
use crate::limits::Limits;
use crate::location::{Location, LocationRef};
use crate::native::{self, Ended, Engine, SharedCode};
use crate::start::AT_START;
use crate::step::{Passed, Step};
use crate::store::Store;
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

/// What makes the steps. Both give the same steps and the same faults.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum EngineChoice {
    /// Interpreted at first, compiled once the run has become long enough to pay for it.
    #[default]
    Automatic,
    /// The program is walked over.
    Interpreted,
    /// Machine code from the first step on, where there is any for this processor.
    Compiled,
}

/// LIMIT: steps made, and an eighth of their updates, before the main rule is compiled.
const COMPILED_AFTER: u64 = 256;
/// LIMIT: the same of another procedure, most of which make few steps.
const OTHERS_COMPILED_AFTER: u64 = 1 << 16;

/// The compiled engine, as far as it has come.
#[derive(Debug, Default)]
struct EngineState {
    choice: EngineChoice,
    /// One a procedure that has made steps, in the order in which they came up.
    codes: Vec<Code>,
    /// The one that makes the present step.
    running: usize,
}

/// A procedure that makes steps.
#[derive(Debug)]
struct Code {
    procedure: ProcedureId,
    /// Steps made, and an eighth of their updates.
    work: u64,
    tried: bool,
    engine: Option<Box<Engine>>,
}

impl EngineState {
    /// From now on this procedure makes the step.
    fn run(&mut self, procedure: ProcedureId) -> &mut Code {
        if self.codes.get(self.running).is_none_or(|code| code.procedure != procedure) {
            let known = self.codes.iter().position(|code| code.procedure == procedure);
            self.running = known.unwrap_or(self.codes.len());
            if known.is_none() {
                self.codes.push(Code { procedure, work: 0, tried: false, engine: None });
            }
        }
        &mut self.codes[self.running]
    }
}

/// A machine: a program and its current state.
#[derive(Debug)]
pub struct Machine {
    program: Arc<Program>,
    limits: Limits,
    pub(crate) core: Core,
    steps: u64,
    /// The update set on the stack is committed: where an update changed anything it holds the value before.
    settled: bool,
    engine: EngineState,
    /// A step was committed since inputs were last forgotten.
    stale: bool,
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
        let (coverage, exploring, unset) = (self.core.coverage.take(), self.core.exploring, self.core.unset);
        let elsewhere = std::mem::take(&mut self.core.elsewhere);
        self.core = Core { elsewhere, ..Core::new(&self.program, &self.limits) };
        // The caller may still return to an earlier state, in which locations were set to undef.
        (self.core.coverage, self.core.exploring, self.core.unset) = (coverage, exploring, unset);
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
        self.execute(environment, |executor, _| executor.start())
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
        self.begin();
        if self.has_code(procedure) && self.runs_compiled(environment) {
            return Ok(());
        }
        self.interpret(procedure, environment)
    }

    /// Computes the update set of a step that has begun by walking over the program.
    fn interpret(&mut self, procedure: ProcedureId, environment: &mut dyn Environment) -> Result<(), Fault> {
        let outcome = self.execute(environment, |executor, program| {
            let span = program.procedure(procedure).span;
            executor.enter(procedure, 0, span)
        });
        if outcome.is_err() {
            self.discard();
        }
        outcome
    }

    /// Makes steps of the main rule one after the other, until as many are made as are `wanted` in all, a domain has
    /// grown, or there was nothing to update. After each the environment is told ([`Environment::step_made`]); else
    /// nobody looks at the states between them, which makes these steps the fastest.
    ///
    /// # Errors
    /// A fault leaves the state as it was after the steps that were counted.
    pub fn pass(&mut self, wanted: u64, environment: &mut dyn Environment, passed: &mut Passed) -> Result<(), Fault> {
        while passed.steps < wanted {
            let main = self.program.main;
            let step = match main.filter(|main| self.has_code(*main)) {
                None => self.step(environment)?,
                Some(main) => match self.passes_compiled(wanted, environment, passed) {
                    Ended::Enough | Ended::Paused => return Ok(()),
                    Ended::Abandoned => {
                        self.interpret(main, environment)?;
                        self.commit()
                    }
                },
            };
            passed.count(step);
            environment.step_made();
            if step.grown || step.updates == 0 {
                break;
            }
        }
        Ok(())
    }

    /// Which engine makes the steps; [`EngineChoice::Automatic`] if nobody says.
    pub fn use_engine(&mut self, choice: EngineChoice) {
        self.engine = EngineState { choice, ..EngineState::default() };
    }

    /// Whether there is compiled code for a procedure, compiling it when that is due.
    fn has_code(&mut self, procedure: ProcedureId) -> bool {
        if std::mem::take(&mut self.core.disturbed) {
            self.look_again();
        }
        let choice = self.engine.choice;
        let Code { work, tried, engine, .. } = self.engine.run(procedure);
        let is_main = self.program.main == Some(procedure);
        let due = match choice {
            EngineChoice::Interpreted => false,
            EngineChoice::Compiled if is_main => true,
            _ if is_main => *work > COMPILED_AFTER,
            _ => *work > OTHERS_COMPILED_AFTER,
        };
        if !due || self.core.coverage.is_some() {
            return false;
        }
        if !*tried {
            *tried = true;
            let code = native::Code::compile(&self.program, procedure, &self.core, false);
            *engine = code.map(|code| Box::new(Engine::new(Arc::new(code))));
        }
        if choice == EngineChoice::Automatic && engine.as_ref().is_some_and(|engine| !engine.pays()) {
            *engine = None;
        }
        engine.is_some()
    }

    /// Throws code away that takes a function for a constant which has other values now. The next code relies on it no more.
    fn look_again(&mut self) {
        for code in &mut self.engine.codes {
            let changed = code.engine.as_ref().map(|engine| engine.code().unsettled(&self.core)).unwrap_or_default();
            if !changed.is_empty() {
                self.core.elsewhere.add_varying(&changed);
                (code.tried, code.engine) = (false, None);
            }
        }
    }

    /// Compiles the main rule now, to code that notes which rules run, unless another machine has done so; whether there is
    /// such code.
    pub(crate) fn compile_main(&mut self, shared: &SharedCode) -> bool {
        let Some(main) = self.program.main else { return false };
        let compile = || native::Code::compile(&self.program, main, &self.core, true).map(Arc::new);
        let engine = match shared.get_or_compile(compile) {
            Some(code) if code.fits(&self.program, main, &self.core) => Some(code),
            Some(_) => compile(),
            None => None,
        };
        let code = self.engine.run(main);
        (code.tried, code.engine) = (true, engine.map(|code| Box::new(Engine::new(code))));
        code.engine.is_some()
    }

    /// The code of the main rule, if it was compiled.
    pub(crate) fn main_engine(&self) -> Option<&Engine> {
        self.engine.codes.iter().find(|code| Some(code.procedure) == self.program.main)?.engine.as_deref()
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

    /// Computes the update set of a step that has begun by compiled code; false where it is to be interpreted.
    pub(crate) fn runs_compiled(&mut self, environment: &mut dyn Environment) -> bool {
        let Machine { program, core, limits, engine, .. } = self;
        let Some(engine) = &mut engine.codes[engine.running].engine else { return false };
        core.clear_calls();
        let mut executor = Executor { program, core, environment, limits };
        let computed = engine.run(&mut executor);
        if !computed {
            self.repeat();
        }
        computed
    }

    /// Makes steps by compiled code. One that is abandoned has begun, and is to be interpreted.
    fn passes_compiled(&mut self, wanted: u64, environment: &mut dyn Environment, passed: &mut Passed) -> Ended {
        self.discard();
        let Machine { program, core, limits, engine, .. } = self;
        let Some(engine) = &mut engine.codes[engine.running].engine else { return Ended::Enough };
        core.clear_calls();
        let before = passed.steps;
        let mut executor = Executor { program, core, environment, limits };
        let ended = engine.pass(&mut executor, self.stale, wanted, passed);
        self.steps += passed.steps - before;
        (self.settled, self.stale) = (true, true);
        if let Ended::Abandoned = ended {
            (self.settled, self.stale) = (false, false);
            self.repeat();
        }
        ended
    }

    /// Starts an abandoned step again: it will make the same choices.
    fn repeat(&mut self) {
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
        if let Some(code) = self.engine.codes.get_mut(self.engine.running) {
            code.work += 1 + step.updates as u64 / 8;
        }
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
        let store = &self.core.store;
        self.core.inputs.iter().map(|(i, _)| (store.location(*i), store.values[*i as usize].clone())).collect()
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
        if value.is_undef() && !self.core.unset && matches!(kind, FunctionKind::Controlled | FunctionKind::Out) {
            // Compiled code relies on locations that the program itself never sets to undef.
            self.core.unset = true;
            self.use_engine(self.engine.choice);
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
