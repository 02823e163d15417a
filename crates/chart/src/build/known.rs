//! What the imports of a chart declare, by name: links to these are kept, others are made.

use std::collections::BTreeSet;

use model::{DomainKind, Model};

/// Names that exist already.
#[derive(Debug, Clone, Default)]
pub struct Known {
    /// Functions and enum literals.
    pub terms: BTreeSet<String>,
    /// Rules.
    pub rules: BTreeSet<String>,
    /// Domains.
    pub domains: BTreeSet<String>,
}

impl Known {
    /// The names of a model, those of its imports included.
    pub fn of(model: &Model) -> Known {
        let mut known = Known::default();
        known.terms.extend(model.functions.iter().map(|function| function.name.clone()));
        known.rules.extend(model.rules.iter().map(|rule| rule.name.clone()));
        for (_, domain) in model.domains.iter() {
            known.domains.extend(domain.name.clone());
            if let DomainKind::Enum { literals } = &domain.kind {
                known.terms.extend(literals.iter().cloned());
            }
        }
        known
    }
}
