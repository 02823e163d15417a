//! The checked model as a whole: tables of domains, functions and rules, properties and initial states.
//!
//! INVARIANT: ids index the tables of the model they come from. Tables are in the order of declaration, imported
//! files first, so that output made by walking them is the same every time.

use std::collections::BTreeMap;

use syntax::{Diagnostic, FileId, Parse, SourceFile, Sources, Span, Stop};

use crate::declaration::{Definition, Function, Rule, Variable};
use crate::domain::Domains;
use crate::id::{DomainId, FunctionId, RuleId};
use crate::names::Names;
use crate::term::Term;
use crate::uses::Uses;

/// Finds the texts of imported files; the shells implement it over a disk, tests over a map.
pub trait Loader {
    /// The text of `path`, as an import of `importer` has it. The loader adds `.asm` if it is missing, and accepts
    /// either slash as a separator. The error is a sentence for the user.
    fn load(&mut self, importer: &SourceFile, path: &str) -> Result<SourceFile, String>;

    /// The tree of a text; `file` is its id among the texts read. An implementation that keeps trees returns the one of the
    /// same text.
    fn parse(&mut self, file: FileId, source: &SourceFile) -> Parse {
        syntax::parse_asmetal(file, &source.text)
    }

    /// Checking ends early if this is asked, and what it gives is to be thrown away.
    fn stop(&self) -> Stop {
        Stop::default()
    }
}

/// The result of checking: as much as could be understood, even after faults.
#[derive(Debug, Clone)]
pub struct Checked {
    /// All texts read, the root first.
    pub sources: Sources,
    /// The model; complete when `diagnostics` hold no error.
    pub model: Model,
    /// Faults, in the order of files and positions.
    pub diagnostics: Vec<Diagnostic>,
}

/// A checked model.
#[derive(Debug, Clone)]
pub struct Model {
    /// The name after `asm` or `module`; empty for a file of comments alone.
    pub name: String,
    /// Its file.
    pub root: FileId,
    /// `asyncr` stands before `asm`: agents interleave.
    pub asynchronous: bool,
    /// All domains.
    pub domains: Domains,
    /// All functions.
    pub functions: Vec<Function>,
    /// All rules.
    pub rules: Vec<Rule>,
    /// The main rule; none for a library module.
    pub main: Option<RuleId>,
    /// Invariants, temporal properties and assumptions, those of imported files included, in order.
    pub properties: Vec<Property>,
    /// Initial states of the root file.
    pub inits: Vec<Init>,
    /// The index of the default one in `inits`.
    pub default_init: Option<usize>,
    /// The names of the modules that it is made of, by their files.
    pub modules: BTreeMap<FileId, String>,
    /// What the names of the root file mean, so that terms and rules from elsewhere (a scenario, a command line)
    /// can be read as if they stood in it.
    pub names: Names,
    /// What each name of the texts means, those of fragments included.
    pub uses: Uses,
}

impl Model {
    /// A model with the predefined domains and nothing else.
    pub fn empty(root: FileId) -> Self {
        Model {
            name: String::new(),
            root,
            asynchronous: false,
            domains: Domains::new(),
            functions: Vec::new(),
            rules: Vec::new(),
            main: None,
            properties: Vec::new(),
            inits: Vec::new(),
            default_init: None,
            modules: BTreeMap::new(),
            names: Names::default(),
            uses: Uses::default(),
        }
    }

    pub(crate) fn add_function(&mut self, function: Function) -> FunctionId {
        self.functions.push(function);
        FunctionId(self.functions.len() as u32 - 1)
    }

    /// The function of that id.
    pub fn function(&self, id: FunctionId) -> &Function {
        &self.functions[id.0 as usize]
    }

    /// The rule of that id.
    pub fn rule(&self, id: RuleId) -> &Rule {
        &self.rules[id.0 as usize]
    }

    /// All functions with their ids.
    pub fn functions(&self) -> impl Iterator<Item = (FunctionId, &Function)> {
        self.functions.iter().enumerate().map(|(i, function)| (FunctionId(i as u32), function))
    }
}

/// What a property is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum PropertyKind {
    /// Holds in every state.
    Invariant,
    /// An assumption on the environment.
    Invar,
    /// A formula over the CTL library.
    Ctl,
    /// A formula over the LTL library.
    Ltl,
    /// True again and again on every fair run.
    Justice,
    /// If the first is true again and again, so is the second.
    Compassion,
}

/// A property or an assumption.
#[derive(Debug, Clone)]
pub struct Property {
    /// Which.
    pub kind: PropertyKind,
    /// Its name, or `invariant at line N` if it has none.
    pub name: String,
    /// The variables of its formulas.
    pub variables: Vec<Variable>,
    /// The formula.
    pub formula: Term,
    /// The second formula of a compassion.
    pub conclusion: Option<Term>,
    /// Where it is written.
    pub span: Span,
}

/// An initial state.
#[derive(Debug, Clone)]
pub struct Init {
    /// The name.
    pub name: String,
    /// Contents of dynamic concrete domains.
    pub domains: Vec<(DomainId, Term)>,
    /// Initial values.
    pub functions: Vec<InitialFunction>,
    /// Programs of agents.
    pub agents: Vec<AgentProgram>,
    /// Where the name is written.
    pub span: Span,
}

/// `function f($x in D) = term` of an initial state.
#[derive(Debug, Clone)]
pub struct InitialFunction {
    /// The function.
    pub function: FunctionId,
    /// Its initial values.
    pub definition: Definition,
    /// Where it is written.
    pub span: Span,
}

/// `agent D: r_x[]` of an initial state.
#[derive(Debug, Clone)]
pub struct AgentProgram {
    /// The domain of the agents: `Agent` or a subset of it.
    pub domain: DomainId,
    /// The parameterless macro rule that is their program.
    pub rule: RuleId,
    /// Where it is written.
    pub span: Span,
}
