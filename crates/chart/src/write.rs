//! Writes the text of a chart file, in its canonical layout.
//!
//! INVARIANT: reading the text gives the same chart, except for places. Each path is as long as possible.

use std::fmt::Write;

use crate::chart::{Arrow, Chart, Composite, Control, End, History, Machine, Shape, ShapeId, ShapeKind};

/// The text of a chart.
pub fn write(chart: &Chart) -> String {
    let mut out = format!("chart {}\n", chart.name);
    for import in chart.charts.iter().chain(&chart.imports) {
        let _ = writeln!(out, "import \"{import}\"");
    }
    for machine in &chart.machines {
        one(&mut out, machine);
    }
    for (name, layout) in &chart.layouts {
        let _ = writeln!(out, "layout {name}");
        for (shape, (x, y)) in layout {
            let _ = writeln!(out, "{shape} at {x}, {y}");
        }
        let _ = writeln!(out, "endlayout");
    }
    let parse = syntax::parse_chart(syntax::FileId(0), &out);
    syntax::format(&parse)
}

fn one(out: &mut String, machine: &Machine) {
    let word = if machine.is_pattern { "pattern" } else { "machine" };
    let parameters: Vec<String> =
        machine.parameters.iter().map(|parameter| format!("{} in {}", parameter.variable, parameter.domain)).collect();
    let parameters = if parameters.is_empty() { String::new() } else { format!("({})", parameters.join(", ")) };
    let rule = machine.rule.as_ref().map(|link| format!(" {{{}}}", link.text)).unwrap_or_default();
    let _ = writeln!(out, "\n{word} {}{parameters} {}{rule}", machine.name, quoted(&machine.text));
    match &machine.control {
        Some(Control::Linked(link)) => _ = writeln!(out, "control {{{}}}", link.text),
        Some(Control::Made { name, .. }) => _ = writeln!(out, "control {name}"),
        None => {}
    }
    shapes(out, machine, None);
    for sequence in &machine.sequences {
        let names: Vec<&str> = sequence.iter().map(|id| machine.shape(*id).name.as_str()).collect();
        let _ = writeln!(out, "sequence {}", names.join(", "));
    }
    paths(out, machine);
    let _ = writeln!(out, "end{word}");
}

/// The shapes in a composite state; without one, those of the machine in none.
fn shapes(out: &mut String, machine: &Machine, around: Option<ShapeId>) {
    for (id, shape) in machine.numbered().filter(|(_, shape)| shape.inside == around) {
        let _ = writeln!(out, "{}", declaration(machine, id, shape));
        let Some(composite) = shape.composite() else { continue };
        match &composite.history {
            Some(History::Linked(link)) => _ = writeln!(out, "history {{{}}}", link.text),
            Some(History::Made) => _ = writeln!(out, "history"),
            None => {}
        }
        shapes(out, machine, Some(id));
        let _ = writeln!(out, "endstate");
    }
}

/// A text as a string of a chart.
pub(crate) fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\"").replace('\n', "\\n"))
}

fn declaration(machine: &Machine, id: ShapeId, shape: &Shape) -> String {
    let around = shape.inside.and_then(|around| machine.shape(around).composite());
    let (word, of) = match &shape.kind {
        ShapeKind::Composite(Composite { initial: true, .. }) => ("initial composite state", String::new()),
        ShapeKind::Composite(_) => ("composite state", String::new()),
        ShapeKind::Action if around.is_some_and(|around| around.entry.contains(&id)) => ("entry", String::new()),
        ShapeKind::Action if around.is_some_and(|around| around.exit.contains(&id)) => ("exit", String::new()),
        ShapeKind::Action if machine.aborts.contains(&id) => ("abort", String::new()),
        ShapeKind::State { initial: true } => ("initial state", String::new()),
        ShapeKind::State { initial: false } => ("state", String::new()),
        ShapeKind::Guard => ("guard", String::new()),
        ShapeKind::Action => ("action", String::new()),
        ShapeKind::Instance(pattern) => ("instance", format!(" of {}({})", pattern.name, pattern.arguments.join(", "))),
    };
    let link = shape.link.as_ref().map(|link| format!(" {{{}}}", link.text)).unwrap_or_default();
    let refinement = match &shape.refinement {
        Some(refinement) => match &refinement.by {
            Some(by) => format!(" to refine by {by}"),
            None => " to refine".to_string(),
        },
        None => String::new(),
    };
    format!("{word} {}{of} {}{link}{refinement}", shape.name, quoted(&shape.text))
}

/// The arrows, each once, joined into paths.
fn paths(out: &mut String, machine: &Machine) {
    let name = |end: End| match end {
        End::Enter => "enter",
        End::Exit => "exit",
        End::Shape(id) => machine.shape(id).name.as_str(),
    };
    let end = |arrow: &Arrow| match arrow.answer {
        Some(true) => format!("{} yes", name(arrow.to)),
        Some(false) => format!("{} no", name(arrow.to)),
        None => name(arrow.to).to_string(),
    };
    let stop = |arrow: &Arrow| match arrow.branch {
        Some(true) => format!("{} yes", name(arrow.from)),
        Some(false) => format!("{} no", name(arrow.from)),
        None => name(arrow.from).to_string(),
    };
    let is_state = |end: End| match end {
        End::Shape(id) => {
            matches!(machine.shape(id).kind, ShapeKind::State { .. } | ShapeKind::Composite(_) | ShapeKind::Instance(_))
        }
        _ => true,
    };
    let mut done = vec![false; machine.arrows.len()];
    // Paths begin at states first, then at the remaining exits of guards.
    for states in [true, false] {
        for start in 0..machine.arrows.len() {
            if done[start] || is_state(machine.arrows[start].from) != states {
                continue;
            }
            let mut index = start;
            loop {
                done[index] = true;
                let arrow = &machine.arrows[index];
                let _ = write!(out, "{} -> ", stop(arrow));
                let next = machine.arrows.iter().position(|next| next.from == arrow.to);
                match next.filter(|next| !done[*next] && !is_state(arrow.to)) {
                    Some(next) => index = next,
                    None => {
                        let _ = writeln!(out, "{}", end(arrow));
                        break;
                    }
                }
            }
        }
    }
}
