//! Rules: one case for each construct.
//!
//! An update of a parameter updates the location that the caller's argument names, however many calls passed it on.

use model::{Call, DomainKind, FunctionId, FunctionKind, RuleKind, RuleNode, Target, TermKind, VariableId};
use syntax::{Diagnostic, Span};

use crate::ir::{self, RuleId, RuleList, TermList};
use crate::lower::Lowering;
use crate::lower::environment::Binding;
use crate::lower::result::InPlace;

impl<'m> Lowering<'m, '_> {
    /// Adds a rule and all its parts.
    pub(super) fn lower_rule(&mut self, rule: &'m RuleNode) -> RuleId {
        if let Some((_, skip)) = self.stopped {
            return skip;
        }
        self.nested(rule.span, |this| this.lower_rule_kind(rule))
    }

    fn lower_rules(&mut self, rules: impl IntoIterator<Item = &'m RuleNode>) -> RuleList {
        let lowered: Vec<RuleId> = rules.into_iter().map(|rule| self.lower_rule(rule)).collect();
        self.rule_list(&lowered)
    }

    fn lower_rule_kind(&mut self, rule: &'m RuleNode) -> RuleId {
        let span = rule.span;
        let lowered = match &rule.kind {
            RuleKind::Skip | RuleKind::Error => ir::Rule::Skip,
            _ if !self.is_whole(rule) => ir::Rule::Skip,
            RuleKind::Update { target, value } => match self.lower_target(target) {
                Some((function, arguments)) => ir::Rule::Update { function, arguments, value: self.lower_term(value) },
                None => ir::Rule::Skip,
            },
            RuleKind::MacroCall(call) | RuleKind::TurboCall(call) => self.lower_call_rule(call, span),
            RuleKind::Return { target, call } => match self.lower_target(target) {
                Some((function, target)) => {
                    let needed = self.needs_place(call.rule, function, target);
                    let stands = if needed { InPlace::Location(function, target) } else { InPlace::Nothing };
                    let (procedure, arguments) = self.lower_call(call.rule, &call.arguments, stands, span);
                    ir::Rule::Return { function, target, procedure, arguments }
                }
                None => ir::Rule::Skip,
            },
            RuleKind::RunValue { rule, arguments } => {
                ir::Rule::RunValue { rule: self.lower_term(rule), arguments: self.lower_terms(arguments) }
            }
            RuleKind::RunAgent { agent } => ir::Rule::RunAgent { agent: self.lower_term(agent) },
            RuleKind::Par(rules) => ir::Rule::Par(self.lower_rules(rules)),
            RuleKind::Seq(rules) => ir::Rule::Seq(self.lower_rules(rules)),
            RuleKind::If { branches, otherwise } => ir::Rule::If {
                guards: self.lower_terms(branches.iter().map(|(guard, _)| guard)),
                rules: self.lower_rules(branches.iter().map(|(_, rule)| rule).chain(otherwise.as_deref())),
            },
            RuleKind::Switch { subject, cases, otherwise } => ir::Rule::Switch {
                subject: self.lower_term(subject),
                values: self.lower_terms(cases.iter().map(|(value, _)| value)),
                rules: self.lower_rules(cases.iter().map(|(_, rule)| rule).chain(otherwise.as_deref())),
            },
            RuleKind::Let { bindings, body } => return self.lower_let_rule(bindings, body, span),
            RuleKind::Choose { binders, condition, body, if_none } => ir::Rule::Choose {
                binders: self.lower_binders(binders),
                condition: condition.as_ref().map(|condition| self.lower_term(condition)),
                body: self.lower_rule(body),
                if_none: if_none.as_deref().map(|rule| self.lower_rule(rule)),
            },
            RuleKind::Forall { binders, condition, body } => ir::Rule::Forall {
                binders: self.lower_binders(binders),
                condition: condition.as_ref().map(|condition| self.lower_term(condition)),
                body: self.lower_rule(body),
            },
            RuleKind::Extend { domain, variables, body } => {
                let first = ir::Slot(self.frame.names.len() as u32);
                for variable in variables {
                    self.bind(*variable, *domain);
                }
                let body = self.lower_rule(body);
                ir::Rule::Extend { domain: *domain, first, count: variables.len() as u32, body }
            }
            RuleKind::Iterate(body) => ir::Rule::Iterate(self.lower_rule(body)),
            RuleKind::While { condition, body } => {
                ir::Rule::While { condition: self.lower_term(condition), body: self.lower_rule(body) }
            }
            RuleKind::RecursiveWhile { condition, body } => {
                ir::Rule::RecursiveWhile { condition: self.lower_term(condition), body: self.lower_rule(body) }
            }
            RuleKind::Local { locals, body } => self.lower_local(locals, body),
        };
        self.rule(lowered, span)
    }

    /// Whether a rule is complete: a reported fault may have left only a part of it.
    fn is_whole(&self, rule: &RuleNode) -> bool {
        match &rule.kind {
            RuleKind::Choose { binders, .. } | RuleKind::Forall { binders, .. } => !binders.is_empty(),
            RuleKind::Extend { domain, .. } => matches!(
                self.model.domains.kind(*domain),
                DomainKind::Abstract { dynamic: true } | DomainKind::Concrete { dynamic: true, .. }
            ),
            RuleKind::Return { call, .. } => self.model.rule(call.rule).turbo,
            _ => true,
        }
    }

    fn lower_call_rule(&mut self, call: &'m Call, span: Span) -> ir::Rule {
        let turbo = self.model.rule(call.rule).turbo;
        let (procedure, arguments) = self.lower_call(call.rule, &call.arguments, InPlace::AsAround, span);
        if turbo { ir::Rule::TurboCall { procedure, arguments } } else { ir::Rule::Call { procedure, arguments } }
    }

    fn lower_let_rule(&mut self, bindings: &'m [(VariableId, model::Term)], body: &'m RuleNode, span: Span) -> RuleId {
        let Some(((variable, term), rest)) = bindings.split_first() else {
            return self.lower_rule(body);
        };
        let value = self.lower_term(term);
        let slot = self.bind(*variable, term.domain);
        let body = self.nested(span, |this| this.lower_let_rule(rest, body, span));
        self.rule(ir::Rule::Let { slot, value, body }, span)
    }

    fn lower_local(&mut self, locals: &'m [(FunctionId, RuleNode)], body: &'m RuleNode) -> ir::Rule {
        let initialisations = self.lower_rules(locals.iter().map(|(_, initialisation)| initialisation));
        let body = self.lower_rule(body);
        let start = self.program.function_lists.len() as u32;
        self.program.function_lists.extend(locals.iter().map(|(function, _)| *function));
        ir::Rule::Local { start, len: locals.len() as u32, initialisations, body }
    }

    /// The location to write. If the parameter is not a location here, reports it and returns none.
    fn lower_target(&mut self, target: &'m Target) -> Option<(FunctionId, TermList)> {
        match target {
            Target::Location { function, arguments, span } => {
                if let Some(place) = self.in_place_of(*function, *span) {
                    return Some(place);
                }
                let is_location = self.is_location(*function, arguments);
                is_location.then(|| (*function, self.lower_terms(arguments)))
            }
            Target::Parameter(variable, span) => self.lower_parameter_target(*variable, *span),
        }
    }

    fn lower_parameter_target(&mut self, variable: VariableId, span: Span) -> Option<(FunctionId, TermList)> {
        let known = self.environment.variables.get(variable.0 as usize);
        let name = known.map_or("the parameter", |variable| &variable.name);
        let Some(Binding::ByName { argument, slots }) = self.environment.bindings.get(&variable).cloned() else {
            self.report_no_location(name, span, None);
            return None;
        };
        self.within_argument(argument, &slots, |this, term| {
            if let TermKind::Variable(inner) = &term.kind {
                return this.lower_parameter_target(*inner, span);
            }
            let location = this.location(term);
            if location.is_none() {
                this.report_no_location(name, span, Some(term.span));
            }
            location.map(|(function, arguments)| {
                let place = this.in_place_of(function, term.span);
                place.unwrap_or_else(|| (function, this.lower_terms(arguments)))
            })
        })
    }

    /// The location that a term names: a dynamic function and its arguments.
    pub(super) fn location(&self, term: &'m model::Term) -> Option<(FunctionId, &'m [model::Term])> {
        match &term.kind {
            TermKind::Apply { function, arguments } => {
                self.is_location(*function, arguments).then_some((*function, arguments))
            }
            _ => None,
        }
    }

    fn is_location(&self, function: FunctionId, arguments: &[model::Term]) -> bool {
        let function = self.model.function(function);
        !matches!(function.kind, FunctionKind::Static | FunctionKind::Derived)
            && function.parameters.len() == arguments.len()
    }

    fn report_no_location(&mut self, name: &str, span: Span, argument: Option<Span>) {
        let help = "give a dynamic function, applied to its arguments, in every call of this rule; \
                    a rule that is run as a value takes its arguments by value";
        let mut fault =
            Diagnostic::error("not-a-location", span, format!("{name} stands for a value here, not for a location"))
                .here("only a location can be assigned")
                .with_help(help);
        if let Some(argument) = argument {
            fault = fault.with_label(argument, "the argument given");
        }
        if !self.diagnostics.contains(&fault) {
            self.diagnostics.push(fault);
        }
    }
}
