//! An explored state graph: what temporal properties are decided on.
//!
//! In: what the search met, edge after edge ([`Builder`]). Out: an immutable [`Graph`] in compressed rows, with one bit a
//! state for each proposition. INVARIANT: every state has at least one edge, but those that the search was ended before. An ASM's run is infinite: where a step
//! changes nothing the run goes on in the same state, and a state whose step cannot be made at all (a fault) or that is
//! declared terminal gets an edge to itself marked [`Label::STUTTER`].

/// The number of a state, in the order the search met it: initial states first, then by distance.
pub type StateId = u32;

/// How an edge came about: what was chosen and given in its step. Labels are numbered by the search.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Label(pub u32);

impl Label {
    /// No step: the state goes on unchanged because it has no other future.
    pub const STUTTER: Label = Label(u32::MAX);
}

/// A set of numbers below a bound, one bit each.
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

    /// Whether no number is in it.
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

    /// Puts a number in; tells whether it was not there.
    #[inline]
    pub fn insert(&mut self, index: StateId) -> bool {
        let (word, bit) = (&mut self.words[index as usize / 64], 1u64 << (index % 64));
        let new = *word & bit == 0;
        *word |= bit;
        new
    }

    /// Takes a number out; tells whether it was there.
    #[inline]
    pub fn remove(&mut self, index: StateId) -> bool {
        let (word, bit) = (&mut self.words[index as usize / 64], 1u64 << (index % 64));
        let there = *word & bit != 0;
        *word &= !bit;
        there
    }

    /// Adds one more number to the bound, in the set or not.
    pub fn push(&mut self, inside: bool) {
        if self.len == 64 * self.words.len() {
            self.words.push(0);
        }
        self.len += 1;
        if inside {
            self.insert((self.len - 1) as StateId);
        }
    }

    /// Keeps what is in both.
    pub fn intersect(&mut self, other: &StateSet) {
        self.words.iter_mut().zip(&other.words).for_each(|(mine, theirs)| *mine &= theirs);
    }

    /// Adds what is in the other.
    pub fn unite(&mut self, other: &StateSet) {
        self.words.iter_mut().zip(&other.words).for_each(|(mine, theirs)| *mine |= theirs);
    }

    /// The numbers that are not in it.
    pub fn complement(&self) -> StateSet {
        let mut bits = StateSet { words: self.words.iter().map(|word| !word).collect(), len: self.len };
        bits.trim();
        bits
    }

    /// The numbers in it, ascending.
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
    /// By state, and one more: where its edges begin.
    first_edge: Vec<u64>,
    targets: Vec<StateId>,
    labels: Vec<Label>,
    initial: Vec<StateId>,
    propositions: Vec<StateSet>,
    /// Met, but their steps were not made.
    unexplored: StateSet,
    /// Propositions whose truth is not known in these.
    unknown: Vec<usize>,
}

impl Graph {
    /// How many states there are.
    pub fn states(&self) -> usize {
        self.first_edge.len().saturating_sub(1)
    }

    /// How many edges there are.
    pub fn edges(&self) -> usize {
        self.targets.len()
    }

    /// The initial states.
    pub fn initial(&self) -> &[StateId] {
        &self.initial
    }

    /// The states that a step leads to, in the canonical order of choices and inputs; one may come up twice.
    #[inline]
    pub fn successors(&self, state: StateId) -> &[StateId] {
        &self.targets[self.edges_of(state)]
    }

    /// The numbers of a state's edges, in the order of [`Graph::successors`].
    #[inline]
    pub fn edges_of(&self, state: StateId) -> std::ops::Range<usize> {
        self.first_edge[state as usize] as usize..self.first_edge[state as usize + 1] as usize
    }

    /// Where an edge leads.
    #[inline]
    pub fn target(&self, edge: usize) -> StateId {
        self.targets[edge]
    }

    /// How an edge came about.
    #[inline]
    pub fn label(&self, edge: usize) -> Label {
        self.labels[edge]
    }

    /// The states in which a proposition holds, by the number it was given to the search with.
    pub fn proposition(&self, index: usize) -> &StateSet {
        &self.propositions[index]
    }

    /// The states that were met and whose steps were not made, because a limit ended the search.
    pub fn unexplored(&self) -> &StateSet {
        &self.unexplored
    }

    /// Whether a proposition's truth is known in unexplored states too.
    pub fn is_known_where_unexplored(&self, index: usize) -> bool {
        !self.unknown.contains(&index)
    }

    /// Whether every state that can be reached is in the graph with all its edges.
    pub fn is_complete(&self) -> bool {
        self.unexplored.is_empty()
    }

    /// The graph turned around: by state, its predecessors, ascending.
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
    /// The states that have an edge to this one, ascending; one comes up as often as it has edges.
    #[inline]
    pub fn of(&self, state: StateId) -> &[StateId] {
        &self.sources[self.first[state as usize] as usize..self.first[state as usize + 1] as usize]
    }
}

/// Puts a graph together, state after state in the order of their numbers.
#[derive(Debug, Clone)]
pub struct Builder {
    graph: Graph,
}

impl Builder {
    /// A graph without states whose states will be marked with so many propositions.
    pub fn new(propositions: usize) -> Builder {
        let propositions = vec![StateSet::default(); propositions];
        Builder { graph: Graph { first_edge: vec![0], propositions, ..Graph::default() } }
    }

    /// The truth of a proposition is not known in states whose steps were not made.
    pub fn unknown_where_unexplored(&mut self, proposition: usize) {
        self.graph.unknown.push(proposition);
    }

    /// The next state is an initial one.
    pub fn initial(&mut self) {
        self.graph.initial.push(self.graph.states() as StateId);
    }

    /// An edge of the next state.
    pub fn edge(&mut self, target: StateId, label: Label) {
        self.graph.targets.push(target);
        self.graph.labels.push(label);
    }

    /// Ends the next state: which propositions hold in it, one truth each. Without edges it gets one to itself.
    pub fn state(&mut self, truths: impl IntoIterator<Item = bool>) -> StateId {
        if self.graph.first_edge.last() == Some(&(self.graph.targets.len() as u64)) {
            self.edge(self.graph.states() as StateId, Label::STUTTER);
        }
        self.end_state(truths, false)
    }

    /// Ends the next state, whose steps were not made.
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
        assert_eq!(graph.successors(1), []);
    }

    #[test]
    fn predecessors_are_the_edges_turned_around() {
        let predecessors = sample().predecessors();
        assert_eq!(predecessors.of(0), []);
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
