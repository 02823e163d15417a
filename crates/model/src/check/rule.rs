//! Rules: resolves every name of a written rule (spec/language.md, section 7).
//!
//! In: a typed view of a rule. Out: a [`RuleNode`]; [`RuleKind::Error`] where a fault was reported. INVARIANT: safe on
//! any tree, however deep. Whether macro rules are recursive, and whether location parameters get locations, is known
//! only when all rules are known: see `macros.rs`.

use syntax::Span;
use syntax::ast;

use super::body::{Body, Bound};
use crate::coerce::can_coerce;
use crate::declaration::{Function, FunctionKind};
use crate::domain::{DomainKind, Domains};
use crate::fault;
use crate::id::DomainId;
use crate::id::VariableId;
use crate::rule::{RuleKind, RuleNode};
use crate::term::{Binder, Term, TermKind};
use crate::uses::Referent;

impl Body<'_> {
    /// A rule that may be missing after a syntax fault at `place`.
    pub(crate) fn optional_rule(&mut self, rule: Option<ast::Rule>, place: Span) -> RuleNode {
        match rule {
            Some(rule) => self.rule(&rule),
            None => RuleNode { kind: RuleKind::Error, span: place },
        }
    }

    fn boxed(&mut self, rule: Option<ast::Rule>, place: Span) -> Box<RuleNode> {
        Box::new(self.optional_rule(rule, place))
    }

    /// Checks a rule.
    pub(crate) fn rule(&mut self, rule: &ast::Rule) -> RuleNode {
        let span = self.site.span(rule);
        let kind = stacker::maybe_grow(128 * 1024, 2 * 1024 * 1024, || self.rule_here(rule, span));
        RuleNode { kind, span }
    }

    fn rule_here(&mut self, rule: &ast::Rule, span: Span) -> RuleKind {
        match rule {
            ast::Rule::Skip(_) => RuleKind::Skip,
            ast::Rule::Update(update) => self.update(update, span),
            ast::Rule::MacroCall(call) => match self.call(call.name(), call.arguments(), false, span) {
                Some(call) => RuleKind::MacroCall(call),
                None => RuleKind::Error,
            },
            ast::Rule::TurboCall(call) => match self.call(call.name(), call.arguments(), true, span) {
                Some(call) => RuleKind::TurboCall(call),
                None => RuleKind::Error,
            },
            ast::Rule::Return(rule) => self.return_rule(rule, span),
            ast::Rule::Term(rule) => self.term_rule(rule, span),
            ast::Rule::Par(par) => RuleKind::Par(par.rules().map(|rule| self.rule(&rule)).collect()),
            ast::Rule::Seq(seq) => RuleKind::Seq(seq.rules().map(|rule| self.rule(&rule)).collect()),
            ast::Rule::If(rule) => self.if_rule(rule, span),
            ast::Rule::Switch(rule) => self.switch_rule(rule, span),
            ast::Rule::Let(rule) => self.let_rule(rule, span),
            ast::Rule::Choose(rule) => {
                let mark = self.mark();
                let binders = self.binders(rule.binders());
                let condition = rule.condition().map(|c| self.condition(Some(c), span, "the condition of `choose`"));
                let body = Box::new(self.with_local_state(&ranging(&binders), rule.body(), span));
                self.release(mark);
                let if_none = rule.if_none().map(|rule| Box::new(self.rule(&rule)));
                RuleKind::Choose { binders, condition, body, if_none }
            }
            ast::Rule::Forall(rule) => {
                let mark = self.mark();
                let binders = self.binders(rule.binders());
                let condition = rule.condition().map(|c| self.condition(Some(c), span, "the condition of `forall`"));
                let body = Box::new(self.with_local_state(&ranging(&binders), rule.body(), span));
                self.release(mark);
                RuleKind::Forall { binders, condition, body }
            }
            ast::Rule::Extend(rule) => self.extend(rule, span),
            ast::Rule::Iterate(rule) => RuleKind::Iterate(self.boxed(rule.body(), span)),
            ast::Rule::While(rule) => RuleKind::While {
                condition: self.condition(rule.condition(), span, "the condition of `while`"),
                body: self.boxed(rule.body(), span),
            },
            ast::Rule::RecursiveWhile(rule) => RuleKind::RecursiveWhile {
                condition: self.condition(rule.condition(), span, "the condition of `whilerec`"),
                body: self.boxed(rule.body(), span),
            },
            ast::Rule::Local(rule) => self.local(rule, span),
        }
    }

    fn if_rule(&mut self, rule: &ast::IfRule, span: Span) -> RuleKind {
        let mut branches = Vec::new();
        for branch in rule.branches() {
            let place = self.site.span(&branch);
            let guard = self.condition(branch.guard(), place, "the guard of `if`");
            branches.push((guard, self.optional_rule(branch.rule(), place)));
        }
        let otherwise = rule.otherwise().map(|rule| Box::new(self.rule(&rule)));
        match branches.is_empty() {
            true => RuleNode { kind: RuleKind::Error, span }.kind,
            false => RuleKind::If { branches, otherwise },
        }
    }

    fn switch_rule(&mut self, rule: &ast::SwitchRule, span: Span) -> RuleKind {
        let subject = self.optional_term(rule.subject(), span);
        let mut cases = Vec::new();
        for case in rule.cases() {
            let place = self.site.span(&case);
            let value = self.case_value(&subject, case.value(), place);
            cases.push((value, self.optional_rule(case.rule(), place)));
        }
        let otherwise = rule.otherwise().map(|rule| Box::new(self.rule(&rule)));
        RuleKind::Switch { subject, cases, otherwise }
    }

    fn extend(&mut self, rule: &ast::ExtendRule, span: Span) -> RuleKind {
        let mark = self.mark();
        let domain = match rule.domain() {
            Some(token) => {
                let domain = self.site.resolve_domain_name(&token);
                let place = self.site.token_span(&token);
                self.report_not_extendable(domain, place);
                domain
            }
            None => Domains::ERROR,
        };
        let variables: Vec<VariableId> =
            rule.variables().map(|token| self.bind(&token, domain, Bound::Extend)).collect();
        let body = Box::new(self.with_local_state(&variables, rule.body(), span));
        self.release(mark);
        RuleKind::Extend { domain, variables, body }
    }

    fn report_not_extendable(&mut self, domain: DomainId, span: Span) {
        let domains = &self.site.model.domains;
        let name = domains.display(domain);
        let (what, help) = match domains.kind(domain) {
            DomainKind::Error | DomainKind::Abstract { dynamic: true } => return,
            DomainKind::Abstract { .. } => {
                ("a static domain".to_string(), format!("declare it `dynamic abstract domain {name}`"))
            }
            DomainKind::Concrete { base, dynamic, .. } => match (domains.kind(*base), dynamic) {
                (DomainKind::Abstract { .. } | DomainKind::Error, true) => return,
                (DomainKind::Abstract { .. }, false) => (
                    "a static subset".to_string(),
                    format!("declare it `dynamic domain {name} subsetof {}`", domains.display(*base)),
                ),
                _ => (
                    format!("a subset of {}, which has no fresh elements", domains.display(*base)),
                    "only abstract domains, and dynamic subsets of them, take fresh elements".to_string(),
                ),
            },
            _ => (
                "not an abstract domain".to_string(),
                "only abstract domains, and dynamic subsets of them, take fresh elements".to_string(),
            ),
        };
        let declared = domains.get(domain).span;
        self.site.faults.push(fault::rule::extend_static(span, &name, &what, declared, help));
    }

    /// A term in the place of a rule: an agent's program, or a rule value.
    fn term_rule(&mut self, rule: &ast::TermRule, span: Span) -> RuleKind {
        let before = self.site.faults.len();
        let term = self.optional_term(rule.term(), span);
        if let (Some(ast::Term::Function(written)), TermKind::Error) = (rule.term(), &term.kind)
            && let Some(name) = written.name().filter(|_| written.arguments().is_none())
        {
            let name = name.text();
            let known = self.site.names.rules.contains_key(format!("r_{name}").as_str());
            self.site.faults.amend(before, |fault| fault::rule::not_called_by_rule_name(fault, name, known));
        }
        let arguments: Vec<Term> =
            rule.arguments().into_iter().flat_map(|list| list.terms()).map(|argument| self.term(&argument)).collect();
        if let TermKind::Apply { function, arguments: agents } = &term.kind {
            let function = self.site.model.function(*function);
            if function.library && function.name == "program" && arguments.is_empty() {
                return match agents.first() {
                    Some(agent) => RuleKind::RunAgent { agent: agent.clone() },
                    None => RuleKind::Error,
                };
            }
        }
        match self.site.model.domains.kind(self.site.model.domains.type_domain(term.domain)).clone() {
            DomainKind::Rule(parameters) => self.run_value(term, &parameters, arguments, span),
            DomainKind::Any => RuleKind::RunValue { rule: term, arguments },
            DomainKind::Error => RuleKind::Error,
            _ => {
                let found = self.site.display(term.domain);
                let help = match &term.kind {
                    TermKind::Apply { .. } => "to update it, write `… := …`; to run a rule, write `r_name[…]`",
                    _ => "write a rule here: `r_name[…]`, an update, or `skip`",
                };
                self.site.faults.push(fault::rule::not_a_rule(term.span, &found, help.to_string()));
                RuleKind::Error
            }
        }
    }

    fn run_value(&mut self, rule: Term, parameters: &[DomainId], arguments: Vec<Term>, span: Span) -> RuleKind {
        if parameters.len() != arguments.len() {
            let name = self.site.display(rule.domain);
            let expected = fault::count(parameters.len(), "argument");
            self.site.faults.push(fault::rule::argument_count(span, &name, &expected, arguments.len(), &[]));
            return RuleKind::Error;
        }
        let mut coerced = Vec::new();
        for (argument, formal) in arguments.into_iter().zip(parameters) {
            if !can_coerce(self.site.model, &argument, *formal) {
                let (expected, found) = (self.site.display(*formal), self.site.display(argument.domain));
                let message = format!("the rule takes {expected} here, but this is {found}");
                let help = format!("give a term of domain {expected}");
                self.site.faults.push(fault::rule::argument_domain(argument.span, message, &found, &[], help));
                return RuleKind::Error;
            }
            coerced.push(self.coerce(argument, *formal));
        }
        RuleKind::RunValue { rule, arguments: coerced }
    }

    fn local(&mut self, rule: &ast::LocalRule, span: Span) -> RuleKind {
        let outer = self.locals.len();
        let mut locals = Vec::new();
        for decl in rule.declarations() {
            let parameters = match decl.domain() {
                Some(domain) => {
                    let domain = self.site.resolve_domain(&domain);
                    self.site.model.domains.parameters_of(domain)
                }
                None => Vec::new(),
            };
            let codomain = decl.codomain().map_or(Domains::ERROR, |domain| self.site.resolve_domain(&domain));
            let Some(token) = decl.name() else { continue };
            let place = self.site.token_span(&token);
            let name = token.text().to_string();
            let kind = FunctionKind::Local;
            let function = Function {
                name: name.clone(),
                kind,
                parameters,
                codomain,
                definition: None,
                library: false,
                span: place,
            };
            let id = self.site.model.add_function(function);
            self.site.model.uses.declare(place, Referent::Function(id));
            self.locals.push((name, id));
            let place = self.site.span(&decl);
            locals.push((id, self.optional_rule(decl.initialisation(), place)));
        }
        let body = self.boxed(rule.body(), span);
        self.locals.truncate(outer);
        RuleKind::Local { locals, body }
    }
}

fn ranging(binders: &[Binder]) -> Vec<VariableId> {
    binders.iter().map(|binder| binder.variable).collect()
}
