//! The commands of a scenario, made on a machine: sets, checks, rules, picks, steps, and the invariants around them.
//!
//! In: one command at a time. Out: what it did to the machine, and what went wrong. It must not know the order of commands:
//! that is [`crate::play`].

use std::sync::Arc;

use machine::{Change, Fault, FaultKind, Limits, Location, Machine, Value};
use program::{Expression, FunctionKind, ProcedureId, Program, PropertyKind};
use syntax::Span;
use syntax::ast::Expected;

use crate::environment::{Choices, Made, Picked, ScenarioEnvironment};
use crate::explain::{explain, part, sides};
use crate::script::{Pick, Script, Set};
use crate::story::{PassageKind, Story};
use crate::verdict::{Failure, FailureKind, Remark};

/// How a scenario is run.
#[derive(Debug, Clone)]
pub struct Options {
    /// The machine's limits.
    pub limits: Limits,
    /// The bound of a `step until` that gives none.
    pub bound: u64,
    /// Whether to count what runs.
    pub coverage: bool,
    /// Whether the verdict is to tell what happened.
    pub story: bool,
}

impl Default for Options {
    fn default() -> Self {
        Options { limits: Limits::default(), bound: 1_000_000, coverage: false, story: false }
    }
}

/// What the last move did to the machine.
#[derive(Debug, Clone, Default)]
pub struct Moved {
    /// It made a step or executed a rule, or tried to.
    pub ran: bool,
    /// It did not come to its end: there is no step.
    pub failed: bool,
    /// What that changed.
    pub changes: Vec<Change>,
    /// Its choices, if they are kept.
    pub choices: Vec<Made>,
}

/// Whether to go on; the failures are noted already.
pub(crate) type Going = Result<(), Stopped>;

#[derive(Debug)]
pub(crate) struct Stopped;

/// The machine of a scenario and what has happened on it.
#[derive(Debug)]
pub(crate) struct Stage<'a> {
    pub script: &'a Script,
    pub program: Arc<Program>,
    pub machine: Machine,
    pub environment: ScenarioEnvironment<'a>,
    /// The picks of the group, made before its step.
    pub picked: Vec<Picked>,
    /// What moves do is kept.
    pub keeps: bool,
    pub moved: Moved,
    pub steps: u64,
    pub checks: (u64, u64),
    pub failures: Vec<Failure>,
    pub remarks: Vec<Remark>,
    pub story: Option<Story>,
}

impl<'a> Stage<'a> {
    pub fn new(
        script: &'a Script,
        program: Arc<Program>,
        options: &Options,
        choices: &'a mut dyn Choices,
    ) -> Stage<'a> {
        let mut machine = Machine::new(Arc::clone(&program), options.limits.clone());
        if options.coverage {
            machine.enable_coverage();
        }
        let mut environment = ScenarioEnvironment::new(choices);
        environment.made = options.story.then(Vec::new);
        Stage {
            script,
            program,
            machine,
            environment,
            picked: Vec::new(),
            keeps: false,
            moved: Moved::default(),
            steps: 0,
            checks: (0, 0),
            failures: Vec::new(),
            remarks: Vec::new(),
            story: options.story.then(Story::default),
        }
    }

    /// Sets the initial state. Sets before the first step are part of it: it is set once to evaluate their values
    /// and, where there are any, a second time with them.
    pub fn start(&mut self) -> Going {
        let script = self.script;
        let Some(first) = script.groups.first().filter(|first| !first.parts.sets.is_empty()) else {
            self.start_machine()?;
            self.machine.forget_inputs();
            return Ok(());
        };
        // Initial values may ask for what the sets give; whether there is an initial state shows only with them.
        let _ = self.machine.start(&mut self.environment);
        self.environment.mispick = None;
        let shared = self.sets(&first.parts.sets)?;
        self.start_machine()?;
        for (location, value, span) in shared {
            let set = self.machine.set(&location, value);
            self.try_to(set, span)?;
        }
        self.machine.forget_inputs();
        Ok(())
    }

    fn start_machine(&mut self) -> Going {
        let started = self.machine.start(&mut self.environment);
        self.try_to(started, self.script.span)
    }

    /// Evaluates and makes sets, each seeing those before; gives those of shared locations.
    pub fn sets(&mut self, sets: &[Set]) -> Result<Vec<(Location, Value, Span)>, Stopped> {
        let mut shared = Vec::new();
        for set in sets {
            let mut arguments = Vec::with_capacity(set.arguments.len());
            for argument in &set.arguments {
                arguments.push(self.evaluate(argument, set.span)?);
            }
            let location = Location { function: set.function, arguments };
            let value = self.evaluate(&set.value, set.span)?;
            if self.program.function(set.function).kind == FunctionKind::Shared {
                let made = self.machine.set(&location, value.clone());
                self.try_to(made, set.span)?;
                shared.push((location, value, set.span));
            } else {
                self.check_codomain(set, &location, &value)?;
                self.environment.inputs.insert(location, value);
                // What was asked for before must be asked for again.
                self.machine.forget_inputs();
            }
        }
        Ok(shared)
    }

    fn check_codomain(&mut self, set: &Set, location: &Location, value: &Value) -> Going {
        let domain = self.program.function(set.function).codomain;
        if self.machine.contains(domain, value) {
            return Ok(());
        }
        let kind = FaultKind::OutOfDomain { location: location.clone(), value: value.clone(), domain };
        let fault = Fault { kind, span: set.span, calls: Vec::new() };
        self.try_to(Err::<(), _>(fault), set.span)
    }

    pub fn check(&mut self, formula: &Expression, span: Span) -> Going {
        if self.evaluate(formula, span)? == Value::Boolean(true) {
            self.checks.0 += 1;
            return Ok(());
        }
        self.checks.1 += 1;
        let (actual, expected) = match sides(&self.program, formula) {
            Some((left, right)) => {
                (self.evaluate(&part(formula, left), span)?, self.evaluate(&part(formula, right), span)?)
            }
            None => (self.evaluate(formula, span)?, Value::Boolean(true)),
        };
        let reads = explain(&mut self.machine, &mut self.environment, formula);
        self.fail(span, FailureKind::Check { expected, actual, reads });
        Ok(())
    }

    pub fn exec(&mut self, procedure: ProcedureId, span: Span) -> Going {
        // The inputs are given, so writing undef to one is a change.
        self.machine.forget_inputs();
        for (location, value) in self.environment.inputs.clone() {
            let set = self.machine.set(&location, value);
            self.try_to(set, span)?;
        }
        let prepared = self.machine.prepare_procedure(procedure, &mut self.environment);
        self.try_to(prepared, span)?;
        self.machine.commit();
        self.tell(PassageKind::Exec);
        // What it writes to monitored locations is an input until it is set again.
        for change in self.machine.changes() {
            if self.program.function(change.location.function).kind == FunctionKind::Monitored {
                let set = self.machine.set(&change.location, change.after.clone());
                self.try_to(set, span)?;
                match change.after {
                    Value::Undef => self.environment.inputs.remove(&change.location),
                    value => self.environment.inputs.insert(change.location, value),
                };
            }
        }
        Ok(())
    }

    pub fn pick(&mut self, pick: &Pick) -> Going {
        let value = self.evaluate(&pick.value, pick.span)?;
        if value.is_undef() {
            let choice = pick.choices.first().map_or(pick.span, |(span, _)| *span);
            let message = format!("undef cannot be picked for {}", pick.variable);
            self.fail(pick.span, FailureKind::Pick { choice, message });
            return Err(Stopped);
        }
        let (variable, choices) = (pick.variable.clone(), pick.choices.clone());
        self.picked.push(Picked { variable, choices, value, span: pick.span, used: false });
        Ok(())
    }

    /// Whether the condition of a `step until` holds; after the last step it must.
    pub fn is_reached(&mut self, condition: &Expression, last: bool, bound: u64, span: Span) -> Result<bool, Stopped> {
        let reached = self.evaluate(condition, span)? == Value::Boolean(true);
        if last && !reached {
            self.fail(span, FailureKind::Bound { bound });
            return Err(Stopped);
        }
        Ok(reached)
    }

    pub fn report_unused_picks(&mut self) {
        for pick in std::mem::take(&mut self.environment.picks) {
            if !pick.used {
                let message = format!("no choice of {} was made, the pick is not used", pick.variable);
                self.remarks.push(Remark { span: pick.span, message });
            }
        }
    }

    pub fn step(&mut self, span: Span) -> Going {
        // The invariants that read inputs are about the state before the step; nothing may be prepared while their
        // inputs are asked for anew.
        self.invariants(true, span)?;
        let prepared = self.machine.prepare(&mut self.environment);
        if prepared.is_err() {
            self.tell(PassageKind::Attempt(self.steps + 1));
        }
        self.try_to(prepared, span)?;
        self.machine.commit();
        self.steps += 1;
        self.tell(PassageKind::Step(self.steps));
        self.environment.seconds += 1;
        self.invariants(false, span)
    }

    /// A step that must not be possible; the state stays as it is.
    pub fn trouble(&mut self, expected: Expected, span: Span) -> Going {
        let outcome = self.machine.prepare(&mut self.environment);
        self.machine.discard();
        let instead = match outcome {
            Err(fault) if is_trouble(&fault, expected) => return Ok(()),
            Err(fault) => {
                let kind = FailureKind::Fault { fault: Box::new(fault), during: span };
                vec![Failure { step: self.steps, span, kind }]
            }
            Ok(()) => Vec::new(),
        };
        self.fail(span, FailureKind::Expected { expected, invariant: None, instead });
        Err(Stopped)
    }

    /// Evaluates the invariants that read inputs, or those that do not: the model's and the scenario's.
    pub fn invariants(&mut self, reads_monitored: bool, during: Span) -> Going {
        let program = Arc::clone(self.machine.program());
        let of_model = program
            .properties
            .iter()
            .filter(|property| property.kind == PropertyKind::Invariant && property.reads_monitored == reads_monitored);
        for property in of_model {
            self.invariant(&property.name, &property.formula, property.span, during)?;
        }
        let script = self.script;
        for invariant in script.invariants.iter().filter(|own| own.reads_monitored == reads_monitored) {
            self.invariant(&invariant.name, &invariant.formula, invariant.span, during)?;
        }
        if self.failures.is_empty() { Ok(()) } else { Err(Stopped) }
    }

    fn invariant(&mut self, name: &str, formula: &Expression, span: Span, during: Span) -> Going {
        let outcome = self.machine.evaluate(formula, &mut self.environment);
        if outcome == Ok(Value::Boolean(true)) {
            return Ok(());
        }
        // Not judged before its inputs are there. They may have been asked for earlier in the step: ask again.
        self.environment.missing = false;
        self.machine.forget_inputs();
        let outcome = self.machine.evaluate(formula, &mut self.environment);
        if self.environment.missing {
            return Ok(());
        }
        let value = self.try_to(outcome, during)?;
        let reads = explain(&mut self.machine, &mut self.environment, formula);
        self.fail(span, FailureKind::Invariant { name: name.to_string(), value, during, reads });
        Ok(())
    }

    fn evaluate(&mut self, expression: &Expression, during: Span) -> Result<Value, Stopped> {
        let outcome = self.machine.evaluate(expression, &mut self.environment);
        self.try_to(outcome, during)
    }

    /// Notes a fault as the scenario's failure.
    fn try_to<T>(&mut self, outcome: Result<T, Fault>, during: Span) -> Result<T, Stopped> {
        outcome.map_err(|fault| {
            let kind = match self.environment.mispick.take() {
                Some(mispick) => {
                    let kind = FailureKind::Pick { choice: mispick.choice, message: mispick.message };
                    self.fail(mispick.span, kind);
                    return Stopped;
                }
                None => FailureKind::Fault { fault: Box::new(fault), during },
            };
            self.fail(during, kind);
            Stopped
        })
    }

    fn tell(&mut self, kind: PassageKind) {
        let made = self.environment.made.as_mut().map(std::mem::take).unwrap_or_default();
        if self.keeps {
            self.moved.ran = true;
            self.moved.choices.clone_from(&made);
            self.moved.failed = matches!(kind, PassageKind::Attempt(_));
            if !self.moved.failed {
                self.moved.changes = self.machine.changes();
            }
        }
        if let Some(story) = &mut self.story {
            story.add(kind, &self.environment.inputs, made, &self.machine);
        }
    }

    fn fail(&mut self, span: Span, kind: FailureKind) {
        self.failures.push(Failure { step: self.steps, span, kind });
    }
}

/// Whether a fault is the trouble that is expected.
pub(crate) fn is_trouble(fault: &Fault, expected: Expected) -> bool {
    let clash = matches!(fault.kind, FaultKind::InconsistentUpdate { .. });
    if let FaultKind::Interrupted(_) = fault.kind {
        return false;
    }
    match expected {
        Expected::InconsistentUpdate => clash,
        Expected::Error => !clash,
        Expected::Failure => true,
        Expected::Check | Expected::Invariant => false,
    }
}
