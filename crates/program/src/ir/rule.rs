//! Rules of the IR (Börger & Stärk 2003, tables 2.2 and 4.1).
//!
//! INVARIANT: a child's index is below its parent's. A [`ProcedureId`] leads to the body of a procedure.

use model::{DomainId, FunctionId};

use crate::ir::{BinderList, ProcedureId, RuleId, RuleList, Slot, TermId, TermList};

/// A rule of the IR. [`Program::rule_spans`](crate::Program::rule_spans) has its span.
#[derive(Debug, Clone, PartialEq)]
pub enum Rule {
    /// Nothing.
    Skip,
    /// `function(arguments) := value`
    Update {
        /// The function.
        function: FunctionId,
        /// The location's arguments.
        arguments: TermList,
        /// The new value.
        value: TermId,
    },
    /// A macro call: sets the procedure's first slots to the arguments. It is not a unit of its own: its updates belong
    /// to the caller.
    Call {
        /// The procedure.
        procedure: ProcedureId,
        /// Values of its parameters.
        arguments: TermList,
    },
    /// A turbo call: passes the arguments by value and runs the body as one unit, whose update set then joins the caller's.
    TurboCall {
        /// The procedure.
        procedure: ProcedureId,
        /// Values of its parameters.
        arguments: TermList,
    },
    /// `function(target) <- procedure(arguments)`: a turbo call whose result becomes an update of the target.
    Return {
        /// The function that takes the result.
        function: FunctionId,
        /// The location's arguments.
        target: TermList,
        /// The procedure.
        procedure: ProcedureId,
        /// Values of its parameters.
        arguments: TermList,
    },
    /// A rule value, run with arguments.
    RunValue {
        /// The term whose value is a rule.
        rule: TermId,
        /// Values of its parameters.
        arguments: TermList,
    },
    /// The program of an agent; within it, `self` is the agent.
    RunAgent {
        /// The agent.
        agent: TermId,
    },
    /// All in parallel.
    Par(RuleList),
    /// In sequence, as one unit.
    Seq(RuleList),
    /// guard\[i\] → rule\[i\]. The list of rules may have one more: the `else`.
    If {
        /// The guards.
        guards: TermList,
        /// The rules.
        rules: RuleList,
    },
    /// value\[i\] → rule\[i\]. The list of rules may have one more: the `otherwise`.
    Switch {
        /// The term compared.
        subject: TermId,
        /// The values compared with.
        values: TermList,
        /// The rules.
        rules: RuleList,
    },
    /// One binding; several are nested.
    Let {
        /// The variable.
        slot: Slot,
        /// Its value.
        value: TermId,
        /// The rule that can read it.
        body: RuleId,
    },
    /// One choice.
    Choose {
        /// The ranges; the leftmost varies slowest.
        binders: BinderList,
        /// The condition on the values.
        condition: Option<TermId>,
        /// The rule to run with the chosen values.
        body: RuleId,
        /// The rule to run if no values fulfil the condition.
        if_none: Option<RuleId>,
    },
    /// All in parallel.
    Forall {
        /// The ranges; the leftmost varies slowest.
        binders: BinderList,
        /// The condition on the values.
        condition: Option<TermId>,
        /// The rule to run for each.
        body: RuleId,
    },
    /// With fresh elements: slots `first`, `first+1`, …
    Extend {
        /// The domain.
        domain: DomainId,
        /// The first of consecutive slots.
        first: Slot,
        /// How many elements.
        count: u32,
        /// The rule that sees them.
        body: RuleId,
    },
    /// Until the update set is empty, as one unit.
    Iterate(RuleId),
    /// While the condition holds and the body's update set is not empty, as one unit.
    While {
        /// The condition.
        condition: TermId,
        /// The body.
        body: RuleId,
    },
    /// While the condition holds, as one unit.
    RecursiveWhile {
        /// The condition.
        condition: TermId,
        /// The body.
        body: RuleId,
    },
    /// Local functions: resets them, runs the initialisations in sequence, then the body, all as one unit. At its end, it
    /// drops the updates of the local functions and restores their former values.
    Local {
        /// The functions, a range of [`Program::function_lists`](crate::Program::function_lists).
        start: u32,
        /// How many.
        len: u32,
        /// An initialisation for each function.
        initialisations: RuleList,
        /// The rule that can use them.
        body: RuleId,
    },
}

/// What a rule runs that is not written in it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Runs {
    /// Nothing.
    Nothing,
    /// A procedure.
    Procedure(ProcedureId),
    /// The rule that is the value of a term, with these arguments.
    Value {
        /// The arguments.
        arguments: TermList,
    },
    /// The program of an agent.
    Agent,
}

impl Rule {
    /// What it runs besides the rules written in it.
    pub fn runs(&self) -> Runs {
        match self {
            Rule::Call { procedure, .. } | Rule::TurboCall { procedure, .. } | Rule::Return { procedure, .. } => {
                Runs::Procedure(*procedure)
            }
            Rule::RunValue { arguments, .. } => Runs::Value { arguments: *arguments },
            Rule::RunAgent { .. } => Runs::Agent,
            Rule::Skip
            | Rule::Update { .. }
            | Rule::Par(_)
            | Rule::Seq(_)
            | Rule::If { .. }
            | Rule::Switch { .. }
            | Rule::Let { .. }
            | Rule::Choose { .. }
            | Rule::Forall { .. }
            | Rule::Extend { .. }
            | Rule::Iterate(_)
            | Rule::While { .. }
            | Rule::RecursiveWhile { .. }
            | Rule::Local { .. } => Runs::Nothing,
        }
    }
}
