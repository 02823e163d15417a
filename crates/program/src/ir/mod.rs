//! The types of the IR.
//!
//! Terms and rules are kept in arenas and refer to each other by index. Lists of children are ranges of one shared
//! array. INVARIANT (checked by [`crate::verify()`]): every index is within its table; a child's index is below its
//! parent's; a slot is below the frame size of its procedure, and only one place binds it; argument counts match;
//! terms and rules nest no deeper than [`MAX_DEPTH`].
//!
//! Domain and function ids are those of the model, so a fault found here can refer to the model.

mod elements;
mod program;
mod rule;
mod specialisation;
mod term;
mod updated;
mod visit;

pub use program::{AgentProgram, Domain, DomainKind, Expression, Function, Initial, Procedure, Program, Property};
pub use rule::{Rule, Runs};
pub(crate) use specialisation::ArgumentId;
pub use specialisation::Specialisations;
pub use term::Term;

/// LIMIT: the depth to which terms and rules nest in one procedure or expression.
pub const MAX_DEPTH: u32 = 4096;

/// Names a term of the arena.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct TermId(pub u32);

/// Names a rule of the arena.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct RuleId(pub u32);

/// Names a procedure: a rule with its own frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ProcedureId(pub u32);

/// A variable's place in the frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Slot(pub u32);

/// A list of term ids, a range of [`Program::term_lists`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct TermList {
    /// First index.
    pub start: u32,
    /// How many.
    pub len: u32,
}

/// A list of rule ids, a range of [`Program::rule_lists`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct RuleList {
    /// First index.
    pub start: u32,
    /// How many.
    pub len: u32,
}

/// `slot in range`, in quantifiers, comprehensions, choose and forall.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Binder {
    /// The bound variable.
    pub slot: Slot,
    /// The range: often a [`Term::Domain`].
    pub range: TermId,
}

/// A list of binders, a range of [`Program::binder_lists`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct BinderList {
    /// First index.
    pub start: u32,
    /// How many.
    pub len: u32,
}
