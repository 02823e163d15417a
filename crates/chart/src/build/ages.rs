//! The part of a ground model that follows how old data get: hops, ways, and an invariant for each age bound.
//!
//! In: a system without errors. Out: elements, their configuration and initial values for `patterns/DataAges`. A hop is a channel as a
//! part of a way; ways of one bound that begin alike share their first hops.

use crate::system::{Action, AgeBound, ChannelKind, System};
use crate::ways::{accessed, prepared, ways};

use super::table::{by_case, waiting};

/// What follows the ages of a system.
pub(super) struct Ages {
    hops: Vec<Hop>,
    ways: Vec<Way>,
}

struct Hop {
    name: String,
    before: Option<usize>,
    channel: usize,
}

struct Way {
    name: String,
    bound: usize,
    hop: Option<usize>,
    end: usize,
}

impl Ages {
    pub(super) fn of(system: &System) -> Ages {
        let mut ages = Ages { hops: Vec::new(), ways: Vec::new() };
        for (bound, stated) in system.bounds.iter().enumerate() {
            let first = ages.hops.len();
            for (number, (start, channels)) in ways(system, stated).into_iter().enumerate() {
                let mut hop: Option<usize> = None;
                for channel in channels.iter().copied() {
                    let known = (first..ages.hops.len())
                        .find(|index| (ages.hops[*index].before, ages.hops[*index].channel) == (hop, channel));
                    hop = Some(known.unwrap_or_else(|| {
                        let name = format!("bound{}_hop{}", bound + 1, ages.hops.len() - first + 1);
                        ages.hops.push(Hop { name, before: hop, channel });
                        ages.hops.len() - 1
                    }));
                }
                let end = channels.last().map_or(start, |channel| system.channels[*channel].to);
                let name = format!("bound{}_way{}", bound + 1, number + 1);
                ages.ways.push(Way { name, bound, hop, end });
            }
        }
        ages
    }

    /// The ways: their names, and the number of the bound of each.
    pub(super) fn ways(&self) -> impl Iterator<Item = (&str, usize)> {
        self.ways.iter().map(|way| (way.name.as_str(), way.bound))
    }

    /// The elements, with their domains.
    pub(super) fn elements(&self) -> Vec<(String, &'static str)> {
        let hops = self.hops.iter().map(|hop| (hop.name.clone(), "AgeHop"));
        hops.chain(self.ways.iter().map(|way| (way.name.clone(), "AgeWay"))).collect()
    }

    /// The invariant of each bound: its name and its text.
    pub(super) fn invariants(&self, system: &System) -> Vec<(String, String)> {
        let each = |(index, bound): (usize, &AgeBound)| {
            let name = bound.invariant();
            let ways = self.ways.iter().filter(|way| way.bound == index);
            let all: Vec<String> = ways.map(|way| format!("way_tooOld({}) = 0", way.name)).collect();
            let text = format!("invariant {name} over way_tooOld: {}\n", all.join(" and "));
            (name, text)
        };
        system.bounds.iter().enumerate().map(each).collect()
    }

    /// Configuration and initial values.
    pub(super) fn define(&self, system: &System, define: &mut impl FnMut(&str, &str)) {
        let phase = |component: usize, written: Option<usize>| {
            let written = written.and_then(|channel| accessed(system, component, &Action::Write(channel)));
            let decided = prepared(system, component, written);
            decided.map_or("undef".to_string(), |at| system.components[component].phases[at].name.clone())
        };
        let hops = |value: &dyn Fn(&Hop) -> String| -> String {
            by_case("$h", &self.hops.iter().map(|hop| (hop.name.clone(), value(hop))).collect::<Vec<_>>())
        };
        let channel = |hop: &Hop, of: fn(ChannelKind) -> bool| {
            let channel = &system.channels[hop.channel];
            if of(channel.kind) { channel.name.clone() } else { "undef".to_string() }
        };
        let hop = |index: Option<usize>| index.map_or("undef".to_string(), |index| self.hops[index].name.clone());
        let writer = |hop: &Hop| system.channels[hop.channel].from;
        define("hop_before($h in AgeHop)", &hops(&|one| hop(one.before)));
        define("hop_writer($h in AgeHop)", &hops(&|one| system.components[writer(one)].name.clone()));
        define("hop_decided($h in AgeHop)", &hops(&|one| phase(writer(one), Some(one.channel))));
        define(
            "hop_buffer($h in AgeHop)",
            &hops(&|one| channel(one, |kind| matches!(kind, ChannelKind::Buffer { .. }))),
        );
        define("hop_queue($h in AgeHop)", &hops(&|one| channel(one, |kind| matches!(kind, ChannelKind::Queue { .. }))));
        define("hop_value($h in AgeHop)", &hops(&|one| channel(one, |kind| kind == ChannelKind::Shared)));
        let ways = |value: &dyn Fn(&Way) -> String| -> String {
            by_case("$w", &self.ways.iter().map(|way| (way.name.clone(), value(way))).collect::<Vec<_>>())
        };
        define("way_hop($w in AgeWay)", &ways(&|way| hop(way.hop)));
        define("way_end($w in AgeWay)", &ways(&|way| system.components[way.end].name.clone()));
        define("way_decided($w in AgeWay)", &ways(&|way| phase(way.end, None)));
        define("way_limit($w in AgeWay)", &ways(&|way| system.bounds[way.bound].limit.to_string()));
        let begin: Vec<_> = system.components.iter().map(|one| (one.name.clone(), waiting(one))).collect();
        define("phaseBefore($c in Scheduler)", &by_case("$c", &begin));
        for name in ["written", "read"] {
            define(&format!("hop_{name}($h in AgeHop)"), "0");
        }
        for name in ["oldest", "tooOld"] {
            define(&format!("way_{name}($w in AgeWay)"), "0");
        }
    }
}
