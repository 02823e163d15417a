//! What a run chose, by names: two programs that are made of the same rules number and place them differently.
//!
//! In: the choices of a step of one program. Out: the candidates of another program that stand for them.

use std::collections::VecDeque;

use explore::ChoiceTaken;
use machine::{Choice, Show, Value};
use program::{Program, Rule, RuleId};
use syntax::Span;

/// A choice: the name of its rule, its number among the choices there, and what was chosen.
type Pick = ((String, usize), Vec<String>);

/// The choices of a step that are still to be made.
#[derive(Debug, Clone, Default)]
pub(crate) struct Picked(VecDeque<Pick>);

impl Picked {
    pub fn of(program: &Program, choices: &[ChoiceTaken]) -> Picked {
        let picks =
            choices.iter().filter_map(|choice| Some((place(program, choice.span)?, shown(program, &choice.values))));
        Picked(picks.collect())
    }

    /// The candidate that was chosen; none if the step made no such choice.
    pub fn take(&mut self, program: &Program, choice: &Choice<'_>) -> Option<usize> {
        let here = place(program, choice.span)?;
        let next = self.0.iter().position(|(place, _)| *place == here)?;
        let (_, values) = self.0.remove(next)?;
        (0..choice.candidates()).find(|index| shown(program, choice.candidate(*index)) == values)
    }
}

fn shown(program: &Program, values: &[Value]) -> Vec<String> {
    values.iter().map(|value| value.show(program).to_string()).collect()
}

/// The rule of a choice, and its number among the choices of that rule.
fn place(program: &Program, span: Span) -> Option<(String, usize)> {
    program.procedures.iter().find_map(|procedure| {
        let (mut open, mut number): (Vec<RuleId>, usize) = (vec![procedure.body], 0);
        while let Some(id) = open.pop() {
            program.each_child_of_rule(id, &mut |child| open.push(child));
            if matches!(program.rule(id), Rule::Choose { .. }) {
                if program.rule_span(id) == span {
                    return Some((procedure.name.clone(), number));
                }
                number += 1;
            }
        }
        None
    })
}
