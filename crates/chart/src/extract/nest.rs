//! Finds composite states: control states in which the same tests come first and lead to the same.
//!
//! In: what a rule does in each control state. Out: the same with regions. What the states of a region do alike before anything else is
//! the region's path, and each keeps what it does otherwise. What is done on all ways into a region is done on entry, what is done on
//! all ways out of it on exit; a location that every way out sets to the state that is left is the region's history.
//!
//! That the result means the same is not relied upon: its chart is held to the rule ([`agrees`](super::agrees)).

use std::collections::{BTreeMap, BTreeSet};

use super::Trees;
use super::decisions::{Leaf, Tree};
use super::graph::{Graph, Node};
use super::region::{Region, is_within};
use super::shapes::is_application;
use crate::symbolic::Reason;

/// LIMIT: how many pairs of parts are compared; beyond that nothing more is found.
const MAX_WORK: usize = 2_000_000;

/// LIMIT: the most tests of which each is tried as the first one.
const MAX_TESTS: usize = 40;

/// What a remembering update sets its location to: the state that is left. No text of a model has it.
const LEFT: &str = "\u{0}";

/// The same with regions; `None` if there are none.
pub(super) fn nested<'c>(trees: Trees<'c>) -> Result<Option<Trees<'c>>, Reason> {
    let mut several: BTreeMap<&str, usize> = BTreeMap::new();
    trees.starts.iter().for_each(|(value, _)| *several.entry(value).or_default() += 1);
    let single = |value: &String| several[value.as_str()] == 1;
    let torn = trees.starts.iter().filter(|(value, _)| !single(value)).cloned().collect();
    let mut nester = Nester { graph: trees.graph.roomy(), own: BTreeMap::new(), torn, regions: Vec::new(), work: 0 };
    for (value, node) in trees.starts.iter().filter(|(value, _)| single(value)) {
        let marked = nester.marked(*node, value)?;
        nester.own.insert(value.clone(), Some(marked));
    }
    let states: Vec<String> = trees.starts.iter().map(|(value, _)| value.clone()).filter(single).collect();
    nester.split(&states, None)?;
    if nester.regions.is_empty() {
        return Ok(None);
    }
    if let Some(first) = trees.first()
        && !nester.begins(first)
    {
        return Ok(None);
    }
    let mut enter = trees.enter.clone();
    nester.find_returns(&mut enter)?;
    nester.find_beginnings(&mut enter)?;
    nester.find_actions(&mut enter)?;
    for value in &states {
        if let Some(node) = nester.own[value] {
            let told = nester.told(node, value)?;
            nester.own.insert(value.clone(), Some(told));
        }
    }
    let mut torn = nester.torn.iter().map(|(_, node)| *node);
    let mut starts: Vec<(String, usize)> = Vec::new();
    for (value, _) in &trees.starts {
        let node = if single(value) { nester.own[value] } else { torn.next() };
        starts.extend(node.map(|node| (value.clone(), node)));
    }
    drop(torn);
    let paths = nester.regions.iter().map(|region| region.path);
    let roots: Vec<usize> = enter.iter().copied().chain(paths).chain(starts.iter().map(|(_, node)| *node)).collect();
    let (graph, roots) = nester.graph.only(&roots)?;
    let (entered, rest) = roots.split_at(enter.len());
    let (paths, begun) = rest.split_at(nester.regions.len());
    nester.regions.iter_mut().zip(paths).for_each(|(region, path)| region.path = *path);
    starts.iter_mut().zip(begun).for_each(|((_, node), root)| *node = *root);
    // Nobody is left who says where a path went that left a state.
    let is_marked = |node: &Node| matches!(node, Node::Action(text, _) if text.ends_with(LEFT));
    if graph.nodes.iter().any(is_marked) {
        return Ok(None);
    }
    Ok(Some(Trees { graph, enter: entered.to_vec(), starts, regions: nester.regions, ..trees }))
}

/// States that do the same first.
struct Alike {
    /// What they do first, with nothing where each goes its own way.
    path: usize,
    /// The states, and what each does otherwise.
    members: Vec<(String, Option<usize>)>,
}

/// Regions, and the states in which they begin.
type Begins = Vec<(usize, String)>;

struct Nester<'c> {
    graph: Graph<'c>,
    /// What each state does that no region around it does.
    own: BTreeMap<String, Option<usize>>,
    /// What is done in states whose updates clash: they stand in no region.
    torn: Vec<(String, usize)>,
    regions: Vec<Region>,
    work: usize,
}

impl Nester<'_> {
    /// Finds the regions among some states, from the outside in.
    fn split(&mut self, states: &[String], around: Option<usize>) -> Result<(), Reason> {
        let mut open = states.to_vec();
        while let Some((alike, history)) = self.best(&open, around.map(|_| states.len()))? {
            let states: Vec<String> = alike.members.iter().map(|(value, _)| value.clone()).collect();
            open.retain(|value| !states.contains(value));
            let region = self.regions.len();
            self.own.extend(alike.members);
            self.regions.push(Region {
                around,
                states: states.clone(),
                path: alike.path,
                history,
                entry: Vec::new(),
                exit: Vec::new(),
                initial: None,
            });
            self.split(&states, Some(region))?;
        }
        Ok(())
    }

    /// The states that have most in common; fewer than `below`, if that is given.
    fn best(&mut self, open: &[String], below: Option<usize>) -> Result<Option<(Alike, Option<String>)>, Reason> {
        let mut found = self.alike(open)?;
        found.retain(|alike| below.is_none_or(|below| alike.members.len() < below));
        // More states come first; of as many, those that ask in the order of the rule.
        found.sort_by_key(|alike| std::cmp::Reverse(alike.members.len()));
        for mut alike in found {
            self.go_on(&mut alike)?;
            if let Some(history) = self.history(&mut alike)? {
                return Ok(Some((alike, history)));
            }
        }
        Ok(None)
    }

    /// States that do the same first, as often as there are some.
    fn alike(&mut self, open: &[String]) -> Result<Vec<Alike>, Reason> {
        let trees: Vec<(String, Option<usize>)> =
            open.iter().map(|value| (value.clone(), self.own[value])).filter(|(_, tree)| tree.is_some()).collect();
        let tests: BTreeSet<String> = trees.iter().flat_map(|(_, tree)| self.graph.atoms(*tree)).collect();
        let mut orders: Vec<Option<&String>> = vec![None];
        orders.extend(tests.iter().filter(|_| tests.len() <= MAX_TESTS).map(Some));
        let mut found: Vec<Alike> = Vec::new();
        for first in orders {
            let mut trees = trees.clone();
            if let Some(first) = first {
                for (_, tree) in &mut trees {
                    *tree = self.graph.asking(*tree, first)?;
                }
                trees.retain(|(_, tree)| tree.is_some());
            }
            let mut paths: BTreeSet<usize> = BTreeSet::new();
            for (index, (_, one)) in trees.iter().enumerate() {
                for (_, other) in &trees[index + 1..] {
                    if one != other
                        && let Some(Some(path)) = self.common(*one, *other, &mut None)?
                        && paths.insert(path)
                    {
                        let members = trees.iter().filter_map(|(value, tree)| {
                            let mut hole = None;
                            let fits = self.graph.fits(Some(path), *tree, &mut hole);
                            hole.filter(|_| fits).map(|rest| (value.clone(), rest))
                        });
                        let alike = Alike { path, members: members.collect() };
                        if self.is_lively(&alike) {
                            found.push(alike);
                        }
                    }
                }
            }
        }
        Ok(found)
    }

    /// What the states do alike behind what they do alike.
    fn go_on(&mut self, alike: &mut Alike) -> Result<(), Reason> {
        loop {
            let kept: Vec<(String, Option<usize>)> =
                alike.members.iter().map(|(value, _)| (value.clone(), self.own[value])).collect();
            self.own.extend(alike.members.iter().cloned());
            let states: Vec<String> = kept.iter().map(|(value, _)| value.clone()).collect();
            let more = self.alike(&states);
            self.own.extend(kept);
            let Some(more) = more?.into_iter().find(|more| more.members.len() == states.len()) else { return Ok(()) };
            alike.path = self.graph.filled(alike.path, more.path)?;
            alike.members = more.members;
        }
    }

    /// Whether the states are worth a frame: something else happens in them, or there are many.
    fn is_lively(&self, alike: &Alike) -> bool {
        let rests: BTreeSet<Option<usize>> = alike.members.iter().map(|(_, rest)| *rest).collect();
        let holds = |value: &str| alike.members.iter().any(|(held, _)| held == value);
        let goes_on = |(from, rest): &(String, Option<usize>)| {
            let is_other = |leaf: &Leaf| self.target(leaf.1).is_some_and(|to| to != from && holds(to));
            rest.is_some_and(|rest| self.graph.leaves(rest).iter().any(is_other))
        };
        alike.members.len() > 1 && rests.len() > 1 && (alike.members.len() > 2 || alike.members.iter().any(goes_on))
    }

    /// The location that remembers which state is left, if there is one; nothing if some ways out remember and others do not. What
    /// remembers is taken out of the paths.
    fn history(&mut self, alike: &mut Alike) -> Result<Option<Option<String>>, Reason> {
        let memories =
            |leaf: &Leaf| -> BTreeSet<String> { leaf.0.iter().filter(|text| text.ends_with(LEFT)).cloned().collect() };
        let of_path: BTreeSet<BTreeSet<String>> = self.graph.leaves(alike.path).iter().map(memories).collect();
        let Some(memory) = of_path.first().filter(|first| of_path.len() == 1 && first.len() < 2) else {
            return Ok(None);
        };
        let Some(memory) = memory.first().cloned() else { return Ok(Some(None)) };
        let states: Vec<String> = alike.members.iter().map(|(value, _)| value.clone()).collect();
        for (_, rest) in &alike.members {
            let leaves = rest.map(|rest| self.graph.leaves(rest)).unwrap_or_default();
            let is_right = |leaf: &Leaf| {
                let stays = self.target(leaf.1).is_some_and(|to| states.iter().any(|held| held == to));
                leaf.0.contains(&memory) != stays
            };
            if !leaves.iter().all(is_right) {
                return Ok(None);
            }
        }
        let mut without = |(actions, to): Leaf| (actions.into_iter().filter(|text| *text != memory).collect(), to);
        alike.path = self.graph.mapped(alike.path, &mut without)?;
        for (_, rest) in &mut alike.members {
            if let Some(tree) = rest {
                *rest = Some(self.graph.mapped(*tree, &mut without)?);
            }
        }
        Ok(memory.strip_suffix(&format!(" := {LEFT}")).map(|location| Some(location.to_string())))
    }

    /// Lets all regions around a state begin there; `false` if one of them begins elsewhere.
    fn begins(&mut self, first: &str) -> bool {
        let mut around = self.regions.iter_mut().filter(|region| region.states.iter().any(|held| held == first));
        around.all(|region| *region.initial.get_or_insert_with(|| first.to_string()) == first)
    }

    /// The control state that a leaf leads to.
    fn target(&self, node: usize) -> Option<&str> {
        match &self.graph.nodes[node] {
            Node::Target(value) => Some(value),
            Node::Region(_) | Node::Guard(..) | Node::Action(..) => None,
        }
    }

    /// Whether a leaf leads into a region.
    fn enters(&self, leaf: &Leaf, region: usize) -> bool {
        match &self.graph.nodes[leaf.1] {
            Node::Target(value) => self.regions[region].states.contains(value),
            Node::Region(inner) => is_within(&self.regions, *inner, region),
            Node::Guard(..) | Node::Action(..) => false,
        }
    }

    /// Tests of where a region was left, on ways into it, become ways to the region.
    fn find_returns(&mut self, enter: &mut [usize]) -> Result<(), Reason> {
        for region in 0..self.regions.len() {
            let Some(memory) = self.regions[region].history.clone() else { continue };
            for node in enter.iter_mut() {
                *node = self.returning(*node, region, &memory)?;
            }
            for other in 0..self.regions.len() {
                if other != region && self.is_inside(other, region) {
                    continue;
                }
                self.regions[other].path = self.returning(self.regions[other].path, region, &memory)?;
            }
            let outside = self.own.iter().filter(|(value, _)| !self.regions[region].states.contains(value));
            for (value, node) in outside.map(|(value, node)| (value.clone(), *node)).collect::<Vec<_>>() {
                let node = node.map(|node| self.returning(node, region, &memory)).transpose()?;
                self.own.insert(value, node);
            }
        }
        Ok(())
    }

    fn is_inside(&self, inner: usize, outer: usize) -> bool {
        is_within(&self.regions, inner, outer)
    }

    fn returning(&mut self, node: usize, region: usize, memory: &str) -> Result<usize, Reason> {
        if let Some((actions, begins)) = self.returns(node, region, memory) {
            for (region, first) in begins {
                self.regions[region].initial = Some(first);
            }
            let target = self.graph.node(Node::Region(region))?;
            return self.graph.chain(&actions, target);
        }
        match self.graph.nodes[node].clone() {
            Node::Guard(atom, yes, no) => {
                let yes = yes.map(|yes| self.returning(yes, region, memory)).transpose()?;
                let no = no.map(|no| self.returning(no, region, memory)).transpose()?;
                self.graph.node(Node::Guard(atom, yes, no))
            }
            Node::Action(..) | Node::Target(_) | Node::Region(_) => Ok(node),
        }
    }

    /// What is done, and where regions begin, if the tests from here ask for each state of a region whether it was left there.
    fn returns(&self, node: usize, region: usize, memory: &str) -> Option<(Vec<String>, Begins)> {
        let states = &self.regions[region].states;
        let mut asked: BTreeMap<&str, Leaf> = BTreeMap::new();
        let mut node = node;
        while let Node::Guard(atom, Some(yes), Some(no)) = &self.graph.nodes[node] {
            let value = atom.strip_prefix(memory)?.strip_prefix(" = ")?;
            asked.insert(states.iter().find(|held| *held == value)?, self.graph.ending(*yes)?);
            node = *no;
        }
        let (actions, first) = self.graph.ending(node)?;
        let first = self.target(first).filter(|first| states.iter().any(|held| held == first))?;
        if asked.is_empty() {
            return None;
        }
        let mut begins: BTreeMap<usize, &str> = BTreeMap::from([(region, first)]);
        for value in states {
            let to = match asked.get(value.as_str()) {
                Some(leaf) if leaf.0 == actions => self.target(leaf.1)?,
                Some(_) => return None,
                None => first,
            };
            // Where a region in it was left, that one begins anew; another state goes on.
            let inside = |inner: usize, value: &str| {
                inner != region
                    && self.is_inside(inner, region)
                    && self.regions[inner].states.iter().any(|held| held == value)
            };
            let child = (0..self.regions.len())
                .find(|inner| inside(*inner, value) && self.regions[*inner].around == Some(region));
            match child {
                None if value != to => return None,
                Some(child) if !inside(child, to) => return None,
                _ => {}
            }
            for inner in (0..self.regions.len()).filter(|inner| inside(*inner, to)) {
                let is_other = *begins.entry(inner).or_insert(to) != to;
                if is_other || self.regions[inner].history.is_some() {
                    return None;
                }
            }
        }
        let differs = |(region, first): (&usize, &&str)| {
            self.regions[*region].initial.as_deref().is_some_and(|known| known != *first)
        };
        if begins.iter().any(differs) {
            return None;
        }
        Some((actions, begins.into_iter().map(|(region, first)| (region, first.to_string())).collect()))
    }

    /// What is done on all ways into a region, and on all ways out of it, if there are several.
    fn find_actions(&mut self, enter: &mut [usize]) -> Result<(), Reason> {
        for region in 0..self.regions.len() {
            let entry = self.done_alike(region, enter, true);
            self.drop_actions(region, enter, true, &entry)?;
            self.regions[region].entry = entry;
            // A path from around it leaves states that are not in it, too.
            if self.regions[region].around.is_none() {
                let exit = self.done_alike(region, enter, false);
                self.drop_actions(region, enter, false, &exit)?;
                self.regions[region].exit = exit;
            }
        }
        Ok(())
    }

    /// Whether a path that starts in a state, a region or at the entering arrow goes into a region, or out of it.
    fn passes(&self, from: &Source, leaf: &Leaf, region: usize, into: bool) -> bool {
        let is_inside = match from {
            Source::Enter | Source::Torn(_) => false,
            Source::State(value) => self.regions[region].states.contains(value),
            Source::Region(inner) => *inner != region && self.is_inside(*inner, region),
        };
        let enters = self.enters(leaf, region);
        match (into, from) {
            (true, _) => enters && !is_inside,
            (false, Source::Region(own)) if *own == region => true,
            (false, _) => is_inside && !enters,
        }
    }

    fn sources(&self, enter: &[usize]) -> Vec<(Source, usize)> {
        let entered = enter.iter().map(|node| (Source::Enter, *node));
        let regions = self.regions.iter().enumerate().map(|(index, region)| (Source::Region(index), region.path));
        let states = self.own.iter().filter_map(|(value, node)| Some((Source::State(value.clone()), (*node)?)));
        let torn = self.torn.iter().enumerate().map(|(index, (_, node))| (Source::Torn(index), *node));
        entered.chain(regions).chain(states).chain(torn).collect()
    }

    /// What is done on the ways into a region, or out of it, and where they lead.
    fn ways(&self, region: usize, enter: &[usize], into: bool) -> Vec<Leaf> {
        let of_source = |(from, node): (Source, usize)| {
            let leaves = self.graph.leaves(node).into_iter();
            leaves.filter(|leaf| self.passes(&from, leaf, region, into)).collect::<Vec<Leaf>>()
        };
        self.sources(enter).into_iter().flat_map(of_source).collect()
    }

    fn done_alike(&self, region: usize, enter: &[usize], into: bool) -> Vec<String> {
        let ways = self.ways(region, enter, into);
        let Some(first) = ways.first().filter(|_| ways.len() > 1) else { return Vec::new() };
        let in_all = |text: &&String| ways.iter().all(|way| way.0.contains(text)) && !text.ends_with(LEFT);
        first.0.iter().filter(in_all).cloned().collect()
    }

    fn drop_actions(&mut self, region: usize, enter: &mut [usize], into: bool, done: &[String]) -> Result<(), Reason> {
        let without = |leaf: Leaf| (leaf.0.into_iter().filter(|text| !done.contains(text)).collect(), leaf.1);
        if done.is_empty() { Ok(()) } else { self.change_ways(region, enter, into, &without) }
    }

    /// Puts other ends to the ways into a region, or out of it.
    fn change_ways(
        &mut self,
        region: usize,
        enter: &mut [usize],
        into: bool,
        end: &dyn Fn(Leaf) -> Leaf,
    ) -> Result<(), Reason> {
        for (index, (from, node)) in self.sources(enter).into_iter().enumerate() {
            let passing: BTreeSet<Leaf> =
                self.graph.leaves(node).into_iter().filter(|leaf| self.passes(&from, leaf, region, into)).collect();
            let mut changed = |leaf: Leaf| if passing.contains(&leaf) { end(leaf) } else { leaf };
            let node = self.graph.mapped(node, &mut changed)?;
            match from {
                Source::Enter => enter[index] = node,
                Source::Region(index) => self.regions[index].path = node,
                Source::State(value) => _ = self.own.insert(value, Some(node)),
                Source::Torn(index) => self.torn[index].1 = node,
            }
        }
        Ok(())
    }

    /// Ways into a region that all lead to one state lead to the region, which begins there.
    fn find_beginnings(&mut self, enter: &mut [usize]) -> Result<(), Reason> {
        // What stands in another region comes first: it may be where that one begins.
        for region in (0..self.regions.len()).rev() {
            if self.regions[region].history.is_some() {
                continue;
            }
            let ends: BTreeSet<usize> = self.ways(region, enter, true).into_iter().map(|(_, end)| end).collect();
            let Some(end) = ends.first().copied().filter(|_| ends.len() == 1) else { continue };
            let first = match &self.graph.nodes[end] {
                Node::Target(value) => Some(value.clone()),
                Node::Region(inner) => {
                    self.regions[*inner].initial.clone().filter(|_| self.regions[*inner].history.is_none())
                }
                Node::Guard(..) | Node::Action(..) => None,
            };
            let Some(first) = first else { continue };
            let inner = |inner: &usize| self.is_inside(*inner, region) && self.regions[*inner].states.contains(&first);
            let all: Vec<usize> = (0..self.regions.len()).filter(inner).collect();
            let begins_elsewhere =
                |inner: &usize| self.regions[*inner].initial.as_ref().is_some_and(|known| *known != first);
            if all.iter().any(begins_elsewhere) || all.iter().any(|inner| self.regions[*inner].history.is_some()) {
                continue;
            }
            for inner in all {
                self.regions[inner].initial = Some(first.clone());
            }
            let target = self.graph.node(Node::Region(region))?;
            self.change_ways(region, enter, true, &|leaf| (leaf.0, target))?;
        }
        Ok(())
    }

    /// Updates of a location to the state that is left say so.
    fn marked(&mut self, node: usize, state: &str) -> Result<usize, Reason> {
        let remembers = |text: &String| {
            let location = text.strip_suffix(state)?.strip_suffix(" := ")?;
            is_application(location).then(|| format!("{location} := {LEFT}"))
        };
        self.graph.mapped(node, &mut |(actions, to)| {
            (actions.into_iter().map(|text| remembers(&text).unwrap_or(text)).collect(), to)
        })
    }

    /// The opposite.
    fn told(&mut self, node: usize, state: &str) -> Result<usize, Reason> {
        self.graph.mapped(node, &mut |(actions, to)| {
            (actions.into_iter().map(|text| text.replace(LEFT, state)).collect(), to)
        })
    }

    /// What two trees do alike, with nothing at the places where both go their own ways, `hole`; these must be the same
    /// everywhere.
    fn common(&mut self, one: Tree, other: Tree, hole: &mut Option<(Tree, Tree)>) -> Result<Option<Tree>, Reason> {
        self.work += 1;
        if self.work > MAX_WORK {
            return Ok(None);
        }
        if let (Some(node), true) = (one, one == other)
            && self.graph.is_closed(node)
        {
            return Ok(Some(one));
        }
        if let (Some(left), Some(right)) = (one, other)
            && let (Node::Guard(atom, yes, no), Node::Guard(test, right_yes, right_no)) =
                (self.graph.nodes[left].clone(), self.graph.nodes[right].clone())
            && atom == test
        {
            let kept = *hole;
            if let Some(yes) = self.common(yes, right_yes, hole)?
                && let Some(no) = self.common(no, right_no, hole)?
                && (yes, no) != (None, None)
            {
                return self.graph.node(Node::Guard(atom, yes, no)).map(|node| Some(Some(node)));
            }
            *hole = kept;
        }
        Ok((*hole.get_or_insert((one, other)) == (one, other)).then_some(None))
    }
}

/// Where paths start.
enum Source {
    Enter,
    State(String),
    /// A state whose updates clash.
    Torn(usize),
    Region(usize),
}
