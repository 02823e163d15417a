//! Calls of rules: macro rules with `[]`, turbo rules with `()`, and rules named as values.
//!
//! In: a name and arguments. Out: a [`Call`] with the overload resolved and the arguments coerced, or a fault that
//! says which arguments the rules of that name take.

use syntax::{Span, SyntaxToken, ast};

use super::body::Body;
use crate::coerce::can_coerce;
use crate::compat::NARROWING;
use crate::domain::Domains;
use crate::fault;
use crate::id::DomainId;
use crate::id::RuleId;
use crate::overload;
use crate::rule::Call;
use crate::term::Term;
use crate::uses::Referent;

impl Body<'_> {
    /// A call of a macro or turbo rule.
    pub(crate) fn call(
        &mut self,
        name: Option<SyntaxToken>,
        arguments: Option<ast::ArgumentList>,
        turbo: bool,
        span: Span,
    ) -> Option<Call> {
        let arguments: Vec<Term> =
            arguments.into_iter().flat_map(|list| list.terms()).map(|argument| self.term(&argument)).collect();
        let token = name?;
        let all = self.site.names.rules(token.text());
        if all.is_empty() {
            self.site.unknown_rule(&token);
            return None;
        }
        let candidates: Vec<RuleId> =
            all.iter().copied().filter(|id| self.site.model.rule(*id).turbo == turbo).collect();
        if candidates.is_empty() {
            let declared = self.site.model.rule(all[0]).span;
            let place = self.site.token_span(&token);
            self.site.faults.push(fault::rule::call_brackets(place, token.text(), !turbo, declared));
            return None;
        }
        let place = self.site.token_span(&token);
        if let [only] = candidates.as_slice() {
            self.site.note(place, Referent::Rule(*only));
        }
        if arguments.iter().any(|argument| argument.domain == Domains::ERROR) && candidates.len() > 1 {
            return None;
        }
        let Some(rule) = overload::rule(self.site.model, &candidates, &arguments) else {
            self.report_call(&token, &candidates, &arguments, span);
            return None;
        };
        self.site.note(place, Referent::Rule(rule));
        let formals = self.formals(rule);
        let arguments =
            arguments.into_iter().zip(formals).map(|(argument, formal)| self.coerce(argument, formal)).collect();
        Some(Call { rule, arguments })
    }

    fn formals(&self, rule: RuleId) -> Vec<DomainId> {
        let rule = self.site.model.rule(rule);
        rule.parameters.iter().map(|id| rule.variables[id.0 as usize].domain).collect()
    }

    fn report_call(&mut self, token: &SyntaxToken, candidates: &[RuleId], arguments: &[Term], span: Span) {
        let name = token.text();
        let fitting: Vec<RuleId> =
            candidates.iter().copied().filter(|id| self.formals(*id).len() == arguments.len()).collect();
        let fault = match fitting.as_slice() {
            [] => {
                let mut counts: Vec<usize> = candidates.iter().map(|id| self.formals(*id).len()).collect();
                counts.sort_unstable();
                counts.dedup();
                let counts: Vec<String> = counts.iter().map(|n| fault::count(*n, "argument")).collect();
                let declared: Vec<Span> = candidates.iter().map(|id| self.site.model.rule(*id).span).take(3).collect();
                let place = self.site.token_span(token);
                fault::rule::argument_count(place, name, &counts.join(" or "), arguments.len(), &declared)
            }
            [id] => {
                let formals = self.formals(*id);
                let mut pairs = arguments.iter().zip(&formals);
                let wrong = pairs.find(|(argument, formal)| !can_coerce(self.site.model, argument, **formal));
                let Some((argument, formal)) = wrong else { return };
                let (expected, found) = (self.site.display(*formal), self.site.display(argument.domain));
                let message = format!("`{name}` takes {expected} here, but this is {found}");
                let declared = [(self.site.model.rule(*id).span, self.site.rule_signature(*id))];
                let help = format!("give a term of domain {expected}");
                fault::rule::argument_domain(argument.span, message, &found, &declared, help)
            }
            several => {
                let domains: Vec<String> =
                    arguments.iter().map(|argument| self.site.display(argument.domain)).collect();
                let message = format!("no rule `{name}` takes {}", fault::list(&domains));
                let declared: Vec<(Span, String)> = several
                    .iter()
                    .take(3)
                    .map(|id| (self.site.model.rule(*id).span, self.site.rule_signature(*id)))
                    .collect();
                let help = "give arguments of the domains of one of them".to_string();
                fault::rule::argument_domain(span, message, &fault::list(&domains), &declared, help)
            }
        };
        self.site.faults.push(fault);
    }

    /// The rule of that name with exactly these parameter domains, otherwise one whose parameters take them; without
    /// domains, the only one of that name.
    pub(crate) fn rule_by_domains(&mut self, token: &SyntaxToken, domains: &[DomainId], span: Span) -> Option<RuleId> {
        let found = self.find_by_domains(token, domains, span)?;
        self.site.note(self.site.token_span(token), Referent::Rule(found));
        Some(found)
    }

    fn find_by_domains(&mut self, token: &SyntaxToken, domains: &[DomainId], span: Span) -> Option<RuleId> {
        let candidates = self.site.names.rules(token.text());
        if candidates.is_empty() {
            self.site.unknown_rule(token);
            return None;
        }
        let exact = candidates.iter().rev().find(|id| self.formals(**id) == domains);
        if let Some(id) = exact {
            return Some(*id);
        }
        let wider = candidates.iter().rev().find(|id| {
            let formals = self.formals(**id);
            let narrow = |(domain, formal): (&DomainId, &DomainId)| {
                self.site.model.domains.fits(*domain, *formal).is_some_and(|cost| cost < NARROWING)
            };
            formals.len() == domains.len() && domains.iter().zip(&formals).all(narrow)
        });
        if let Some(id) = wider {
            return Some(*id);
        }
        if let ([only], []) = (candidates, domains) {
            return Some(*only);
        }
        if domains.contains(&Domains::ERROR) {
            return None;
        }
        let found: Vec<String> = domains.iter().map(|domain| self.site.display(*domain)).collect();
        let found = fault::list(&found);
        let message = format!("no rule `{}` has the parameters {found}", token.text());
        let declared: Vec<(Span, String)> = candidates
            .iter()
            .take(3)
            .map(|id| (self.site.model.rule(*id).span, self.site.rule_signature(*id)))
            .collect();
        let help = "name the parameter domains as they are declared".to_string();
        self.site.faults.push(fault::rule::argument_domain(span, message, &found, &declared, help));
        None
    }
}
