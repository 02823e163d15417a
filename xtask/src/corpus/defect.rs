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
            again.step > difference.step || again.step == difference.step && is_later(trace, &again.what, difference)
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

/// The two are of different locations, which are compared in the order of the listing: what the one was about, and all
/// before it, is as recorded in the other.
fn is_later(trace: &Trace, again: &What, difference: &Difference) -> bool {
    let (What::Value { location, .. }, What::Value { location: before, .. }) = (again, &difference.what) else {
        return false;
    };
    let step = difference.step.checked_sub(1).and_then(|index| trace.steps.get(index));
    let listing = step.and_then(|step| step.after.as_ref()).unwrap_or(&trace.initial);
    let place = |name: &str| listing.iter().position(|(location, _)| location == name);
    place(location) > place(before)
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::corpus::trace;

    struct NoFiles;

    impl model::Loader for NoFiles {
        fn load(&mut self, _: &syntax::SourceFile, path: &str) -> Result<syntax::SourceFile, String> {
            Err(format!("there is no {path}"))
        }
    }

    /// The reason why a model with these declarations and this main rule parts from a recorded first step.
    fn reason_of(declarations: &str, rule: &str, record: &str) -> Option<&'static str> {
        let text =
            format!("asm a import StandardLibrary signature: {declarations} definitions: main rule r_Main = {rule}");
        let loaded = groundstate::load(syntax::SourceFile::new("a.asm", text), &mut NoFiles).expect("a model");
        let (program, sources) = (Arc::new(loaded.program), loaded.sources);
        let trace = trace::read(&format!("# a.asm\nSTATE 0\nSTEP 1\n{record}\nEND OK\n")).expect("a trace");
        let difference = replay(&program, &sources, &trace, None).difference.expect("they part");
        found(&program, &sources, &trace, &difference)
    }

    #[test]
    fn a_range_without_its_upper_bound_is_known_by_what_it_gives() {
        let declarations = "controlled s: Powerset(Natural) controlled t: Powerset(Natural)";
        let rule = "par s := range(1n, 3n) t := {1n} endpar";
        assert_eq!(reason_of(declarations, rule, "STATE 1\ns={1,2}\nt={1}"), Some(reason::RANGE));
        assert_eq!(reason_of(declarations, rule, "STATE 1\ns={1,2,3}\nt={2}"), None);
    }

    #[test]
    fn a_symmetric_difference_is_known_by_what_it_gives() {
        let (declarations, rule) = ("controlled s: Powerset(Integer)", "s := difference({1, 2}, {2, 3})");
        assert_eq!(reason_of(declarations, rule, "STATE 1\ns={1,3}"), Some(reason::DIFFERENCE));
        assert_eq!(reason_of(declarations, rule, "STATE 1\ns={3}"), None);
    }

    #[test]
    fn an_input_asked_twice_is_known_by_its_other_value() {
        let (declarations, rule) = ("monitored m: Integer controlled x: Integer", "x := m");
        assert_eq!(reason_of(declarations, rule, "MON m=1\nMON m=2\nSTATE 1\nx=2"), Some(reason::ASKED_TWICE));
        assert_eq!(reason_of(declarations, rule, "MON m=1\nMON m=2\nSTATE 1\nx=3"), None);
    }
}
