//! Finds a short accepted lasso: a stem from a start, and a cycle that repeats forever.
//!
//! In: edges, the allowed nodes, the acceptance condition. Out: the edges of stem and cycle. The stem to each node is
//! shortest; the nearest nodes of each accepting component are tried as the beginning of the cycle, and the shortest
//! lasso wins.

use std::ops::ControlFlow;

use crate::graph::StateSet;
use crate::temporal::budget::{Budget, Spent};
use crate::temporal::component::{Acceptance, Component, Edges, accepting_components};
use crate::temporal::search::{Finder, turn};

/// LIMIT: how many places of a component are tried, and how many nodes may be visited for trying more than the first.
const PLACES: usize = 64;
const EFFORT: u64 = 4_000_000;

/// The edges of a lasso.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Lasso {
    /// The node it starts with.
    pub start: u32,
    /// From the start to the cycle.
    pub stem: Vec<usize>,
    /// The cycle: at least one edge.
    pub turn: Vec<usize>,
}

/// A short accepted lasso that starts in one of the nodes and stays within a set; `None` if there is no accepted one.
///
/// # Errors
/// The caller asked to stop.
pub fn accepted_lasso(
    edges: &impl Edges,
    starts: &[u32],
    within: &StateSet,
    acceptance: &Acceptance,
    budget: &mut Budget<'_>,
) -> Result<Option<Lasso>, Spent> {
    let starts: Vec<u32> = starts.iter().copied().filter(|start| within.contains(*start)).collect();
    let Reached { set, distance } = reach(edges, &starts, within, budget)?;
    let mut components = Vec::new();
    accepting_components(edges, &set, acceptance, budget, |component| {
        components.push(component);
        ControlFlow::Continue(())
    })?;
    let mut finder = Finder::new(edges);
    let Some((node, turn)) = shortest(&mut finder, &components, &distance, acceptance, budget)? else {
        return Ok(None);
    };
    if starts.contains(&node) {
        return Ok(Some(Lasso { start: node, stem: Vec::new(), turn }));
    }
    let found = finder.path(&starts, budget, |_, target| within.contains(target), |_, target| target == node)?;
    let (start, stem) = found.expect("the node was reached");
    Ok(Some(Lasso { start, stem, turn }))
}

fn shortest<E: Edges>(
    finder: &mut Finder<'_, E>,
    components: &[Component],
    distance: &[u32],
    acceptance: &Acceptance,
    budget: &mut Budget<'_>,
) -> Result<Option<(u32, Vec<usize>)>, Spent> {
    let mut places: Vec<(u32, usize, u32)> = Vec::new();
    for (index, component) in components.iter().enumerate() {
        let mut nodes: Vec<(u32, u32)> = component.nodes.iter().map(|node| (distance[*node as usize], *node)).collect();
        nodes.sort_unstable();
        places.extend(nodes.iter().take(PLACES).map(|(distance, node)| (*distance, index, *node)));
    }
    places.sort_unstable();
    let mut best: Option<(usize, u32, Vec<usize>)> = None;
    for (distance, index, node) in places {
        if best.as_ref().is_some_and(|(length, ..)| finder.work > EFFORT || distance as usize + 1 >= *length) {
            break;
        }
        let turn = turn(finder, &components[index], acceptance, node, budget)?;
        let length = distance as usize + turn.len();
        if best.as_ref().is_none_or(|(shortest, ..)| length < *shortest) {
            best = Some((length, node, turn));
        }
    }
    Ok(best.map(|(_, node, turn)| (node, turn)))
}

struct Reached {
    set: StateSet,
    /// For each node; meaningless if it was not reached.
    distance: Vec<u32>,
}

fn reach(edges: &impl Edges, starts: &[u32], within: &StateSet, budget: &mut Budget<'_>) -> Result<Reached, Spent> {
    let mut set = StateSet::none(edges.nodes());
    let mut distance = vec![0; edges.nodes()];
    let mut queue: Vec<u32> = starts.iter().copied().filter(|start| set.insert(*start)).collect();
    let mut next = 0;
    while let Some(node) = queue.get(next).copied() {
        next += 1;
        budget.work()?;
        for edge in edges.edges_of(node) {
            let target = edges.target(edge);
            if within.contains(target) && set.insert(target) {
                distance[target as usize] = distance[node as usize] + 1;
                queue.push(target);
            }
        }
    }
    Ok(Reached { set, distance })
}
