//! A run: steps one after the other, with invariants checked where the language says, until something says stop.
//!
//! Order within a step (spec/language.md, section 9): the environment's writes, the update set, the invariants that
//! read inputs, the commit, the other invariants. INVARIANT: after [`Record::End`] nothing follows; a step that
//! faults leaves the state as it was.

use std::collections::VecDeque;
use std::sync::Arc;

use machine::{Cause, EngineChoice, Fault, FaultKind, Limits, Machine, Passed, Snapshot, Step, Value};
use program::{Expression, Program};

use crate::inputs::Inputs;
use crate::invariants::Watch;
use crate::signal::Signal;
use crate::trace::{End, Invariants, Record, StepRecord, Violation};

/// When to stop, and what to record.
#[derive(Debug, Clone)]
pub struct Options {
    /// The most steps to make; none for no bound.
    pub steps: Option<u64>,
    /// Stop when the update set is empty.
    pub stop_on_empty: bool,
    /// Stop when the update set changes nothing.
    pub stop_on_trivial: bool,
    /// Stop when this holds, the initial state included.
    pub until: Option<Expression>,
    /// What is done about invariants.
    pub invariants: Invariants,
    /// Whether records hold inputs, choices and changes.
    pub keep: bool,
    /// How many steps can be taken back.
    pub history: usize,
    /// What makes the steps.
    pub engine: EngineChoice,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            steps: Some(100),
            stop_on_empty: false,
            stop_on_trivial: false,
            until: None,
            invariants: Invariants::Stop,
            keep: true,
            history: 0,
            engine: EngineChoice::Automatic,
        }
    }
}

/// A run; see the module.
#[derive(Debug)]
pub struct Run {
    machine: Machine,
    inputs: Inputs,
    options: Options,
    watch: Watch,
    history: VecDeque<Box<Snapshot>>,
    made: u64,
    phase: Phase,
}

#[derive(Debug, PartialEq)]
enum Phase {
    New,
    Running,
    Ending(Box<End>),
    Ended,
}

/// What became of a step.
enum Made {
    /// It was made.
    Step,
    /// It was made with others, which were counted.
    Unseen,
    /// It could not be made.
    Attempt,
    /// Something else came instead.
    Other(Box<Record>),
}

impl Run {
    /// A run that has not begun.
    pub fn new(program: Arc<Program>, limits: Limits, mut inputs: Inputs, options: Options) -> Run {
        let watch = match options.invariants {
            Invariants::Ignore => Watch::default(),
            _ => Watch::of(&program),
        };
        inputs.keep = options.keep;
        let mut machine = Machine::new(program, limits);
        machine.use_engine(options.engine);
        machine.watch_conditions(watch.conditions(machine.program()));
        let (history, phase) = (VecDeque::new(), Phase::New);
        Run { machine, inputs, options, watch, history, made: 0, phase }
    }

    /// A run of the same machine from its initial state, with other inputs. What the machine has compiled is kept.
    pub fn again(self, mut inputs: Inputs) -> Run {
        inputs.keep = self.options.keep;
        Run { inputs, history: VecDeque::new(), made: 0, phase: Phase::New, ..self }
    }

    /// The machine in its current state.
    pub fn machine(&self) -> &Machine {
        &self.machine
    }

    /// The machine, to evaluate terms in its current state or to change it.
    pub fn machine_mut(&mut self) -> &mut Machine {
        self.watch.forget();
        &mut self.machine
    }

    /// How many steps have been made.
    pub fn steps(&self) -> u64 {
        self.made
    }

    /// Ends the run before its next step.
    pub fn stop(&mut self, end: End) {
        if !matches!(self.phase, Phase::Ending(_) | Phase::Ended) {
            self.phase = Phase::Ending(Box::new(end));
        }
    }

    /// Takes the last step back; none if none is kept that could be taken back.
    pub fn take_back(&mut self) -> Option<Record> {
        let can = !self.history.is_empty() && !matches!(self.phase, Phase::New);
        can.then(|| {
            self.phase = Phase::Running;
            self.back(None)
        })
    }

    /// The next record; none after the end.
    pub fn advance(&mut self) -> Option<Record> {
        match std::mem::replace(&mut self.phase, Phase::Running) {
            Phase::New => Some(self.begin()),
            Phase::Running if self.options.steps.is_some_and(|steps| self.made >= steps) => Some(self.end(End::Steps)),
            Phase::Running => Some(self.step()),
            Phase::Ending(end) => Some(self.end(*end)),
            Phase::Ended => {
                self.phase = Phase::Ended;
                None
            }
        }
    }

    fn end(&mut self, end: End) -> Record {
        self.phase = Phase::Ended;
        Record::End(end)
    }

    fn begin(&mut self) -> Record {
        self.inputs.prepare(&mut self.machine);
        if let Err(fault) = self.machine.start(&mut self.inputs) {
            return self.end(self.trouble(fault));
        }
        self.inputs.prepare(&mut self.machine);
        let (choices, times) = (std::mem::take(&mut self.inputs.chosen), std::mem::take(&mut self.inputs.times));
        let inputs = if self.options.keep { self.machine.inputs() } else { Vec::new() };
        let values = if self.options.keep { self.machine.locations() } else { Vec::new() };
        let mut violations = Vec::new();
        if let Err(fault) = self.watch.check_state(&mut self.machine, &mut self.inputs, &mut violations) {
            self.stop_with(self.trouble(*fault));
        }
        self.judge(&violations);
        if self.phase == Phase::Running {
            self.check_until();
        }
        Record::Initial { inputs, choices, times, values, violations }
    }

    /// Makes this many steps, or fewer if the run ends, and keeps no record of them.
    pub fn pass(&mut self, steps: u64) -> Passed {
        let mut passed = Passed::default();
        while let Some(record) = self.pass_to_record(steps, &mut passed) {
            if !matches!(record, Record::Initial { .. } | Record::Step(_)) {
                break;
            }
        }
        passed
    }

    /// Makes steps, counted in `passed`, until these are as many as `steps`, and gives the first record that says more than that a step was
    /// made: of a step that violates something, of one that could not be made, of the end. None: all were made, or the run was over.
    pub fn pass_to_record(&mut self, steps: u64, passed: &mut Passed) -> Option<Record> {
        let mut record = StepRecord::default();
        while passed.steps < steps {
            let bounded = self.options.steps.is_some_and(|steps| self.made >= steps);
            if self.phase != Phase::Running || bounded || self.options.keep {
                let record = self.advance()?;
                if let Record::Step(step) = &record {
                    passed.count(summary(step));
                }
                return Some(record);
            }
            record.step = self.made + 1;
            let made = match self.can_pass() {
                true => self.pass_unseen(&mut record, steps, passed),
                false => self.make(&mut record),
            };
            match made {
                Made::Unseen => {}
                Made::Step => {
                    passed.count(summary(&record));
                    if !record.violations.is_empty() {
                        return Some(Record::Step(record));
                    }
                    record.writes.clear();
                }
                Made::Attempt => return Some(Record::Attempt(record)),
                Made::Other(record) => return Some(*record),
            }
        }
        None
    }

    /// Whether nothing needs to look at the states between steps.
    fn can_pass(&self) -> bool {
        let Options { until, stop_on_empty, stop_on_trivial, history, .. } = &self.options;
        let ends = until.is_some() || *stop_on_empty || *stop_on_trivial;
        !ends && *history == 0 && self.watch.is_idle() && self.inputs.can_pass()
    }

    /// Makes steps as [`Machine::pass`] does; the record is that of a step at fault.
    fn pass_unseen(&mut self, record: &mut StepRecord, wanted: u64, passed: &mut Passed) -> Made {
        if let Err(fault) = self.inputs.begin(record.step, &mut self.machine, &mut record.writes) {
            return self.failed(record, *fault, None);
        }
        let before = passed.steps;
        let bound = self.options.steps.map_or(wanted, |steps| wanted.min(before + (steps - self.made)));
        let outcome = self.machine.pass(bound, &mut self.inputs, passed);
        self.made += passed.steps - before;
        self.inputs.grown = true;
        match outcome {
            Ok(()) => Made::Unseen,
            Err(fault) => {
                record.step = self.made + 1;
                self.failed(record, fault, None)
            }
        }
    }

    fn step(&mut self) -> Record {
        let mut record = StepRecord { step: self.made + 1, ..StepRecord::default() };
        match self.make(&mut record) {
            Made::Step | Made::Unseen => Record::Step(record),
            Made::Attempt => Record::Attempt(record),
            Made::Other(record) => *record,
        }
    }

    /// Makes the step that the record has the number of.
    fn make(&mut self, record: &mut StepRecord) -> Made {
        let before = (self.options.history > 0).then(|| Box::new(self.machine.snapshot()));
        if let Err(fault) = self.prepare(record) {
            return self.failed(record, *fault, before);
        }
        self.judge(&record.violations);
        self.note_inputs(record);
        if self.phase != Phase::Running {
            self.machine.discard();
            return Made::Attempt;
        }
        self.commit(record, before);
        Made::Step
    }

    fn prepare(&mut self, record: &mut StepRecord) -> Result<(), Box<Fault>> {
        self.inputs.begin(record.step, &mut self.machine, &mut record.writes)?;
        if let Err(fault) = self.machine.prepare(&mut self.inputs) {
            return Err(Box::new(fault));
        }
        self.watch.check_inputs(&mut self.machine, &mut self.inputs, &mut record.violations)
    }

    fn commit(&mut self, record: &mut StepRecord, before: Option<Box<Snapshot>>) {
        let step = self.machine.commit();
        self.made += 1;
        self.inputs.grown |= step.grown;
        record.updates = step.updates;
        record.changed = step.changed;
        if self.options.keep {
            record.changes = self.machine.changes();
        }
        self.watch.note(&self.machine, step.grown);
        if let Err(fault) = self.watch.check_state(&mut self.machine, &mut self.inputs, &mut record.violations) {
            self.stop_with(self.trouble(*fault));
        }
        self.judge(&record.violations);
        if self.phase == Phase::Running && self.options.until.is_some() {
            self.check_until();
        }
        if step.updates == 0 && self.options.stop_on_empty {
            self.stop(End::Empty);
        } else if !step.changed && self.options.stop_on_trivial {
            self.stop(End::Trivial);
        }
        self.inputs.finish(self.made, false);
        if let Some(snapshot) = before {
            if self.history.len() == self.options.history {
                self.history.pop_front();
            }
            self.history.push_back(snapshot);
        }
    }

    /// A step that could not be made: the model's fault, or the user at the prompt wants something else.
    #[cold]
    fn failed(&mut self, record: &mut StepRecord, fault: Fault, before: Option<Box<Snapshot>>) -> Made {
        self.machine.discard();
        let end = self.trouble(fault);
        if let End::Quit | End::Interrupted = end {
            return Made::Other(Box::new(self.end(end)));
        }
        match self.inputs.signal {
            Some(Signal::Back) => {
                self.inputs.signal = None;
                return Made::Other(Box::new(self.back(before)));
            }
            Some(Signal::Abandon) => {
                self.inputs.signal = None;
                return Made::Other(Box::new(self.abandon(before)));
            }
            Some(Signal::Quit) | None => {}
        }
        self.note_inputs(record);
        self.stop_with(end);
        Made::Attempt
    }

    /// What the environment wrote for the step goes, too.
    fn abandon(&mut self, before: Option<Box<Snapshot>>) -> Record {
        self.inputs.grown = true;
        self.watch.forget();
        if let Some(snapshot) = before {
            self.machine.restore(&snapshot);
        }
        self.inputs.finish(self.made + 1, true);
        Record::Back { step: self.made + 1 }
    }

    fn back(&mut self, before: Option<Box<Snapshot>>) -> Record {
        self.inputs.grown = true;
        self.watch.forget();
        // From the first step one can only ask that step's inputs again.
        if let Some(snapshot) = self.history.pop_back() {
            self.machine.restore(&snapshot);
            self.made -= 1;
            self.inputs.finish(self.made + 1, true);
        } else if let Some(snapshot) = before {
            self.machine.restore(&snapshot);
            self.inputs.finish(self.made + 1, true);
        }
        Record::Back { step: self.made + 1 }
    }

    fn trouble(&self, fault: Fault) -> End {
        match (&fault.kind, self.inputs.signal) {
            (FaultKind::Environment { .. }, Some(Signal::Quit)) => End::Quit,
            (FaultKind::Interrupted(Cause::Asked), _) => End::Interrupted,
            _ => End::Fault(Box::new(fault)),
        }
    }

    fn note_inputs(&mut self, record: &mut StepRecord) {
        if self.options.keep {
            record.inputs = self.machine.inputs();
            record.choices = std::mem::take(&mut self.inputs.chosen);
            record.times = std::mem::take(&mut self.inputs.times);
        }
    }

    fn stop_with(&mut self, end: End) {
        self.phase = Phase::Ending(Box::new(end));
    }

    fn judge(&mut self, violations: &[Violation]) {
        if !violations.is_empty() && self.options.invariants == Invariants::Stop && self.phase == Phase::Running {
            self.stop_with(End::Violation);
        }
    }

    fn check_until(&mut self) {
        let Some(until) = &self.options.until else { return };
        match self.machine.evaluate(until, &mut self.inputs) {
            Ok(Value::Boolean(true)) => self.stop_with(End::Until),
            Ok(_) => {}
            Err(fault) => self.stop_with(self.trouble(fault)),
        }
    }
}

fn summary(record: &StepRecord) -> Step {
    Step { updates: record.updates, changed: record.changed, grown: false }
}
