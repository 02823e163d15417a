//! Invariants, temporal properties and assumptions.
//!
//! In: typed views. Out: [`Property`] with a Boolean formula. The `over` list of an invariant says nothing to the
//! machine; its names are only looked up.

use syntax::ast;
use syntax::{Sources, Span, SyntaxKind};

use super::body::{Body, Bound};
use crate::coerce::can_coerce;
use crate::domain::Domains;
use crate::fault;
use crate::model::{Property, PropertyKind};
use crate::site::Site;
use crate::suggest::did_you_mean;
use crate::term::Term;

/// Checks a property and adds it to the model.
pub(crate) fn property(mut site: Site<'_>, written: &ast::Property, sources: &Sources) {
    let span = site.span(written);
    let name = written.name();
    if let Some(token) = &name {
        let same = |other: &&Property| other.span.file == span.file && other.name == token.text();
        if let Some(first) = site.model.properties.iter().find(same).map(|property| property.span) {
            let place = site.token_span(token);
            site.faults.push(fault::name::duplicate_property(place, first, token.text()));
        }
    }
    if let ast::Property::Invariant(invariant) = written {
        report_over(&mut site, invariant);
    }
    let (kind, what, formulas) = match written {
        ast::Property::Invariant(p) => (PropertyKind::Invariant, "an invariant", vec![p.term()]),
        ast::Property::Invar(p) => (PropertyKind::Invar, "an `INVAR` assumption", vec![p.term()]),
        ast::Property::Justice(p) => (PropertyKind::Justice, "a `JUSTICE` assumption", vec![p.term()]),
        ast::Property::Compassion(p) => {
            (PropertyKind::Compassion, "a `COMPASSION` assumption", vec![p.premise(), p.conclusion()])
        }
        ast::Property::Ctl(p) => (PropertyKind::Ctl, "a CTL property", vec![p.term()]),
        ast::Property::Ltl(p) => (PropertyKind::Ltl, "an LTL property", vec![p.term()]),
    };
    let line = sources.file(span.file).line_column(span.start).line;
    let name = name.map_or_else(|| format!("{} at line {line}", word(kind)), |token| token.text().to_string());
    let before = site.faults.len();
    let mut body = Body::new(site, &[], Bound::Parameter);
    let mut formulas =
        formulas.into_iter().map(|formula| formula_of(&mut body, formula, span, what)).collect::<Vec<_>>().into_iter();
    let Some(formula) = formulas.next() else { return };
    let conclusion = formulas.next();
    let Body { site, variables, .. } = body;
    site.faults.amend(before, |fault| fault::name::missing_operator(fault, kind));
    site.model.properties.push(Property { kind, name, variables, formula, conclusion, span });
}

fn word(kind: PropertyKind) -> &'static str {
    match kind {
        PropertyKind::Invariant => "invariant",
        PropertyKind::Invar => "INVAR",
        PropertyKind::Ctl => "CTLSPEC",
        PropertyKind::Ltl => "LTLSPEC",
        PropertyKind::Justice => "JUSTICE",
        PropertyKind::Compassion => "COMPASSION",
    }
}

fn formula_of(body: &mut Body<'_>, formula: Option<ast::Term>, place: Span, what: &str) -> Term {
    let formula = body.optional_term(formula, place);
    if !can_coerce(body.site.model, &formula, Domains::BOOLEAN) {
        let found = body.site.display(formula.domain);
        body.site.faults.push(fault::property::not_boolean(formula.span, what, &found));
    }
    formula
}

fn report_over(site: &mut Site<'_>, invariant: &ast::Invariant) {
    let items = invariant.over().into_iter().flat_map(|over| over.items());
    for token in items.filter_map(|item| item.name()) {
        let names = site.names;
        let name = token.text();
        let span = site.token_span(&token);
        site.model.uses.add_all(span, name, names);
        let known = match token.kind() {
            SyntaxKind::FUNCTION_ID => names.functions.contains_key(name),
            SyntaxKind::RULE_ID => names.rules.contains_key(name),
            SyntaxKind::DOMAIN_ID | SyntaxKind::ENUM_ID => {
                names.domains.contains_key(name) || names.literals.contains_key(name)
            }
            _ => true,
        };
        if known || names.incomplete {
            continue;
        }
        let all = names.functions.keys().chain(names.domains.keys()).chain(names.rules.keys());
        let help = did_you_mean(name, all.map(|name| &**name), || "remove it from the list behind `over`".to_string());
        site.faults.push(fault::property::over_unknown(span, name, help));
    }
}
