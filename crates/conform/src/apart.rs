//! On what the events of a program's steps depend: whether what machines decide can be replayed apart from them, and which rules only count.
//!
//! In: the program of the tasks' steps, in which nothing is decided, and the procedures that decide. Out: a function through which one of
//! the two depends on the other, beside what a recording says of the channels. Then no replay of the two by themselves is one of the
//! model. And the program without the rules on which no event depends, such as those that count ages. It looks at what rules may read and
//! write, whatever the state.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use program::{Expression, FunctionId, ProcedureId, Program, Rule, RuleId, Runs, Term, TermId};

/// What the numbers and the newness of data are read from, at the end of an elaboration: a recording gives them.
const GIVEN: &[&str] = &[
    "sb_written",
    "sb_receivedSequence",
    "sb_fresh",
    "mq_sent",
    "mq_taken",
    "sv_sequence",
    "sv_receivedSequence",
    "sv_fresh",
];

/// What a procedure reads, writes and calls, by itself.
#[derive(Debug, Default)]
struct Does {
    reads: BTreeSet<FunctionId>,
    writes: BTreeSet<FunctionId>,
    calls: Vec<ProcedureId>,
    /// Of these, the ones whose results it uses.
    asks: Vec<ProcedureId>,
    /// It does something until nothing changes.
    repeats: bool,
}

/// Why decisions cannot be replayed apart from the tasks' steps, in words. The events are those of the functions that are `told`.
pub(crate) fn entangled(
    steps: &Program,
    told: impl Iterator<Item = FunctionId>,
    decisions: &Program,
    ends: impl Iterator<Item = ProcedureId>,
) -> Option<String> {
    let all = reached(steps, steps.main.into_iter());
    let ends = reached(decisions, ends);
    let name = |function: &FunctionId| steps.function(*function).name.as_str();
    let (matters, _) = led_by(&all, told.collect());
    let mut decided = ends.values().flat_map(|does| &does.writes);
    if let Some(shared) = decided.find(|function| matters.contains(function)) {
        return Some(format!("what tasks do depends on {}, which the end of an elaboration changes", name(shared)));
    }
    let written: BTreeSet<FunctionId> = all.values().flat_map(|does| &does.writes).copied().collect();
    let is_shared = |function: &&FunctionId| written.contains(function) && !GIVEN.contains(&name(function));
    let mut read = ends.values().flat_map(|does| &does.reads);
    let shared = read.find(is_shared)?;
    Some(format!("what is computed at the end of an elaboration depends on {}, which the tasks change", name(shared)))
}

/// Lets the rules do nothing on which none of the functions that are `told` depends.
pub(crate) fn without_counts(program: &mut Program, from: ProcedureId, told: impl Iterator<Item = FunctionId>) {
    let all = reached(program, std::iter::once(from));
    // What repeats a rule until nothing changes would end earlier.
    if all.values().any(|does| does.repeats) {
        return;
    }
    let (_, leading) = led_by(&all, told.collect());
    let span = program.procedure(from).span;
    program.rules.push(Rule::Skip);
    program.rule_spans.push(span);
    let nothing = RuleId(program.rules.len() as u32 - 1);
    for id in all.keys().filter(|id| !leading.contains(id)) {
        program.procedures[id.0 as usize].body = nothing;
    }
}

/// The functions on which these depend, and the procedures that may lead to a change of one of them: what such a procedure reads matters.
fn led_by(
    all: &BTreeMap<ProcedureId, Does>,
    mut functions: BTreeSet<FunctionId>,
) -> (BTreeSet<FunctionId>, BTreeSet<ProcedureId>) {
    let mut procedures: BTreeSet<ProcedureId> = BTreeSet::new();
    let mut asked: BTreeSet<ProcedureId> = BTreeSet::new();
    loop {
        let leads = |id: &ProcedureId, does: &Does| {
            asked.contains(id)
                || does.writes.iter().any(|function| functions.contains(function))
                || does.calls.iter().any(|called| procedures.contains(called))
        };
        let is_new = |(id, does): &(&ProcedureId, &Does)| !procedures.contains(*id) && leads(id, does);
        let Some((id, does)) = all.iter().find(is_new) else { return (functions, procedures) };
        procedures.insert(*id);
        asked.extend(&does.asks);
        functions.extend(&does.reads);
    }
}

/// What is done in these procedures and in all that they may run.
fn reached(program: &Program, from: impl Iterator<Item = ProcedureId>) -> BTreeMap<ProcedureId, Does> {
    let mut all = BTreeMap::new();
    let mut open: VecDeque<ProcedureId> = from.collect();
    while let Some(procedure) = open.pop_front() {
        all.entry(procedure).or_insert_with(|| {
            let does = Does::of(program, procedure);
            open.extend(&does.calls);
            does
        });
    }
    all
}

impl Does {
    fn of(program: &Program, procedure: ProcedureId) -> Does {
        let mut does = Does::default();
        let mut rules: Vec<RuleId> = vec![program.procedure(procedure).body];
        let mut terms = Vec::new();
        while let Some(rule) = rules.pop() {
            match program.rule(rule) {
                Rule::Update { function, .. } | Rule::Return { function, .. } => _ = does.writes.insert(*function),
                Rule::Local { start, len, .. } => {
                    does.writes.extend(&program.function_lists[*start as usize..(*start + *len) as usize]);
                }
                Rule::Iterate(_) | Rule::While { .. } | Rule::RecursiveWhile { .. } => does.repeats = true,
                _ => {}
            }
            if let Rule::Return { procedure, .. } = program.rule(rule) {
                does.asks.push(*procedure);
            }
            match program.rule(rule).runs() {
                Runs::Nothing => {}
                Runs::Procedure(called) => does.calls.push(called),
                // Any rule that is a value somewhere.
                Runs::Value { .. } => does.calls.extend(program.terms.iter().filter_map(|term| match term {
                    Term::Rule(called) => Some(*called),
                    _ => None,
                })),
                Runs::Agent => does.calls.extend(program.agents.iter().map(|agent| agent.procedure)),
            }
            program.each_child_of_rule(rule, &mut |child| rules.push(child));
            program.each_term_of_rule(rule, &mut |term| terms.push(term));
        }
        read(program, terms, &mut does.reads);
        does
    }
}

/// The functions that these terms read, through definitions too.
fn read(program: &Program, mut terms: Vec<TermId>, found: &mut BTreeSet<FunctionId>) {
    while let Some(term) = terms.pop() {
        if let Term::Read { function, .. } | Term::Define { function, .. } = program.term(term)
            && found.insert(*function)
        {
            let body = |definition: &Expression| definition.body;
            terms.extend(program.function(*function).definition.as_ref().map(body));
        }
        program.each_child_of_term(term, &mut |child| terms.push(child));
    }
}
