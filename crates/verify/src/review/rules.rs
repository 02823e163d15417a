//! MP1 to MP4: findings about rules.
//!
//! The program contains a rule once for each way of calling it; here its copies count as one, identified by its place
//! in the text. Of nested rules that never run, only the outermost is reported.

use std::collections::{BTreeMap, BTreeSet};

use machine::Observation;
use model::{RuleKind, RuleNode};
use program::{Rule, RuleId};
use syntax::Span;

use crate::review::{Matter, Meta, Reviewer};
use crate::survey::Sighting;

/// What happened to the rule at a place.
#[derive(Default)]
struct Went {
    ran: bool,
    ran_in_faults: bool,
    changed: bool,
    /// Where no branch was taken.
    no_branch: Option<Sighting>,
}

impl Reviewer<'_> {
    pub(super) fn rules(&mut self) {
        let went = self.went();
        self.clashes();
        for rule in &self.model.rules {
            if !self.is_own(rule.span) {
                continue;
            }
            match went.get(&rule.body.span) {
                None => self.find(Meta::Fires, Matter::NeverCalled(rule.name.clone()), rule.span),
                Some(_) => self.rule(&rule.body, &went),
            }
        }
    }

    fn went(&self) -> BTreeMap<Span, Went> {
        let mut went: BTreeMap<Span, Went> = BTreeMap::new();
        let span = |rule: RuleId| self.program.rule_span(rule);
        for rule in 0..self.program.rules.len() {
            went.entry(span(RuleId(rule as u32))).or_default();
        }
        for sighting in &self.survey.sightings {
            match sighting.observation {
                Observation::Ran(rule) => {
                    let went = went.entry(span(rule)).or_default();
                    went.ran |= sighting.made;
                    went.ran_in_faults |= !sighting.made;
                }
                Observation::Went(rule, outcome) if sighting.made => {
                    let went = went.entry(span(rule)).or_default();
                    match self.program.rule(rule) {
                        Rule::Update { .. } => went.changed |= outcome == 1,
                        Rule::If { .. } | Rule::Switch { .. } if outcome == 0 => {
                            went.no_branch.get_or_insert_with(|| sighting.clone());
                        }
                        _ => {}
                    }
                }
                _ => {}
            }
        }
        went
    }

    /// MP1: reports each pair of rules whose updates clash, once.
    fn clashes(&mut self) {
        let mut met = BTreeSet::new();
        for sighting in self.survey.sightings.clone() {
            let Observation::Clashed(first, second) = sighting.observation else { continue };
            let mut pair = [self.program.rule_span(first), self.program.rule_span(second)];
            pair.sort_unstable();
            if (self.is_own(pair[0]) || self.is_own(pair[1])) && met.insert(pair) {
                let witness = Some(Box::new(self.survey.walk(&sighting).trace));
                let finding =
                    super::Finding { meta: Meta::Consistent, matter: Matter::Clash(pair[0]), span: pair[1], witness };
                self.findings.push(finding);
            }
        }
    }

    /// MP2 to MP4 for a rule and those inside it.
    fn rule(&mut self, node: &RuleNode, went: &BTreeMap<Span, Went>) {
        // A rule that lowering removed is not in the program, but rules inside it may be.
        if let Some(here) = went.get(&node.span) {
            if !here.ran {
                node.walk(&mut |part| self.unrun_update |= matches!(part.kind, RuleKind::Update { .. }));
                // A branch that does nothing need not run.
                if !matches!(node.kind, RuleKind::Skip) {
                    let matter = if here.ran_in_faults { Matter::RunsInFaults } else { Matter::NeverRuns };
                    self.find(Meta::Fires, matter, node.span);
                }
                return;
            }
            if let (RuleKind::If { otherwise: None, .. } | RuleKind::Switch { otherwise: None, .. }, Some(sighting)) =
                (&node.kind, &here.no_branch)
            {
                let witness = Some(Box::new(self.survey.walk(sighting).trace));
                let finding =
                    super::Finding { meta: Meta::Complete, matter: Matter::NoBranch, span: node.span, witness };
                self.findings.push(finding);
            }
            if matches!(node.kind, RuleKind::Update { .. }) && !here.changed {
                self.find(Meta::NotTrivial, Matter::AlwaysTrivial, node.span);
            }
        }
        let mut inside = Vec::new();
        node.parts(&mut |part| inside.push(part));
        for part in inside {
            self.rule(part, went);
        }
    }
}
