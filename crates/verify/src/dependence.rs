//! What a property depends on: the functions that it reads, those that their updates read, and so on.
//!
//! In: a program. Out: for each property its [`Cone`], and what lies in none: functions, and the updates of them. This is the cone of
//! influence of model checking (E. M. Clarke, O. Grumberg, D. Peled, *Model Checking*, 1999, section 13.1), for update rules. INVARIANT: what is
//! outside of a property's cone could be left out, or be another rule, without changing whether the property holds, unless a
//! step could then not be made at all. The converse is not said: what is inside may make no difference.

use std::collections::BTreeSet;

use program::{
    DomainId, Expression, FunctionId, FunctionKind, ProcedureId, Program, Property, PropertyKind, Rule, RuleId, Runs,
    Term, TermId,
};
use syntax::Span;

/// What one property depends on.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Cone {
    /// The property's number.
    pub property: usize,
    /// The functions of the state, and the inputs, in the order of their declarations.
    pub functions: Vec<FunctionId>,
}

/// A function, and where rules write it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Written {
    /// The function.
    pub function: FunctionId,
    /// The updates, in the order of the texts.
    pub updates: Vec<Span>,
}

/// What properties depend on, and what none depends on.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Dependence {
    /// By property.
    pub cones: Vec<Cone>,
    /// The functions in some cone.
    pub within: Vec<Written>,
    /// The functions in none.
    pub outside: Vec<Written>,
}

/// Looks at these properties of a program, of the functions that no built-in library declares.
pub fn dependence(program: &Program, properties: &[usize]) -> Dependence {
    let flow = Flow::of(program);
    // A state that an assumption excludes is no state of any run, and fairness excludes runs.
    let assumed = program.properties.iter().filter(|property| !is_asked(property.kind));
    let assumed: BTreeSet<Node> = assumed.flat_map(|property| flow.reads_of(property)).collect();
    let cone = |property: usize| {
        let roots = flow.reads_of(&program.properties[property]);
        flow.closure(roots.into_iter().chain(assumed.iter().copied()))
    };
    let own = |function: FunctionId| {
        let declared = program.function(function);
        !declared.library && !matches!(declared.kind, FunctionKind::Static | FunctionKind::Derived)
    };
    let cones: Vec<Cone> = properties
        .iter()
        .map(|property| {
            let nodes = cone(*property);
            let functions = nodes.into_iter().filter_map(|node| match node {
                Node::Function(function) if own(function) => Some(function),
                Node::Function(_) | Node::Domain(_) => None,
            });
            Cone { property: *property, functions: functions.collect() }
        })
        .collect();
    let covered: BTreeSet<FunctionId> = cones.iter().flat_map(|cone| cone.functions.iter().copied()).collect();
    let all = (0..program.functions.len() as u32).map(FunctionId).filter(|function| own(*function));
    let written = |function: FunctionId| Written { function, updates: flow.updates_of(function) };
    let (within, outside): (Vec<Written>, Vec<Written>) =
        all.map(written).partition(|written| covered.contains(&written.function));
    Dependence { cones, within, outside }
}

fn is_asked(kind: PropertyKind) -> bool {
    match kind {
        PropertyKind::Invariant | PropertyKind::Ctl | PropertyKind::Ltl => true,
        PropertyKind::Invar | PropertyKind::Justice | PropertyKind::Compassion => false,
    }
}

/// What can be read, and can change.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Node {
    Function(FunctionId),
    /// The elements of a domain that grows.
    Domain(DomainId),
}

type Nodes = BTreeSet<Node>;

/// What flows into what.
struct Flow<'p> {
    program: &'p Program,
    /// By function, what its updates rest on.
    into_function: Vec<Nodes>,
    /// By domain, what its growth rests on.
    into_domain: Vec<Nodes>,
    /// By procedure, what decides that it runs, and with which arguments.
    around: Vec<Nodes>,
    updates: Vec<Vec<Span>>,
    /// What decides which rule runs where a value is run: another value might be a rule that writes anything.
    chosen: Nodes,
    /// A procedure's surroundings have grown.
    grown: bool,
}

impl<'p> Flow<'p> {
    fn of(program: &'p Program) -> Flow<'p> {
        let mut flow = Flow {
            program,
            into_function: vec![Nodes::new(); program.functions.len()],
            into_domain: vec![Nodes::new(); program.domains.len()],
            around: vec![Nodes::new(); program.procedures.len()],
            updates: vec![Vec::new(); program.functions.len()],
            chosen: Nodes::new(),
            grown: true,
        };
        for initial in &program.initials {
            let reads = flow.reads(initial.value.body);
            flow.into_function[initial.function.0 as usize].extend(reads);
        }
        let run = flow.run();
        // The surroundings of a procedure are those of its calls, which may lie in procedures themselves.
        while std::mem::take(&mut flow.grown) {
            flow.updates.iter_mut().for_each(Vec::clear);
            for procedure in &run {
                let around = flow.around[procedure.0 as usize].clone();
                flow.rule(program.procedure(*procedure).body, &around);
            }
        }
        let writable = |kind| matches!(kind, FunctionKind::Controlled | FunctionKind::Shared | FunctionKind::Out);
        for (into, function) in flow.into_function.iter_mut().zip(&program.functions) {
            if writable(function.kind) {
                into.extend(&flow.chosen);
            }
        }
        flow.into_domain.iter_mut().for_each(|into| into.extend(&flow.chosen));
        flow
    }

    /// The procedures that steps run.
    fn run(&self) -> BTreeSet<ProcedureId> {
        let program = self.program;
        let mut found = BTreeSet::new();
        let mut open: Vec<ProcedureId> = program.main.into_iter().collect();
        while let Some(procedure) = open.pop() {
            if !found.insert(procedure) {
                continue;
            }
            let mut rules = vec![program.procedure(procedure).body];
            while let Some(rule) = rules.pop() {
                open.extend(self.called(rule));
                program.each_child_of_rule(rule, &mut |child| rules.push(child));
            }
        }
        found
    }

    fn reads_of(&self, property: &Property) -> Vec<Node> {
        let formulas = [Some(&property.formula), property.conclusion.as_ref()];
        let formulas = formulas.into_iter().flatten().map(|formula: &Expression| formula.body);
        formulas.flat_map(|body| self.reads(body)).collect()
    }

    /// What a term reads, directly or through definitions.
    fn reads(&self, term: TermId) -> Nodes {
        let program = self.program;
        let (mut found, mut entered, mut open) = (Nodes::new(), BTreeSet::new(), vec![term]);
        while let Some(id) = open.pop() {
            match program.term(id) {
                Term::Read { function, .. } | Term::Define { function, .. } => {
                    found.insert(Node::Function(*function));
                    if entered.insert(*function) {
                        let definition = program.function(*function).definition.as_ref();
                        open.extend(definition.map(|definition| definition.body));
                    }
                }
                Term::Domain(domain) => _ = found.insert(Node::Domain(*domain)),
                Term::Constant(_)
                | Term::Slot(_)
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
            program.each_child_of_term(id, &mut |child| open.push(child));
        }
        found
    }

    /// What everything in a rule rests on and writes, calls included: whether a loop goes on depends on all of it.
    fn all_of(&self, rule: RuleId) -> Nodes {
        let program = self.program;
        let (mut found, mut entered, mut open) = (Nodes::new(), BTreeSet::new(), vec![rule]);
        while let Some(id) = open.pop() {
            program.each_term_of_rule(id, &mut |term| found.extend(self.reads(term)));
            match program.rule(id) {
                Rule::Update { function, .. } => _ = found.insert(Node::Function(*function)),
                Rule::Return { function, .. } => {
                    found.insert(Node::Function(*function));
                    found.extend(program.result_function.map(Node::Function));
                }
                Rule::Extend { domain, .. } => _ = found.insert(Node::Domain(*domain)),
                Rule::Skip
                | Rule::Call { .. }
                | Rule::TurboCall { .. }
                | Rule::RunValue { .. }
                | Rule::RunAgent { .. }
                | Rule::Par(_)
                | Rule::Seq(_)
                | Rule::If { .. }
                | Rule::Switch { .. }
                | Rule::Let { .. }
                | Rule::Choose { .. }
                | Rule::Forall { .. }
                | Rule::Iterate(_)
                | Rule::While { .. }
                | Rule::RecursiveWhile { .. }
                | Rule::Local { .. } => {}
            }
            let called: Vec<ProcedureId> = self.called(id);
            open.extend(called.into_iter().filter(|id| entered.insert(*id)).map(|id| program.procedure(id).body));
            program.each_child_of_rule(id, &mut |child| open.push(child));
        }
        found
    }

    /// The procedures that a rule may run, besides the rules written in it.
    fn called(&self, rule: RuleId) -> Vec<ProcedureId> {
        match self.program.rule(rule).runs() {
            Runs::Nothing => Vec::new(),
            Runs::Procedure(procedure) => vec![procedure],
            // Any rule that is a value somewhere.
            Runs::Value { .. } => {
                let values = self.program.terms.iter().filter_map(|term| match term {
                    Term::Rule(procedure) => Some(*procedure),
                    _ => None,
                });
                values.collect()
            }
            Runs::Agent => self.program.agents.iter().map(|agent| agent.procedure).collect(),
        }
    }

    fn write(&mut self, function: FunctionId, nodes: &Nodes, rule: RuleId) {
        self.into_function[function.0 as usize].extend(nodes);
        self.updates[function.0 as usize].push(self.program.rule_span(rule));
    }

    /// Follows what flows into the updates of a rule; `around` is what decides that it runs, and what its variables are.
    fn rule(&mut self, id: RuleId, around: &Nodes) {
        let program = self.program;
        // The terms of this rule: guards, ranges and values of variables decide what happens within, too.
        let mut here = around.clone();
        program.each_term_of_rule(id, &mut |term| here.extend(self.reads(term)));
        for procedure in self.called(id) {
            let of = &mut self.around[procedure.0 as usize];
            let before = of.len();
            of.extend(&here);
            self.grown |= of.len() > before;
        }
        match program.rule(id) {
            Rule::Update { function, .. } => self.write(*function, &here, id),
            Rule::Return { function, .. } => {
                here.extend(program.result_function.map(Node::Function));
                self.write(*function, &here, id);
            }
            Rule::Extend { domain, .. } => {
                let base = program.base_domain(*domain);
                self.into_domain[domain.0 as usize].extend(&here);
                self.into_domain[base.0 as usize].extend(&here);
                here.insert(Node::Domain(*domain));
            }
            Rule::Iterate(body) | Rule::While { body, .. } | Rule::RecursiveWhile { body, .. } => {
                here.extend(self.all_of(*body));
            }
            Rule::RunValue { .. } => self.chosen.extend(&here),
            Rule::Skip
            | Rule::Call { .. }
            | Rule::TurboCall { .. }
            | Rule::RunAgent { .. }
            | Rule::Par(_)
            | Rule::Seq(_)
            | Rule::If { .. }
            | Rule::Switch { .. }
            | Rule::Let { .. }
            | Rule::Choose { .. }
            | Rule::Forall { .. }
            | Rule::Local { .. } => {}
        }
        let mut children = Vec::new();
        program.each_child_of_rule(id, &mut |child| children.push(child));
        children.into_iter().for_each(|child| self.rule(child, &here));
    }

    fn closure(&self, roots: impl Iterator<Item = Node>) -> Nodes {
        let mut found = Nodes::new();
        let mut open: Vec<Node> = roots.collect();
        while let Some(node) = open.pop() {
            if found.insert(node) {
                open.extend(match node {
                    Node::Function(function) => &self.into_function[function.0 as usize],
                    Node::Domain(domain) => &self.into_domain[domain.0 as usize],
                });
            }
        }
        found
    }

    /// Where a function is updated; a rule that is lowered several times has one place.
    fn updates_of(&self, function: FunctionId) -> Vec<Span> {
        let mut updates = self.updates[function.0 as usize].clone();
        updates.sort_by_key(|span| (span.file, span.start));
        updates.dedup();
        updates
    }
}
