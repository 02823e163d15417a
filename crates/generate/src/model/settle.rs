//! Finds domains that are declared as growing but never grow.
//!
//! In: a program. Out: the same program, in which domains that no rule extends do not grow: `Agent` in most models, and
//! its declared subsets. Their elements then have places in arrays and are known when code is generated.

use std::collections::BTreeSet;

use program::{DomainId, DomainKind, Program, Rule};

/// The program without growth that never happens.
pub(crate) fn settled(program: &Program) -> Program {
    let growing: BTreeSet<DomainId> = program
        .rules
        .iter()
        .filter_map(|rule| match rule {
            Rule::Extend { domain, .. } => Some(program.base_domain(*domain)),
            Rule::Skip
            | Rule::Update { .. }
            | Rule::Call { .. }
            | Rule::TurboCall { .. }
            | Rule::Return { .. }
            | Rule::RunValue { .. }
            | Rule::RunAgent { .. }
            | Rule::Par(_)
            | Rule::Seq(_)
            | Rule::If { .. }
            | Rule::Switch { .. }
            | Rule::Let { .. }
            | Rule::Choose { .. }
            | Rule::Forall { .. }
            | Rule::Iterate(_)
            | Rule::While { .. }
            | Rule::RecursiveWhile { .. }
            | Rule::Local { .. } => None,
        })
        .collect();
    let mut settled = program.clone();
    for (index, domain) in settled.domains.iter_mut().enumerate() {
        if growing.contains(&program.base_domain(DomainId(index as u32))) {
            continue;
        }
        match &mut domain.kind {
            DomainKind::Abstract { dynamic, .. } => *dynamic = false,
            // Contents that depend on the environment or the state are unknown when code is generated.
            DomainKind::Concrete { dynamic, contents, .. }
                if contents
                    .as_ref()
                    .is_none_or(|contents| program.reads(contents).is_some_and(|read| read.is_empty())) =>
            {
                *dynamic = false;
            }
            _ => {}
        }
    }
    settled
}
