//! What a model declares: functions and rules with their variables.

use syntax::Span;

use crate::id::{DomainId, VariableId};
use crate::rule::RuleNode;
use crate::term::Term;

/// A logical variable.
#[derive(Debug, Clone)]
pub struct Variable {
    /// The name with its `$`; a made one starts with `$$`.
    pub name: String,
    /// The domain of its values.
    pub domain: DomainId,
    /// Where it is bound.
    pub span: Span,
}

/// Who may change a function, and when (Börger & Stärk 2003, section 2.2.3).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum FunctionKind {
    /// Never changes; defined by a term, by the library, or (0-ary, abstract) an element of its domain.
    Static,
    /// Defined by a term over the state.
    Derived,
    /// Written by the environment.
    Monitored,
    /// Written by the machine.
    Controlled,
    /// Written by both.
    Shared,
    /// Written by the machine and not read by it.
    Out,
    /// Of a turbo rule with local state.
    Local,
}

/// A function.
#[derive(Debug, Clone)]
pub struct Function {
    /// The name.
    pub name: String,
    /// The kind.
    pub kind: FunctionKind,
    /// Parameter domains; a declared product is taken apart into its components.
    pub parameters: Vec<DomainId>,
    /// The domain of its values.
    pub codomain: DomainId,
    /// The defining term of a static or derived function.
    pub definition: Option<Definition>,
    /// Declared in a built-in library file; without a definition its meaning is the machine's
    /// (named by `name`, `parameters` and `codomain`).
    pub library: bool,
    /// Where it is declared.
    pub span: Span,
}

/// A defining term with its parameters.
#[derive(Debug, Clone)]
pub struct Definition {
    /// All variables of this definition.
    pub variables: Vec<Variable>,
    /// The parameters, a prefix of the variables.
    pub parameters: Vec<VariableId>,
    /// The term.
    pub body: Term,
}

/// A declared rule.
#[derive(Debug, Clone)]
pub struct Rule {
    /// The name.
    pub name: String,
    /// A turbo rule: called by value, atomic.
    pub turbo: bool,
    /// All variables of this declaration.
    pub variables: Vec<Variable>,
    /// The parameters, a prefix of the variables.
    pub parameters: Vec<VariableId>,
    /// The domain of a turbo rule's result.
    pub result: Option<DomainId>,
    /// The body.
    pub body: RuleNode,
    /// Where the name is declared.
    pub span: Span,
}
