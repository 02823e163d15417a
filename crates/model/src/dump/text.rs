//! Terms and rules as text, the inner part of the dump.
//!
//! In: a model, the variables of a declaration. Out: terms on one line in prefix form; one line for each rule, indented
//! by two blanks for each level. Every coercion is shown. Safe at any depth.

use std::fmt::Write;

use super::signature;
use crate::collection::CollectionKind;
use crate::declaration::{FunctionKind, Variable};
use crate::domain::{Basic, DomainKind};
use crate::id::{FunctionId, VariableId};
use crate::model::Model;
use crate::rule::{Call, RuleKind, RuleNode, Target};
use crate::term::{Binder, Literal, Quantifier, Term, TermKind};

/// A term or rule being written.
pub(super) struct Text<'m> {
    model: &'m Model,
    variables: &'m [Variable],
    /// What is written so far.
    pub(super) out: String,
}

impl<'m> Text<'m> {
    /// Nothing written yet.
    pub(super) fn new(model: &'m Model, variables: &'m [Variable]) -> Self {
        Text { model, variables, out: String::new() }
    }

    fn push(&mut self, text: &str) {
        self.out.push_str(text);
    }

    fn variable(&mut self, id: VariableId) {
        let name = self.variables.get(id.0 as usize).map_or("$?", |variable| variable.name.as_str());
        self.out.push_str(name);
    }

    fn list(&mut self, terms: &[Term]) {
        for (index, term) in terms.iter().enumerate() {
            if index > 0 {
                self.push(", ");
            }
            self.term(term);
        }
    }

    fn application(&mut self, function: FunctionId, arguments: &[Term]) {
        let function = self.model.function(function);
        self.push(&function.name);
        if function.kind == FunctionKind::Local && arguments.is_empty() {
            return;
        }
        if !arguments.is_empty() {
            self.push("(");
            self.list(arguments);
            self.push(")");
        }
    }

    /// Writes a term.
    pub(super) fn term(&mut self, term: &Term) {
        stacker::maybe_grow(128 * 1024, 2 * 1024 * 1024, || self.term_here(term));
    }

    fn term_here(&mut self, term: &Term) {
        match &term.kind {
            TermKind::Literal(literal) => self.literal(literal, term),
            TermKind::Variable(id) => self.variable(*id),
            TermKind::Apply { function, arguments } => self.application(*function, arguments),
            TermKind::Domain(domain) => self.push(&self.model.domains.display(*domain)),
            TermKind::Tuple(parts) => {
                self.push("(");
                self.list(parts);
                self.push(")");
            }
            TermKind::Project { tuple, index } => {
                self.term(tuple);
                let _ = write!(self.out, ".{index}");
            }
            TermKind::Collection { kind, elements } => {
                self.push(brackets(*kind).0);
                if *kind == CollectionKind::Map {
                    for (index, entry) in elements.iter().enumerate() {
                        self.push(if index > 0 { ", " } else { "" });
                        self.entry(entry);
                    }
                } else {
                    self.list(elements);
                }
                self.push(brackets(*kind).1);
            }
            TermKind::Range { kind, low, high, step } => {
                self.push(brackets(*kind).0);
                self.term(low);
                self.push(" : ");
                self.term(high);
                if let Some(step) = step {
                    self.push(", ");
                    self.term(step);
                }
                self.push(brackets(*kind).1);
            }
            TermKind::Comprehension { kind, binders, condition, body } => {
                self.push(brackets(*kind).0);
                self.binders(binders);
                if let Some(condition) = condition {
                    self.push(" | ");
                    self.term(condition);
                }
                self.push(" : ");
                if *kind == CollectionKind::Map {
                    self.entry(body)
                } else {
                    self.term(body)
                }
                self.push(brackets(*kind).1);
            }
            TermKind::Quantified { quantifier, binders, condition } => {
                self.push(match quantifier {
                    Quantifier::Forall => "(forall ",
                    Quantifier::Exists => "(exists ",
                    Quantifier::ExistsUnique => "(exists unique ",
                });
                self.binders(binders);
                self.optional(" with ", condition.as_deref());
                self.push(")");
            }
            TermKind::If { branches, otherwise } => {
                for (index, (guard, term)) in branches.iter().enumerate() {
                    self.push(if index > 0 { " elseif " } else { "(if " });
                    self.term(guard);
                    self.push(" then ");
                    self.term(term);
                }
                self.optional(" else ", otherwise.as_deref());
                self.push(")");
            }
            TermKind::Switch { subject, cases, otherwise } => {
                self.push("(switch ");
                self.term(subject);
                for (value, term) in cases {
                    self.push(" case ");
                    self.term(value);
                    self.push(": ");
                    self.term(term);
                }
                self.optional(" otherwise ", otherwise.as_deref());
                self.push(")");
            }
            TermKind::Let { bindings, body } => {
                self.push("(let ");
                self.bindings(bindings);
                self.push(" in ");
                self.term(body);
                self.push(")");
            }
            TermKind::Rule(rule) => {
                let _ = write!(self.out, "<<{}>>", self.model.rule(*rule).name);
            }
            TermKind::Coerce(inner) => {
                let _ = write!(self.out, "{}(", self.model.domains.display(term.domain));
                self.term(inner);
                self.push(")");
            }
            TermKind::Unbound(_) => self.push("unbound"),
            TermKind::Error => self.push("?"),
        }
    }

    fn optional(&mut self, word: &str, term: Option<&Term>) {
        if let Some(term) = term {
            self.push(word);
            self.term(term);
        }
    }

    fn entry(&mut self, entry: &Term) {
        match &entry.kind {
            TermKind::Tuple(pair) if pair.len() == 2 => {
                self.term(&pair[0]);
                self.push(" -> ");
                self.term(&pair[1]);
            }
            _ => self.term(entry),
        }
    }

    fn binders(&mut self, binders: &[Binder]) {
        for (index, binder) in binders.iter().enumerate() {
            self.push(if index > 0 { ", " } else { "" });
            self.variable(binder.variable);
            self.push(" in ");
            self.term(&binder.range);
        }
    }

    fn bindings(&mut self, bindings: &[(VariableId, Term)]) {
        for (index, (variable, term)) in bindings.iter().enumerate() {
            self.push(if index > 0 { ", " } else { "" });
            self.variable(*variable);
            self.push(" = ");
            self.term(term);
        }
    }

    fn literal(&mut self, literal: &Literal, term: &Term) {
        let natural = self.model.domains.numeric(term.domain) == Some(Basic::Natural);
        let _ = match literal {
            Literal::Undef => write!(self.out, "undef"),
            Literal::Boolean(value) => write!(self.out, "{value}"),
            Literal::Integer(value) => write!(self.out, "{value}{}", if natural { "n" } else { "" }),
            Literal::Real(value) => write!(self.out, "{value:?}"),
            Literal::Complex(re, im) => write!(self.out, "{re:?}i{im:?}"),
            Literal::Char(letter) => write!(self.out, "{letter:?}"),
            Literal::String(text) => write!(self.out, "{text:?}"),
            Literal::Enum(domain, place) => match self.model.domains.kind(*domain) {
                DomainKind::Enum { literals } => write!(self.out, "{}", literals[*place as usize]),
                _ => Ok(()),
            },
        };
    }

    fn line(&mut self, depth: usize, text: &str) {
        let _ = writeln!(self.out, "{:1$}{text}", "", depth * 2);
    }

    fn start(&mut self, depth: usize, text: &str) {
        let _ = write!(self.out, "{:1$}{text}", "", depth * 2);
    }

    fn target(&mut self, target: &Target) {
        match target {
            Target::Location { function, arguments, .. } => self.application(*function, arguments),
            Target::Parameter(id, _) => self.variable(*id),
        }
    }

    fn call(&mut self, call: &Call, open: &str, close: &str) {
        let name = &self.model.rule(call.rule).name;
        self.push(name);
        self.push(open);
        self.list(&call.arguments);
        self.push(close);
    }

    /// Writes a rule, `depth` levels in.
    pub(super) fn rule(&mut self, rule: &RuleNode, depth: usize) {
        stacker::maybe_grow(128 * 1024, 2 * 1024 * 1024, || self.rule_here(rule, depth));
    }

    fn rule_here(&mut self, rule: &RuleNode, depth: usize) {
        match &rule.kind {
            RuleKind::Skip => self.line(depth, "skip"),
            RuleKind::Error => self.line(depth, "?"),
            RuleKind::Update { target, value } => {
                self.start(depth, "");
                self.target(target);
                self.push(" := ");
                self.term(value);
                self.push("\n");
            }
            RuleKind::MacroCall(call) => {
                self.start(depth, "");
                self.call(call, "[", "]\n");
            }
            RuleKind::TurboCall(call) => {
                self.start(depth, "");
                self.call(call, "(", ")\n");
            }
            RuleKind::Return { target, call } => {
                self.start(depth, "");
                self.target(target);
                self.push(" <- ");
                self.call(call, "(", ")\n");
            }
            RuleKind::RunValue { rule, arguments } => {
                self.start(depth, "run ");
                self.term(rule);
                self.push("[");
                self.list(arguments);
                self.push("]\n");
            }
            RuleKind::RunAgent { agent } => {
                self.start(depth, "run agent ");
                self.term(agent);
                self.push("\n");
            }
            RuleKind::Par(rules) => self.block(depth, "par", rules),
            RuleKind::Seq(rules) => self.block(depth, "seq", rules),
            RuleKind::If { branches, otherwise } => {
                for (index, (guard, rule)) in branches.iter().enumerate() {
                    self.start(depth, if index > 0 { "elseif " } else { "if " });
                    self.term(guard);
                    self.push("\n");
                    self.rule(rule, depth + 1);
                }
                self.otherwise(depth, "else", otherwise.as_deref());
            }
            RuleKind::Switch { subject, cases, otherwise } => {
                self.start(depth, "switch ");
                self.term(subject);
                self.push("\n");
                for (value, rule) in cases {
                    self.start(depth, "case ");
                    self.term(value);
                    self.push("\n");
                    self.rule(rule, depth + 1);
                }
                self.otherwise(depth, "otherwise", otherwise.as_deref());
            }
            RuleKind::Let { bindings, body } => {
                self.start(depth, "let ");
                self.bindings(bindings);
                self.push("\n");
                self.rule(body, depth + 1);
            }
            RuleKind::Choose { binders, condition, body, if_none } => {
                self.ranging(depth, "choose ", binders, condition.as_ref(), body);
                self.otherwise(depth, "ifnone", if_none.as_deref());
            }
            RuleKind::Forall { binders, condition, body } => {
                self.ranging(depth, "forall ", binders, condition.as_ref(), body)
            }
            RuleKind::Extend { domain, variables, body } => {
                self.start(depth, "extend ");
                self.push(&self.model.domains.display(*domain));
                self.push(" with");
                for variable in variables {
                    self.push(" ");
                    self.variable(*variable);
                }
                self.push("\n");
                self.rule(body, depth + 1);
            }
            RuleKind::Iterate(body) => {
                self.line(depth, "iterate");
                self.rule(body, depth + 1);
            }
            RuleKind::While { condition, body } => self.looping(depth, "while ", condition, body),
            RuleKind::RecursiveWhile { condition, body } => self.looping(depth, "whilerec ", condition, body),
            RuleKind::Local { locals, body } => {
                for (function, first) in locals {
                    let text = format!("local {}", signature(self.model, self.model.function(*function)));
                    self.line(depth, &text);
                    self.rule(first, depth + 1);
                }
                self.line(depth, "in");
                self.rule(body, depth + 1);
            }
        }
    }

    fn block(&mut self, depth: usize, word: &str, rules: &[RuleNode]) {
        self.line(depth, word);
        rules.iter().for_each(|rule| self.rule(rule, depth + 1));
    }

    fn otherwise(&mut self, depth: usize, word: &str, rule: Option<&RuleNode>) {
        if let Some(rule) = rule {
            self.line(depth, word);
            self.rule(rule, depth + 1);
        }
    }

    fn ranging(&mut self, depth: usize, word: &str, binders: &[Binder], condition: Option<&Term>, body: &RuleNode) {
        self.start(depth, word);
        self.binders(binders);
        self.optional(" with ", condition);
        self.push("\n");
        self.rule(body, depth + 1);
    }

    fn looping(&mut self, depth: usize, word: &str, condition: &Term, body: &RuleNode) {
        self.start(depth, word);
        self.term(condition);
        self.push("\n");
        self.rule(body, depth + 1);
    }
}

fn brackets(kind: CollectionKind) -> (&'static str, &'static str) {
    match kind {
        CollectionKind::Set | CollectionKind::Map => ("{", "}"),
        CollectionKind::Seq => ("[", "]"),
        CollectionKind::Bag => ("<", ">"),
    }
}
