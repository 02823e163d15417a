//! Symmetry reduction: states that differ only by a permutation of interchangeable elements count as one.
//!
//! In: a program and the targets. Out: classes of interchangeable elements, and for each domain without one, why (C.
//! Ip, D. Dill, *Better verification through symmetry*, 1996). [`telling`] finds from the text which elements are named
//! and where an order is visible. What the text does not show is watched during the search: below a quantifier or a
//! `forall`, a fault may come before or after the element that decides. If that happens, the search starts again
//! without these classes. INVARIANT: a permutation of a class maps steps to steps, and preserves the truth of every
//! condition.

mod element;
mod telling;

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use explore::{Explorer, Orbits};
use machine::{Closed, Machine, Value};
use program::{DomainId, DomainKind, FunctionId, Program};
use syntax::Span;

use crate::plan::Plan;
pub use crate::symmetry::element::Distinct;
use crate::symmetry::element::{count, element};
use crate::symmetry::telling::Telling;

/// LIMIT: the most elements in a class.
const ELEMENTS: usize = 64;

/// The interchangeable elements of domains.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Symmetry {
    /// The elements that are interchangeable with each other.
    pub classes: Vec<(DomainId, Vec<Value>)>,
    /// The domains without interchangeable elements, and why.
    pub distinct: Vec<(DomainId, Distinct)>,
}

/// What a search needs for symmetry reduction.
#[derive(Debug, Clone, Default)]
pub(crate) struct Interchange {
    pub symmetry: Symmetry,
    /// For each term, whether it is a range over such elements.
    pub unordered: Arc<[bool]>,
    /// The elements that initial values name, by function.
    initial: BTreeMap<FunctionId, BTreeMap<Value, Span>>,
}

/// The domains whose elements might be interchangeable.
fn candidates(program: &Program) -> Vec<DomainId> {
    let all = (0..program.domains.len()).map(|index| DomainId(index as u32));
    all.filter(|domain| count(program, *domain) >= 2).collect()
}

impl Interchange {
    /// The result of analysing the text.
    pub fn new(program: &Arc<Program>, plan: &Plan) -> Interchange {
        let candidates = candidates(program);
        let mut telling = Telling::of(program, &plan.settings, &candidates);
        for (function, values) in plan.settings.bounds.iter() {
            telling.bound(*function, values);
        }
        let mut machine = Machine::new(Arc::clone(program), plan.settings.limits.clone());
        // The contents of domains do not depend on the state, so a failed start does not matter.
        let _ = machine.start(&mut Closed);
        let mut symmetry = Symmetry::default();
        for domain in candidates {
            let distinct = match telling.extended {
                Some(span) => Some(Distinct::Extended(span)),
                None => telling.told.get(&domain).map(|span| Distinct::Told(*span)),
            };
            match distinct.map_or_else(|| classes(program, &mut machine, domain, &telling), Err) {
                Ok(classes) => symmetry.classes.extend(classes.into_iter().map(|class| (domain, class))),
                Err(distinct) => symmetry.distinct.push((domain, distinct)),
            }
        }
        let domains: BTreeSet<DomainId> = symmetry.classes.iter().map(|(domain, _)| *domain).collect();
        let mut unordered = vec![false; if domains.is_empty() { 0 } else { program.terms.len() }];
        for range in &telling.ranges {
            let over = program.term_domain(*range);
            if domains.iter().any(|domain| telling::mentions(program, over, *domain)) {
                unordered[range.0 as usize] = true;
            }
        }
        Interchange { symmetry, unordered: unordered.into(), initial: telling.initial }
    }

    /// The orbits of an explorer's states; `None` if no elements are interchangeable, which is then recorded.
    pub fn orbits(&mut self, program: &Program, explorer: &Explorer) -> Option<Arc<Orbits>> {
        if self.symmetry.classes.is_empty() {
            return None;
        }
        // An initial value that does not belong to the state from the beginning appears later, the same in all states;
        // so does one of a location outside of the declared domains.
        let is_late = |function: FunctionId| {
            let mut parameters = program.function(function).parameters.iter();
            let may_be_outside =
                |domain: &DomainId| matches!(program.domain(*domain).kind, DomainKind::Concrete { .. });
            !explorer.has_fields(function) || parameters.any(may_be_outside)
        };
        let late = self.initial.iter().filter(|(function, _)| is_late(**function));
        let named: BTreeMap<Value, Span> = late.flat_map(|(_, named)| named.clone()).collect();
        let classes = std::mem::take(&mut self.symmetry.classes);
        for (domain, class) in classes {
            match class.iter().find_map(|element| named.get(element)) {
                Some(span) => self.symmetry.distinct.push((domain, Distinct::Named(*span))),
                None => self.symmetry.classes.push((domain, class)),
            }
        }
        let classes: Vec<Vec<Value>> = self.symmetry.classes.iter().map(|(_, class)| class.clone()).collect();
        let holds = |function: FunctionId| {
            let codomain = program.function(function).codomain;
            self.symmetry.classes.iter().any(|(domain, _)| telling::mentions(program, codomain, *domain))
        };
        let orbits = if classes.is_empty() { None } else { explorer.orbits(&classes, &holds) };
        if orbits.is_none() {
            self.refuse(Distinct::Packed);
        }
        self.symmetry.distinct.sort_unstable();
        orbits.map(Arc::new)
    }

    /// Records that the elements are not interchangeable after all.
    pub fn refuse(&mut self, why: Distinct) {
        for (domain, _) in std::mem::take(&mut self.symmetry.classes) {
            if self.symmetry.distinct.last() != Some(&(domain, why)) {
                self.symmetry.distinct.push((domain, why));
            }
        }
        self.symmetry.distinct.sort_unstable();
        self.unordered = Arc::default();
    }
}

/// The classes of a domain's elements, at least one.
fn classes(
    program: &Program,
    machine: &mut Machine,
    domain: DomainId,
    telling: &Telling,
) -> Result<Vec<Vec<Value>>, Distinct> {
    let elements: Vec<Value> =
        (0..count(program, domain)).map(|index| element(program, domain, index as u32)).collect();
    if elements.len() > ELEMENTS {
        return Err(Distinct::Packed);
    }
    let mut subsets = Vec::new();
    for (index, subset) in program.domains.iter().enumerate() {
        if let DomainKind::Concrete { base, dynamic: false, .. } = subset.kind
            && base == domain
        {
            subsets.push(machine.elements(DomainId(index as u32)).map_err(|_| Distinct::Packed)?);
        }
    }
    let mut by_subsets: BTreeMap<Vec<bool>, Vec<Value>> = BTreeMap::new();
    for element in elements.iter().filter(|element| !telling.named.contains_key(element)) {
        let signature = subsets.iter().map(|subset| subset.contains(element)).collect();
        by_subsets.entry(signature).or_default().push(element.clone());
    }
    let mut classes: Vec<Vec<Value>> = by_subsets.into_values().filter(|class| class.len() > 1).collect();
    classes.sort_unstable();
    if !classes.is_empty() {
        return Ok(classes);
    }
    let named = elements.iter().filter_map(|element| telling.named.get(element)).min();
    Err(named.copied().unwrap_or(Distinct::Subsets))
}
