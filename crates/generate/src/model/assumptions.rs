//! Assumptions under which code is small, such as: this function is never undef.
//!
//! In: a program and its plan. Out: the [`Assumptions`] that might hold, with which code is first generated. Code that refutes some
//! is generated again without these. INVARIANT: each round assumes less, so the rounds end.

use std::collections::BTreeSet;

use program::{FunctionKind, ProcedureId, Program, Runs};

use crate::model::interval::Interval;
use crate::model::nesting::runnable;
use crate::model::plan::{FunctionPlan, Plan, Role};

/// Assumptions about a program, by index into its tables.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Assumptions {
    /// A function's locations are never undef.
    pub total: Vec<bool>,
    /// By argument: no location of the function is accessed while that argument is undef.
    pub inside: Vec<Vec<bool>>,
    /// Initial values of locations with undef arguments can be computed at the start: they neither fault nor ask the
    /// environment.
    pub eager: Vec<bool>,
    /// No location of the function is accessed with an integer outside of its array.
    pub covered: Vec<bool>,
    /// `self` is defined wherever it is read.
    pub acting: bool,
    /// No list contains undef.
    pub solid: bool,
    /// A definition's value is never undef.
    pub result: Vec<bool>,
    /// Evaluating a definition neither faults nor asks the environment.
    pub pure: Vec<bool>,
    /// A definition's arguments are never undef.
    pub arguments: Vec<Vec<bool>>,
    /// A procedure's arguments are never undef.
    pub parameters: Vec<Vec<bool>>,
    /// An interval around the integers among a function's values.
    pub values: Vec<Interval>,
    /// Intervals around the integers among a definition's arguments.
    pub argument_ranges: Vec<Vec<Interval>>,
    /// Intervals around the integers among a procedure's arguments.
    pub parameter_ranges: Vec<Vec<Interval>>,
}

impl Assumptions {
    /// All assumptions that might hold.
    pub fn all(program: &Program, plan: &Plan) -> Assumptions {
        let functions = program.functions.len();
        // Only functions that no one but the model's rules writes can be assumed to be never undef.
        let written = |index: usize, function: &FunctionPlan| {
            function.role == Role::State
                && function.initial.is_some()
                && matches!(program.functions[index].kind, FunctionKind::Controlled | FunctionKind::Out)
        };
        Assumptions {
            total: plan.functions.iter().enumerate().map(|(index, function)| written(index, function)).collect(),
            inside: program.functions.iter().map(|f| vec![true; f.parameters.len()]).collect(),
            eager: vec![true; functions],
            covered: vec![true; functions],
            acting: acting(program),
            solid: true,
            result: vec![true; functions],
            pure: vec![true; functions],
            arguments: program.functions.iter().map(|f| vec![true; f.parameters.len()]).collect(),
            parameters: program.procedures.iter().map(|p| vec![true; p.parameters.len()]).collect(),
            values: vec![Interval::EMPTY; functions],
            argument_ranges: program.functions.iter().map(|f| vec![Interval::EMPTY; f.parameters.len()]).collect(),
            parameter_ranges: program.procedures.iter().map(|p| vec![Interval::EMPTY; p.parameters.len()]).collect(),
        }
    }

    /// These assumptions, with each interval that grew since `before` widened, so that growth soon ends.
    pub fn widened(mut self, before: &Assumptions) -> Assumptions {
        let lists = std::iter::once(&mut self.values)
            .chain(&mut self.argument_ranges)
            .chain(&mut self.parameter_ranges)
            .zip(std::iter::once(&before.values).chain(&before.argument_ranges).chain(&before.parameter_ranges));
        for (now, before) in lists {
            for (now, before) in now.iter_mut().zip(before) {
                *now = now.widened(*before);
            }
        }
        self
    }
}

/// Whether `self` is read only in agents' programs, so that it is always defined.
fn acting(program: &Program) -> bool {
    let Some(own) = program.self_function else { return false };
    let mut procedures: Vec<ProcedureId> = program.main.into_iter().collect();
    let mut terms: Vec<_> = program.initials.iter().map(|initial| initial.value.body).collect();
    let mut entered: BTreeSet<ProcedureId> = procedures.iter().copied().collect();
    while let Some(procedure) = procedures.pop() {
        let mut rules = vec![program.procedure(procedure).body];
        while let Some(rule) = rules.pop() {
            let called: Vec<ProcedureId> = match program.rule(rule).runs() {
                Runs::Procedure(procedure) => vec![procedure],
                Runs::Value { .. } => runnable(program).collect(),
                // The agent runs its program, so there is a `self`.
                Runs::Agent | Runs::Nothing => Vec::new(),
            };
            procedures.extend(called.into_iter().filter(|called| entered.insert(*called)));
            program.each_term_of_rule(rule, &mut |term| terms.push(term));
            program.each_child_of_rule(rule, &mut |child| rules.push(child));
        }
    }
    let mut defined = BTreeSet::new();
    while let Some(term) = terms.pop() {
        match program.term(term) {
            program::Term::Read { function, .. } if *function == own => return false,
            program::Term::Define { function, .. } if defined.insert(*function) => {
                terms.extend(program.function(*function).definition.as_ref().map(|definition| definition.body));
            }
            _ => {}
        }
        program.each_child_of_term(term, &mut |child| terms.push(child));
    }
    program.initials.iter().all(|initial| initial.function != own)
}
