//! Mutation analysis: which small faults of a model its properties and scenarios would not notice (spec/mutation.md).
//!
//! In: paths of the texts to mutate, and of the models and scenarios that judge. Out: first whether these accept the model
//! as it is ([`Bench`]), then an [`Outcome`] for each mutant. INVARIANT: a mutant is killed only by a check that the model
//! itself passes, and equivalent only by proof; whatever a limit left open is neither killed nor survived.

mod ask;
mod base;
mod drawn;
mod judge;
mod ledger;
mod link;
mod outcome;
mod page;
mod passing;

use std::collections::{BTreeMap, BTreeSet};
use std::ops::RangeInclusive;
use std::sync::Arc;

use machine::{Interrupt, Limits};
use mutate::{Change, Mutant, Operator};
use syntax::{LineColumn, SourceFile};

pub use base::{Bench, Judging, Unfit};
pub use drawn::machines_of;
pub use judge::Worker;
pub use ledger::Ledger;
pub use outcome::{By, Killed, Outcome, Proof, Score, Unseen, score, surprising};
pub use page::mutation_page;

/// What is to be mutated, and who judges.
#[derive(Debug, Clone)]
pub struct Wanted {
    /// Paths of the models that judge by their properties, and are run by scenarios.
    pub models: Vec<String>,
    /// Paths of the charts that judge: by the properties of the systems that they draw, or of the models that are built of them.
    pub charts: Vec<String>,
    /// Paths of the scenarios that judge.
    pub scenarios: Vec<String>,
    /// Paths of the coupling files that judge.
    pub couplings: Vec<String>,
    /// Paths of the texts to mutate.
    pub mutated: BTreeSet<String>,
    /// Also mutate what the models import, unless it belongs to a built-in library.
    pub imports: bool,
    /// The models are all that the mutated texts are for: what makes no difference in any of them is equivalent.
    pub whole: bool,
    /// Judge by the models' properties.
    pub verify: bool,
    /// Judge by the scenarios.
    pub test: bool,
    /// Judge by the couplings.
    pub refine: bool,
    /// The operators.
    pub operators: Vec<Operator>,
    /// Only mutants of these lines of each path.
    pub lines: Option<BTreeMap<String, Vec<RangeInclusive<u32>>>>,
    /// Only so many, drawn by this seed.
    pub sample: Option<(usize, u64)>,
    /// How far a search goes.
    pub extent: Extent,
}

/// How far the search of one model goes.
#[derive(Debug, Clone)]
pub struct Extent {
    /// The machine's limits.
    pub limits: Limits,
    /// The most states.
    pub max_states: u64,
    /// The most bytes for states.
    pub max_bytes: u64,
}

/// Gives an interrupt that is raised when the time of one judgement is up.
pub trait Timer: Send + Sync {
    /// Begins to measure.
    fn begin(&self) -> Interrupt;

    /// No longer measures.
    fn end(&self, interrupt: &Interrupt);
}

/// A mutant of one of the texts.
#[derive(Debug, Clone)]
pub struct Candidate {
    /// The text.
    pub file: Arc<SourceFile>,
    /// The fault.
    pub mutant: Mutant,
    /// The models, by number, that run what is mutated.
    pub models: Vec<usize>,
    /// The paths of the models that are built of the text: of a chart, or of a machine by which components of a chart decide.
    pub builds: Vec<String>,
    /// Of such a machine: the components.
    pub components: Vec<String>,
}

impl Candidate {
    /// Where the fault is.
    pub fn place(&self) -> LineColumn {
        self.file.line_column(self.mutant.place.start as u32)
    }

    /// Whether the mutated text, or what is built of it, is one of these.
    pub(super) fn is_in(&self, files: &BTreeSet<String>) -> bool {
        files.contains(&self.file.name) || self.builds.iter().any(|model| files.contains(model))
    }

    /// Components of one more chart decide by the text: these models judge, and this one is built.
    fn also(&mut self, models: &[usize], builds: &str, components: &[String]) {
        let models: Vec<usize> = models.iter().copied().filter(|model| !self.models.contains(model)).collect();
        self.models.extend(models);
        if !self.builds.iter().any(|model| model == builds) {
            self.builds.push(builds.to_string());
            self.components.extend_from_slice(components);
        }
    }

    /// The lines that the fault changes.
    pub fn change(&self) -> Change {
        mutate::changed(&self.file.text, &self.mutant.edits)
    }
}
