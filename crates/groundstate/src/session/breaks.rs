//! What stops a run: rules, commands of a scenario, changed locations, each with a condition; faults and violated invariants.
//!
//! In: a moment, and how often each break was reached before. Out: what of it is to stop the run, and the messages of breaks that
//! say something instead. A condition that cannot be evaluated stops the run, too: whoever wrote it wants to know.
//! INVARIANT: how often a break was reached depends on the steps that led to the moment, not on steps that were taken back.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use machine::{Change, Location, Show, Value};
use program::{Expression, FunctionId, Program, RuleId};
use syntax::Span;

/// Where a break is.
#[derive(Debug, Clone)]
pub enum On {
    /// One of these rules ran.
    Rules(BTreeSet<RuleId>),
    /// One of these commands comes next.
    Commands(Vec<Span>),
    /// This location changed.
    Location(Location),
    /// A location of this function changed.
    Function(FunctionId),
}

/// Something that stops the run.
#[derive(Debug, Clone)]
pub struct Break {
    /// Its number.
    pub id: u64,
    /// Where.
    pub on: On,
    /// It stops only where this holds.
    pub condition: Option<Expression>,
    /// It stops only when it is reached for the time that this says. It is reached where its condition holds.
    pub count: Option<Count>,
    /// What it says instead of stopping the run.
    pub message: Option<Vec<Piece>>,
}

/// A part of a message.
#[derive(Debug, Clone)]
pub enum Piece {
    /// As it is written.
    Text(String),
    /// The value of a term.
    Term(Expression),
}

/// Of the times that a break is reached, those that count.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Count {
    /// This time alone, from 1.
    Exactly(u64),
    /// This time and all that follow.
    AtLeast(u64),
    /// This time and all before.
    AtMost(u64),
    /// Each time whose number is a multiple.
    Every(u64),
}

impl Count {
    /// Reads `5`, `= 5`, `>= 5`, `> 5`, `<= 5`, `< 5`, `% 5`.
    ///
    /// # Errors
    /// A sentence: it is none of these, or no time is such.
    pub fn read(text: &str) -> Result<Count, String> {
        let trimmed = text.trim();
        let digits = trimmed.trim_start_matches(['<', '>', '=', '%']);
        let operator = &trimmed[..trimmed.len() - digits.len()];
        let wrong = || format!("`{trimmed}` is no count: write `5`, `>= 5`, `> 5`, `<= 5`, `< 5` or `% 5`");
        let number: u64 = digits.trim().parse().map_err(|_| wrong())?;
        let count = match operator {
            "" | "=" | "==" => Count::Exactly(number),
            ">=" => Count::AtLeast(number),
            ">" => Count::AtLeast(number.saturating_add(1)),
            "<=" => Count::AtMost(number),
            "<" => Count::AtMost(number.saturating_sub(1)),
            "%" => Count::Every(number),
            _ => return Err(wrong()),
        };
        match count {
            Count::Exactly(0) | Count::AtMost(0) | Count::Every(0) => {
                Err(format!("`{trimmed}` never holds: the first time is number 1"))
            }
            _ => Ok(count),
        }
    }

    /// Whether this time counts, from 1.
    fn admits(self, time: u64) -> bool {
        match self {
            Count::Exactly(number) => time == number,
            Count::AtLeast(number) => time >= number,
            Count::AtMost(number) => time <= number,
            Count::Every(number) => time.is_multiple_of(number),
        }
    }
}

/// All that stops the run.
#[derive(Debug, Clone, Default)]
pub struct Breaks {
    /// The breaks.
    pub list: Vec<Break>,
    /// The program with the conditions, if there are any.
    pub program: Option<Arc<Program>>,
    /// Whether a fault, or a command of a scenario that fails, stops it.
    pub faults: bool,
    /// Whether a violated invariant does.
    pub violations: bool,
}

/// What stopped the run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Hit {
    /// These breaks.
    Breaks(Vec<u64>),
    /// A fault, a failed check or a violated invariant.
    Wrong,
}

/// What happened, as far as it may stop a run.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Happened<'a> {
    pub ran: &'a [RuleId],
    pub changes: &'a [Change],
    pub next: Option<Span>,
    pub faults: bool,
    pub violations: bool,
    /// A step was made; otherwise one was taken back.
    pub forth: bool,
}

/// What breaks come to.
#[derive(Debug, Default)]
pub(crate) struct Judged {
    /// What stops the run.
    pub hit: Option<Hit>,
    /// What is said, and by which breaks.
    pub said: Vec<(u64, String)>,
}

impl Breaks {
    /// What this comes to. `reached` is how often each break was reached on the way; `value` evaluates a term.
    pub(crate) fn judge(
        &self,
        happened: Happened<'_>,
        reached: &mut BTreeMap<u64, u64>,
        value: &mut dyn FnMut(&Expression) -> Result<Value, String>,
    ) -> Judged {
        let mut judged = Judged::default();
        let mut hit = Vec::new();
        for Break { id, on, condition, count, message } in &self.list {
            let is_there = match on {
                On::Rules(rules) => happened.ran.iter().any(|rule| rules.contains(rule)),
                On::Commands(places) => happened.next.is_some_and(|next| places.contains(&next)),
                On::Location(location) => happened.changes.iter().any(|change| change.location == *location),
                On::Function(function) => happened.changes.iter().any(|change| change.location.function == *function),
            };
            let mut holds =
                |condition: &Expression| !matches!(value(condition), Ok(Value::Boolean(false) | Value::Undef));
            if !is_there || !condition.as_ref().is_none_or(&mut holds) {
                continue;
            }
            if happened.forth {
                *reached.entry(*id).or_default() += 1;
            }
            // Steps that were made before the break was set were not counted.
            let time = reached.get(id).copied().filter(|time| *time > 0);
            if !count.is_none_or(|count| time.is_some_and(|time| count.admits(time))) {
                continue;
            }
            match message {
                Some(message) if happened.forth => judged.said.push((*id, self.text(message, value))),
                Some(_) => {}
                None => hit.push(*id),
            }
        }
        judged.hit = match self.faults && happened.faults || self.violations && happened.violations {
            true => Some(Hit::Wrong),
            false => (!hit.is_empty()).then_some(Hit::Breaks(hit)),
        };
        judged
    }

    /// A message with the values of its terms; why there is none stands in its place.
    fn text(&self, message: &[Piece], value: &mut dyn FnMut(&Expression) -> Result<Value, String>) -> String {
        let mut text = String::new();
        for piece in message {
            match (piece, &self.program) {
                (Piece::Text(part), _) => text.push_str(part),
                (Piece::Term(_), None) => {}
                (Piece::Term(term), Some(program)) => match value(term) {
                    Ok(value) => text.push_str(&value.show(program).briefly().to_string()),
                    Err(reason) => text.push_str(&format!("({reason})")),
                },
            }
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_read() {
        let times = |text: &str| -> Vec<u64> {
            let count = Count::read(text).unwrap_or_else(|reason| panic!("{reason}"));
            (1..=9).filter(|time| count.admits(*time)).collect()
        };
        assert_eq!(times("5"), [5]);
        assert_eq!(times(" == 5 "), [5]);
        assert_eq!(times(">= 7"), [7, 8, 9]);
        assert_eq!(times(">7"), [8, 9]);
        assert_eq!(times("<= 2"), [1, 2]);
        assert_eq!(times("< 2"), [1]);
        assert_eq!(times("% 3"), [3, 6, 9]);
        assert_eq!(times("> 0").len(), 9);
        for wrong in ["", "x", "5 5", "=> 5", "-1", "% 0", "0", "< 1", "<= 0", "5.0", "99999999999999999999", "%"] {
            assert!(Count::read(wrong).is_err(), "{wrong}");
        }
    }
}
