//! Domains: the sort of each, its carrier, and its values where they can be listed.

use model::{Basic, CollectionKind, DomainId, DomainKind, FunctionKind, Literal, Term, TermKind};
use syntax::Span;

use super::{Result, Translator};
use crate::formula::{Carrier, Sort, Value};

/// LIMIT: a domain of more values is not listed.
const MAX_VALUES: usize = 10_000;

impl Translator<'_> {
    pub(super) fn sort(&mut self, domain: DomainId, span: Span) -> Result<Sort> {
        let domains = &self.model.domains;
        let kind = domains.kind(domains.type_domain(domain));
        Ok(match kind {
            DomainKind::Basic(Basic::Boolean) => Sort::Boolean,
            DomainKind::Basic(Basic::Integer | Basic::Natural) => Sort::Integer,
            DomainKind::Basic(Basic::Real) => Sort::Real,
            DomainKind::Basic(Basic::String | Basic::Char) | DomainKind::Enum { .. } | DomainKind::Abstract { .. } => {
                Sort::Carrier(self.carrier(domains.type_domain(domain)))
            }
            _ => {
                let what = format!("a term of the domain {}", domains.display(domain));
                return self.outside(what, span);
            }
        })
    }

    pub(super) fn is_natural(&self, domain: DomainId) -> bool {
        let domains = &self.model.domains;
        matches!(domains.kind(domains.type_domain(domain)), DomainKind::Basic(Basic::Natural))
    }

    /// The carrier of an enum, an abstract domain, strings or characters.
    pub(super) fn carrier(&mut self, domain: DomainId) -> usize {
        if let Some(index) = self.carriers.get(&domain) {
            return *index;
        }
        let model = self.model;
        let (elements, open) = match model.domains.kind(domain) {
            DomainKind::Enum { literals } => (literals.clone(), false),
            DomainKind::Abstract { dynamic } => {
                let elements = self.statics(domain, domain);
                // What is imported elsewhere may get elements there.
                let open = *dynamic || model.main.is_none() || elements.is_empty();
                (elements, open)
            }
            _ => (Vec::new(), true),
        };
        self.add_carrier(domain, Carrier { name: model.domains.display(domain), elements, open })
    }

    /// The elements with names of a domain: of `part`, or of any part of `whole` where they are the same.
    fn statics(&self, whole: DomainId, part: DomainId) -> Vec<String> {
        let domains = &self.model.domains;
        let is_element = |function: &model::Function| {
            let constant = function.kind == FunctionKind::Static && function.parameters.is_empty();
            let within = function.codomain == part || whole == part && domains.type_domain(function.codomain) == whole;
            constant && function.definition.is_none() && within
        };
        self.model.functions.iter().filter(|function| is_element(function)).map(|f| f.name.clone()).collect()
    }

    /// A character or string as an element of its carrier.
    pub(super) fn text(&mut self, domain: DomainId, text: String) -> Value {
        let carrier = self.carrier(self.model.domains.type_domain(domain));
        let elements = &mut self.formula.carriers[carrier].elements;
        let index = elements.iter().position(|known| *known == text).unwrap_or_else(|| {
            elements.push(text);
            elements.len() - 1
        });
        Value::Element(carrier, index)
    }

    /// The values of a part of a sort; none where it is the whole sort or cannot be listed.
    pub(super) fn values(&mut self, domain: DomainId) -> Option<Vec<Value>> {
        let model = self.model;
        match model.domains.kind(domain) {
            DomainKind::Concrete { definition: Some(definition), dynamic: false, .. } => self.listed(definition),
            DomainKind::Concrete { base, dynamic: false, definition: None } => {
                let carrier = self.carrier_of(*base)?;
                if self.formula.carriers[carrier].open {
                    return None;
                }
                let names = self.statics(*base, domain);
                let index = |name: &String| self.formula.carriers[carrier].elements.iter().position(|e| e == name);
                Some(names.iter().filter_map(|name| Some(Value::Element(carrier, index(name)?))).collect())
            }
            _ => None,
        }
    }

    fn carrier_of(&mut self, domain: DomainId) -> Option<usize> {
        let is_carrier =
            matches!(self.model.domains.kind(domain), DomainKind::Enum { .. } | DomainKind::Abstract { .. });
        is_carrier.then(|| self.carrier(domain))
    }

    /// The elements of a domain, a range or a collection of constants.
    pub(super) fn enumerated(&mut self, term: &Term) -> Option<Vec<Value>> {
        let TermKind::Domain(domain) = term.kind else { return self.listed(term) };
        if let Some(values) = self.values(domain) {
            return Some(values);
        }
        match self.model.domains.kind(domain) {
            DomainKind::Basic(Basic::Boolean) => Some(vec![Value::Boolean(false), Value::Boolean(true)]),
            DomainKind::Enum { .. } | DomainKind::Abstract { .. } => {
                let index = self.carrier(domain);
                let carrier = &self.formula.carriers[index];
                let all = (0..carrier.elements.len()).map(|element| Value::Element(index, element)).collect();
                (!carrier.open).then_some(all)
            }
            _ => None,
        }
    }

    fn listed(&mut self, term: &Term) -> Option<Vec<Value>> {
        match &term.kind {
            TermKind::Collection { kind: CollectionKind::Set | CollectionKind::Seq, elements } => {
                elements.iter().map(|element| self.constant(element)).collect()
            }
            TermKind::Range { low, high, step, .. } => {
                let whole = |term: &Term| whole(term);
                let (low, high) = (whole(low)?, whole(high)?);
                let step = step.as_ref().map_or(Some(1), |step| whole(step)).filter(|step| *step > 0)?;
                let count = high.checked_sub(low)?.checked_div(step)?.saturating_add(1).max(0);
                let count = usize::try_from(count).ok().filter(|count| *count <= MAX_VALUES)?;
                Some((0..count as i64).map(|index| Value::Integer(low + index * step)).collect())
            }
            _ => None,
        }
    }

    fn constant(&mut self, term: &Term) -> Option<Value> {
        match &term.kind {
            TermKind::Literal(Literal::Boolean(truth)) => Some(Value::Boolean(*truth)),
            TermKind::Literal(Literal::Enum(domain, index)) => {
                Some(Value::Element(self.carrier(*domain), *index as usize))
            }
            TermKind::Apply { function, arguments } if arguments.is_empty() => {
                let declared = self.model.function(*function);
                let carrier = self.carrier_of(self.model.domains.type_domain(declared.codomain))?;
                let index = self.formula.carriers[carrier].elements.iter().position(|name| *name == declared.name)?;
                Some(Value::Element(carrier, index))
            }
            _ => whole(term).map(Value::Integer),
        }
    }
}

/// An integer, with its sign.
fn whole(term: &Term) -> Option<i64> {
    match &term.kind {
        TermKind::Literal(Literal::Integer(number)) => Some(*number),
        TermKind::Apply { arguments, .. } => match &arguments[..] {
            // The only operation of one operand on a literal number in a range is its sign.
            [operand] if matches!(operand.kind, TermKind::Literal(Literal::Integer(_))) => {
                whole(operand)?.checked_neg()
            }
            _ => None,
        },
        _ => None,
    }
}
