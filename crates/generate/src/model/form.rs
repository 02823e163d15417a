//! Determines how much a step must remember of the updates of a function.
//!
//! In: a program and what its rules write. Out: a [`Form`] for each function. If no sequence updates the function, the
//! step is its only unit, and no marks are needed. If no two updates of a step can address the same location, clashes
//! need not be looked for. If a step writes all locations or none, the new values go to a second array.
//!
//! Rules are judged by their shape: a `forall` whose variables are arguments of the location writes each location once.
//! Undecided cases are [`Form::General`], which is always correct.

use std::collections::{BTreeMap, BTreeSet};

use program::{
    Binder, DomainKind, FunctionId, Literal, ProcedureId, Program, Rule, RuleId, Slot, Term, TermId, TermList,
};

use crate::model::nesting::runnable;
use crate::model::writes::{Target, Writes};

/// The form of a function's updates.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Form {
    /// No restriction.
    General,
    /// No sequence and no turbo rule updates it: its updates agree among themselves, or the step fails.
    Unsequenced,
    /// In addition, no two updates of a step give different values to one location.
    Disjoint,
    /// In addition, a step updates all of its locations or none.
    Whole,
}

/// The form of each function.
pub(crate) fn forms(program: &Program, writes: &Writes) -> Vec<Form> {
    let sequenced = sequenced(program, writes);
    let mut walk = Walk { program, writes, done: BTreeMap::new(), open: BTreeSet::new() };
    let shapes = program.main.map(|main| walk.procedure(main)).unwrap_or_default();
    let constant = written_constants(program);
    (0..program.functions.len())
        .map(|index| {
            let function = FunctionId(index as u32);
            if sequenced.contains(&function) {
                return Form::General;
            }
            match shapes.get(&function) {
                Some(Shape::Once(places)) if !places.is_empty() && places.iter().all(|place| place.all) => Form::Whole,
                Some(Shape::Once(_)) => Form::Disjoint,
                _ if constant.get(&function).is_some_and(Option::is_some) => Form::Disjoint,
                _ => Form::Unsequenced,
            }
        })
        .collect()
}

/// The functions updated by rules that are, or may run in, units of their own.
fn sequenced(program: &Program, writes: &Writes) -> BTreeSet<FunctionId> {
    let mut found = BTreeSet::new();
    for index in 0..program.rules.len() {
        let id = RuleId(index as u32);
        match program.rule(id) {
            Rule::Seq(_)
            | Rule::Iterate(_)
            | Rule::While { .. }
            | Rule::RecursiveWhile { .. }
            | Rule::Local { .. }
            | Rule::TurboCall { .. }
            | Rule::Return { .. } => {
                found.extend(writes.of(program, id).into_iter().filter_map(function_of));
                if let Rule::Local { start, len, .. } = program.rule(id) {
                    found.extend(&program.function_lists[*start as usize..(*start + *len) as usize]);
                }
            }
            // A rule value is a unit of its own only if it is a turbo rule.
            Rule::RunValue { arguments, .. } => {
                let fits = |procedure: &program::Procedure| {
                    procedure.turbo && procedure.parameters.len() == arguments.len as usize
                };
                let turbo = runnable(program).filter(|procedure| fits(program.procedure(*procedure)));
                found.extend(turbo.flat_map(|procedure| writes.procedure(procedure)).copied().filter_map(function_of));
            }
            Rule::Skip
            | Rule::Update { .. }
            | Rule::Call { .. }
            | Rule::RunAgent { .. }
            | Rule::Par(_)
            | Rule::If { .. }
            | Rule::Switch { .. }
            | Rule::Let { .. }
            | Rule::Choose { .. }
            | Rule::Forall { .. }
            | Rule::Extend { .. } => {}
        }
    }
    found
}

fn function_of(target: Target) -> Option<FunctionId> {
    match target {
        Target::Function(function) => Some(function),
        Target::Domain(_) => None,
    }
}

/// By function, the constant that all its updates write; `None` if they write different values.
fn written_constants(program: &Program) -> BTreeMap<FunctionId, Option<Literal>> {
    let mut found: BTreeMap<FunctionId, Option<Literal>> = BTreeMap::new();
    for rule in &program.rules {
        let Rule::Update { function, value, .. } = rule else { continue };
        let literal = match program.term(*value) {
            Term::Constant(index) => Some(program.constants[*index as usize].clone()),
            _ => None,
        };
        match found.get_mut(function) {
            Some(known) if *known != literal => *known = None,
            Some(_) => {}
            None => {
                found.insert(*function, literal);
            }
        }
    }
    found
}

/// How often a rule updates a location of a function.
#[derive(Debug, Clone, PartialEq, Eq)]
enum Shape {
    /// Each at most once; describes the arguments.
    Once(Vec<Place>),
    /// Possibly more than once.
    Clash,
}

/// An argument of the updated location.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Place {
    /// The variable of the procedure that it is, if any.
    slot: Option<Slot>,
    /// Whether it ranges over the parameter's whole domain in every state.
    all: bool,
    /// Whether the update is made unconditionally.
    always: bool,
}

type Shapes = BTreeMap<FunctionId, Shape>;

struct Walk<'a> {
    program: &'a Program,
    writes: &'a Writes,
    done: BTreeMap<ProcedureId, Shapes>,
    /// Procedures whose analysis is in progress.
    open: BTreeSet<ProcedureId>,
}

impl Walk<'_> {
    fn procedure(&mut self, id: ProcedureId) -> Shapes {
        if let Some(done) = self.done.get(&id) {
            return done.clone();
        }
        if !self.open.insert(id) {
            return clashes(self.writes.procedure(id).iter().copied());
        }
        let shapes = self.rule(self.program.procedure(id).body);
        self.open.remove(&id);
        self.done.insert(id, shapes.clone());
        shapes
    }

    fn rule(&mut self, id: RuleId) -> Shapes {
        let program = self.program;
        match program.rule(id) {
            Rule::Skip => Shapes::new(),
            Rule::Update { function, arguments, .. } => {
                let places = program
                    .term_list(*arguments)
                    .iter()
                    .map(|argument| Place { slot: self.slot(*argument), all: false, always: true })
                    .collect();
                Shapes::from([(*function, Shape::Once(places))])
            }
            Rule::Call { procedure, arguments } => {
                let shapes = self.procedure(*procedure);
                self.called(shapes, *arguments)
            }
            Rule::Par(rules) => {
                let mut all = Shapes::new();
                for rule in program.rule_list(*rules) {
                    for (function, shape) in self.rule(*rule) {
                        all.entry(function).and_modify(|known| *known = Shape::Clash).or_insert(shape);
                    }
                }
                all
            }
            Rule::If { rules, .. } | Rule::Switch { rules, .. } => self.alternatives(program.rule_list(*rules)),
            Rule::Let { slot, body, .. } => outside(self.rule(*body), &[*slot]),
            Rule::Choose { binders, body, if_none, .. } => {
                let slots: Vec<Slot> = program.binder_list(*binders).iter().map(|binder| binder.slot).collect();
                let rules: Vec<RuleId> = std::iter::once(*body).chain(*if_none).collect();
                outside(self.alternatives(&rules), &slots)
            }
            Rule::Extend { first, count, body, .. } => {
                let slots: Vec<Slot> = (0..*count).map(|offset| Slot(first.0 + offset)).collect();
                let shapes = self.rule(*body);
                outside(shapes, &slots)
            }
            Rule::Forall { binders, condition, body } => {
                let shapes = self.rule(*body);
                let binders = program.binder_list(*binders);
                let free = condition.is_none_or(|condition| is_true(program, condition));
                shapes
                    .into_iter()
                    .map(|(function, shape)| (function, self.for_all(function, shape, binders, free)))
                    .collect()
            }
            Rule::TurboCall { .. }
            | Rule::Return { .. }
            | Rule::RunValue { .. }
            | Rule::RunAgent { .. }
            | Rule::Seq(_)
            | Rule::Iterate(_)
            | Rule::While { .. }
            | Rule::RecursiveWhile { .. }
            | Rule::Local { .. } => clashes(self.writes.of(program, id)),
        }
    }

    /// The shapes of exactly one of several rules.
    fn alternatives(&mut self, rules: &[RuleId]) -> Shapes {
        let mut all: Shapes = Shapes::new();
        for rule in rules {
            for (function, shape) in self.rule(*rule) {
                let shape = undecided(shape);
                all.entry(function).and_modify(|known| *known = either(known, &shape)).or_insert(shape);
            }
        }
        all
    }

    /// A procedure's shapes, as its caller sees them.
    fn called(&self, shapes: Shapes, arguments: TermList) -> Shapes {
        let arguments = self.program.term_list(arguments);
        let mapped = |place: Place| Place {
            slot: place.slot.and_then(|slot| arguments.get(slot.0 as usize)).and_then(|argument| self.slot(*argument)),
            ..place
        };
        each_place(shapes, mapped)
    }

    fn for_all(&self, function: FunctionId, shape: Shape, binders: &[Binder], free: bool) -> Shape {
        let Shape::Once(mut places) = shape else { return Shape::Clash };
        let parameters = &self.program.function(function).parameters;
        for binder in binders {
            let Some(index) = places.iter().position(|place| place.slot == Some(binder.slot)) else {
                return Shape::Clash;
            };
            let range = self.program.term(binder.range);
            // A list may contain an element twice.
            let once = match range {
                Term::Domain(_) => true,
                Term::Range { kind, .. } | Term::Collection { kind, .. } => *kind == program::CollectionKind::Set,
                _ => {
                    matches!(self.program.domain(self.program.term_domain(binder.range)).kind, DomainKind::Powerset(_))
                }
            };
            if !once {
                return Shape::Clash;
            }
            let place = &mut places[index];
            place.all |= free && place.always && matches!(range, Term::Domain(domain) if *domain == parameters[index]);
            place.slot = None;
        }
        if free { Shape::Once(places) } else { undecided(Shape::Once(places)) }
    }

    fn slot(&self, term: TermId) -> Option<Slot> {
        match self.program.term(term) {
            Term::Slot(slot) => Some(*slot),
            _ => None,
        }
    }
}

/// Whether a condition is the constant true.
pub(crate) fn is_true(program: &Program, condition: TermId) -> bool {
    match program.term(condition) {
        Term::Constant(index) => program.constants[*index as usize] == Literal::Boolean(true),
        _ => false,
    }
}

fn clashes(targets: impl IntoIterator<Item = Target>) -> Shapes {
    targets.into_iter().filter_map(function_of).map(|function| (function, Shape::Clash)).collect()
}

fn each_place(shapes: Shapes, change: impl Fn(Place) -> Place) -> Shapes {
    let changed = |shape| match shape {
        Shape::Once(places) => Shape::Once(places.into_iter().map(&change).collect()),
        Shape::Clash => Shape::Clash,
    };
    shapes.into_iter().map(|(function, shape)| (function, changed(shape))).collect()
}

/// The shapes outside the scope of these variables.
fn outside(shapes: Shapes, slots: &[Slot]) -> Shapes {
    each_place(shapes, |place| Place { slot: place.slot.filter(|slot| !slots.contains(slot)), ..place })
}

/// The rule may be left out, so places that do not range over their whole domain yet never count as doing so.
fn undecided(shape: Shape) -> Shape {
    match shape {
        Shape::Once(places) if !places.iter().all(|place| place.all) => {
            Shape::Once(places.into_iter().map(|place| Place { always: false, ..place }).collect())
        }
        shape => shape,
    }
}

/// The shape of one of the two.
fn either(left: &Shape, right: &Shape) -> Shape {
    let (Shape::Once(left), Shape::Once(right)) = (left, right) else { return Shape::Clash };
    let both = |(left, right): (&Place, &Place)| Place {
        slot: left.slot.filter(|slot| right.slot == Some(*slot)),
        all: left.all && right.all,
        always: left.always && right.always,
    };
    Shape::Once(left.iter().zip(right).map(both).collect())
}
