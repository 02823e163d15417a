//! Describes a proof of refinement by induction as text for people: the obligations that solvers accept, or where it does not go on.
//!
//! In: a proof, the words for the two models. Out: lines. INVARIANT: a pair of states from which an obligation fails is never called a
//! counterexample: no run need reach it.

use machine::{Fault, FaultKind};
use refine::{ABSTRACT, Attempt, CONCRETE, Gap, Known, Obligation, Origin, Proof, SIDES, Said, Stuck};

use super::{Refinements, plural};

/// LIMIT: so many lines of a state are shown.
const LINES: usize = 24;

/// Names joined as in a sentence.
pub(super) fn joined(names: &[String]) -> String {
    match names {
        [] => "no solver".to_string(),
        [one] => one.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

/// Solvers without their versions.
pub(super) fn named(solvers: &[String]) -> Vec<String> {
    solvers.iter().map(|solver| solver.split(' ').next().unwrap_or(solver).to_string()).collect()
}

/// What a solver said, in a word or a clause.
pub fn said(said: &Said) -> String {
    match said {
        Said::Possible => "sat".to_string(),
        Said::Impossible => "unsat".to_string(),
        Said::Unknown => "unknown".to_string(),
        Said::Late => "no answer in time".to_string(),
        Said::Broken(reason) => reason.clone(),
    }
}

impl Refinements<'_> {
    /// Why a proof is not whole, as a clause.
    pub fn gap(&self, proof: &Proof) -> String {
        let name = |index: usize| proof.obligations.get(index).map_or("", |obligation| &obligation.name);
        match &proof.gap {
            None => "the proof is whole".to_string(),
            Some(Gap::Outside(origin, outside)) => format!("solvers are not told of {}", self.named(*origin, outside)),
            Some(Gap::Stuck(index, _)) => format!("the induction fails at `{}`", name(*index)),
            Some(Gap::Contradicted(index)) => format!("solvers contradict each other about `{}`", name(*index)),
            Some(Gap::Silent(index)) => format!("not all solvers decide `{}`", name(*index)),
            Some(Gap::Alone) => {
                format!("only {} accepts the proof, and two solvers have to", joined(&named(&proof.solvers)))
            }
            Some(Gap::Stopped) => "stopped".to_string(),
        }
    }

    /// Something that solvers are not told of, with its place.
    pub(super) fn named(&self, origin: Origin, outside: &solve::Outside) -> String {
        let (sources, whose) = match origin {
            Origin::Side(side) => (&self.models[side].sources, format!("the {} model", SIDES[side])),
            Origin::Coupling => (self.coupling.sources(), "the coupling".to_string()),
        };
        match outside.span.end {
            0 => format!("{}, in {whose}", outside.what),
            _ => format!("{}, in {whose} at {}", outside.what, sources.position(outside.span)),
        }
    }

    /// The lines about a proof; `is_reached` if a run comes to a pair from which it does not go on.
    pub(super) fn proof(&self, proof: &Proof, is_reached: bool) -> Vec<String> {
        let mut lines = known(proof);
        let accepted = proof.obligations.iter().filter(|obligation| obligation.is_accepted()).count();
        if proof.gap.is_none() {
            let used: Vec<String> = proof.diagrams.iter().map(|(m, n)| format!("{m}:{n}")).collect();
            let senses = proof.obligations.iter().filter(|obligation| obligation.sense).count();
            let count = plural(accepted - senses, "obligation");
            lines.insert(
                0,
                format!("  proved     by induction: {count}, accepted by {}", joined(&named(&proof.solvers))),
            );
            if !used.is_empty() {
                lines.insert(0, format!("  diagrams   {}", used.join(", ")));
            }
            if let Some(variant) = self.coupling.variant() {
                lines.push(format!("  variant    {variant}"));
            }
            return lines;
        }
        match &proof.gap {
            Some(Gap::Stuck(index, stuck)) => {
                lines.push(format!("  to prove: {}", proof.obligations[*index].claim));
                lines.extend(self.stuck(stuck, is_reached));
            }
            Some(Gap::Contradicted(index) | Gap::Silent(index)) => {
                let obligation = &proof.obligations[*index];
                lines.push(format!("  to prove: {}", obligation.claim));
                for (solver, word) in proof.solvers.iter().zip(&obligation.said) {
                    lines.push(format!("  {solver} says: {}", said(word)));
                }
                lines.push("  --obligations DIR writes the question for other solvers".to_string());
            }
            Some(Gap::Alone) => lines.push(missing(&named(&proof.solvers))),
            Some(Gap::Outside(..)) => {
                lines.push("  let the pairs be explored: leave out --method".to_string());
            }
            Some(Gap::Stopped) | None => {}
        }
        let open = proof.obligations.iter().filter(|obligation| !obligation.is_accepted()).map(name);
        let open: Vec<String> = open.collect();
        if !proof.obligations.is_empty() {
            let open = if open.is_empty() { String::new() } else { format!("; not: {}", open.join(", ")) };
            lines.push(format!("  {} accepted{open}", plural(accepted, "obligation")));
        }
        lines
    }

    fn stuck(&self, stuck: &Stuck, is_reached: bool) -> Vec<String> {
        let mut lines = vec!["  from this pair, which corresponds, and which no run need reach:".to_string()];
        let shown = |side: usize| -> Vec<String> {
            let all = stuck.states[side].iter().map(|(name, value)| format!("{name} = {value}"));
            let mut all: Vec<String> = all.collect();
            if all.len() > LINES {
                let more = all.len() - LINES;
                all.truncate(LINES);
                all.push(format!("… and {more} more"));
            }
            all
        };
        let (left, right) = (shown(ABSTRACT), shown(CONCRETE));
        let width = left.iter().map(|line| line.chars().count()).max().unwrap_or(0).max("abstract".len());
        lines.push(format!("    {:width$}  concrete", "abstract"));
        for index in 0..left.len().max(right.len()) {
            let of = |lines: &[String]| lines.get(index).cloned().unwrap_or_default();
            lines.push(format!("    {:width$}  {}", of(&left), of(&right)));
        }
        for (number, (inputs, changes)) in stuck.steps.iter().enumerate() {
            let mut what: Vec<String> = inputs.iter().map(|(name, value)| format!("in {name} = {value}")).collect();
            what.extend(changes.iter().map(|(name, value)| format!("{name} becomes {value}")));
            let is_last = number + 1 == stuck.steps.len();
            let faults = &stuck.faults[CONCRETE];
            match &stuck.fault {
                Some(fault) if is_last && faults.is_empty() => what.push(format!("it comes to {fault}")),
                Some(_) if is_last => what.extend(faults.iter().map(|fault| self.cannot(CONCRETE, fault))),
                Some(_) | None => {}
            }
            if what.is_empty() {
                what.push("no change".to_string());
            }
            lines.push(format!("  step {} of the concrete machine: {}", number + 1, what.join(", ")));
        }
        lines.extend(stuck.tried.iter().map(|attempt| format!("  {}", tried(attempt))));
        let faults = stuck.faults[ABSTRACT].iter();
        lines.extend(
            faults.map(|fault| format!("  if the abstract machine makes a step, {}", self.cannot(ABSTRACT, fault))),
        );
        if stuck.tried.is_empty() && stuck.fault.is_none() {
            lines.push("  the abstract machine has no step that could answer".to_string());
        }
        let stands = stuck.tried.iter().any(|attempt| attempt.stands);
        if stands && self.coupling.variant().is_none() {
            lines.push(
                "  say why it does not stand still for ever, `variant TERM;`, or take it for granted, `allow waiting;`"
                    .to_string(),
            );
        } else if stands {
            lines.push("  the variant must be at least 0 there, and less after the step".to_string());
        }
        if !is_reached {
            lines.push(
                "  if no run reaches this pair, say what holds of those that are reached: `couple TERM;`, or an invariant"
                    .to_string(),
            );
        }
        lines
    }

    /// Why a step cannot be made, with its places.
    fn cannot(&self, side: usize, fault: &Fault) -> String {
        let (message, places) = self.replayed(side, fault);
        format!("it cannot be made: {message}, at {}", places.join(" and "))
    }

    /// A fault to which a machine comes where an obligation fails: a sentence, and the places of it; of a clash those of both updates.
    pub fn replayed(&self, side: usize, fault: &Fault) -> (String, Vec<String>) {
        let model = &self.models[side];
        let spans = match &fault.kind {
            FaultKind::InconsistentUpdate { first, second, .. } => vec![first.span, second.span],
            _ => vec![fault.span],
        };
        let places = spans.into_iter().map(|span| model.sources.position(span)).collect();
        (fault.show(&model.program).to_string(), places)
    }
}

/// What is known of every pair by the invariants of the models, and what is not used.
fn known(proof: &Proof) -> Vec<String> {
    let (used, unused): (Vec<&Known>, Vec<&Known>) = proof.known.iter().partition(|known| known.unused.is_none());
    let mut lines = Vec::new();
    if !used.is_empty() {
        let names: Vec<String> = used.iter().map(|known| format!("{} ({})", known.name, SIDES[known.side])).collect();
        lines.push(format!("  invariants {}", names.join(", ")));
    }
    for Known { side, name, unused } in unused {
        let why = unused.clone().unwrap_or_default();
        lines.push(format!("  not used   {name} ({}): {why}", SIDES[*side]));
    }
    lines
}

fn tried(attempt: &Attempt) -> String {
    let what = match attempt.m {
        0 => "if the abstract machine makes no step".to_string(),
        1 => "if the abstract machine makes a step".to_string(),
        m => format!("if the abstract machine makes {m} steps"),
    };
    match &attempt.parts[..] {
        [] if attempt.stands => format!("{what}, all corresponds, but nothing says that it ever moves again"),
        [] => format!("{what}, it cannot be made"),
        parts => {
            let parts: Vec<String> = parts.iter().map(|part| format!("`{part}`")).collect();
            format!("{what}, this does not hold: {}", parts.join(", "))
        }
    }
}

fn name(obligation: &Obligation) -> String {
    obligation.name.clone()
}

/// How to get the solver that is missing.
fn missing(there: &[String]) -> String {
    let absent: Vec<&str> = ["z3", "cvc5"].into_iter().filter(|one| !there.iter().any(|other| other == one)).collect();
    let absent = absent.join(" ");
    format!("  install the other: sh cpp/install.sh {absent}, or apt-get install {absent}")
}
