//! A run: steps one after the other, invariants checked where the language says, until something says stop.
//!
//! Order within a step (spec/language.md, section 9): the environment's writes, the update set, the invariants that
//! read inputs, the commit, the other invariants. INVARIANT: after [`Record::End`] nothing follows; a step that
//! faults leaves the state as it was.

use std::collections::VecDeque;
use std::sync::Arc;

use machine::{Fault, FaultKind, Limits, Machine, Snapshot, Value};
use program::{Expression, Program, PropertyKind};

use crate::inputs::{Inputs, Signal};
use crate::trace::{End, Record, StepRecord, Violation};

/// What is done about an invariant that does not hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Invariants {
    /// It ends the run.
    #[default]
    Stop,
    /// It is reported and the run goes on.
    Report,
    /// Invariants are not evaluated.
    Ignore,
}

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
        }
    }
}

/// A run; see the module.
#[derive(Debug)]
pub struct Run {
    machine: Machine,
    inputs: Inputs,
    options: Options,
    invariants: Vec<usize>,
    history: VecDeque<Snapshot>,
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

impl Run {
    /// A run that has not begun.
    pub fn new(program: Arc<Program>, limits: Limits, mut inputs: Inputs, options: Options) -> Run {
        let properties = program.properties.iter().enumerate();
        let invariants = match options.invariants {
            Invariants::Ignore => Vec::new(),
            _ => properties.filter(|(_, p)| p.kind == PropertyKind::Invariant).map(|(index, _)| index).collect(),
        };
        inputs.keep = options.keep;
        let machine = Machine::new(program, limits);
        Run { machine, inputs, options, invariants, history: VecDeque::new(), made: 0, phase: Phase::New }
    }

    /// The machine in its current state.
    pub fn machine(&self) -> &Machine {
        &self.machine
    }

    /// The machine, to evaluate terms in its current state.
    pub fn machine_mut(&mut self) -> &mut Machine {
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
        let times = std::mem::take(&mut self.inputs.times);
        let inputs = if self.options.keep { self.machine.inputs() } else { Vec::new() };
        let values = if self.options.keep { self.machine.locations() } else { Vec::new() };
        let violations = match self.check_invariants(false) {
            Ok(violations) => violations,
            Err(fault) => {
                self.stop_with(End::Fault(Box::new(fault)));
                Vec::new()
            }
        };
        self.judge(&violations);
        if self.phase == Phase::Running {
            self.check_until();
        }
        Record::Initial { inputs, times, values, violations }
    }

    fn step(&mut self) -> Record {
        let step = self.made + 1;
        let before = (self.options.history > 0).then(|| self.machine.snapshot());
        let mut record = StepRecord { step, ..StepRecord::default() };
        let prepared = self.inputs.begin(step, &mut self.machine).and_then(|writes| {
            record.writes = writes;
            self.machine.prepare(&mut self.inputs)
        });
        let prepared = prepared.and_then(|()| self.check_invariants(true));
        match prepared {
            Err(fault) => return self.failed(record, fault, before),
            Ok(violations) => {
                record.violations = violations;
                self.judge(&record.violations);
            }
        }
        self.note_inputs(&mut record);
        if self.phase != Phase::Running {
            self.machine.discard();
            return Record::Attempt(record);
        }
        self.commit(&mut record, before);
        Record::Step(record)
    }

    fn commit(&mut self, record: &mut StepRecord, before: Option<Snapshot>) {
        let step = self.machine.commit();
        self.made += 1;
        record.updates = step.updates;
        record.changed = step.changed;
        if self.options.keep {
            record.changes = self.machine.changes();
        }
        match self.check_invariants(false) {
            Ok(violations) => record.violations.extend(violations),
            Err(fault) => self.stop_with(End::Fault(Box::new(fault))),
        }
        self.judge(&record.violations);
        if self.phase == Phase::Running {
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
    fn failed(&mut self, mut record: StepRecord, fault: Fault, before: Option<Snapshot>) -> Record {
        self.machine.discard();
        let end = self.trouble(fault);
        if let End::Quit = end {
            return self.end(End::Quit);
        }
        if self.inputs.signal == Some(Signal::Back) {
            self.inputs.signal = None;
            return self.back(before);
        }
        self.note_inputs(&mut record);
        self.stop_with(end);
        Record::Attempt(record)
    }

    fn back(&mut self, before: Option<Snapshot>) -> Record {
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
            Err(fault) => self.stop_with(End::Fault(Box::new(fault))),
        }
    }

    /// Evaluates the invariants that read inputs, or those that do not.
    fn check_invariants(&mut self, reads_monitored: bool) -> Result<Vec<Violation>, Fault> {
        let mut violations = Vec::new();
        let program = Arc::clone(self.machine.program());
        for index in &self.invariants {
            let property = &program.properties[*index];
            if property.reads_monitored != reads_monitored {
                continue;
            }
            let value = self.machine.evaluate(&property.formula, &mut self.inputs)?;
            if value != Value::Boolean(true) {
                violations.push(Violation {
                    name: property.name.clone(),
                    span: property.span,
                    value,
                    before: reads_monitored,
                });
            }
        }
        Ok(violations)
    }
}
