//! What the prompt shows: what can be typed, states, terms, and why a line is no value.
//!
//! In: the records of the run with their states. Out: texts. Terms are evaluated beside the run, so looking changes nothing of it.

use groundstate::job::Frozen;
use groundstate::model::nearest;
use groundstate::session::{Evaluator, Moment};
use groundstate::simulate::{Record, expected};
use groundstate::tell::Narrator;
use machine::{Show, Value};
use program::{DomainId, Expression, FunctionKind, Program};

use super::command;

/// What can be typed anywhere.
pub const COMMANDS: &str = "  :state [TERM]    the state before this step; what a function or a term is in it
  :updates         what the last step changed
  :run [N]         make N steps without asking: inputs keep their values
  :until TERM      the same until TERM holds, for at most 1000 steps
  :inputs random   let :run and :until draw the inputs; `:inputs held` keeps them
  :back            take a step back; also `:undo`
  :save FILE       write the run so far as a scenario; `:save!` replaces a file
  :quit            end the run; also Ctrl-D";

/// What can be typed where a run only asks.
pub const FEW: &str = "  :quit            end the run; also Ctrl-D";

/// LIMIT: of a larger domain only the first values are shown.
const SHOWN: usize = 12;

/// Looks at the states of a run.
pub struct Looking<'a> {
    program: &'a Program,
    narrator: Narrator<'a>,
    evaluator: Evaluator,
    /// None as long as the initial state is being set.
    moment: Option<Moment>,
    updates: String,
}

impl<'a> Looking<'a> {
    pub fn new(program: &'a Program, narrator: Narrator<'a>, evaluator: Evaluator) -> Looking<'a> {
        Looking { program, narrator, evaluator, moment: None, updates: String::new() }
    }

    /// Takes in what was recorded, and what it changed.
    pub fn note(&mut self, record: &Record, steps: u64, frozen: Option<&Frozen>, updates: String) {
        let inputs = match record {
            Record::Initial { inputs, .. } => {
                self.evaluator.begin(inputs);
                inputs.clone()
            }
            Record::Step(step) => step.inputs.clone(),
            Record::Back { .. } | Record::Attempt(_) | Record::End(_) => Vec::new(),
        };
        if let Some(frozen) = frozen {
            self.moment = Some(Moment::after(steps, frozen, inputs));
        }
        self.updates = updates;
    }

    /// Whether there is a state.
    pub fn has_state(&self) -> bool {
        self.moment.is_some()
    }

    /// What the last step changed.
    pub fn updates(&self) -> &str {
        match (self.updates.trim_end(), &self.moment) {
            ("", Some(moment)) if moment.step > 0 => "  a step was taken back: what the one before changed is not kept",
            ("", _) => "  no step has been made",
            (updates, _) => updates,
        }
    }

    /// The text of a term that is true or false.
    pub fn condition(&mut self, text: &str) -> Result<Expression, String> {
        self.evaluator.condition(text).map_err(|reason| self.meant(text, reason))
    }

    /// Whether it holds now.
    pub fn holds(&mut self, term: &Expression) -> Result<bool, String> {
        let moment = self.moment.as_ref().ok_or(NO_STATE)?;
        Ok(self.evaluator.value(term, moment)? == Value::Boolean(true))
    }

    /// The whole state, all locations of a function, or the value of a term.
    pub fn state(&mut self, text: &str) -> Result<String, String> {
        let moment = self.moment.as_ref().ok_or(NO_STATE)?;
        let locations = self.evaluator.locations(moment);
        if text.is_empty() {
            return Ok(self.narrator.state(&locations));
        }
        let named = |at: &machine::Location| self.program.function(at.function).name == text;
        let of: Vec<_> = locations.into_iter().filter(|(location, _)| named(location)).collect();
        if !of.is_empty() {
            return Ok(self.narrator.state(&of));
        }
        let value = self.evaluator.term(text).and_then(|term| self.evaluator.value(&term, moment));
        match value {
            Ok(value) => Ok(format!("  {text} = {}", value.show(self.program))),
            Err(reason) => Err(self.meant(text, reason)),
        }
    }

    /// A reason, with the name that was probably meant.
    fn meant(&self, text: &str, reason: String) -> String {
        let known = names(self.program);
        let words = text.split(|c: char| !(c.is_alphanumeric() || c == '_')).filter(|word| !word.is_empty());
        let mut strange = words.filter(|word| !known.iter().any(|name| name == word));
        let meant = strange.find_map(|word| nearest(word, known.iter().map(String::as_str)));
        match meant {
            Some(meant) if !reason.contains("did you mean") => format!("{reason}; did you mean `{meant}`?"),
            _ => reason,
        }
    }
}

const NO_STATE: &str = "the initial state is being set: there is none yet";

/// The names of the model's own functions, and of the literals of its enums.
pub fn names(program: &Program) -> Vec<String> {
    let own = |function: &&program::Function| !function.library && function.kind != FunctionKind::Static;
    let functions = program.functions.iter().filter(own).map(|function| function.name.clone());
    let literals = program.domains.iter().filter_map(|domain| match &domain.kind {
        program::DomainKind::Enum { literals } => Some(literals.clone()),
        _ => None,
    });
    let mut names: Vec<String> = functions.chain(literals.flatten()).collect();
    names.sort();
    names.dedup();
    names
}

/// A domain and its values.
pub fn wanted(program: &Program, domain: DomainId, values: &[Value]) -> String {
    let name = &program.domain(domain).name;
    let shown: Vec<String> = values.iter().take(SHOWN).map(|value| value.show(program).to_string()).collect();
    let choice = match values.len() {
        0 => expected(program, domain).unwrap_or_else(|| "a value".to_string()),
        all if all > SHOWN => format!("{}, …", shown.join(", ")),
        _ => shown.join(", "),
    };
    format!("{name}: {choice}")
}

/// What is asked for, and what it was before.
pub fn asked(step: u64, location: &str, wanted: &str, held: Option<&str>) -> String {
    let made = match step {
        0 => "The initial state".to_string(),
        step => format!("Step {step}"),
    };
    let held = held.map_or(String::new(), |value| format!("; {value} the last time"));
    format!("  {made} asks for {location} ({wanted}){held}")
}

/// Why a line is no value, and what was probably meant.
pub fn not_a_value(text: &str, told: &str, values: &[String]) -> String {
    match (as_command(text), nearest(text, values.iter().map(String::as_str))) {
        (_, Some(meant)) => format!("{told}; did you mean `{meant}`?"),
        (Some(command), None) => format!("{told}; did you mean `{command}`?"),
        (None, None) => told.to_string(),
    }
}

/// Why a line is not a value that is wanted now.
pub fn no_value(text: &str, ended: bool) -> String {
    let enter = if ended { "Enter leaves the run" } else { "Enter makes a step" };
    match as_command(text) {
        Some(command) => format!("no input is asked for now; did you mean `{command}`?"),
        None => format!("no input is asked for now: {enter}, `?` says what else can be typed"),
    }
}

/// The command of which the colon was left out.
fn as_command(text: &str) -> Option<String> {
    let colon = format!(":{text}");
    command::wish(&colon).is_ok().then_some(colon)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_meant_is_told() {
        let values = ["OPENED", "CLOSED"].map(str::to_string);
        assert_eq!(not_a_value("OPEND", "`OPEND` is no value", &values), "`OPEND` is no value; did you mean `OPENED`?");
        assert_eq!(not_a_value("run 3", "`run 3` is no value", &values), "`run 3` is no value; did you mean `:run 3`?");
        assert_eq!(not_a_value("12", "`12` is no value", &values), "`12` is no value");
        assert!(no_value("quit", false).contains("`:quit`") && no_value("7", true).contains("Enter leaves"));
    }
}
