//! The results of a mutation analysis, as JSON objects.

use groundstate::mutation::{By, Candidate, Killed, Outcome, Proof, Score, Unseen};
use serde::Serialize;
use syntax::Sources;

use crate::Place;

/// `{"type":"mutant",…}`: what became of a mutant.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Mutant<'a> {
    #[cfg_attr(test, schemars(extend("const" = "mutant")))]
    r#type: &'static str,
    operator: &'static str,
    /// `killed`, `survived`, `equivalent`, `unknown` or `not-compiled`.
    outcome: &'static str,
    #[serde(flatten)]
    place: Place,
    /// The lines that it changes.
    before: Vec<String>,
    /// What they become.
    after: Vec<String>,
    /// The property or the scenario that killed it.
    #[serde(skip_serializing_if = "Option::is_none")]
    check: Option<&'a str>,
    /// The model that has the property.
    #[serde(skip_serializing_if = "Option::is_none")]
    model: Option<&'a str>,
    /// After how many steps it was killed.
    #[serde(skip_serializing_if = "Option::is_none")]
    steps: Option<u64>,
    /// If it survived: in how many reachable states more or fewer it differs, if that is known.
    #[serde(skip_serializing_if = "Option::is_none")]
    states: Option<u64>,
    /// Of what is equivalent, the proof: `never-runs` or `same-steps`. Of what survived: `states`, `steps`, `nowhere`,
    /// `within-bounds` or `unmeasured`. Otherwise a clause.
    #[serde(skip_serializing_if = "Option::is_none")]
    why: Option<&'a str>,
}

impl<'a> Mutant<'a> {
    /// The mutant and its outcome.
    pub fn new(candidate: &Candidate, outcome: &'a Outcome) -> Mutant<'a> {
        let mut sources = Sources::default();
        let file = sources.add((*candidate.file).clone());
        let bytes = &candidate.mutant.place;
        let span = syntax::Span { file, start: bytes.start as u32, end: bytes.end as u32 };
        let change = candidate.change();
        let mut mutant = Mutant {
            r#type: "mutant",
            operator: candidate.mutant.operator.id(),
            outcome: "killed",
            place: Place::new(&sources, span),
            before: change.before,
            after: change.after,
            check: None,
            model: None,
            steps: None,
            states: None,
            why: None,
        };
        match outcome {
            Outcome::Killed(Killed { by, steps }) => {
                mutant.steps = Some(*steps);
                match by {
                    By::Property { model, name } => {
                        (mutant.model, mutant.check) = (Some(model.as_str()), Some(name.as_str()));
                    }
                    By::Scenario { path } => mutant.check = Some(path),
                }
            }
            Outcome::Survived(unseen) => {
                mutant.outcome = "survived";
                mutant.why = Some(match unseen {
                    Unseen::States(more) => {
                        mutant.states = Some(*more);
                        "states"
                    }
                    Unseen::Steps => "steps",
                    Unseen::Nowhere => "nowhere",
                    Unseen::WithinBounds => "within-bounds",
                    Unseen::Unmeasured => "unmeasured",
                });
            }
            Outcome::Equivalent(proof) => {
                mutant.outcome = "equivalent";
                mutant.why = Some(match proof {
                    Proof::NeverRuns => "never-runs",
                    Proof::SameSteps => "same-steps",
                });
            }
            Outcome::Open(why) => (mutant.outcome, mutant.why) = ("unknown", Some(why.as_str())),
            Outcome::NotCompiled(why) => (mutant.outcome, mutant.why) = ("not-compiled", Some(why.as_str())),
        }
        mutant
    }
}

/// `{"type":"mutation",…}`: how many mutants came to what.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Mutation<'a> {
    #[cfg_attr(test, schemars(extend("const" = "mutation")))]
    r#type: &'static str,
    /// The models that judged by their properties.
    models: Vec<&'a str>,
    /// The scenarios that judged.
    scenarios: Vec<&'a str>,
    /// All mutants.
    mutants: usize,
    /// Those that were judged.
    judged: usize,
    killed_by_properties: usize,
    killed_by_scenarios: usize,
    survived: usize,
    equivalent: usize,
    unknown: usize,
    not_compiled: usize,
    /// In percent of those killed or survived.
    score: Option<f64>,
    /// In percent of those killed, survived or equivalent.
    score_of_all: Option<f64>,
    /// Of a sample: where the score of all mutants lies with a probability of 95 %.
    #[serde(skip_serializing_if = "Option::is_none")]
    interval: Option<[f64; 2]>,
}

impl<'a> Mutation<'a> {
    /// The count: who judged; how many mutants there are, and how many were judged; the score, of a sample or of all.
    pub fn new(
        (models, scenarios): (Vec<&'a str>, Vec<&'a str>),
        (mutants, judged): (usize, usize),
        score: &Score,
        sampled: bool,
    ) -> Mutation<'a> {
        let round = |percent: f64| (percent * 10.0).round() / 10.0;
        let interval = score.interval().filter(|_| sampled);
        Mutation {
            r#type: "mutation",
            models,
            scenarios,
            mutants,
            judged,
            killed_by_properties: score.by_verify,
            killed_by_scenarios: score.by_test,
            survived: score.survived,
            equivalent: score.equivalent,
            unknown: score.open,
            not_compiled: score.not_compiled,
            score: score.percent().map(round),
            score_of_all: score.percent_of_all().map(round),
            interval: interval.map(|interval| [round(100.0 * interval.low), round(100.0 * interval.high)]),
        }
    }
}
