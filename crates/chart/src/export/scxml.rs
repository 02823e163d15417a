//! SCXML: a state for each control state, a transition for each path, its guards as the condition and its actions as the
//! script, both in AsmetaL. A pattern begins in the state `enter` and ends in the final state `exit`; an instance on a path
//! invokes its pattern, and goes on when that is done.
//!
//! LIMIT: of two paths whose guards hold together SCXML takes the first one; in a chart they are parallel.

use std::fmt::Write;

use crate::build::call;
use crate::chart::{Chart, Machine, ShapeId, ShapeKind};
use crate::draw::Text;
use crate::flow::{Origin, Target, Transition, is_block, transitions};

/// The SCXML of a machine.
pub(super) fn scxml(chart: &Chart, machine: &Machine) -> String {
    let initial = match machine.initial() {
        Some(id) if !machine.is_pattern => machine.shape(id).name.as_str(),
        _ => "enter",
    };
    let mut out = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<scxml xmlns=\"http://www.w3.org/2005/07/scxml\" version=\"1.0\" \
         datamodel=\"asmetal\" name=\"{}\" initial=\"{initial}\">\n",
        Text(&machine.name)
    );
    let all = transitions(chart, machine);
    let writer = Writer { machine };
    if machine.is_pattern {
        writer.state(&mut out, "enter", None, all.iter().filter(|one| one.origin == Origin::Enter));
    }
    for (id, shape) in machine.numbered() {
        if is_block(chart, machine, id) {
            let source = match &shape.kind {
                ShapeKind::Instance(pattern) => pattern.name.clone(),
                _ => String::new(),
            };
            writer.state(&mut out, &shape.name, Some(&source), all.iter().filter(|one| one.origin == Origin::Left(id)));
        } else if matches!(shape.kind, ShapeKind::State { .. }) {
            writer.state(&mut out, &shape.name, None, all.iter().filter(|one| one.origin == Origin::State(id)));
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

impl Writer<'_> {
    fn state<'t>(
        &self,
        out: &mut String,
        name: &str,
        invoked: Option<&str>,
        paths: impl Iterator<Item = &'t Transition>,
    ) {
        let _ = writeln!(out, "  <state id=\"{}\">", Text(name));
        if let Some(source) = invoked {
            let _ = writeln!(out, "    <invoke id=\"{0}\" src=\"{1}.scxml\"/>", Text(name), Text(source));
        }
        for path in paths {
            let event = invoked.map(|_| format!(" event=\"done.invoke.{}\"", Text(name))).unwrap_or_default();
            let guards: Vec<String> = path.guards.iter().map(|(id, holds)| self.guard(*id, *holds)).collect();
            let condition = match guards.is_empty() {
                true => String::new(),
                false => format!(" cond=\"{}\"", Text(&guards.join(" and "))),
            };
            let target = match path.target {
                Target::State(id) | Target::Block(id) => self.machine.shape(id).name.as_str(),
                Target::Exit => "exit",
            };
            let _ = write!(out, "    <transition{event}{condition} target=\"{}\"", Text(target));
            let actions: Vec<String> =
                path.actions.iter().map(|id| call(self.machine, self.machine.shape(*id))).collect();
            let _ = match &actions[..] {
                [] => writeln!(out, "/>"),
                [one] => writeln!(out, "><script>{}</script></transition>", Text(one)),
                several => writeln!(out, "><script>par {} endpar</script></transition>", Text(&several.join(" "))),
            };
        }
        let _ = writeln!(out, "  </state>");
    }

    fn guard(&self, id: ShapeId, holds: bool) -> String {
        let text = call(self.machine, self.machine.shape(id));
        match (holds, text.contains(' ')) {
            (true, true) => format!("({text})"),
            (true, false) => text,
            (false, _) => format!("not ({text})"),
        }
    }
}
