//! What a solver prints → an answer: `sat` with values, `unsat`, or anything else.
//!
//! In: the solver's output. Out: [`Answer`]; values that are no constants of ours (algebraic numbers, say) are left out.

use std::collections::BTreeMap;

use program::DomainId;

use crate::cases::{State, value_in};
use crate::question::Question;
use crate::session::{Constant, constants};
use crate::shared::Kind;
use crate::symbol::Shape;

/// A solver's answer.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Answer {
    /// The condition holds in this state, of which some values may be missing.
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

/// Reads the output of the script of a question.
pub(crate) fn answer(question: &Question, output: &str) -> Answer {
    let first = output.lines().map(str::trim).find(|line| !line.is_empty()).unwrap_or("nothing");
    match first {
        "unsat" => return Answer::Unsat,
        "sat" => {}
        other => return Answer::Other(other.chars().take(120).collect()),
    }
    let rest = output.split_once("sat").map_or("", |(_, rest)| rest);
    let kinds: Vec<Kind> = question.locations.iter().map(|location| question.terms.kind(*location)).collect();
    let mut nameless: BTreeMap<(DomainId, i128), i128> = BTreeMap::new();
    let mut state = State::new();
    for (location, value) in question.locations.iter().zip(constants(rest, &kinds)) {
        let (Some(value), Some((id, arguments))) = (value, question.location(*location)) else { continue };
        let Some(unknown) = question.unknown(*location) else { continue };
        let value = match (value, unknown.sort) {
            // The solver has its own numbers for elements without names.
            (Constant::Integer(number), sort @ (Shape::Element(_) | Shape::Coded, domain)) => {
                let first = question.named(sort).1;
                let next = first + nameless.keys().filter(|(of, _)| *of == domain).count() as i128;
                Constant::Integer(match number >= first {
                    true => *nameless.entry((domain, number)).or_insert(next),
                    false => number,
                })
            }
            (Constant::Integer(number), _) if i64::try_from(number).is_err() => continue,
            (value, _) => value,
        };
        let arguments: Option<Vec<Constant>> =
            arguments.iter().map(|argument| value_in(question, &state, *argument)).collect();
        if let Some(arguments) = arguments
            && !state.iter().any(|(location, _)| *location == (id, arguments.clone()))
        {
            state.push(((id, arguments), value));
        }
    }
    Answer::Sat(state)
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
