//! What a model has to cover, and what scenarios covered: rules, branches, updates, forall with no, one and many
//! elements.
//!
//! In: a model. Out: everything that is [`wanted`] of tests; and, with the counts of several runs, [`Items`], each
//! covered or not. Counts go by the place of the rule in the text, so a macro rule that is lowered several times counts
//! as one.

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

    /// Whether it was shown.
    pub fn show(&self, evidence: Evidence) -> bool {
        let at = |span: Span| self.rules.get(&span).copied().unwrap_or_default();
        match evidence {
            Evidence::Ran(span) => at(span).executed > 0,
            Evidence::Went(span, outcome) => at(span).outcomes[usize::from(outcome)] > 0,
        }
    }
}

/// One thing to be covered.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Item {
    /// The declared rule it is in.
    pub rule: String,
    /// The kind of item: the rule's name, `then`, `else`, `case`, `no candidate`, the updated location's text is at
    /// `span`.
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

/// What kind of thing is to be covered.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WantedKind {
    /// A declared rule runs.
    Rule,
    /// A branch of an if, switch or choose is taken, or none.
    Branch(&'static str),
    /// An update changes something.
    Update,
    /// A forall runs with no, one or many elements: 0, 1, 2.
    Forall(u8),
}

/// What shows that it is covered, by the place of a rule in the text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Evidence {
    /// The rule ran.
    Ran(Span),
    /// The rule went so (see [`machine::Coverage`]).
    Went(Span, u8),
}

/// One thing that there is to cover.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Wanted<'m> {
    /// The declared rule it is in.
    pub rule: &'m str,
    /// What it is.
    pub kind: WantedKind,
    /// Where.
    pub span: Span,
    /// What shows that it is covered.
    pub evidence: Evidence,
}

/// Everything there is to cover in the rules of files that `own` accepts, in the order of the text: what scenarios are
/// counted by, and what tests are made for.
pub fn wanted<'m>(model: &'m Model, own: &dyn Fn(FileId) -> bool) -> Vec<Wanted<'m>> {
    let mut all = Vec::new();
    for rule in model.rules.iter().filter(|rule| own(rule.span.file)) {
        let evidence = Evidence::Ran(rule.body.span);
        all.push(Wanted { rule: &rule.name, kind: WantedKind::Rule, span: rule.span, evidence });
        rule.body.walk(&mut |node| {
            of_node(node, &mut |kind, span, evidence| all.push(Wanted { rule: &rule.name, kind, span, evidence }));
        });
    }
    all
}

fn of_node(node: &RuleNode, add: &mut dyn FnMut(WantedKind, Span, Evidence)) {
    let mut branch = |what, span, evidence| add(WantedKind::Branch(what), span, evidence);
    let went = |outcome| Evidence::Went(node.span, outcome);
    match &node.kind {
        RuleKind::Update { .. } => add(WantedKind::Update, node.span, went(1)),
        RuleKind::If { branches, otherwise } => {
            branches.iter().for_each(|(_, child)| branch("then", child.span, Evidence::Ran(child.span)));
            match otherwise {
                Some(child) => branch("else", child.span, Evidence::Ran(child.span)),
                None => branch("no branch", node.span, went(0)),
            }
        }
        RuleKind::Switch { cases, otherwise, .. } => {
            cases.iter().for_each(|(_, child)| branch("case", child.span, Evidence::Ran(child.span)));
            match otherwise {
                Some(child) => branch("otherwise", child.span, Evidence::Ran(child.span)),
                None => branch("no case", node.span, went(0)),
            }
        }
        RuleKind::Choose { body, .. } => {
            branch("chosen", body.span, Evidence::Ran(body.span));
            branch("nothing to choose", node.span, went(0));
        }
        RuleKind::Forall { .. } => {
            (0..3).for_each(|outcome| add(WantedKind::Forall(outcome), node.span, went(outcome)));
        }
        RuleKind::Skip
        | RuleKind::MacroCall(_)
        | RuleKind::TurboCall(_)
        | RuleKind::Return { .. }
        | RuleKind::RunValue { .. }
        | RuleKind::RunAgent { .. }
        | RuleKind::Par(_)
        | RuleKind::Seq(_)
        | RuleKind::Let { .. }
        | RuleKind::Extend { .. }
        | RuleKind::Iterate(_)
        | RuleKind::While { .. }
        | RuleKind::RecursiveWhile { .. }
        | RuleKind::Local { .. }
        | RuleKind::Error => {}
    }
}

impl Items {
    /// What there is to cover in the rules of files that `own` accepts.
    pub fn of(model: &Model, own: &dyn Fn(FileId) -> bool, counts: &Counts) -> Items {
        let mut items = Items::default();
        for Wanted { rule, kind, span, evidence } in wanted(model, own) {
            let covered = counts.show(evidence);
            let item = |what| Item { rule: rule.to_string(), what, span, covered };
            match kind {
                WantedKind::Rule => items.rules.push(item("rule")),
                WantedKind::Branch(what) => items.branches.push(item(what)),
                WantedKind::Update => items.updates.push(item("update")),
                WantedKind::Forall(0) => {
                    items.foralls.push(Forall { rule: rule.to_string(), span, seen: [covered, false, false] });
                }
                WantedKind::Forall(outcome) => {
                    if let Some(forall) = items.foralls.last_mut() {
                        forall.seen[usize::from(outcome)] = covered;
                    }
                }
            }
        }
        items
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
