//! Results of scenarios as JSON objects.
//!
//! In: the result of a scenario, its faults, and its run if it failed. Out: [`ScenarioResult`].

use ::scenario::{Judgement, Passage, PassageKind, Story};
use groundstate::Tested;
use machine::{Location, Show, Value};
use program::Program;
use serde::Serialize;

use super::{Fault, Pairs, Place};

/// `{"type":"scenario",…}`
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct ScenarioResult<'a> {
    #[cfg_attr(test, schemars(extend("const" = "scenario")))]
    r#type: &'static str,
    name: &'a str,
    file: String,
    /// `passed`, `failed-as-expected`, `failed` or `faulty`.
    result: &'static str,
    steps: u64,
    checks: u64,
    failed_checks: u64,
    faults: Vec<Fault<'a>>,
    remarks: Vec<Remark<'a>>,
    /// The run of a scenario that failed, if requested.
    #[serde(skip_serializing_if = "Option::is_none")]
    run: Option<Vec<Told>>,
}

#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct Remark<'a> {
    message: &'a str,
    #[serde(flatten)]
    place: Place,
}

impl<'a> ScenarioResult<'a> {
    /// The result of the scenario in this file.
    pub fn new(file: String, tested: &'a Tested, faults: Vec<Fault<'a>>, run: Option<Vec<Told>>) -> Self {
        let verdict = tested.verdict.as_ref();
        let (held, broken) = verdict.map_or((0, 0), |verdict| verdict.checks);
        let remarks = verdict
            .iter()
            .flat_map(|verdict| &verdict.remarks)
            .map(|remark| Remark { message: &remark.message, place: Place::new(&tested.sources, remark.span) });
        ScenarioResult {
            r#type: "scenario",
            name: &tested.name,
            file,
            result: match verdict.map(|verdict| &verdict.judgement) {
                None => "faulty",
                Some(Judgement::Passed) => "passed",
                Some(Judgement::FailedAsExpected(_)) => "failed-as-expected",
                Some(Judgement::Failed(_)) => "failed",
            },
            steps: verdict.map_or(0, |verdict| verdict.steps),
            checks: held + broken,
            failed_checks: broken,
            faults,
            remarks: remarks.collect(),
            run,
        }
    }
}

/// A part of the run of a scenario.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(tag = "kind", rename_all = "lowercase")]
pub enum Told {
    /// The state in which the run begins.
    State {
        /// All locations that have a value.
        values: Pairs<String>,
        /// How many steps are left out before the following ones.
        left_out: u64,
    },
    /// A step that was made.
    Step(Happened),
    /// A step that could not be made.
    Attempt(Happened),
    /// A rule that the scenario itself executed.
    Exec(Happened),
}

/// A part of a run.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Happened {
    step: Option<u64>,
    inputs: Pairs<String>,
    choices: Vec<Vec<String>>,
    changes: Pairs<FromTo>,
}

#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct FromTo {
    from: String,
    to: String,
}

impl Told {
    /// The run of a scenario: the initial state, then each passage.
    pub fn story(program: &Program, story: &Story) -> Vec<Told> {
        let value = |value: &Value| value.show(program).to_string();
        let at = |location: &Location| location.show(program).to_string();
        let pairs = |values: &[(Location, Value)]| values.iter().map(|(of, is)| (at(of), value(is))).collect();
        let happened = |passage: &Passage, step: Option<u64>| Happened {
            step,
            inputs: pairs(&passage.inputs),
            choices: passage.choices.iter().map(|choice| choice.values.iter().map(value).collect()).collect(),
            changes: passage
                .changes
                .iter()
                .map(|change| (at(&change.location), FromTo { from: value(&change.before), to: value(&change.after) }))
                .collect(),
        };
        let initial = Told::State { values: pairs(&story.initial), left_out: story.left_out };
        let passages = story.passages.iter().map(|passage| match passage.kind {
            PassageKind::Step(step) => Told::Step(happened(passage, Some(step))),
            PassageKind::Attempt(step) => Told::Attempt(happened(passage, Some(step))),
            PassageKind::Exec => Told::Exec(happened(passage, None)),
        });
        std::iter::once(initial).chain(passages).collect()
    }
}
