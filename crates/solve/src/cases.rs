//! Case enumeration: assigns values to locations, one at a time, as the condition turns out to need them.
//!
//! In: a question. Out: a state in which the condition holds, that there is none, or that enumeration cannot decide. A
//! location over a finite domain takes all its values. An open domain gets as many unnamed elements as there are terms
//! over it; that suffices, since elements can only be compared. A number that is only compared with constants takes one
//! value in each gap between these. Other numbers take the same few values, then some near the numbers in the
//! condition. So a state may be found, but finding none proves nothing.

use std::collections::{BTreeMap, BTreeSet};

use program::DomainId;

use crate::question::Question;
use crate::session::Constant;
use crate::shared::{Bounds, Node, Op, VariableId};
use crate::symbol::Shape;

/// LIMIT: the most cases that are tried.
pub(crate) const MAX_CASES: usize = 200_000;

/// The result of enumeration.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Cases {
    /// A state, location by location.
    Found(State),
    /// There is no such state.
    None,
    /// Undecided.
    Open(Reason),
}

/// Why enumeration cannot decide.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Reason {
    /// There are too many.
    Many,
    /// Some numbers have too many values.
    Numbers,
}

/// The values of some locations.
pub(crate) type State = Vec<((VariableId, Vec<Constant>), Constant)>;

/// Enumerates states.
pub(crate) fn cases(question: &Question) -> Cases {
    let mut numbers = Numbers::of(question);
    match searched(question, &numbers) {
        Cases::None if !numbers.complete => {}
        other => return other,
    }
    numbers.add_near(question);
    match searched(question, &numbers) {
        Cases::Found(state) => Cases::Found(state),
        Cases::None | Cases::Open(_) => Cases::Open(Reason::Numbers),
    }
}

fn searched(question: &Question, numbers: &Numbers) -> Cases {
    let mut search = Search { question, numbers, state: Vec::new(), budget: MAX_CASES };
    match search.run() {
        Some(true) => Cases::Found(search.state),
        Some(false) => Cases::None,
        None => Cases::Open(Reason::Many),
    }
}

/// Whether the condition holds in a state; `None` if the state does not determine it.
pub(crate) fn holds(question: &Question, state: &State) -> Option<bool> {
    value_in(question, state, question.condition).map(|value| value == Constant::Boolean(true))
}

/// The value of a term in a state; `None` if the state does not determine it.
pub(crate) fn value_in(question: &Question, state: &State, node: Node) -> Option<Constant> {
    match Evaluation::of(question, state).evaluate(node) {
        Outcome::Value(value) => Some(value),
        Outcome::Needs(_) | Outcome::Trouble => None,
    }
}

/// The values to try for numbers.
struct Numbers {
    integers: Vec<i128>,
    reals: Vec<f64>,
    /// Whether they represent all numbers.
    complete: bool,
    /// Unnamed elements of each domain.
    nameless: BTreeMap<DomainId, i128>,
}

impl Numbers {
    fn of(question: &Question) -> Self {
        let (terms, parts) = (&question.terms, question.terms.parts([question.condition]));
        let numbers = numbers(question, &parts);
        let (mut whole, mut broken, mut complete) = (vec![-1_i128, 0, 1], vec![0.0_f64], true);
        let mut nameless = BTreeMap::new();
        let unbounded = |node: Node| match question.unknown(node) {
            Some(unknown) => unknown.values.is_none() && matches!(unknown.sort.0, Shape::Integer | Shape::Real),
            None => false,
        };
        let mut constant = |node: Node| match terms.constant(node).filter(|_| numbers.contains(&node)) {
            Some(Constant::Integer(number)) => {
                whole.extend([number.saturating_sub(1), number, number.saturating_add(1)])
            }
            Some(Constant::Real(number)) => broken.push(number),
            Some(Constant::Boolean(_)) | None => {}
        };
        for node in parts {
            let mut children = Vec::new();
            terms.each_operand(node, &mut |child| children.push(child));
            constant(node);
            if let Some((Shape::Element(_) | Shape::Coded, domain)) = question.unknown(node).map(|one| one.sort) {
                *nameless.entry(domain).or_insert(0) += 1;
            }
            let compares = matches!(terms.op(node), Op::Equal(..) | Op::Less(..));
            let known = children.iter().any(|child| terms.constant(*child).is_some());
            complete &= !children.iter().any(|child| unbounded(*child)) || compares && known;
        }
        let mut all = Numbers { integers: whole, reals: broken, complete, nameless };
        all.arrange();
        all
    }

    /// Adds numbers near those that the condition contained before it was simplified.
    fn add_near(&mut self, question: &Question) {
        for constant in question.terms.constants() {
            match constant {
                Constant::Integer(number) => {
                    let near = [number.saturating_sub(1), number, number.saturating_add(1), number.saturating_neg()];
                    self.integers.extend(near);
                }
                Constant::Real(number) => self.reals.extend([number, -number]),
                Constant::Boolean(_) => {}
            }
        }
        self.arrange();
    }

    /// Adds real numbers between the present ones, and moves familiar values to the front.
    fn arrange(&mut self) {
        let Numbers { integers: whole, reals: broken, .. } = self;
        whole.sort_unstable();
        whole.dedup();
        broken.sort_by(f64::total_cmp);
        broken.dedup();
        let between: Vec<f64> = broken.windows(2).map(|pair| pair[0] / 2.0 + pair[1] / 2.0).collect();
        let ends = [broken[0] - 1.0, broken[broken.len() - 1] + 1.0];
        broken.extend(between.into_iter().chain(ends));
        broken.sort_by(f64::total_cmp);
        whole.sort_by_key(|number| (*number < 0, number.unsigned_abs()));
        broken
            .sort_by(|a, b| (*a < 0.0, a.abs()).partial_cmp(&(*b < 0.0, b.abs())).unwrap_or(std::cmp::Ordering::Equal));
    }

    fn values(&self, question: &Question, node: Node) -> Vec<Constant> {
        let Some(unknown) = question.unknown(node) else { return Vec::new() };
        if let Some(values) = &unknown.values {
            return values.clone();
        }
        match unknown.sort {
            (Shape::Boolean, _) => vec![Constant::Boolean(true), Constant::Boolean(false)],
            (Shape::Integer, _) => {
                let bounds = question.terms.bounds(node);
                self.integers.iter().filter(|number| within(**number, bounds)).copied().map(Constant::Integer).collect()
            }
            (Shape::Real, _) => self.reals.iter().copied().map(Constant::Real).collect(),
            (Shape::Enum(_) | Shape::Element(_) | Shape::Coded, domain) => {
                let (named, first) = question.named(unknown.sort);
                let count = self.nameless.get(&domain).copied().unwrap_or(0).max(1);
                named.into_iter().chain(first..first + count).map(Constant::Integer).collect()
            }
        }
    }
}

fn within(number: i128, (low, high): Bounds) -> bool {
    low.is_none_or(|low| low <= number) && high.is_none_or(|high| number <= high)
}

fn is_numeric(shape: Shape) -> bool {
    matches!(shape, Shape::Integer | Shape::Real)
}

/// The terms that are numbers of the model; elements are encoded as numbers, too, but do not count.
fn numbers(question: &Question, parts: &[Node]) -> BTreeSet<Node> {
    let mut found: BTreeSet<Node> = BTreeSet::new();
    let is_location = |node: &Node| question.unknown(*node).is_some_and(|one| is_numeric(one.sort.0));
    // First from operands to terms, then from terms to operands.
    for node in parts {
        let numeric = match question.terms.op(*node) {
            Op::Variable(_) | Op::Apply(..) => is_location(node),
            Op::If(_, yes, no) => found.contains(yes) || found.contains(no),
            Op::Add(..)
            | Op::Subtract(..)
            | Op::Multiply(..)
            | Op::Quotient(..)
            | Op::Remainder(..)
            | Op::Divide(..)
            | Op::ToReal(_)
            | Op::Floor(_)
            | Op::Real(_) => true,
            Op::Boolean(_) | Op::Integer(_) | Op::Not(_) | Op::And(_) | Op::Or(_) | Op::Equal(..) | Op::Less(..) => {
                false
            }
        };
        found.extend(numeric.then_some(*node));
    }
    for node in parts.iter().rev() {
        match question.terms.op(*node) {
            Op::Equal(a, b) if found.contains(a) || found.contains(b) => found.extend([*a, *b]),
            Op::If(_, yes, no) if found.contains(node) => found.extend([*yes, *no]),
            Op::Less(a, b)
            | Op::Add(a, b)
            | Op::Subtract(a, b)
            | Op::Multiply(a, b)
            | Op::Quotient(a, b)
            | Op::Remainder(a, b)
            | Op::Divide(a, b) => found.extend([*a, *b]),
            Op::ToReal(a) | Op::Floor(a) => _ = found.insert(*a),
            Op::Apply(_, arguments) => {
                let sorts = question.unknown(*node).map_or(&[][..], |unknown| &unknown.parameters);
                let numeric = arguments.iter().zip(sorts).filter(|(_, (shape, _))| is_numeric(*shape));
                found.extend(numeric.map(|(argument, _)| *argument));
            }
            Op::Boolean(_)
            | Op::Integer(_)
            | Op::Real(_)
            | Op::Variable(_)
            | Op::Not(_)
            | Op::And(_)
            | Op::Or(_)
            | Op::Equal(..)
            | Op::If(..) => {}
        }
    }
    found
}

struct Search<'q> {
    question: &'q Question,
    numbers: &'q Numbers,
    state: State,
    budget: usize,
}

impl Search<'_> {
    /// Whether the state can be completed; `None` if there are too many cases.
    fn run(&mut self) -> Option<bool> {
        self.budget = self.budget.checked_sub(1)?;
        let mut evaluation = Evaluation::of(self.question, &self.state);
        let location = match evaluation.evaluate(self.question.condition) {
            Outcome::Value(value) => return Some(value == Constant::Boolean(true)),
            Outcome::Trouble => return Some(false),
            Outcome::Needs(location) => location,
        };
        let Some((id, arguments)) = self.question.location(location) else { return Some(false) };
        let Ok(arguments) = evaluation.evaluate_all(arguments) else { return Some(false) };
        for value in self.numbers.values(self.question, location) {
            self.state.push(((id, arguments.clone()), value));
            if stacker::maybe_grow(64 << 10, 1 << 20, || self.run())? {
                return Some(true);
            }
            self.state.pop();
        }
        Some(false)
    }
}

#[derive(Clone, Copy)]
enum Outcome {
    Value(Constant),
    /// This location needs a value first; its arguments have values.
    Needs(Node),
    /// The operation has no result.
    Trouble,
}

/// Evaluates terms in a state, each once.
struct Evaluation<'q> {
    question: &'q Question,
    state: &'q State,
    known: BTreeMap<Node, Outcome>,
}

impl<'q> Evaluation<'q> {
    fn of(question: &'q Question, state: &'q State) -> Self {
        Evaluation { question, state, known: BTreeMap::new() }
    }

    fn evaluate(&mut self, node: Node) -> Outcome {
        if let Some(outcome) = self.known.get(&node) {
            return *outcome;
        }
        let outcome = stacker::maybe_grow(64 << 10, 1 << 20, || self.evaluate_here(node));
        self.known.insert(node, outcome);
        outcome
    }

    /// The values of all terms, or the outcome of the first that has none.
    fn evaluate_all(&mut self, nodes: &[Node]) -> Result<Vec<Constant>, Outcome> {
        let value = |node: &Node| match self.evaluate(*node) {
            Outcome::Value(value) => Ok(value),
            other => Err(other),
        };
        nodes.iter().map(value).collect()
    }

    fn evaluate_here(&mut self, node: Node) -> Outcome {
        let question = self.question;
        match question.terms.op(node) {
            Op::Variable(_) | Op::Apply(..) => {
                let Some((id, arguments)) = question.location(node) else { return Outcome::Trouble };
                let arguments = match self.evaluate_all(arguments) {
                    Ok(arguments) => arguments,
                    Err(other) => return other,
                };
                let found = self.state.iter().find(|((known, at), _)| *known == id && *at == arguments);
                found.map_or(Outcome::Needs(node), |(_, value)| Outcome::Value(*value))
            }
            Op::And(terms) => self.junction(terms, false),
            Op::Or(terms) => self.junction(terms, true),
            Op::If(condition, yes, no) => match self.evaluate(*condition) {
                Outcome::Value(Constant::Boolean(true)) => self.evaluate(*yes),
                Outcome::Value(_) => self.evaluate(*no),
                other => other,
            },
            Op::Boolean(_)
            | Op::Integer(_)
            | Op::Real(_)
            | Op::Not(_)
            | Op::Equal(..)
            | Op::Less(..)
            | Op::Add(..)
            | Op::Subtract(..)
            | Op::Multiply(..)
            | Op::Quotient(..)
            | Op::Remainder(..)
            | Op::Divide(..)
            | Op::ToReal(_)
            | Op::Floor(_) => {
                let mut operands = Vec::new();
                question.terms.each_operand(node, &mut |operand| operands.push(operand));
                let values = match self.evaluate_all(&operands) {
                    Ok(values) => values,
                    Err(other) => return other,
                };
                let of = |node| operands.iter().position(|operand| *operand == node).map(|index| values[index]);
                match question.terms.value_by(node, &of) {
                    Some(Constant::Real(number)) if !number.is_finite() => Outcome::Trouble,
                    Some(value) => Outcome::Value(value),
                    None => Outcome::Trouble,
                }
            }
        }
    }

    /// One deciding operand is enough. Trouble decides nothing, since another part of the condition must exclude it.
    fn junction(&mut self, terms: &[Node], deciding: bool) -> Outcome {
        let mut open = None;
        for term in terms {
            match self.evaluate(*term) {
                Outcome::Value(value) if value == Constant::Boolean(deciding) => return Outcome::Value(value),
                Outcome::Value(_) => {}
                other if matches!(open, None | Some(Outcome::Trouble)) => open = Some(other),
                _ => {}
            }
        }
        open.unwrap_or(Outcome::Value(Constant::Boolean(!deciding)))
    }
}
