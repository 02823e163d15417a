//! A whole program: the tables of domains, functions, procedures and properties, and the arenas.
//!
//! INVARIANT: the tables of domains and functions are in the order of the model's ids; see [`crate::ir`] for the
//! arenas.

use std::borrow::Cow;

use model::{DomainId, FunctionId, FunctionKind, Literal, PropertyKind};
use syntax::Span;

use crate::ir::Specialisations;
use crate::ir::{Binder, BinderList, ProcedureId, Rule, RuleId, RuleList, Term, TermId, TermList};

/// A rule with a frame of its own: a (specialised) macro rule, a turbo rule, the main rule, a fragment.
#[derive(Debug, Clone, PartialEq)]
pub struct Procedure {
    /// The name of the rule it comes from.
    pub name: String,
    /// The model's rule, if it is one.
    pub rule: Option<model::RuleId>,
    /// Whether it is called by value, as one unit.
    pub turbo: bool,
    /// The domains of its parameters, which are its first slots.
    pub parameters: Vec<DomainId>,
    /// The number of slots of its frame.
    pub frame: u32,
    /// The name of each slot as the model writes it, with its `$`; not always distinct.
    pub names: Vec<String>,
    /// The body.
    pub body: RuleId,
    /// Where it is declared.
    pub span: Span,
}

/// A term with a frame of its own: a definition, an initial value, a formula.
#[derive(Debug, Clone, PartialEq)]
pub struct Expression {
    /// The domains of its parameters, which are its first slots.
    pub parameters: Vec<DomainId>,
    /// The number of slots of its frame.
    pub frame: u32,
    /// The name of each slot as the model writes it, with its `$`; not always distinct.
    pub names: Vec<String>,
    /// The term.
    pub body: TermId,
}

/// A function.
#[derive(Debug, Clone, PartialEq)]
pub struct Function {
    /// The name.
    pub name: String,
    /// The kind.
    pub kind: FunctionKind,
    /// Parameter domains.
    pub parameters: Vec<DomainId>,
    /// The domain of its values.
    pub codomain: DomainId,
    /// The definition of a static or derived one.
    pub definition: Option<Expression>,
    /// For a 0-ary static function of an abstract domain: the number of its element in the base domain, from 0.
    pub element: Option<u32>,
    /// Whether a built-in library declares it.
    pub library: bool,
    /// Whether the model's own file sees it: what an export list hides can be named neither there nor in a scenario.
    pub seen: bool,
    /// The name of the file's machine that declares it.
    pub module: String,
    /// It is hidden, and another function with as many parameters has its name: runs tell it as `MODULE.f`.
    pub qualified: bool,
    /// Where it is declared.
    pub span: Span,
}

impl Function {
    /// The name by which runs are told: no other function of as many parameters has it.
    pub fn shown(&self) -> Cow<'_, str> {
        match self.qualified {
            true => format!("{}.{}", self.module, self.name).into(),
            false => self.name.as_str().into(),
        }
    }
}

/// What a run needs to know of a domain, to list its elements, test membership and print values.
#[derive(Debug, Clone, PartialEq)]
pub struct Domain {
    /// The domain as a model would write it.
    pub name: String,
    /// What it is.
    pub kind: DomainKind,
    /// Whether the model's own file sees its literals, or the names of its elements.
    pub seen: bool,
}

/// What a domain is at run time.
#[derive(Debug, Clone, PartialEq)]
pub enum DomainKind {
    /// Never has a value: an unresolved domain.
    Error,
    /// Any value.
    Any,
    /// See [`model::Basic`].
    Basic(model::Basic),
    /// Enumeration; literals in order.
    Enum {
        /// Their names.
        literals: Vec<String>,
    },
    /// Abstract. The elements that static functions name come first, in order of declaration.
    Abstract {
        /// Names of the static elements.
        elements: Vec<String>,
        /// Whether it may grow.
        dynamic: bool,
    },
    /// Concrete.
    Concrete {
        /// The type domain.
        base: DomainId,
        /// Whether its contents are part of the state.
        dynamic: bool,
        /// The static elements declared with it (indices into the base's elements).
        elements: Vec<u32>,
        /// The defining term (static, or initial for a dynamic one).
        contents: Option<Expression>,
    },
    /// Product.
    Prod(Vec<DomainId>),
    /// Sequences.
    Seq(DomainId),
    /// Sets.
    Powerset(DomainId),
    /// Bags.
    Bag(DomainId),
    /// Maps.
    Map(DomainId, DomainId),
    /// Rules.
    Rule(Vec<DomainId>),
}

/// A property or an assumption.
#[derive(Debug, Clone, PartialEq)]
pub struct Property {
    /// Which.
    pub kind: PropertyKind,
    /// Its name.
    pub name: String,
    /// The formula.
    pub formula: Expression,
    /// The second formula of a compassion.
    pub conclusion: Option<Expression>,
    /// Whether it reads a monitored function, directly or through definitions.
    pub reads_monitored: bool,
    /// Where it is written.
    pub span: Span,
}

/// The initial value of a function, as a term over its arguments.
#[derive(Debug, Clone, PartialEq)]
pub struct Initial {
    /// The function.
    pub function: FunctionId,
    /// The value.
    pub value: Expression,
    /// Where it is written.
    pub span: Span,
}

/// The program of the agents of a domain.
#[derive(Debug, Clone, PartialEq)]
pub struct AgentProgram {
    /// `Agent` or a subset of it.
    pub domain: DomainId,
    /// The program.
    pub procedure: ProcedureId,
}

/// A whole program.
#[derive(Debug, Clone, Default)]
pub struct Program {
    /// The machine's name.
    pub name: String,
    /// Whether agents interleave.
    pub asynchronous: bool,
    /// Domains, by the model's ids.
    pub domains: Vec<Domain>,
    /// Functions, by the model's ids.
    pub functions: Vec<Function>,
    /// The constant pool.
    pub constants: Vec<Literal>,
    /// The arena of terms.
    pub terms: Vec<Term>,
    /// The domain of each term.
    pub term_domains: Vec<DomainId>,
    /// The place of each term.
    pub term_spans: Vec<Span>,
    /// The arena of rules.
    pub rules: Vec<Rule>,
    /// The place of each rule.
    pub rule_spans: Vec<Span>,
    /// Children of terms.
    pub term_lists: Vec<TermId>,
    /// Children of rules.
    pub rule_lists: Vec<RuleId>,
    /// Binders.
    pub binder_lists: Vec<Binder>,
    /// Functions of local rules.
    pub function_lists: Vec<FunctionId>,
    /// Procedures.
    pub procedures: Vec<Procedure>,
    /// The main rule.
    pub main: Option<ProcedureId>,
    /// Initial values, in order. A library function such as `self` has none.
    pub initials: Vec<Initial>,
    /// Programs of agents, those of more specific domains first. An agent runs the first whose domain contains it.
    pub agents: Vec<AgentProgram>,
    /// Properties and assumptions.
    pub properties: Vec<Property>,
    /// The library function `self`, if the model imports it.
    pub self_function: Option<FunctionId>,
    /// The library function `result`, if the model imports it.
    pub result_function: Option<FunctionId>,
    /// The procedures of rules with their arguments, for fragments that are added later.
    pub specialisations: Specialisations,
}

impl Program {
    /// Whether it is another program with more terms, which no rule and no definition of the other has: with other
    /// conditions, that is.
    pub fn extends(&self, other: &Program) -> bool {
        self.asynchronous == other.asynchronous
            && self.domains == other.domains
            && self.functions == other.functions
            && self.constants.starts_with(&other.constants)
            && self.terms.starts_with(&other.terms)
            && self.term_domains.starts_with(&other.term_domains)
            && self.rules == other.rules
            && self.term_lists.starts_with(&other.term_lists)
            && self.rule_lists == other.rule_lists
            && self.binder_lists.starts_with(&other.binder_lists)
            && self.function_lists == other.function_lists
            && self.procedures == other.procedures
            && self.main == other.main
            && self.initials == other.initials
            && self.agents == other.agents
            && self.self_function == other.self_function
            && self.result_function == other.result_function
    }

    /// Adds a term, whose children are there.
    pub fn add_term(&mut self, term: Term, domain: DomainId, span: Span) -> TermId {
        self.terms.push(term);
        self.term_domains.push(domain);
        self.term_spans.push(span);
        TermId(self.terms.len() as u32 - 1)
    }

    /// The term of that id.
    pub fn term(&self, id: TermId) -> &Term {
        &self.terms[id.0 as usize]
    }
    /// The rule of that id.
    pub fn rule(&self, id: RuleId) -> &Rule {
        &self.rules[id.0 as usize]
    }
    /// The terms of a list.
    pub fn term_list(&self, list: TermList) -> &[TermId] {
        &self.term_lists[list.start as usize..(list.start + list.len) as usize]
    }
    /// The rules of a list.
    pub fn rule_list(&self, list: RuleList) -> &[RuleId] {
        &self.rule_lists[list.start as usize..(list.start + list.len) as usize]
    }
    /// The binders of a list.
    pub fn binder_list(&self, list: BinderList) -> &[Binder] {
        &self.binder_lists[list.start as usize..(list.start + list.len) as usize]
    }
    /// The place of a term.
    pub fn term_span(&self, id: TermId) -> Span {
        self.term_spans[id.0 as usize]
    }
    /// The place of a rule.
    pub fn rule_span(&self, id: RuleId) -> Span {
        self.rule_spans[id.0 as usize]
    }
    /// The domain of a term.
    pub fn term_domain(&self, id: TermId) -> DomainId {
        self.term_domains[id.0 as usize]
    }
    /// The function of that id.
    pub fn function(&self, id: FunctionId) -> &Function {
        &self.functions[id.0 as usize]
    }
    /// The domain of that id.
    pub fn domain(&self, id: DomainId) -> &Domain {
        &self.domains[id.0 as usize]
    }
    /// The type domain of a domain; for a concrete one, the domain of which it is a subset.
    pub fn base_domain(&self, id: DomainId) -> DomainId {
        match self.domain(id).kind {
            DomainKind::Concrete { base, .. } => base,
            _ => id,
        }
    }
    /// The procedure of that id.
    pub fn procedure(&self, id: ProcedureId) -> &Procedure {
        &self.procedures[id.0 as usize]
    }
    /// The function with this name and number of parameters. If there are several, it is the one declared last.
    pub fn find_function(&self, name: &str, arity: usize) -> Option<FunctionId> {
        let found = self.functions.iter().rposition(|f| f.name == name && f.parameters.len() == arity);
        found.map(|index| FunctionId(index as u32))
    }
}
