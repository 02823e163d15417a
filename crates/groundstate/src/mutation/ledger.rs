//! Outcomes that are kept from one analysis to the next.
//!
//! In: a mutant, and all that its outcome rests on. Out: the key under which the outcome is kept. INVARIANT: an outcome is
//! found again only where the same version of the program judges the same change of the same text, by the same models, scenarios
//! and couplings, which count as far. What a limit of the search has left open is not kept, so these limits are no part of the key.

use std::fmt::Write;

use super::{Bench, Candidate, Outcome, Unseen};
use crate::text_fingerprint;

/// Keeps outcomes.
pub trait Ledger: Send {
    /// The outcome that was kept under a key.
    fn known(&self, key: &str) -> Option<Outcome>;

    /// Keeps an outcome.
    fn keep(&mut self, key: &str, outcome: &Outcome);
}

impl Outcome {
    /// Whether another analysis, with more time, could come to nothing else.
    pub fn is_final(&self) -> bool {
        match self {
            Outcome::Killed(_) | Outcome::Equivalent(_) | Outcome::NotCompiled(_) => true,
            Outcome::Survived(unseen) => *unseen != Unseen::Unmeasured,
            Outcome::Open(_) => false,
        }
    }
}

impl Bench {
    /// The key of the mutant of this number.
    pub fn key(&self, number: usize) -> String {
        let candidate = &self.candidates[number];
        let Candidate { file, mutant, models, builds, components: _ } = candidate;
        let super::Wanted { verify, test, refine, whole, extent, .. } = &self.wanted;
        let machine::Limits { iterations, call_depth, collection, updates, locations, work, interrupt: _ } =
            &extent.limits;
        let mut told = format!(
            "{} {verify} {test} {refine} {whole} {iterations} {call_depth} {collection} {updates} {locations} {work}\n",
            env!("CARGO_PKG_VERSION")
        );
        // Writing to a String cannot fail.
        let _ = writeln!(told, "{} {} {}", mutant.operator.id(), file.name, text_fingerprint(&file.text));
        for edit in &mutant.edits {
            let _ = writeln!(told, "{:?} {:?}", edit.range, edit.text);
        }
        for drawn in self.drawn.iter().filter(|drawn| builds.contains(&drawn.model)) {
            let _ = writeln!(told, "{} {} {}", drawn.model, drawn.is_new, text_fingerprint(&drawn.text));
        }
        for judge in models.iter().map(|index| &self.judges[*index]) {
            told += &judge.print;
            told.push('\n');
        }
        for play in self.plays.iter().filter(|play| candidate.is_in(&play.files)) {
            told += &play.print;
            told.push('\n');
        }
        for link in self.links.iter().filter(|link| candidate.is_in(&link.files)) {
            told += &link.print;
            told.push('\n');
        }
        // Two of them, since a collision would be a wrong verdict.
        let reversed: String = told.chars().rev().collect();
        text_fingerprint(&told) + &text_fingerprint(&reversed)
    }
}
