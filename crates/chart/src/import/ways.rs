//! Paths of our own export, as arrows between shapes.
//!
//! In: paths, each as the names of its stops; those of one origin in the order of the export, which takes the `yes` exit of a guard
//! before its `no` exit. Out: paths over shapes of which each has one way on from each exit. Where another tool has led one of several
//! paths over a shape elsewhere, they go on differently: each of these gets a shape of its own, a copy. INVARIANT: stops of one
//! name that go on alike are one shape, so what no tool has changed is read back without copies. SYNC(scxml): `export.rs`.

use std::collections::BTreeMap;

/// A path from a control state to the next one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Way {
    /// Where it starts.
    pub from: String,
    /// Names of guards, with the exit, and of actions.
    pub stops: Vec<(String, Option<bool>)>,
    /// Where it ends.
    pub to: String,
}

/// Where an exit leads.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
enum Next {
    Nowhere,
    End(String),
    Stop(usize),
}

/// A stop with its exits: that of an action is the second one.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
struct Stop {
    name: String,
    exits: [Next; 2],
}

/// Paths as arrows.
#[derive(Debug, Default)]
pub(super) struct Arrows {
    /// Each with its exit, if it is one of a guard's.
    pub all: Vec<(String, Option<bool>, String)>,
    /// For each name on the paths its copies, itself first.
    pub copies: BTreeMap<String, Vec<String>>,
}

/// The arrows of paths; `fresh` makes another name of one that is taken.
pub(super) fn arrows(ways: &[Way], fresh: &mut dyn FnMut(&str) -> String) -> Arrows {
    let (mut stops, starts) = trees(ways);
    // Stops that are alike, from the ends of the paths to their beginnings: a stop comes before those behind it.
    let mut known: BTreeMap<Stop, usize> = BTreeMap::new();
    let mut same: Vec<usize> = (0..stops.len()).collect();
    for index in (0..stops.len()).rev() {
        for exit in &mut stops[index].exits {
            if let Next::Stop(next) = exit {
                *next = same[*next];
            }
        }
        same[index] = *known.entry(stops[index].clone()).or_insert(index);
    }
    let mut out = Arrows::default();
    let mut named: BTreeMap<usize, String> = BTreeMap::new();
    for index in (0..stops.len()).filter(|index| same[*index] == *index) {
        let name = &stops[index].name;
        let copies = out.copies.entry(name.clone()).or_default();
        let copy = if copies.is_empty() { name.clone() } else { fresh(name) };
        copies.push(copy.clone());
        named.insert(index, copy);
    }
    let end = |next: &Next| match next {
        Next::Nowhere => None,
        Next::End(name) => Some(name.clone()),
        Next::Stop(index) => named.get(&same[*index]).cloned(),
    };
    for (from, next) in &starts {
        let arrow = end(next).map(|to| (from.clone(), None, to));
        out.all.extend(arrow.filter(|arrow| !out.all.contains(arrow)));
    }
    for (index, name) in &named {
        let Stop { exits: [no, yes], name: of } = &stops[*index];
        let is_guard = ways.iter().flat_map(|way| &way.stops).any(|(stop, exit)| stop == of && exit.is_some());
        for (branch, next) in [(true, yes), (false, no)] {
            out.all.extend(end(next).map(|to| (name.clone(), is_guard.then_some(branch), to)));
        }
    }
    out
}

/// A tree for each arrow out of an origin, over all of them together; a stop comes before those behind it.
fn trees(ways: &[Way]) -> (Vec<Stop>, Vec<(String, Next)>) {
    let mut stops: Vec<Stop> = Vec::new();
    let mut starts: Vec<(String, Next)> = Vec::new();
    // The stops of the path before, in the tree.
    let mut last: Vec<usize> = Vec::new();
    for (index, way) in ways.iter().enumerate() {
        let before = index.checked_sub(1).map(|before| &ways[before]).filter(|before| before.from == way.from);
        let kept = before.map_or(0, |before| branch_off(before, way));
        last.truncate(kept);
        let mut at = kept;
        loop {
            let next = match way.stops.get(at) {
                None => Next::End(way.to.clone()),
                Some((name, _)) => {
                    stops.push(Stop { name: name.clone(), exits: [Next::Nowhere, Next::Nowhere] });
                    Next::Stop(stops.len() - 1)
                }
            };
            let is_stop = matches!(next, Next::Stop(_));
            match at.checked_sub(1) {
                None => starts.push((way.from.clone(), next)),
                Some(before) => {
                    let exit = usize::from(way.stops[before].1.unwrap_or(true));
                    stops[last[before]].exits[exit] = next;
                }
            }
            if !is_stop {
                break;
            }
            last.push(stops.len() - 1);
            at += 1;
        }
    }
    (stops, starts)
}

/// How many stops a path shares with the one before: those up to a guard that the one before left by `yes`, and this one by `no`.
fn branch_off(before: &Way, way: &Way) -> usize {
    let pairs = before.stops.iter().zip(&way.stops);
    let same = pairs.take_while(|(one, other)| one == other).count();
    match (before.stops.get(same), way.stops.get(same)) {
        (Some((one, Some(true))), Some((other, Some(false)))) if one == other => same + 1,
        _ => 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Paths as texts: `a: g+ act g- -> b`.
    fn check(texts: &[&str], expected: &[&str]) {
        let ways = texts.iter().map(|text| {
            let (from, rest) = text.split_once(": ").expect("an origin");
            let (stops, to) = rest.split_once("-> ").expect("an end");
            let stop = |stop: &str| match (stop.strip_suffix('+'), stop.strip_suffix('-')) {
                (Some(name), _) => (name.to_string(), Some(true)),
                (_, Some(name)) => (name.to_string(), Some(false)),
                _ => (stop.to_string(), None),
            };
            Way { from: from.to_string(), stops: stops.split_whitespace().map(stop).collect(), to: to.to_string() }
        });
        let ways: Vec<Way> = ways.collect();
        let mut count = 1;
        let made = arrows(&ways, &mut |name| {
            count += 1;
            format!("{name}{count}")
        });
        let sign = |branch| match branch {
            Some(true) => "+",
            Some(false) => "-",
            None => "",
        };
        let shown = made.all.iter().map(|(from, branch, to)| format!("{from}{} > {to}", sign(*branch)));
        assert_eq!(shown.collect::<Vec<_>>(), expected, "{texts:?}");
    }

    #[test]
    fn stops_that_go_on_alike_are_one_shape() {
        check(&["a: g+ f -> b", "a: g- -> c", "b: f -> b"], &["a > g", "b > f", "g+ > f", "g- > c", "f > b"]);
        check(&["a: -> b", "a: -> b", "a: -> c"], &["a > b", "a > c"]);
    }

    #[test]
    fn stops_that_go_on_differently_are_copies() {
        check(&["a: f -> b", "b: f -> c"], &["a > f", "b > f2", "f > b", "f2 > c"]);
        check(
            &["a: g+ h+ -> b", "a: g+ h- -> c", "a: g- -> c", "b: h+ -> b"],
            &["a > g", "b > h2", "g+ > h", "g- > c", "h+ > b", "h- > c", "h2+ > b"],
        );
        // Two arrows out of one state: each has paths of its own.
        check(&["a: f -> b", "a: f -> c"], &["a > f", "a > f2", "f > b", "f2 > c"]);
        check(&["a: g- -> b", "a: g+ -> b"], &["a > g", "a > g2", "g- > b", "g2+ > b"]);
    }
}
