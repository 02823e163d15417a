//! The table of domains: what a run needs to know of each.
//!
//! INVARIANT: a domain has the model's id. The contents of a static concrete domain come from its definition, those of
//! a dynamic one from the initial state. The functions that denote elements give them their names.

use model::{DomainId, FunctionKind, Init};

use crate::ir::{Domain, DomainKind};
use crate::lower::Lowering;

impl<'m> Lowering<'m, '_> {
    /// Adds the domains that the program lacks, without contents.
    pub(super) fn lower_domains(&mut self) {
        for (id, domain) in self.model.domains.iter().skip(self.program.domains.len()) {
            let kind = match &domain.kind {
                model::DomainKind::Error => DomainKind::Error,
                model::DomainKind::Any => DomainKind::Any,
                model::DomainKind::Basic(basic) => DomainKind::Basic(*basic),
                model::DomainKind::Enum { literals } => DomainKind::Enum { literals: literals.clone() },
                model::DomainKind::Abstract { dynamic } => {
                    DomainKind::Abstract { elements: Vec::new(), dynamic: *dynamic }
                }
                model::DomainKind::Concrete { base, dynamic, .. } => {
                    DomainKind::Concrete { base: *base, dynamic: *dynamic, elements: Vec::new(), contents: None }
                }
                model::DomainKind::Prod(parts) => DomainKind::Prod(parts.clone()),
                model::DomainKind::Seq(of) => DomainKind::Seq(*of),
                model::DomainKind::Powerset(of) => DomainKind::Powerset(*of),
                model::DomainKind::Bag(of) => DomainKind::Bag(*of),
                model::DomainKind::Map(key, value) => DomainKind::Map(*key, *value),
                model::DomainKind::Rule(parts) => DomainKind::Rule(parts.clone()),
            };
            let names = &self.model.names;
            let seen = match &kind {
                DomainKind::Enum { literals } => {
                    literals.iter().all(|literal| names.literal(literal).is_some_and(|(of, _)| of == id))
                }
                DomainKind::Abstract { .. } => {
                    let is_element = |function: &model::Function| {
                        function.kind == FunctionKind::Static
                            && function.parameters.is_empty()
                            && function.codomain == id
                    };
                    let mut elements = self.model.functions().filter(|(_, function)| is_element(function));
                    elements.all(|(element, function)| function.library || names.sees(&function.name, element))
                }
                _ => true,
            };
            self.program.domains.push(Domain { name: self.model.domains.display(id), kind, seen });
        }
    }

    /// Fills in the contents of static concrete domains, from that id on.
    pub(super) fn lower_static_contents(&mut self, from: usize) {
        let model = self.model;
        for (id, domain) in model.domains.iter().skip(from) {
            if let model::DomainKind::Concrete { definition: Some(term), .. } = &domain.kind {
                self.lower_contents(id, term);
            }
        }
    }

    /// Fills in the initial contents of dynamic concrete domains.
    pub(super) fn lower_initial_contents(&mut self, init: &'m Init) {
        for (id, term) in &init.domains {
            self.lower_contents(*id, term);
        }
    }

    fn lower_contents(&mut self, id: DomainId, term: &'m model::Term) {
        let lowered = self.lower_expression(&[], &[], term);
        if let DomainKind::Concrete { contents, .. } = &mut self.program.domains[id.0 as usize].kind {
            *contents = Some(lowered);
        }
    }
}
