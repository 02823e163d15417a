//! The meaning of each variable, and the slots of a frame.
//!
//! The variables of a model are numbered by declaration. A body can hold terms of several declarations, because by-name
//! arguments are lowered within the callee. An [`Environment`] is about the variables of *one* declaration and the
//! slots of *one* frame. INVARIANT: only one place of a body binds a slot, so no name can capture another.

use std::collections::BTreeMap;

use model::{Binder, DomainId, DomainKind, Variable, VariableId};

use crate::ir::ArgumentId;
use crate::ir::{self, BinderList, Slot};
use crate::lower::Lowering;

/// What a variable stands for.
#[derive(Debug, Clone)]
pub(super) enum Binding {
    /// A value in the frame.
    Slot(Slot),
    /// A term to be lowered wherever the variable stands; its free slots are these.
    ByName { argument: ArgumentId, slots: Vec<Slot> },
}

/// What the variables of one declaration stand for.
#[derive(Debug, Clone, Default)]
pub(super) struct Environment<'m> {
    /// The variables of the declaration.
    pub variables: &'m [Variable],
    /// Those in scope.
    pub bindings: BTreeMap<VariableId, Binding>,
}

/// The slots of a body.
#[derive(Debug, Default)]
pub(super) struct Frame {
    pub names: Vec<String>,
    pub domains: Vec<DomainId>,
}

impl Frame {
    /// A new slot.
    pub fn add(&mut self, name: String, domain: DomainId) -> Slot {
        self.names.push(name);
        self.domains.push(domain);
        Slot(self.names.len() as u32 - 1)
    }
}

impl<'m> Lowering<'m, '_> {
    /// Binds a variable of the current declaration to a new slot. `domain` is that of its values, for the few
    /// terms whose variables are not listed.
    pub(super) fn bind(&mut self, variable: VariableId, domain: DomainId) -> Slot {
        let (name, domain) = match self.environment.variables.get(variable.0 as usize) {
            Some(known) => (known.name.clone(), known.domain),
            None => (format!("$${}", variable.0), domain),
        };
        let slot = self.frame.add(name, domain);
        self.environment.bindings.insert(variable, Binding::Slot(slot));
        slot
    }

    /// Lowers binders from left to right; a range may use the variables before it.
    pub(super) fn lower_binders(&mut self, binders: &'m [Binder]) -> BinderList {
        let mut lowered = Vec::with_capacity(binders.len());
        for binder in binders {
            let range = self.lower_term(&binder.range);
            let slot = self.bind(binder.variable, self.element_domain(binder.range.domain));
            lowered.push(ir::Binder { slot, range });
        }
        self.binder_list(&lowered)
    }

    fn element_domain(&self, collection: DomainId) -> DomainId {
        match self.model.domains.kind(self.model.domains.type_domain(collection)) {
            DomainKind::Powerset(of) | DomainKind::Seq(of) | DomainKind::Bag(of) => *of,
            _ => collection,
        }
    }
}
