//! Property-directed reachability (IC3), by a solver's engine for Horn clauses.
//!
//! A. Bradley, *SAT-based model checking without unrolling*, 2011; N. Bjørner, A. Gurfinkel, K. McMillan, A.
//! Rybalchenko, *Horn clause solvers for program verification*, 2015. A predicate holds for every reachable state. The
//! solver finds such a predicate that excludes the target, or says that there is none.

use std::fmt::Write;

use rustc_hash::FxHashMap;
use solve::session::{Session, Silence, Verdict, verdict};
use solve::shared::{Node, Script, Terms, VariableId};

use crate::solver::relation::Relation;
use crate::solver::unrolling::Patience;

/// Whether a state or a step that satisfies a condition is reachable.
pub(crate) fn reachable(
    relation: &mut Relation,
    wanted: Node,
    session: &mut dyn Session,
    patience: &mut Patience<'_>,
) -> Result<bool, Silence> {
    let text = clauses(relation, wanted);
    let depth = patience.depth;
    let go_on = &mut *patience.go_on;
    let answer = session.ask(&text, patience.seconds, &mut || go_on(depth))?;
    match verdict(&answer)? {
        Verdict::Possible => Ok(false),
        Verdict::Impossible => Ok(true),
        Verdict::Unknown => Err(Silence::Late),
    }
}

fn clauses(relation: &mut Relation, wanted: Node) -> String {
    let cone = relation.cone();
    let state: Vec<VariableId> = cone.iter().map(|index| relation.state[*index]).collect();
    let mut text = "(set-logic HORN)\n".to_string();
    let sorts: Vec<&str> = state.iter().map(|id| Script::sort(relation.terms.variable_of(*id).kind)).collect();
    let _ = writeln!(text, "(declare-fun reached ({}) Bool)", sorts.join(" "));
    let typed = bounded(relation, &state);
    let inputs = relation.input_variables();
    let of_inputs = bounded(relation, &inputs);
    let mut later = Vec::new();
    for id in &state {
        let declared = relation.terms.variable_of(*id).clone();
        later.push(relation.terms.variable(format!("{}'", declared.name), declared.kind, declared.bounds));
    }
    let by: FxHashMap<VariableId, Node> = state.iter().copied().zip(later.iter().copied()).collect();
    let mut made = FxHashMap::default();
    let admitted = relation.terms.replace(relation.admitted, &|id| by.get(&id).copied(), &mut made);
    let later_ids = relation.terms.variables_of(later.iter().copied());
    let now = [typed, of_inputs, relation.typed, relation.admitted, relation.given];
    let mut leads = vec![relation.goes, admitted];
    for (index, later) in cone.iter().zip(&later) {
        leads.push(relation.terms.equal(*later, relation.next[*index]));
    }
    let step = relation.terms.and(now.iter().chain(&leads).copied());
    let found = relation.terms.and(now.iter().copied().chain([wanted]));
    let here: Vec<VariableId> = state.iter().chain(&inputs).copied().collect();
    let all: Vec<VariableId> = here.iter().chain(&later_ids).copied().collect();
    let start: Vec<VariableId> = relation.start.into_iter().collect();
    let at_start = bounded(relation, &start);
    if relation.first == Terms::TRUE {
        // Initial states are reachable.
        let mut begin = vec![admitted, at_start];
        for (index, later) in cone.iter().zip(&later) {
            begin.push(relation.terms.equal(*later, relation.initial[*index]));
        }
        let begin = relation.terms.and(begin);
        let bound: Vec<VariableId> = later_ids.iter().chain(&start).copied().collect();
        clause(relation, &bound, None, begin, Some(&later), &mut text);
    } else {
        // The first step has its own inputs: its successors are reachable, and it must not satisfy the condition.
        let mut begin = vec![at_start, relation.first];
        for (index, id) in cone.iter().zip(&state) {
            let now = relation.terms.known(*id);
            begin.push(relation.terms.equal(now, relation.initial[*index]));
        }
        let begin = relation.terms.and(begin);
        let leads = relation.terms.and([begin, step]);
        let bound: Vec<VariableId> = all.iter().chain(&start).copied().collect();
        clause(relation, &bound, None, leads, Some(&later), &mut text);
        let found = relation.terms.and([begin, found]);
        let bound: Vec<VariableId> = here.iter().chain(&start).copied().collect();
        clause(relation, &bound, None, found, None, &mut text);
    }
    // Successors are reachable.
    clause(relation, &all, Some(&state), step, Some(&later), &mut text);
    // The condition is not reachable.
    clause(relation, &here, Some(&state), found, None, &mut text);
    text.push_str("(check-sat)\n");
    text
}

/// The bounds of variables, as a condition.
fn bounded(relation: &mut Relation, variables: &[VariableId]) -> Node {
    let mut all = Vec::new();
    for id in variables {
        let bounds = relation.terms.variable_of(*id).bounds;
        all.push(relation.terms.bound(*id, bounds));
    }
    relation.terms.and(all)
}

fn clause(
    relation: &Relation,
    bound: &[VariableId],
    from: Option<&[VariableId]>,
    condition: Node,
    to: Option<&[Node]>,
    text: &mut String,
) {
    let terms = &relation.terms;
    let bindings: Vec<String> = bound.iter().map(|id| Script::binding(terms, *id)).collect();
    let applied = |names: Vec<String>| match names.is_empty() {
        true => "reached".to_string(),
        false => format!("(reached {})", names.join(" ")),
    };
    let from = from
        .map_or("true".to_string(), |state| applied(state.iter().map(|id| Script::bound_name(terms, *id)).collect()));
    let to = to
        .map_or("false".to_string(), |later| applied(later.iter().map(|node| Script::closed(terms, *node)).collect()));
    let body = format!("(=> (and {from} {})\n{to})", Script::closed(terms, condition));
    let _ = match bindings.is_empty() {
        true => writeln!(text, "(assert {body})"),
        false => writeln!(text, "(assert (forall ({})\n{body}))", bindings.join(" ")),
    };
}
