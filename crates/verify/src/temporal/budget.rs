//! Limits the effort of deciding a formula, and records what ended it early.

/// What ended a decision early.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Spent {
    /// The caller asked to stop.
    Stopped,
    /// A limit was reached.
    Limit {
        /// The limited quantity, e.g. `states of the product`.
        of: &'static str,
        /// The limit's value.
        value: u64,
    },
}

/// Limits of a decision; the defaults keep it within a few gigabytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Allowance {
    /// States of the product of graph and automaton.
    pub product_states: u64,
    /// States of the automaton.
    pub automaton_states: u64,
    /// The ways to satisfy the obligations of one state of the automaton.
    pub covers: u64,
}

impl Default for Allowance {
    fn default() -> Allowance {
        Allowance { product_states: 200_000_000, automaton_states: 1_000_000, covers: 1_000_000 }
    }
}

/// The effort so far: limits, and whether to stop.
pub struct Budget<'a> {
    /// The limits.
    pub limits: Allowance,
    stop: &'a mut dyn FnMut() -> bool,
    work: u32,
}

/// LIMIT: pieces of work between two checks whether to stop.
const PIECES: u32 = 1 << 14;

impl<'a> Budget<'a> {
    /// A new budget; `stop` is asked from time to time.
    pub fn new(limits: Allowance, stop: &'a mut dyn FnMut() -> bool) -> Budget<'a> {
        Budget { limits, stop, work: 0 }
    }

    /// Counts a piece of work.
    ///
    /// # Errors
    /// [`Spent::Stopped`].
    #[inline]
    pub fn work(&mut self) -> Result<(), Spent> {
        self.work += 1;
        if self.work < PIECES {
            return Ok(());
        }
        self.work = 0;
        if (self.stop)() { Err(Spent::Stopped) } else { Ok(()) }
    }

    /// Compares a number with its limit.
    ///
    /// # Errors
    /// [`Spent::Limit`].
    pub fn within(&self, number: usize, limit: u64, of: &'static str) -> Result<(), Spent> {
        if number as u64 > limit { Err(Spent::Limit { of, value: limit }) } else { Ok(()) }
    }
}
