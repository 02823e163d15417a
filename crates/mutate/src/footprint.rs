//! What rules read and write, and whether they may be made one after the other as well as at once.
//!
//! In: the parts of a `par` or a `seq`. Out: whether no part reads or writes a function that an earlier one writes; then both
//! mean the same. INVARIANT: whatever is not known counts as read and written.

use std::collections::BTreeSet;

use model::{FunctionId, Model, RuleId, RuleKind, RuleNode, Target, Term, TermKind};

/// The functions that a rule reads and writes.
#[derive(Default)]
struct Footprint {
    reads: BTreeSet<FunctionId>,
    writes: BTreeSet<FunctionId>,
    /// It may do anything.
    anything: bool,
    entered: BTreeSet<RuleId>,
}

/// Whether these rules do the same one after the other and at once.
pub(crate) fn are_independent(model: &Model, parts: &[RuleNode]) -> bool {
    let footprints: Vec<Footprint> = parts.iter().map(|part| Footprint::of(model, part)).collect();
    footprints.iter().enumerate().all(|(index, later)| {
        !later.anything
            && footprints[..index]
                .iter()
                .all(|earlier| earlier.writes.is_disjoint(&later.reads) && earlier.writes.is_disjoint(&later.writes))
    })
}

impl Footprint {
    fn of(model: &Model, rule: &RuleNode) -> Footprint {
        let mut footprint = Footprint::default();
        footprint.rule(model, rule);
        footprint
    }

    fn rule(&mut self, model: &Model, rule: &RuleNode) {
        rule.walk(&mut |rule| {
            rule.terms(&mut |term| self.term(model, term));
            match &rule.kind {
                RuleKind::Update { target, .. } => self.target(target),
                RuleKind::MacroCall(call) | RuleKind::TurboCall(call) => self.call(model, call.rule),
                RuleKind::Return { target, call } => {
                    self.target(target);
                    self.call(model, call.rule);
                }
                RuleKind::RunValue { .. } | RuleKind::RunAgent { .. } | RuleKind::Extend { .. } | RuleKind::Error => {
                    self.anything = true;
                }
                RuleKind::Skip
                | RuleKind::Par(_)
                | RuleKind::Seq(_)
                | RuleKind::If { .. }
                | RuleKind::Switch { .. }
                | RuleKind::Let { .. }
                | RuleKind::Choose { .. }
                | RuleKind::Forall { .. }
                | RuleKind::Iterate(_)
                | RuleKind::While { .. }
                | RuleKind::RecursiveWhile { .. }
                | RuleKind::Local { .. } => {}
            }
        });
    }

    fn call(&mut self, model: &Model, rule: RuleId) {
        if self.entered.insert(rule) {
            self.rule(model, &model.rule(rule).body);
        }
    }

    fn target(&mut self, target: &Target) {
        match target {
            Target::Location { function, .. } => _ = self.writes.insert(*function),
            Target::Parameter(..) => self.anything = true,
        }
    }

    fn term(&mut self, model: &Model, term: &Term) {
        let mut open = Vec::new();
        term.walk(&mut |term| {
            if let TermKind::Apply { function, .. } = &term.kind {
                open.push(*function);
            }
        });
        while let Some(function) = open.pop() {
            if self.reads.insert(function)
                && let Some(definition) = &model.function(function).definition
            {
                definition.body.walk(&mut |term| {
                    if let TermKind::Apply { function, .. } = &term.kind {
                        open.push(*function);
                    }
                });
            }
        }
    }
}
