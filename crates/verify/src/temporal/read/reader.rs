//! Reads formulas; the scope around a term tells what its variables stand for.

use std::collections::BTreeMap;
use std::sync::Arc;

use machine::{Closed, Limits, Machine, Value};
use program::{Binder, Builtin, Expression, FunctionId, Program, Quantifier, Slot, TemporalOperator, Term, TermId};
use syntax::{Diagnostic, Span};

use super::fault;
use super::fixed::{elements, is_fixed};
use super::proposition::{Piece, Proposition};
use crate::temporal::formula::{FormulaId, Logic};

/// The stack kept free for one level of recursion, and the size of each extension.
const RED_ZONE: usize = 64 * 1024;
const STACK_PIECE: usize = 1024 * 1024;
/// LIMIT: how deeply functions over formulas may call each other.
const DEPTH: usize = 10_000;

/// What a variable stands for.
#[derive(Debug, Clone)]
enum Bound {
    /// A value that is the same in every state.
    Value(Value),
    /// A formula.
    Formula(FormulaId),
    /// A collection of formulas.
    Formulas(Vec<FormulaId>),
}

/// The scope of a term.
#[derive(Debug, Clone, Default)]
struct Surroundings {
    size: u32,
    bound: BTreeMap<u32, Bound>,
}

/// Reads a program's properties.
pub struct Reader<'p> {
    program: &'p Program,
    machine: Machine,
    propositions: Vec<Proposition>,
    known: BTreeMap<Vec<Piece>, usize>,
    /// For each function, whether its definition contains temporal operators.
    temporal: BTreeMap<FunctionId, bool>,
    faults: Vec<Diagnostic>,
    depth: usize,
}

impl<'p> Reader<'p> {
    /// A reader of a program's properties.
    pub fn new(program: &'p Arc<Program>) -> Reader<'p> {
        let machine = Machine::new(Arc::clone(program), Limits::default());
        let (propositions, known, temporal) = Default::default();
        Reader { program, machine, propositions, known, temporal, faults: Vec::new(), depth: 0 }
    }

    /// Takes the faults found so far.
    pub fn faults(&mut self) -> Vec<Diagnostic> {
        std::mem::take(&mut self.faults)
    }

    /// The propositions.
    pub fn finish(self) -> Vec<Proposition> {
        self.propositions
    }

    /// Reads a property; `None` if it has a fault.
    pub fn read<L: Logic>(&mut self, table: &mut L, property: &Expression) -> Option<FormulaId> {
        let around = Surroundings { size: property.frame, bound: BTreeMap::new() };
        self.formula(table, property.body, &around)
    }

    /// The number of a proposition, the same for terms that are written alike.
    pub fn proposition_of(&mut self, proposition: Proposition) -> usize {
        let next = self.propositions.len();
        let number = *self.known.entry(proposition.pieces(self.program)).or_insert(next);
        if number == next {
            self.propositions.push(proposition);
        }
        number
    }

    fn span(&self, term: TermId) -> Span {
        self.program.term_span(term)
    }

    fn fault<T>(&mut self, fault: Diagnostic) -> Option<T> {
        self.faults.push(fault);
        None
    }

    fn formula<L: Logic>(&mut self, table: &mut L, term: TermId, around: &Surroundings) -> Option<FormulaId> {
        if table.size() > fault::MOST_FORMULAS || self.depth > DEPTH {
            return self.fault(fault::too_large(self.span(term), "parts", fault::MOST_FORMULAS as u64));
        }
        if self.operator_in(term, around).is_none() {
            return self.proposition(table, term, around);
        }
        self.depth += 1;
        let formula = stacker::maybe_grow(RED_ZONE, STACK_PIECE, || self.joined(table, term, around));
        self.depth -= 1;
        formula
    }

    /// A term about runs.
    fn joined<L: Logic>(&mut self, table: &mut L, term: TermId, around: &Surroundings) -> Option<FormulaId> {
        let program = self.program;
        match program.term(term) {
            Term::Builtin { builtin: Builtin::Temporal(operator), arguments } => {
                self.temporal(table, term, *operator, program.term_list(*arguments), around)
            }
            Term::Builtin { builtin, arguments } => {
                let arguments = program.term_list(*arguments);
                let boolean = |term: &TermId| program.term_domain(*term) == model::Domains::BOOLEAN;
                let joins = matches!(
                    builtin,
                    Builtin::Not | Builtin::And | Builtin::Or | Builtin::Xor | Builtin::Implies | Builtin::Iff
                ) || matches!(builtin, Builtin::Eq | Builtin::Neq) && arguments.iter().all(boolean);
                if !joins {
                    return self.misplaced(term, around);
                }
                let parts = self.formulas(table, arguments, around)?;
                Some(match (builtin, &parts[..]) {
                    (Builtin::Not, [p]) => table.not(*p),
                    (Builtin::And, [p, q]) => table.and(*p, *q),
                    (Builtin::Or, [p, q]) => table.or(*p, *q),
                    (Builtin::Implies, [p, q]) => table.implies(*p, *q),
                    (Builtin::Iff | Builtin::Eq, [p, q]) => table.iff(*p, *q),
                    (_, [p, q]) => {
                        let same = table.iff(*p, *q);
                        table.not(same)
                    }
                    _ => unreachable!("the verifier of programs counts arguments"),
                })
            }
            Term::Quantified { quantifier, binders, condition } => {
                let binders = program.binder_list(*binders);
                let mut each = Vec::new();
                self.each(table, binders, *condition, &mut around.clone(), &mut each)?;
                Some(quantified(table, *quantifier, &each))
            }
            Term::If { branches, otherwise: Some(otherwise) } => {
                let mut formula = self.formula(table, *otherwise, around)?;
                for pair in program.term_list(*branches).chunks_exact(2).rev() {
                    let guard = self.formula(table, pair[0], around)?;
                    let then = self.formula(table, pair[1], around)?;
                    let not = table.not(guard);
                    let (yes, no) = (table.and(guard, then), table.and(not, formula));
                    formula = table.or(yes, no);
                }
                Some(formula)
            }
            Term::Let { slot, value, body } => {
                let bound = self.bound(table, *value, around, "a variable")?;
                let mut around = around.clone();
                around.bound.insert(slot.0, bound);
                self.formula(table, *body, &around)
            }
            Term::Define { function, arguments } => {
                let definition = program.function(*function).definition.as_ref()?;
                let mut inside = Surroundings { size: definition.frame, bound: BTreeMap::new() };
                for (slot, argument) in program.term_list(*arguments).iter().enumerate() {
                    inside.bound.insert(slot as u32, self.bound(table, *argument, around, "an argument")?);
                }
                self.formula(table, definition.body, &inside)
            }
            Term::Slot(slot) => match around.bound.get(&slot.0) {
                Some(Bound::Formula(formula)) => Some(*formula),
                _ => self.misplaced(term, around),
            },
            _ => self.misplaced(term, around),
        }
    }

    fn formulas<L: Logic>(&mut self, table: &mut L, terms: &[TermId], around: &Surroundings) -> Option<Vec<FormulaId>> {
        // All are read, so that each reports its fault.
        let read: Vec<Option<FormulaId>> = terms.iter().map(|term| self.formula(table, *term, around)).collect();
        read.into_iter().collect()
    }

    fn temporal<L: Logic>(
        &mut self,
        table: &mut L,
        term: TermId,
        operator: TemporalOperator,
        arguments: &[TermId],
        around: &Surroundings,
    ) -> Option<FormulaId> {
        if operator.is_ctl() != L::BRANCHING {
            return self.fault(fault::mixed(self.span(term), operator.is_ctl()));
        }
        if let (TemporalOperator::ExN | TemporalOperator::AxN, [formula, steps]) = (operator, arguments) {
            let formula = self.formula(table, *formula, around)?;
            if !is_fixed(self.program, *steps) {
                return self.fault(fault::changing(self.span(*steps), "the number of steps"));
            }
            return match self.value(*steps, around)? {
                Value::Integer(steps @ 0..=fault::MOST_STEPS) => table.after_steps(operator, formula, steps as u64),
                _ => self.fault(fault::too_large(self.span(*steps), "steps", fault::MOST_STEPS as u64)),
            };
        }
        let parts = self.formulas(table, arguments, around)?;
        table.operator(operator, &parts)
    }

    /// The meaning of a variable that is bound to a term.
    fn bound<L: Logic>(&mut self, table: &mut L, term: TermId, around: &Surroundings, what: &str) -> Option<Bound> {
        if let Some(formulas) = self.collection(table, term, around) {
            return formulas.map(Bound::Formulas);
        }
        if self.operator_in(term, around).is_none() && is_fixed(self.program, term) {
            return self.value(term, around).map(Bound::Value);
        }
        if self.program.term_domain(term) == model::Domains::BOOLEAN {
            return self.formula(table, term, around).map(Bound::Formula);
        }
        match self.operator_in(term, around) {
            Some(_) => self.misplaced(term, around),
            None => self.fault(fault::changing(self.span(term), what)),
        }
    }

    /// The formulas of a Boolean collection that is written out, or passed on.
    fn collection<L: Logic>(
        &mut self,
        table: &mut L,
        term: TermId,
        around: &Surroundings,
    ) -> Option<Option<Vec<FormulaId>>> {
        match self.program.term(term) {
            Term::Slot(slot) => match around.bound.get(&slot.0) {
                Some(Bound::Formulas(formulas)) => Some(Some(formulas.clone())),
                _ => None,
            },
            Term::Collection { elements, .. } if elements.len > 0 => {
                let elements = self.program.term_list(*elements);
                let boolean = |term: &TermId| self.program.term_domain(*term) == model::Domains::BOOLEAN;
                elements.iter().all(boolean).then(|| self.formulas(table, elements, around))
            }
            _ => None,
        }
    }

    /// The formula for each element that binders range over.
    fn each<L: Logic>(
        &mut self,
        table: &mut L,
        binders: &[Binder],
        condition: Option<TermId>,
        around: &mut Surroundings,
        each: &mut Vec<FormulaId>,
    ) -> Option<()> {
        let Some((binder, rest)) = binders.split_first() else {
            each.push(match condition {
                Some(condition) => self.formula(table, condition, around)?,
                None => table.constant(true),
            });
            return Some(());
        };
        let all: Vec<Bound> = if let Some(formulas) = self.collection(table, binder.range, around) {
            formulas?.into_iter().map(Bound::Formula).collect()
        } else if !is_fixed(self.program, binder.range) {
            return self.fault(fault::changing(self.span(binder.range), "the range"));
        } else {
            let bindings = self.bindings(binder.range, around);
            match elements(&mut self.machine, binder.range, around.size, &bindings) {
                Ok(elements) => elements.into_iter().map(Bound::Value).collect(),
                Err(reason) => return self.fault(fault::not_enumerable(self.span(binder.range), &reason)),
            }
        };
        for bound in all {
            around.bound.insert(binder.slot.0, bound);
            self.each(table, rest, condition, around, each)?;
        }
        around.bound.remove(&binder.slot.0);
        Some(())
    }

    /// A term about one state.
    fn proposition<L: Logic>(&mut self, table: &mut L, term: TermId, around: &Surroundings) -> Option<FormulaId> {
        if is_fixed(self.program, term)
            && let Some(Value::Boolean(truth)) = self.value_of(term, around)
        {
            return Some(table.constant(truth));
        }
        let proposition = Proposition { term, frame: around.size, bindings: self.bindings(term, around) };
        let number = self.proposition_of(proposition);
        if number >= fault::MOST_PROPOSITIONS {
            return self.fault(fault::too_large(self.span(term), "propositions", fault::MOST_PROPOSITIONS as u64));
        }
        Some(table.proposition(number as u32))
    }

    /// The values of a term's free variables.
    fn bindings(&self, term: TermId, around: &Surroundings) -> Vec<(Slot, Value)> {
        let mut used = BTreeMap::new();
        let mut open = vec![term];
        while let Some(id) = open.pop() {
            if let Term::Slot(slot) = self.program.term(id)
                && let Some(Bound::Value(value)) = around.bound.get(&slot.0)
            {
                used.insert(*slot, value.clone());
            }
            self.program.each_child_of_term(id, &mut |child| open.push(child));
        }
        used.into_iter().collect()
    }

    fn value_of(&mut self, term: TermId, around: &Surroundings) -> Option<Value> {
        let bindings = self.bindings(term, around);
        self.machine.evaluate_with(term, around.size, &bindings, &mut Closed).ok()
    }

    /// The value of a fixed term.
    fn value(&mut self, term: TermId, around: &Surroundings) -> Option<Value> {
        let bindings = self.bindings(term, around);
        match self.machine.evaluate_with(term, around.size, &bindings, &mut Closed) {
            Ok(value) => Some(value),
            Err(fault) => {
                let reason = fault.show(self.program).to_string();
                self.fault(fault::not_enumerable(self.span(term), &reason))
            }
        }
    }

    /// The first operator (or variable for a formula) that makes a term one about runs.
    fn operator_in(&mut self, term: TermId, around: &Surroundings) -> Option<TermId> {
        let program = self.program;
        let mut open = vec![term];
        while let Some(id) = open.pop() {
            let speaks = match program.term(id) {
                Term::Builtin { builtin: Builtin::Temporal(_), .. } => true,
                Term::Define { function, .. } => self.defines_formula(*function),
                Term::Slot(slot) => {
                    matches!(around.bound.get(&slot.0), Some(Bound::Formula(_) | Bound::Formulas(_)))
                }
                _ => false,
            };
            if speaks {
                return Some(id);
            }
            program.each_child_of_term(id, &mut |child| open.push(child));
        }
        None
    }

    fn defines_formula(&mut self, function: FunctionId) -> bool {
        if let Some(known) = self.temporal.get(&function) {
            return *known;
        }
        let mut entered = vec![function];
        let mut open: Vec<TermId> = self.program.function(function).definition.iter().map(|d| d.body).collect();
        let mut speaks = false;
        while let Some(id) = open.pop() {
            match self.program.term(id) {
                Term::Builtin { builtin: Builtin::Temporal(_), .. } => speaks = true,
                Term::Define { function, .. } if !entered.contains(function) => {
                    entered.push(*function);
                    open.extend(self.program.function(*function).definition.iter().map(|definition| definition.body));
                }
                _ => {}
            }
            self.program.each_child_of_term(id, &mut |child| open.push(child));
        }
        self.temporal.insert(function, speaks);
        speaks
    }

    fn misplaced<T>(&mut self, term: TermId, around: &Surroundings) -> Option<T> {
        let operator = self.operator_in(term, around).unwrap_or(term);
        self.fault(fault::in_term(self.span(term), self.span(operator)))
    }
}

fn quantified<L: Logic>(table: &mut L, quantifier: Quantifier, each: &[FormulaId]) -> FormulaId {
    let (mut none, mut some, mut one) = (table.constant(true), table.constant(false), table.constant(false));
    let mut all = none;
    for formula in each {
        match quantifier {
            Quantifier::Forall => all = table.and(all, *formula),
            Quantifier::Exists => some = table.or(some, *formula),
            Quantifier::ExistsUnique => {
                let not = table.not(*formula);
                let (still, now) = (table.and(one, not), table.and(none, *formula));
                one = table.or(still, now);
                none = table.and(none, not);
            }
        }
    }
    match quantifier {
        Quantifier::Forall => all,
        Quantifier::Exists => some,
        Quantifier::ExistsUnique => one,
    }
}
