//! The rules that may run: what the main rule and the programs of agents call, and every rule that is used as a value.

use std::collections::BTreeSet;

use crate::id::RuleId;
use crate::model::Model;
use crate::rule::RuleKind;
use crate::term::{Term, TermKind};

impl Model {
    /// The rules that a run may come to. INVARIANT: it leaves out no rule that some run comes to; a rule that is used as a value
    /// counts, wherever that value goes. Without a main rule there are none.
    pub fn may_run(&self) -> BTreeSet<RuleId> {
        let mut found = roots(self);
        let mut open: Vec<RuleId> = found.iter().copied().collect();
        while let Some(rule) = open.pop() {
            self.rule(rule).body.walk(&mut |node| {
                if let RuleKind::MacroCall(call) | RuleKind::TurboCall(call) | RuleKind::Return { call, .. } =
                    &node.kind
                    && found.insert(call.rule)
                {
                    open.push(call.rule);
                }
            });
        }
        found
    }
}

/// The rules that run without being called: the main rule, the programs of agents, and those that are values of terms.
pub(crate) fn roots(model: &Model) -> BTreeSet<RuleId> {
    let Some(main) = model.main else { return BTreeSet::new() };
    let init = model.default_init.and_then(|index| model.inits.get(index));
    let mut roots: BTreeSet<RuleId> = init.iter().flat_map(|init| &init.agents).map(|agent| agent.rule).collect();
    roots.insert(main);
    roots.extend(values(model));
    roots
}

/// Rules that are used as values somewhere: they may run wherever such a value goes.
fn values(model: &Model) -> BTreeSet<RuleId> {
    let mut found = BTreeSet::new();
    let mut look = |term: &Term| {
        term.walk(&mut |part| {
            if let TermKind::Rule(rule) = &part.kind {
                found.insert(*rule);
            }
        });
    };
    for rule in &model.rules {
        rule.body.walk(&mut |node| node.terms(&mut look));
    }
    let initial = model.inits.iter().flat_map(|init| &init.functions).map(|given| &given.definition);
    for definition in model.functions.iter().filter_map(|function| function.definition.as_ref()).chain(initial) {
        look(&definition.body);
    }
    found
}
