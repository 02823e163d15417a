//! What the translator knows of the program and its state's layout, and what it leaves to the running code.
//!
//! In: the program and the machine's core after its start. Out: decisions (what is inlined, what is tabulated), the
//! [`Facts`] that they rest on, and what compiled code refers to by number.

use std::sync::Arc;
use std::sync::atomic::AtomicU8;

use cranelift_module::FuncId;
use program::{
    Builtin, Certain, Certainty, DomainId, DomainKind, Effect, FunctionId, ProcedureId, Program, Rule, RuleId, Slot,
    Term, TermId,
};

use crate::execute::Core;
use crate::layout::Layout;
use crate::memo;
use crate::native::facts::Facts;
use crate::native::grounds::Grounds;
use crate::native::helper::Helpers;
use crate::native::nesting::{Nesting, UnitKey};
use crate::native::numbered::{Fixed, Numbered};
use crate::native::shape::{Kind, Scalar, consecutive};
use crate::value::Value;
use crate::weighed::Items;

/// LIMIT: a body of more terms and rules is translated once, where it is called from more than one place.
const INLINE: usize = 12;
/// LIMIT: a function of more terms and rules inlines no more.
const BODY: usize = 1_200;
/// LIMIT: nested inlining.
const DEPTH: usize = 24;
/// LIMIT: entries of a table of a fixed term.
const TABLE: i64 = 1 << 16;

static UNDEF: Value = Value::Undef;

/// The knowledge of one compilation.
#[derive(Debug)]
pub(super) struct Plan {
    /// The procedure that makes the steps, if steps are compiled.
    main: Option<ProcedureId>,
    pub helpers: Helpers,
    pub constants: Arc<Items>,
    pub facts: Facts,
    pub certainty: Certainty,
    /// By function: its definition depends on no state.
    fixed: Vec<bool>,
    /// By domain: it has the same elements in all states.
    constant: Vec<bool>,
    /// How often each unit is called in the program's text.
    procedure_calls: Vec<u32>,
    definition_calls: Vec<u32>,
    pub nesting: Nesting,
    pub units: Vec<(UnitKey, FuncId)>,
    pub queue: Vec<(UnitKey, FuncId)>,
    pub numbered: Numbered,
    /// Arrays that the code refers to.
    pub pinned: Vec<Arc<Items>>,
    /// By rule, 1 where it has run; empty where that is not noted.
    pub ran: Box<[AtomicU8]>,
    /// Some term may gather items.
    pub gathers: bool,
    /// While a term is evaluated, kept values of definitions may be replaced by those of another state: of that before the step, or of
    /// the initial one.
    pub visits: bool,
}

impl Plan {
    /// Looks at a program and a started core.
    pub fn new(program: &Program, main: Option<ProcedureId>, core: &Core, helpers: Helpers) -> Plan {
        let mut procedure_calls = vec![0; program.procedures.len()];
        let mut definition_calls = vec![0; program.functions.len()];
        for rule in &program.rules {
            if let Rule::Call { procedure, .. } | Rule::TurboCall { procedure, .. } = rule {
                procedure_calls[procedure.0 as usize] += 1;
            }
        }
        for agent in &program.agents {
            procedure_calls[agent.procedure.0 as usize] += 1;
        }
        for term in &program.terms {
            match term {
                Term::Define { function, .. } => definition_calls[function.0 as usize] += 1,
                Term::Rule(procedure) => procedure_calls[procedure.0 as usize] += 1,
                _ => {}
            }
        }
        let constants = Arc::new(Items::new(core.constants.clone()));
        let (facts, constant) = (Facts::of(program, core), program.constant_domains());
        let certainty = Grounds { program, facts: &facts, constant: &constant }.certainty();
        let visits = facts.late || program.terms.iter().any(reads_before);
        Plan {
            main,
            helpers,
            constants: Arc::clone(&constants),
            facts,
            certainty,
            fixed: memo::fixed_functions(program),
            constant,
            procedure_calls,
            definition_calls,
            nesting: Nesting::of(program),
            units: Vec::new(),
            queue: Vec::new(),
            numbered: Numbered::default(),
            pinned: vec![constants],
            ran: Box::default(),
            gathers: program.terms.iter().any(may_gather),
            visits,
        }
    }

    /// From now on the code that is made notes which rules run, and leaves out updates that change nothing: for searches.
    pub fn note_rules(&mut self, program: &Program) {
        self.ran = program.rules.iter().map(|_| AtomicU8::new(0)).collect();
    }

    /// Whether updates that change nothing are left out.
    pub fn is_terse(&self) -> bool {
        !self.ran.is_empty()
    }

    /// Where it is noted that a rule has run, if that is noted.
    pub fn mark_of(&self, rule: RuleId) -> Option<*const AtomicU8> {
        self.ran.get(rule.0 as usize).map(std::ptr::from_ref)
    }

    /// The address of undef.
    pub fn undef(&self) -> *const Value {
        &raw const UNDEF
    }

    /// Keeps an array alive as long as the code.
    pub fn pin(&mut self, values: Arc<Items>) {
        self.pinned.push(values);
    }

    /// The bounds of a domain whose elements are consecutive numbers in every state.
    pub fn numbers(&self, program: &Program, domain: DomainId) -> Option<(i64, i64)> {
        match &program.domain(domain).kind {
            DomainKind::Abstract { elements, .. } if self.constant[domain.0 as usize] => {
                Some((0, elements.len() as i64 - 1))
            }
            _ => self.facts.contents[domain.0 as usize].as_ref().and_then(|values| consecutive(values)),
        }
    }

    /// Whether agents alone run a unit: within it, `self` is one.
    pub fn runs_by_agent(&self, key: UnitKey) -> bool {
        match key {
            UnitKey::Procedure(id) => self.certainty.procedure_is_of_agents(id),
            UnitKey::Definition(id) => self.certainty.definition_is_of_agents(id),
        }
    }

    /// What is certain of a term's value, given what is of the variables that occur in it.
    pub fn certain(&self, program: &Program, term: TermId, free: &dyn Fn(Slot) -> Certain) -> Certain {
        let grounds = Grounds { program, facts: &self.facts, constant: &self.constant };
        self.certainty.term(program, &grounds, term, free)
    }

    /// The numbers that a scalar may have, as far as they are bounded.
    pub fn bounds(&self, program: &Program, scalar: Scalar) -> Option<(i64, i64)> {
        let all = match scalar.kind {
            Kind::Boolean => Some((0, 1)),
            Kind::Enum(domain) | Kind::Element(domain) => match &program.domain(domain).kind {
                DomainKind::Enum { literals } => Some((0, literals.len() as i64 - 1)),
                DomainKind::Abstract { .. } => self.numbers(program, domain),
                _ => None,
            },
            _ => None,
        };
        scalar.range.or(all)
    }

    /// Procedures that occur as values and take so many arguments.
    pub fn rule_values(&self, program: &Program, arity: usize) -> Vec<ProcedureId> {
        let mut found: Vec<ProcedureId> = program
            .terms
            .iter()
            .filter_map(|term| if let Term::Rule(procedure) = term { Some(*procedure) } else { None })
            .chain(program.agents.iter().map(|entry| entry.procedure))
            .filter(|procedure| program.procedure(*procedure).parameters.len() == arity)
            .collect();
        found.sort_unstable();
        found.dedup();
        found
    }

    /// Whether every agent that a scalar may be has a program.
    pub fn all_have_program(&self, program: &Program, agent: Scalar) -> bool {
        let (Kind::Element(base), Some((low, high))) = (agent.kind, self.bounds(program, agent)) else { return false };
        (low..=high).all(|number| {
            let element = Value::Element(base, number as u32);
            program.agents.iter().any(|entry| {
                entry.domain == base
                    || self.facts.contents[entry.domain.0 as usize].as_ref().is_some_and(|all| all.contains(&element))
            })
        })
    }

    /// Where `self` is kept.
    pub fn self_location(&self, program: &Program) -> Option<u32> {
        match self.facts.layouts[program.self_function?.0 as usize] {
            Layout::Single(index) => Some(index),
            _ => None,
        }
    }

    /// Whether a unit is small enough, or used once, to be translated where it is called.
    pub fn is_small(&self, program: &Program, key: UnitKey, weight: usize, depth: usize) -> bool {
        let (own, calls) = match key {
            UnitKey::Procedure(id) => {
                (weight_of_rule(program, program.procedure(id).body), self.procedure_calls[id.0 as usize])
            }
            UnitKey::Definition(id) => {
                let Some(definition) = &program.function(id).definition else { return false };
                (weight_of_term(program, definition.body), self.definition_calls[id.0 as usize])
            }
        };
        depth < DEPTH && weight + own < BODY && (own <= INLINE || calls <= 1)
    }

    /// Whether a term depends on nothing but its variables and is worth a table.
    pub fn is_fixed(&self, program: &Program, term: TermId) -> bool {
        is_worth(program, term) && memo::is_fixed_term(program, term, &self.fixed)
    }

    /// Whether evaluating a term asks the environment for nothing.
    pub fn is_silent(&self, program: &Program, term: TermId) -> bool {
        let mut open = vec![term];
        let mut entered = Vec::new();
        while let Some(id) = open.pop() {
            match program.term(id) {
                Term::Read { function, .. } => {
                    let known = program.function(*function).element.is_some() || self.facts.plain[function.0 as usize];
                    if !known || self.facts.lazy[function.0 as usize] {
                        return false;
                    }
                }
                Term::Define { function, .. } if !entered.contains(function) => {
                    entered.push(*function);
                    open.extend(program.function(*function).definition.as_ref().map(|definition| definition.body));
                }
                Term::Builtin { builtin, .. } if !builtin.info().effect.is_none() => return false,
                Term::Define { .. }
                | Term::Builtin { .. }
                | Term::Constant(_)
                | Term::Slot(_)
                | Term::Domain(_)
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
        true
    }

    /// The number of a table for a fixed term.
    pub fn table(&mut self, term: TermId, spill: usize, entries: i64) -> Option<usize> {
        if !(1..=TABLE).contains(&entries) {
            return None;
        }
        Some(self.numbered.table(Fixed { term, spill: spill as u64, entries: entries as usize }))
    }

    /// The variables that occur in a term, sorted.
    pub fn slots_of_term(&self, program: &Program, term: TermId, slots: &mut Vec<u32>) {
        if let Term::Slot(slot) = program.term(term)
            && !slots.contains(&slot.0)
        {
            slots.push(slot.0);
        }
        program.each_child_of_term(term, &mut |child| self.slots_of_term(program, child, slots));
        slots.sort_unstable();
    }

    /// Whether a rule of the compiled procedure's own body is the only one that updates a function, and runs once a step.
    pub fn is_only_update(&self, program: &Program, function: FunctionId, id: RuleId) -> bool {
        // Called by another it would run once more.
        let once = self.main.is_some_and(|main| self.procedure_calls[main.0 as usize] == 0);
        let only = program.rules.iter().enumerate().all(|(index, rule)| match rule {
            Rule::Update { function: updated, .. } | Rule::Return { function: updated, .. } => {
                *updated != function || index == id.0 as usize
            }
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
            | Rule::Extend { .. }
            | Rule::Iterate(_)
            | Rule::While { .. }
            | Rule::RecursiveWhile { .. }
            | Rule::Local { .. } => true,
        });
        once && only
    }

    /// The variables that a term binds itself.
    pub fn own_slots(&self, program: &Program, term: TermId) -> Vec<u32> {
        let mut own = Vec::new();
        let mut open = vec![term];
        while let Some(id) = open.pop() {
            match program.term(id) {
                Term::Let { slot, .. } => own.push(slot.0),
                Term::Comprehension { binders, .. } | Term::Quantified { binders, .. } => {
                    own.extend(program.binder_list(*binders).iter().map(|binder| binder.slot.0));
                }
                Term::Constant(_)
                | Term::Slot(_)
                | Term::Read { .. }
                | Term::Define { .. }
                | Term::Builtin { .. }
                | Term::Domain(_)
                | Term::Tuple(_)
                | Term::Project { .. }
                | Term::Collection { .. }
                | Term::Range { .. }
                | Term::If { .. }
                | Term::Switch { .. }
                | Term::Rule(_)
                | Term::Unbound
                | Term::Missing(_)
                | Term::Coerce(_) => {}
            }
            program.each_child_of_term(id, &mut |child| open.push(child));
        }
        own
    }

    /// The variables that occur in a rule, sorted.
    pub fn slots_of_rule(&self, program: &Program, rule: RuleId, slots: &mut Vec<u32>) {
        program.each_term_of_rule(rule, &mut |term| self.slots_of_term(program, term, slots));
        program.each_child_of_rule(rule, &mut |child| self.slots_of_rule(program, child, slots));
    }
}

fn reads_before(term: &Term) -> bool {
    matches!(term, Term::Builtin { builtin, .. } if builtin.info().effect == Effect::ReadsBefore)
}

/// Whether a term may give a collection that is not made.
fn may_gather(term: &Term) -> bool {
    match term {
        Term::Collection { .. } | Term::Comprehension { .. } => true,
        Term::Builtin { builtin, .. } => {
            matches!(builtin, Builtin::SeqConcat | Builtin::SetUnion | Builtin::AsSet | Builtin::Append)
        }
        _ => false,
    }
}

/// Whether evaluating a term anew costs more than looking it up.
fn is_worth(program: &Program, term: TermId) -> bool {
    cost(program, term, 0) > LOOKUP
}

/// LIMIT: what costs less than so many simple operations is not tabulated.
const LOOKUP: u32 = 24;

/// About how many simple operations evaluating a term takes; counted no further than it matters.
fn cost(program: &Program, term: TermId, depth: u32) -> u32 {
    let own = match program.term(term) {
        Term::Define { function, .. } => match &program.function(*function).definition {
            Some(_) if depth > 8 => 2 * LOOKUP,
            Some(definition) => 1 + cost(program, definition.body, depth + 1),
            None => 1,
        },
        Term::Quantified { .. }
        | Term::Comprehension { .. }
        | Term::Range { .. }
        | Term::Collection { .. }
        | Term::Tuple(_) => 2 * LOOKUP,
        Term::Domain(domain)
            if !matches!(program.domain(*domain).kind, DomainKind::Basic(_)) && is_static_domain(program, *domain) =>
        {
            2 * LOOKUP
        }
        Term::Builtin {
            builtin: Builtin::SetContains | Builtin::SetNotIn | Builtin::SeqAt | Builtin::MapAt | Builtin::IntPower,
            ..
        } => 2 * LOOKUP,
        _ => 1,
    };
    let mut total = own;
    program.each_child_of_term(term, &mut |child| {
        if total <= LOOKUP {
            total += cost(program, child, depth);
        }
    });
    total
}

fn is_static_domain(program: &Program, domain: DomainId) -> bool {
    match &program.domain(domain).kind {
        DomainKind::Enum { .. } => true,
        DomainKind::Abstract { dynamic, .. } | DomainKind::Concrete { dynamic, .. } => !dynamic,
        _ => false,
    }
}

/// How many terms and rules a rule holds, calls not followed.
fn weight_of_rule(program: &Program, rule: RuleId) -> usize {
    let mut weight = 1;
    program.each_term_of_rule(rule, &mut |term| weight += weight_of_term(program, term));
    program.each_child_of_rule(rule, &mut |child| weight += weight_of_rule(program, child));
    weight
}

fn weight_of_term(program: &Program, term: TermId) -> usize {
    let mut weight = 1;
    program.each_child_of_term(term, &mut |child| weight += weight_of_term(program, child));
    weight
}
