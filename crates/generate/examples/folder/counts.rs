//! The counts for a folder: how many models there are, run, are generated, compile and agree.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use crate::judge::Judged;
use crate::log::Verdict;
use crate::prepare::{Fate, Model};

/// The results for the models.
#[derive(Default)]
pub struct Counts {
    files: usize,
    faulty: usize,
    no_main: usize,
    no_run: usize,
    generated: usize,
    distinct: usize,
    compiled: usize,
    agreed: usize,
    /// Recorded runs of generated models, and how many of them the code reproduces.
    recorded: (usize, usize),
    /// The same for models with recorded runs.
    with_record: (usize, usize),
    /// Why models were not generated, and how often.
    refused: BTreeMap<String, usize>,
}

impl Counts {
    pub fn of(models: &[Model], judged: &BTreeMap<usize, Judged>) -> Counts {
        let codes: BTreeSet<u64> = judged.values().map(|judged| judged.code).collect();
        let mut counts = Counts { files: models.len(), distinct: codes.len(), ..Counts::default() };
        for model in models {
            match &model.fate {
                Fate::Faulty => counts.faulty += 1,
                Fate::NoMain => counts.no_main += 1,
                Fate::NoRun => counts.no_run += 1,
                Fate::Refused(why) => *counts.refused.entry(why.clone()).or_default() += 1,
                Fate::Ready(_) => counts.generated += 1,
            }
        }
        for Judged { random, recorded, .. } in judged.values() {
            counts.compiled += usize::from(!matches!(random, Verdict::DoesNotCompile(_)));
            counts.agreed += usize::from(*random == Verdict::Agrees);
            let agreed = recorded.iter().filter(|verdict| **verdict == Verdict::Agrees).count();
            counts.recorded.0 += recorded.len();
            counts.recorded.1 += agreed;
            counts.with_record.0 += usize::from(!recorded.is_empty());
            counts.with_record.1 += usize::from(!recorded.is_empty() && agreed == recorded.len());
        }
        counts
    }

    /// Whether all generated code compiles and agrees.
    pub fn is_good(&self) -> bool {
        self.agreed == self.generated && self.recorded.0 == self.recorded.1
    }
}

impl fmt::Display for Counts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let run = self.generated + self.refused.values().sum::<usize>();
        let percent = |part: usize, whole: usize| 100.0 * part as f64 / whole.max(1) as f64;
        writeln!(f, "files                {:6}", self.files)?;
        writeln!(f, "  with faults        {:6}", self.faulty)?;
        writeln!(f, "  without main rule  {:6}", self.no_main)?;
        writeln!(f, "  no initial state   {:6}", self.no_run)?;
        writeln!(f, "run in the machine   {run:6}")?;
        for (what, count) in [("generated", self.generated), ("compiled", self.compiled), ("agreed", self.agreed)] {
            writeln!(f, "{what:20} {count:6}  {:.1} %", percent(count, run))?;
        }
        writeln!(f, "of distinct code     {:6}", self.distinct)?;
        let recorded = [("recorded runs", self.recorded), ("models with these", self.with_record)];
        for (what, (all, agreed)) in recorded.into_iter().filter(|(_, (all, _))| *all > 0) {
            writeln!(f, "{what:20} {all:6}  of which {agreed} agree, {:.1} %", percent(agreed, all))?;
        }
        for (why, count) in &self.refused {
            writeln!(f, "refused {count:4}  {why}")?;
        }
        Ok(())
    }
}
