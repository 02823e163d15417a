//! Which defects of the peer bring a difference about: the run is made again with the defect, and the difference goes.
//!
//! In: a program, a trace and the replay in which the two part. Out: [`Shown`]: the defects put in one after the other,
//! each of which brought the run further, and the run with all of them. A defect is put into a copy of the program
//! ([`terms`], [`rules`], [`locations`]). INVARIANT: what stands for a reason here has been run.

mod graft;
pub mod locations;
mod rules;
mod terms;

use std::collections::BTreeSet;
use std::sync::Arc;

use program::Program;
use syntax::Sources;

use super::difference::{Difference, What};
use super::reason;
use super::replay::{Replayed, replay};
use super::trace::Trace;

/// LIMIT: how many defects are put into one run; a sum that wraps around counts anew each time.
const ROUNDS: usize = 100;

/// What defects of the peer come to in a run.
#[derive(Debug)]
pub struct Shown {
    /// The defects put in.
    pub reasons: BTreeSet<&'static str>,
    /// The run with all of them.
    pub replayed: Replayed,
}

/// Copies of the program with the defect, as far as it is of any consequence for the difference.
type Defect = fn(&Program, &Trace, &Difference) -> Vec<Program>;

const DEFECTS: [(Defect, &str); 11] = [
    (locations::asked_again, reason::ASKED_TWICE),
    (terms::range, reason::RANGE),
    (terms::difference, reason::DIFFERENCE),
    (terms::wrap, reason::WRAP),
    (terms::negative_natural, reason::NEGATIVE_NATURAL),
    (terms::both_sides, reason::BOTH_SIDES),
    (rules::result_stays, reason::RESULT_STAYS),
    (rules::self_stays, reason::SELF_KEPT),
    (rules::members_before, reason::NEW_ELEMENT),
    (rules::ranges_apart, reason::DEPENDENT_RANGE),
    (locations::lazy_initial, reason::LAZY_INITIAL),
];

/// Puts defects in as long as one brings the run further.
pub fn shown(program: &Arc<Program>, sources: &Sources, trace: &Trace, replayed: Replayed) -> Shown {
    let mut program = Arc::clone(program);
    let mut shown = Shown { reasons: BTreeSet::new(), replayed };
    for _ in 0..ROUNDS {
        let now = &shown.replayed;
        if now.difference.is_none() && now.reasons.is_empty() {
            break;
        }
        // Where only mended values are left, what mended them is looked for.
        let nowhere = Difference { step: usize::MAX, what: What::Beyond { location: String::new() } };
        let difference = now.difference.as_ref().unwrap_or(&nowhere);
        let mut attempts = DEFECTS.iter().flat_map(|(defect, name)| {
            defect(&program, trace, difference).into_iter().map(move |copy| (Arc::new(copy), *name))
        });
        let found = attempts.find_map(|(copy, name)| {
            let again = replay(&copy, sources, trace);
            goes_further(trace, &again, now).then_some((again, copy, name))
        });
        let Some((again, copy, name)) = found else { break };
        shown.reasons.insert(name);
        (shown.replayed, program) = (again, copy);
    }
    shown
}

/// A run comes further than another, or as far with less to mend.
fn goes_further(trace: &Trace, again: &Replayed, before: &Replayed) -> bool {
    let fewer = again.reasons.len() < before.reasons.len() && again.reasons.is_subset(&before.reasons);
    match (&again.difference, &before.difference) {
        (None, Some(_)) => true,
        (None, None) => fewer,
        (Some(_), None) => false,
        (Some(again), Some(before)) => {
            again.step > before.step
                || again.step == before.step && (is_later(trace, &again.what, before) || again == before && fewer)
        }
    }
}

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

#[cfg(test)]
mod tests {
    use testkit::NoFiles;

    use super::*;
    use crate::corpus::trace;

    /// The reason why a model with these declarations and this main rule parts from a recorded first step.
    fn reason_of(declarations: &str, rule: &str, record: &str) -> Option<&'static str> {
        let agents = if declarations.contains("r_p") { "agent P: r_p[]" } else { "" };
        reason_with(declarations, rule, agents, record)
    }

    fn reason_with(declarations: &str, rule: &str, initial: &str, record: &str) -> Option<&'static str> {
        let definitions = if declarations.contains("definitions:") { "" } else { "definitions:" };
        let text = format!(
            "asm a import StandardLibrary signature: {declarations} {definitions} main rule r_Main = {rule} \
             default init s: {initial}"
        );
        let loaded = groundstate::load(syntax::SourceFile::new("a.asm", text), &mut NoFiles).expect("a model");
        let (program, sources) = (loaded.program, loaded.sources);
        let trace = trace::read(&format!("# a.asm\nSTATE 0\nSTEP 1\n{record}\n")).expect("a trace");
        let replayed = replay(&program, &sources, &trace);
        assert!(replayed.difference.is_some() || !replayed.reasons.is_empty(), "they part");
        let shown = shown(&program, &sources, &trace, replayed);
        shown.reasons.first().copied().filter(|_| shown.replayed.difference.is_none())
    }

    #[test]
    fn a_range_without_its_upper_bound_is_known_by_what_it_gives() {
        let declarations = "controlled s: Powerset(Natural) controlled t: Powerset(Natural)";
        let rule = "par s := range(1n, 3n) t := {1n} endpar";
        assert_eq!(reason_of(declarations, rule, "STATE 1\ns={1,2}\nt={1}\nEND OK"), Some(reason::RANGE));
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
        assert_eq!(reason_of(declarations, rule, "MON m=1\nMON m=2\nSTATE 1\nx=2\nEND OK"), Some(reason::ASKED_TWICE));
        assert_eq!(reason_of(declarations, rule, "MON m=1\nMON m=2\nSTATE 1\nx=3\nEND OK"), None);
    }

    #[test]
    fn an_input_asked_twice_may_be_read_both_ways() {
        let declarations = "monitored m: Integer controlled x: Integer controlled y: Integer";
        let record = "MON m=1\nMON m=2\nSTATE 1\nx=2\ny=1\nEND OK";
        assert_eq!(reason_of(declarations, "par x := m y := m endpar", record), Some(reason::ASKED_TWICE));
    }

    #[test]
    fn integers_that_wrap_around_are_known_by_what_is_left() {
        let (declarations, rule) = ("controlled x: Integer", "x := 3037000500 * 3037000500");
        assert_eq!(reason_of(declarations, rule, "STATE 1\nx=-9223372036709301616\nEND OK"), Some(reason::WRAP));
        assert_eq!(reason_of(declarations, rule, "STATE 1\nx=1\nEND OK"), None);
    }

    #[test]
    fn what_the_peer_stops_at_is_a_fault_with_the_defect() {
        let declarations = "controlled s: Powerset(Integer) controlled x: Boolean";
        let rule = "x := true or (forall $n in s with $n > 0)";
        let record = "END EXC ClassCastException UndefValue";
        assert_eq!(reason_of(declarations, rule, record), Some(reason::BOTH_SIDES));
        assert_eq!(reason_of(declarations, "x := true", record), None);

        let declarations =
            "dynamic abstract domain A dynamic domain B subsetof A controlled f: B -> B controlled g: A -> A";
        let record = "END EXC InvalidValueException value out of domain: cannot assign b!1 to f(b!1)";
        let found = |rule| reason_of(declarations, rule, record);
        assert_eq!(found("extend B with $b do f($b) := $b"), Some(reason::NEW_ELEMENT));
        assert_eq!(found("extend A with $a do g($a) := $a"), None);

        let record = "END EXC RuntimeException Variable $s is unbound";
        let found = |rule| reason_of("controlled x: Integer", rule, record);
        assert_eq!(found("choose $s in {{1}, {2}}, $n in $s do x := $n"), Some(reason::DEPENDENT_RANGE));
        assert_eq!(found("choose $s in {1, 2}, $n in {3} do x := $n"), None);
    }

    #[test]
    fn a_negative_natural_is_known_by_what_becomes_of_it() {
        let (declarations, rule) = ("controlled x: Integer", "x := 1 + ntoi(iton(0 - 3))");
        assert_eq!(reason_of(declarations, rule, "STATE 1\nx=-2\nEND OK"), Some(reason::NEGATIVE_NATURAL));
        assert_eq!(reason_of(declarations, rule, "STATE 1\nx=2\nEND OK"), None);
    }

    #[test]
    fn a_result_that_stays_is_known_by_its_value() {
        let declarations = "controlled x: Integer definitions: turbo rule r_t in Integer = result := 5";
        assert_eq!(reason_of(declarations, "x <- r_t()", "STATE 1\nresult=5\nx=5\nEND OK"), Some(reason::RESULT_STAYS));
        assert_eq!(reason_of(declarations, "x <- r_t()", "STATE 1\nresult=4\nx=5\nEND OK"), None);
    }

    #[test]
    fn a_self_that_stays_is_known_by_what_is_written() {
        let declarations = "domain P subsetof Agent static p: P controlled f: Agent -> Integer controlled y: Integer \
            definitions: rule r_p = y := 1";
        let found = |record| reason_of(declarations, "par program(p) f(self) := 2 endpar", record);
        assert_eq!(found("STATE 1\nf(p)=2\ny=1\nEND OK"), Some(reason::SELF_KEPT));
        assert_eq!(found("STATE 1\nf(p)=3\ny=1\nEND OK"), None);
    }

    #[test]
    fn a_lazy_initial_value_is_known_by_what_it_is_later() {
        let declarations = "controlled x: Integer controlled y: Integer controlled z: Integer";
        let rule = "par x := 7 if x = 7 then z := y endif endpar";
        let record = "STATE 1\nx=7\nSTEP 2\nSTATE 2\nx=7\nz=8\nEND OK";
        assert_eq!(
            reason_with(declarations, rule, "function x = 1 function y = x + 1", record),
            Some(reason::LAZY_INITIAL)
        );
        assert_eq!(reason_with(declarations, rule, "function x = 1 function y = 2", record), None);
    }
}
