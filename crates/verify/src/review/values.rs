//! MP5 and MP6: the elements of domains, and the values of functions.
//!
//! In: the values that occurred. An element is used if it is the value of some location, or a part of one: of a dynamic
//! location in some state, of an input that a rule reads, of a static function without a definition. The initial values of a function
//! that has more locations than can be listed are those that are written as its alternatives; if they are computed, it is unknown
//! whether what is missing is among them.
//! LIMIT: domains with more elements, and growing ones, are skipped; derived functions are not considered.

use std::collections::{BTreeMap, BTreeSet};

use machine::{Observation, Value};
use model::FunctionKind;
use program::{DomainId, DomainKind, FunctionId, Term, TermId};

use crate::review::{Matter, Meta, Reviewer};

/// LIMIT: domains with more elements are skipped.
const ELEMENTS: usize = 1 << 12;

impl Reviewer<'_> {
    pub(super) fn values(&mut self) {
        let met = self.survey.values();
        let mut taken: BTreeMap<FunctionId, BTreeSet<Value>> = BTreeMap::new();
        for (location, values) in met {
            taken.entry(location.function).or_default().extend(values);
        }
        self.elements(&taken);
        for index in 0..self.program.functions.len() {
            let (id, function) = (FunctionId(index as u32), &self.program.functions[index]);
            let written = matches!(function.kind, FunctionKind::Controlled | FunctionKind::Out);
            if function.library || !written || !self.is_own(function.span) {
                continue;
            }
            let span = function.span;
            let Some(elements) = self.values_of(function.codomain) else { continue };
            let begun = self.written_initials(id);
            let none = BTreeSet::new();
            let taken = taken.get(&id).unwrap_or(&none);
            let is_taken = |value: &Value| taken.contains(value) || begun.as_ref().is_some_and(|it| it.contains(value));
            let missing: Vec<Value> = elements.into_iter().filter(|value| !is_taken(value)).collect();
            match begun {
                _ if missing.is_empty() => {}
                None => _ = self.unclear.insert((Meta::ValueTaken, id)),
                Some(_) => self.find(Meta::ValueTaken, Matter::NeverTaken(id, missing), span),
            }
        }
    }

    /// The initial values of a function whose locations cannot be listed; none if they are computed. Those of other functions have been met.
    fn written_initials(&mut self, id: FunctionId) -> Option<BTreeSet<Value>> {
        let mut found = BTreeSet::new();
        if !self.all_locations(id).is_empty() {
            return Some(found);
        }
        let program = self.program;
        let initials = program.initials.iter().filter(|initial| initial.function == id);
        let mut open: Vec<TermId> = initials.map(|initial| initial.value.body).collect();
        while let Some(term) = open.pop() {
            match program.term(term) {
                Term::If { branches, otherwise } | Term::Switch { cases: branches, otherwise, .. } => {
                    open.extend(program.term_list(*branches).iter().skip(1).step_by(2));
                    open.extend(otherwise);
                }
                Term::Let { body, .. } => open.push(*body),
                _ => {
                    found.insert(self.written(term)?);
                }
            }
        }
        Some(found)
    }

    /// The value of a term that is a literal or an element.
    fn written(&self, term: TermId) -> Option<Value> {
        match self.program.term(term) {
            Term::Constant(index) => match self.program.constants[*index as usize] {
                program::Literal::Enum(domain, literal) => Some(Value::Enum(domain, literal)),
                program::Literal::Integer(number) => Some(Value::Integer(number)),
                program::Literal::Boolean(truth) => Some(Value::Boolean(truth)),
                program::Literal::Undef => Some(Value::Undef),
                _ => None,
            },
            Term::Read { function, .. } => {
                let function = self.program.function(*function);
                let domain = self.program.base_domain(function.codomain);
                function.element.map(|element| Value::Element(domain, element))
            }
            _ => None,
        }
    }

    /// The values of a codomain, if they are not too many: its elements, or its sets.
    fn values_of(&mut self, domain: DomainId) -> Option<Vec<Value>> {
        let DomainKind::Powerset(of) = self.program.domain(domain).kind else {
            return self.survey.elements(domain, ELEMENTS);
        };
        let elements = self.survey.elements(of, ELEMENTS.ilog2() as usize)?;
        let set = |chosen: usize| {
            let within = (0..elements.len()).filter(|place| chosen >> place & 1 == 1);
            Value::set(within.map(|place| elements[place].clone()).collect())
        };
        Some((0..1 << elements.len()).map(set).collect())
    }

    /// MP5.
    fn elements(&mut self, taken: &BTreeMap<FunctionId, BTreeSet<Value>>) {
        let mut used: BTreeSet<Value> = BTreeSet::new();
        for value in taken.values().flatten() {
            parts(value, &mut used);
        }
        let mut read: BTreeSet<FunctionId> = self.read_functions();
        read.extend(self.read_by_initials());
        for id in read {
            let function = self.program.function(id);
            if function.kind == FunctionKind::Monitored
                && let Some(elements) = self.survey.elements(function.codomain, ELEMENTS)
            {
                used.extend(elements);
            }
        }
        self.constants_of_statics(&mut used);
        let program = self.program;
        let mut computed = Vec::new();
        for initial in &program.initials {
            match self.written_initials(initial.function) {
                Some(begun) => begun.iter().for_each(|value| parts(value, &mut used)),
                None => computed.push((Meta::ElementUsed, initial.function)),
            }
        }
        let mut index = 0;
        while let Some(domain) = self.program.domains.get(index) {
            let id = DomainId(index as u32);
            index += 1;
            let Some(span) = self.model.domains.get(id).span.filter(|span| (self.own)(span.file)) else { continue };
            let fixed = match &domain.kind {
                DomainKind::Enum { .. } => true,
                DomainKind::Abstract { dynamic, .. } | DomainKind::Concrete { dynamic, .. } => !dynamic,
                _ => false,
            };
            if !fixed {
                continue;
            }
            let Some(elements) = self.survey.elements(id, ELEMENTS) else { continue };
            let missing: Vec<Value> = elements.into_iter().filter(|element| !used.contains(element)).collect();
            if !missing.is_empty() && !computed.is_empty() {
                self.unclear.extend(&computed);
            } else if !missing.is_empty() {
                self.find(Meta::ElementUsed, Matter::Unused(id, missing), span);
            }
        }
    }

    pub(super) fn read_functions(&self) -> BTreeSet<FunctionId> {
        let read = self.survey.sightings.iter().filter_map(|sighting| match sighting.observation {
            Observation::Read(function, _) => Some(function),
            _ => None,
        });
        read.collect()
    }

    /// The elements and literals in the definitions of static functions.
    fn constants_of_statics(&self, used: &mut BTreeSet<Value>) {
        let statics = self.program.functions.iter().filter(|f| f.kind == FunctionKind::Static && !f.library);
        let mut open: Vec<_> =
            statics.filter_map(|f| f.definition.as_ref().map(|definition| definition.body)).collect();
        while let Some(term) = open.pop() {
            self.program.each_child_of_term(term, &mut |child| open.push(child));
            used.extend(self.written(term));
        }
    }
}

/// A value and all its parts.
fn parts(value: &Value, into: &mut BTreeSet<Value>) {
    if !into.insert(value.clone()) {
        return;
    }
    match value {
        Value::Tuple(items) => items.iter().for_each(|item| parts(item, into)),
        Value::Seq(items) | Value::Set(items) => items.iter().for_each(|item| parts(item, into)),
        Value::Bag(items) => items.keys().for_each(|item| parts(item, into)),
        Value::Map(entries) => entries.iter().for_each(|(key, value)| {
            parts(key, into);
            parts(value, into);
        }),
        _ => {}
    }
}
