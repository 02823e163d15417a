//! Sets of packed states as binary decision diagrams (R. Bryant, *Graph-based algorithms for Boolean function
//! manipulation*, 1986), by the crate oxidd, with one variable per bit.
//!
//! In: the fields of a packed state in the order of their variables. INVARIANT: each set depends only on the bits of
//! the fields, so its satisfying assignments are its states.

use std::hash::BuildHasherDefault;

use explore::{Bits, Overwrite, StateSets};
use oxidd::bcdd::{BCDDFunction, BCDDManagerRef};
use oxidd::util::{OutOfMemory, SatCountCache};
use oxidd::{BooleanFunction, BooleanFunctionQuant, Manager, ManagerRef};
use rustc_hash::{FxHashMap, FxHasher};

use crate::symbolic::large::Large;

/// A set of states.
pub(crate) type Set = BCDDFunction;

/// No room for another node.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Full;

impl From<OutOfMemory> for Full {
    fn from(_: OutOfMemory) -> Full {
        Full
    }
}

/// LIMIT: one entry of the operation cache per this many nodes.
const NODES_AN_ENTRY: usize = 2;

/// A manager of sets.
pub(crate) struct Diagrams {
    manager: BCDDManagerRef,
    /// How many words a state has.
    words: usize,
    /// For each variable, its bit.
    places: Vec<(u32, u8)>,
    /// For each bit: the states in which it is set, and those in which it is clear.
    literals: FxHashMap<(u32, u8), (Set, Set)>,
    /// For each overwrite: the variables that it sets, as a cube, and their new values.
    writes: FxHashMap<Vec<Overwrite>, (Set, Set)>,
    empty: Set,
    all: Set,
    counts: SatCountCache<Large, BuildHasherDefault<FxHasher>>,
}

impl Diagrams {
    /// An empty manager with room for this many nodes.
    pub fn new(order: &[Bits], words: usize, nodes: usize) -> Result<Diagrams, Full> {
        let manager = oxidd::bcdd::new_manager(nodes, nodes / NODES_AN_ENTRY, 1);
        // The highest bit of a field is the most decisive and comes first.
        let places: Vec<(u32, u8)> = order
            .iter()
            .flat_map(|field| (0..field.bits).rev().map(move |bit| (field.word, field.shift + bit)))
            .collect();
        let mut literals = FxHashMap::default();
        let variables = manager.with_manager_exclusive(|manager| manager.add_vars(places.len() as u32));
        for (variable, place) in variables.zip(&places) {
            // Operations lock the manager themselves, so none may be called while it is locked here.
            let one = manager.with_manager_shared(|manager| BCDDFunction::var(manager, variable))?;
            let zero = one.not()?;
            literals.insert(*place, (one, zero));
        }
        let (empty, all) = manager.with_manager_shared(|manager| (BCDDFunction::f(manager), BCDDFunction::t(manager)));
        let (writes, counts) = (FxHashMap::default(), SatCountCache::default());
        Ok(Diagrams { manager, words, places, literals, writes, empty, all, counts })
    }

    /// The empty set.
    pub fn empty(&self) -> Set {
        self.empty.clone()
    }

    /// The set of one state.
    pub fn state(&self, words: &[u64]) -> Result<Set, Full> {
        let mut set = self.all.clone();
        // From the last variable up, each conjunction adds one node.
        for place in self.places.iter().rev() {
            set = set.and(self.literal(*place, words[place.0 as usize] >> place.1 & 1 == 1))?;
        }
        Ok(set)
    }

    fn literal(&self, place: (u32, u8), one: bool) -> &Set {
        let (positive, negative) = &self.literals[&place];
        if one { positive } else { negative }
    }

    /// The intersection.
    pub fn and(&self, a: &Set, b: &Set) -> Result<Set, Full> {
        Ok(a.and(b)?)
    }

    /// The successors of a set by a step with these overwrites.
    pub fn image(&mut self, set: &Set, overwrites: &[Overwrite]) -> Result<Set, Full> {
        let (variables, values) = self.write(overwrites)?;
        Ok(set.exists(&variables)?.and(&values)?)
    }

    /// The states that these overwrites do not change.
    pub fn unmoved(&mut self, set: &Set, overwrites: &[Overwrite]) -> Result<Set, Full> {
        let (_, values) = self.write(overwrites)?;
        Ok(set.and(&values)?)
    }

    /// The states of a set that these overwrites turn into one of another set.
    pub fn preimage(&mut self, set: &Set, overwrites: &[Overwrite], of: &Set) -> Result<Set, Full> {
        let (variables, values) = self.write(overwrites)?;
        Ok(set.and(&of.and(&values)?.exists(&variables)?)?)
    }

    fn write(&mut self, overwrites: &[Overwrite]) -> Result<(Set, Set), Full> {
        if let Some(known) = self.writes.get(overwrites) {
            return Ok(known.clone());
        }
        assert!(overwrites.iter().all(|write| write.from == 0), "bits of sets of states do not move");
        let (mut variables, mut values) = (self.all.clone(), self.all.clone());
        for (word, shift) in self.places.iter().rev() {
            let Some(write) = overwrites.iter().find(|write| write.word == *word) else { continue };
            if write.clear >> shift & 1 == 1 {
                variables = variables.and(self.literal((*word, *shift), true))?;
                values = values.and(self.literal((*word, *shift), write.set >> shift & 1 == 1))?;
            }
        }
        self.writes.insert(overwrites.to_vec(), (variables.clone(), values.clone()));
        Ok((variables, values))
    }

    /// The number of states in a set; exact below 2⁵³.
    pub fn count(&mut self, set: &Set) -> f64 {
        set.sat_count(self.places.len() as u32, &mut self.counts).value()
    }

    /// The number of nodes.
    pub fn nodes(&self) -> usize {
        self.manager.with_manager_shared(|manager| manager.num_inner_nodes())
    }
}

impl StateSets for Diagrams {
    type Set = Set;
    type Failure = Full;

    fn is_empty(&self, set: &Set) -> bool {
        *set == self.empty
    }

    fn split(&mut self, set: &Set, field: Bits) -> Result<Vec<(u64, Set)>, Full> {
        let mut parts = vec![(0u64, set.clone())];
        for bit in (0..field.bits).rev() {
            let place = (field.word, field.shift + bit);
            let mut finer = Vec::with_capacity(2 * parts.len());
            for (code, part) in parts {
                for one in [false, true] {
                    let some = part.and(self.literal(place, one))?;
                    if some != self.empty {
                        finer.push((code | u64::from(one) << bit, some));
                    }
                }
            }
            parts = finer;
        }
        Ok(parts)
    }

    fn union(&mut self, a: &Set, b: &Set) -> Result<Set, Full> {
        Ok(a.or(b)?)
    }

    fn minus(&mut self, a: &Set, b: &Set) -> Result<Set, Full> {
        Ok(b.imp_strict(a)?)
    }

    fn member(&self, set: &Set) -> Box<[u64]> {
        let mut state = vec![0; self.words].into_boxed_slice();
        let cube = set.pick_cube(|_, _, _| false).expect("not empty");
        for ((word, shift), value) in self.places.iter().zip(cube) {
            if value == oxidd::util::OptBool::True {
                state[*word as usize] |= 1 << shift;
            }
        }
        state
    }
}
