//! A scenario ready to run: commands in groups, every fragment lowered into the program.
//!
//! INVARIANT: blocks are expanded; a group holds what happens between two steps, in the order of the text within
//! each kind of command.

use program::{Expression, FunctionId, ProcedureId};
use syntax::Span;
use syntax::ast::Expected;

/// A scenario.
#[derive(Debug, Clone)]
pub struct Script {
    /// Its name.
    pub name: String,
    /// Where the name is written.
    pub span: Span,
    /// How it is expected to fail.
    pub expectation: Option<Expectation>,
    /// Its own invariants.
    pub invariants: Vec<Invariant>,
    /// What happens between the steps.
    pub groups: Vec<Group>,
}

/// How a scenario is expected to fail.
#[derive(Debug, Clone)]
pub struct Expectation {
    /// Which trouble.
    pub expected: Expected,
    /// The invariant named.
    pub invariant: Option<String>,
    /// Where it is written.
    pub span: Span,
}

/// An invariant of the scenario.
#[derive(Debug, Clone)]
pub struct Invariant {
    /// Its name.
    pub name: String,
    /// The formula.
    pub formula: Expression,
    /// It reads inputs.
    pub reads_monitored: bool,
    /// Where it is written.
    pub span: Span,
}

/// The commands between two steps, and the step that ends them.
#[derive(Debug, Clone, Default)]
pub(crate) struct GroupParts {
    pub sets: Vec<Set>,
    pub picks: Vec<Pick>,
    pub actions: Vec<Action>,
}

/// The commands between two steps, and the step that ends them.
#[derive(Debug, Clone)]
pub struct Group {
    pub(crate) parts: GroupParts,
    pub(crate) step: StepKind,
}

/// What ends a group.
#[derive(Debug, Clone)]
pub(crate) enum StepKind {
    /// So many steps.
    Steps { count: u64, span: Span },
    /// Steps until the condition holds.
    Until { condition: Expression, bound: Option<u64>, span: Span },
    /// One step that must end in trouble.
    Trouble { expected: Expected, span: Span },
    /// The scenario's end.
    End,
}

/// `set location := value;`
#[derive(Debug, Clone)]
pub(crate) struct Set {
    pub function: FunctionId,
    pub arguments: Vec<Expression>,
    pub value: Expression,
    pub span: Span,
}

/// `pick $x in r_R := value;`
#[derive(Debug, Clone)]
pub(crate) struct Pick {
    pub variable: String,
    /// The choose rules meant, with the place of the variable among those they bind.
    pub choices: Vec<(Span, usize)>,
    pub value: Expression,
    pub span: Span,
}

/// What is done between two steps.
#[derive(Debug, Clone)]
pub(crate) enum Action {
    Check { strict: bool, formula: Expression, span: Span },
    Exec { procedure: ProcedureId, span: Span },
}

impl Action {
    /// Where it is written.
    pub fn span(&self) -> Span {
        match self {
            Action::Check { span, .. } | Action::Exec { span, .. } => *span,
        }
    }
}

impl Script {
    /// The places of all commands, in the order in which groups are played.
    pub fn places(&self) -> Vec<Span> {
        let of_group = |group: &Group| {
            let parts = &group.parts;
            let sets = parts.sets.iter().map(|set| set.span);
            let rest = parts.actions.iter().map(Action::span).chain(parts.picks.iter().map(|pick| pick.span));
            let step = match &group.step {
                StepKind::Steps { span, .. } | StepKind::Until { span, .. } | StepKind::Trouble { span, .. } => {
                    Some(*span)
                }
                StepKind::End => None,
            };
            sets.chain(rest).chain(step).collect::<Vec<Span>>()
        };
        self.groups.iter().flat_map(of_group).collect()
    }
}
