//! Refinement by induction: from every pair of states that corresponds, reached or not, each diagram leads to one that corresponds.
//!
//! In: a coupling, options, solvers. Out: a [`Report`] whose proof has the obligations as files of SMT-LIB, and what solvers said of each.
//! Nothing is assumed of a pair but the coupling, the domains, the models' assumptions, and those of their invariants that are proved first;
//! and with `segment`, that a segment ends there or begins a run. A short search by the machines goes before, and has the initial states. Where an
//! obligation fails, runs of a few steps are looked for ([`crate::bmc`]). Only what the machines make refutes. INVARIANT: *refines* is said only if two solvers accept every obligation, and none was left out. Decided in docs/adr/0043.

mod invariants;
pub(crate) mod proof;
mod prover;
mod replay;
mod steps;
mod stuck;

use std::ops::ControlFlow;

use machine::Cause;

use crate::bmc::look;
use crate::coupling::Coupling;
use crate::formulas::Formulas;
use crate::formulas::ask::{Ask, Provers};
use crate::formulas::obligation::SOLVERS;
use crate::limited::with_shared_inputs;
use crate::options::Options;
use crate::preserve::preserved_by;
use crate::refine::Trouble;
use crate::report::{Progress, Report, Verdict, Why};
use crate::short_search::short_search;
use crate::transfer::Transfer;
use crate::{ABSTRACT, CONCRETE};
use proof::{Gap, Proof};
use prover::{Ended, Prover};

/// LIMIT: so long each solver may think about runs from the initial states, if an obligation fails, in seconds.
const SECONDS: u32 = 10;

/// Whether the concrete machine refines the abstract one, by induction. `watch` receives progress and tells whether to go on.
///
/// # Errors
/// A machine has no initial states.
pub fn prove(
    coupling: &Coupling,
    options: &Options,
    provers: Provers<'_>,
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Result<Report, Trouble> {
    let options = &with_shared_inputs(coupling, options);
    let mut report = match short_search(coupling, options, watch)? {
        ControlFlow::Continue(report) => report,
        ControlFlow::Break(report) => return Ok(report),
    };
    let mut proof = Proof::default();
    let Provers { solvers, seconds, depth } = provers;
    for solver in &solvers {
        proof.solvers.extend(solver.name());
    }
    let progress = report.progress;
    let mut go_on = || watch(&progress) && options.extents.iter().all(|extent| !extent.interrupt.is_raised());
    let mut ask = Ask { solvers, seconds, go_on: &mut go_on, obligations: Vec::new(), stopped: false };
    let mut found = None;
    let outcome = match Formulas::of(coupling, options) {
        Err((origin, outside)) => Err(Ended::Gap(Gap::Outside(origin, outside))),
        Ok(mut formulas) => {
            let mut prover = Prover::new(coupling, options, &mut ask, &mut formulas.store, &formulas.starts);
            let machines = [&formulas.machines[ABSTRACT], &formulas.machines[CONCRETE]];
            let outcome = prover.all(machines, &formulas.related, &formulas.begun);
            let failing = prover.asked;
            (proof.diagrams, proof.known) = (prover.diagrams, prover.known);
            if let (Err(Ended::Gap(Gap::Stuck(..))), false) = (&outcome, ask.stopped || depth == 0) {
                ask.seconds = seconds.min(SECONDS);
                let (runs, refuted) = look(coupling, options, &mut formulas, &mut ask, depth, Some(failing));
                // Whoever has had enough by now still wants to know where the proof does not go on.
                ask.stopped = false;
                report.runs = Some(Box::new(runs));
                found = refuted;
            }
            outcome
        }
    };
    let Ask { obligations, stopped, .. } = ask;
    proof.obligations = obligations;
    let alone = proof.obligations.iter().any(|obligation| !obligation.is_accepted());
    proof.gap = match outcome {
        _ if stopped => Some(Gap::Stopped),
        Err(Ended::Gap(gap)) => Some(gap),
        Err(Ended::Vacuous(vacuous)) => {
            report.verdict = Verdict::Vacuous(vacuous);
            report.proof = Some(Box::new(proof));
            return Ok(report);
        }
        Ok(()) if alone || proof.solvers.len() < SOLVERS => Some(Gap::Alone),
        Ok(()) => None,
    };
    report.verdict = match &proof.gap {
        _ if found.is_some() => found.unwrap_or(Verdict::Refines),
        None => Verdict::Refines,
        Some(Gap::Stopped) => {
            let asked = |side: usize| options.extents[side].interrupt.cause();
            let cause = asked(ABSTRACT).or(asked(CONCRETE)).unwrap_or(Cause::Asked);
            Verdict::Unknown(vec![Why::Stopped(cause)])
        }
        Some(_) => Verdict::Unknown(vec![Why::Unproved]),
    };
    if report.verdict == Verdict::Refines {
        report.properties = preserved_by(coupling, &Transfer::of_allowed(coupling));
    }
    report.proof = Some(Box::new(proof));
    Ok(report)
}
