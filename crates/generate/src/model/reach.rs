//! What the generated class needs: which procedures and functions have code, in which order, and which parts go with them.
//!
//! In: a program, its plan, what its rules write. Out: a [`Reach`], found by walking over the program. INVARIANT: the walk
//! meets exactly the terms and rules that are printed, so nothing that is printed lacks its declaration, and printing decides
//! none of this.

use std::collections::{BTreeMap, BTreeSet};

use model::Basic;
use program::{
    BinderList, Builtin, DomainId, DomainKind, FunctionId, FunctionKind, ProcedureId, Program, Rule, RuleId, Term,
    TermId, TermList,
};

use crate::model::form::is_true;
use crate::model::nesting::runnable;
use crate::model::plan::{Plan, Role};
use crate::model::recursion::{initial_order, is_recursive, reads_itself};
use crate::model::selection::{Selection, selection};
use crate::model::types::{Type, type_of};
use crate::model::writes::{Target, Writes};

/// A body that is generated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Part {
    /// The rule of a procedure.
    Procedure(ProcedureId),
    /// The definition of a function, or its initial values.
    Function(FunctionId),
}

/// A part of the class that is generated only if needed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Need {
    /// The names of literals and elements.
    Names,
    /// `program(agent)`.
    AgentProgram,
    /// The clock.
    Clock,
    /// The count of loop rounds.
    Rounds,
    /// The depth of nested calls.
    Depth,
}

/// See the module.
#[derive(Debug, Default)]
pub(crate) struct Reach {
    /// All bodies, in the order in which they are met.
    pub parts: Vec<Part>,
    /// The initial values, in an order in which none reads a later one.
    pub initials: Vec<usize>,
    /// Those for which there is no such order.
    pub cyclic_initials: BTreeSet<usize>,
    /// Functions whose code is needed.
    pub functions: BTreeSet<FunctionId>,
    /// Procedures whose code is needed.
    pub procedures: BTreeSet<ProcedureId>,
    /// Growing domains whose elements matter.
    pub carriers: BTreeSet<DomainId>,
    pub needs: BTreeSet<Need>,
    /// How often the code calls each procedure.
    calls: BTreeMap<ProcedureId, u32>,
    /// Procedures and definitions that reach themselves.
    recursive_procedures: BTreeSet<ProcedureId>,
    recursive_functions: BTreeSet<FunctionId>,
}

impl Reach {
    /// What the class of a program needs.
    pub fn new(program: &Program, plan: &Plan, writes: &Writes) -> Reach {
        let mut walk = Walk { program, plan, writes, reach: Reach::default() };
        walk.start();
        walk.parts();
        walk.reach
    }

    /// Whether code needs a part of the class.
    pub fn needs(&self, need: Need) -> bool {
        self.needs.contains(&need)
    }

    /// To be called where code names a function or procedure that has a body.
    pub fn expect(&self, part: Part) {
        let known = match part {
            Part::Procedure(id) => self.procedures.contains(&id),
            Part::Function(id) => self.functions.contains(&id),
        };
        assert!(known, "{part:?} is named but was not reached");
    }

    /// To be called where code names such a part of the class.
    pub fn expect_need(&self, need: Need) {
        assert!(self.needs(need), "{need:?} is named but was not reached");
    }

    /// Whether code calls a procedure at exactly one place.
    pub fn is_called_once(&self, id: ProcedureId) -> bool {
        self.calls.get(&id) == Some(&1)
    }

    /// Whether a procedure with code calls itself, directly or through others.
    pub fn is_recursive(&self, id: ProcedureId) -> bool {
        self.recursive_procedures.contains(&id)
    }

    /// Whether a definition with code reads itself, directly or through others.
    pub fn reads_itself(&self, id: FunctionId) -> bool {
        self.recursive_functions.contains(&id)
    }
}

struct Walk<'p> {
    program: &'p Program,
    plan: &'p Plan,
    writes: &'p Writes,
    reach: Reach,
}

impl Walk<'_> {
    /// The initial state, the choice of an agent's program, the main rule.
    fn start(&mut self) {
        let (program, plan) = (self.program, self.plan);
        let (order, cyclic) = initial_order(program);
        for index in &order {
            let function = program.initials[*index].function;
            let role = plan.function(function).role;
            if matches!(role, Role::Input | Role::None) {
                continue;
            }
            self.reach.functions.insert(function);
            if role != Role::Agent && !cyclic.contains(index) {
                for domain in &program.function(function).parameters {
                    // Initial values over other domains are computed when they are read.
                    if !self.is_enumerable(*domain) {
                        break;
                    }
                    self.carrier(*domain);
                }
            }
        }
        (self.reach.initials, self.reach.cyclic_initials) = (order, cyclic);
        for agent in &program.agents {
            self.carrier(agent.domain);
            let domain = plan.domain(agent.domain);
            let is_abstract = matches!(program.domain(agent.domain).kind, DomainKind::Abstract { .. });
            // A domain without elements has no agents that could run the program.
            if is_abstract || domain.carrier.is_some() || domain.contents.is_some() {
                self.reach.procedures.insert(agent.procedure);
            }
        }
        for procedure in program.main.into_iter().chain(program.agents.iter().map(|agent| agent.procedure)) {
            *self.reach.calls.entry(procedure).or_default() += 1;
        }
        self.reach.procedures.extend(program.main);
    }

    /// Bodies, each of which may reach more.
    fn parts(&mut self) {
        let (mut procedures, mut functions) = (BTreeSet::new(), BTreeSet::new());
        loop {
            if let Some(id) = self.reach.procedures.iter().find(|id| !procedures.contains(*id)).copied() {
                procedures.insert(id);
                self.reach.parts.push(Part::Procedure(id));
                if is_recursive(self.program, id) {
                    self.reach.recursive_procedures.insert(id);
                    self.reach.needs.insert(Need::Depth);
                }
                self.rule(self.program.procedure(id).body);
                continue;
            }
            let Some(id) = self.reach.functions.iter().find(|id| !functions.contains(*id)).copied() else { return };
            functions.insert(id);
            self.reach.parts.push(Part::Function(id));
            self.function(id);
        }
    }

    fn function(&mut self, id: FunctionId) {
        let (program, plan) = (self.program, self.plan.function(id));
        match plan.role {
            Role::Definition => {
                let Some(definition) = &program.function(id).definition else { return };
                if reads_itself(program, id) {
                    self.reach.recursive_functions.insert(id);
                    self.reach.needs.insert(Need::Depth);
                }
                self.term(definition.body);
            }
            Role::Input => self.codomain(id),
            Role::None | Role::Element(_) | Role::State | Role::Local | Role::Shared | Role::Agent => {
                if plan.role == Role::Shared {
                    self.codomain(id);
                }
                if let Some(initial) = plan.initial {
                    self.term(program.initials[initial].value.body);
                }
            }
        }
    }

    fn rule(&mut self, id: RuleId) {
        let program = self.program;
        match program.rule(id) {
            Rule::Skip => {}
            Rule::Update { function, arguments, value } => {
                self.term(*value);
                self.update(*function, *arguments);
            }
            Rule::Call { procedure, arguments } => self.call(*procedure, *arguments),
            Rule::TurboCall { procedure, arguments } => {
                self.call(*procedure, *arguments);
                self.targets(self.writes.procedure(*procedure));
            }
            Rule::Return { function, target, procedure, arguments } => {
                self.call(*procedure, *arguments);
                let targets = self.writes.procedure(*procedure);
                self.targets(targets);
                if let Some(result) = program.result_function
                    && targets.contains(&Target::Function(result))
                {
                    self.reach.functions.insert(result);
                    if program.function(*function).kind != FunctionKind::Monitored {
                        self.update(*function, *target);
                    }
                }
            }
            Rule::RunValue { rule, arguments } => {
                self.term(*rule);
                for procedure in runnable(program) {
                    let declared = program.procedure(procedure);
                    if declared.parameters.len() == arguments.len as usize {
                        self.call(procedure, *arguments);
                        if declared.turbo {
                            self.targets(self.writes.procedure(procedure));
                        }
                    }
                }
            }
            Rule::RunAgent { agent } => {
                self.reach.needs.insert(Need::AgentProgram);
                self.term(*agent);
            }
            Rule::Par(rules) => program.rule_list(*rules).iter().for_each(|rule| self.rule(*rule)),
            Rule::Seq(rules) => {
                self.unit(id);
                program.rule_list(*rules).iter().for_each(|rule| self.rule(*rule));
            }
            Rule::If { guards, rules } => {
                self.terms(*guards);
                program.rule_list(*rules).iter().for_each(|rule| self.rule(*rule));
            }
            Rule::Switch { subject, values, rules } => {
                self.term(*subject);
                self.terms(*values);
                program.rule_list(*rules).iter().for_each(|rule| self.rule(*rule));
            }
            Rule::Let { value, body, .. } => {
                self.term(*value);
                self.rule(*body);
            }
            Rule::Choose { binders, condition, body, if_none } => {
                match selection(program, self.plan, *binders, *condition) {
                    // There always is a candidate.
                    Selection::Drawn | Selection::Picked(..) => {}
                    Selection::Listed(listed) => {
                        listed.iter().for_each(|binder| self.term(binder.range));
                        self.condition(*condition);
                        if_none.iter().for_each(|rule| self.rule(*rule));
                    }
                }
                self.rule(*body);
            }
            Rule::Forall { binders, condition, body } => {
                self.ranges(*binders);
                self.condition(*condition);
                self.rule(*body);
            }
            Rule::Extend { domain, body, .. } => {
                let base = program.base_domain(*domain);
                // Otherwise the rule is refused.
                if self.plan.domain(base).carrier.is_some() && matches!(type_of(program, *domain), Type::Element(_)) {
                    self.carrier(base);
                    self.carrier(*domain);
                    self.rule(*body);
                }
            }
            Rule::Iterate(body) => self.looped(None, *body, id),
            Rule::While { condition, body } | Rule::RecursiveWhile { condition, body } => {
                self.looped(Some(*condition), *body, id);
            }
            Rule::Local { start, len, initialisations, body } => {
                let locals = &program.function_lists[*start as usize..(*start + *len) as usize];
                self.reach.functions.extend(locals);
                self.unit(id);
                program.rule_list(*initialisations).iter().for_each(|rule| self.rule(*rule));
                self.rule(*body);
            }
        }
    }

    fn update(&mut self, function: FunctionId, arguments: TermList) {
        self.reach.functions.insert(function);
        self.codomain(function);
        self.terms(arguments);
    }

    fn call(&mut self, procedure: ProcedureId, arguments: TermList) {
        self.terms(arguments);
        self.reach.procedures.insert(procedure);
        *self.reach.calls.entry(procedure).or_default() += 1;
    }

    fn looped(&mut self, condition: Option<TermId>, body: RuleId, id: RuleId) {
        self.reach.needs.insert(Need::Rounds);
        self.unit(id);
        condition.iter().for_each(|condition| self.term(*condition));
        self.rule(body);
    }

    /// A rule that is a unit of its own over what it writes.
    fn unit(&mut self, id: RuleId) {
        self.targets(&self.writes.of(self.program, id));
    }

    fn targets(&mut self, targets: &BTreeSet<Target>) {
        for target in targets {
            match target {
                Target::Domain(domain) => self.carrier(*domain),
                Target::Function(_) => {}
            }
        }
    }

    /// A guard, which is not printed if it is the constant true.
    fn condition(&mut self, condition: Option<TermId>) {
        if let Some(condition) = condition
            && !is_true(self.program, condition)
        {
            self.term(condition);
        }
    }

    fn ranges(&mut self, binders: BinderList) {
        self.program.binder_list(binders).iter().for_each(|binder| self.term(binder.range));
    }

    fn terms(&mut self, terms: TermList) {
        self.program.term_list(terms).iter().for_each(|term| self.term(*term));
    }

    fn term(&mut self, id: TermId) {
        let program = self.program;
        match program.term(id) {
            Term::Read { function, .. } => {
                if let Role::Element(_) = self.plan.function(*function).role {
                    return;
                }
                self.reach.functions.insert(*function);
            }
            Term::Define { function, .. } => {
                // Its evaluation faults before its arguments are evaluated.
                if self.plan.function(*function).role != Role::Definition {
                    return;
                }
                self.reach.functions.insert(*function);
            }
            Term::Builtin { builtin, .. } => match builtin {
                Builtin::Temporal(_) => return,
                Builtin::TimeNanoseconds | Builtin::TimeMilliseconds | Builtin::TimeSeconds => {
                    self.reach.needs.insert(Need::Clock);
                    return;
                }
                Builtin::Program => _ = self.reach.needs.insert(Need::AgentProgram),
                Builtin::ToString | Builtin::AgentId | Builtin::GetAgent => _ = self.reach.needs.insert(Need::Names),
                // All others are operators, or functions of the runtime.
                _ => {}
            },
            Term::Domain(domain) => self.carrier(*domain),
            Term::Rule(procedure) => _ = self.reach.procedures.insert(*procedure),
            Term::Constant(_)
            | Term::Slot(_)
            | Term::Tuple(_)
            | Term::Project { .. }
            | Term::Collection { .. }
            | Term::Range { .. }
            | Term::Comprehension { .. }
            | Term::Quantified { .. }
            | Term::If { .. }
            | Term::Switch { .. }
            | Term::Let { .. }
            | Term::Unbound
            | Term::Missing(_)
            | Term::Coerce(_) => {}
        }
        program.each_child_of_term(id, &mut |child| self.term(child));
    }

    /// Values are checked against a function's codomain.
    fn codomain(&mut self, function: FunctionId) {
        let codomain = self.program.function(function).codomain;
        if let DomainKind::Concrete { .. } = self.program.domain(codomain).kind {
            self.carrier(codomain);
        }
    }

    /// Whether code can go through a domain's elements as values of one type.
    fn is_enumerable(&self, domain: DomainId) -> bool {
        let plan = self.plan.domain(domain);
        match &self.program.domain(domain).kind {
            DomainKind::Basic(Basic::Boolean) | DomainKind::Enum { .. } | DomainKind::Abstract { .. } => true,
            DomainKind::Concrete { .. } => plan.carrier.is_some() || plan.contents.is_some(),
            DomainKind::Error
            | DomainKind::Any
            | DomainKind::Basic(_)
            | DomainKind::Prod(_)
            | DomainKind::Seq(_)
            | DomainKind::Powerset(_)
            | DomainKind::Bag(_)
            | DomainKind::Map(..)
            | DomainKind::Rule(_) => false,
        }
    }

    /// The elements of a domain, as far as some domain in it grows.
    fn carrier(&mut self, domain: DomainId) {
        match &self.program.domain(domain).kind {
            DomainKind::Prod(parts) => parts.iter().for_each(|part| self.carrier(*part)),
            DomainKind::Powerset(of) => self.carrier(*of),
            DomainKind::Abstract { .. } | DomainKind::Concrete { .. } => {
                if self.plan.domain(domain).carrier.is_some() {
                    self.reach.carriers.insert(domain);
                }
            }
            DomainKind::Error
            | DomainKind::Any
            | DomainKind::Basic(_)
            | DomainKind::Enum { .. }
            | DomainKind::Seq(_)
            | DomainKind::Bag(_)
            | DomainKind::Map(..)
            | DomainKind::Rule(_) => {}
        }
    }
}
