//! What a solver prints → an answer: `sat` with values, `unsat`, or anything else.
//!
//! In: the solver's output. Out: [`Answer`]; values that are no constants of the formula (algebraic numbers, say) are left out.

use std::collections::BTreeMap;

use crate::cases::State;
use crate::formula::{Formula, Sort, Term, Value};
use crate::script::Asked;

/// A solver's answer.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Answer {
    /// The formula holds in this state, of which some values may be missing.
    Sat(State),
    /// It holds in none.
    Unsat,
    /// Something else; the first line says what.
    Other(String),
}

/// An S-expression.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Expression {
    Word(String),
    List(Vec<Expression>),
}

/// Reads the output of a script that asked for these terms.
pub(crate) fn answer(formula: &Formula, asked: &[Asked], output: &str) -> Answer {
    let first = output.lines().map(str::trim).find(|line| !line.is_empty()).unwrap_or("nothing");
    match first {
        "unsat" => return Answer::Unsat,
        "sat" => {}
        other => return Answer::Other(other.chars().take(120).collect()),
    }
    let rest = output.split_once("sat").map_or("", |(_, rest)| rest);
    let values = match expressions(rest).into_iter().next() {
        Some(Expression::List(pairs)) => pairs,
        _ => Vec::new(),
    };
    let second = |pair: &Expression| match pair {
        Expression::List(both) => both.get(1).cloned(),
        Expression::Word(_) => None,
    };
    let values: Vec<Option<Expression>> = values.iter().map(second).collect();
    let mut reader = Reader { formula, named: BTreeMap::new() };
    let mut known: Vec<(&Term, Value)> = Vec::new();
    for (asked, value) in asked.iter().zip(&values) {
        let Some(value) = value else { continue };
        match asked {
            Asked::Element(carrier, index) => _ = reader.named.insert(spelled(value), (*carrier, *index)),
            Asked::Term(term) => known.extend(reader.value(formula.sort(term), value).map(|value| (term, value))),
        }
    }
    let mut state = State::new();
    for (term, value) in &known {
        let Term::Apply(id, arguments) = term else { continue };
        let constant = |term: &Term| match term {
            Term::Constant(value) => Some(*value),
            term => known.iter().find(|(known, _)| *known == term).map(|(_, value)| *value),
        };
        let arguments: Option<Vec<Value>> = arguments.iter().map(constant).collect();
        if let Some(arguments) = arguments
            && !state.iter().any(|(location, _)| *location == (*id, arguments.clone()))
        {
            state.push(((*id, arguments), *value));
        }
    }
    Answer::Sat(state)
}

struct Reader<'f> {
    formula: &'f Formula,
    /// The elements of open carriers by what the solver calls them.
    named: BTreeMap<String, (usize, usize)>,
}

impl Reader<'_> {
    fn value(&mut self, sort: Sort, value: &Expression) -> Option<Value> {
        match sort {
            Sort::Boolean => spelled(value).parse().ok().map(Value::Boolean),
            Sort::Integer => integer(value).and_then(|number| i64::try_from(number).ok()).map(Value::Integer),
            Sort::Real => real(value).map(Value::Real),
            Sort::Carrier(carrier) => Some(self.element(carrier, &spelled(value))),
        }
    }

    fn element(&mut self, carrier: usize, name: &str) -> Value {
        let known = &self.formula.carriers[carrier];
        if !known.open {
            // `|NAME carrier.index|`
            let number = name.trim_matches('|').rsplit_once('.').and_then(|(_, index)| index.parse().ok());
            return Value::Element(carrier, number.unwrap_or(0));
        }
        let nameless =
            self.named.values().filter(|(of, index)| *of == carrier && *index >= known.elements.len()).count();
        let next = (carrier, known.elements.len() + nameless);
        let (carrier, index) = *self.named.entry(name.to_string()).or_insert(next);
        Value::Element(carrier, index)
    }
}

pub(crate) fn spelled(expression: &Expression) -> String {
    match expression {
        Expression::Word(word) => word.clone(),
        Expression::List(inner) => format!("({})", inner.iter().map(spelled).collect::<Vec<_>>().join(" ")),
    }
}

/// `12`, `(- 12)`
pub(crate) fn integer(expression: &Expression) -> Option<i128> {
    match expression {
        Expression::Word(word) => word.parse().ok(),
        Expression::List(inner) => match &inner[..] {
            [Expression::Word(sign), number] if sign == "-" => integer(number).map(|number| -number),
            _ => None,
        },
    }
}

/// `1.5`, `(- 1.5)`, `(/ 1.0 3.0)`
pub(crate) fn real(expression: &Expression) -> Option<f64> {
    match expression {
        Expression::Word(word) => word.parse().ok(),
        Expression::List(inner) => match &inner[..] {
            [Expression::Word(sign), number] if sign == "-" => real(number).map(|number| -number),
            [Expression::Word(sign), a, b] if sign == "/" => Some(real(a)? / real(b)?),
            _ => None,
        },
    }
}

/// The expressions of a text; brackets that do not match are let go.
pub(crate) fn expressions(text: &str) -> Vec<Expression> {
    let mut open: Vec<Vec<Expression>> = vec![Vec::new()];
    let mut letters = text.char_indices().peekable();
    let put = |open: &mut Vec<Vec<Expression>>, expression| {
        if let Some(list) = open.last_mut() {
            list.push(expression);
        }
    };
    while let Some((start, letter)) = letters.next() {
        match letter {
            '(' => open.push(Vec::new()),
            ')' => {
                let list = open.pop().unwrap_or_default();
                if open.is_empty() {
                    open.push(Vec::new());
                }
                put(&mut open, Expression::List(list));
            }
            '|' => {
                let end = letters.by_ref().find(|(_, letter)| *letter == '|').map_or(text.len(), |(at, _)| at + 1);
                put(&mut open, Expression::Word(text[start..end].to_string()));
            }
            letter if letter.is_whitespace() => {}
            _ => {
                let mut end = start + letter.len_utf8();
                while let Some((at, letter)) = letters.peek() {
                    if letter.is_whitespace() || matches!(letter, '(' | ')') {
                        break;
                    }
                    end = at + letter.len_utf8();
                    letters.next();
                }
                put(&mut open, Expression::Word(text[start..end].to_string()));
            }
        }
    }
    open.swap_remove(0)
}
