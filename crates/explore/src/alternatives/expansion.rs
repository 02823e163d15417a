//! What the alternatives of a state come to, counted.
//!
//! In: what became of each alternative. Out: how many came to what, and the states that they lead to. INVARIANT: alternatives are
//! counted one by one, whether they lead to one state or to many.

use crate::alternatives::kind::AlternativeKind;
use crate::alternatives::successors::Successors;
use crate::packed::words::{Overwrite, apply};

/// What the alternatives of a state came to, all together.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Expansion {
    /// Alternatives that change the state.
    pub moved: u32,
    /// Alternatives that leave it as it is.
    pub stayed: u32,
    /// Alternatives that are faults, by [`machine::FaultClass`].
    pub faults: [u32; 3],
    /// Alternatives that cannot be gone through.
    pub unbounded: u32,
    /// Alternatives in which a condition on the step does not hold.
    pub failed: u32,
    /// Which conditions these are, a bit each; the highest stands for all from [`Expansion::TOLD`] on.
    pub failing: u64,
    /// Alternatives that an assumption leaves out.
    pub excluded: u32,
    /// Whoever waits has had enough: there may be more alternatives.
    pub interrupted: bool,
}

impl Expansion {
    /// LIMIT: so many conditions on steps are told apart.
    pub const TOLD: usize = 63;

    /// Whether a condition on the step is one of those that do not hold of some alternative, or may be where that many are not told
    /// apart.
    pub fn may_fail(&self, condition: usize) -> bool {
        self.failing >> condition.min(Expansion::TOLD) & 1 == 1
    }

    /// Counts an alternative of which these conditions do not hold.
    #[cold]
    pub(crate) fn fail(&mut self, conditions: &[u32]) {
        self.failed += 1;
        self.failing |=
            conditions.iter().fold(0, |bits, condition| bits | 1 << (*condition as usize).min(Expansion::TOLD));
    }

    /// Counts an alternative that leads to a state, perhaps to the same one.
    #[inline]
    pub(crate) fn arrive(&mut self, state: &[u64], next: &[u64], found: &mut Successors<'_>) {
        // Word by word: a call to compare memory takes longer than a state of few words.
        if state.iter().zip(next).all(|(word, next)| word == next) {
            self.stayed += 1;
        } else {
            found.room(state.len()).extend_from_slice(next);
            self.moved += 1;
        }
    }

    /// Counts an alternative, and lists what it leads to.
    #[inline(always)]
    pub(crate) fn count(
        &mut self,
        kind: AlternativeKind,
        state: &[u64],
        overwrites: &[Overwrite],
        found: &mut Successors<'_>,
    ) {
        match kind {
            AlternativeKind::Next => {
                // Most alternatives of a state with many of them leave it as it is.
                if overwrites
                    .iter()
                    .all(|overwrite| overwrite.of(state[overwrite.word as usize]) == state[overwrite.word as usize])
                {
                    self.stayed += 1;
                    return;
                }
                let out = found.room(state.len());
                let start = out.len();
                out.extend_from_slice(state);
                apply(overwrites, &mut out[start..]);
                self.moved += 1;
            }
            AlternativeKind::Fault(class) => self.faults[class as usize] += 1,
            AlternativeKind::Unbounded => self.unbounded += 1,
            AlternativeKind::Excluded => self.excluded += 1,
        }
    }
}
