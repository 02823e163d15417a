//! What solvers said of a refinement, as JSON objects: of each obligation of a proof by induction, and of runs from the initial states.
//!
//! In: a proof, or how far runs were looked at, with the words for it. Out: [`ProofLine`] and [`RunsLine`], which stand in the object of
//! the refinement.

use groundstate::refine::{ABSTRACT, CONCRETE, Differs, Gap, Known, Proof, Runs, SIDES, Stuck};
use groundstate::tell::{Refinements, said};
use serde::Serialize;

/// A proof, or how far it came.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct ProofLine {
    /// The solvers, with their versions.
    solvers: Vec<String>,
    /// What they were asked, in order.
    obligations: Vec<ObligationLine>,
    /// The invariants of both models.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    invariants: Vec<KnownLine>,
    /// The diagrams that answers use.
    diagrams: Vec<UsedDiagram>,
    /// What decreases while the abstract machine makes no step.
    #[serde(skip_serializing_if = "Option::is_none")]
    variant: Option<String>,
    /// Why it is not whole.
    #[serde(skip_serializing_if = "Option::is_none")]
    gap: Option<String>,
    /// A pair of states that corresponds and from which the last obligation fails. No run need reach it.
    #[serde(skip_serializing_if = "Option::is_none")]
    stuck: Option<StuckLine>,
}

#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct ObligationLine {
    name: String,
    /// What holds if it is accepted.
    claim: String,
    /// The answer with which it is accepted, `unsat` or `sat`.
    wants: &'static str,
    /// What each solver said.
    said: Vec<String>,
    accepted: bool,
}

/// An invariant: whether it was proved first, and is known of each pair of states.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct KnownLine {
    model: &'static str,
    name: String,
    used: bool,
    /// Why it is not used.
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
}

/// A diagram: so many steps of each machine.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct UsedDiagram {
    r#abstract: u32,
    concrete: u32,
}

#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct StuckLine {
    r#abstract: Vec<(String, String)>,
    concrete: Vec<(String, String)>,
    /// The concrete steps from there.
    steps: Vec<StuckStep>,
    /// What the last of them comes to, if it cannot be made.
    #[serde(skip_serializing_if = "Option::is_none")]
    fault: Option<String>,
    /// What the abstract machine could do.
    tried: Vec<AttemptLine>,
    /// The faults that the machines come to in this pair: the concrete one in its last step, the abstract one in its first.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    faults: Vec<ReplayedLine>,
}

/// Why a step cannot be made.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct ReplayedLine {
    model: &'static str,
    message: String,
    /// Where, as `FILE:LINE:COLUMN`; of a clash both updates.
    at: Vec<String>,
}

#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct StuckStep {
    inputs: Vec<(String, String)>,
    changes: Vec<(String, String)>,
}

#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct AttemptLine {
    /// How many steps it makes.
    steps: u32,
    /// The parts of the coupling that do not hold then.
    fails: Vec<String>,
    /// All parts hold, but no variant says that it does not stand still for ever.
    stands_still: bool,
}

/// What solvers looked at of runs from the initial states.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct RunsLine {
    /// The solvers, with their versions.
    solvers: Vec<String>,
    /// All of them say that no run of at most so many concrete steps is refuted.
    steps: u64,
    /// A run that refutes: its steps, and the solver that found it. Both machines have made it again.
    #[serde(skip_serializing_if = "Option::is_none")]
    found: Option<FoundLine>,
    /// With `induction`: a run to a pair of states from which the last obligation fails.
    #[serde(skip_serializing_if = "Option::is_none")]
    reached: Option<FoundLine>,
    /// With `induction`: all solvers say that no run of at most so many steps comes to such a pair.
    #[serde(skip_serializing_if = "Option::is_none")]
    not_reached: Option<u64>,
    /// Why longer runs were not looked at, if it is not the limit of steps.
    #[serde(skip_serializing_if = "Option::is_none")]
    left: Option<String>,
}

#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct FoundLine {
    steps: u64,
    solver: String,
}

impl RunsLine {
    /// What was looked at.
    pub fn new(words: &Refinements<'_>, runs: &Runs) -> RunsLine {
        let line = |(steps, solver): &(u64, String)| FoundLine { steps: *steps, solver: solver.clone() };
        RunsLine {
            solvers: runs.solvers.clone(),
            steps: runs.depth,
            found: runs.found.as_ref().map(line),
            reached: runs.reached.as_ref().map(line),
            not_reached: runs.apart,
            left: runs.left.is_some().then(|| words.no_run(runs)),
        }
    }
}

impl ProofLine {
    /// A proof.
    pub fn new(words: &Refinements<'_>, proof: &Proof) -> ProofLine {
        let line = |obligation: &groundstate::refine::Obligation| ObligationLine {
            name: obligation.name.clone(),
            claim: obligation.claim.clone(),
            wants: if obligation.sense { "sat" } else { "unsat" },
            said: obligation.said.iter().map(said).collect(),
            accepted: obligation.is_accepted(),
        };
        let stuck = match &proof.gap {
            Some(Gap::Stuck(_, stuck)) => Some(StuckLine::new(words, stuck)),
            _ => None,
        };
        ProofLine {
            solvers: proof.solvers.clone(),
            obligations: proof.obligations.iter().map(line).collect(),
            invariants: proof.known.iter().map(KnownLine::of).collect(),
            diagrams: proof.diagrams.iter().map(|(m, n)| UsedDiagram { r#abstract: *m, concrete: *n }).collect(),
            variant: words.coupling.variant(),
            gap: proof.gap.is_some().then(|| words.gap(proof)),
            stuck,
        }
    }
}

impl KnownLine {
    fn of(known: &Known) -> KnownLine {
        let Known { side, name, unused } = known.clone();
        KnownLine { model: SIDES[side], name, used: unused.is_none(), reason: unused }
    }
}

impl StuckStep {
    fn new((inputs, changes): &(Differs, Differs)) -> StuckStep {
        StuckStep { inputs: inputs.clone(), changes: changes.clone() }
    }
}

impl StuckLine {
    fn new(words: &Refinements<'_>, stuck: &Stuck) -> StuckLine {
        let mut faults = Vec::new();
        for side in [ABSTRACT, CONCRETE] {
            faults.extend(stuck.faults[side].iter().map(|fault| {
                let (message, at) = words.replayed(side, fault);
                ReplayedLine { model: SIDES[side], message, at }
            }));
        }
        let attempt = |attempt: &groundstate::refine::Attempt| AttemptLine {
            steps: attempt.m,
            fails: attempt.parts.clone(),
            stands_still: attempt.stands,
        };
        StuckLine {
            r#abstract: stuck.states[ABSTRACT].clone(),
            concrete: stuck.states[CONCRETE].clone(),
            steps: stuck.steps.iter().map(StuckStep::new).collect(),
            fault: stuck.fault.clone(),
            tried: stuck.tried.iter().map(attempt).collect(),
            faults,
        }
    }
}
