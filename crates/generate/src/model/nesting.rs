//! Bounds how deeply units are nested in a step.
//!
//! In: a program. Out: a bound on the levels of `seq`, loops, turbo calls and scopes around any update, including
//! calls; `None` if a rule may call itself. The log of the running step contains at most one update of a location per
//! level.

use std::collections::BTreeSet;

use program::{ProcedureId, Program, Rule, RuleId, Term};

/// The procedures that are values or programs of agents.
pub(crate) fn runnable(program: &Program) -> impl Iterator<Item = ProcedureId> {
    let values = program.terms.iter().filter_map(|term| match term {
        Term::Rule(procedure) => Some(*procedure),
        _ => None,
    });
    let agents = program.agents.iter().map(|agent| agent.procedure);
    let all: BTreeSet<ProcedureId> = values.chain(agents).collect();
    all.into_iter()
}

/// The levels around any update of the main rule.
pub(crate) fn levels(program: &Program) -> Option<u64> {
    let mut known = vec![Known::Unseen; program.procedures.len()];
    let run: Vec<ProcedureId> = runnable(program).collect();
    program.main.map_or(Some(0), |main| procedure(program, &run, &mut known, main))
}

#[derive(Clone, Copy)]
enum Known {
    Unseen,
    /// Being computed; meeting it again means recursion.
    Open,
    Levels(u64),
}

fn procedure(program: &Program, run: &[ProcedureId], known: &mut [Known], id: ProcedureId) -> Option<u64> {
    let index = id.0 as usize;
    match known[index] {
        Known::Unseen => {}
        Known::Open => return None,
        Known::Levels(levels) => return Some(levels),
    }
    known[index] = Known::Open;
    let levels = rule(program, run, known, program.procedure(id).body)?;
    known[index] = Known::Levels(levels);
    Some(levels)
}

fn rule(program: &Program, run: &[ProcedureId], known: &mut [Known], id: RuleId) -> Option<u64> {
    let mut inside = Some(0u64);
    let mut meet = |levels: Option<u64>| inside = inside.zip(levels).map(|(a, b)| a.max(b));
    // A scope of local functions is also a sequence; the result of a turbo rule has a level of its own.
    let own = match program.rule(id) {
        Rule::Call { procedure: called, .. } => {
            meet(procedure(program, run, known, *called));
            0
        }
        Rule::TurboCall { procedure: called, .. } | Rule::Return { procedure: called, .. } => {
            meet(procedure(program, run, known, *called));
            2
        }
        Rule::RunValue { .. } | Rule::RunAgent { .. } => {
            run.iter().for_each(|called| meet(procedure(program, run, known, *called)));
            2
        }
        Rule::Seq(_) | Rule::Iterate(_) | Rule::While { .. } | Rule::RecursiveWhile { .. } => 1,
        Rule::Local { .. } => 2,
        Rule::Skip
        | Rule::Update { .. }
        | Rule::Par(_)
        | Rule::If { .. }
        | Rule::Switch { .. }
        | Rule::Let { .. }
        | Rule::Choose { .. }
        | Rule::Forall { .. }
        | Rule::Extend { .. } => 0,
    };
    let mut children = Vec::new();
    program.each_child_of_rule(id, &mut |child| children.push(child));
    for child in children {
        let levels = rule(program, run, known, child);
        inside = inside.zip(levels).map(|(a, b)| a.max(b));
    }
    inside.map(|levels| levels + own)
}
