//! Terms and rules from elsewhere, checked as if a model's root file contained them.
//!
//! In: a checked model, and views of a term, rule or location in another text (a scenario, a command line). Out: the
//! resolved term or rule with its variables, and the faults found. A fragment only adds structured domains and
//! local functions to the model's tables. It sees all names of the root file, also the imported ones.

use syntax::{Diagnostic, FileId, ast};

use crate::check::body::{Body, Bound};
use crate::check::local_state::Writes;
use crate::coerce::can_coerce;
use crate::declaration::{Rule, Variable};
use crate::domain::Domains;
use crate::fault::{self, Faults};
use crate::id::DomainId;
use crate::macros;
use crate::model::Model;
use crate::rule::{RuleNode, Target};
use crate::site::Site;
use crate::term::Term;

/// A term, rule or update from elsewhere, checked.
#[derive(Debug, Clone)]
pub struct Fragment<T> {
    /// What was checked; complete when `diagnostics` hold no error.
    pub item: T,
    /// The variables in it.
    pub variables: Vec<Variable>,
    /// Faults, in the order of their positions.
    pub diagnostics: Vec<Diagnostic>,
}

impl Fragment<RuleNode> {
    /// The checked rule as a separate rule without parameters.
    pub fn into_rule(self) -> Rule {
        Rule {
            name: "exec".to_string(),
            turbo: false,
            variables: self.variables,
            parameters: Vec::new(),
            result: None,
            span: self.item.span,
            body: self.item,
        }
    }
}

impl Model {
    /// Checks a term. `file` has its text: add it to the [`crate::Checked::sources`] of the model, so that faults can
    /// point to both.
    pub fn check_term(&mut self, file: FileId, term: &ast::Term) -> Fragment<Term> {
        self.fragment(file, |body| body.term(term))
    }

    /// Checks a term that must be Boolean; `what` names it in a fault: "the condition of `check`".
    pub fn check_condition(&mut self, file: FileId, term: &ast::Term, what: &str) -> Fragment<Term> {
        self.fragment(file, |body| {
            let place = body.place(term);
            body.condition(Some(term.clone()), place, what)
        })
    }

    /// Checks a term that must be of a domain, and converts it to that domain; `what` names what takes it: "`$x`".
    pub fn check_value(&mut self, file: FileId, term: &ast::Term, domain: DomainId, what: &str) -> Fragment<Term> {
        self.fragment(file, |body| {
            let value = body.term(term);
            if can_coerce(body.site.model, &value, domain) {
                return body.coerce(value, domain);
            }
            let mismatch = body.site.mismatch(domain, value.domain);
            body.site.faults.push(fault::rule::value_domain(value.span, what, &mismatch));
            value
        })
    }

    /// Checks an update by the environment: the target is a monitored or shared function. None after a fault.
    pub fn check_set(
        &mut self,
        file: FileId,
        target: &ast::Term,
        value: &ast::Term,
    ) -> Fragment<Option<(Target, Term)>> {
        self.fragment(file, |body| {
            body.as_environment = true;
            let place = body.place(target);
            body.update_of(Some(target.clone()), Some(value.clone()), place)
        })
    }

    /// Checks a rule of a scenario; it may update monitored functions as well.
    pub fn check_rule(&mut self, file: FileId, rule: &ast::Rule) -> Fragment<RuleNode> {
        let updated = Writes::of(rule).updated(&macros::updated_by_name(self));
        let mut fragment = self.fragment(file, |body| {
            body.updated = updated;
            body.in_scenario = true;
            body.rule(rule)
        });
        let mut faults = Faults::default();
        macros::check_fragment(self, &fragment.item, &mut faults);
        fragment.diagnostics.extend(faults.into_sorted());
        fragment
    }

    /// The domain of that name in the root file.
    pub fn domain_named(&self, name: &str) -> Option<DomainId> {
        self.names.domain(name).or_else(|| crate::site::predefined(name)).filter(|id| *id != Domains::ERROR)
    }

    fn fragment<T>(&mut self, file: FileId, check: impl FnOnce(&mut Body<'_>) -> T) -> Fragment<T> {
        let mut names = std::mem::take(&mut self.names);
        names.beside = true;
        let mut faults = Faults::default();
        let site = Site { model: self, names: &names, faults: &mut faults, file };
        let mut body = Body::new(site, &[], Bound::Parameter);
        let item = check(&mut body);
        let variables = body.variables;
        names.beside = false;
        self.names = names;
        Fragment { item, variables, diagnostics: faults.into_sorted() }
    }
}
