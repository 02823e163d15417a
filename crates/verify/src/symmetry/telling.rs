//! Finds what a program's text distinguishes: named elements, and operations that reveal an order.
//!
//! In: a program, the checked conditions, the domains in question. Out: a [`Telling`]. The main rule, the programs of
//! agents, the conditions, rules that are values, and everything that these call are traversed. Initial values are
//! traversed separately, as most are evaluated before the first step. INVARIANT: what is traversed and not reported
//! means the same for all elements, except for the order in which quantifiers, comprehensions and `forall` visit them.

use std::collections::{BTreeMap, BTreeSet};

use explore::Settings;
use machine::Value;
use program::{
    CollectionKind, DomainId, DomainKind, FunctionId, Literal, ProcedureId, Program, Rule, RuleId, ShowsOrder, Term,
    TermId,
};
use syntax::Span;

use crate::symmetry::element::{Distinct, count, element};

/// What the text distinguishes.
#[derive(Debug, Default)]
pub struct Telling {
    /// Named elements, each with the first place.
    pub named: BTreeMap<Value, Distinct>,
    /// Domains whose elements are distinguished, each with the first place.
    pub told: BTreeMap<DomainId, Span>,
    /// Where elements are created.
    pub extended: Option<Span>,
    /// The ranges of what iterates over elements.
    pub ranges: BTreeSet<TermId>,
    /// By function, the elements that its initial value names.
    pub initial: BTreeMap<FunctionId, BTreeMap<Value, Span>>,
}

struct Walk<'p> {
    program: &'p Program,
    domains: &'p [DomainId],
    found: Telling,
    terms: BTreeSet<TermId>,
    rules: BTreeSet<RuleId>,
    open: Vec<Next>,
    /// While in an initial value: the rules that it may be, which run later.
    values: Option<Vec<ProcedureId>>,
}

enum Next {
    Term(TermId),
    Rule(RuleId),
    Procedure(ProcedureId),
}

/// Whether values of a domain may be, or contain, elements of another.
pub fn mentions(program: &Program, domain: DomainId, of: DomainId) -> bool {
    match &program.domain(domain).kind {
        _ if domain == of => true,
        DomainKind::Any => true,
        DomainKind::Concrete { base, .. } => mentions(program, *base, of),
        DomainKind::Prod(parts) => parts.iter().any(|part| mentions(program, *part, of)),
        DomainKind::Seq(part) | DomainKind::Powerset(part) | DomainKind::Bag(part) => mentions(program, *part, of),
        DomainKind::Map(key, value) => mentions(program, *key, of) || mentions(program, *value, of),
        DomainKind::Error
        | DomainKind::Basic(_)
        | DomainKind::Enum { .. }
        | DomainKind::Abstract { .. }
        | DomainKind::Rule(_) => false,
    }
}

impl Telling {
    /// What a program distinguishes among the elements of these domains.
    pub fn of(program: &Program, settings: &Settings, domains: &[DomainId]) -> Telling {
        let (terms, rules) = (BTreeSet::new(), BTreeSet::new());
        let found = Telling::default();
        let mut walk = Walk { program, domains, found, terms, rules, open: Vec::new(), values: Some(Vec::new()) };
        let (mut ranges, mut initials) = (BTreeSet::new(), BTreeMap::new());
        for initial in &program.initials {
            // Each initial value is traversed on its own, including terms that others have visited.
            walk.terms.clear();
            walk.open.push(Next::Term(initial.value.body));
            walk.all();
            let Telling { named, told, ranges: more, .. } = std::mem::take(&mut walk.found);
            let of_initial: &mut BTreeMap<Value, Span> = initials.entry(initial.function).or_default();
            for (element, distinct) in named {
                if let Distinct::Named(span) = distinct {
                    of_initial.insert(element, span);
                }
            }
            // A visible order is treated as if all elements were named.
            for (domain, span) in told {
                let count = count(program, domain) as u32;
                of_initial.extend((0..count).map(|index| (element(program, domain, index), span)));
            }
            ranges.extend(more);
        }
        walk.terms.clear();
        let values = walk.values.take().unwrap_or_default();
        let procedures = program.main.iter().copied().chain(program.agents.iter().map(|agent| agent.procedure));
        walk.open.extend(procedures.chain(values).map(Next::Procedure));
        let steps = settings.step_conditions.iter().map(|(formula, _)| formula);
        walk.open.extend(settings.conditions.iter().chain(steps).map(|formula| Next::Term(formula.body)));
        walk.all();
        let mut found = walk.found;
        found.ranges.extend(ranges);
        found.initial = initials;
        found
    }

    /// Only some values of an input are tried.
    pub fn bound(&mut self, function: FunctionId, values: &[Value]) {
        let mut open: Vec<Value> = values.to_vec();
        while let Some(value) = open.pop() {
            match &value {
                Value::Enum(..) | Value::Element(..) => {
                    self.named.entry(value).or_insert(Distinct::Bounded(function));
                }
                Value::Tuple(items) | Value::Seq(items) | Value::Set(items) => open.extend(items.iter().cloned()),
                Value::Bag(items) => open.extend(items.keys().cloned()),
                Value::Map(items) => open.extend(items.iter().flat_map(|(key, value)| [key.clone(), value.clone()])),
                _ => {}
            }
        }
    }
}

impl Walk<'_> {
    fn all(&mut self) {
        let program = self.program;
        while let Some(next) = self.open.pop() {
            match next {
                Next::Procedure(procedure) => self.open.push(Next::Rule(program.procedure(procedure).body)),
                Next::Rule(id) if self.rules.insert(id) => self.rule(id),
                Next::Term(id) if self.terms.insert(id) => self.term(id),
                Next::Rule(_) | Next::Term(_) => {}
            }
        }
    }

    fn name(&mut self, element: Value, span: Span) {
        self.found.named.entry(element).or_insert(Distinct::Named(span));
    }

    /// Records that elements in the values of a domain are distinguished.
    fn tell(&mut self, domain: DomainId, span: Span) {
        let program = self.program;
        for told in self.domains.iter().filter(|of| mentions(program, domain, **of)) {
            self.found.told.entry(*told).or_insert(span);
        }
    }

    fn term(&mut self, id: TermId) {
        let program = self.program;
        let span = program.term_span(id);
        match program.term(id) {
            Term::Constant(index) => {
                if let Literal::Enum(domain, index) = program.constants[*index as usize] {
                    self.name(Value::Enum(domain, index), span);
                }
            }
            Term::Read { function, .. } => {
                let function = program.function(*function);
                if let Some(index) = function.element {
                    self.name(element(program, program.base_domain(function.codomain), index), span);
                }
            }
            Term::Define { function, .. } => {
                let definition = program.function(*function).definition.as_ref();
                self.open.extend(definition.map(|definition| Next::Term(definition.body)));
            }
            Term::Rule(procedure) => match &mut self.values {
                Some(values) => values.push(*procedure),
                None => self.open.push(Next::Procedure(*procedure)),
            },
            Term::Quantified { binders, .. } => {
                self.found.ranges.extend(program.binder_list(*binders).iter().map(|binder| binder.range));
            }
            Term::Comprehension { kind, binders, .. } => {
                for binder in program.binder_list(*binders) {
                    self.found.ranges.insert(binder.range);
                    // A sequence reveals their order; in a map, the last of equal keys counts.
                    if matches!(kind, CollectionKind::Seq | CollectionKind::Map) {
                        self.tell(program.term_domain(binder.range), span);
                    }
                }
            }
            Term::Builtin { builtin, arguments } => {
                let told: &[TermId] = match builtin.info().shows_order {
                    ShowsOrder::No => &[],
                    ShowsOrder::OfOperands => program.term_list(*arguments),
                    ShowsOrder::OfResult => &[id],
                };
                told.iter().for_each(|term| self.tell(program.term_domain(*term), span));
            }
            Term::Slot(_)
            | Term::Domain(_)
            | Term::Tuple(_)
            | Term::Project { .. }
            | Term::Collection { .. }
            | Term::Range { .. }
            | Term::If { .. }
            | Term::Switch { .. }
            | Term::Let { .. }
            | Term::Unbound
            | Term::Missing(_)
            | Term::Coerce(_) => {}
        }
        program.each_child_of_term(id, &mut |child| self.open.push(Next::Term(child)));
    }

    fn rule(&mut self, id: RuleId) {
        let program = self.program;
        match program.rule(id) {
            Rule::Call { procedure, .. } | Rule::TurboCall { procedure, .. } | Rule::Return { procedure, .. } => {
                self.open.push(Next::Procedure(*procedure));
            }
            Rule::Choose { binders, .. } | Rule::Forall { binders, .. } => {
                self.found.ranges.extend(program.binder_list(*binders).iter().map(|binder| binder.range));
            }
            Rule::Extend { .. } => {
                self.found.extended.get_or_insert(program.rule_span(id));
            }
            Rule::Skip
            | Rule::Update { .. }
            | Rule::RunValue { .. }
            | Rule::RunAgent { .. }
            | Rule::Par(_)
            | Rule::Seq(_)
            | Rule::If { .. }
            | Rule::Switch { .. }
            | Rule::Let { .. }
            | Rule::Iterate(_)
            | Rule::While { .. }
            | Rule::RecursiveWhile { .. }
            | Rule::Local { .. } => {}
        }
        program.each_term_of_rule(id, &mut |term| self.open.push(Next::Term(term)));
        program.each_child_of_rule(id, &mut |rule| self.open.push(Next::Rule(rule)));
    }
}
