//! Generates rules as C++ statements (Börger & Stärk 2003, tables 2.2 and 4.1).
//!
//! A statement adds the rule's updates to the current unit of each function it updates. They become visible when the
//! step is committed or the part of a `seq` is applied. So rules in parallel become consecutive statements.

use std::collections::BTreeSet;

use model::Basic;
use program::{
    DomainId, DomainKind, FunctionId, FunctionKind, ProcedureId, Rule, RuleId, RuleList, Slot, TermId, TermList,
};

use crate::model::code::{CALLED, Code, listed, unwrapped};
use crate::model::form::is_true;
use crate::model::generator::Generator;
use crate::model::interval::Interval;
use crate::model::nesting::runnable;
use crate::model::plan::{Role, integer};
use crate::model::reach::{Need, Part};
use crate::model::storage::Updates;
use crate::model::text::Text;
use crate::model::types::{Type, type_of};
use crate::model::writes::Target;

impl Generator<'_> {
    /// A rule as statements.
    pub fn rule(&mut self, id: RuleId, text: &mut Text) {
        let program = self.program;
        let span = program.rule_span(id);
        let site = self.sites.number(span);
        match program.rule(id) {
            Rule::Skip => {}
            Rule::Update { function, arguments, value } => {
                let value = self.term(*value);
                self.update(*function, *arguments, value, id, text);
            }
            Rule::Call { procedure, arguments } => {
                let call = self.call(*procedure, *arguments);
                text.marked(span, format!("{call};"));
            }
            Rule::TurboCall { procedure, arguments } => {
                let call = self.call(*procedure, *arguments);
                let targets = self.writes.procedure(*procedure).clone();
                self.unit(&targets, &call, id, text);
            }
            Rule::Return { function, target, procedure, arguments } => {
                self.returning((*function, *target), *procedure, *arguments, id, text);
            }
            Rule::RunValue { rule, arguments } => self.run_value(*rule, *arguments, id, text),
            Rule::RunAgent { agent } => {
                self.reach.expect_need(Need::AgentProgram);
                let code = self.term(*agent);
                let agent = self.agent(code, site);
                text.marked(span, format!("run_agent(next, {agent}, {site});"));
            }
            Rule::Par(rules) => {
                for rule in program.rule_list(*rules) {
                    self.rule(*rule, text);
                }
            }
            Rule::Seq(rules) => self.sequence(id, text, &mut |this, name, text| {
                for rule in program.rule_list(*rules) {
                    this.rule(*rule, text);
                    text.line(format!("{name}.part();"));
                }
            }),
            Rule::If { guards, rules } => {
                let rules = program.rule_list(*rules);
                let guards = program.term_list(*guards);
                for (index, (guard, rule)) in guards.iter().zip(rules).enumerate() {
                    let guard = self.guard(*guard);
                    let guard = unwrapped(&guard);
                    if index == 0 {
                        text.open_marked(span, format!("if ({guard}) {{"));
                    } else {
                        text.between(format!("}} else if ({guard}) {{"));
                    }
                    self.rule(*rule, text);
                }
                if let Some(otherwise) = rules.get(guards.len()) {
                    text.between("} else {");
                    self.rule(*otherwise, text);
                }
                text.close("}");
            }
            Rule::Switch { subject, values, rules } => self.switch_rule(*subject, *values, *rules, id, text),
            Rule::Let { slot, value, body } => {
                let value_site = self.site(*value);
                let value = self.term(*value);
                text.open("{");
                let variable = self.declare(*slot, value.ty, value.defined, value.range);
                let ty = self.plan.cpp(variable.ty, variable.defined);
                let value = self.convert(value, variable.ty, variable.defined, value_site);
                let value = unwrapped(&value);
                text.marked(span, format!("[[maybe_unused]] const {ty} {} = {value};", variable.name));
                self.rule(*body, text);
                text.close("}");
                self.frame.scope.release(&variable.name);
            }
            Rule::Choose { binders, condition, body, if_none } => {
                self.choose(*binders, *condition, *body, *if_none, id, text);
            }
            Rule::Forall { binders, condition, body } => {
                self.ranging(*binders, text, &mut |this, text| {
                    let guard = condition.and_then(|condition| this.guard_unless_true(condition));
                    if let Some(guard) = &guard {
                        text.open_marked(span, format!("if ({}) {{", unwrapped(guard)));
                    }
                    this.rule(*body, text);
                    if guard.is_some() {
                        text.close("}");
                    }
                });
            }
            Rule::Extend { domain, first, count, body } => self.extend(*domain, *first, *count, *body, id, text),
            Rule::Iterate(body) => self.looped(None, *body, true, id, text),
            Rule::While { condition, body } => self.looped(Some(*condition), *body, true, id, text),
            Rule::RecursiveWhile { condition, body } => self.looped(Some(*condition), *body, false, id, text),
            Rule::Local { start, len, initialisations, body } => {
                let locals = program.function_lists[*start as usize..(*start + *len) as usize].to_vec();
                self.local(&locals, *initialisations, *body, id, text);
            }
        }
    }

    /// A guard; `None` if it is the constant true.
    pub fn guard_unless_true(&mut self, condition: TermId) -> Option<String> {
        (!self.is_true(condition)).then(|| self.guard(condition))
    }

    pub fn is_true(&self, condition: TermId) -> bool {
        is_true(self.program, condition)
    }

    /// `function(arguments) := value`
    fn update(&mut self, function: FunctionId, arguments: TermList, value: Code, id: RuleId, text: &mut Text) {
        let span = self.program.rule_span(id);
        let site = self.sites.number(span);
        let plan = self.plan.function(function).clone();
        let index = function.0 as usize;
        self.reach.expect(Part::Function(function));
        let value = self.cast(value, plan.ty, site);
        if !value.defined {
            self.refuted.total[index] = false;
        }
        let range = value.range;
        let checked = range.meet(self.codomain_range(function));
        self.refuted.values[index] = self.refuted.values[index].join(checked);
        let mut codes = vec![value];
        codes.extend(self.arguments(function, arguments));
        let (statements, mut codes) = self.hoist(codes, false);
        let value = codes.remove(0);
        let defined = self.assumed.total[index] && plan.ty != Type::Value;
        let value = self.convert(value, plan.ty, defined, site);
        let value = self.checked(function, value, range, &site.to_string());
        let block = !statements.is_empty();
        if block {
            text.open("{");
            text.marked(span, statements.trim_end());
        }
        if self.is_lazy(function) {
            let place = if plan.role == Role::Shared { format!(", {site}") } else { String::new() };
            // A location that is only written does not need its initial value.
            text.marked(span, format!("gs::prepare([&] {{ (void){}({}{place}); }});", plan.name, listed(&codes)));
        }
        let mut list = vec![site.to_string(), unwrapped(&value).to_string()];
        if self.storage(function).updates == Updates::Step {
            list.insert(0, format!("next.{}", plan.name));
        }
        list.extend(codes.into_iter().map(|code| unwrapped(&code.text).to_string()));
        let call = match plan.role {
            Role::Shared => format!("{}.write({});", plan.member, list.join(", ")),
            _ => format!("{}.update({});", plan.member, list.join(", ")),
        };
        text.marked(span, call);
        if block {
            text.close("}");
        }
    }

    /// A value, checked against the codomain unless it is known to lie there.
    pub fn checked(&mut self, function: FunctionId, value: String, range: Interval, site: &str) -> String {
        let codomain = self.program.function(function).codomain;
        match &self.program.domain(codomain).kind {
            DomainKind::Basic(Basic::Natural) if range.within(Interval::NATURAL) => value,
            DomainKind::Basic(Basic::Natural) => format!("gs::not_negative({value}, {site})"),
            DomainKind::Concrete { .. } => {
                match (self.carrier(codomain), self.plan.domain(codomain).contents.clone()) {
                    (Some(carrier), _) => format!("gs::within_subset({value}, {carrier}, {site})"),
                    (None, Some(contents)) => {
                        if let Some(all) = crate::model::plan::gapless(&contents) {
                            if range.within(all) {
                                return value;
                            }
                            let (low, high) = (integer(all.low), integer(all.high));
                            return format!("gs::between({value}, {low}, {high}, {site})");
                        }
                        let table = self.contents_table(codomain, &contents);
                        format!("gs::within({value}, {table}, {site})")
                    }
                    // The codomain's contents are unknown, so only undef is accepted.
                    (None, None) => format!("gs::nothing_but_undef({value}, {site})"),
                }
            }
            _ => value,
        }
    }

    /// A call of a procedure.
    fn call(&mut self, procedure: ProcedureId, arguments: TermList) -> String {
        let terms = self.program.term_list(arguments).to_vec();
        let arguments = terms.into_iter().map(|term| (self.term(term), self.site(term))).collect();
        self.call_with(procedure, arguments)
    }

    fn call_with(&mut self, procedure: ProcedureId, arguments: Vec<(Code, u32)>) -> String {
        self.reach.expect(Part::Procedure(procedure));
        let index = procedure.0 as usize;
        let parameters = self.program.procedure(procedure).parameters.clone();
        let assumed = self.assumed.parameters[index].clone();
        let mut codes = Vec::new();
        let mut sites = Vec::new();
        for (place, ((code, site), domain)) in arguments.into_iter().zip(&parameters).enumerate() {
            let ty = self.parameter_type(*domain);
            let code = self.cast(code, ty, site);
            if !code.defined {
                self.refuted.parameters[index][place] = false;
            }
            let range = &mut self.refuted.parameter_ranges[index][place];
            *range = range.join(code.range);
            codes.push(code);
            sites.push(site);
        }
        let (statements, codes) = self.hoist(codes, false);
        let mut list = vec!["next".to_string()];
        for (place, (code, domain)) in codes.into_iter().zip(&parameters).enumerate() {
            let ty = self.parameter_type(*domain);
            let text = self.convert(code, ty, assumed[place], sites[place]);
            list.push(unwrapped(&text).to_string());
        }
        let call = format!("{}({})", self.plan.procedure(procedure), list.join(", "));
        if statements.is_empty() { call } else { format!("{CALLED} {{ {statements}{call}; }}()") }
    }

    /// The members that hold the targets.
    pub fn members(&mut self, targets: &BTreeSet<Target>) -> Vec<String> {
        let mut member = |target: &Target| match target {
            Target::Function(function) => match self.plan.function(*function).role {
                Role::State | Role::Local => Some(self.plan.function(*function).member.clone()),
                Role::Shared => Some(format!("{}.locations", self.plan.function(*function).member)),
                _ => None,
            },
            Target::Domain(domain) => self.carrier(*domain),
        };
        targets.iter().filter_map(&mut member).collect()
    }

    /// A statement as a unit of its own.
    fn unit(&mut self, targets: &BTreeSet<Target>, call: &str, id: RuleId, text: &mut Text) {
        let members = self.members(targets);
        let name = self.fresh("unit");
        text.open("{");
        text.line(declared("Unit", &name, &members));
        text.marked(self.program.rule_span(id), format!("{call};"));
        text.line(format!("{name}.join();"));
        text.close("}");
        self.frame.scope.release(&name);
    }

    /// The parts, executed in sequence.
    fn sequence(&mut self, id: RuleId, text: &mut Text, parts: &mut dyn FnMut(&mut Self, &str, &mut Text)) {
        let targets = self.writes.of(self.program, id);
        let members = self.members(&targets);
        let name = self.fresh("seq");
        text.open("{");
        text.line(declared("Sequence", &name, &members));
        parts(self, &name, text);
        text.line(format!("{name}.end();"));
        text.close("}");
        self.frame.scope.release(&name);
    }

    /// A loop while the condition holds; its rounds are parts of a sequence. With `ends_idle` it also ends after a
    /// round without updates.
    fn looped(&mut self, condition: Option<TermId>, body: RuleId, ends_idle: bool, id: RuleId, text: &mut Text) {
        let span = self.program.rule_span(id);
        let site = self.sites.number(span);
        self.reach.expect_need(Need::Rounds);
        self.sequence(id, text, &mut |this, name, text| {
            match condition.map(|condition| this.guard(condition)) {
                Some(guard) => text.open_marked(span, format!("while ({}) {{", unwrapped(&guard))),
                None => text.open("for (;;) {"),
            }
            this.rule(body, text);
            if ends_idle {
                text.open(format!("if (!{name}.part()) {{"));
                text.line("break;");
                text.close("}");
            } else {
                text.line(format!("{name}.part();"));
            }
            text.line(format!("iteration({site});"));
            text.close("}");
        });
    }

    /// `target <- procedure(arguments)`
    fn returning(
        &mut self,
        (function, target): (FunctionId, TermList),
        procedure: ProcedureId,
        arguments: TermList,
        id: RuleId,
        text: &mut Text,
    ) {
        let span = self.program.rule_span(id);
        let call = self.call(procedure, arguments);
        let mut targets = self.writes.procedure(procedure).clone();
        let result = self.program.result_function.filter(|result| targets.remove(&Target::Function(*result)));
        let Some(result) = result else { return self.unit(&targets, &call, id, text) };
        // A turbo rule may not write its result.
        self.refuted.total[result.0 as usize] = false;
        let range = self.assumed.values[result.0 as usize];
        let result = self.plan.function(result).clone();
        let (unit, mark, name) = (self.fresh("unit"), self.fresh("mark"), self.fresh("result"));
        text.open("{");
        let members = self.members(&targets);
        text.line(declared("Unit", &unit, &members));
        text.line(format!("const gs::Mark {mark} = {}.open();", result.member));
        text.marked(span, format!("{call};"));
        text.line(format!("const auto {name} = {}.take({mark});", result.member));
        text.line(format!("{unit}.join();"));
        if self.program.function(function).kind != FunctionKind::Monitored {
            text.open(format!("if ({name}.first) {{"));
            let value = Code::maybe(format!("{name}.second"), result.ty).pure().within(range);
            self.update(function, target, value, id, text);
            text.close("}");
        }
        text.close("}");
    }

    fn run_value(&mut self, rule: TermId, arguments: TermList, id: RuleId, text: &mut Text) {
        let span = self.program.rule_span(id);
        let site = self.sites.number(span);
        self.needs_values(span, "a rule as a value");
        let value = self.value(rule);
        let given = arguments.len as usize;
        text.open_marked(span, format!("switch (gs::rule_of({value}, {site})) {{"));
        let terms = self.program.term_list(arguments).to_vec();
        for procedure in runnable(self.program) {
            let declared = self.program.procedure(procedure);
            if declared.parameters.len() != given {
                continue;
            }
            let codes = terms.iter().map(|term| (self.term(*term), self.site(*term))).collect();
            let call = self.call_with(procedure, codes);
            text.open(format!("case {}: {{", procedure.0));
            if declared.turbo {
                let targets = self.writes.procedure(procedure).clone();
                self.unit(&targets, &call, id, text);
            } else {
                text.line(format!("{call};"));
            }
            text.line("break;");
            text.close("}");
        }
        text.line(format!("default: gs::fail(gs::FaultKind::wrong_arguments, {site});"));
        text.close("}");
    }

    /// An agent as a possibly undefined element.
    pub fn agent(&mut self, code: Code, site: u32) -> String {
        let base = self.program.agents.first().map(|agent| self.program.base_domain(agent.domain));
        match base {
            Some(base) => self.convert(code, Type::Element(base), false, site),
            None => self.convert(code, Type::Value, false, site),
        }
    }

    fn switch_rule(&mut self, subject: TermId, values: TermList, rules: RuleList, id: RuleId, text: &mut Text) {
        let span = self.program.rule_span(id);
        let site = self.site(subject);
        let code = self.term(subject);
        let name = self.fresh("subject");
        let ty = if code.ty == Type::Undef { Type::Value } else { code.ty };
        let (defined, range) = (code.defined, code.range);
        let code = self.convert(code, ty, defined, site);
        text.open("{");
        text.marked(span, format!("[[maybe_unused]] const auto {name} = {code};"));
        let values = self.program.term_list(values).to_vec();
        let rules = self.program.rule_list(rules).to_vec();
        for (index, (value, rule)) in values.iter().zip(&rules).enumerate() {
            let value = self.term(*value);
            let subject = Code { text: name.clone(), ty, defined, pure: true, range };
            let guard = self.equality(subject, value, site);
            let guard = unwrapped(&guard).to_string();
            if index == 0 {
                text.open(format!("if ({guard}) {{"));
            } else {
                text.between(format!("}} else if ({guard}) {{"));
            }
            self.rule(*rule, text);
        }
        if let Some(otherwise) = rules.get(values.len()) {
            if !values.is_empty() {
                text.between("} else {");
            }
            self.rule(*otherwise, text);
        }
        if !values.is_empty() {
            text.close("}");
        }
        text.close("}");
        self.frame.scope.release(&name);
    }

    fn extend(&mut self, domain: DomainId, first: Slot, count: u32, body: RuleId, id: RuleId, text: &mut Text) {
        let span = self.program.rule_span(id);
        let site = self.sites.number(span);
        let base = self.program.base_domain(domain);
        let (Some(carrier), Type::Element(_)) = (self.carrier(base), type_of(self.program, domain)) else {
            self.refuse(
                span,
                format!("`{}` does not grow", self.program.domain(domain).name),
                "declare the domain dynamic",
            );
            return;
        };
        let name = self.plan.domain(base).name().to_string();
        text.open("{");
        let mut made = Vec::new();
        for offset in 0..count {
            let variable = self.declare(Slot(first.0 + offset), Type::Element(base), true, Interval::ALL);
            text.marked(span, format!("[[maybe_unused]] const {name} {}{{{carrier}.create({site})}};", variable.name));
            if domain != base
                && let Some(subset) = self.carrier(domain)
            {
                text.line(format!("{subset}.create({}.element, {site});", variable.name));
            }
            made.push(variable.name);
        }
        self.rule(body, text);
        text.close("}");
        made.iter().for_each(|name| self.frame.scope.release(name));
    }

    fn local(&mut self, locals: &[FunctionId], initialisations: RuleList, body: RuleId, id: RuleId, text: &mut Text) {
        // A local function is undef until it is written.
        locals.iter().for_each(|local| self.refuted.total[local.0 as usize] = false);
        let mut targets = self.writes.of(self.program, id);
        targets.retain(|target| !matches!(target, Target::Function(function) if locals.contains(function)));
        let members = self.members(&targets);
        let own: Vec<String> = locals.iter().map(|local| self.plan.function(*local).member.clone()).collect();
        let (scope, seq) = (self.fresh("scope"), self.fresh("seq"));
        text.open("{");
        text.line(declared("Scope", &scope, &own));
        text.line(declared("Sequence", &seq, &members));
        for rule in self.program.rule_list(initialisations).to_vec().into_iter().chain([body]) {
            self.rule(rule, text);
            text.line(format!("{scope}.part();"));
            text.line(format!("{seq}.part();"));
        }
        text.line(format!("{seq}.end();"));
        text.line(format!("{scope}.end();"));
        text.close("}");
        self.frame.scope.release(&scope);
        self.frame.scope.release(&seq);
    }
}

/// A declaration whose template arguments are deduced from its members.
fn declared(class: &str, name: &str, members: &[String]) -> String {
    match members {
        [] => format!("gs::{class}<> {name};"),
        _ => format!("gs::{class} {name}{{{}}};", members.join(", ")),
    }
}
