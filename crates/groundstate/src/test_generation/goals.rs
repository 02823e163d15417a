//! The goals of generated tests: everything that the coverage of scenarios counts, conditions that decide, transitions.
//!
//! In: a model, for which [`scenario::wanted`] lists what to cover; what was seen to happen. Out: [`Goal`]s. A goal has
//! [`Need`]s: a condition that decides needs two decisions, everything else one event. A rule is identified by its
//! place in the text, so its copies in the program count as one.

use std::collections::BTreeSet;

use machine::{Observation, Truths};
use model::Model;
use program::{DomainId, Program};
use scenario::{Evidence, Wanted, WantedKind, wanted};
use syntax::{FileId, Span};
use verify::survey::{Sighting, guards};

/// The kinds of goals.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum GoalKind {
    /// A declared rule runs.
    Rule,
    /// A branch of an if, switch or choose is taken, or none.
    Branch(&'static str),
    /// An update changes something.
    Update,
    /// A forall runs with no, one, many elements.
    Forall(&'static str),
    /// A condition decides its guard by itself.
    Condition,
    /// A transition of a chart is taken.
    Transition,
}

impl GoalKind {
    /// The words for a kind of goal, and for which of its kind it is.
    pub fn words(self) -> (&'static str, &'static str) {
        match self {
            GoalKind::Rule => ("rules", "the whole"),
            GoalKind::Branch(what) => ("branches", what),
            GoalKind::Update => ("updates", "update"),
            GoalKind::Forall(what) => ("foralls", what),
            GoalKind::Condition => ("conditions", "deciding condition"),
            GoalKind::Transition => ("transitions", "transition"),
        }
    }
}

/// Something to reach.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Goal {
    /// What kind it is.
    pub kind: GoalKind,
    /// The declared rule that it is in, or the transition's control states.
    pub rule: String,
    /// Where.
    pub span: Span,
    /// The events that must all happen.
    pub(super) needs: Vec<Need>,
    /// Whether it can be reached.
    pub reached: bool,
}

/// An event that a step may show.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Need {
    Ran(Span),
    Went(Span, u8),
    Decided(Span, Truths),
    Turned(DomainId, u32, u32),
}

/// A transition of a chart: an update replaces one literal of an enum domain by another. LIMIT: transitions with the
/// same control states are not told apart.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Turn {
    /// Its name in messages.
    pub name: String,
    /// Its place in messages.
    pub span: Span,
    /// The domain of the control states.
    pub domain: DomainId,
    /// The numbers of the literals.
    pub literals: (u32, u32),
}

/// The needs that an event meets.
pub(super) fn needs_met(program: &Program, observation: Observation) -> impl Iterator<Item = Need> {
    let need = match observation {
        Observation::Ran(rule) => Some(Need::Ran(program.rule_span(rule))),
        Observation::Went(rule, outcome) => Some(Need::Went(program.rule_span(rule), outcome)),
        Observation::Decided(guard, truths) => Some(Need::Decided(program.term_span(guard), truths)),
        Observation::Turned(domain, from, to) => Some(Need::Turned(domain, from, to)),
        Observation::Read(..) | Observation::Wrote(..) | Observation::Clashed(..) => None,
    };
    need.into_iter()
}

/// All goals in the files that `own` accepts, in the order of the text; those that were seen to happen are marked as
/// reached.
pub(super) fn goals(
    model: &Model,
    program: &Program,
    turns: &[Turn],
    own: &dyn Fn(FileId) -> bool,
    sightings: &[Sighting],
) -> Vec<Goal> {
    let mut goals: Vec<Goal> = wanted(model, own).iter().map(goal).collect();
    let seen: BTreeSet<Need> = sightings
        .iter()
        .filter(|sighting| sighting.made)
        .flat_map(|sighting| needs_met(program, sighting.observation))
        .collect();
    for goal in &mut goals {
        goal.reached = goal.needs.iter().all(|need| seen.contains(need));
    }
    for guard in guards(program, sightings).into_iter().filter(|guard| own(guard.span.file)) {
        for (span, pair) in guard.conditions {
            let rule = model.rules.iter().find(|rule| covers(rule.body.span, span));
            let name = rule.map_or(String::new(), |rule| rule.name.clone());
            let reached = pair.is_some();
            let needs = pair.iter().flatten().flat_map(|sighting| needs_met(program, sighting.observation)).collect();
            goals.push(Goal { kind: GoalKind::Condition, rule: name, span, needs, reached });
        }
    }
    for turn in turns {
        let (from, to) = turn.literals;
        let need = Need::Turned(turn.domain, from, to);
        let reached = seen.contains(&need);
        let (rule, span) = (turn.name.clone(), turn.span);
        goals.push(Goal { kind: GoalKind::Transition, rule, span, needs: vec![need], reached });
    }
    goals.sort_by_key(|goal| (goal.span, goal.kind));
    goals
}

fn covers(outer: Span, inner: Span) -> bool {
    outer.file == inner.file && outer.start <= inner.start && inner.end <= outer.end
}

/// What scenario coverage counts, as a goal.
fn goal(wanted: &Wanted<'_>) -> Goal {
    let kind = match wanted.kind {
        WantedKind::Rule => GoalKind::Rule,
        WantedKind::Branch(what) => GoalKind::Branch(what),
        WantedKind::Update => GoalKind::Update,
        WantedKind::Forall(0) => GoalKind::Forall("no element"),
        WantedKind::Forall(1) => GoalKind::Forall("one element"),
        WantedKind::Forall(_) => GoalKind::Forall("many elements"),
    };
    let need = match wanted.evidence {
        Evidence::Ran(span) => Need::Ran(span),
        Evidence::Went(span, outcome) => Need::Went(span, outcome),
    };
    Goal { kind, rule: wanted.rule.to_string(), span: wanted.span, needs: vec![need], reached: false }
}
