//! Letters: sets of a formula's propositions that hold in a state, numbered so that equal sets have equal numbers.

use hashbrown::HashMap;
use rustc_hash::FxBuildHasher;

use crate::graph::{Graph, StateId, StateSet};
use crate::temporal::budget::{Budget, Spent};

/// The letter of each state.
#[derive(Debug)]
pub struct Letters {
    /// For each state.
    letters: Vec<u32>,
    /// For each letter, one bit per proposition in the order of `propositions`.
    held: Vec<Vec<u64>>,
    /// The propositions of the formula, ascending.
    propositions: Vec<u32>,
}

impl Letters {
    /// The letters of a graph's states over these propositions, which are ascending.
    ///
    /// # Errors
    /// The caller asked to stop.
    pub fn of(graph: &Graph, propositions: Vec<u32>, budget: &mut Budget<'_>) -> Result<Letters, Spent> {
        let columns: Vec<&StateSet> = propositions.iter().map(|number| graph.proposition(*number as usize)).collect();
        let mut known: HashMap<Vec<u64>, u32, FxBuildHasher> = HashMap::default();
        let mut held = Vec::new();
        let mut letters = Vec::with_capacity(graph.states());
        let mut row = vec![0u64; columns.len().div_ceil(64)];
        for state in 0..graph.states() as StateId {
            budget.work()?;
            row.fill(0);
            for (index, column) in columns.iter().enumerate() {
                row[index / 64] |= u64::from(column.contains(state)) << (index % 64);
            }
            let letter = known.get(&row).copied().unwrap_or_else(|| {
                let letter = held.len() as u32;
                held.push(row.clone());
                known.insert(row.clone(), letter);
                letter
            });
            letters.push(letter);
        }
        Ok(Letters { letters, held, propositions })
    }

    /// The letter of a state.
    pub fn at(&self, state: StateId) -> u32 {
        self.letters[state as usize]
    }

    /// Whether a letter contains a proposition.
    ///
    /// # Panics
    /// The formula does not contain the proposition.
    pub fn holds(&self, letter: u32, proposition: u32) -> bool {
        let index = self.propositions.binary_search(&proposition).expect("a proposition of the formula");
        self.held[letter as usize][index / 64] >> (index % 64) & 1 == 1
    }
}
