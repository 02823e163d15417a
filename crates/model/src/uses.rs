//! The meaning of each name of the texts, as the checker found it: a table from places to what they refer to.
//!
//! In: every name that the checker resolves. Out: [`Uses`], for editors; nothing that runs a model reads it. INVARIANT:
//! a name is in the table only if the checker resolved it to this meaning, or if nothing else has that name. A name that
//! might mean several things is not in it.

use syntax::{FileId, Span};

use crate::id::{DomainId, FunctionId, RuleId};
use crate::names::Names;

/// What a name refers to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Referent {
    /// A domain.
    Domain(DomainId),
    /// An enum literal: its domain and its place in it.
    Literal(DomainId, u32),
    /// A function; an operator refers to its library function.
    Function(FunctionId),
    /// A rule.
    Rule(RuleId),
    /// A logical variable: where it is bound, and the domain of its values.
    Variable(Span, DomainId),
}

/// A name at a place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Use {
    /// Where the name stands.
    pub span: Span,
    /// What it refers to.
    pub referent: Referent,
    /// Whether it is declared or bound here.
    pub declares: bool,
}

/// All names of the texts. A name in a list of imports or exports refers to all overloads that it lets through.
#[derive(Debug, Clone, Default)]
pub struct Uses(Vec<Use>);

impl Uses {
    pub(crate) fn add(&mut self, span: Span, referent: Referent) {
        self.0.push(Use { span, referent, declares: false });
    }

    pub(crate) fn declare(&mut self, span: Span, referent: Referent) {
        self.0.push(Use { span, referent, declares: true });
    }

    /// Adds all meanings of a name in a list.
    pub(crate) fn add_all(&mut self, span: Span, name: &str, names: &Names) {
        let domain = names.domain(name).map(Referent::Domain);
        let literal = names.literal(name).map(|(domain, place)| Referent::Literal(domain, place));
        let functions = names.functions(name).iter().copied().map(Referent::Function);
        let rules = names.rules(name).iter().copied().map(Referent::Rule);
        for referent in domain.into_iter().chain(literal).chain(functions).chain(rules) {
            self.add(span, referent);
        }
    }

    /// Those of a file, in the order of their places, each once.
    pub fn in_file(&self, file: FileId) -> Vec<Use> {
        let mut found: Vec<Use> = self.0.iter().filter(|name| name.span.file == file).copied().collect();
        // Nearly all have a place of their own.
        let rest = |name: &Use| (name.span, name.referent, !name.declares);
        found.sort_by(|one, other| one.span.start.cmp(&other.span.start).then_with(|| rest(one).cmp(&rest(other))));
        found.dedup_by_key(|name| (name.span, name.referent));
        found
    }

    /// All of them, in the order in which they were resolved.
    pub fn iter(&self) -> impl Iterator<Item = &Use> {
        self.0.iter()
    }
}
