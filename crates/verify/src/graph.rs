//! The explored state graph, on which temporal properties are decided.
//!
//! In: the edges that the search found, one after another ([`Builder`]). Out: an immutable [`Graph`] in compressed
//! rows, with one bit per state for each proposition. INVARIANT: every state has at least one edge, except unexplored
//! ones. Runs of an ASM are infinite: if a step changes nothing, the run stays in its state. A state whose step cannot
//! be made (a fault), or that is declared terminal, gets an edge to itself marked [`Label::STUTTER`].

/// The number of a state, in the order of discovery: initial states first, then by distance.
pub type StateId = u32;

/// Identifies the choices and inputs of an edge's step. The search numbers the labels.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Label(pub u32);

impl Label {
    /// No step: the state stays unchanged because it has no successor.
    pub const STUTTER: Label = Label(u32::MAX);
}

/// A set of numbers below a bound, stored as bits.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct StateSet {
    words: Vec<u64>,
    len: usize,
}

impl StateSet {
    /// The empty set of numbers below `len`.
    pub fn none(len: usize) -> StateSet {
        StateSet { words: vec![0; len.div_ceil(64)], len }
    }

    /// All numbers below `len`.
    pub fn all(len: usize) -> StateSet {
        let mut bits = StateSet { words: vec![u64::MAX; len.div_ceil(64)], len };
        bits.trim();
        bits
    }

    /// The bound.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether the set is empty.
    pub fn is_empty(&self) -> bool {
        self.words.iter().all(|word| *word == 0)
    }

    /// How many numbers are in it.
    pub fn count(&self) -> usize {
        self.words.iter().map(|word| word.count_ones() as usize).sum()
    }

    /// Whether a number is in it.
    #[inline]
    pub fn contains(&self, index: StateId) -> bool {
        self.words[index as usize / 64] >> (index % 64) & 1 == 1
    }

    /// Adds a number; returns whether it is new.
    #[inline]
    pub fn insert(&mut self, index: StateId) -> bool {
        let (word, bit) = (&mut self.words[index as usize / 64], 1u64 << (index % 64));
        let new = *word & bit == 0;
        *word |= bit;
        new
    }

    /// Removes a number; returns whether it was present.
    #[inline]
    pub fn remove(&mut self, index: StateId) -> bool {
        let (word, bit) = (&mut self.words[index as usize / 64], 1u64 << (index % 64));
        let there = *word & bit != 0;
        *word &= !bit;
        there
    }

    /// Raises the bound by one; `inside` tells whether the new number is in the set.
    pub fn push(&mut self, inside: bool) {
        if self.len == 64 * self.words.len() {
            self.words.push(0);
        }
        self.len += 1;
        if inside {
            self.insert((self.len - 1) as StateId);
        }
    }

    /// Intersects with another set.
    pub fn intersect(&mut self, other: &StateSet) {
        self.words.iter_mut().zip(&other.words).for_each(|(mine, theirs)| *mine &= theirs);
    }

    /// Unites with another set.
    pub fn unite(&mut self, other: &StateSet) {
        self.words.iter_mut().zip(&other.words).for_each(|(mine, theirs)| *mine |= theirs);
    }

    /// The numbers that are not in the set.
    pub fn complement(&self) -> StateSet {
        let mut bits = StateSet { words: self.words.iter().map(|word| !word).collect(), len: self.len };
        bits.trim();
        bits
    }

    /// The numbers in the set, ascending.
    pub fn iter(&self) -> impl Iterator<Item = StateId> + '_ {
        self.words.iter().enumerate().flat_map(|(index, word)| {
            let mut rest = *word;
            std::iter::from_fn(move || {
                let bit = (rest != 0).then(|| rest.trailing_zeros())?;
                rest &= rest - 1;
                Some(index as u32 * 64 + bit)
            })
        })
    }

    fn trim(&mut self) {
        let beyond = 64 * self.words.len() - self.len;
        if let Some(last) = self.words.last_mut() {
            *last &= u64::MAX >> beyond;
        }
    }
}

/// The graph.
#[derive(Debug, Clone, Default)]
pub struct Graph {
    /// For each state, and one more, where its edges begin.
    first_edge: Vec<u64>,
    targets: Vec<StateId>,
    labels: Vec<Label>,
    initial: Vec<StateId>,
    propositions: Vec<StateSet>,
    /// States that were discovered, but whose steps were not made.
    unexplored: StateSet,
    /// Propositions whose truth is unknown in these states.
    unknown: Vec<usize>,
}

impl Graph {
    /// The number of states.
    pub fn states(&self) -> usize {
        self.first_edge.len().saturating_sub(1)
    }

    /// The number of edges.
    pub fn edges(&self) -> usize {
        self.targets.len()
    }

    /// The initial states.
    pub fn initial(&self) -> &[StateId] {
        &self.initial
    }

    /// The successors of a state, in the canonical order of choices and inputs; a state may occur twice.
    #[inline]
    pub fn successors(&self, state: StateId) -> &[StateId] {
        &self.targets[self.edges_of(state)]
    }

    /// The numbers of a state's edges, in the order of [`Graph::successors`].
    #[inline]
    pub fn edges_of(&self, state: StateId) -> std::ops::Range<usize> {
        self.first_edge[state as usize] as usize..self.first_edge[state as usize + 1] as usize
    }

    /// The state that an edge leads to.
    #[inline]
    pub fn target(&self, edge: usize) -> StateId {
        self.targets[edge]
    }

    /// The label of an edge.
    #[inline]
    pub fn label(&self, edge: usize) -> Label {
        self.labels[edge]
    }

    /// The states in which a proposition holds; propositions are numbered as they were given to the search.
    pub fn proposition(&self, index: usize) -> &StateSet {
        &self.propositions[index]
    }

    /// The states that were discovered but not explored, because a limit ended the search.
    pub fn unexplored(&self) -> &StateSet {
        &self.unexplored
    }

    /// Whether a proposition's truth is also known in unexplored states.
    pub fn is_known_where_unexplored(&self, index: usize) -> bool {
        !self.unknown.contains(&index)
    }

    /// Whether the graph contains every reachable state with all its edges.
    pub fn is_complete(&self) -> bool {
        self.unexplored.is_empty()
    }

    /// The predecessors of each state, ascending.
    pub fn predecessors(&self) -> Predecessors {
        let states = self.states();
        let mut first = vec![0u64; states + 1];
        for target in &self.targets {
            first[*target as usize + 1] += 1;
        }
        for state in 0..states {
            first[state + 1] += first[state];
        }
        let mut next = first.clone();
        let mut sources = vec![0; self.targets.len()];
        for state in 0..states as StateId {
            for target in self.successors(state) {
                let place = &mut next[*target as usize];
                sources[*place as usize] = state;
                *place += 1;
            }
        }
        Predecessors { first, sources }
    }
}

/// The predecessors of each state of a graph.
#[derive(Debug, Clone)]
pub struct Predecessors {
    first: Vec<u64>,
    sources: Vec<StateId>,
}

impl Predecessors {
    /// The predecessors of this state, ascending, once for each edge.
    #[inline]
    pub fn of(&self, state: StateId) -> &[StateId] {
        &self.sources[self.first[state as usize] as usize..self.first[state as usize + 1] as usize]
    }
}

/// Builds a graph, state after state in the order of their numbers.
#[derive(Debug, Clone)]
pub struct Builder {
    graph: Graph,
}

impl Builder {
    /// A graph without states, for this many propositions.
    pub fn new(propositions: usize) -> Builder {
        let propositions = vec![StateSet::default(); propositions];
        Builder { graph: Graph { first_edge: vec![0], propositions, ..Graph::default() } }
    }

    /// Marks a proposition's truth as unknown in unexplored states.
    pub fn unknown_where_unexplored(&mut self, proposition: usize) {
        self.graph.unknown.push(proposition);
    }

    /// Makes the next state an initial one.
    pub fn initial(&mut self) {
        self.graph.initial.push(self.graph.states() as StateId);
    }

    /// Adds an edge of the next state.
    pub fn edge(&mut self, target: StateId, label: Label) {
        self.graph.targets.push(target);
        self.graph.labels.push(label);
    }

    /// Completes the next state, given the truth of each proposition in it. Without edges it gets one to itself.
    pub fn state(&mut self, truths: impl IntoIterator<Item = bool>) -> StateId {
        if self.graph.first_edge.last() == Some(&(self.graph.targets.len() as u64)) {
            self.edge(self.graph.states() as StateId, Label::STUTTER);
        }
        self.end_state(truths, false)
    }

    /// Completes the next state as unexplored.
    ///
    /// # Panics
    /// An edge was given for it.
    pub fn unexplored_state(&mut self, truths: impl IntoIterator<Item = bool>) -> StateId {
        assert_eq!(self.graph.first_edge.last(), Some(&(self.graph.targets.len() as u64)), "no edges");
        self.end_state(truths, true)
    }

    fn end_state(&mut self, truths: impl IntoIterator<Item = bool>, unexplored: bool) -> StateId {
        let state = self.graph.states() as StateId;
        let mut given = 0;
        for (bits, truth) in self.graph.propositions.iter_mut().zip(truths) {
            bits.push(truth);
            given += 1;
        }
        assert_eq!(given, self.graph.propositions.len(), "one truth for each proposition");
        self.graph.unexplored.push(unexplored);
        self.graph.first_edge.push(self.graph.targets.len() as u64);
        state
    }

    /// The graph.
    ///
    /// # Panics
    /// An edge to a state that was never given.
    pub fn finish(self) -> Graph {
        let states = self.graph.states();
        assert!(self.graph.targets.iter().all(|target| (*target as usize) < states), "every target is a state");
        self.graph
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 0 → 1 → 2, 0 → 2; 2 has no step.
    fn sample() -> Graph {
        let mut builder = Builder::new(1);
        builder.initial();
        builder.edge(1, Label(0));
        builder.edge(2, Label(1));
        builder.state([true]);
        builder.edge(2, Label(0));
        builder.state([false]);
        builder.state([true]);
        builder.finish()
    }

    #[test]
    fn rows_are_those_given_and_an_end_goes_on_in_itself() {
        let graph = sample();
        assert_eq!((graph.states(), graph.edges(), graph.initial()), (3, 4, &[0][..]));
        assert_eq!(graph.successors(0), [1, 2]);
        assert_eq!(graph.successors(2), [2]);
        assert_eq!(graph.label(graph.edges_of(2).start), Label::STUTTER);
        assert_eq!(graph.proposition(0).iter().collect::<Vec<_>>(), [0, 2]);
    }

    #[test]
    fn a_graph_with_an_unexplored_state_is_not_complete() {
        assert!(sample().is_complete());
        let mut builder = Builder::new(0);
        builder.initial();
        builder.edge(1, Label(0));
        builder.state([]);
        builder.unexplored_state([]);
        let graph = builder.finish();
        assert!(!graph.is_complete());
        assert_eq!(graph.unexplored().iter().collect::<Vec<_>>(), [1]);
        assert!(graph.successors(1).is_empty());
    }

    #[test]
    fn predecessors_are_the_edges_turned_around() {
        let predecessors = sample().predecessors();
        assert!(predecessors.of(0).is_empty());
        assert_eq!(predecessors.of(1), [0]);
        assert_eq!(predecessors.of(2), [0, 1, 2]);
    }

    #[test]
    fn sets_of_bits_are_sets() {
        let mut bits = StateSet::none(130);
        assert!(bits.insert(0) && bits.insert(129) && !bits.insert(129));
        assert_eq!(bits.iter().collect::<Vec<_>>(), [0, 129]);
        assert_eq!(bits.complement().count(), 128);
        assert_eq!(StateSet::all(130).complement(), StateSet::none(130));
        assert!(bits.remove(0) && !bits.contains(0) && bits.contains(129));
        let mut pushed = StateSet::default();
        (0..70).for_each(|index| pushed.push(index % 3 == 0));
        assert_eq!((pushed.len(), pushed.count()), (70, 24));
    }
}
