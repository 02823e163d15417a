//! Terms: one case for each construct.
//!
//! A variable becomes its slot, or the by-name argument that it stands for. The argument is lowered again at each
//! place.

use model::{Domains, FunctionId, TermKind, VariableId};

use crate::builtin::Builtin;
use crate::ir::{self, TermId, TermList};
use crate::lower::environment::Binding;
use crate::lower::meaning::Meaning;
use crate::lower::number::Form;
use crate::lower::{Lowering, constant};

impl<'m> Lowering<'m, '_> {
    /// Adds a term and all its parts.
    pub(super) fn lower_term(&mut self, term: &'m model::Term) -> TermId {
        if let Some((undef, _)) = self.stopped {
            return undef;
        }
        self.nested(term.span, |this| this.lower_term_kind(term))
    }

    /// Adds terms as a list.
    pub(super) fn lower_terms(&mut self, terms: impl IntoIterator<Item = &'m model::Term>) -> TermList {
        let lowered: Vec<TermId> = terms.into_iter().map(|term| self.lower_term(term)).collect();
        self.term_list(&lowered)
    }

    fn lower_optional(&mut self, term: Option<&'m model::Term>) -> Option<TermId> {
        term.map(|term| self.lower_term(term))
    }

    fn lower_term_kind(&mut self, term: &'m model::Term) -> TermId {
        let lowered = match &term.kind {
            TermKind::Literal(literal) => return self.constant(literal, term.domain, term.span),
            TermKind::Variable(variable) => return self.lower_variable(*variable, term),
            TermKind::Apply { function, arguments } => return self.lower_application(*function, arguments, term),
            TermKind::Let { bindings, body } => return self.lower_let_term(bindings, body, term),
            TermKind::Coerce(operand) => return self.lower_coercion(operand, term),
            TermKind::Unbound(_) => ir::Term::Unbound,
            TermKind::Error => return self.undef(term.domain, term.span),
            TermKind::Comprehension { binders, .. } | TermKind::Quantified { binders, .. } if binders.is_empty() => {
                return self.undef(term.domain, term.span);
            }
            TermKind::Domain(domain) => ir::Term::Domain(*domain),
            TermKind::Tuple(components) => ir::Term::Tuple(self.lower_terms(components)),
            TermKind::Project { tuple, index } => ir::Term::Project { tuple: self.lower_term(tuple), index: *index },
            TermKind::Collection { kind, elements } => {
                ir::Term::Collection { kind: *kind, elements: self.lower_terms(elements) }
            }
            TermKind::Range { kind, low, high, step } => ir::Term::Range {
                kind: *kind,
                low: self.lower_term(low),
                high: self.lower_term(high),
                step: self.lower_optional(step.as_deref()),
            },
            TermKind::Comprehension { kind, binders, condition, body } => ir::Term::Comprehension {
                kind: *kind,
                binders: self.lower_binders(binders),
                condition: self.lower_optional(condition.as_deref()),
                body: self.lower_term(body),
            },
            TermKind::Quantified { quantifier, binders, condition } => ir::Term::Quantified {
                quantifier: *quantifier,
                binders: self.lower_binders(binders),
                condition: self.lower_optional(condition.as_deref()),
            },
            TermKind::If { branches, otherwise } => ir::Term::If {
                branches: self.lower_terms(branches.iter().flat_map(|(guard, term)| [guard, term])),
                otherwise: self.lower_optional(otherwise.as_deref()),
            },
            TermKind::Switch { subject, cases, otherwise } => ir::Term::Switch {
                subject: self.lower_term(subject),
                cases: self.lower_terms(cases.iter().flat_map(|(value, term)| [value, term])),
                otherwise: self.lower_optional(otherwise.as_deref()),
            },
            TermKind::Rule(rule) => ir::Term::Rule(self.procedure_by_value(*rule)),
        };
        self.term(lowered, term.domain, term.span)
    }

    fn lower_variable(&mut self, variable: VariableId, term: &'m model::Term) -> TermId {
        match self.environment.bindings.get(&variable).cloned() {
            Some(Binding::Slot(slot)) => self.term(ir::Term::Slot(slot), term.domain, term.span),
            Some(Binding::ByName { argument, slots }) => {
                self.within_argument(argument, &slots, |this, argument| this.lower_term(argument))
            }
            None => self.undef(term.domain, term.span),
        }
    }

    fn lower_application(
        &mut self,
        function: FunctionId,
        arguments: &'m [model::Term],
        term: &'m model::Term,
    ) -> TermId {
        if let Some(literal) = self.folded(term) {
            return self.constant(&literal, term.domain, term.span);
        }
        if self.model.function(function).parameters.len() != arguments.len() {
            return self.undef(term.domain, term.span);
        }
        if let Some((function, arguments)) = self.in_place_of(function, term.span) {
            return self.term(ir::Term::Read { function, arguments }, term.domain, term.span);
        }
        let lowered = match self.meaning(function) {
            Meaning::Read => ir::Term::Read { function, arguments: self.lower_terms(arguments) },
            Meaning::Define => ir::Term::Define { function, arguments: self.lower_terms(arguments) },
            Meaning::Missing => ir::Term::Missing(function),
            Meaning::Builtin(builtin) => self.lower_operation(builtin, arguments),
            Meaning::Argument(index) => match arguments.get(index) {
                Some(argument) => return self.lower_term(argument),
                None => return self.undef(term.domain, term.span),
            },
        };
        self.term(lowered, term.domain, term.span)
    }

    /// A builtin; operands of different numeric forms are coerced to one form.
    fn lower_operation(&mut self, builtin: Builtin, arguments: &'m [model::Term]) -> ir::Term {
        let form = self.common_form(builtin, arguments);
        let mut operands = Vec::with_capacity(arguments.len());
        for argument in arguments {
            let operand = self.lower_term(argument);
            operands.push(match form {
                Some(form) if self.form(argument.domain).is_some_and(|own| own < form) => self.widen(operand, form),
                _ => operand,
            });
        }
        ir::Term::Builtin { builtin, arguments: self.term_list(&operands) }
    }

    fn widen(&mut self, operand: TermId, form: Form) -> TermId {
        let domain = if form == Form::Complex { Domains::COMPLEX } else { Domains::REAL };
        let span = self.program.term_span(operand);
        if let ir::Term::Constant(index) = *self.program.term(operand) {
            let literal = &self.program.constants[index as usize];
            if let Some(literal) = constant::coerced(literal, self.model.domains.kind(domain)) {
                return self.constant(&literal, domain, span);
            }
        }
        self.term(ir::Term::Coerce(operand), domain, span)
    }

    fn lower_coercion(&mut self, operand: &'m model::Term, term: &'m model::Term) -> TermId {
        if let Some(literal) = self.folded(term) {
            return self.constant(&literal, term.domain, term.span);
        }
        let operand = self.lower_term(operand);
        self.term(ir::Term::Coerce(operand), term.domain, term.span)
    }

    fn lower_let_term(
        &mut self,
        bindings: &'m [(VariableId, model::Term)],
        body: &'m model::Term,
        term: &'m model::Term,
    ) -> TermId {
        let Some(((variable, value), rest)) = bindings.split_first() else {
            return self.lower_term(body);
        };
        let value_term = self.lower_term(value);
        let slot = self.bind(*variable, value.domain);
        let body = self.nested(term.span, |this| this.lower_let_term(rest, body, term));
        self.term(ir::Term::Let { slot, value: value_term, body }, term.domain, term.span)
    }
}
