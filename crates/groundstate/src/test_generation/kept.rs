//! Decides which of the generated scenarios are kept.

use machine::Limits;
use model::Loader;
use scenario::{FirstCandidate, Options};
use syntax::SourceFile;

use crate::{SeededChoices, Suite};

/// Whether a scenario passes with different choices where it picks nothing. If it does not, it depends on a choice that
/// no scenario can pick. If it passes, its coverage is added to the suite.
pub fn passes_whatever_is_chosen(
    suite: &mut Suite,
    source: &SourceFile,
    loader: &mut dyn Loader,
    limits: Limits,
) -> bool {
    let mut passes = |coverage: bool, seed: Option<u64>| {
        let options = Options { limits: limits.clone(), coverage, ..Options::default() };
        let tested = match seed {
            None => suite.test(source.clone(), loader, options, &mut FirstCandidate),
            Some(seed) => suite.test(source.clone(), loader, options, &mut SeededChoices::new(seed)),
        };
        tested.passed()
    };
    // The last run chooses as `groundstate test --coverage` will.
    [None, Some(1), Some(2)].into_iter().all(|seed| passes(false, seed)) && passes(true, Some(0))
}
