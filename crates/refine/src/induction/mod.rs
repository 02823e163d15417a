//! Refinement by induction: from every pair of states that corresponds, reached or not, each diagram leads to one that corresponds.
//!
//! In: a coupling, options, solvers. Out: a [`Report`] whose proof has the obligations as files of SMT-LIB, and what solvers said of each.
//! Nothing is assumed of a pair but the coupling, the domains, the models' assumptions, and those of their invariants that are proved first;
//! and with `segment`, that a segment ends there or begins a run. A short search by the machines goes before: it has the initial states, and
//! it alone refutes. INVARIANT: *refines* is said only if two solvers accept every obligation, and none was left out. Decided in docs/adr/0043.

mod across;
mod answers;
mod ask;
mod diagrams;
mod invariants;
pub(crate) mod proof;
mod prover;
mod related;
mod replay;
mod steps;
mod stuck;
mod symbolic;

use machine::Cause;
use solve::session::Solvers;

use crate::coupling::Coupling;
use crate::limited::with_shared_inputs;
use crate::options::Options;
use crate::preserve::preserved_by;
use crate::refine::{Trouble, refine};
use crate::report::{Progress, Report, Verdict, Why};
use crate::transfer::Transfer;
use crate::{ABSTRACT, CONCRETE};
use ask::Ask;
use proof::{Gap, Proof, SOLVERS};
use prover::{Ended, Prover};
use symbolic::Store;

/// LIMIT: so many pairs of states are searched for a refutation, if the options say nothing.
const SEARCHED: u64 = 500;
/// LIMIT: so many steps are made for it.
const STEPS: u64 = 20_000;
/// The solvers and how long they may take.
pub struct Provers<'s> {
    /// Two of them must accept each obligation.
    pub solvers: Vec<&'s mut dyn Solvers>,
    /// For each question, in seconds.
    pub seconds: u32,
}

impl std::fmt::Debug for Provers<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Provers").field("seconds", &self.seconds).finish_non_exhaustive()
    }
}

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
    let max_pairs = options.max_pairs.min(SEARCHED);
    let searched = Options { max_pairs, max_steps: options.max_steps.min(STEPS), ..options.clone() };
    let mut report = refine(coupling, &searched, watch)?;
    report.diagrams.clear();
    report.properties.clear();
    let is_interrupted = |why: &Why| matches!(why, Why::Stopped(_));
    match &report.verdict {
        Verdict::DoesNot(_) | Verdict::Vacuous(_) => return Ok(report),
        Verdict::Unknown(whys) if whys.iter().any(is_interrupted) => return Ok(report),
        Verdict::Refines | Verdict::Unknown(_) => {}
    }
    // The search before a proof may not have come to the steps that matter.
    report.idle = false;
    let mut proof = Proof::default();
    let Provers { solvers, seconds } = provers;
    for solver in &solvers {
        proof.solvers.extend(solver.name());
    }
    let progress = report.progress;
    let mut go_on = || watch(&progress) && options.extents.iter().all(|extent| !extent.interrupt.is_raised());
    let ask = Ask { solvers, seconds, go_on: &mut go_on, obligations: Vec::new(), stopped: false };
    let mut prover = Prover {
        coupling,
        options,
        ask,
        store: Store::default(),
        diagrams: Vec::new(),
        known: Vec::new(),
        begun: Default::default(),
    };
    let outcome = prover.all();
    let Prover { ask, diagrams, known, .. } = prover;
    let Ask { obligations, stopped, .. } = ask;
    proof.obligations = obligations;
    proof.diagrams = diagrams;
    proof.known = known;
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
