//! Decides for each condition of a guard whether it decides the guard by itself: modified condition/decision coverage.
//!
//! In: the truth values with which a guard was evaluated. Out: for each condition, two evaluations that show it. They
//! have different outcomes and differ in that condition, but in no other condition that was evaluated in both (J.
//! Chilenski, S. Miller, *Applicability of modified condition/decision coverage to software testing*, 1994, for
//! connectives that do not evaluate all operands).

use std::collections::BTreeMap;

use machine::{CONDITIONS, Observation, Truths, conditions_of};
use program::{Program, Rule, TermId};
use syntax::Span;

use crate::survey::surveyor::Sighting;

/// A guard with several conditions.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Guard {
    /// Where it stands.
    pub span: Span,
    /// For each condition, its place and two sightings that show that it decides, if there are any.
    pub conditions: Vec<(Span, Option<[Sighting; 2]>)>,
}

/// A guard and its evaluations.
type Decided<'s> = (TermId, Vec<(Truths, &'s Sighting)>);

/// All guards with several conditions, evaluated or not, in the order of the text.
pub fn guards(program: &Program, sightings: &[Sighting]) -> Vec<Guard> {
    let mut decided: BTreeMap<Span, Decided<'_>> = BTreeMap::new();
    for guard in program.rules.iter().flat_map(|rule| guards_of(program, rule)) {
        if (2..=CONDITIONS).contains(&conditions_of(program, guard).len()) {
            decided.entry(program.term_span(guard)).or_insert_with(|| (guard, Vec::new()));
        }
    }
    for sighting in sightings.iter().filter(|sighting| sighting.made) {
        if let Observation::Decided(guard, truths) = sighting.observation {
            let entry = decided.entry(program.term_span(guard)).or_insert_with(|| (guard, Vec::new()));
            entry.1.push((truths, sighting));
        }
    }
    let guard = |(span, (guard, truths)): (Span, Decided<'_>)| {
        let conditions = conditions_of(program, guard);
        let shown = |(place, condition): (usize, &TermId)| (program.term_span(*condition), pair(&truths, place));
        Guard { span, conditions: conditions.iter().enumerate().map(shown).collect() }
    };
    decided.into_iter().map(guard).collect()
}

/// The guards of a rule, without those of the rules inside.
fn guards_of(program: &Program, rule: &Rule) -> Vec<TermId> {
    match rule {
        Rule::If { guards, .. } => program.term_list(*guards).to_vec(),
        Rule::While { condition, .. } | Rule::RecursiveWhile { condition, .. } => vec![*condition],
        Rule::Forall { condition, .. } => condition.iter().copied().collect(),
        Rule::Skip
        | Rule::Update { .. }
        | Rule::Call { .. }
        | Rule::TurboCall { .. }
        | Rule::Return { .. }
        | Rule::RunValue { .. }
        | Rule::RunAgent { .. }
        | Rule::Par(_)
        | Rule::Seq(_)
        | Rule::Switch { .. }
        | Rule::Let { .. }
        | Rule::Choose { .. }
        | Rule::Extend { .. }
        | Rule::Iterate(_)
        | Rule::Local { .. } => Vec::new(),
    }
}

/// The first two evaluations that show that a condition decides.
fn pair(truths: &[(Truths, &Sighting)], condition: usize) -> Option<[Sighting; 2]> {
    let bit = 1 << condition;
    for (later, (one, second)) in truths.iter().enumerate() {
        for (other, first) in &truths[..later] {
            let both = one.known & other.known;
            let differ = (one.truth ^ other.truth) & both;
            if one.outcome != other.outcome && differ == bit {
                return Some([(*first).clone(), (*second).clone()]);
            }
        }
    }
    None
}
