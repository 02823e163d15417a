//! Writes SCXML: a state for each control state, a transition for each path, with its guards as the condition and its
//! actions as the script, both in AsmetaL. A pattern begins in the state `enter` and ends in the final state `exit`; an
//! instance on a path invokes its pattern and continues when that is done. A composite state holds its states, with what is
//! done on entry and exit, and with its history. SCXML takes inner transitions first, so the condition of a transition within a
//! composite state says that none of those out of it is open.
//!
//! What SCXML cannot express (parameters, the control variable, names and texts of shapes, the single guards and
//! actions of a path) is in a namespace of its own, which other tools ignore. SYNC(scxml): `import/scxml` reads it.
//!
//! LIMIT: SCXML takes the first of two paths whose guards hold together; in a chart both are taken. It does what is done on exit, on the
//! path and on entry one after the other, and what is done on entry also where the machine starts.

use std::collections::BTreeMap;
use std::fmt::Write;

use crate::answer::without_answers;
use crate::build::call;
use crate::chart::{Chart, Composite, Control, History, Machine, Refinement, Shape, ShapeId, ShapeKind};
use crate::flow::{Origin, Target, Transition, drawn_transitions, is_block};
use crate::link::Link;
use crate::xml::Text;

/// The namespace of what SCXML cannot express.
pub(crate) const NAMESPACE: &str = "urn:groundstate:chart";

/// The SCXML of a machine.
pub fn scxml_of(chart: &Chart, machine: &Machine) -> String {
    let plain = without_answers(chart, machine);
    let machine = plain.as_ref().unwrap_or(machine);
    let mut paths: BTreeMap<Origin, Vec<Transition>> = BTreeMap::new();
    for path in drawn_transitions(chart, machine) {
        paths.entry(path.origin).or_default().push(path);
    }
    Writer { chart, machine, paths, out: String::new() }.document()
}

struct Writer<'c> {
    chart: &'c Chart,
    machine: &'c Machine,
    paths: BTreeMap<Origin, Vec<Transition>>,
    out: String,
}

/// Text as the value of an attribute; line ends are preserved.
struct Attribute<'t>(&'t str);

impl std::fmt::Display for Attribute<'_> {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let lines: Vec<String> = self.0.split('\n').map(|line| Text(line).to_string()).collect();
        out.write_str(&lines.join("&#10;"))
    }
}

impl Writer<'_> {
    fn document(mut self) -> String {
        let machine = self.machine;
        let initial = if machine.is_pattern { None } else { self.begins(None) };
        self.out = format!(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<scxml xmlns=\"http://www.w3.org/2005/07/scxml\" \
             xmlns:gs=\"{NAMESPACE}\" version=\"1.0\" datamodel=\"asmetal\" name=\"{}\" initial=\"{}\"",
            Text(&machine.name),
            initial.as_deref().unwrap_or("enter"),
        );
        self.own("kind", if machine.is_pattern { "pattern" } else { "machine" });
        self.own("text", &machine.text);
        if !machine.parameters.is_empty() {
            let parameters = machine.parameters.iter().map(|one| format!("{} in {}", one.variable, one.domain));
            self.own("parameters", &parameters.collect::<Vec<_>>().join(", "));
        }
        match &machine.control {
            Some(Control::Linked(link)) => self.own("control", &format!("{{{}}}", link.text)),
            Some(Control::Made { name, .. }) => self.own("control", name),
            None => {}
        }
        if let Some(rule) = &machine.rule {
            self.own("rule", &rule.text);
        }
        self.out.push_str(">\n");
        self.declarations(None, 1);
        for sequence in &machine.sequences {
            let names: Vec<&str> = sequence.iter().map(|id| machine.shape(*id).name.as_str()).collect();
            let _ = writeln!(self.out, "  <gs:sequence names=\"{}\"/>", names.join(", "));
        }
        if machine.is_pattern {
            self.out.push_str("  <state id=\"enter\">\n");
            self.transitions(Origin::Enter, None, 2);
            self.out.push_str("  </state>\n");
        }
        self.states(None, 1);
        if machine.is_pattern {
            self.out.push_str("  <final id=\"exit\"/>\n");
        }
        self.out + "</scxml>\n"
    }

    /// An attribute of our own.
    fn own(&mut self, name: &str, value: &str) {
        let _ = write!(self.out, " gs:{name}=\"{}\"", Attribute(value));
    }

    fn indent(&mut self, depth: usize) {
        self.out.extend(std::iter::repeat_n("  ", depth));
    }

    /// A shape's name, text and link, as attributes.
    fn about(&self, prefix: &str, shape: &Shape) -> String {
        let mut out = format!(" {prefix}text=\"{}\"", Attribute(&shape.text));
        if let Some(Link { text, .. }) = &shape.link {
            let _ = write!(out, " {prefix}link=\"{}\"", Attribute(text));
        }
        if let Some(Refinement { by }) = &shape.refinement {
            let _ = write!(out, " {prefix}refine=\"{}\"", Attribute(by.as_deref().unwrap_or_default()));
        }
        if let ShapeKind::Instance(pattern) = &shape.kind {
            let _ = write!(out, " {prefix}of=\"{}\"", Attribute(&pattern.name));
            let _ = write!(out, " {prefix}arguments=\"{}\"", Attribute(&pattern.arguments.join(", ")));
        }
        out
    }

    /// The guards, the actions, and the instances in which the machine does not stay, of a composite state; without one, of the
    /// machine.
    fn declarations(&mut self, around: Option<ShapeId>, depth: usize) {
        let machine = self.machine;
        let composite = around.and_then(|around| machine.shape(around).composite());
        for (id, shape) in machine.numbered().filter(|(_, shape)| shape.inside == around) {
            let word = match &shape.kind {
                ShapeKind::State { .. } | ShapeKind::Composite(_) => continue,
                ShapeKind::Instance(_) if is_block(self.chart, machine, id) => continue,
                ShapeKind::Guard => "guard",
                ShapeKind::Action if composite.is_some_and(|composite| composite.entry.contains(&id)) => "entry",
                ShapeKind::Action if composite.is_some_and(|composite| composite.exit.contains(&id)) => "exit",
                ShapeKind::Action if machine.aborts.contains(&id) => "abort",
                ShapeKind::Action => "action",
                ShapeKind::Instance(_) => "instance",
            };
            self.indent(depth);
            let _ = writeln!(self.out, "<gs:{word} name=\"{}\"{}/>", Text(&shape.name), self.about("", shape));
        }
    }

    /// The states in a composite state; without one, those of the machine.
    fn states(&mut self, around: Option<ShapeId>, depth: usize) {
        let machine = self.machine;
        for (id, shape) in machine.numbered().filter(|(_, shape)| shape.inside == around) {
            match &shape.kind {
                ShapeKind::Composite(composite) => self.composite(id, shape, composite, depth),
                ShapeKind::Instance(pattern) if is_block(self.chart, machine, id) => {
                    self.begin_state(shape, depth);
                    let (name, of) = (Text(&shape.name), Text(&pattern.name));
                    self.indent(depth + 1);
                    let _ = writeln!(self.out, "<invoke id=\"{name}\" src=\"{of}.scxml\"/>");
                    self.transitions(Origin::Left(id), Some(id), depth + 1);
                    self.end_state(depth);
                }
                ShapeKind::State { .. } => {
                    self.begin_state(shape, depth);
                    self.transitions(Origin::State(id), Some(id), depth + 1);
                    self.end_state(depth);
                }
                ShapeKind::Guard | ShapeKind::Action | ShapeKind::Instance(_) => {}
            }
        }
    }

    fn begin_state(&mut self, shape: &Shape, depth: usize) {
        self.indent(depth);
        let _ = writeln!(self.out, "<state id=\"{}\"{}>", Text(&shape.name), self.about("gs:", shape));
    }

    fn end_state(&mut self, depth: usize) {
        self.indent(depth);
        self.out.push_str("</state>\n");
    }

    fn composite(&mut self, id: ShapeId, shape: &Shape, composite: &Composite, depth: usize) {
        self.indent(depth);
        let _ = write!(self.out, "<state id=\"{}\"", Text(&shape.name));
        let begins = self.begins(Some(id));
        if let Some(first) = &begins {
            let _ = write!(self.out, " initial=\"{first}\"");
        }
        self.out.push_str(&self.about("gs:", shape));
        match &composite.history {
            Some(History::Linked(link)) => self.own("history", &format!("{{{}}}", link.text)),
            Some(History::Made) => self.own("history", ""),
            None => {}
        }
        self.out.push_str(">\n");
        self.declarations(Some(id), depth + 1);
        for (element, actions) in [("onentry", &composite.entry), ("onexit", &composite.exit)] {
            if let Some(script) = self.script(actions) {
                self.indent(depth + 1);
                let _ = writeln!(self.out, "<{element}><script>{}</script></{element}>", Text(&script));
            }
        }
        if let (Some(_), Some(first)) = (&composite.history, begins) {
            // It is in a state with a history of its own where that was left.
            let inner = |(one, shape): (ShapeId, &Shape)| {
                self.machine.around(one).contains(&id) && shape.composite().is_some_and(|one| one.history.is_some())
            };
            let kind = if self.machine.numbered().any(inner) { "deep" } else { "shallow" };
            let name = history(&shape.name);
            self.indent(depth + 1);
            let _ =
                writeln!(self.out, "<history id=\"{name}\" type=\"{kind}\"><transition target=\"{first}\"/></history>");
        }
        self.transitions(Origin::State(id), Some(id), depth + 1);
        self.states(Some(id), depth + 1);
        self.end_state(depth);
    }

    /// Where a composite state begins; without one, the machine.
    fn begins(&self, around: Option<ShapeId>) -> Option<String> {
        let is_first = |(_, shape): &(ShapeId, &Shape)| shape.inside == around && shape.is_initial();
        self.machine.numbered().find(is_first).map(|(id, _)| self.way_into(id))
    }

    /// The target of what leads to a state.
    fn way_into(&self, id: ShapeId) -> String {
        let shape = self.machine.shape(id);
        match shape.composite().and_then(|composite| composite.history.as_ref()) {
            Some(_) => history(&shape.name),
            None => shape.name.clone(),
        }
    }

    fn transitions(&mut self, origin: Origin, from: Option<ShapeId>, depth: usize) {
        let barred = from.map(|from| self.barred(from)).unwrap_or_default();
        for path in self.paths.get(&origin).cloned().unwrap_or_default() {
            self.transition(&barred, &path, depth);
        }
    }

    /// What has to hold for paths in composite states: that those out of these are not open, from the outside in.
    fn barred(&self, id: ShapeId) -> Vec<String> {
        let outer = self.machine.around(id).into_iter().rev();
        let all = outer.filter_map(|outer| {
            let paths = self.paths.get(&Origin::State(outer))?;
            bar(&paths.iter().map(|path| self.condition(path)).collect::<Vec<_>>())
        });
        all.collect()
    }

    /// The guards of a path.
    fn condition(&self, path: &Transition) -> String {
        let guard = |id: &ShapeId| call(self.machine, self.machine.shape(*id));
        path.guards.iter().map(|(id, holds)| condition(&guard(id), *holds)).collect::<Vec<_>>().join(" and ")
    }

    fn script(&self, actions: &[ShapeId]) -> Option<String> {
        script(&actions.iter().map(|id| call(self.machine, self.machine.shape(*id))).collect::<Vec<_>>())
    }

    fn transition(&mut self, barred: &[String], path: &Transition, depth: usize) {
        let name = |id: ShapeId| self.machine.shape(id).name.as_str();
        let event = match path.origin {
            Origin::Left(block) => format!(" event=\"done.invoke.{}\"", Text(name(block))),
            Origin::Enter | Origin::State(_) => String::new(),
        };
        let own = Some(self.condition(path)).filter(|own| !own.is_empty());
        let condition = match barred.iter().cloned().chain(own).collect::<Vec<_>>().join(" and ") {
            none if none.is_empty() => String::new(),
            condition => format!(" cond=\"{}\"", Attribute(&condition)),
        };
        let target = match path.target {
            Target::State(id) | Target::Block(id) => self.way_into(id),
            Target::Exit => "exit".to_string(),
        };
        let stops: Vec<String> = path
            .stops
            .iter()
            .map(|(id, branch)| match branch {
                Some(true) => format!("{} yes", name(*id)),
                Some(false) => format!("{} no", name(*id)),
                None => name(*id).to_string(),
            })
            .collect();
        let stops = if stops.is_empty() { String::new() } else { format!(" gs:path=\"{}\"", stops.join(", ")) };
        self.indent(depth);
        let _ = write!(self.out, "<transition{event}{condition} target=\"{}\"{stops}", Text(&target));
        let _ = match self.script(&path.actions) {
            None => writeln!(self.out, "/>"),
            Some(script) => writeln!(self.out, "><script>{}</script></transition>", Text(&script)),
        };
    }
}

/// The name of a composite state's history: no shape has such a name.
pub(crate) fn history(composite: &str) -> String {
    format!("{composite}.history")
}

/// A test and its outcome, as a part of a condition.
pub(crate) fn condition(text: &str, holds: bool) -> String {
    match (holds, text.contains(' ')) {
        (true, true) => format!("({text})"),
        (true, false) => text.to_string(),
        (false, _) => format!("not ({text})"),
    }
}

/// That no path with one of these conditions is open; `None` if there is no path. One without a condition is always open.
pub(crate) fn bar(conditions: &[String]) -> Option<String> {
    match conditions {
        [] => None,
        all if all.iter().any(String::is_empty) => Some("false".to_string()),
        [one] => Some(format!("not ({one})")),
        several => Some(format!("not (({}))", several.join(") or ("))),
    }
}

/// Rules in parallel, as one rule.
pub(crate) fn script(rules: &[String]) -> Option<String> {
    match rules {
        [] => None,
        [one] => Some(one.clone()),
        several => Some(format!("par {} endpar", several.join(" "))),
    }
}
