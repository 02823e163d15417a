//! The table of functions, the elements that some of them denote, and the meaning of an application of each.
//!
//! INVARIANT: a function has the model's id. The elements of an abstract domain are the 0-ary static functions that are
//! declared in it or in a subset of it and have no definition. They are numbered from 0 in order of declaration.

use model::{Definition, DomainId, FunctionId, FunctionKind, Init};

use crate::ir::{DomainKind, Function, Initial};
use crate::lower::meaning::Meaning;
use crate::lower::{Lowering, builtin};

impl<'m> Lowering<'m, '_> {
    /// The meaning of an application of a function.
    pub(super) fn meaning(&mut self, id: FunctionId) -> Meaning {
        if let Some(known) = self.meanings.get(&id) {
            return *known;
        }
        let function = self.model.function(id);
        let meaning = match function.kind {
            FunctionKind::Static | FunctionKind::Derived => {
                if definition(function).is_some() {
                    Meaning::Define
                } else if function.library {
                    builtin::resolve(self.model, function).unwrap_or(Meaning::Read)
                } else if self.program.function(id).element.is_some() {
                    Meaning::Read
                } else {
                    Meaning::Missing
                }
            }
            FunctionKind::Monitored
            | FunctionKind::Controlled
            | FunctionKind::Shared
            | FunctionKind::Out
            | FunctionKind::Local => Meaning::Read,
        };
        self.meanings.insert(id, meaning);
        meaning
    }

    /// Adds the functions that the program does not have yet, without definitions.
    pub(super) fn lower_functions(&mut self) {
        for (id, function) in self.model.functions().skip(self.program.functions.len()) {
            let element = self.element(function);
            let seen =
                function.library || function.kind == FunctionKind::Local || self.model.names.sees(&function.name, id);
            let is_homonym = |(other, one): (FunctionId, &model::Function)| {
                other != id && one.name == function.name && one.parameters.len() == function.parameters.len()
            };
            let qualified = !seen && self.model.functions().any(is_homonym);
            let module = self.model.modules.get(&function.span.file).cloned().unwrap_or_default();
            self.program.functions.push(Function {
                name: function.name.clone(),
                kind: function.kind,
                parameters: function.parameters.clone(),
                codomain: function.codomain,
                definition: None,
                element,
                library: function.library,
                seen,
                module,
                qualified,
                span: function.span,
            });
            let id = Some(FunctionId(self.program.functions.len() as u32 - 1));
            if function.library && function.kind == FunctionKind::Controlled && function.parameters.is_empty() {
                match function.name.as_str() {
                    "self" => self.program.self_function = id,
                    "result" => self.program.result_function = id,
                    _ => {}
                }
            }
        }
    }

    /// Fills in the definitions of static and derived functions, from that id on.
    pub(super) fn lower_function_definitions(&mut self, from: usize) {
        let model = self.model;
        for (id, function) in model.functions().skip(from) {
            if let Some(definition) = definition(function) {
                let lowered = self.lower_expression(&definition.variables, &definition.parameters, &definition.body);
                self.program.functions[id.0 as usize].definition = Some(lowered);
            }
        }
    }

    /// Adds the initial values of an initial state.
    pub(super) fn lower_initial_values(&mut self, init: &'m Init) {
        for initial in &init.functions {
            let definition = &initial.definition;
            if definition.parameters.len() != self.model.function(initial.function).parameters.len() {
                continue;
            }
            let value = self.lower_expression(&definition.variables, &definition.parameters, &definition.body);
            self.program.initials.push(Initial { function: initial.function, value, span: initial.span });
        }
    }

    /// The element that a function denotes, if it denotes one; gives it a number.
    fn element(&mut self, function: &model::Function) -> Option<u32> {
        let constant =
            function.kind == FunctionKind::Static && function.parameters.is_empty() && function.definition.is_none();
        if !constant {
            return None;
        }
        let base = self.model.domains.type_domain(function.codomain);
        let number = match self.domain_kind(base) {
            DomainKind::Abstract { elements, .. } => {
                elements.push(function.name.clone());
                elements.len() as u32 - 1
            }
            _ => return None,
        };
        if let DomainKind::Concrete { elements, .. } = self.domain_kind(function.codomain) {
            elements.push(number);
        }
        Some(number)
    }

    fn domain_kind(&mut self, id: DomainId) -> &mut DomainKind {
        &mut self.program.domains[id.0 as usize].kind
    }
}

/// The definition of a static or derived function, unless a reported fault left only a part of it.
fn definition(function: &model::Function) -> Option<&Definition> {
    let defined = matches!(function.kind, FunctionKind::Static | FunctionKind::Derived);
    let fits = |definition: &&Definition| definition.parameters.len() == function.parameters.len();
    function.definition.as_ref().filter(fits).filter(|_| defined)
}
