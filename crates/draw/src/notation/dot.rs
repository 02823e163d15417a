//! Graphviz DOT: a directed graph. In a string, quotes and backslashes stand behind a backslash.

use std::fmt::Write;

use crate::picture::Figure;
use crate::scene::Scene;

/// The graph of a scene.
pub fn dot(scene: &Scene, name: &str) -> String {
    let quoted = |text: &str| text.replace('\\', "\\\\").replace('"', "\\\"");
    let mut out = format!(
        "digraph \"{}\" {{\n  node [fontname=\"Helvetica\"];\n  edge [fontname=\"Helvetica\"];\n",
        quoted(name)
    );
    for node in &scene.nodes {
        let shape = match node.figure {
            Figure::Circle if node.initial => "doublecircle",
            Figure::Circle => "circle",
            Figure::Hexagon => "hexagon",
            Figure::Rectangle | Figure::Device => "box",
            Figure::Block => "box3d",
            Figure::Component => "component",
            Figure::Channel => "oval",
            Figure::Enter | Figure::Exit => "none",
        };
        let lines: Vec<String> = node.told().map(|line| quoted(&line)).collect();
        let style = if node.dashed { ", style=dashed" } else { "" };
        let link = node.link.as_ref().map(|link| format!(", xlabel=\"{}\"", quoted(link))).unwrap_or_default();
        let _ =
            writeln!(out, "  \"{}\" [shape={shape}, label=\"{}\"{link}{style}];", quoted(&node.id), lines.join("\\n"));
    }
    for edge in &scene.edges {
        let label = match edge.branch {
            Some(true) => " [label=\"yes\"]",
            Some(false) => " [label=\"no\"]",
            None => "",
        };
        let id = |index: usize| quoted(&scene.nodes[index].id);
        let _ = writeln!(out, "  \"{}\" -> \"{}\"{label};", id(edge.from), id(edge.to));
    }
    out + "}\n"
}
