//! The results of a mutation analysis, as JSON objects.

use groundstate::mutation::{By, Candidate, Judging, Killed, Outcome, Proof, Score, Unseen};
use serde::{Deserialize, Serialize};
use syntax::Sources;

use crate::Place;

/// `{"type":"mutant",…}`: what became of a mutant.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Mutant {
    #[cfg_attr(test, schemars(extend("const" = "mutant")))]
    r#type: &'static str,
    operator: &'static str,
    /// The components of a chart's system that decide by it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    components: Vec<String>,
    #[serde(flatten)]
    became: Became,
    #[serde(flatten)]
    place: Place,
    /// The lines that it changes.
    before: Vec<String>,
    /// What they become.
    after: Vec<String>,
}

/// An outcome.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Became {
    /// `killed`, `survived`, `equivalent`, `unknown` or `not-compiled`.
    outcome: String,
    /// The property, or the path of the scenario or of the coupling, that killed it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    check: Option<String>,
    /// The model that has the property.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    model: Option<String>,
    /// After how many steps it was killed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    steps: Option<u64>,
    /// If it survived: in how many reachable states more or fewer it differs, if that is known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    states: Option<u64>,
    /// Of what is equivalent, the proof: `never-runs` or `same-steps`. Of what survived: `states`, `steps`, `nowhere`,
    /// `within-bounds`, `left-out` or `unmeasured`. Otherwise a clause.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    why: Option<String>,
}

impl Mutant {
    /// The mutant and its outcome.
    pub fn new(candidate: &Candidate, outcome: &Outcome) -> Mutant {
        let mut sources = Sources::default();
        let file = sources.add((*candidate.file).clone());
        let bytes = &candidate.mutant.place;
        let span = syntax::Span { file, start: bytes.start as u32, end: bytes.end as u32 };
        let change = candidate.change();
        Mutant {
            r#type: "mutant",
            operator: candidate.mutant.operator.id(),
            components: candidate.components.clone(),
            became: Became::of(outcome),
            place: Place::new(&sources, span),
            before: change.before,
            after: change.after,
        }
    }
}

impl Became {
    /// The words for an outcome.
    pub fn of(outcome: &Outcome) -> Became {
        let plain = |word: &str, why: Option<&str>| Became {
            outcome: word.to_string(),
            check: None,
            model: None,
            steps: None,
            states: None,
            why: why.map(str::to_string),
        };
        match outcome {
            Outcome::Killed(Killed { by, steps }) => {
                let (model, check) = match by {
                    By::Property { model, name } => (Some(model.clone()), name.clone()),
                    By::Scenario { path } | By::Refinement { path } => (None, path.clone()),
                };
                Became { model, check: Some(check), steps: Some(*steps), ..plain("killed", None) }
            }
            Outcome::Survived(unseen) => {
                let states = match unseen {
                    Unseen::States(more) => Some(*more),
                    Unseen::Steps | Unseen::Nowhere | Unseen::WithinBounds | Unseen::LeftOut | Unseen::Unmeasured => {
                        None
                    }
                };
                Became { states, ..plain("survived", Some(word_of(*unseen))) }
            }
            Outcome::Equivalent(proof) => plain("equivalent", Some(word_of_proof(*proof))),
            Outcome::Open(why) => plain("unknown", Some(why)),
            Outcome::NotCompiled(why) => plain("not-compiled", Some(why)),
        }
    }

    /// The outcome; none if these are no words for one.
    pub fn outcome(self) -> Option<Outcome> {
        let Became { outcome, check, model, steps, states, why } = self;
        Some(match outcome.as_str() {
            "killed" => {
                let name = check?;
                let by = match model {
                    Some(model) => By::Property { model, name },
                    None if name.ends_with(".refine") => By::Refinement { path: name },
                    None => By::Scenario { path: name },
                };
                Outcome::Killed(Killed { by, steps: steps? })
            }
            "survived" => {
                use Unseen::{LeftOut, Nowhere, Steps, Unmeasured, WithinBounds};
                let unseen = [Steps, Nowhere, WithinBounds, LeftOut, Unmeasured];
                let unseen = unseen.into_iter().chain(states.map(Unseen::States));
                Outcome::Survived(unseen.into_iter().find(|unseen| why.as_deref() == Some(word_of(*unseen)))?)
            }
            "equivalent" => {
                let proofs = [Proof::NeverRuns, Proof::SameSteps];
                Outcome::Equivalent(proofs.into_iter().find(|proof| why.as_deref() == Some(word_of_proof(*proof)))?)
            }
            "unknown" => Outcome::Open(why?),
            "not-compiled" => Outcome::NotCompiled(why?),
            _ => return None,
        })
    }
}

fn word_of(unseen: Unseen) -> &'static str {
    match unseen {
        Unseen::States(_) => "states",
        Unseen::Steps => "steps",
        Unseen::Nowhere => "nowhere",
        Unseen::WithinBounds => "within-bounds",
        Unseen::LeftOut => "left-out",
        Unseen::Unmeasured => "unmeasured",
    }
}

fn word_of_proof(proof: Proof) -> &'static str {
    match proof {
        Proof::NeverRuns => "never-runs",
        Proof::SameSteps => "same-steps",
    }
}

/// `{"type":"mutation-results",…}`: the first line of a file in which outcomes are kept.
#[derive(Debug, Serialize, Deserialize, PartialEq, Eq)]
pub struct ResultsHead {
    r#type: String,
    version: u32,
}

impl Default for ResultsHead {
    fn default() -> Self {
        ResultsHead { r#type: "mutation-results".to_string(), version: 1 }
    }
}

/// A line of such a file: an outcome under its key.
#[derive(Debug, Serialize, Deserialize)]
pub struct KeptOutcome {
    /// The key.
    pub key: String,
    /// The outcome.
    #[serde(flatten)]
    pub became: Became,
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
    /// The couplings that judged, if refinements do.
    #[serde(skip_serializing_if = "Option::is_none")]
    couplings: Option<Vec<&'a str>>,
    /// All mutants.
    mutants: usize,
    /// Those that were judged.
    judged: usize,
    killed_by_properties: usize,
    killed_by_scenarios: usize,
    killed_by_refinements: usize,
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
    pub fn new(judging: Judging<'a>, (mutants, judged): (usize, usize), score: &Score, sampled: bool) -> Mutation<'a> {
        let round = |percent: f64| (percent * 10.0).round() / 10.0;
        let interval = score.interval().filter(|_| sampled);
        Mutation {
            r#type: "mutation",
            models: judging.models,
            scenarios: judging.scenarios,
            couplings: judging.couplings,
            mutants,
            judged,
            killed_by_properties: score.by_verify,
            killed_by_scenarios: score.by_test,
            killed_by_refinements: score.by_refine,
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outcomes_are_read_back() {
        let property = By::Property { model: "A.asm".to_string(), name: "inv_a".to_string() };
        let outcomes = [
            Outcome::Killed(Killed { by: property, steps: 3 }),
            Outcome::Killed(Killed { by: By::Refinement { path: "A.refine".to_string() }, steps: 2 }),
            Outcome::Killed(Killed { by: By::Scenario { path: "A.avalla".to_string() }, steps: 0 }),
            Outcome::Survived(Unseen::States(7)),
            Outcome::Survived(Unseen::Steps),
            Outcome::Survived(Unseen::Nowhere),
            Outcome::Survived(Unseen::WithinBounds),
            Outcome::Survived(Unseen::LeftOut),
            Outcome::Survived(Unseen::Unmeasured),
            Outcome::Equivalent(Proof::NeverRuns),
            Outcome::Equivalent(Proof::SameSteps),
            Outcome::Open("the time was up".to_string()),
            Outcome::NotCompiled("no such name".to_string()),
        ];
        for outcome in outcomes {
            let line = KeptOutcome { key: "k".to_string(), became: Became::of(&outcome) };
            let text = serde_json::to_string(&line).expect("it can be written");
            let read: KeptOutcome = serde_json::from_str(&text).expect("it can be read");
            assert_eq!(read.became.outcome(), Some(outcome), "{text}");
        }
        let wrong = r#"{"key":"k","outcome":"survived","why":"states"}"#;
        let read: KeptOutcome = serde_json::from_str(wrong).expect("it can be read");
        assert_eq!(read.became.outcome(), None);
    }
}
