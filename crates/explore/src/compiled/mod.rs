//! Steps made by machine code.
//!
//! In: packed states. Out: where their steps lead. A machine of its own, which notes nothing of what steps look at, is put into each
//! state and runs the compiled main rule once for each alternative; only what differs from the state before is unpacked, and
//! only what a step updates is packed again. Where compiled code gives up, at a fault for one, nothing is known of the state and the
//! machine that explores makes the steps. INVARIANT: inputs and choices are asked for in the interpreter's order, so the
//! alternatives come in the same order from both.

mod codec;

use std::ops::ControlFlow;
use std::sync::Arc;

use machine::inside::Elsewhere;
use machine::{EngineChoice, Interrupt, Machine, Value};
use program::{Expression, FunctionKind, Program, RuleId};

use crate::alternatives::branches::Branches;
use crate::alternatives::expansion::Expansion;
use crate::alternatives::successors::Successors;
use crate::memory::maker::{StepMaker, Unmade};
use crate::packed::codes::finite;
use crate::packed::encoding::Encoding;
use crate::packed::interner::{Interner, View};
use crate::packed::words::{NOWHERE, Overwrite, REST};
use crate::settings::{Check, Settings, note_failures};
use crate::starts::{Starts, each_start};
use codec::Codec;

/// See the module.
#[derive(Debug)]
pub(crate) struct Compiled {
    program: Arc<Program>,
    machine: Machine,
    branches: Branches,
    encoding: Arc<Encoding>,
    view: View,
    /// By field.
    codecs: Vec<Codec>,
    /// By word of a packed state, the fields in it.
    fields: Vec<Vec<usize>>,
    /// In the order of their evaluation.
    step_conditions: Vec<StepCondition>,
    /// The packed state that the machine is in.
    loaded: Vec<u64>,
    /// What stands in the fields of the inputs that initial states keep where none is kept.
    asks_all: Vec<Overwrite>,
    /// What the machine's store said of its locations without fields when these were last those of that state.
    touched: u64,
    next: Vec<u64>,
    failed: Vec<u32>,
}

/// A condition on a step, and maybe its negation.
#[derive(Debug)]
struct StepCondition {
    numbers: (u32, Option<u32>),
    formula: Expression,
    assumed: bool,
}

/// What an alternative came to.
enum Step {
    Next,
    Excluded,
    Unknown,
}

impl Compiled {
    /// Compiles the steps of a program; none where its states are more than fields, what steps look at matters, or there is
    /// no compiler for this processor.
    pub fn new(
        program: &Arc<Program>,
        settings: &Settings,
        encoding: &Arc<Encoding>,
        interner: &Arc<Interner>,
        starts: &Starts,
    ) -> Option<Compiled> {
        let plain = encoding.origin.is_none() && encoding.kept.in_rest.is_empty();
        if !plain || settings.observed || !settings.unordered.is_empty() {
            return None;
        }
        let mut machine = Machine::new(Arc::clone(program), settings.limits.clone());
        machine.use_engine(EngineChoice::Interpreted);
        let blank = machine.snapshot();
        let mut branches = Branches::new(Arc::clone(&settings.bounds));
        branches.first();
        let interrupt = Interrupt::default();
        let started =
            each_start(&mut machine, &blank, &mut branches, &interrupt, &mut |_, _| Ok(ControlFlow::Break(())));
        started.ok()?;
        let state = machine.snapshot();
        machine.restore(&state);
        machine.forget_inputs();
        branches.bounds = Arc::new(all_bounds(program, encoding, &mut machine, settings));
        let mut view = View::new(Arc::clone(interner));
        // Each location has the value that its field says from now on, not only those that differ.
        let first = starts.first()?.to_vec();
        encoding.unpack(program, &first, &mut machine, &mut view);
        if !machine.compile_steps(elsewhere(&machine, encoding, starts, &mut view), &settings.code) {
            return None;
        }
        // Conditions on a step are evaluated in the state before it.
        machine.let_stand(settings.checks_of_steps().next().is_none());
        let touched = machine.store().touched();
        let asks_all = encoding.without_inputs(&mut view);
        let codecs = encoding.fields.iter().map(|field| Codec::of(encoding, *field)).collect();
        let mut fields = vec![Vec::new(); encoding.words];
        for (index, field) in encoding.fields.iter().enumerate().filter(|(_, field)| field.bits > 0) {
            fields[field.word as usize].push(index);
        }
        Some(Compiled {
            fields,
            codecs,
            program: Arc::clone(program),
            machine,
            branches,
            encoding: Arc::clone(encoding),
            view,
            step_conditions: settings
                .checks_of_steps()
                .map(|Check { index, formula, assumed, negation }| StepCondition {
                    numbers: (index, negation),
                    formula: formula.clone(),
                    assumed,
                })
                .collect(),
            loaded: first,
            asks_all,
            touched,
            next: Vec::new(),
            failed: Vec::new(),
        })
    }

    /// Whether a rule has run.
    pub fn has_run(&self, rule: RuleId) -> bool {
        self.machine.has_run_compiled(rule)
    }

    /// Puts the machine into a state.
    fn load(&mut self, state: &[u64]) {
        let Compiled { machine, encoding, view, codecs, fields, loaded, touched, .. } = self;
        machine.discard();
        // No step is committed: but for what it touches it leaves the rest as it was.
        let mut rest = machine.store().touched() != *touched;
        let store = machine.store_mut();
        for (word, (now, before)) in state.iter().zip(loaded.iter_mut()).enumerate() {
            let differs = *now ^ *before;
            if differs == 0 {
                continue;
            }
            *before = *now;
            for index in &fields[word] {
                let field = encoding.fields[*index];
                if differs & field.mask() == 0 {
                    continue;
                }
                match field.location {
                    NOWHERE => rest = true,
                    location => store.overwrite(location, codecs[*index].value(field.code(state), view)),
                }
            }
        }
        if rest {
            encoding.unpack_rest(&self.program, state, machine, view);
            *touched = machine.store().touched();
        }
        machine.forget_inputs();
    }

    /// Makes the step with the alternatives that are due; where it leads is packed.
    fn step(&mut self, state: &[u64]) -> Step {
        self.load(state);
        if !self.machine.prepare_compiled(&mut self.branches) {
            return Step::Unknown;
        }
        self.failed.clear();
        for StepCondition { numbers, formula, assumed } in &self.step_conditions {
            let truth = match self.machine.evaluate(formula, &mut self.branches) {
                Ok(Value::Boolean(truth)) if truth || !assumed => Some(truth),
                Ok(_) if *assumed => return Step::Excluded,
                Err(fault) if *assumed || !fault.kind.is_of_the_model() => return Step::Unknown,
                Ok(_) | Err(_) => None,
            };
            note_failures(truth, *numbers, &mut self.failed);
        }
        let Compiled { program, machine, encoding, view, codecs, next, touched, .. } = self;
        // Compiled code stamps no location that it knows to be updated once, so the updates are not found by their stamps.
        let mut others: Vec<(u32, &Value)> = Vec::new();
        next.clear();
        next.extend_from_slice(state);
        for (location, value) in machine.updates() {
            match encoding.of_location.get(location as usize) {
                Some(&NOWHERE) => {}
                Some(&REST) | None => others.push((location, value)),
                Some(index) => {
                    let Some(code) = codecs[*index as usize].code(value, view) else { return Step::Unknown };
                    encoding.fields[*index as usize].put(code, next);
                }
            }
        }
        let changes = !others.is_empty() || machine.creates();
        if changes || machine.store().touched() != *touched {
            others.sort_unstable_by_key(|(location, _)| *location);
            let update_of = |location: u32| {
                let found = others.binary_search_by_key(&location, |(location, _)| *location);
                found.ok().map(|index| others[index].1)
            };
            let mut rest = encoding.gather_with(program, machine, true, &update_of);
            encoding.settle(machine, &mut rest);
            if encoding.put_rest(rest, next, view).is_err() {
                return Step::Unknown;
            }
            // What was touched is what it would be anyway when it is next read.
            let same = encoding.rest.is_none_or(|rest| {
                let field = encoding.fields[rest as usize];
                field.code(next) == field.code(state)
            });
            if !changes && same {
                *touched = machine.store().touched();
            }
        }
        Step::Next
    }
}

impl StepMaker for Compiled {
    fn make(
        &mut self,
        state: &[u64],
        interrupt: &Interrupt,
        expansion: &mut Expansion,
        found: &mut Successors<'_>,
    ) -> Result<(), Unmade> {
        // The machine makes the first steps of runs, which keep inputs.
        if self.asks_all.iter().any(|field| state[field.word as usize] & field.clear != field.set) {
            return Err(Unmade::Unknown);
        }
        self.branches.first();
        loop {
            if interrupt.is_raised() {
                return Err(Unmade::Interrupted);
            }
            let step = self.step(state);
            if self.branches.dead || self.branches.unbounded.is_some() {
                return Err(Unmade::Unknown);
            }
            match step {
                Step::Next => expansion.arrive(state, &self.next, found),
                Step::Excluded => expansion.excluded += 1,
                Step::Unknown => return Err(Unmade::Unknown),
            }
            if !self.failed.is_empty() && matches!(step, Step::Next) {
                expansion.fail(&self.failed);
            }
            if !self.branches.next() {
                return Ok(());
            }
        }
    }
}

/// What is otherwise in some initial state than in the first. Nothing is known of what is in the rest.
fn elsewhere(machine: &Machine, encoding: &Encoding, starts: &Starts, view: &mut View) -> Elsewhere {
    let functions = machine.program().functions.len();
    let (mut varies, mut undefined) = (vec![false; functions], vec![false; functions]);
    let Some(first) = starts.first().filter(|_| starts.len() > 1) else { return Elsewhere::default() };
    for field in encoding.fields.iter().filter(|field| field.location != NOWHERE) {
        let index = field.function.0 as usize;
        varies[index] |= starts.iter().any(|(state, _)| field.code(state) != field.code(first));
        undefined[index] |= starts.iter().any(|(state, _)| encoding.value(*field, state, view).is_undef());
    }
    for location in (0..).zip(&*encoding.of_location).filter(|(_, field)| **field == REST).map(|(location, _)| location)
    {
        let index = machine.store().function_of(location).0 as usize;
        (varies[index], undefined[index]) = (true, true);
    }
    Elsewhere::new(varies, undefined)
}

/// The values that inputs are given, and those of their domains where these are few and always the same.
fn all_bounds(program: &Program, encoding: &Encoding, machine: &mut Machine, settings: &Settings) -> machine::Bounds {
    let mut bounds = (*settings.bounds).clone();
    for (function, declared) in (0..).map(program::FunctionId).zip(&program.functions) {
        if declared.kind == FunctionKind::Monitored
            && !bounds.contains_key(&function)
            && let Some(values) = finite(program, &encoding.constant, machine, declared.codomain)
        {
            bounds.insert(function, values);
        }
    }
    bounds
}
