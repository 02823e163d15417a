//! Whether the bounds that a recording states are those of the model, and can have been counted as it says.
//!
//! In: what a program says that it counted (spec/charts.md, "What the program counts"), in words, and the model's initial state. Out: the
//! first bound that the two have otherwise; which bounds were not compared, and of which the recording says nothing. Jitter, lengths of
//! elaborations, new data, missed deadlines and ages are configuration of the library's machines, so they are read where these read them.
//! The counts are the program's own: nothing here counts again, but counts that contradict each other are refused. Devices are not in the
//! model, so between which of them an age counts is not compared.

use machine::{Location, Machine, Value};
use program::Program;
use recording::{Bounded, Greatest, Recording};

use crate::vocabulary::{End, Vocabulary};

/// A bound of the model.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Modelled {
    /// What it bounds; the text says it as the program does, as far as the model knows the words.
    what: What,
    limit: Limit,
}

/// What is bounded.
#[derive(Debug, Clone, PartialEq, Eq)]
enum What {
    Releases {
        of: String,
    },
    Elaboration {
        of: String,
    },
    News {
        channel: String,
        of: String,
    },
    Misses {
        of: String,
    },
    /// Of data from one component to another, over these channels.
    Age {
        from: String,
        to: String,
        over: Vec<String>,
    },
}

/// By what it is bounded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Limit {
    Ns(i128),
    Between(i128, i128),
    Misses { most: i64, of: i64 },
}

/// The bounds of the model that a program counts.
pub(crate) fn modelled(program: &Program, machine: &Machine, vocabulary: &Vocabulary, tick_ns: i64) -> Vec<Modelled> {
    let state = State { program, machine, vocabulary, tick_ns: i128::from(tick_ns) };
    let mut all = Vec::new();
    for component in &vocabulary.components {
        let of = || component.name.clone();
        if let Some(ns) = state.length("task_jitter", &component.task).filter(|ns| *ns > 0) {
            all.push(Modelled { what: What::Releases { of: of() }, limit: Limit::Ns(ns) });
        }
        for phase in &component.phases {
            if let (Some(least), Some(most)) = (state.length("timeAtLeast", phase), state.length("time", phase)) {
                all.push(Modelled { what: What::Elaboration { of: of() }, limit: Limit::Between(least, most) });
            }
        }
        if let (Some(most), Some(window)) =
            (state.integer("task_mayMiss", &component.task), state.integer("task_window", &component.task))
        {
            all.push(Modelled { what: What::Misses { of: of() }, limit: Limit::Misses { most, of: window } });
        }
    }
    for (reading, ns) in state.lengths("reading_limit") {
        let channel = state.first(&["reading_buffer", "reading_queue", "reading_value"], &reading);
        let reader = vocabulary.end(&channel, End::Reads).map(|index| vocabulary.components[index].name.clone());
        if let Some(of) = reader {
            let what = What::News { channel: state.shown(&channel), of };
            all.push(Modelled { what, limit: Limit::Ns(ns) });
        }
    }
    for (way, ns) in state.lengths("way_limit") {
        all.push(Modelled { what: state.way(&way), limit: Limit::Ns(ns) });
    }
    all
}

/// The model's initial state, asked by the names of the library.
struct State<'a> {
    program: &'a Program,
    machine: &'a Machine,
    vocabulary: &'a Vocabulary,
    tick_ns: i128,
}

impl State<'_> {
    fn get(&self, function: &str, argument: &Value) -> Value {
        let Some(function) = self.program.find_function(function, 1) else { return Value::Undef };
        self.machine.value(&Location { function, arguments: vec![argument.clone()] })
    }

    fn integer(&self, function: &str, argument: &Value) -> Option<i64> {
        if let Value::Integer(number) = self.get(function, argument) { Some(number) } else { None }
    }

    fn length(&self, function: &str, argument: &Value) -> Option<i128> {
        Some(i128::from(self.integer(function, argument)?) * self.tick_ns)
    }

    /// The elements for which a function of lengths is defined.
    fn lengths(&self, function: &str) -> Vec<(Value, i128)> {
        let Some(function) = self.program.find_function(function, 1) else { return Vec::new() };
        let of = |(location, value): (Location, Value)| match (location.function == function, value) {
            (true, Value::Integer(ticks)) => Some((location.arguments.into_iter().next()?, i128::from(ticks))),
            _ => None,
        };
        let all = self.machine.locations().into_iter().filter_map(of);
        all.map(|(element, ticks)| (element, ticks * self.tick_ns)).collect()
    }

    fn first(&self, functions: &[&str], argument: &Value) -> Value {
        let all = functions.iter().map(|function| self.get(function, argument));
        all.into_iter().find(|value| !value.is_undef()).unwrap_or_default()
    }

    fn shown(&self, element: &Value) -> String {
        self.vocabulary.object(self.machine, element).to_string()
    }

    fn way(&self, way: &Value) -> What {
        let to = self.shown(&self.get("way_end", way));
        let (mut from, mut over) = (to.clone(), Vec::new());
        let mut hop = self.get("way_hop", way);
        // A way leads through no component twice.
        while !hop.is_undef() && over.len() <= self.vocabulary.components.len() {
            over.push(self.shown(&self.first(&["hop_buffer", "hop_queue", "hop_value"], &hop)));
            from = self.shown(&self.get("hop_writer", &hop));
            hop = self.get("hop_before", &hop);
        }
        over.reverse();
        What::Age { from, to, over }
    }
}

/// What the comparison of the bounds leaves open.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Open {
    /// Bounds that the recording states in other words than generated programs do, so that they were not compared.
    pub unread: Vec<String>,
    /// Bounds of the model of which the recording says nothing.
    pub uncounted: Vec<String>,
}

/// What is left open if the recording's bounds are the model's.
///
/// # Errors
/// The first bound that the two have otherwise, as a sentence.
pub(crate) fn compare(recording: &Recording, modelled: &[Modelled], vocabulary: &Vocabulary) -> Result<Open, String> {
    let mut left: Vec<&Modelled> = modelled.iter().collect();
    let mut open = Open::default();
    let mut told: Vec<(&Bounded, Told)> = Vec::new();
    for bound in &recording.bounds {
        match Told::read(bound) {
            Some(one) => told.push((bound, one)),
            None => open.unread.push(format!("{} ({})", bound.what, bound.limit)),
        }
    }
    // The ones that say over which channels come first: of them only one bound of the model can be meant.
    told.sort_by_key(|(_, told)| std::cmp::Reverse(told.over().len()));
    for (bound, told) in told {
        let same = |modelled: &&Modelled| told.means(&modelled.what, vocabulary);
        let found = left.iter().position(|modelled| same(modelled) && modelled.limit == told.limit);
        let Some(found) = found else {
            let (what, limit) = (&bound.what, &bound.limit);
            let others: Vec<String> =
                left.iter().filter(|one| same(one)).map(|one| one.limit.shown(&one.what)).collect();
            return Err(match others.is_empty() {
                true => format!("the recording bounds {what} ({limit}), the model does not"),
                false => {
                    format!("the bound of {what} is {limit} in the recording, {} in the model", others.join(" or "))
                }
            });
        };
        left.remove(found);
    }
    open.uncounted = left.iter().map(|one| format!("{} ({})", one.what.shown(), one.limit.shown(&one.what))).collect();
    Ok(open)
}

/// The first bound of which no program can have counted what the recording says, as a sentence. A program of which a task failed or hung
/// may be asked while it counts.
pub(crate) fn contradiction(recording: &Recording) -> Option<String> {
    let of = |bound: &Bounded| {
        let words = Told::read(bound)?.limit.contradiction(bound)?;
        Some(format!("of {} ({}) {words}", bound.what, bound.limit))
    };
    recording.bounds.iter().filter(|_| recording.failure.is_none()).find_map(of)
}

/// A bound as a program states it.
struct Told {
    what: What,
    limit: Limit,
}

impl Told {
    /// SYNC(bounds): crates/generate/src/system/bounds.rs writes these words.
    fn read(bound: &Bounded) -> Option<Told> {
        let (what, limit) = (bound.what.as_str(), bound.limit.as_str());
        let name = |text: &str| (!text.is_empty() && !text.contains(' ')).then(|| text.to_string());
        if let Some(rest) = what.strip_prefix("age from ") {
            let (ends, over) = rest.split_once(" over ").unwrap_or((rest, ""));
            let (from, to) = ends.split_once(" to ")?;
            let over = over.split(", ").filter(|channel| !channel.is_empty()).map(str::to_string).collect();
            let limit = Limit::Ns(length(limit.strip_prefix("within ")?)?);
            return Some(Told { what: What::Age { from: name(from)?, to: name(to)?, over }, limit });
        }
        if let Some(of) = what.strip_prefix("deadlines missed by ") {
            let (most, window) = limit.split_once(" of ")?;
            let limit = Limit::Misses { most: most.parse().ok()?, of: window.parse().ok()? };
            return Some(Told { what: What::Misses { of: name(of)? }, limit });
        }
        if let (Some(rest), Some(limit)) = (what.strip_prefix("new "), limit.strip_prefix("every ")) {
            let (channel, of) = rest.split_once(" for ")?;
            let what = What::News { channel: name(channel)?, of: name(of)? };
            return Some(Told { what, limit: Limit::Ns(length(limit)?) });
        }
        let (subject, of) = what.split_once(" of ")?;
        let (_, of) = (name(subject)?, name(of)?);
        match limit.split_once("..") {
            Some((least, most)) => {
                let unit = most.split_once(' ').map(|(_, unit)| unit)?;
                let least = if least.contains(' ') { length(least)? } else { length(&format!("{least} {unit}"))? };
                Some(Told { what: What::Elaboration { of }, limit: Limit::Between(least, length(most)?) })
            }
            None if subject == "releases" => {
                Some(Told { what: What::Releases { of }, limit: Limit::Ns(length(limit)?) })
            }
            None => None,
        }
    }

    fn over(&self) -> &[String] {
        if let What::Age { over, .. } = &self.what { over } else { &[] }
    }

    /// Whether it may be that bound of the model, whatever its limit.
    fn means(&self, modelled: &What, vocabulary: &Vocabulary) -> bool {
        // A device is no component; the model does not have it.
        let end = |told: &str, known: &str| told == known || vocabulary.component_named(told).is_none();
        match (&self.what, modelled) {
            (What::Age { from, to, over }, What::Age { from: known_from, to: known_to, over: known }) => {
                end(from, known_from) && end(to, known_to) && (over.is_empty() || over == known)
            }
            // A channel with several readers is one in the chart, and one for each reader in the model.
            (What::News { channel, of }, What::News { channel: known, of: reader }) => {
                of == reader && (channel == known || *known == format!("{channel}_{of}"))
            }
            (told, modelled) => told == modelled,
        }
    }
}

impl What {
    fn shown(&self) -> String {
        match self {
            What::Releases { of } => format!("releases of {of}"),
            What::Elaboration { of } => format!("an elaboration of {of}"),
            What::News { channel, of } => format!("new {channel} for {of}"),
            What::Misses { of } => format!("deadlines missed by {of}"),
            What::Age { from, to, over } if over.is_empty() => format!("age from {from} to {to}"),
            What::Age { from, to, over } => format!("age from {from} to {to} over {}", over.join(", ")),
        }
    }
}

impl Limit {
    /// What of the counts does not fit to this limit, or to each other.
    fn contradiction(self, bound: &Bounded) -> Option<String> {
        let &Bounded { seen, below, beyond, greatest, .. } = bound;
        let (least, most) = match self {
            Limit::Ns(most) => (0, most),
            Limit::Between(least, most) => (least, most),
            Limit::Misses { most, .. } => (0, i128::from(most)),
        };
        let (number, shown) = match (self, greatest) {
            (Limit::Misses { .. }, Greatest::Number(number)) => (number, number.to_string()),
            (Limit::Ns(_) | Limit::Between(..), Greatest::Time(ns)) => (ns, format!("{} ms", ns as f64 / 1e6)),
            (Limit::Misses { .. }, Greatest::Time(_)) => {
                return Some("the greatest value is a length of time".to_string());
            }
            (_, Greatest::Number(_)) => return Some("the greatest value is no length of time".to_string()),
        };
        let number = i128::from(number);
        let are_below = if below == 1 { "1 value is".to_string() } else { format!("{below} values are") };
        match (number > most, beyond > 0) {
            _ if seen == 0 && number > 0 => Some(format!("nothing was seen, and the greatest value is {shown}")),
            (true, false) => Some(format!("no value is beyond, and the greatest is {shown}")),
            (false, true) => Some(format!("some values are beyond, and the greatest is {shown}")),
            _ if seen > 0 && (number < least) != (below == seen) => {
                Some(format!("{are_below} below, of {seen}, and the greatest is {shown}"))
            }
            _ if seen > 0 && least == 0 && below > 0 => Some(format!("{are_below} below, and there is no least one")),
            _ => None,
        }
    }

    fn shown(self, what: &What) -> String {
        let ms = |ns: i128| format!("{} ms", ns as f64 / 1e6);
        match (self, what) {
            (Limit::Ns(ns), What::Age { .. }) => format!("within {}", ms(ns)),
            (Limit::Ns(ns), What::News { .. }) => format!("every {}", ms(ns)),
            (Limit::Ns(ns), _) => ms(ns),
            (Limit::Between(least, most), _) => format!("{}..{}", least as f64 / 1e6, ms(most)),
            (Limit::Misses { most, of }, _) => format!("{most} of {of}"),
        }
    }
}

/// A length of time such as `0.5 ms`, in nanoseconds.
fn length(text: &str) -> Option<i128> {
    let (number, unit) = text.split_once(' ')?;
    let size: i128 = match unit {
        "s" => 1_000_000_000,
        "ms" => 1_000_000,
        "us" => 1_000,
        "ns" => 1,
        _ => return None,
    };
    let (whole, rest) = number.split_once('.').unwrap_or((number, ""));
    // LIMIT: nine decimals, and no longer than a number of the recording can be.
    let is_digits = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    if whole.is_empty() || whole.len() > 18 || rest.len() > 9 || !is_digits(whole) || !is_digits(rest) {
        return None;
    }
    let scale = 10_i128.pow(rest.len() as u32);
    let parts = whole.parse::<i128>().ok()? * scale + if rest.is_empty() { 0 } else { rest.parse::<i128>().ok()? };
    (parts * size % scale == 0).then(|| parts * size / scale)
}

#[cfg(test)]
mod tests;
