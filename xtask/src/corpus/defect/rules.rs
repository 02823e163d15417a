//! Defects of the peer's rules, put into a copy of a program: `result` and `self` that stay, elements that are not yet
//! in the domain which they extend, ranges that do not see an earlier variable.
//!
//! In: a program and the difference that is looked into. Out: the copy, if the defect is of any consequence there.
//! What the peer stops at is a variable out of scope in the copy, a fault that no model that is run has of its own.

use model::{FunctionKind, Literal};
use program::{Binder, BinderList, Builtin, DomainKind, Program, Rule, RuleId, Slot, Term, TermId, TermList};

use super::super::difference::{Difference, What};
use super::super::trace::Trace;
use super::graft::{Graft, rules};

const NONE: TermList = TermList { start: 0, len: 0 };

/// `f <- r()` as `result := undef`, the call, then `f := result`: the location `result` stays in the update set, and a
/// rule that sets none is a fault.
pub fn result_stays(program: &Program, _: &Trace, _: &Difference) -> Vec<Program> {
    let Some(result) = program.result_function else { return Vec::new() };
    let mut graft = Graft::of(program);
    for (place, rule) in rules(program) {
        let Rule::Return { function, target, procedure, arguments } = rule else { continue };
        let Some(like) = program.terms.len().checked_sub(1).map(|last| TermId(last as u32)) else { continue };
        let nothing = graft.constant(Literal::Undef, like);
        let cleared = graft.rule(Rule::Update { function: result, arguments: NONE, value: nothing }, place);
        let call = graft.rule(Rule::TurboCall { procedure, arguments }, place);
        let read = graft.term(Term::Read { function: result, arguments: NONE }, like);
        let defined = graft.builtin(Builtin::IsDef, &[read], like);
        let missing = graft.term(Term::Unbound, like);
        let branches = graft.terms(&[defined, read]);
        let value = graft.term(Term::If { branches, otherwise: Some(missing) }, like);
        let mut parts = vec![cleared, call];
        // A value for a monitored location is lost, but it is looked for.
        let into = if program.function(function).kind == FunctionKind::Monitored {
            Rule::Update { function: result, arguments: NONE, value }
        } else {
            Rule::Update { function, arguments: target, value }
        };
        parts.push(graft.rule(into, place));
        let parts = graft.rules(&parts);
        graft.replace_rule(place, Rule::Seq(parts));
    }
    graft.done()
}

/// An update takes no element for a value of a growing domain that is not in it before the step.
pub fn members_before(program: &Program, _: &Trace, difference: &Difference) -> Vec<Program> {
    let What::GoesOn { theirs } = &difference.what else { return Vec::new() };
    if theirs.class != "InvalidValueException" {
        return Vec::new();
    }
    let mut graft = Graft::of(program);
    for (place, rule) in rules(program) {
        let Rule::Update { function, arguments, value } = rule else { continue };
        let domain = program.function(function).codomain;
        if !matches!(program.domain(domain).kind, DomainKind::Concrete { dynamic: true, .. }) {
            continue;
        }
        let elements = graft.term(Term::Domain(domain), value);
        let inside = graft.builtin(Builtin::SetContains, &[elements, value], value);
        let undef = graft.builtin(Builtin::IsUndef, &[value], value);
        let admitted = graft.builtin(Builtin::Or, &[undef, inside], value);
        let outside = graft.term(Term::Unbound, value);
        let branches = graft.terms(&[admitted, value]);
        let value = graft.term(Term::If { branches, otherwise: Some(outside) }, value);
        graft.replace_rule(place, Rule::Update { function, arguments, value });
    }
    graft.done()
}

/// A range of a `choose` sees no variable that the same `choose` binds before it.
pub fn ranges_apart(program: &Program, _: &Trace, difference: &Difference) -> Vec<Program> {
    let What::GoesOn { theirs } = &difference.what else { return Vec::new() };
    if !theirs.message.contains("is unbound") {
        return Vec::new();
    }
    let mut graft = Graft::of(program);
    for (place, rule) in rules(program) {
        let Rule::Choose { binders, condition, body, if_none } = rule else { continue };
        let mut before: Vec<Slot> = Vec::new();
        let mut ranges = Vec::new();
        for Binder { slot, range } in program.binder_list(binders).iter().copied() {
            let sees = part(program, range, &|term| matches!(term, Term::Slot(slot) if before.contains(slot)));
            ranges.push(Binder { slot, range: if sees { graft.term(Term::Unbound, range) } else { range } });
            before.push(slot);
        }
        if ranges != program.binder_list(binders) {
            let list = BinderList { start: graft.program.binder_lists.len() as u32, len: binders.len };
            graft.program.binder_lists.extend(ranges);
            graft.replace_rule(place, Rule::Choose { binders: list, condition, body, if_none });
        }
    }
    graft.done()
}

/// Behind `program(a)`, the rules beside it have `a` for `self`. LIMIT: in those rules themselves, not in what they call.
pub fn self_stays(program: &Program, _: &Trace, _: &Difference) -> Vec<Program> {
    let Some(this) = program.self_function else { return Vec::new() };
    let mut graft = Graft::of(program);
    for (_, rule) in rules(program) {
        let Rule::Par(parts) = rule else { continue };
        let mut last = None;
        for part in program.rule_list(parts) {
            if let Rule::RunAgent { agent } = program.rule(*part) {
                last = Some(*agent);
                continue;
            }
            let Some(agent) = last else { continue };
            for term in terms_of(program, *part) {
                if matches!(program.term(term), Term::Read { function, .. } if *function == this) {
                    graft.replace(term, |graft, _| graft.program.term(agent).clone());
                }
            }
        }
    }
    graft.done()
}

/// All terms of a rule and the rules in it.
fn terms_of(program: &Program, root: RuleId) -> Vec<TermId> {
    let (mut open, mut found) = (vec![root], Vec::new());
    while let Some(rule) = open.pop() {
        program.each_term_of_rule(rule, &mut |term| found.push(term));
        program.each_child_of_rule(rule, &mut |child| open.push(child));
    }
    let mut at = 0;
    while at < found.len() {
        program.each_child_of_term(found[at], &mut |child| found.push(child));
        at += 1;
    }
    found
}

fn part(program: &Program, root: TermId, wanted: &dyn Fn(&Term) -> bool) -> bool {
    let mut open = vec![root];
    while let Some(term) = open.pop() {
        if wanted(program.term(term)) {
            return true;
        }
        program.each_child_of_term(term, &mut |child| open.push(child));
    }
    false
}
