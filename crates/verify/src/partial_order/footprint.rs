//! Computes what a part of the main rule may ever read and write, from the text of its rules.
//!
//! In: a program whose main rule is one `choose` over constant domains, with guards that read nothing; the location of
//! each field. Out: a [`Footprint`] for each binding, and one for the checked conditions. The rules and terms are
//! traversed with the known values of variables: branches with guards known to be false are skipped, and unknown
//! arguments may have any value. INVARIANT: the footprint of a part contains what its steps read and write.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use explore::Settings;
use machine::{Closed, Location, Machine, Value};
use program::{
    Binder, DomainKind, Effect, Expression, FunctionId, ProcedureId, Program, Rule, RuleId, Slot, Term, TermId,
    TermList,
};

/// LIMIT: the most rules and terms that are traversed for one part.
const WALKED: usize = 1 << 20;

/// For each field, whether it may be read or written.
#[derive(Debug, Clone)]
pub struct Footprint {
    pub looks: Vec<bool>,
    pub writes: Vec<bool>,
}

/// The footprints of all parts, by number, and of the conditions.
pub struct Footprints {
    pub parts: Vec<Footprint>,
    pub visible: Footprint,
}

/// The known values of a frame's variables.
#[derive(Debug, Clone)]
struct Frame(Vec<Option<Value>>);

/// Whether it is a procedure, its number, the known arguments, the agent.
type Entered = (bool, u32, Vec<Option<Value>>, Option<Value>);

struct Walk<'p> {
    program: &'p Arc<Program>,
    machine: Machine,
    fields: BTreeMap<FunctionId, Vec<(usize, &'p [Value])>>,
    found: Footprint,
    /// What was traversed: a procedure or a definition, its known arguments, and the agent.
    entered: BTreeSet<Entered>,
    /// The agent that runs, if known.
    agent: Option<Value>,
    walked: usize,
}

/// The footprints of a program; `None` if the main rule does not have that form.
pub fn footprints(program: &Arc<Program>, settings: &Settings, locations: &[Option<Location>]) -> Option<Footprints> {
    let mut machine = Machine::new(Arc::clone(program), settings.limits.clone());
    // The machine only evaluates what does not depend on the state, so a failed start does not matter.
    let _ = machine.start(&mut Closed);
    let mut fields: BTreeMap<FunctionId, Vec<(usize, &[Value])>> = BTreeMap::new();
    for (field, location) in locations.iter().enumerate() {
        if let Some(location) = location {
            fields.entry(location.function).or_default().push((field, &location.arguments));
        }
    }
    let none = Footprint { looks: vec![false; locations.len()], writes: vec![false; locations.len()] };
    let (entered, agent) = (BTreeSet::new(), None);
    let mut walk = Walk { program, machine, fields, found: none.clone(), entered, agent, walked: 0 };
    let main = program.procedure(program.main?);
    let Rule::Choose { binders, condition, body, .. } = program.rule(main.body) else { return None };
    let (binders, condition, body) = (program.binder_list(*binders), *condition, *body);
    if let Some(condition) = condition {
        walk.asks_nothing(condition)?;
    }
    let mut parts = Vec::new();
    for values in walk.bindings(binders)? {
        let mut frame = Frame(vec![None; main.frame as usize]);
        for (binder, value) in binders.iter().zip(values) {
            frame.set(binder.slot, Some(value));
        }
        walk.found = none.clone();
        walk.entered.clear();
        walk.walked = 0;
        if let Some(condition) = condition {
            walk.term(condition, &mut frame);
        }
        walk.rule(body, &mut frame);
        parts.push(walk.found.clone());
    }
    walk.found = none;
    walk.entered.clear();
    for condition in &settings.conditions {
        walk.term(condition.body, &mut Frame(vec![None; condition.frame as usize]));
    }
    Some(Footprints { parts, visible: walk.found })
}

impl Frame {
    fn get(&self, slot: Slot) -> Option<&Value> {
        self.0.get(slot.0 as usize)?.as_ref()
    }

    fn set(&mut self, slot: Slot, value: Option<Value>) {
        let index = slot.0 as usize;
        if index >= self.0.len() {
            self.0.resize(index + 1, None);
        }
        self.0[index] = value;
    }
}

impl Walk<'_> {
    /// Checks that a term neither reads inputs nor depends on the agent.
    fn asks_nothing(&self, term: TermId) -> Option<Vec<FunctionId>> {
        let (parameters, names) = (Vec::new(), Vec::new());
        self.program.reads(&Expression { parameters, frame: 0, names, body: term })
    }

    /// The bindings of a choice, in order: the leftmost varies slowest.
    fn bindings(&mut self, binders: &[Binder]) -> Option<Vec<Vec<Value>>> {
        let constant = self.program.constant_domains();
        let mut all = vec![Vec::new()];
        for binder in binders {
            let Term::Domain(domain) = self.program.term(binder.range) else { return None };
            // The machine may not have started.
            let is_known = constant[domain.0 as usize] && !self.program.waits_for_start(*domain);
            if !is_known || !self.program.is_listable(*domain) {
                return None;
            }
            let elements = self.machine.elements(*domain).ok()?;
            let longer = |values: Vec<Value>| {
                elements.iter().map(move |value| values.iter().chain([value]).cloned().collect()).collect::<Vec<_>>()
            };
            all = all.into_iter().flat_map(longer).collect();
        }
        Some(all)
    }

    /// Anything may be read and written.
    fn give_up(&mut self) {
        self.found.looks.fill(true);
        self.found.writes.fill(true);
    }

    fn is_too_long(&mut self) -> bool {
        self.walked += 1;
        if self.walked == WALKED {
            self.give_up();
        }
        self.walked >= WALKED
    }

    /// The value of a term that depends only on known variables.
    fn known(&mut self, term: TermId, frame: &Frame) -> Option<Value> {
        match self.program.term(term) {
            Term::Slot(slot) => return frame.get(*slot).cloned(),
            Term::Read { function, .. } if Some(*function) == self.program.self_function => return self.agent.clone(),
            _ => {}
        }
        if !self.asks_nothing(term)?.is_empty() || self.depends_on_domains(term) {
            return None;
        }
        let (mut open, mut bindings) = (vec![term], Vec::new());
        while let Some(id) = open.pop() {
            if let Term::Slot(slot) = self.program.term(id) {
                bindings.push((*slot, frame.get(*slot)?.clone()));
            }
            self.program.each_child_of_term(id, &mut |child| open.push(child));
        }
        self.machine.evaluate_with(term, frame.0.len() as u32, &bindings, &mut Closed).ok()
    }

    /// Whether a term, or a definition that it uses, depends on the elements of a domain that may grow.
    fn depends_on_domains(&self, term: TermId) -> bool {
        let (mut open, mut entered) = (vec![term], BTreeSet::new());
        while let Some(id) = open.pop() {
            match self.program.term(id) {
                Term::Domain(_) => return true,
                Term::Define { function, .. } if entered.insert(*function) => {
                    open.extend(self.program.function(*function).definition.as_ref().map(|definition| definition.body));
                }
                Term::Constant(_)
                | Term::Slot(_)
                | Term::Read { .. }
                | Term::Define { .. }
                | Term::Builtin { .. }
                | Term::Tuple(_)
                | Term::Project { .. }
                | Term::Collection { .. }
                | Term::Range { .. }
                | Term::Comprehension { .. }
                | Term::Quantified { .. }
                | Term::If { .. }
                | Term::Switch { .. }
                | Term::Let { .. }
                | Term::Rule(_)
                | Term::Unbound
                | Term::Missing(_)
                | Term::Coerce(_) => {}
            }
            self.program.each_child_of_term(id, &mut |child| open.push(child));
        }
        false
    }

    fn arguments(&mut self, list: TermList, frame: &mut Frame) -> Vec<Option<Value>> {
        let program = Arc::clone(self.program);
        let each = program.term_list(list).iter().map(|term| {
            self.term(*term, frame);
            self.known(*term, frame)
        });
        each.collect()
    }

    fn touch(&mut self, function: FunctionId, arguments: &[Option<Value>], writes: bool) {
        let found = if writes { &mut self.found.writes } else { &mut self.found.looks };
        for (field, location) in self.fields.get(&function).into_iter().flatten() {
            let mut pairs = arguments.iter().zip(*location);
            if pairs.all(|(argument, value)| argument.as_ref().is_none_or(|argument| argument == value)) {
                found[*field] = true;
            }
        }
    }

    fn term(&mut self, id: TermId, frame: &mut Frame) {
        if self.is_too_long() {
            return;
        }
        stacker::maybe_grow(1 << 17, 2 << 20, || self.term_of(id, frame));
    }

    fn term_of(&mut self, id: TermId, frame: &mut Frame) {
        let program = Arc::clone(self.program);
        match program.term(id) {
            Term::Read { function, arguments } => {
                let arguments = self.arguments(*arguments, frame);
                self.touch(*function, &arguments, false);
            }
            Term::Define { function, arguments } => {
                let arguments = self.arguments(*arguments, frame);
                let key = (false, function.0, arguments.clone(), self.agent.clone());
                if self.entered.insert(key)
                    && let Some(definition) = &program.function(*function).definition
                {
                    let mut frame = Frame(vec![None; definition.frame as usize]);
                    arguments.into_iter().enumerate().for_each(|(slot, value)| frame.set(Slot(slot as u32), value));
                    self.term(definition.body, &mut frame);
                }
            }
            Term::If { branches, otherwise } => {
                for branch in program.term_list(*branches).chunks_exact(2) {
                    self.term(branch[0], frame);
                    match self.known(branch[0], frame) {
                        Some(Value::Boolean(true)) => return self.term(branch[1], frame),
                        Some(Value::Boolean(false)) => {}
                        _ => self.term(branch[1], frame),
                    }
                }
                otherwise.iter().for_each(|otherwise| self.term(*otherwise, frame));
            }
            Term::Switch { subject, cases, otherwise } => {
                self.term(*subject, frame);
                let subject = self.known(*subject, frame);
                for case in program.term_list(*cases).chunks_exact(2) {
                    self.term(case[0], frame);
                    match (&subject, self.known(case[0], frame)) {
                        (Some(subject), Some(value)) if *subject == value => return self.term(case[1], frame),
                        (Some(_), Some(_)) => {}
                        _ => self.term(case[1], frame),
                    }
                }
                otherwise.iter().for_each(|otherwise| self.term(*otherwise, frame));
            }
            Term::Let { slot, value, body } => {
                self.term(*value, frame);
                let value = self.known(*value, frame);
                frame.set(*slot, value);
                self.term(*body, frame);
            }
            // Which rule a value is cannot be determined, nor which agent has which program.
            Term::Rule(_) => self.give_up(),
            Term::Builtin { builtin, .. } => match builtin.info().effect {
                Effect::Pure | Effect::Chooses | Effect::ReadsClock => {
                    program.each_child_of_term(id, &mut |child| self.term(child, frame));
                }
                Effect::ReadsAgents | Effect::ReadsBefore | Effect::SpeaksOfRuns => self.give_up(),
            },
            Term::Constant(_)
            | Term::Slot(_)
            | Term::Domain(_)
            | Term::Tuple(_)
            | Term::Project { .. }
            | Term::Collection { .. }
            | Term::Range { .. }
            | Term::Comprehension { .. }
            | Term::Quantified { .. }
            | Term::Unbound
            | Term::Missing(_)
            | Term::Coerce(_) => program.each_child_of_term(id, &mut |child| self.term(child, frame)),
        }
    }

    fn procedure(&mut self, id: ProcedureId, arguments: Vec<Option<Value>>) {
        if self.entered.insert((true, id.0, arguments.clone(), self.agent.clone())) {
            let program = Arc::clone(self.program);
            let procedure = program.procedure(id);
            let mut frame = Frame(vec![None; procedure.frame as usize]);
            arguments.into_iter().enumerate().for_each(|(slot, value)| frame.set(Slot(slot as u32), value));
            self.rule(procedure.body, &mut frame);
        }
    }

    fn rule(&mut self, id: RuleId, frame: &mut Frame) {
        if self.is_too_long() {
            return;
        }
        stacker::maybe_grow(1 << 17, 2 << 20, || self.rule_of(id, frame));
    }

    fn rule_of(&mut self, id: RuleId, frame: &mut Frame) {
        let program = Arc::clone(self.program);
        match program.rule(id) {
            Rule::Update { function, arguments, value } => {
                let arguments = self.arguments(*arguments, frame);
                self.term(*value, frame);
                self.touch(*function, &arguments, true);
            }
            Rule::Call { procedure, arguments } | Rule::TurboCall { procedure, arguments } => {
                let arguments = self.arguments(*arguments, frame);
                self.procedure(*procedure, arguments);
            }
            Rule::Return { function, target, procedure, arguments } => {
                let target = self.arguments(*target, frame);
                self.touch(*function, &target, true);
                let arguments = self.arguments(*arguments, frame);
                self.procedure(*procedure, arguments);
            }
            Rule::RunAgent { agent } => {
                self.term(*agent, frame);
                let known = self.known(*agent, frame);
                self.run_agent(known);
            }
            Rule::RunValue { .. } => self.give_up(),
            Rule::If { guards, rules } => {
                let (guards, rules) = (program.term_list(*guards), program.rule_list(*rules));
                for (guard, rule) in guards.iter().zip(rules) {
                    self.term(*guard, frame);
                    match self.known(*guard, frame) {
                        Some(Value::Boolean(true)) => return self.rule(*rule, frame),
                        Some(Value::Boolean(false)) => {}
                        _ => self.rule(*rule, frame),
                    }
                }
                rules[guards.len()..].iter().for_each(|rule| self.rule(*rule, frame));
            }
            Rule::Switch { subject, values, rules } => {
                self.term(*subject, frame);
                let subject = self.known(*subject, frame);
                let (values, rules) = (program.term_list(*values), program.rule_list(*rules));
                for (value, rule) in values.iter().zip(rules) {
                    self.term(*value, frame);
                    match (&subject, self.known(*value, frame)) {
                        (Some(subject), Some(value)) if *subject == value => return self.rule(*rule, frame),
                        (Some(_), Some(_)) => {}
                        _ => self.rule(*rule, frame),
                    }
                }
                rules[values.len()..].iter().for_each(|rule| self.rule(*rule, frame));
            }
            Rule::Let { slot, value, body } => {
                self.term(*value, frame);
                let value = self.known(*value, frame);
                frame.set(*slot, value);
                self.rule(*body, frame);
            }
            Rule::Skip
            | Rule::Par(_)
            | Rule::Seq(_)
            | Rule::Choose { .. }
            | Rule::Forall { .. }
            | Rule::Extend { .. }
            | Rule::Iterate(_)
            | Rule::While { .. }
            | Rule::RecursiveWhile { .. }
            | Rule::Local { .. } => {
                program.each_term_of_rule(id, &mut |term| self.term(term, frame));
                program.each_child_of_rule(id, &mut |child| self.rule(child, frame));
            }
        }
    }

    fn run_agent(&mut self, agent: Option<Value>) {
        let program = Arc::clone(self.program);
        let Some(agent) = agent else { return self.give_up() };
        let moves = |runs: &program::AgentProgram| {
            matches!(program.domain(runs.domain).kind, DomainKind::Concrete { dynamic: true, .. })
        };
        if program.agents.iter().any(moves) {
            return self.give_up();
        }
        let runs = program.agents.iter().find(|runs| self.machine.contains(runs.domain, &agent));
        if let Some(runs) = runs {
            let before = self.agent.replace(agent);
            self.procedure(runs.procedure, Vec::new());
            self.agent = before;
        }
    }
}
