//! The file format of report specifications: YAML → [`Spec`], each term with its place.
//!
//! This module does not know whether the terms fit a model, nor what the charts hold. Tasks, buffers and queues are
//! given as `each`, a mapping from names in the model to their entries, and `terms`, in which `{}` stands for that
//! name; an entry of `each` may give a term of its own, or `~` for none.

use std::collections::BTreeMap;
use std::ops::Range;

use inputs::Scalar;
use inputs::node::{Key, Node, Shape, read};
use syntax::{Diagnostic, FileId, Span};

use crate::keys::{self, Lanes};
use crate::spec::{ActivitySpec, BufferSpec, CounterSpec, FlowSpec, HopSpec, QueueSpec, SeriesSpec, Spec, TaskSpec};
use crate::tone::Tone;

/// The id of what is wrong with a specification.
const ID: &str = "bad-report-specification";

/// Something wrong with a specification.
pub fn specification_fault(span: Span, message: impl Into<String>) -> Diagnostic {
    Diagnostic::error(ID, span, message)
}

/// A specification, where its terms stand, and the charts it wants.
#[derive(Debug)]
pub struct Specification {
    /// What it shows, without the charts.
    pub spec: Spec,
    /// Where each term stands; for a term that comes several times, where it comes first.
    pub places: BTreeMap<String, TermPlace>,
    /// The charts that are to be read and drawn.
    pub charts: Vec<Wanted>,
}

/// Where a term of a specification stands.
#[derive(Debug, Clone)]
pub struct TermPlace {
    /// The whole of it.
    pub span: Span,
    /// The scalar that it is, and up to where the term is what stands there: a name put in for `{}` moves what follows it.
    written: Option<(Scalar, u32)>,
}

impl TermPlace {
    /// That of a term whose parts are not told apart.
    pub fn whole(span: Span) -> TermPlace {
        TermPlace { span, written: None }
    }

    /// Where a part of the term stands.
    pub fn part(&self, part: Range<u32>) -> Span {
        match &self.written {
            Some((written, same)) if part.end <= *same => written.place(part),
            Some((written, same)) => Span { start: written.place(part.start.min(*same)..*same).start, ..self.span },
            None => self.span,
        }
    }
}

/// A chart to be shown.
#[derive(Debug)]
pub struct Wanted {
    /// The file, seen from the specification.
    pub file: String,
    /// Where it is named.
    pub span: Span,
    /// The values of its machines' parameters: names in the model, and for people.
    pub each: Vec<(String, String)>,
    /// The machines to show; none: all of them, always at work.
    pub machines: Vec<WantedMachine>,
}

/// A machine of a chart to be shown.
#[derive(Debug)]
pub struct WantedMachine {
    /// Its name.
    pub name: String,
    /// Where it is named.
    pub span: Span,
    /// The term that is true when it is at work, and where that stands.
    pub when: Option<(String, Span)>,
}

/// Reads a specification.
///
/// # Errors
/// All faults of its form.
pub fn read_specification(file: FileId, source: &str) -> Result<Specification, Vec<Diagnostic>> {
    let root = read(file, source, ID).map_err(|fault| vec![*fault])?;
    let mut reader = Reader { faults: Vec::new(), places: BTreeMap::new() };
    let spec = reader.spec(&root);
    let charts = reader.charts(&root);
    let whole = Span { file, start: 0, end: 0 };
    if reader.faults.is_empty() {
        reader.faults.extend(spec.faults().into_iter().map(|message| specification_fault(whole, message)));
    }
    if reader.faults.is_empty() {
        Ok(Specification { spec, places: reader.places, charts })
    } else {
        Err(reader.faults)
    }
}

struct Reader {
    faults: Vec<Diagnostic>,
    places: BTreeMap<String, TermPlace>,
}

/// The entries of a mapping.
#[derive(Clone, Copy)]
struct Fields<'a>(&'a [(Key, Node)]);

impl<'a> Fields<'a> {
    fn get(self, name: &str) -> Option<&'a Node> {
        self.0.iter().find(|(key, _)| key.text == name).map(|(_, node)| node)
    }
}

/// A group of lanes of one kind: each with its terms.
struct Lane<'a> {
    id: &'a str,
    own: Fields<'a>,
    terms: Fields<'a>,
    counters: Fields<'a>,
}

impl Reader {
    fn refuse(&mut self, span: Span, message: impl Into<String>) {
        self.faults.push(specification_fault(span, message));
    }

    /// A mapping with keys of these names only; none: of any name.
    fn fields<'a>(&mut self, node: Option<&'a Node>, known: &[&str]) -> Fields<'a> {
        let Some(node) = node else { return Fields(&[]) };
        match &node.shape {
            Shape::Map(entries) => {
                for (key, _) in
                    entries.iter().filter(|(key, _)| !known.is_empty() && !known.contains(&key.text.as_str()))
                {
                    let unknown = specification_fault(key.span, format!("nothing here is called `{}`", key.text));
                    self.faults.push(unknown.with_help(format!("known are: {}", known.join(", "))));
                }
                Fields(entries)
            }
            Shape::Text(text) if is_nothing(text) => Fields(&[]),
            _ => {
                self.refuse(node.span, "a mapping is expected");
                Fields(&[])
            }
        }
    }

    fn list<'a>(&mut self, node: Option<&'a Node>) -> &'a [Node] {
        match node.map(|node| (&node.shape, node.span)) {
            None => &[],
            Some((Shape::List(items), _)) => items,
            Some((_, span)) => {
                self.refuse(span, "a list is expected");
                &[]
            }
        }
    }

    fn text(&mut self, node: Option<&Node>) -> Option<String> {
        match &node?.shape {
            Shape::Text(text) if is_nothing(text) => None,
            Shape::Text(text) => Some(text.to_string()),
            _ => {
                self.refuse(node?.span, "a text is expected");
                None
            }
        }
    }

    /// A term in which `{}` stands for a name.
    fn term(&mut self, node: Option<&Node>, id: &str) -> Option<String> {
        let text = self.text(node)?;
        let (node, term) = (node?, text.replace("{}", id));
        let same = text.find("{}").unwrap_or(text.len()) as u32;
        let written = match &node.shape {
            Shape::Text(written) => Some((written.clone(), same)),
            Shape::List(_) | Shape::Map(_) => None,
        };
        self.places.entry(term.clone()).or_insert(TermPlace { span: node.span, written });
        Some(term)
    }

    fn spec(&mut self, root: &Node) -> Spec {
        let fields = self.fields(Some(root), &keys::ROOT);
        let tick_ns = fields.get("tick").and_then(|node| self.duration(node));
        let window = fields.get("window").map_or(0, |node| self.ticks(node, tick_ns));
        let activities = self.activities(fields.get("activities"));
        Spec {
            title: self.text(fields.get("title")).unwrap_or_default(),
            note: self.text(fields.get("note")).unwrap_or_default(),
            tick_ns,
            window,
            activities,
            tasks: self.tasks(fields.get("tasks")),
            buffers: self.buffers(fields.get("buffers")),
            queues: [
                self.queues(fields.get("queues"), "queue", keys::QUEUES),
                self.queues(fields.get("values"), "shared value", keys::VALUES),
            ]
            .concat(),
            series: self.series(fields.get("series")),
            flow: fields.get("flow").map(|node| self.flow(node, fields.get("tasks"))),
            ..Spec::default()
        }
    }

    fn charts(&mut self, root: &Node) -> Vec<Wanted> {
        let root = match &root.shape {
            Shape::Map(entries) => Fields(entries),
            _ => return Vec::new(),
        };
        let tasks: Vec<(String, String)> = match root.get("tasks").map(|node| &node.shape) {
            Some(Shape::Map(entries)) => {
                let each = self.fields(Fields(entries).get("each"), &[]).0;
                let name = |node: &Node| match &node.shape {
                    Shape::Map(entries) => self.text(Fields(entries).get("name")),
                    _ => None,
                };
                let mut name = name;
                each.iter().map(|(key, node)| (key.text.clone(), name(node).unwrap_or(key.text.clone()))).collect()
            }
            _ => Vec::new(),
        };
        let mut charts = Vec::new();
        for (key, node) in self.fields(root.get("charts"), &[]).0 {
            let fields = self.fields(Some(node), &keys::CHART);
            let named = |id: String| {
                let name = tasks.iter().find(|(known, _)| *known == id).map(|(_, name)| name.clone());
                (id.clone(), name.unwrap_or(id))
            };
            let each = match fields.get("each") {
                None => tasks.clone(),
                Some(node) => {
                    self.list(Some(node)).iter().filter_map(|item| self.text(Some(item))).map(named).collect()
                }
            };
            let mut machines = Vec::new();
            for (machine, node) in self.fields(fields.get("machines"), &[]).0 {
                let when = self.fields(Some(node), &keys::MACHINE).get("when");
                let when = when.and_then(|node| Some((self.text(Some(node))?, node.span)));
                machines.push(WantedMachine { name: machine.text.clone(), span: machine.span, when });
            }
            charts.push(Wanted { file: key.text.clone(), span: key.span, each, machines });
        }
        charts
    }

    /// `100 us` in nanoseconds.
    fn duration(&mut self, node: &Node) -> Option<u64> {
        let text = self.text(Some(node))?;
        let parsed = nanoseconds(&text);
        if parsed.is_none() {
            self.refuse(
                node.span,
                format!("`{text}` is no time: write a number and its unit, such as 100 us, 0.5 ms or 1 s"),
            );
        }
        parsed
    }

    /// A number of ticks, or a time that is one.
    fn ticks(&mut self, node: &Node, tick_ns: Option<u64>) -> u64 {
        let text = self.text(Some(node)).unwrap_or_default();
        if let Ok(ticks) = text.trim().parse() {
            return ticks;
        }
        match (self.duration(node), tick_ns) {
            (Some(time), Some(tick)) => time / tick.max(1),
            (Some(_), None) => {
                self.refuse(node.span, "a time says nothing here while `tick` is not given: write a number of steps");
                0
            }
            _ => 0,
        }
    }

    fn activities(&mut self, node: Option<&Node>) -> Vec<ActivitySpec> {
        let mut activities = Vec::new();
        for (key, node) in self.fields(node, &[]).0 {
            let [label, tone] = self.list(Some(node)) else {
                self.refuse(node.span, "two texts are expected: words and tone, such as [waiting, wait]");
                continue;
            };
            let (label, name) = (self.text(Some(label)), self.text(Some(tone)).unwrap_or_default());
            let Some(found) = Tone::named(&name) else {
                let tones = Tone::ALL.map(Tone::name).join(", ");
                self.faults.push(
                    specification_fault(tone.span, format!("`{name}` is no tone"))
                        .with_help(format!("tones are: {tones}")),
                );
                continue;
            };
            activities.push(ActivitySpec { value: key.text.clone(), label: label.unwrap_or_default(), tone: found });
        }
        activities
    }

    /// The lanes of a group.
    fn lanes<'a>(&mut self, node: Option<&'a Node>, Lanes { told, terms, .. }: Lanes) -> Vec<Lane<'a>> {
        let group = self.fields(node, &keys::GROUP);
        let shared = self.fields(group.get("terms"), terms);
        let counters = self.fields(group.get("counters"), &[]);
        let known = [told, terms].concat();
        let each = self.fields(group.get("each"), &[]).0;
        each.iter()
            .map(|(key, node)| Lane { id: &key.text, own: self.fields(Some(node), &known), terms: shared, counters })
            .collect()
    }

    fn lane_term(&mut self, lane: &Lane, name: &str) -> Option<String> {
        self.term(lane.own.get(name).or(lane.terms.get(name)), lane.id)
    }

    fn counters(&mut self, lane: &Lane) -> Vec<CounterSpec> {
        let mut counters = Vec::new();
        for (key, node) in lane.counters.0 {
            if let Some(term) = self.term(Some(node), lane.id) {
                counters.push(CounterSpec { label: key.text.clone(), term });
            }
        }
        counters
    }

    fn tasks(&mut self, node: Option<&Node>) -> Vec<TaskSpec> {
        let lanes = self.lanes(node, keys::TASKS);
        let task = |lane: &Lane| TaskSpec {
            name: self.text(lane.own.get("name")).unwrap_or_else(|| lane.id.to_string()),
            caption: self.text(lane.own.get("caption")).unwrap_or_default(),
            activity: self.lane_term(lane, "activity").unwrap_or_default(),
            period: self.lane_term(lane, "period"),
            deadline: self.lane_term(lane, "deadline"),
            may_miss: self.lane_term(lane, "may_miss"),
            release: self.lane_term(lane, "release"),
            cycles: self.lane_term(lane, "cycles"),
            met: self.lane_term(lane, "met"),
            missed: self.lane_term(lane, "missed"),
            skipped: self.lane_term(lane, "skipped"),
        };
        lanes.iter().map(task).collect()
    }

    fn buffers(&mut self, node: Option<&Node>) -> Vec<BufferSpec> {
        let lanes = self.lanes(node, keys::BUFFERS);
        let buffer = |lane: &Lane| BufferSpec {
            from: self.text(lane.own.get("from")).unwrap_or_else(|| lane.id.to_string()),
            to: self.text(lane.own.get("to")).unwrap_or_default(),
            arrays: self.lane_term(lane, "arrays"),
            writing: self.lane_term(lane, "writing"),
            reading: self.lane_term(lane, "reading"),
            write_index: self.lane_term(lane, "write_index"),
            read_index: self.lane_term(lane, "read_index"),
            lock: self.lane_term(lane, "lock"),
            swaps: self.lane_term(lane, "swaps"),
            counters: self.counters(lane),
        };
        lanes.iter().map(buffer).collect()
    }

    /// Queues, or what holds one datum; the first term of their group counts what is in them.
    fn queues(&mut self, node: Option<&Node>, kind: &str, group: keys::Lanes) -> Vec<QueueSpec> {
        let length = group.terms[0];
        let lanes = self.lanes(node, group);
        let mut queues = Vec::new();
        for lane in &lanes {
            let Some(held) = self.lane_term(lane, length) else {
                let span = node.map_or(Span { file: FileId(0), start: 0, end: 0 }, |node| node.span);
                self.refuse(
                    span,
                    format!("the {kind} `{}` has no `{length}`: name the term that counts what is in it", lane.id),
                );
                continue;
            };
            queues.push(QueueSpec {
                from: self.text(lane.own.get("from")).unwrap_or_else(|| lane.id.to_string()),
                to: self.text(lane.own.get("to")).unwrap_or_default(),
                kind: kind.to_string(),
                length: held,
                capacity: self.lane_term(lane, "capacity"),
                counters: self.counters(lane),
            });
        }
        queues
    }

    fn series(&mut self, node: Option<&Node>) -> Vec<SeriesSpec> {
        let mut all = Vec::new();
        for (key, node) in self.fields(node, &[]).0 {
            let fields = self.fields(Some(node), &keys::SERIES);
            let Some(value) = self.term(fields.get("value"), "") else {
                self.refuse(key.span, format!("`{}` has no `value`: name the term to be shown", key.text));
                continue;
            };
            let ticks = match self.text(fields.get("unit")).as_deref() {
                None | Some("number") => false,
                Some("ticks") => true,
                Some(other) => {
                    self.refuse(node.span, format!("the unit `{other}` is not known: it is `ticks` or `number`"));
                    false
                }
            };
            let (name, caption) = (key.text.clone(), self.text(fields.get("caption")).unwrap_or_default());
            all.push(SeriesSpec { name, caption, value, ticks, bound: self.term(fields.get("bound"), "") });
        }
        all
    }

    fn flow(&mut self, node: &Node, tasks: Option<&Node>) -> FlowSpec {
        let fields = self.fields(Some(node), &keys::FLOW);
        let noun = match self.list(fields.get("noun")) {
            [one, many] => (self.text(Some(one)).unwrap_or_default(), self.text(Some(many)).unwrap_or_default()),
            _ => ("datum".to_string(), "data".to_string()),
        };
        let each = match tasks.map(|node| &node.shape) {
            Some(Shape::Map(entries)) => Fields(entries).get("each"),
            _ => None,
        };
        let mut hops = Vec::new();
        for item in self.list(fields.get("hops")) {
            let hop = self.fields(Some(item), &keys::HOP);
            let (id, event) = (self.text(hop.get("task")).unwrap_or_default(), self.text(hop.get("event")));
            let Some(value) = self.term(hop.get("value"), &id) else {
                self.refuse(item.span, "the hop has no `value`: name the term that tells which datum it works on");
                continue;
            };
            // The file uses the model's names of tasks; the page uses the names for people.
            let named = match each.map(|node| &node.shape) {
                Some(Shape::Map(entries)) => Fields(entries).get(&id),
                _ => None,
            };
            let name = match named.map(|node| &node.shape) {
                Some(Shape::Map(entries)) => self.text(Fields(entries).get("name")),
                _ => None,
            };
            hops.push(HopSpec { task: name.unwrap_or(id), event: event.unwrap_or_else(|| "seen".to_string()), value });
        }
        FlowSpec { noun, hops }
    }
}

/// What YAML writes for nothing.
fn is_nothing(text: &str) -> bool {
    matches!(text, "" | "~" | "null")
}

/// `100 us`, `0.1ms`, `1 s`.
fn nanoseconds(text: &str) -> Option<u64> {
    let text = text.trim();
    let digits = text.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(text.len());
    let unit = match text[digits..].trim() {
        "ns" => 1.0,
        "us" | "µs" => 1e3,
        "ms" => 1e6,
        "s" => 1e9,
        _ => return None,
    };
    let time = text[..digits].parse::<f64>().ok()? * unit;
    // Below a nanosecond, or beyond what a run could last, it is a mistake.
    (1.0..1e18).contains(&time).then_some(time.round() as u64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_of_a_term_stands_where_it_is_written() {
        let source = "series:\n  a: { value: \"layer\u{e9} + 1\" }\n  b: { value: 'it{} + x' }\n";
        let specification = read_specification(FileId(0), source).expect("it is one");
        let part = |term: &str, part: &str| {
            let at = term.find(part).expect("it is there") as u32;
            let span = specification.places[term].part(at..at + part.len() as u32);
            &source[span.start as usize..span.end as usize]
        };
        assert_eq!(part("layer\u{e9} + 1", "\u{e9}"), "\u{e9}");
        assert_eq!(part("layer\u{e9} + 1", "1"), "1");
        // Behind the name that is put in nothing is told apart.
        let (term, _) = specification.places.iter().find(|(term, _)| term.starts_with("it")).expect("it is read");
        assert_eq!(part(term, "it"), "it");
        assert!(part(term, "x").contains("+ x"), "{term}");
    }
}
