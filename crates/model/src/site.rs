//! The context in which names are resolved: a file, the names it sees, and the model under construction.
//!
//! In: names and domains as written. Out: what they mean, or a reported fault and [`Domains::ERROR`]. Everything that
//! declares or checks does so through a [`Site`].

use syntax::ast::{self, AstNode};
use syntax::{FileId, Span, SyntaxKind, SyntaxToken};

use crate::declaration::FunctionKind;
use crate::domain::{Basic, Domain, DomainKind, Domains};
use crate::fault::{self, Faults, Mismatch};
use crate::id::DomainId;
use crate::id::{FunctionId, RuleId};
use crate::library;
use crate::model::Model;
use crate::names::Names;
use crate::suggest::{did_you_mean, foreign_domain, nearest};
use crate::uses::Referent;

/// A file being declared or checked.
pub(crate) struct Site<'a> {
    /// The model under construction.
    pub(crate) model: &'a mut Model,
    /// What the file sees.
    pub(crate) names: &'a Names,
    /// The faults found so far.
    pub(crate) faults: &'a mut Faults,
    /// The file.
    pub(crate) file: FileId,
}

impl Site<'_> {
    /// The place of a node.
    pub(crate) fn span(&self, node: &impl AstNode) -> Span {
        Span::new(self.file, node.range())
    }

    /// The place of a token.
    pub(crate) fn token_span(&self, token: &SyntaxToken) -> Span {
        Span::new(self.file, token.text_range())
    }

    /// Notes what a name at a place means.
    pub(crate) fn note(&mut self, span: Span, referent: Referent) {
        self.model.uses.add(span, referent);
    }

    /// The domain as written in a model.
    pub(crate) fn display(&self, domain: DomainId) -> String {
        self.model.domains.display(domain)
    }

    /// What to say of a term of domain `found` where `expected` is needed.
    pub(crate) fn mismatch(&self, expected: DomainId, found: DomainId) -> Mismatch {
        let domains = &self.model.domains;
        let conversion = match (domains.numeric(found), domains.numeric(expected)) {
            (Some(Basic::Real), Some(Basic::Integer)) => Some("rtoi"),
            (Some(Basic::Real), Some(Basic::Natural)) => Some("rton"),
            (Some(Basic::Integer), Some(Basic::Natural)) => Some("iton"),
            (Some(Basic::Complex), Some(Basic::Real)) => Some("re"),
            _ => None,
        };
        Mismatch { expected: self.display(expected), found: self.display(found), conversion }
    }

    /// `f: Prod(A,B) -> C`
    pub(crate) fn signature(&self, id: FunctionId) -> String {
        let function = self.model.function(id);
        let codomain = self.display(function.codomain);
        match function.parameters.as_slice() {
            [] => format!("{}: {codomain}", function.name),
            parameters => format!("{}: {} -> {codomain}", function.name, self.product(parameters)),
        }
    }

    /// `r_x(A,B)`
    pub(crate) fn rule_signature(&self, id: RuleId) -> String {
        let rule = self.model.rule(id);
        let parameters: Vec<String> =
            rule.parameters.iter().map(|id| self.display(rule.variables[id.0 as usize].domain)).collect();
        format!("{}({})", rule.name, parameters.join(","))
    }

    /// Several domains as one: nothing, the domain itself, or a product.
    pub(crate) fn product(&self, domains: &[DomainId]) -> String {
        let parts: Vec<String> = domains.iter().map(|domain| self.display(*domain)).collect();
        match parts.as_slice() {
            [one] => one.clone(),
            _ => format!("Prod({})", parts.join(",")),
        }
    }

    /// The domain that a written one means.
    pub(crate) fn resolve_domain(&mut self, domain: &ast::Domain) -> DomainId {
        match domain {
            ast::Domain::Named(named) => match named.name() {
                Some(name) => self.resolve_domain_name(&name),
                None => Domains::ERROR,
            },
            ast::Domain::Structured(structured) => {
                stacker::maybe_grow(64 * 1024, 1024 * 1024, || self.resolve_structured(structured))
            }
        }
    }

    fn resolve_structured(&mut self, domain: &ast::StructuredDomain) -> DomainId {
        let Some(constructor) = domain.constructor() else { return Domains::ERROR };
        let parts: Vec<DomainId> = domain.arguments().map(|argument| self.resolve_domain(&argument)).collect();
        if parts.contains(&Domains::ERROR) {
            return Domains::ERROR;
        }
        let kind = match (constructor, parts.as_slice()) {
            (SyntaxKind::PROD_KW, [_, _, ..]) => DomainKind::Prod(parts),
            (SyntaxKind::SEQ_DOMAIN_KW, [of]) => DomainKind::Seq(*of),
            (SyntaxKind::POWERSET_KW, [of]) => DomainKind::Powerset(*of),
            (SyntaxKind::BAG_KW, [of]) => DomainKind::Bag(*of),
            (SyntaxKind::MAP_KW, [key, value]) => DomainKind::Map(*key, *value),
            (SyntaxKind::RULE_DOMAIN_KW, _) => DomainKind::Rule(parts),
            _ => return Domains::ERROR, // the parser has reported that there are too few or too many
        };
        self.model.domains.structured(kind)
    }

    /// The domain of that name.
    pub(crate) fn resolve_domain_name(&mut self, token: &SyntaxToken) -> DomainId {
        let (name, span) = (token.text(), self.token_span(token));
        let domain = match self.names.domain(name) {
            Some(domain) => domain,
            None => self.unknown_domain(name, span),
        };
        if domain != Domains::ERROR {
            self.model.uses.add(span, Referent::Domain(domain));
        }
        domain
    }

    fn unknown_domain(&mut self, name: &str, span: Span) -> DomainId {
        // The predefined domains need no import, unlike the functions on them.
        if let Some(domain) = predefined(name) {
            return domain;
        }
        if self.names.incomplete {
            return Domains::ERROR;
        }
        if let Some(domain) = self.domain_in_signatures(name) {
            return domain;
        }
        let help = match self.names.literal(name) {
            Some((domain, _)) => format!("`{name}` is a literal of the enum domain `{}`", self.display(domain)),
            None => did_you_mean(name, self.names.domains.keys().map(|name| &**name), || {
                if let Some(ours) = foreign_domain(name) {
                    return format!("did you mean `{ours}`?");
                }
                self.hidden(name, |model, name| {
                    model
                        .domains
                        .iter()
                        .find_map(|(_, domain)| (domain.name.as_deref() == Some(name)).then_some(domain.span?))
                })
                .unwrap_or_else(|| self.declare(&format!("`abstract domain {name}`")))
            }),
        };
        self.faults.push(fault::name::unknown_domain(span, name, help));
        Domains::ERROR
    }

    /// A domain that is not imported by name, but that a visible function is declared with.
    fn domain_in_signatures(&self, name: &str) -> Option<DomainId> {
        let functions = self.names.functions.values().flat_map(|ids| ids.iter()).map(|id| self.model.function(*id));
        let mut domains = functions.flat_map(|function| function.parameters.iter().chain([&function.codomain]));
        domains.find(|domain| self.model.domains.get(**domain).name.as_deref() == Some(name)).copied()
    }

    /// Says where a name that nobody has would be declared: a text beside a model declares nothing.
    fn declare(&self, declaration: &str) -> String {
        match self.names.beside {
            true => format!("name one that the model has, or declare it there: {declaration}"),
            false => format!("declare it in the signature: {declaration}, or import the file that does"),
        }
    }

    /// Says that a name is declared in a file that is read but does not let it be seen here.
    fn hidden(&self, name: &str, find: impl Fn(&Model, &str) -> Option<Span>) -> Option<String> {
        let place = find(self.model, name)?;
        (place.file != self.file)
            .then(|| format!("`{name}` is declared in an imported file: add it to that file's export list, and to the selection of the import"))
    }

    /// Reports a function name that means nothing.
    ///
    /// `shown` is the name or operator as written.
    pub(crate) fn unknown_function(&mut self, name: &str, shown: &str, span: Span, variables: &[&str]) {
        if library::is_standard_name(name) && !self.names.functions.contains_key("eq") && !self.names.incomplete {
            self.faults.missing_library(fault::import::missing_library(span, &format!("`{shown}`")));
            return;
        }
        if self.names.incomplete {
            return;
        }
        let variable = format!("${name}");
        let help = if variables.contains(&variable.as_str()) {
            format!("did you mean the variable `{variable}`?")
        } else {
            did_you_mean(name, self.names.functions.keys().map(|name| &**name), || {
                if let Some(other) =
                    nearest(name, self.names.literals.keys().chain(self.names.domains.keys()).map(|name| &**name))
                {
                    return format!("did you mean `{other}`?");
                }
                self.hidden(name, |model, name| model.functions.iter().find(|f| f.name == name).map(|f| f.span))
                    .unwrap_or_else(|| self.declare(&format!("`controlled {name}: …`")))
            })
        };
        self.faults.push(fault::name::unknown_function(span, name, help));
    }

    /// Reports an enum literal that means nothing.
    pub(crate) fn unknown_literal(&mut self, name: &str, span: Span) {
        if self.names.incomplete {
            return;
        }
        let help = did_you_mean(name, self.names.literals.keys().map(|name| &**name), || {
            if let Some(function) = self.names.functions.keys().find(|known| known.eq_ignore_ascii_case(name)) {
                return format!("did you mean the function `{function}`?");
            }
            let of = |(_, domain): (DomainId, &Domain)| match &domain.kind {
                DomainKind::Enum { literals } if literals.iter().any(|literal| literal == name) => domain.name.clone(),
                _ => None,
            };
            match self.model.domains.iter().find_map(of) {
                Some(domain) => format!(
                    "`{name}` is a literal of `{domain}` in an imported file: add `{domain}` to that file's export list, and to the selection of the import"
                ),
                None => format!("declare it in an enum domain: `enum domain D = {{{name} | …}}`"),
            }
        });
        self.faults.push(fault::name::unknown_literal(span, name, help));
    }

    /// Reports a rule name that means nothing.
    pub(crate) fn unknown_rule(&mut self, token: &SyntaxToken) {
        if self.names.incomplete {
            return;
        }
        let (name, span) = (token.text(), self.token_span(token));
        let help = did_you_mean(name, self.names.rules.keys().map(|name| &**name), || {
            self.hidden(name, |model, name| model.rules.iter().find(|r| r.name == name).map(|r| r.span)).unwrap_or_else(
                || format!("declare it in the definitions: `rule {name} = …`, or import the file that does"),
            )
        });
        self.faults.push(fault::name::unknown_rule(span, name, help));
    }
}

/// The predefined domain of that name.
pub(crate) fn predefined(name: &str) -> Option<DomainId> {
    Some(match name {
        "Complex" => Domains::COMPLEX,
        "Real" => Domains::REAL,
        "Integer" => Domains::INTEGER,
        "Natural" => Domains::NATURAL,
        "Char" => Domains::CHAR,
        "String" => Domains::STRING,
        "Boolean" => Domains::BOOLEAN,
        "Undef" => Domains::UNDEF,
        "Agent" => Domains::AGENT,
        "Reserve" => Domains::RESERVE,
        "Any" => Domains::ANY,
        _ => return None,
    })
}

/// The word for a kind of function.
pub fn kind_word(kind: FunctionKind) -> &'static str {
    match kind {
        FunctionKind::Static => "static",
        FunctionKind::Derived => "derived",
        FunctionKind::Monitored => "monitored",
        FunctionKind::Controlled => "controlled",
        FunctionKind::Shared => "shared",
        FunctionKind::Out => "out",
        FunctionKind::Local => "local",
    }
}
