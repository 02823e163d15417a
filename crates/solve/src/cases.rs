//! Going through cases: locations get values, one at a time, as the condition turns out to need them.
//!
//! In: a formula. Out: a state in which it holds, or that there is none, or that going through cases does not tell. A
//! location over a finite domain has its values; an open carrier gets as many nameless elements as there are terms over it,
//! which is enough, as elements can only be compared. A number that is only compared with constants has one value for each
//! gap between these; other numbers get the same few values, so that a state may be found, but none found says nothing.

use std::collections::BTreeMap;

use crate::formula::{Arithmetic, Formula, Order, Sort, SymbolId, Term, Value};

/// LIMIT: so many cases are gone through.
pub(crate) const MAX_CASES: usize = 200_000;

/// What going through cases gives.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Cases {
    /// A state, location by location.
    Found(State),
    /// There is none.
    None,
    /// Not told.
    Open(Reason),
}

/// Why cases do not tell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Reason {
    /// There are too many.
    Many,
    /// Some numbers have too many values.
    Numbers,
}

/// The values of some locations.
pub(crate) type State = Vec<((SymbolId, Vec<Value>), Value)>;

/// Looks for a state.
pub(crate) fn cases(formula: &Formula) -> Cases {
    let numbers = Numbers::of(formula);
    let mut search = Search { formula, numbers: &numbers, state: Vec::new(), budget: MAX_CASES };
    match search.run() {
        Some(true) => Cases::Found(search.state),
        Some(false) if numbers.complete => Cases::None,
        Some(false) => Cases::Open(Reason::Numbers),
        None => Cases::Open(Reason::Many),
    }
}

/// Whether the condition holds in a state; none where the state leaves it open.
pub(crate) fn holds(formula: &Formula, state: &State) -> Option<bool> {
    match evaluate(formula, state, &formula.condition) {
        Outcome::Value(Value::Boolean(truth)) => Some(truth),
        _ => None,
    }
}

/// Values that numbers are tried with.
struct Numbers {
    integers: Vec<Value>,
    reals: Vec<Value>,
    /// They stand for all numbers.
    complete: bool,
    /// Nameless elements of each carrier.
    nameless: Vec<usize>,
}

impl Numbers {
    fn of(formula: &Formula) -> Self {
        let (mut whole, mut broken, mut complete) = (vec![0_i64], vec![0.0_f64], true);
        let mut nameless: BTreeMap<usize, Vec<&Term>> = BTreeMap::new();
        let unbounded = |term: &Term| match term {
            Term::Apply(id, _) => {
                let symbol = formula.symbol(*id);
                symbol.values.is_none() && matches!(symbol.sort, Sort::Integer | Sort::Real)
            }
            _ => false,
        };
        formula.condition.walk(&mut |term| {
            match term {
                Term::Constant(Value::Integer(number)) => {
                    whole.extend([number.saturating_sub(1), *number, number.saturating_add(1)]);
                }
                Term::Constant(Value::Real(number)) => broken.push(*number),
                Term::Apply(id, _) => {
                    if let Sort::Carrier(carrier) = formula.symbol(*id).sort {
                        let known = nameless.entry(carrier).or_default();
                        if !known.contains(&term) {
                            known.push(term);
                        }
                    }
                }
                _ => {}
            }
            let compares = matches!(term, Term::Equal(..) | Term::Compare(..));
            let children = term.children();
            let constant = children.iter().any(|child| matches!(child, Term::Constant(_)));
            complete &= !children.iter().any(|child| unbounded(child)) || compares && constant;
        });
        whole.sort_unstable();
        whole.dedup();
        broken.sort_by(f64::total_cmp);
        broken.dedup();
        let between: Vec<f64> = broken.windows(2).map(|pair| pair[0] / 2.0 + pair[1] / 2.0).collect();
        let ends = [broken[0] - 1.0, broken[broken.len() - 1] + 1.0];
        broken.extend(between.into_iter().chain(ends));
        broken.sort_by(f64::total_cmp);
        // What people would think of first comes first.
        whole.sort_by_key(|number| (*number < 0, number.unsigned_abs()));
        broken
            .sort_by(|a, b| (*a < 0.0, a.abs()).partial_cmp(&(*b < 0.0, b.abs())).unwrap_or(std::cmp::Ordering::Equal));
        Numbers {
            integers: whole.into_iter().map(Value::Integer).collect(),
            reals: broken.into_iter().map(Value::Real).collect(),
            complete,
            nameless: (0..formula.carriers.len()).map(|carrier| nameless.get(&carrier).map_or(0, Vec::len)).collect(),
        }
    }

    fn values(&self, formula: &Formula, id: SymbolId) -> Vec<Value> {
        let symbol = formula.symbol(id);
        if let Some(values) = &symbol.values {
            return values.clone();
        }
        match symbol.sort {
            Sort::Boolean => vec![Value::Boolean(true), Value::Boolean(false)],
            Sort::Integer => self.integers.clone(),
            Sort::Real => self.reals.clone(),
            Sort::Carrier(carrier) => {
                let known = &formula.carriers[carrier];
                let count = known.elements.len() + if known.open { self.nameless[carrier].max(1) } else { 0 };
                (0..count).map(|index| Value::Element(carrier, index)).collect()
            }
        }
    }
}

struct Search<'f> {
    formula: &'f Formula,
    numbers: &'f Numbers,
    state: State,
    budget: usize,
}

impl Search<'_> {
    /// Whether the state can be completed; none when there are too many cases.
    fn run(&mut self) -> Option<bool> {
        self.budget = self.budget.checked_sub(1)?;
        match evaluate(self.formula, &self.state, &self.formula.condition) {
            Outcome::Value(value) => Some(value == Value::Boolean(true)),
            Outcome::Trouble => Some(false),
            Outcome::Needs(id, arguments) => {
                for value in self.numbers.values(self.formula, id) {
                    self.state.push(((id, arguments.clone()), value));
                    if self.run()? {
                        return Some(true);
                    }
                    self.state.pop();
                }
                Some(false)
            }
        }
    }
}

enum Outcome {
    Value(Value),
    /// This location must have a value first.
    Needs(SymbolId, Vec<Value>),
    /// No number results.
    Trouble,
}

fn evaluate(formula: &Formula, state: &State, term: &Term) -> Outcome {
    let truth = |truth: bool| Outcome::Value(Value::Boolean(truth));
    macro_rules! value {
        ($term:expr) => {
            match evaluate(formula, state, $term) {
                Outcome::Value(value) => value,
                other => return other,
            }
        };
    }
    match term {
        Term::Constant(value) => Outcome::Value(*value),
        Term::Apply(id, arguments) => {
            let mut values = Vec::with_capacity(arguments.len());
            for argument in arguments {
                values.push(value!(argument));
            }
            match state.iter().find(|((known, at), _)| known == id && *at == values) {
                Some((_, value)) => Outcome::Value(*value),
                None => Outcome::Needs(*id, values),
            }
        }
        Term::Not(inner) => truth(value!(inner) == Value::Boolean(false)),
        Term::And(terms) => junction(formula, state, terms, false),
        Term::Or(terms) => junction(formula, state, terms, true),
        Term::Equal(a, b) => truth(value!(a) == value!(b)),
        Term::Compare(order, a, b) => match (value!(a).partial_cmp(&value!(b)), order) {
            (Some(ordering), Order::Less) => truth(ordering.is_lt()),
            (Some(ordering), Order::LessEqual) => truth(ordering.is_le()),
            (None, _) => Outcome::Trouble,
        },
        Term::If(condition, yes, no) => {
            evaluate(formula, state, if value!(condition) == Value::Boolean(true) { yes } else { no })
        }
        Term::Compute(operation, a, b) => {
            compute(*operation, value!(a), value!(b)).map_or(Outcome::Trouble, Outcome::Value)
        }
        Term::ToReal(inner) => match value!(inner) {
            Value::Integer(number) => Outcome::Value(Value::Real(number as f64)),
            _ => Outcome::Trouble,
        },
        Term::Floor(inner) => match value!(inner) {
            Value::Real(number) if number.abs() < 9.2e18 => Outcome::Value(Value::Integer(number.floor() as i64)),
            _ => Outcome::Trouble,
        },
    }
}

/// One that decides is enough; trouble is for a condition elsewhere to exclude, so it decides nothing.
fn junction(formula: &Formula, state: &State, terms: &[Term], deciding: bool) -> Outcome {
    let mut open = None;
    for term in terms {
        match evaluate(formula, state, term) {
            Outcome::Value(value) if value == Value::Boolean(deciding) => return Outcome::Value(value),
            Outcome::Value(_) => {}
            other if matches!(open, None | Some(Outcome::Trouble)) => open = Some(other),
            _ => {}
        }
    }
    open.unwrap_or(Outcome::Value(Value::Boolean(!deciding)))
}

fn compute(operation: Arithmetic, a: Value, b: Value) -> Option<Value> {
    match (a, b) {
        (Value::Integer(a), Value::Integer(b)) => Some(Value::Integer(match operation {
            Arithmetic::Add => a.checked_add(b)?,
            Arithmetic::Subtract => a.checked_sub(b)?,
            Arithmetic::Multiply => a.checked_mul(b)?,
            Arithmetic::Quotient => a.checked_div(b)?,
            Arithmetic::Remainder if b == 0 => return None,
            Arithmetic::Remainder => a.wrapping_rem(b),
            Arithmetic::Divide => return None,
        })),
        (Value::Real(a), Value::Real(b)) => {
            let result = match operation {
                Arithmetic::Add => a + b,
                Arithmetic::Subtract => a - b,
                Arithmetic::Multiply => a * b,
                Arithmetic::Divide => a / b,
                Arithmetic::Quotient | Arithmetic::Remainder => return None,
            };
            result.is_finite().then_some(Value::Real(result))
        }
        _ => None,
    }
}
