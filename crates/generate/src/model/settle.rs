//! Finds domains that are declared as growing but never grow.
//!
//! In: a program. Out: the same program, in which domains with the same elements in all states are declared as such: `Agent`
//! in most models, and its subsets. Their elements then have places in arrays and are known when code is generated.

use program::{DomainId, DomainKind, Program};

/// The program without growth that never happens.
pub(crate) fn settled(program: &Program) -> Program {
    let constant = program.constant_domains();
    let mut settled = program.clone();
    for (index, domain) in settled.domains.iter_mut().enumerate() {
        // A subset of a domain that grows stays a set of numbers of its elements.
        let base = program.base_domain(DomainId(index as u32));
        if let DomainKind::Abstract { dynamic, .. } | DomainKind::Concrete { dynamic, .. } = &mut domain.kind
            && constant[index]
            && constant[base.0 as usize]
        {
            *dynamic = false;
        }
    }
    settled
}
