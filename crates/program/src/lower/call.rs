//! Calls: finds or makes the procedure of a rule for its arguments.
//!
//! A turbo rule has one procedure, called by value. A macro rule has a procedure for each shape of its arguments, and
//! calls of the same shape share it. Its first slots hold the arguments passed by value; then come the slots that the
//! by-name arguments need. INVARIANT: a procedure has its number before its body is lowered, so recursion ends.

use std::collections::BTreeMap;
use std::fmt::Write;

use model::{DomainId, RuleId, Term};
use syntax::Span;

use crate::ir::ArgumentId;
use crate::ir::{self, Procedure, ProcedureId, Slot, TermId, TermList};
use crate::lower::environment::{Binding, Environment, Frame};
use crate::lower::result::{InPlace, Place};
use crate::lower::{Lowering, MAX_PROCEDURES};

/// A procedure whose body is still to be lowered.
#[derive(Debug)]
pub(super) struct Pending<'m> {
    procedure: ProcedureId,
    body: &'m model::RuleNode,
    environment: Environment<'m>,
    frame: Frame,
    place: Option<Place>,
}

impl<'m> Lowering<'m, '_> {
    /// The procedure of a call, and the terms passed to it. In its body, `stands` replaces `result`.
    pub(super) fn lower_call(
        &mut self,
        id: RuleId,
        arguments: &'m [Term],
        stands: InPlace,
        span: Span,
    ) -> (ProcedureId, TermList) {
        let rule = self.model.rule(id);
        let mut callee = Environment { variables: &rule.variables, bindings: BTreeMap::new() };
        let mut frame = Frame::default();
        let mut key = id.0.to_string();
        let mut passed: Vec<TermId> = Vec::with_capacity(arguments.len());
        let mut by_name = Vec::new();
        for (parameter, argument) in rule.parameters.iter().zip(arguments) {
            let named = if rule.turbo { None } else { self.by_name(argument) };
            if let Some((argument, slots)) = named {
                by_name.push((*parameter, argument, slots));
                write!(key, " n{argument}").expect("a string takes any text");
            } else {
                passed.push(self.lower_term(argument));
                let variable = &rule.variables[parameter.0 as usize];
                let slot = frame.add(variable.name.clone(), variable.domain);
                callee.bindings.insert(*parameter, Binding::Slot(slot));
                key.push_str(" v");
            }
        }
        let by_value = passed.len();
        let mut needed: Vec<Slot> = Vec::new();
        for (parameter, argument, slots) in by_name {
            let mut given = Vec::with_capacity(slots.len());
            for slot in slots {
                let index = needed.iter().position(|other| *other == slot).unwrap_or_else(|| {
                    needed.push(slot);
                    let (name, domain) = self.slot(slot);
                    frame.add(name, domain);
                    passed.push(self.term(ir::Term::Slot(slot), domain, span));
                    needed.len() - 1
                });
                given.push(Slot((by_value + index) as u32));
                write!(key, ":{index}").expect("a string takes any text");
            }
            key.push(';');
            callee.bindings.insert(parameter, Binding::ByName { argument, slots: given });
        }
        let location = match stands {
            InPlace::Nothing => None,
            InPlace::Location(function, given) => Some((function, given)),
            // A macro rule's arguments may read `result`, whether the rule itself does or not.
            InPlace::AsAround if rule.turbo && !self.uses_result(id) => None,
            InPlace::AsAround => self.program.result_function.and_then(|result| self.in_place_of(result, span)),
        };
        let place = location.map(|(function, given)| {
            write!(key, " r{}", function.0).expect("a string takes any text");
            let given = self.program.term_list(given).to_vec();
            let domains = &self.model.function(function).parameters;
            let slots = domains.iter().map(|domain| frame.add("$$result".to_string(), *domain)).collect();
            passed.extend(given);
            Place { function, slots }
        });
        let procedure = self.procedure(key, id, callee, frame, place);
        (procedure, self.term_list(&passed))
    }

    /// The procedure of a rule whose arguments are all passed by value.
    pub(super) fn procedure_by_value(&mut self, id: RuleId) -> ProcedureId {
        let rule = self.model.rule(id);
        let mut environment = Environment { variables: &rule.variables, bindings: BTreeMap::new() };
        let mut frame = Frame::default();
        let mut key = id.0.to_string();
        for parameter in &rule.parameters {
            let variable = &rule.variables[parameter.0 as usize];
            environment.bindings.insert(*parameter, Binding::Slot(frame.add(variable.name.clone(), variable.domain)));
            key.push_str(" v");
        }
        self.procedure(key, id, environment, frame, None)
    }

    /// A procedure of a rule without parameters that is not one of the model's: a fragment.
    pub(super) fn fragment_procedure(&mut self, rule: &'m model::Rule) -> ProcedureId {
        let procedure = self.add_procedure(None, rule, &Frame::default());
        let environment = Environment { variables: &rule.variables, bindings: BTreeMap::new() };
        self.pending.push_back(Pending {
            procedure,
            body: &rule.body,
            environment,
            frame: Frame::default(),
            place: None,
        });
        procedure
    }

    /// Lowers the body of a procedure.
    pub(super) fn lower_pending(&mut self, pending: Pending<'m>) {
        self.environment = pending.environment;
        self.frame = pending.frame;
        self.place = pending.place;
        self.depth = 0;
        let body = self.lower_rule(pending.body);
        let names = std::mem::take(&mut self.frame).names;
        let procedure = &mut self.program.procedures[pending.procedure.0 as usize];
        procedure.frame = names.len() as u32;
        procedure.names = names;
        procedure.body = body;
    }

    /// The argument and the slots it needs, unless it is passed by value. An argument that is passed on stays the same.
    fn by_name(&mut self, argument: &'m Term) -> Option<(ArgumentId, Vec<Slot>)> {
        if let model::TermKind::Variable(variable) = &argument.kind {
            return match self.environment.bindings.get(variable) {
                Some(Binding::ByName { argument, slots }) => Some((*argument, slots.clone())),
                _ => None,
            };
        }
        if self.is_simple(argument) { None } else { Some(self.intern(argument)) }
    }

    fn slot(&self, slot: Slot) -> (String, DomainId) {
        (self.frame.names[slot.0 as usize].clone(), self.frame.domains[slot.0 as usize])
    }

    fn procedure(
        &mut self,
        key: String,
        id: RuleId,
        environment: Environment<'m>,
        frame: Frame,
        place: Option<Place>,
    ) -> ProcedureId {
        if let Some(known) = self.program.specialisations.procedures.get(&key) {
            return *known;
        }
        let rule = self.model.rule(id);
        let procedure = self.add_procedure(Some(id), rule, &frame);
        self.program.specialisations.procedures.insert(key, procedure);
        self.pending.push_back(Pending { procedure, body: &rule.body, environment, frame, place });
        if self.program.procedures.len() > MAX_PROCEDURES {
            self.stop(rule.span, format!("calls by name make more than {MAX_PROCEDURES} procedures"));
        }
        procedure
    }

    fn add_procedure(&mut self, id: Option<RuleId>, rule: &model::Rule, frame: &Frame) -> ProcedureId {
        self.program.procedures.push(Procedure {
            name: rule.name.clone(),
            rule: id,
            turbo: rule.turbo,
            parameters: frame.domains.clone(),
            frame: 0,
            names: Vec::new(),
            body: ir::RuleId(0),
            span: rule.span,
        });
        ProcedureId(self.program.procedures.len() as u32 - 1)
    }
}
