//! Writes SCXML: a state for each control state, a transition for each path, with its guards as the condition and its
//! actions as the script, both in AsmetaL. A pattern begins in the state `enter` and ends in the final state `exit`; an
//! instance on a path invokes its pattern and continues when that is done.
//!
//! What SCXML cannot express (parameters, the control variable, names and texts of shapes, the single guards and
//! actions of a path) is in a namespace of its own, which other tools ignore. SYNC(scxml): `import/scxml.rs` reads it.
//!
//! LIMIT: if the guards of two paths hold together, SCXML takes the first one; in a chart both are taken in parallel.

use std::collections::BTreeSet;
use std::fmt::Write;

use crate::build::call;
use crate::chart::{Chart, Control, Machine, Refinement, Shape, ShapeId, ShapeKind};
use crate::flow::{Origin, Target, Transition, is_block, transitions};
use crate::link::Link;
use crate::xml::Text;

/// The namespace of what SCXML cannot express.
pub(crate) const NAMESPACE: &str = "urn:groundstate:chart";

/// The SCXML of a machine.
pub fn scxml_of(chart: &Chart, machine: &Machine) -> String {
    // The first shapes of the flat machine are those of the drawn one, which knows in which state it begins.
    let (initial, machine) = (machine.initial(), machine.flat());
    let initial = match initial {
        Some(id) if !machine.is_pattern => machine.shape(id).name.as_str(),
        _ => "enter",
    };
    let mut out = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<scxml xmlns=\"http://www.w3.org/2005/07/scxml\" \
         xmlns:gs=\"{NAMESPACE}\" version=\"1.0\" datamodel=\"asmetal\" name=\"{}\" initial=\"{initial}\"",
        Text(&machine.name)
    );
    let mut own = |name: &str, value: &str| _ = write!(out, " gs:{name}=\"{}\"", Attribute(value));
    own("kind", if machine.is_pattern { "pattern" } else { "machine" });
    own("text", &machine.text);
    if !machine.parameters.is_empty() {
        let parameters = machine.parameters.iter().map(|one| format!("{} in {}", one.variable, one.domain));
        own("parameters", &parameters.collect::<Vec<_>>().join(", "));
    }
    match &machine.control {
        Some(Control::Linked(link)) => own("control", &format!("{{{}}}", link.text)),
        Some(Control::Made { name, .. }) => own("control", name),
        None => {}
    }
    if let Some(rule) = &machine.rule {
        own("rule", &rule.text);
    }
    out.push_str(">\n");
    let all = transitions(chart, machine);
    let writer = Writer { machine };
    let mut declared = BTreeSet::new();
    for (id, shape) in machine.numbered().filter(|(id, _)| !is_block(chart, machine, *id)) {
        // A flat machine has the guards and actions on the paths of several states once for each.
        if declared.insert(&shape.name) {
            writer.declaration(&mut out, id, shape);
        }
    }
    for sequence in &machine.sequences {
        let names: Vec<&str> = sequence.iter().map(|id| machine.shape(*id).name.as_str()).collect();
        let _ = writeln!(out, "  <gs:sequence names=\"{}\"/>", names.join(", "));
    }
    if machine.is_pattern {
        writer.state(&mut out, None, None, all.iter().filter(|one| one.origin == Origin::Enter));
    }
    for (id, shape) in machine.numbered() {
        if is_block(chart, machine, id) {
            writer.state(&mut out, Some(shape), Some(id), all.iter().filter(|one| one.origin == Origin::Left(id)));
        } else if matches!(shape.kind, ShapeKind::State { .. }) {
            writer.state(&mut out, Some(shape), None, all.iter().filter(|one| one.origin == Origin::State(id)));
        }
    }
    if machine.is_pattern {
        out.push_str("  <final id=\"exit\"/>\n");
    }
    out + "</scxml>\n"
}

struct Writer<'c> {
    machine: &'c Machine,
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

    /// A guard, an action, or an instance in which the machine does not stay.
    fn declaration(&self, out: &mut String, id: ShapeId, shape: &Shape) {
        let word = match &self.machine.shape(id).kind {
            ShapeKind::State { .. } | ShapeKind::Composite(_) => return,
            ShapeKind::Guard => "guard",
            ShapeKind::Action => "action",
            ShapeKind::Instance(_) => "instance",
        };
        let _ = writeln!(out, "  <gs:{word} name=\"{}\"{}/>", Text(&shape.name), self.about("", shape));
    }

    fn state<'t>(
        &self,
        out: &mut String,
        shape: Option<&Shape>,
        block: Option<ShapeId>,
        paths: impl Iterator<Item = &'t Transition>,
    ) {
        let name = shape.map_or("enter", |shape| shape.name.as_str());
        let about = shape.map(|shape| self.about("gs:", shape)).unwrap_or_default();
        let _ = writeln!(out, "  <state id=\"{}\"{about}>", Text(name));
        if let Some(ShapeKind::Instance(pattern)) = block.map(|id| &self.machine.shape(id).kind) {
            let _ = writeln!(out, "    <invoke id=\"{}\" src=\"{}.scxml\"/>", Text(name), Text(&pattern.name));
        }
        for path in paths {
            self.transition(out, name, block.is_some(), path);
        }
        let _ = writeln!(out, "  </state>");
    }

    fn transition(&self, out: &mut String, from: &str, is_block: bool, path: &Transition) {
        let event = if is_block { format!(" event=\"done.invoke.{}\"", Text(from)) } else { String::new() };
        let guards: Vec<String> = path.guards.iter().map(|(id, holds)| self.guard(*id, *holds)).collect();
        let condition = match guards.is_empty() {
            true => String::new(),
            false => format!(" cond=\"{}\"", Attribute(&guards.join(" and "))),
        };
        let target = match path.target {
            Target::State(id) | Target::Block(id) => self.machine.shape(id).name.as_str(),
            Target::Exit => "exit",
        };
        let stops: Vec<String> = path
            .stops
            .iter()
            .map(|(id, branch)| {
                let name = &self.machine.shape(*id).name;
                match branch {
                    Some(true) => format!("{name} yes"),
                    Some(false) => format!("{name} no"),
                    None => name.clone(),
                }
            })
            .collect();
        let stops = if stops.is_empty() { String::new() } else { format!(" gs:path=\"{}\"", stops.join(", ")) };
        let _ = write!(out, "    <transition{event}{condition} target=\"{}\"{stops}", Text(target));
        let actions: Vec<String> = path.actions.iter().map(|id| call(self.machine, self.machine.shape(*id))).collect();
        let _ = match script(&actions) {
            None => writeln!(out, "/>"),
            Some(script) => writeln!(out, "><script>{}</script></transition>", Text(&script)),
        };
    }

    fn guard(&self, id: ShapeId, holds: bool) -> String {
        condition(&call(self.machine, self.machine.shape(id)), holds)
    }
}

/// A test and its outcome, as a part of a condition.
pub(crate) fn condition(text: &str, holds: bool) -> String {
    match (holds, text.contains(' ')) {
        (true, true) => format!("({text})"),
        (true, false) => text.to_string(),
        (false, _) => format!("not ({text})"),
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
