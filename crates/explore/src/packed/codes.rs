//! How the values of a function become codes, and how many bits a code needs.
//!
//! In: a domain, the values that were found. Out: [`Codes`]: places in a list where there are few values, numbers of an
//! interner otherwise.

use std::sync::Arc;

use machine::{Machine, Value};
use program::{DomainId, DomainKind, Program};

/// LIMIT: a domain with more elements counts as infinite.
const CODES: usize = 1 << 12;

/// How values of one function become codes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Codes {
    /// The place in this list, sorted; undef, where it is possible, comes last.
    Listed { values: Arc<Vec<Value>>, undefined: bool },
    /// The number that an interner gives.
    Interned,
}

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
        let Some(mut values) = finite(program, constant, machine, domain) else { return (Codes::Interned, 32) };
        values.extend(found.cloned());
        values.retain(|value| !value.is_undef());
        values.sort_unstable();
        values.dedup();
        let count = values.len() + usize::from(undefined);
        let bits = (usize::BITS - count.saturating_sub(1).leading_zeros()) as usize;
        (Codes::Listed { values: Arc::new(values), undefined }, bits)
    }
}

/// How a function's values become codes, for who asks.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Coding<'e> {
    /// The place in this list.
    Listed(&'e [Value]),
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
