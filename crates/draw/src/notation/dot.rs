//! Graphviz DOT: a directed graph. In a string, quotes and backslashes stand behind a backslash.

use std::fmt::Write;

use crate::picture::Figure;
use crate::scene::Scene;

/// The graph of a scene.
pub fn dot(scene: &Scene, name: &str) -> String {
    let is_nested = scene.nodes.iter().any(|node| node.figure == Figure::Composite);
    let compound = if is_nested { "  compound=true;\n" } else { "" };
    let mut out = format!(
        "digraph \"{}\" {{\n{compound}  node [fontname=\"Helvetica\"];\n  edge [fontname=\"Helvetica\"];\n",
        quoted(name)
    );
    nodes(&mut out, scene, None);
    for edge in &scene.edges {
        let mut told = Vec::new();
        told.extend(edge.branch.map(|yes| format!("label=\"{}\"", if yes { "yes" } else { "no" })));
        // An arrow of a composite state is one of a node in it, cut at its frame.
        for (word, index) in [("ltail", edge.from), ("lhead", edge.to)] {
            if scene.nodes[index].figure == Figure::Composite {
                told.push(format!("{word}=\"cluster_{index}\""));
            }
        }
        let told = if told.is_empty() { String::new() } else { format!(" [{}]", told.join(", ")) };
        let id = |index: usize| quoted(&scene.nodes[inner(scene, index)].id);
        let _ = writeln!(out, "  \"{}\" -> \"{}\"{told};", id(edge.from), id(edge.to));
    }
    out + "}\n"
}

/// A node that is no composite state: itself, or the first one in it.
fn inner(scene: &Scene, index: usize) -> usize {
    let first = scene.nodes.iter().position(|node| node.inside == Some(index));
    match (scene.nodes[index].figure, first) {
        (Figure::Composite, Some(first)) => inner(scene, first),
        _ => index,
    }
}

/// The nodes in a composite state; without one, those in none.
fn nodes(out: &mut String, scene: &Scene, around: Option<usize>) {
    for (index, node) in scene.nodes.iter().enumerate().filter(|(_, node)| node.inside == around) {
        let lines: Vec<String> = node.told().map(|line| quoted(&line)).collect();
        let shape = match node.figure {
            Figure::Composite => {
                let _ = writeln!(out, "  subgraph \"cluster_{index}\" {{\n  label=\"{}\";", lines.join("\\n"));
                nodes(out, scene, Some(index));
                out.push_str("  }\n");
                continue;
            }
            Figure::Circle if node.initial => "doublecircle",
            Figure::Circle => "circle",
            Figure::Hexagon => "hexagon",
            Figure::Rectangle | Figure::Device => "box",
            Figure::Block => "box3d",
            Figure::Component => "component",
            Figure::Channel => "oval",
            Figure::Enter | Figure::Exit => "none",
        };
        let style = if node.dashed { ", style=dashed" } else { "" };
        let link = node.link.as_ref().map(|link| format!(", xlabel=\"{}\"", quoted(link))).unwrap_or_default();
        let _ =
            writeln!(out, "  \"{}\" [shape={shape}, label=\"{}\"{link}{style}];", quoted(&node.id), lines.join("\\n"));
    }
}

fn quoted(text: &str) -> String {
    text.replace('\\', "\\\\").replace('"', "\\\"")
}
