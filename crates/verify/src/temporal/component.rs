//! Strongly connected components in which a run can stay forever and be accepted.
//!
//! In: edges with marks, and an [`Acceptance`]: marks that must occur infinitely often (generalised Büchi), and pairs
//! whose second mark must if the first does (Streett). Out: [`Component`]s. A component with the first mark of a pair
//! but not the second is searched again without the edges that have the first (Emerson, Lei, *Modalities for model
//! checking*, 1987; Baier, Katoen, section 6.6). Components are found by Tarjan's algorithm, without recursion.

use std::ops::{BitAnd, BitOr, BitOrAssign, ControlFlow, Range};

use crate::graph::StateSet;
use crate::temporal::budget::{Budget, Spent};

/// A set of marks, at most 128.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Marks(pub u128);

impl Marks {
    /// No mark.
    pub const NONE: Marks = Marks(0);

    /// One mark.
    pub fn one(number: usize) -> Marks {
        Marks(1 << number)
    }

    /// The marks with smaller numbers.
    pub fn below(number: usize) -> Marks {
        if number >= 128 { Marks(u128::MAX) } else { Marks((1 << number) - 1) }
    }

    /// Whether it contains all of these.
    pub fn has(self, all: Marks) -> bool {
        self.0 & all.0 == all.0
    }

    /// Whether it contains any of these.
    pub fn meets(self, some: Marks) -> bool {
        self.0 & some.0 != 0
    }

    /// Without these.
    pub fn without(self, others: Marks) -> Marks {
        Marks(self.0 & !others.0)
    }
}

impl BitOr for Marks {
    type Output = Marks;
    fn bitor(self, other: Marks) -> Marks {
        Marks(self.0 | other.0)
    }
}

impl BitAnd for Marks {
    type Output = Marks;
    fn bitand(self, other: Marks) -> Marks {
        Marks(self.0 & other.0)
    }
}

impl BitOrAssign for Marks {
    fn bitor_assign(&mut self, other: Marks) {
        self.0 |= other.0;
    }
}

/// The condition for an infinite run to be accepted.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Acceptance {
    /// Each of these occurs infinitely often.
    pub again: Marks,
    /// If the first occurs infinitely often, so does the second.
    pub pairs: Vec<(Marks, Marks)>,
}

impl Acceptance {
    /// The conjunction of two conditions.
    pub fn with(mut self, other: Acceptance) -> Acceptance {
        self.again |= other.again;
        self.pairs.extend(other.pairs);
        self
    }

    /// The first marks of pairs that these marks do not satisfy.
    pub fn open_pairs(&self, marks: Marks) -> Marks {
        let open = self.pairs.iter().filter(|(first, second)| marks.meets(*first) && !marks.meets(*second));
        open.fold(Marks::NONE, |all, (first, _)| all | *first)
    }

    /// Whether a run with exactly these marks infinitely often is accepted.
    pub fn accepts(&self, marks: Marks) -> bool {
        marks.has(self.again) && self.open_pairs(marks) == Marks::NONE
    }
}

/// A graph with marks on its edges.
pub trait Edges {
    /// The number of nodes.
    fn nodes(&self) -> usize;
    /// The numbers of a node's edges.
    fn edges_of(&self, node: u32) -> Range<usize>;
    /// The node that an edge leads to.
    fn target(&self, edge: usize) -> u32;
    /// The marks of an edge.
    fn marks(&self, edge: usize) -> Marks;
}

/// A set of nodes in which a run can stay forever and be accepted.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Component {
    /// The nodes, ascending.
    pub nodes: Vec<u32>,
    /// Only edges without these marks belong to it; they connect the nodes strongly.
    pub avoided: Marks,
}

/// Calls `found` for each accepting component among the given nodes. Together the components contain every node that
/// occurs infinitely often on an accepted run within these nodes.
///
/// # Errors
/// The caller asked to stop.
pub fn accepting_components(
    edges: &impl Edges,
    within: &StateSet,
    acceptance: &Acceptance,
    budget: &mut Budget<'_>,
    mut found: impl FnMut(Component) -> ControlFlow<()>,
) -> Result<(), Spent> {
    let mut search = Search::new(edges.nodes());
    let first = Problem { nodes: within.iter().collect(), region: search.fresh_region(), avoided: Marks::NONE };
    for node in &first.nodes {
        search.region[*node as usize] = first.region;
    }
    let mut open = vec![first];
    while let Some(problem) = open.pop() {
        for mut nodes in search.components(edges, &problem, budget)? {
            let region = search.fresh_region();
            nodes.iter().for_each(|node| search.region[*node as usize] = region);
            let marks = search.marks_within(edges, &nodes, region, problem.avoided);
            let Some(marks) = marks.filter(|marks| marks.has(acceptance.again)) else { continue };
            let avoided = acceptance.open_pairs(marks);
            nodes.sort_unstable();
            if avoided != Marks::NONE {
                open.push(Problem { nodes, region, avoided: problem.avoided | avoided });
            } else if found(Component { nodes, avoided: problem.avoided }).is_break() {
                return Ok(());
            }
        }
    }
    Ok(())
}

struct Problem {
    nodes: Vec<u32>,
    /// Its nodes have this region.
    region: u32,
    avoided: Marks,
}

struct Search {
    /// For each node, the part that is being searched.
    region: Vec<u32>,
    regions: u32,
    /// For each node, the order of visit in the part; 0 if not visited.
    order: Vec<u32>,
    /// For each node, the first open node that it can reach; the maximum once its component is closed.
    low: Vec<u32>,
}

const CLOSED: u32 = u32::MAX;

impl Search {
    fn new(nodes: usize) -> Search {
        Search { region: vec![0; nodes], regions: 0, order: vec![0; nodes], low: vec![0; nodes] }
    }

    fn fresh_region(&mut self) -> u32 {
        self.regions += 1;
        self.regions
    }

    /// The marks of the edges within a region; `None` if there are no edges.
    fn marks_within(&self, edges: &impl Edges, nodes: &[u32], region: u32, avoided: Marks) -> Option<Marks> {
        let mut all = None;
        for edge in nodes.iter().flat_map(|node| edges.edges_of(*node)) {
            let marks = edges.marks(edge);
            if !marks.meets(avoided) && self.region[edges.target(edge) as usize] == region {
                all = Some(all.unwrap_or(Marks::NONE) | marks);
            }
        }
        all
    }

    fn leads_to_itself(&self, edges: &impl Edges, node: u32, avoided: Marks) -> bool {
        edges.edges_of(node).any(|edge| edges.target(edge) == node && !edges.marks(edge).meets(avoided))
    }

    /// The strongly connected components of a part that have an edge.
    fn components(
        &mut self,
        edges: &impl Edges,
        problem: &Problem,
        budget: &mut Budget<'_>,
    ) -> Result<Vec<Vec<u32>>, Spent> {
        let mut found = Vec::new();
        let mut visited = 0;
        let mut stack: Vec<u32> = Vec::new();
        let mut path: Vec<(u32, Range<usize>)> = Vec::new();
        problem.nodes.iter().for_each(|node| self.order[*node as usize] = 0);
        for root in &problem.nodes {
            if self.order[*root as usize] != 0 {
                continue;
            }
            let mut enter = Some(*root);
            loop {
                budget.work()?;
                if let Some(node) = enter.take() {
                    visited += 1;
                    (self.order[node as usize], self.low[node as usize]) = (visited, visited);
                    stack.push(node);
                    path.push((node, edges.edges_of(node)));
                }
                let Some((node, rest)) = path.last_mut() else { break };
                let node = *node;
                while enter.is_none() {
                    let Some(edge) = rest.next() else { break };
                    let target = edges.target(edge);
                    if self.region[target as usize] != problem.region || edges.marks(edge).meets(problem.avoided) {
                        continue;
                    }
                    match self.order[target as usize] {
                        0 => enter = Some(target),
                        _ if self.low[target as usize] == CLOSED => {}
                        order => self.low[node as usize] = self.low[node as usize].min(order),
                    }
                }
                if enter.is_some() {
                    continue;
                }
                path.pop();
                let low = self.low[node as usize];
                if let Some((parent, _)) = path.last() {
                    self.low[*parent as usize] = self.low[*parent as usize].min(low);
                }
                if low == self.order[node as usize] {
                    let from = stack.iter().rposition(|other| *other == node).unwrap_or(0);
                    let component = stack.split_off(from);
                    component.iter().for_each(|node| self.low[*node as usize] = CLOSED);
                    if component.len() > 1 || self.leads_to_itself(edges, node, problem.avoided) {
                        found.push(component);
                    }
                }
            }
        }
        Ok(found)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::temporal::budget::Allowance;

    /// Edges with their targets and marks, by node.
    struct Rows(Vec<Vec<(u32, u128)>>);

    impl Edges for Rows {
        fn nodes(&self) -> usize {
            self.0.len()
        }
        fn edges_of(&self, node: u32) -> Range<usize> {
            let before: usize = self.0[..node as usize].iter().map(Vec::len).sum();
            before..before + self.0[node as usize].len()
        }
        fn target(&self, edge: usize) -> u32 {
            self.0.iter().flatten().nth(edge).expect("an edge").0
        }
        fn marks(&self, edge: usize) -> Marks {
            Marks(self.0.iter().flatten().nth(edge).expect("an edge").1)
        }
    }

    fn check(rows: Vec<Vec<(u32, u128)>>, again: u128, pairs: &[(u128, u128)], expected: &[&[u32]]) {
        let pairs = pairs.iter().map(|(first, second)| (Marks(*first), Marks(*second))).collect();
        let acceptance = Acceptance { again: Marks(again), pairs };
        let rows = Rows(rows);
        let mut go_on = || false;
        let mut budget = Budget::new(Allowance::default(), &mut go_on);
        let mut found = Vec::new();
        accepting_components(&rows, &StateSet::all(rows.nodes()), &acceptance, &mut budget, |component| {
            found.push(component.nodes);
            ControlFlow::Continue(())
        })
        .expect("nobody stops it");
        found.sort();
        assert_eq!(found, expected);
    }

    #[test]
    fn a_component_has_all_that_must_come_up() {
        let ring = || vec![vec![(1, 1)], vec![(0, 0), (2, 2)], vec![(2, 0)]];
        check(ring(), 0, &[], &[&[0, 1], &[2]]);
        check(ring(), 1, &[], &[&[0, 1]]);
        check(ring(), 2, &[], &[]);
    }

    #[test]
    fn what_is_avoided_counts_no_more() {
        // Two cycles: one has the required mark 1, and the mark 2, which requires 4; the other has neither.
        let rows = || vec![vec![(1, 1 | 2), (1, 0)], vec![(0, 0)]];
        check(rows(), 0, &[(2, 4)], &[&[0, 1]]);
        check(rows(), 1, &[], &[&[0, 1]]);
        check(rows(), 1, &[(2, 4)], &[]);
        check(rows(), 1, &[(2, 1)], &[&[0, 1]]);
    }
}
