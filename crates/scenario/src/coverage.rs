//! What scenarios covered of a model: rules, branches, updates, forall with no, one and many elements.
//!
//! In: counts of several runs, by the place of the rule in the text, so that a macro rule lowered several times
//! counts as one. Out: [`Items`], everything there is to cover in the model's own files, each covered or not.

use std::collections::BTreeMap;

use model::{Model, RuleKind, RuleNode};
use program::{Program, RuleId};
use syntax::{FileId, Span};

/// How often the rule at a place ran, and how it went (see [`machine::Coverage`]).
#[derive(Debug, Clone, Default)]
pub struct Counts {
    rules: BTreeMap<Span, Count>,
}

#[derive(Debug, Clone, Copy, Default)]
struct Count {
    executed: u64,
    outcomes: [u64; 3],
}

impl Counts {
    pub(crate) fn of(program: &Program, coverage: &machine::Coverage) -> Counts {
        let mut counts = Counts::default();
        for (index, (executed, outcomes)) in coverage.executed.iter().zip(&coverage.outcomes).enumerate() {
            counts.add(program.rule_span(RuleId(index as u32)), Count { executed: *executed, outcomes: *outcomes });
        }
        counts
    }

    fn add(&mut self, span: Span, count: Count) {
        let sum = self.rules.entry(span).or_default();
        sum.executed += count.executed;
        sum.outcomes.iter_mut().zip(count.outcomes).for_each(|(sum, more)| *sum += more);
    }

    /// Adds the counts of another run of the same model.
    pub fn merge(&mut self, other: &Counts) {
        other.rules.iter().for_each(|(span, count)| self.add(*span, *count));
    }

    fn at(&self, node: &RuleNode) -> Count {
        self.rules.get(&node.span).copied().unwrap_or_default()
    }
}

/// One thing to be covered.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Item {
    /// The declared rule it is in.
    pub rule: String,
    /// What it is: the rule's name, `then`, `else`, `case`, `no candidate`, the updated location's text is at `span`.
    pub what: &'static str,
    /// Where.
    pub span: Span,
    /// Whether it was covered.
    pub covered: bool,
}

/// A branch of an if, switch or choose.
pub type Branch = Item;

/// A forall and with how many elements it ran.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Forall {
    /// The declared rule it is in.
    pub rule: String,
    /// Where.
    pub span: Span,
    /// With no, one and many elements.
    pub seen: [bool; 3],
}

/// Everything there is to cover.
#[derive(Debug, Clone, Default)]
pub struct Items {
    /// Declared rules.
    pub rules: Vec<Item>,
    /// Branches of if, switch and choose.
    pub branches: Vec<Branch>,
    /// Update rules; covered when they changed something.
    pub updates: Vec<Item>,
    /// Foralls.
    pub foralls: Vec<Forall>,
}

/// How much of it was covered.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Coverage {
    /// How many were.
    pub covered: usize,
    /// How many there are.
    pub total: usize,
}

impl Items {
    /// What there is to cover in the rules of files that `own` accepts.
    pub fn of(model: &Model, own: &dyn Fn(FileId) -> bool, counts: &Counts) -> Items {
        let mut items = Items::default();
        for rule in model.rules.iter().filter(|rule| own(rule.span.file)) {
            let covered = counts.at(&rule.body).executed > 0;
            items.rules.push(Item { rule: rule.name.clone(), what: "rule", span: rule.span, covered });
            rule.body.walk(&mut |node| items.node(&rule.name, node, counts));
        }
        items
    }

    fn node(&mut self, rule: &str, node: &RuleNode, counts: &Counts) {
        let count = counts.at(node);
        let item = |what, span, covered| Item { rule: rule.to_string(), what, span, covered };
        let ran = |child: &RuleNode| counts.at(child).executed > 0;
        match &node.kind {
            RuleKind::Update { .. } => self.updates.push(item("update", node.span, count.outcomes[1] > 0)),
            RuleKind::If { branches, otherwise } => {
                let taken = branches.iter().map(|(_, child)| item("then", child.span, ran(child)));
                self.branches.extend(taken);
                self.branches.push(match otherwise {
                    Some(child) => item("else", child.span, ran(child)),
                    None => item("no branch", node.span, count.outcomes[0] > 0),
                });
            }
            RuleKind::Switch { cases, otherwise, .. } => {
                let taken = cases.iter().map(|(_, child)| item("case", child.span, ran(child)));
                self.branches.extend(taken);
                self.branches.push(match otherwise {
                    Some(child) => item("otherwise", child.span, ran(child)),
                    None => item("no case", node.span, count.outcomes[0] > 0),
                });
            }
            RuleKind::Choose { body, .. } => {
                self.branches.push(item("chosen", body.span, ran(body)));
                self.branches.push(item("nothing to choose", node.span, count.outcomes[0] > 0));
            }
            RuleKind::Forall { .. } => {
                let seen = count.outcomes.map(|count| count > 0);
                self.foralls.push(Forall { rule: rule.to_string(), span: node.span, seen });
            }
            _ => {}
        }
    }

    /// How much of each kind was covered: rules, branches, updates, foralls (each counting three times).
    pub fn totals(&self) -> [(&'static str, Coverage); 4] {
        let of =
            |items: &[Item]| Coverage { covered: items.iter().filter(|item| item.covered).count(), total: items.len() };
        let seen = self.foralls.iter().flat_map(|forall| forall.seen).filter(|seen| *seen).count();
        let foralls = Coverage { covered: seen, total: 3 * self.foralls.len() };
        [
            ("rules", of(&self.rules)),
            ("branches", of(&self.branches)),
            ("updates", of(&self.updates)),
            ("foralls", foralls),
        ]
    }
}
