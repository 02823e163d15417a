//! Why a step could not be made: faults of the model at run time.
//!
//! A fault is always the model's, never a bug of this program. It names its place in the text and the values there. After a
//! fault, the state is the one before the step.

use std::fmt;

use program::{DomainId, FunctionId, Program};
use syntax::Span;

use crate::interrupt::Cause;
use crate::location::Location;
use crate::print::Show;
use crate::value::Value;

/// One of the two sides of a clash: the value and the rule that wrote it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ClashSide {
    /// The value.
    pub value: Value,
    /// The update rule.
    pub span: Span,
}

/// A fault, its place, and the calls that led there.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fault {
    /// What happened.
    pub kind: FaultKind,
    /// Where: the term or rule.
    pub span: Span,
    /// The rule and function calls that led there, innermost first; long chains are cut in the middle.
    pub calls: Vec<Span>,
}

/// The kind of a fault, as far as an explorer of many steps tells kinds apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum FaultClass {
    /// An inconsistent update.
    Inconsistent,
    /// A value outside its domain.
    OutOfDomain,
    /// Anything else that has no meaning: an undefined guard, a division by zero.
    Undefined,
}

impl FaultClass {
    /// The class of a fault.
    pub fn of(fault: &Fault) -> FaultClass {
        match fault.kind {
            FaultKind::InconsistentUpdate { .. } => FaultClass::Inconsistent,
            FaultKind::OutOfDomain { .. } => FaultClass::OutOfDomain,
            _ => FaultClass::Undefined,
        }
    }
}

/// What happened.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum FaultKind {
    /// Two rules write different values to one location in one step.
    InconsistentUpdate {
        /// The location.
        location: Location,
        /// The first side, in the order of evaluation.
        first: ClashSide,
        /// The second side.
        second: ClashSide,
    },
    /// An update's value is not in the function's codomain.
    OutOfDomain {
        /// The location.
        location: Location,
        /// The value.
        value: Value,
        /// The codomain.
        domain: DomainId,
    },
    /// A guard or condition is neither true nor false.
    UndefinedGuard,
    /// An operand of an operation is undefined.
    UndefinedOperand {
        /// The operation, as written.
        operation: String,
    },
    /// The operands of an operation are outside its domain; the sentence says which.
    BadOperand {
        /// What is wrong, e.g. `index 7 is outside a sequence of length 3`.
        reason: String,
    },
    /// Division by zero.
    DivisionByZero,
    /// The result is no 64-bit integer.
    Overflow {
        /// The operation with its operands, e.g. `9223372036854775807 + 1`.
        operation: String,
    },
    /// The result is no number.
    NotANumber {
        /// The operation.
        operation: String,
    },
    /// A domain that is infinite, or whose contents are undefined, was enumerated.
    NotEnumerable {
        /// The domain.
        domain: DomainId,
    },
    /// A static or derived function without definition was evaluated.
    NoDefinition {
        /// The function.
        function: FunctionId,
    },
    /// A variable was read outside the scope that binds it.
    Unbound,
    /// An agent has no program, or a value that is no rule was run.
    NotARule {
        /// The value.
        value: Value,
    },
    /// A rule value was run with the wrong number of arguments.
    WrongArguments {
        /// How many were given.
        given: usize,
        /// How many it takes.
        expected: usize,
    },
    /// A temporal operator has no value in a single state.
    Temporal,
    /// A limit was reached; see [`crate::Limits`].
    Limit {
        /// Which, e.g. `iterations`.
        limit: &'static str,
        /// Its value.
        value: u64,
    },
    /// The step was to stop: see [`crate::Interrupt`].
    Interrupted(Cause),
    /// The environment could not give a value.
    Environment {
        /// Its sentence.
        reason: String,
    },
    /// The model has no main rule.
    NoMain,
}

impl FaultKind {
    /// The kebab-case name of the kind, which names its page in spec/faults/.
    pub fn id(&self) -> &'static str {
        match self {
            FaultKind::InconsistentUpdate { .. } => "inconsistent-update",
            FaultKind::OutOfDomain { .. } => "value-outside-domain",
            FaultKind::UndefinedGuard => "undefined-guard",
            FaultKind::UndefinedOperand { .. } => "undefined-operand",
            FaultKind::BadOperand { .. } => "bad-operand",
            FaultKind::DivisionByZero => "division-by-zero",
            FaultKind::Overflow { .. } => "integer-overflow",
            FaultKind::NotANumber { .. } => "not-a-number",
            FaultKind::NotEnumerable { .. } => "domain-not-enumerable",
            FaultKind::NoDefinition { .. } => "no-definition",
            FaultKind::Unbound => "unbound-variable",
            FaultKind::NotARule { .. } => "not-runnable",
            FaultKind::WrongArguments { .. } => "wrong-arguments",
            FaultKind::Temporal => "temporal-operator",
            FaultKind::Limit { .. } => "limit-reached",
            FaultKind::Interrupted(Cause::Asked) => "interrupted",
            FaultKind::Interrupted(Cause::Memory) => "limit-reached",
            FaultKind::Environment { .. } => "no-input",
            FaultKind::NoMain => "no-main-rule",
        }
    }
}

impl FaultKind {
    /// Whether the model is at fault, whatever the environment and the limits.
    pub fn is_of_the_model(&self) -> bool {
        match self {
            FaultKind::Limit { .. } | FaultKind::Interrupted(_) | FaultKind::Environment { .. } => false,
            FaultKind::InconsistentUpdate { .. }
            | FaultKind::OutOfDomain { .. }
            | FaultKind::UndefinedGuard
            | FaultKind::UndefinedOperand { .. }
            | FaultKind::BadOperand { .. }
            | FaultKind::DivisionByZero
            | FaultKind::Overflow { .. }
            | FaultKind::NotANumber { .. }
            | FaultKind::NotEnumerable { .. }
            | FaultKind::NoDefinition { .. }
            | FaultKind::Unbound
            | FaultKind::NotARule { .. }
            | FaultKind::WrongArguments { .. }
            | FaultKind::Temporal
            | FaultKind::NoMain => true,
        }
    }
}

impl Fault {
    /// The fault as one sentence.
    pub fn show<'a>(&'a self, program: &'a Program) -> impl fmt::Display + 'a {
        ShowFault { fault: self, program }
    }
}

struct ShowFault<'a> {
    fault: &'a Fault,
    program: &'a Program,
}

impl fmt::Display for ShowFault<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let program = self.program;
        match &self.fault.kind {
            FaultKind::InconsistentUpdate { location, first, second } => write!(
                f,
                "inconsistent update: {} is set to {} and to {} in one step",
                location.show(program),
                first.value.show(program).briefly(),
                second.value.show(program).briefly()
            ),
            FaultKind::OutOfDomain { location, value, domain } => write!(
                f,
                "{} is not in {}, the domain of {}",
                value.show(program).briefly(),
                program.domain(*domain).name,
                location.show(program)
            ),
            FaultKind::UndefinedGuard => f.write_str("the condition is undef, neither true nor false"),
            FaultKind::UndefinedOperand { operation } => write!(f, "{operation} of undef"),
            FaultKind::BadOperand { reason } => f.write_str(reason),
            FaultKind::DivisionByZero => f.write_str("division by zero"),
            FaultKind::Overflow { operation } => write!(f, "integer overflow: {operation} is beyond 64 bits"),
            FaultKind::NotANumber { operation } => write!(f, "{operation} is not a number"),
            FaultKind::NotEnumerable { domain } => {
                write!(f, "the elements of {} cannot be enumerated", program.domain(*domain).name)
            }
            FaultKind::NoDefinition { function } => {
                write!(f, "`{}` has no definition", program.function(*function).name)
            }
            FaultKind::Unbound => f.write_str("the variable is not bound here"),
            FaultKind::NotARule { value } => {
                write!(f, "{} is not a rule that can be run", value.show(program).briefly())
            }
            FaultKind::WrongArguments { given, expected } => {
                write!(f, "the rule takes {expected} arguments, {given} are given")
            }
            FaultKind::Temporal => f.write_str("a temporal operator has no value in a single state"),
            FaultKind::Limit { limit, value } => write!(f, "the limit of {value} {limit} is reached"),
            FaultKind::Interrupted(Cause::Asked) => f.write_str("the step was interrupted"),
            FaultKind::Interrupted(Cause::Memory) => f.write_str("the limit of memory is reached"),
            FaultKind::Environment { reason } => f.write_str(reason),
            FaultKind::NoMain => f.write_str("the model has no main rule to run"),
        }
    }
}
