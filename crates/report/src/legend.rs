//! What the colours and marks of a timeline mean: the keys that the page and the still picture share.
//!
//! In: a report. Out: its activities and its marks, in the order of the legend. INVARIANT: what is never drawn has no key.

use crate::report::Report;
use crate::track::Kind;

/// A sign in lanes that is no box of an activity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Mark {
    /// A period begins.
    Period,
    /// The deadline of a cycle, where it is not the end of its period.
    Deadline,
    /// A cycle was completed after its deadline.
    Late,
    /// The way of a datum.
    Way,
    /// The array that is written to next.
    WritePlace,
    /// The array that is read next.
    ReadPlace,
    /// The arrays are swapped.
    Swap,
}

/// The activities that occur.
pub(crate) fn activities(report: &Report) -> impl Iterator<Item = &Kind> {
    let done = |index: usize| report.tasks.iter().any(|task| task.shares.get(index).is_some_and(|ticks| *ticks > 0));
    report.activities.iter().enumerate().filter(move |(index, _)| done(*index)).map(|(_, kind)| kind)
}

/// The marks that occur, with their words.
pub(crate) fn marks(report: &Report) -> Vec<(Mark, String)> {
    let mut marks = Vec::new();
    let mut mark = |mark: Mark, words: &str| marks.push((mark, words.to_owned()));
    if report.tasks.iter().any(|task| !task.releases.is_empty()) {
        let early = report.tasks.iter().any(|task| task.early_deadline().is_some());
        let all =
            report.tasks.iter().filter(|task| !task.releases.is_empty()).all(|task| task.early_deadline().is_some());
        mark(
            Mark::Period,
            match (early, all) {
                (false, _) => "a period begins, the deadline of the one before",
                (true, true) => "a period begins",
                (true, false) => "a period begins, the deadline where none is marked",
            },
        );
        if early {
            mark(Mark::Deadline, "deadline");
        }
    }
    if report.tasks.iter().any(|task| !task.misses.is_empty()) {
        mark(Mark::Late, "completed after its deadline");
    }
    if let Some(flow) = &report.flow {
        mark(Mark::Way, &format!("way of a {}, dashed when overtaken", flow.noun.0));
    }
    if !report.buffers.is_empty() {
        mark(Mark::WritePlace, "array next to be written");
        mark(Mark::ReadPlace, "next to be read");
        mark(Mark::Swap, "arrays swapped");
    }
    marks
}
