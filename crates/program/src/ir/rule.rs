//! Rules of the IR (Börger & Stärk 2003, tables 2.2 and 4.1).
//!
//! INVARIANT: a child's index is below its parent's; the bodies of procedures are reached by [`ProcedureId`].

use model::{DomainId, FunctionId};

use crate::ir::{BinderList, ProcedureId, RuleId, RuleList, Slot, TermId, TermList};

/// A rule of the IR. Its span stands in [`Program::rule_spans`](crate::Program::rule_spans).
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
    /// A macro call: the procedure's first slots are set to the arguments. It is not a unit of its own: its updates are
    /// those of the caller.
    Call {
        /// The procedure.
        procedure: ProcedureId,
        /// Values of its parameters.
        arguments: TermList,
    },
    /// A turbo call: the arguments by value, the body as one unit (its update set is computed, then joined).
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
    /// The program of an agent, with `self` bound to it within.
    RunAgent {
        /// The agent.
        agent: TermId,
    },
    /// All in parallel.
    Par(RuleList),
    /// In sequence, as one unit.
    Seq(RuleList),
    /// guard\[i\] → rule\[i\]; the rules list may hold one more: the `else`.
    If {
        /// The guards.
        guards: TermList,
        /// The rules.
        rules: RuleList,
    },
    /// value\[i\] → rule\[i\]; the rules list may hold one more: the `otherwise`.
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
        /// The rule it is bound in.
        body: RuleId,
    },
    /// One choice.
    Choose {
        /// What is ranged over, leftmost slowest.
        binders: BinderList,
        /// Only where this holds.
        condition: Option<TermId>,
        /// The rule run with the choice.
        body: RuleId,
        /// The rule run where there is none.
        if_none: Option<RuleId>,
    },
    /// All in parallel.
    Forall {
        /// What is ranged over, leftmost slowest.
        binders: BinderList,
        /// Only where this holds.
        condition: Option<TermId>,
        /// The rule run for each.
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
    /// Local functions: reset, the initialisations in sequence, then the body; as one unit, after which the
    /// updates of the locals are dropped and their former values restored.
    Local {
        /// The functions, a range of [`Program::function_lists`](crate::Program::function_lists).
        start: u32,
        /// How many.
        len: u32,
        /// One initialisation a function.
        initialisations: RuleList,
        /// The rule they are local to.
        body: RuleId,
    },
}

/// What a rule runs that does not stand in it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Runs {
    /// Nothing.
    Nothing,
    /// A procedure.
    Procedure(ProcedureId),
    /// The rule that a term's value is, with as many arguments.
    Value {
        /// The arguments.
        arguments: TermList,
    },
    /// The program of an agent.
    Agent,
}

impl Rule {
    /// What it runs besides the rules that stand in it.
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
