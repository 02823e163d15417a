//! Decides which of the generated scenarios are kept.
//!
//! In: a scenario that was generated, and its file. Out: what it shows of what it was made for. INVARIANT: a kept scenario passes and shows
//! that whatever is chosen where it picks nothing, as far as a few runs tell. Coverage is what they are looked at with: what coverage does
//! not count is taken to be shown if all else of the scenario is.

use std::collections::BTreeSet;

use machine::Limits;
use model::Loader;
use scenario::{Evidence, FirstCandidate, Options};
use syntax::SourceFile;

use crate::test_generation::Generated;
use crate::test_generation::goals::Need;
use crate::{SeededChoices, Suite};

/// Runs scenarios that may be kept.
#[derive(Debug, Default)]
pub struct Trial(Suite);

impl Trial {
    /// What a scenario shows of what it was made for, with different choices where it picks nothing; none if it fails with some.
    pub fn shown(
        &mut self,
        generated: &Generated,
        source: &SourceFile,
        loader: &mut dyn Loader,
        limits: &Limits,
    ) -> Option<Shown> {
        let Trial(suite) = self;
        let counted = |need: &&Need| need.evidence().is_some();
        let all: BTreeSet<Need> = generated.meets.iter().filter(counted).copied().collect();
        let mut shown = all.clone();
        // Seed 0 chooses as `groundstate test` will.
        for seed in [None, Some(0), Some(1), Some(2)] {
            let options = Options { limits: limits.clone(), coverage: true, ..Options::default() };
            let tested = match seed {
                None => suite.test(source.clone(), loader, options, &mut FirstCandidate),
                Some(seed) => suite.test(source.clone(), loader, options, &mut SeededChoices::new(seed)),
            };
            let counts = suite.take_counts();
            if !tested.passed() {
                return None;
            }
            shown.retain(|need| need.evidence().is_some_and(|evidence| counts.show(evidence)));
        }
        Some(Shown(if shown == all { generated.meets.clone() } else { shown }))
    }
}

/// What a scenario shows.
#[derive(Debug)]
pub struct Shown(pub(super) BTreeSet<Need>);

impl Need {
    /// What coverage has to show for it, if coverage counts it.
    fn evidence(&self) -> Option<Evidence> {
        match *self {
            Need::Ran(span) => Some(Evidence::Ran(span)),
            Need::Went(span, outcome) => Some(Evidence::Went(span, outcome)),
            Need::Decided(..) | Need::Turned(..) => None,
        }
    }
}
