//! Results of scenarios as JSON objects.
//!
//! In: a scenario that was tested, its faults, the run of one that failed. Out: [`ScenarioResult`].

use ::scenario::Judgement;
use groundstate::Tested;
use serde::Serialize;

use super::{Fault, Place};

/// `{"type":"scenario",…}`
#[derive(Debug, Serialize)]
pub struct ScenarioResult<'a> {
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
    /// What happened in one that failed, where it is asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    run: Option<serde_json::Value>,
}

#[derive(Debug, Serialize)]
struct Remark<'a> {
    message: &'a str,
    #[serde(flatten)]
    place: Place,
}

impl<'a> ScenarioResult<'a> {
    /// The result of the scenario in this file.
    pub fn new(file: String, tested: &'a Tested, faults: Vec<Fault<'a>>, run: Option<serde_json::Value>) -> Self {
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
