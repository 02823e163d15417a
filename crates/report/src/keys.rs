//! The keys of a report specification, by the mapping in which they stand: what its reader accepts, and what an editor proposes.
//!
//! In: nothing. Out: words. INVARIANT: no other place lists them.

/// Of the whole file.
pub const ROOT: [&str; 12] = [
    "title",
    "note",
    "tick",
    "window",
    "activities",
    "tasks",
    "buffers",
    "queues",
    "values",
    "series",
    "flow",
    "charts",
];
/// Of a group of lanes.
pub const GROUP: [&str; 3] = ["each", "terms", "counters"];
/// A series.
pub const SERIES: [&str; 4] = ["caption", "value", "unit", "bound"];
/// What the unit of a series can be.
pub const UNITS: [&str; 2] = ["ticks", "number"];
/// The way of data.
pub const FLOW: [&str; 2] = ["noun", "hops"];
/// One of its hops.
pub const HOP: [&str; 3] = ["task", "event", "value"];
/// A chart.
pub const CHART: [&str; 2] = ["each", "machines"];
/// A machine of a chart.
pub const MACHINE: [&str; 1] = ["when"];

/// A group of lanes: the keys of an entry that are texts, and those that are terms.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Lanes {
    /// Its key in the file.
    pub group: &'static str,
    /// Texts.
    pub told: &'static [&'static str],
    /// Terms.
    pub terms: &'static [&'static str],
}

/// Tasks.
pub const TASKS: Lanes = Lanes {
    group: "tasks",
    told: &["name", "caption"],
    terms: &["activity", "period", "deadline", "may_miss", "release", "cycles", "met", "missed", "skipped"],
};
/// Buffers.
pub const BUFFERS: Lanes = Lanes {
    group: "buffers",
    told: &["from", "to"],
    terms: &["arrays", "writing", "reading", "write_index", "read_index", "lock", "swaps"],
};
/// Queues.
pub const QUEUES: Lanes = Lanes { group: "queues", told: &["from", "to"], terms: &["length", "capacity"] };
/// Shared values.
pub const VALUES: Lanes = Lanes { group: "values", told: &["from", "to"], terms: &["unread"] };

/// All groups of lanes.
pub const LANES: [Lanes; 4] = [TASKS, BUFFERS, QUEUES, VALUES];
