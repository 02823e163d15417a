//! Why a step has no next state: either a term has no value or the update set is not consistent.
//!
//! The kinds and their names are the language's (spec/faults); places and call chains are left to the machine.

use crate::state::{Clash, Location, UpdateSet};
use crate::value::Value;

/// A fault.
#[derive(Debug, Clone, PartialEq, Eq)]
#[allow(missing_docs, reason = "each is described in spec/faults under its name")]
pub enum Fault {
    /// All of them: the language leaves open which one is reported.
    Clash(Vec<Clash>),
    OutOfDomain {
        location: Location,
        value: Value,
    },
    UndefinedGuard,
    UndefinedOperand(String),
    BadOperand(String),
    DivisionByZero,
    Overflow,
    NotANumber,
    NotEnumerable,
    NoDefinition,
    Unbound,
    NotARule(Value),
    WrongArguments,
    Temporal,
    Limit,
    Environment(String),
    NoMain,
}

impl Fault {
    /// The name of the kind.
    pub fn id(&self) -> &'static str {
        match self {
            Fault::Clash(_) => "inconsistent-update",
            Fault::OutOfDomain { .. } => "value-outside-domain",
            Fault::UndefinedGuard => "undefined-guard",
            Fault::UndefinedOperand(_) => "undefined-operand",
            Fault::BadOperand(_) => "bad-operand",
            Fault::DivisionByZero => "division-by-zero",
            Fault::Overflow => "integer-overflow",
            Fault::NotANumber => "not-a-number",
            Fault::NotEnumerable => "domain-not-enumerable",
            Fault::NoDefinition => "no-definition",
            Fault::Unbound => "unbound-variable",
            Fault::NotARule(_) => "not-runnable",
            Fault::WrongArguments => "wrong-arguments",
            Fault::Temporal => "temporal-operator",
            Fault::Limit => "limit-reached",
            Fault::Environment(_) => "no-input",
            Fault::NoMain => "no-main-rule",
        }
    }
}

/// The evaluation of a rule that met a fault, and what it had yielded until then.
///
/// The book leaves `yields` undefined if a part has no value, and calls an update set inconsistent only when it is
/// complete. If both occur, the language reports the one met first, from left to right. So the updates yielded before
/// the fault are kept until their unit is known.
#[derive(Debug, Clone)]
pub struct Stop {
    /// What happened.
    pub fault: Fault,
    /// The updates yielded before.
    pub before: UpdateSet,
}

impl From<Fault> for Stop {
    fn from(fault: Fault) -> Stop {
        Stop { fault, before: UpdateSet::empty() }
    }
}

/// U ∪ V, where V may have stopped.
pub fn join(updates: UpdateSet, more: Result<UpdateSet, Stop>) -> Result<UpdateSet, Stop> {
    match more {
        Ok(more) => Ok(updates.union(more)),
        Err(stop) => Err(Stop { fault: stop.fault, before: updates.union(stop.before) }),
    }
}

/// The update set of a unit that is fired on its own (a step, a part of a sequence, a turbo call): it must be
/// consistent.
pub fn consistent(result: Result<UpdateSet, Stop>) -> Result<UpdateSet, Fault> {
    let (updates, fault) = match result {
        Ok(updates) => (updates, None),
        Err(stop) => (stop.before, Some(stop.fault)),
    };
    let clashes = updates.clashes();
    match fault {
        _ if !clashes.is_empty() => Err(Fault::Clash(clashes)),
        Some(fault) => Err(fault),
        None => Ok(updates),
    }
}
