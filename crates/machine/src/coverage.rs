//! Which rules ran, and how.

use program::{Program, RuleId};

/// How often each rule ran, by [`RuleId`].
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Coverage {
    /// How often each rule of the arena ran, steps that ended in a fault included.
    pub executed: Vec<u64>,
    /// How a rule went, by its kind: an update: `[trivial, changing, 0]`; forall: `[none, one, many]` elements;
    /// choose: `[no candidate, one, several]`; if and switch: `[no branch taken, a branch taken, 0]`.
    pub outcomes: Vec<[u64; 3]>,
}

impl Coverage {
    pub(crate) fn new(program: &Program) -> Coverage {
        Coverage { executed: vec![0; program.rules.len()], outcomes: vec![[0; 3]; program.rules.len()] }
    }

    pub(crate) fn ran(&mut self, rule: RuleId) {
        self.executed[rule.0 as usize] += 1;
    }

    pub(crate) fn went(&mut self, rule: RuleId, outcome: usize) {
        self.outcomes[rule.0 as usize][outcome] += 1;
    }

    /// Adds the counts of another run of the same program.
    pub fn merge(&mut self, other: &Coverage) {
        for (mine, theirs) in self.executed.iter_mut().zip(&other.executed) {
            *mine += theirs;
        }
        for (mine, theirs) in self.outcomes.iter_mut().zip(&other.outcomes) {
            mine.iter_mut().zip(theirs).for_each(|(mine, theirs)| *mine += theirs);
        }
    }
}
