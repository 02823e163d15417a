//! Runs a script: groups one after the other, each with its sets, checks and step.
//!
//! INVARIANT: within a group the strict checks come first (they see the inputs of the step just made), then all sets,
//! then checks and execs in the order of the text, then the step. After a failed check the others of its group are
//! made, then the run ends; any other failure ends it at once.

use std::sync::Arc;

use machine::{Fault, FaultKind, Limits, Location, Machine, Value};
use program::{Expression, FunctionKind, ProcedureId, Program, PropertyKind};
use syntax::Span;
use syntax::ast::Expected;

use crate::coverage::Counts;
use crate::environment::{Choices, Picked, ScenarioEnvironment};
use crate::explain::{explain, part, sides};
use crate::script::{Action, Group, Pick, Script, Set, StepKind};
use crate::story::{PassageKind, Story};
use crate::verdict::{Failure, FailureKind, Judgement, Remark, Verdict};

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

/// Runs a script on the program it was resolved with.
pub fn run(script: &Script, program: Arc<Program>, options: Options, choices: &mut dyn Choices) -> (Verdict, Counts) {
    let mut machine = Machine::new(Arc::clone(&program), options.limits.clone());
    if options.coverage {
        machine.enable_coverage();
    }
    let mut play = Play {
        script,
        program: &program,
        machine,
        environment: ScenarioEnvironment::new(choices),
        bound: options.bound,
        steps: 0,
        checks: (0, 0),
        failures: Vec::new(),
        remarks: Vec::new(),
        story: options.story.then(Story::default),
    };
    play.environment.made = options.story.then(Vec::new);
    play.play();
    let counts = play.machine.coverage().map(|coverage| Counts::of(&program, coverage)).unwrap_or_default();
    let Play { steps, checks, failures, remarks, story, .. } = play;
    let judgement = judge(script, steps, failures);
    (Verdict { name: script.name.clone(), judgement, steps, checks, remarks, story }, counts)
}

/// Holds what happened against what was expected.
fn judge(script: &Script, step: u64, failures: Vec<Failure>) -> Judgement {
    let Some(expectation) = &script.expectation else {
        return if failures.is_empty() { Judgement::Passed } else { Judgement::Failed(failures) };
    };
    let named = |name: &String| expectation.invariant.as_ref().is_none_or(|wanted| wanted == name);
    let fits = |failure: &Failure| match (&failure.kind, expectation.expected) {
        (FailureKind::Expected { .. }, _) => false,
        // It says nothing of the model.
        (FailureKind::Fault { fault, .. }, _) if matches!(fault.kind, FaultKind::Interrupted(_)) => false,
        (_, Expected::Failure) | (FailureKind::Check { .. }, Expected::Check) => true,
        (FailureKind::Invariant { name, .. }, Expected::Invariant) => named(name),
        (FailureKind::Fault { fault, .. }, expected) => is_trouble(fault, expected),
        _ => false,
    };
    if failures.iter().any(fits) {
        return Judgement::FailedAsExpected(failures);
    }
    let kind = FailureKind::Expected {
        expected: expectation.expected,
        invariant: expectation.invariant.clone(),
        instead: failures,
    };
    Judgement::Failed(vec![Failure { step, span: expectation.span, kind }])
}

fn is_trouble(fault: &Fault, expected: Expected) -> bool {
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

struct Play<'a> {
    script: &'a Script,
    program: &'a Program,
    machine: Machine,
    environment: ScenarioEnvironment<'a>,
    bound: u64,
    steps: u64,
    checks: (u64, u64),
    failures: Vec<Failure>,
    remarks: Vec<Remark>,
    story: Option<Story>,
}

/// Whether to go on; the failures are noted already.
type Going = Result<(), Stopped>;

struct Stopped;

impl Play<'_> {
    fn play(&mut self) {
        let _ = self.play_groups();
    }

    fn play_groups(&mut self) -> Going {
        let script = self.script;
        self.start()?;
        if let Some(story) = &mut self.story {
            story.begin(&self.machine);
        }
        self.invariants(false, script.span)?;
        for (index, group) in script.groups.iter().enumerate() {
            self.group(group, index == 0)?;
        }
        Ok(())
    }

    /// Sets the initial state. Sets before the first step are part of it: it is set once to evaluate their values
    /// and, where there are any, a second time with them.
    fn start(&mut self) -> Going {
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

    fn group(&mut self, group: &Group, first: bool) -> Going {
        let (parts, span) = (&group.parts, self.span_of(group));
        for action in &parts.actions {
            if let Action::Check { strict: true, formula, span } = action
                && !first
            {
                self.check(formula, *span)?;
            }
        }
        if !first {
            // The clock has gone on.
            self.machine.forget_inputs();
            self.sets(&parts.sets)?;
        }
        let mut ran = false;
        for action in &parts.actions {
            match action {
                Action::Check { strict, formula, span } if first || !strict => self.check(formula, *span)?,
                Action::Check { .. } => {}
                Action::Exec { procedure, span } => {
                    self.exec(*procedure, *span)?;
                    ran = true;
                }
            }
        }
        if !self.failures.is_empty() {
            return Err(Stopped);
        }
        self.pick(&parts.picks)?;
        match &group.step {
            StepKind::Steps { count, span } => (0..*count).try_for_each(|made| {
                if made > 0 {
                    self.machine.forget_inputs();
                }
                self.step(*span)
            })?,
            StepKind::Until { condition, bound, span } => self.until(condition, bound.unwrap_or(self.bound), *span)?,
            StepKind::Trouble { expected, span } => self.trouble(*expected, *span)?,
            StepKind::End => {
                if ran {
                    self.invariants(false, span)?;
                }
                self.invariants(true, span)?;
            }
        }
        self.report_unused_picks();
        Ok(())
    }

    /// Where a broken invariant is noticed: the step, or at the end the last command.
    fn span_of(&self, group: &Group) -> Span {
        match &group.step {
            StepKind::Steps { span, .. } | StepKind::Until { span, .. } | StepKind::Trouble { span, .. } => *span,
            StepKind::End => {
                let last = group.parts.actions.last().map(|action| match action {
                    Action::Check { span, .. } | Action::Exec { span, .. } => *span,
                });
                last.or(group.parts.sets.last().map(|set| set.span)).unwrap_or(self.script.span)
            }
        }
    }

    /// Evaluates and makes sets, each seeing those before; gives those of shared locations.
    fn sets(&mut self, sets: &[Set]) -> Result<Vec<(Location, Value, Span)>, Stopped> {
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

    fn check(&mut self, formula: &Expression, span: Span) -> Going {
        if self.evaluate(formula, span)? == Value::Boolean(true) {
            self.checks.0 += 1;
            return Ok(());
        }
        self.checks.1 += 1;
        let (actual, expected) = match sides(self.program, formula) {
            Some((left, right)) => {
                (self.evaluate(&part(formula, left), span)?, self.evaluate(&part(formula, right), span)?)
            }
            None => (self.evaluate(formula, span)?, Value::Boolean(true)),
        };
        let reads = explain(&mut self.machine, &mut self.environment, formula);
        self.fail(span, FailureKind::Check { expected, actual, reads });
        Ok(())
    }

    fn exec(&mut self, procedure: ProcedureId, span: Span) -> Going {
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

    fn pick(&mut self, picks: &[Pick]) -> Going {
        let mut picked = Vec::with_capacity(picks.len());
        for pick in picks {
            let value = self.evaluate(&pick.value, pick.span)?;
            if value.is_undef() {
                let choice = pick.choices.first().map_or(pick.span, |(span, _)| *span);
                let message = format!("undef cannot be picked for {}", pick.variable);
                self.fail(pick.span, FailureKind::Pick { choice, message });
                return Err(Stopped);
            }
            let (variable, choices) = (pick.variable.clone(), pick.choices.clone());
            picked.push(Picked { variable, choices, value, span: pick.span, used: false });
        }
        self.environment.picks = picked;
        Ok(())
    }

    fn report_unused_picks(&mut self) {
        for pick in std::mem::take(&mut self.environment.picks) {
            if !pick.used {
                let message = format!("no choice of {} was made, the pick is not used", pick.variable);
                self.remarks.push(Remark { span: pick.span, message });
            }
        }
    }

    fn step(&mut self, span: Span) -> Going {
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

    fn until(&mut self, condition: &Expression, bound: u64, span: Span) -> Going {
        for _ in 0..bound {
            if self.evaluate(condition, span)? == Value::Boolean(true) {
                return Ok(());
            }
            self.step(span)?;
            self.machine.forget_inputs();
        }
        if self.evaluate(condition, span)? == Value::Boolean(true) {
            return Ok(());
        }
        self.fail(span, FailureKind::Bound { bound });
        Err(Stopped)
    }

    /// A step that must not be possible; the state stays as it is.
    fn trouble(&mut self, expected: Expected, span: Span) -> Going {
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
    fn invariants(&mut self, reads_monitored: bool, during: Span) -> Going {
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
        if let Some(story) = &mut self.story {
            story.add(kind, &self.environment.inputs, made, &self.machine);
        }
    }

    fn fail(&mut self, span: Span, kind: FailureKind) {
        self.failures.push(Failure { step: self.steps, span, kind });
    }
}
