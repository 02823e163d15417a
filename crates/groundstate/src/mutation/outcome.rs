//! What became of mutants, and what that says of those who judged.
//!
//! In: outcomes of single mutants. Out: the score, and the survivors in an order worth reading.

use mutate::{Interval, interval};

use super::Candidate;
use crate::tell::plural;

/// What became of a mutant.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Outcome {
    /// A check noticed it.
    Killed(Killed),
    /// Every check passes.
    Survived(Unseen),
    /// Nothing can notice it: this was proved.
    Equivalent(Proof),
    /// A limit was reached before that was known; a clause says which.
    Open(String),
    /// The checker refuses it; its first message.
    NotCompiled(String),
}

/// Who noticed a mutant.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Killed {
    /// The check.
    pub by: By,
    /// After how many steps.
    pub steps: u64,
}

/// A check.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum By {
    /// A property, or one of the built-in checks.
    Property {
        /// The model's path.
        model: String,
        /// The name.
        name: String,
    },
    /// A scenario.
    Scenario {
        /// Its path.
        path: String,
    },
    /// A refinement.
    Refinement {
        /// The path of the coupling.
        path: String,
    },
}

/// How much a mutant that survived differs from the model.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unseen {
    /// In this many reachable states more or fewer.
    States(u64),
    /// It makes other steps, or that is not known; but the states are as many.
    Steps,
    /// In no reachable state of any of the models, which are not all that the text is for.
    Nowhere,
    /// In no reachable state within the bounds of inputs, which leave values out.
    WithinBounds,
    /// The model that verifies the system leaves it out, for no property of the system rests on it.
    LeftOut,
    /// The models' states were not all visited.
    Unmeasured,
}

/// Why nothing can notice a mutant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Proof {
    /// No reachable state runs the rule in which it is.
    NeverRuns,
    /// It makes the same steps from every reachable state.
    SameSteps,
}

impl Outcome {
    /// How it came to that, as a clause.
    pub fn remark(&self) -> String {
        match self {
            Outcome::Killed(Killed { by, steps }) => {
                let by = match by {
                    By::Property { model, name } => format!("{name} of {model}"),
                    By::Scenario { path } | By::Refinement { path } => path.clone(),
                };
                format!("by {by}, after {}", plural(*steps as usize, "step"))
            }
            Outcome::Survived(unseen) => match unseen {
                Unseen::States(1) => "one reachable state more or less".to_string(),
                Unseen::States(more) => format!("{more} reachable states more or fewer"),
                Unseen::Steps => "as many states, other steps".to_string(),
                Unseen::Nowhere => "no reachable state differs".to_string(),
                Unseen::WithinBounds => "no reachable state differs within the bounds of inputs".to_string(),
                Unseen::LeftOut => "no property of the system rests on it".to_string(),
                Unseen::Unmeasured => "not compared in every state".to_string(),
            },
            Outcome::Equivalent(Proof::NeverRuns) => "no reachable state runs it".to_string(),
            Outcome::Equivalent(Proof::SameSteps) => "the same steps from every reachable state".to_string(),
            Outcome::Open(why) | Outcome::NotCompiled(why) => why.clone(),
        }
    }
}

/// How many mutants came to what.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Score {
    /// Killed by a property.
    pub by_verify: usize,
    /// Killed by a scenario.
    pub by_test: usize,
    /// Killed by a refinement.
    pub by_refine: usize,
    /// Survived.
    pub survived: usize,
    /// Equivalent.
    pub equivalent: usize,
    /// Left open by a limit.
    pub open: usize,
    /// Refused by the checker.
    pub not_compiled: usize,
}

impl Score {
    /// Those that were killed.
    pub fn killed(&self) -> usize {
        self.by_verify + self.by_test + self.by_refine
    }

    /// Those that were judged and could be noticed.
    pub fn noticeable(&self) -> usize {
        self.killed() + self.survived
    }

    /// Those that were judged.
    pub fn judged(&self) -> usize {
        self.noticeable() + self.equivalent
    }

    /// The share of those killed among those that could be noticed, in percent; none without any.
    pub fn percent(&self) -> Option<f64> {
        share(self.killed(), self.noticeable())
    }

    /// The same share with equivalent mutants counted as if they had survived.
    pub fn percent_of_all(&self) -> Option<f64> {
        share(self.killed(), self.judged())
    }

    /// Of a sample: where the share among all mutants lies, with a probability of 95 %.
    pub fn interval(&self) -> Option<Interval> {
        interval(self.killed(), self.noticeable())
    }
}

fn share(part: usize, of: usize) -> Option<f64> {
    (of > 0).then(|| 100.0 * part as f64 / of as f64)
}

/// Counts outcomes.
pub fn score<'o>(outcomes: impl IntoIterator<Item = &'o Outcome>) -> Score {
    let mut score = Score::default();
    for outcome in outcomes {
        *match outcome {
            Outcome::Killed(Killed { by: By::Property { .. }, .. }) => &mut score.by_verify,
            Outcome::Killed(Killed { by: By::Scenario { .. }, .. }) => &mut score.by_test,
            Outcome::Killed(Killed { by: By::Refinement { .. }, .. }) => &mut score.by_refine,
            Outcome::Survived(_) => &mut score.survived,
            Outcome::Equivalent(_) => &mut score.equivalent,
            Outcome::Open(_) => &mut score.open,
            Outcome::NotCompiled(_) => &mut score.not_compiled,
        } += 1;
    }
    score
}

/// The survivors, the most surprising first: those with the largest difference in reachable states, then those with as many
/// states but perhaps other steps, then those that were left out or not measured, at last those that differ in no reachable state; among
/// equals in the order of operators and of the text.
pub fn surprising<'o>(judged: &'o [(Candidate, Outcome)]) -> Vec<(&'o Candidate, Unseen)> {
    let unseen = |(candidate, outcome): &'o (Candidate, Outcome)| match outcome {
        Outcome::Survived(unseen) => Some((candidate, *unseen)),
        _ => None,
    };
    let mut survivors: Vec<_> = judged.iter().filter_map(unseen).collect();
    let rank = |unseen: Unseen| match unseen {
        Unseen::States(more) => (0, u64::MAX - more),
        Unseen::Steps => (1, 0),
        Unseen::LeftOut | Unseen::Unmeasured => (2, 0),
        Unseen::Nowhere | Unseen::WithinBounds => (3, 0),
    };
    survivors.sort_by(|(one, one_seen), (other, other_seen)| {
        let key = |candidate: &Candidate, unseen| {
            let Candidate { file, mutant, .. } = candidate;
            (rank(unseen), mutant.operator, file.name.clone(), mutant.place.start)
        };
        key(one, *one_seen).cmp(&key(other, *other_seen))
    });
    survivors
}
