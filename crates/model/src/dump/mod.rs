//! The checked model as text, for people and for golden tests (`groundstate dump model`).
//!
//! In: a [`Model`]. Out: its own declarations in the order of its tables. Terms are in prefix form, with every coercion
//! and with overloads resolved. Library functions and structured domains are shown only if they are used. The same model
//! always gives the same text.

mod text;

use std::fmt::Write;

use crate::declaration::{Definition, Function, Rule, Variable};
use crate::domain::{Domain, DomainKind};
use crate::id::VariableId;
use crate::model::{Init, Model, Property, PropertyKind};
use crate::rule::RuleNode;
use crate::site::kind_word;
use crate::term::Term;
use text::Text;

impl Model {
    /// The model as text.
    pub fn dump(&self) -> String {
        let mut out = String::new();
        let asynchronous = if self.asynchronous { "asyncr " } else { "" };
        let _ = writeln!(out, "{asynchronous}model {}", self.name);
        for (_, domain) in self.domains.iter() {
            dump_domain(self, domain, &mut out);
        }
        for function in self.functions.iter().filter(|function| !function.library || function.definition.is_some()) {
            dump_function(self, function, &mut out);
        }
        for rule in &self.rules {
            dump_rule(self, rule, &mut out);
        }
        for property in &self.properties {
            dump_property(self, property, &mut out);
        }
        for (index, init) in self.inits.iter().enumerate() {
            dump_init(self, init, self.default_init == Some(index), &mut out);
        }
        if let Some(main) = self.main {
            let _ = writeln!(out, "main {}", self.rule(main).name);
        }
        out
    }

    /// A term as text; `variables` are those of its declaration.
    pub fn dump_term(&self, term: &Term, variables: &[Variable]) -> String {
        let mut text = Text::new(self, variables);
        text.term(term);
        text.out
    }

    /// A rule as text, one line for each rule; `variables` are those of its declaration.
    pub fn dump_rule(&self, rule: &RuleNode, variables: &[Variable]) -> String {
        let mut text = Text::new(self, variables);
        text.rule(rule, 0);
        text.out
    }
}

fn dump_domain(model: &Model, domain: &Domain, out: &mut String) {
    let (Some(name), Some(_)) = (&domain.name, domain.span) else { return };
    let _ = match &domain.kind {
        DomainKind::Enum { literals } => writeln!(out, "domain {name} = {{{}}}", literals.join(", ")),
        DomainKind::Abstract { dynamic } => writeln!(out, "domain {name}{}", if *dynamic { ", dynamic" } else { "" }),
        DomainKind::Concrete { base, dynamic, definition } => {
            let dynamic = if *dynamic { ", dynamic" } else { "" };
            let contents =
                definition.as_ref().map(|term| format!(" = {}", model.dump_term(term, &[]))).unwrap_or_default();
            writeln!(out, "domain {name} ⊂ {}{dynamic}{contents}", model.domains.display(*base))
        }
        _ => Ok(()),
    };
}

fn signature(model: &Model, function: &Function) -> String {
    let parameters: Vec<String> = function.parameters.iter().map(|domain| model.domains.display(*domain)).collect();
    let codomain = model.domains.display(function.codomain);
    match parameters.is_empty() {
        true => format!("{}: {codomain}", function.name),
        false => format!("{}: {} -> {codomain}", function.name, parameters.join(" × ")),
    }
}

fn dump_function(model: &Model, function: &Function, out: &mut String) {
    let _ = writeln!(out, "{} {}", kind_word(function.kind), signature(model, function));
    if let Some(definition) = &function.definition {
        let _ = writeln!(out, "  {}", equation(model, definition));
    }
}

fn equation(model: &Model, definition: &Definition) -> String {
    let parameters = parameters(model, &definition.variables, &definition.parameters);
    format!("{parameters}= {}", model.dump_term(&definition.body, &definition.variables))
}

fn parameters(model: &Model, variables: &[Variable], ids: &[VariableId]) -> String {
    let parts: Vec<String> = ids
        .iter()
        .map(|id| &variables[id.0 as usize])
        .map(|variable| format!("{}: {}", variable.name, model.domains.display(variable.domain)))
        .collect();
    if parts.is_empty() { String::new() } else { format!("({}) ", parts.join(", ")) }
}

fn dump_rule(model: &Model, rule: &Rule, out: &mut String) {
    let turbo = if rule.turbo { "turbo " } else { "" };
    let result = rule.result.map(|domain| format!("-> {} ", model.domains.display(domain))).unwrap_or_default();
    let parameters = parameters(model, &rule.variables, &rule.parameters);
    let _ = writeln!(out, "{turbo}rule {} {parameters}{result}=", rule.name);
    let mut text = Text::new(model, &rule.variables);
    text.rule(&rule.body, 1);
    out.push_str(&text.out);
}

fn dump_property(model: &Model, property: &Property, out: &mut String) {
    let word = match property.kind {
        PropertyKind::Invariant => "invariant",
        PropertyKind::Invar => "invar",
        PropertyKind::Ctl => "ctl",
        PropertyKind::Ltl => "ltl",
        PropertyKind::Justice => "justice",
        PropertyKind::Compassion => "compassion",
    };
    let _ = write!(out, "{word} {}: {}", property.name, model.dump_term(&property.formula, &property.variables));
    if let Some(conclusion) = &property.conclusion {
        let _ = write!(out, " ⇒ {}", model.dump_term(conclusion, &property.variables));
    }
    out.push('\n');
}

fn dump_init(model: &Model, init: &Init, default: bool, out: &mut String) {
    let _ = writeln!(out, "{}init {}", if default { "default " } else { "" }, init.name);
    for (domain, term) in &init.domains {
        let _ = writeln!(out, "  domain {} = {}", model.domains.display(*domain), model.dump_term(term, &[]));
    }
    for function in &init.functions {
        let name = &model.function(function.function).name;
        let _ = writeln!(out, "  function {name} {}", equation(model, &function.definition));
    }
    for agent in &init.agents {
        let _ = writeln!(out, "  agent {}: {}", model.domains.display(agent.domain), model.rule(agent.rule).name);
    }
}
