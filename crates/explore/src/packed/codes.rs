//! How the values of a function become codes, and how many bits a code needs.
//!
//! In: a domain, the values that were found. Out: [`Codes`]: places in a list where there are few values, numbers of an
//! interner otherwise.

use std::sync::Arc;

use machine::{Machine, Value};
use program::{DomainId, DomainKind, Program};

use crate::packed::collection::Collection;

/// LIMIT: a domain with more elements counts as infinite.
const CODES: usize = 1 << 12;

/// How values of one function become codes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Codes {
    /// The place in this list, sorted; undef, where it is possible, comes last.
    Listed { values: Arc<Vec<Value>>, undefined: bool },
    /// Sequences or sets, by their elements.
    InPlace(Collection),
    /// The number that an interner gives.
    Interned,
}

/// How many bits so many codes need.
pub(crate) fn bits_of(count: usize) -> u8 {
    (usize::BITS - count.saturating_sub(1).leading_zeros()) as u8
}

/// How many bits the number of a value has.
pub(crate) const NUMBER: usize = 32;

impl Codes {
    /// The codes of values of a domain and these, of undef where that is possible; and how many bits they need.
    pub fn of<'v>(
        program: &Program,
        constant: &[bool],
        machine: &mut Machine,
        domain: DomainId,
        found: impl Iterator<Item = &'v Value>,
        undefined: bool,
    ) -> (Codes, usize) {
        let Some(mut values) = finite(program, constant, machine, domain) else { return (Codes::Interned, NUMBER) };
        values.extend(found.cloned());
        values.retain(|value| !value.is_undef());
        values.sort_unstable();
        values.dedup();
        let count = values.len() + usize::from(undefined);
        (Codes::Listed { values: Arc::new(values), undefined }, usize::from(bits_of(count)))
    }

    /// The codes of collections of a domain in place, if they all are such, these among them, and never undef; sequences may be so
    /// long.
    pub fn in_place<'v>(
        program: &Program,
        constant: &[bool],
        machine: &mut Machine,
        domain: DomainId,
        found: impl Iterator<Item = &'v Value>,
        longest: usize,
    ) -> Option<Collection> {
        let (part, is_sequence) = match program.domain(program.base_domain(domain)).kind {
            DomainKind::Seq(part) => (part, true),
            DomainKind::Powerset(part) => (part, false),
            _ => return None,
        };
        if !constant[part.0 as usize] || !program.is_listable(part) {
            return None;
        }
        let mut elements = machine.elements(part).ok().filter(|elements| elements.len() <= CODES)?;
        elements.sort_unstable();
        elements.dedup();
        let mut longest = longest;
        let found: Vec<&Value> = found.collect();
        for value in &found {
            if let Value::Seq(items) = value {
                longest = longest.max(items.len());
            }
        }
        let collection = match is_sequence {
            true => Collection::sequences(elements, longest),
            false => Collection::sets(elements),
        };
        collection.filter(|collection| found.iter().all(|value| collection.code(value).is_ok()))
    }
}

/// How a function's values become codes, for who asks.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Coding<'e> {
    /// The place in this list.
    Listed(&'e [Value]),
    /// Bits of its own for each piece of the value.
    InPieces,
    /// The number of the value.
    Numbered,
}

/// The elements of a domain that is finite and the same in all states; `constant` says the latter by domain.
pub(crate) fn finite(
    program: &Program,
    constant: &[bool],
    machine: &mut Machine,
    domain: DomainId,
) -> Option<Vec<Value>> {
    // An update does not check the components of a tuple, so they may be anything.
    let is_tuple = matches!(program.domain(domain).kind, DomainKind::Prod(_));
    if is_tuple || !constant[domain.0 as usize] || !program.is_listable(domain) {
        return None;
    }
    machine.elements(domain).ok().filter(|elements| elements.len() <= CODES)
}
