//! Whether a defect of the peer brings about a difference: the run is made again with the defect, and the difference goes.
//!
//! In: a program, a trace and the difference at which the two part. Out: the name of a [`super::reason`], or none. A
//! defect is put into a copy of the program, or into what the environment answers.

use std::collections::BTreeMap;
use std::sync::Arc;

use program::{Builtin, Program, Rule, RuleId, Term, TermId, TermList};
use syntax::Sources;

use super::difference::{Difference, What};
use super::reason;
use super::replay::replay;
use super::text;
use super::trace::{Step, Trace};

/// The defect that brings about a difference.
pub fn found(
    program: &Arc<Program>,
    sources: &Sources,
    trace: &Trace,
    difference: &Difference,
) -> Option<&'static str> {
    let goes = |program: &Arc<Program>, last: Option<usize>| {
        let again = replay(program, sources, trace, last).difference;
        again.is_none_or(|again| {
            again.step > difference.step || again.step == difference.step && is_other(&again.what, &difference.what)
        })
    };
    if asked_twice(trace, difference.step) && goes(program, Some(difference.step)) {
        return Some(reason::ASKED_TWICE);
    }
    for (defect, name) in [(range as Defect, reason::RANGE), (set_difference, reason::DIFFERENCE)] {
        if let Some(defective) = defect(program)
            && goes(&Arc::new(defective), None)
        {
            return Some(name);
        }
    }
    is_of_self(program, &difference.what).then_some(reason::SELF_KEPT)
}

/// A copy of the program with the defect, if it is of any consequence there.
type Defect = fn(&Program) -> Option<Program>;

/// The two are of different locations: what the one was about is as recorded in the other.
fn is_other(again: &What, difference: &What) -> bool {
    match (again, difference) {
        (What::Value { location, .. }, What::Value { location: before, .. }) => location != before,
        _ => false,
    }
}

/// The environment gave one location two values in the step.
fn asked_twice(trace: &Trace, step: usize) -> bool {
    let twice = |step: &Step| {
        let mut first: BTreeMap<&str, &str> = BTreeMap::new();
        step.inputs.iter().any(|(location, value)| *first.entry(location).or_insert(value) != value.as_str())
    };
    step.checked_sub(1).and_then(|index| trace.steps.get(index)).is_some_and(twice)
}

/// `range(a, b)` without `b`.
fn range(program: &Program) -> Option<Program> {
    let mut defective = program.clone();
    for index in 0..program.terms.len() {
        let Term::Builtin { builtin: Builtin::NaturalRange, arguments } = program.terms[index] else { continue };
        let whole = TermId(defective.terms.len() as u32);
        defective.terms.push(program.terms[index].clone());
        defective.term_domains.push(program.term_domains[index]);
        defective.term_spans.push(program.term_spans[index]);
        let list = TermList { start: defective.term_lists.len() as u32, len: 2 };
        defective.term_lists.extend([whole, program.term_list(arguments)[1]]);
        defective.terms[index] = Term::Builtin { builtin: Builtin::SetExcluding, arguments: list };
    }
    (defective.terms.len() > program.terms.len()).then_some(defective)
}

/// `difference(a, b)` as the symmetric difference.
fn set_difference(program: &Program) -> Option<Program> {
    let mut defective = program.clone();
    let mut any = false;
    for term in &mut defective.terms {
        if let Term::Builtin { builtin, .. } = term
            && *builtin == Builtin::SetDifference
        {
            *builtin = Builtin::SymmetricDifference;
            any = true;
        }
    }
    any.then_some(defective)
}

/// The location is written by an update that reads `self` beside a rule that runs an agent's program.
fn is_of_self(program: &Program, what: &What) -> bool {
    let (What::Value { location, .. } | What::Written { location, .. }) = what else { return false };
    let Some(function) = text::location_of(program, location).map(|location| location.function) else { return false };
    program.procedures.iter().any(|procedure| {
        let (mut runs, mut writes) = (false, false);
        let mut open: Vec<RuleId> = vec![procedure.body];
        while let Some(id) = open.pop() {
            match program.rule(id) {
                Rule::RunAgent { .. } => runs = true,
                Rule::Update { function: updated, .. } if *updated == function => {
                    let mut terms = Vec::new();
                    program.each_term_of_rule(id, &mut |term| terms.push(term));
                    writes |= terms.into_iter().any(|term| reads_self(program, term));
                }
                _ => {}
            }
            program.each_child_of_rule(id, &mut |child| open.push(child));
        }
        runs && writes
    })
}

fn reads_self(program: &Program, root: TermId) -> bool {
    let mut open = vec![root];
    while let Some(id) = open.pop() {
        if matches!(program.term(id), Term::Read { function, .. } if Some(*function) == program.self_function) {
            return true;
        }
        program.each_child_of_term(id, &mut |child| open.push(child));
    }
    false
}
