//! `verify --vacuity`: parts without which the properties that hold would hold as well.
//!
//! In: a program, and what was found of its properties. Out: a second search, whose warnings are told; no verdict changes.

use std::io::Write;
use std::sync::Arc;

use groundstate::job::Cancel;
use groundstate::verify::temporal::fairness::AgentFairness;
use groundstate::verify::vacuity::{Idle, Question};
use groundstate::verify::{NoStart, Options, Outcome, Report, Request, Subject};
use program::{Program, PropertyKind};
use wire::Vacuity;

use super::tell::Teller;
use super::watch::Watch;
use super::{Arguments, aside, conflict};
use crate::check::plural;
use crate::failure::Failure;
use crate::interrupt;
use crate::shell::Shell;
use crate::solver::Process;

/// Searches for idle parts of the properties that hold, and tells them.
pub fn tell(
    shell: &mut Shell,
    arguments: &Arguments,
    teller: &Teller<'_>,
    report: &Report,
    (options, agents): (Options, Option<AgentFairness>),
) -> Result<(), Failure> {
    let program: &Program = teller.words.program;
    let held: Vec<usize> = report
        .verdicts
        .iter()
        .filter_map(|verdict| match (verdict.subject, &verdict.outcome) {
            (Subject::Property(index), Outcome::Holds) if is_formula(program.properties[index].kind) => Some(index),
            _ => None,
        })
        .collect();
    let question = Question::new(program, &held);
    let count = question.replaced.len();
    if count == 0 {
        return tell_count(shell, held.len(), 0, &Idle::default());
    }
    let request = Request::of(&Arc::new(question.program.clone()), options).fair(agents).build();
    let request = request.map_err(conflict::conflict)?;
    let mut watch = Watch::new(arguments.bounded.time, shell.global.quiet || shell.json());
    let cancel = Cancel::from(interrupt::request().clone());
    let solver = Process::find(arguments.solver.as_deref());
    let outcome = aside::search(request, solver, cancel, &mut watch, &|| false)?;
    let found = match outcome {
        Ok(found) => found,
        Err(NoStart::Refused(_)) => unreachable!("the search is not kept"),
        Err(trouble) => return super::no_start(shell, teller, trouble).map(|_| ()),
    };
    let idle = question.idle(&found);
    for replaced in &idle.parts {
        shell.diagnostic(teller.words.sources, &groundstate::diagnose_idle(replaced, program))?;
    }
    tell_count(shell, held.len(), count, &idle)
}

fn tell_count(shell: &mut Shell, held: usize, count: usize, idle: &Idle) -> Result<(), Failure> {
    if shell.json() {
        return shell.object(&Vacuity::new(held, count, idle.parts.len(), idle.open));
    }
    if shell.talks() || idle.open > 0 {
        let (parts, of) = (plural(count, "part"), counted(held));
        let found = if idle.parts.is_empty() { "none".to_string() } else { idle.parts.len().to_string() };
        let open = if idle.open > 0 { format!(", {} not known", idle.open) } else { String::new() };
        writeln!(shell.out(), "idle parts: {found} of {parts} of {of}{open}")?;
    }
    Ok(())
}

fn counted(properties: usize) -> String {
    if properties == 1 { "1 property that holds".to_string() } else { format!("{properties} properties that hold") }
}

fn is_formula(kind: PropertyKind) -> bool {
    matches!(kind, PropertyKind::Invariant | PropertyKind::Ctl | PropertyKind::Ltl)
}
