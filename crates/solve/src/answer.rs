//! Parses a solver's output: `sat` with values, `unsat`, or anything else.
//!
//! In: the solver's output. Out: [`Answer`]; values that are not our constants, such as algebraic numbers, are left
//! out.

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
    /// The condition holds in this state, in which some values may be missing.
    Sat(State),
    /// It holds in no state.
    Unsat,
    /// Something else; the first line says what.
    Other(String),
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
            // The solver numbers unnamed elements in its own way.
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
