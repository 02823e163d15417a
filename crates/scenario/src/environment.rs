//! The environment of a scenario: inputs that stay until set again, picks, a policy for the other choices.
//!
//! An input that was never set is undef; one with an initial value keeps it until it is set.
//! [`ScenarioEnvironment::missing`] says whether an unset one was asked for, so an invariant over inputs is not judged
//! before its inputs are there. The clock shows 1 s in the initial state and a second more in each next one; so do the
//! monitored functions of the time libraries that are not set.

use std::collections::BTreeMap;
use std::fmt;

use machine::{Choice, Draw, Environment, Location, LocationRef, Show, TimeUnit, Value};
use program::{DomainId, Program};
use syntax::Span;

/// LIMIT: a number drawn from an infinite domain is one of this many.
const NUMBERS: usize = 21;

/// How choices are made that no `pick` makes. It comes in as a parameter, so this crate has no random source.
pub trait Choices {
    /// The index of one of `candidates` candidates.
    fn choose(&mut self, candidates: usize) -> usize;
}

/// Always the first candidate.
#[derive(Debug, Default, Clone, Copy)]
pub struct FirstCandidate;

impl Choices for FirstCandidate {
    fn choose(&mut self, _candidates: usize) -> usize {
        0
    }
}

/// A choice that was made.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Made {
    /// The rule that chose.
    pub span: Span,
    /// What was chosen, one value a variable.
    pub values: Vec<Value>,
}

/// A pick with its value.
#[derive(Debug, Clone)]
pub(crate) struct Picked {
    pub variable: String,
    pub choices: Vec<(Span, usize)>,
    pub value: Value,
    pub span: Span,
    pub used: bool,
}

/// A pick whose value no candidate has.
#[derive(Debug, Clone)]
pub(crate) struct Mispick {
    pub span: Span,
    pub choice: Span,
    pub message: String,
}

pub(crate) struct ScenarioEnvironment<'a> {
    pub inputs: BTreeMap<Location, Value>,
    pub picks: Vec<Picked>,
    pub choices: &'a mut dyn Choices,
    /// What the clock shows.
    pub seconds: i64,
    /// An input was asked for that is not set.
    pub missing: bool,
    pub mispick: Option<Mispick>,
    /// The choices of the step, where they are kept.
    pub made: Option<Vec<Made>>,
}

impl fmt::Debug for ScenarioEnvironment<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ScenarioEnvironment").field("inputs", &self.inputs).field("picks", &self.picks).finish()
    }
}

impl<'a> ScenarioEnvironment<'a> {
    pub fn new(choices: &'a mut dyn Choices) -> Self {
        ScenarioEnvironment {
            inputs: BTreeMap::new(),
            picks: Vec::new(),
            choices,
            seconds: 1,
            missing: false,
            mispick: None,
            made: None,
        }
    }

    fn note(&mut self, choice: &Choice<'_>, index: usize) -> usize {
        if let Some(made) = &mut self.made {
            made.push(Made { span: choice.span, values: choice.candidate(index).to_vec() });
        }
        index
    }

    /// Of several picks for one variable of one choice, the last counts.
    fn picks_for(&mut self, choice: Span) -> Vec<(usize, usize)> {
        let mut chosen: Vec<(usize, usize)> = Vec::new();
        for (index, pick) in self.picks.iter_mut().enumerate() {
            if let Some((_, place)) = pick.choices.iter().find(|(span, _)| *span == choice) {
                pick.used = true;
                chosen.retain(|(_, earlier)| earlier != place);
                chosen.push((index, *place));
            }
        }
        chosen
    }
}

impl Environment for ScenarioEnvironment<'_> {
    fn monitored(
        &mut self,
        program: &Program,
        location: LocationRef<'_>,
        _codomain: DomainId,
    ) -> Result<Value, String> {
        if let Some(value) = self.inputs.get(&location.to_location()) {
            return Ok(value.clone());
        }
        if let Some(time) = library_time(program, location, self.seconds) {
            return Ok(Value::Integer(time));
        }
        self.missing = true;
        Ok(Value::Undef)
    }

    fn keeps_initial(&self, location: LocationRef<'_>) -> bool {
        !self.inputs.contains_key(&location.to_location())
    }

    fn number(&mut self, program: &Program, draw: &Draw) -> Result<Value, String> {
        let picks = self.picks_for(draw.span);
        let Some((pick, _)) = picks.iter().find(|(_, place)| *place == draw.variable) else {
            return Ok(draw.number(self.choices.choose(NUMBERS) as u32));
        };
        let pick = &self.picks[*pick];
        if draw.admits(&pick.value) {
            return Ok(pick.value.clone());
        }
        let message = format!("{} = {} is no {:?}", pick.variable, pick.value.show(program), draw.basic);
        self.mispick = Some(Mispick { span: pick.span, choice: draw.span, message: message.clone() });
        Err(message)
    }

    fn picks(&self, draw: &Draw) -> bool {
        self.picks.iter().any(|pick| pick.choices.contains(&(draw.span, draw.variable)))
    }

    fn no_candidate(&mut self, program: &Program, choose: Span) -> Result<(), String> {
        let Some((pick, _)) = self.picks_for(choose).pop() else { return Ok(()) };
        let pick = &self.picks[pick];
        let message =
            format!("{} = {} is not among the candidates: there are none", pick.variable, pick.value.show(program));
        self.mispick = Some(Mispick { span: pick.span, choice: choose, message: message.clone() });
        Err(message)
    }

    fn choose(&mut self, program: &Program, choice: &Choice<'_>) -> Result<usize, String> {
        let picks = self.picks_for(choice.span);
        if picks.is_empty() {
            let index = self.choices.choose(choice.candidates());
            return Ok(self.note(choice, index));
        }
        let fits = |index: &usize| {
            let candidate = choice.candidate(*index);
            picks.iter().all(|(pick, place)| candidate.get(*place) == Some(&self.picks[*pick].value))
        };
        let fitting: Vec<usize> = (0..choice.candidates()).filter(fits).collect();
        if fitting.is_empty() {
            let (pick, place) = picks[picks.len() - 1];
            let pick = &self.picks[pick];
            let message = format!(
                "{} = {} is not among the candidates: {}",
                pick.variable,
                pick.value.show(program),
                candidates(program, choice, place)
            );
            self.mispick = Some(Mispick { span: pick.span, choice: choice.span, message: message.clone() });
            return Err(message);
        }
        let index = fitting[self.choices.choose(fitting.len()).min(fitting.len() - 1)];
        Ok(self.note(choice, index))
    }

    fn time(&mut self, unit: TimeUnit) -> Result<i64, String> {
        Ok(match unit {
            TimeUnit::Nanoseconds => self.seconds.saturating_mul(1_000_000_000),
            TimeUnit::Milliseconds => self.seconds.saturating_mul(1_000),
            TimeUnit::Seconds => self.seconds,
        })
    }
}

/// The value of a time library's clock, if the location is one.
fn library_time(program: &Program, location: LocationRef<'_>, seconds: i64) -> Option<i64> {
    let function = program.function(location.function);
    if !function.library || !location.arguments.is_empty() {
        return None;
    }
    Some(match function.name.as_str() {
        "mCurrTimeNanosecs" => seconds.saturating_mul(1_000_000_000),
        "mCurrTimeMillisecs" => seconds.saturating_mul(1_000),
        "mCurrTimeSecs" => seconds,
        "mCurrTimeMins" => seconds / 60,
        "mCurrTimeHours" => seconds / 3600,
        _ => return None,
    })
}

/// The distinct values of one variable, the first of them.
fn candidates(program: &Program, choice: &Choice<'_>, place: usize) -> String {
    const SHOWN: usize = 10;
    let mut values: Vec<&Value> = (0..choice.candidates()).filter_map(|i| choice.candidate(i).get(place)).collect();
    values.sort_unstable();
    values.dedup();
    let mut text: Vec<String> = values.iter().take(SHOWN).map(|value| value.show(program).to_string()).collect();
    if values.len() > SHOWN {
        text.push(format!("and {} more", values.len() - SHOWN));
    }
    text.join(", ")
}
