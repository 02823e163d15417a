//! Mermaid: a flowchart. What has a meaning in Mermaid or in HTML, which labels are, becomes an entity by its number.

use std::fmt::Write;

use crate::picture::Figure;
use crate::scene::Scene;

/// A text as a label shows it. Letters, digits and blanks stay, and the signs that terms are written with most.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for letter in text.chars() {
        let plain = letter.is_alphanumeric() || " _$()[]{},.:=+-/'!?|".contains(letter) || !letter.is_ascii();
        if plain {
            out.push(letter);
        } else if letter.is_ascii_control() {
            out.push(' ');
        } else {
            let _ = write!(out, "#{};", u32::from(letter));
        }
    }
    out
}

/// The flowchart of a scene.
pub fn mermaid(scene: &Scene, name: &str) -> String {
    let mut out = format!("---\ntitle: {name}\n---\nflowchart TD\n");
    nodes(&mut out, scene, None);
    for edge in &scene.edges {
        let label = match edge.branch {
            Some(true) => "|yes|",
            Some(false) => "|no|",
            None => "",
        };
        let _ = writeln!(out, "  n{} -->{label} n{}", edge.from, edge.to);
    }
    out + "  classDef refine stroke-dasharray: 6 4\n  classDef end fill:none,stroke:none\n"
}

/// The nodes in a composite state; without one, those in none.
fn nodes(out: &mut String, scene: &Scene, around: Option<usize>) {
    for (index, node) in scene.nodes.iter().enumerate().filter(|(_, node)| node.inside == around) {
        let mut text = node.told().map(|line| escaped(&line)).collect::<Vec<_>>().join("<br/>");
        if let Some(link) = &node.link {
            let _ = write!(text, "<br/><small>{}</small>", escaped(link));
        }
        let _ = match node.figure {
            Figure::Composite => {
                let _ = writeln!(out, "  subgraph n{index}[\"{text}\"]");
                nodes(out, scene, Some(index));
                writeln!(out, "  end")
            }
            Figure::Circle if node.initial => writeln!(out, "  n{index}(((\"{text}\")))"),
            Figure::Circle => writeln!(out, "  n{index}((\"{text}\"))"),
            Figure::Hexagon => writeln!(out, "  n{index}{{{{\"{text}\"}}}}"),
            Figure::Block => writeln!(out, "  n{index}[[\"{text}\"]]"),
            Figure::Channel => writeln!(out, "  n{index}([\"{text}\"])"),
            Figure::Enter | Figure::Exit if text.is_empty() => writeln!(out, "  n{index}[\" \"]:::end"),
            Figure::Enter | Figure::Exit => writeln!(out, "  n{index}[\"{text}\"]:::end"),
            Figure::Rectangle | Figure::Component | Figure::Device => writeln!(out, "  n{index}[\"{text}\"]"),
        };
        if node.dashed {
            let _ = writeln!(out, "  class n{index} refine");
        }
    }
}
