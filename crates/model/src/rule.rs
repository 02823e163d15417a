//! Rules with every name resolved (spec/language.md, section 7; Börger & Stärk 2003, sections 2.2 and 4.1).

use syntax::Span;

use crate::id::DomainId;
use crate::id::{FunctionId, RuleId, VariableId};
use crate::term::{Binder, Term};

/// A rule and its place.
#[derive(Debug, Clone)]
pub struct RuleNode {
    /// What it is.
    pub kind: RuleKind,
    /// Where it is written.
    pub span: Span,
}

/// What an update or a turbo return writes to.
#[derive(Debug, Clone)]
pub enum Target {
    /// A location: a dynamic function applied to arguments.
    Location {
        /// The function.
        function: FunctionId,
        /// One term a parameter.
        arguments: Vec<Term>,
        /// Where it is written.
        span: Span,
    },
    /// A location parameter of the enclosing macro rule: the location that the caller's argument names.
    Parameter(VariableId, Span),
}

/// A rule applied to arguments.
#[derive(Debug, Clone)]
pub struct Call {
    /// The rule, overloads resolved.
    pub rule: RuleId,
    /// One term for each parameter: by name for macro rules, by value for turbo rules.
    pub arguments: Vec<Term>,
}

/// What a rule is.
#[derive(Debug, Clone)]
pub enum RuleKind {
    /// Does nothing.
    Skip,
    /// `target := value`
    Update {
        /// The location.
        target: Target,
        /// The new value.
        value: Term,
    },
    /// `r_x[…]`: call by name of a macro rule.
    MacroCall(Call),
    /// `r_x(…)`: call by value of a turbo rule.
    TurboCall(Call),
    /// `target <- r_x(…)`
    Return {
        /// The location that takes the result.
        target: Target,
        /// The turbo call.
        call: Call,
    },
    /// A rule value, run with arguments: `$r[…]`, `f(x)[…]`.
    RunValue {
        /// The term whose value is a rule.
        rule: Term,
        /// A term for each parameter, by value.
        arguments: Vec<Term>,
    },
    /// `program(a)`: the program of the agent, run with `self` = a.
    RunAgent {
        /// The agent.
        agent: Term,
    },
    /// All in parallel.
    Par(Vec<RuleNode>),
    /// One after the other within one step; the composition is turbo (Börger & Stärk, definition 4.1.1).
    Seq(Vec<RuleNode>),
    /// The first branch whose guard holds.
    If {
        /// Guards and rules in order.
        branches: Vec<(Term, RuleNode)>,
        /// Where no guard holds.
        otherwise: Option<Box<RuleNode>>,
    },
    /// The first case whose value equals the subject's.
    Switch {
        /// The term compared.
        subject: Term,
        /// Values and rules in order.
        cases: Vec<(Term, RuleNode)>,
        /// Where no case matches.
        otherwise: Option<Box<RuleNode>>,
    },
    /// `let (…) in … endlet`
    Let {
        /// Variables and their terms; a later one may use an earlier one.
        bindings: Vec<(VariableId, Term)>,
        /// The rule they are bound in.
        body: Box<RuleNode>,
    },
    /// For one choice of values, if there is one.
    Choose {
        /// The ranges; the leftmost varies slowest.
        binders: Vec<Binder>,
        /// Only where this holds.
        condition: Option<Term>,
        /// The rule to run with the chosen values.
        body: Box<RuleNode>,
        /// The rule to run if no values fulfil the condition.
        if_none: Option<Box<RuleNode>>,
    },
    /// For all values in parallel.
    Forall {
        /// The ranges; the leftmost varies slowest.
        binders: Vec<Binder>,
        /// Only where this holds.
        condition: Option<Term>,
        /// The rule run for each.
        body: Box<RuleNode>,
    },
    /// With new elements of a dynamic domain.
    Extend {
        /// The domain: dynamic abstract, or dynamic concrete over an abstract one.
        domain: DomainId,
        /// A variable for each fresh element.
        variables: Vec<VariableId>,
        /// The rule that sees them.
        body: Box<RuleNode>,
    },
    /// Until the rule's update set is empty.
    Iterate(Box<RuleNode>),
    /// `while condition do body`: in sequence while the condition holds and the body's update set is not empty.
    While {
        /// The condition.
        condition: Term,
        /// The body.
        body: Box<RuleNode>,
    },
    /// `whilerec condition do body`: recursive while, until the condition is false. It may never end.
    RecursiveWhile {
        /// The condition.
        condition: Term,
        /// The body.
        body: Box<RuleNode>,
    },
    /// Local functions with their initialisation, and the rule they are local to
    /// (Börger & Stärk, section 4.1.2, "turbo submachines with local state").
    Local {
        /// The functions in order, each with the rule that initialises it.
        locals: Vec<(FunctionId, RuleNode)>,
        /// The rule they are local to.
        body: Box<RuleNode>,
    },
    /// Replaces a rule that a reported fault left out.
    Error,
}
