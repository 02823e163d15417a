//! Drawings as text for other tools: Mermaid and Graphviz DOT. They show what ours show, in the shapes those tools have;
//! SCXML, which says what a machine does, comes from `chart`.

mod dot;
mod mermaid;

use crate::drawing::Drawing;

/// A notation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Notation {
    /// Flowcharts of <https://mermaid.js.org>.
    Mermaid,
    /// The graph language of <https://graphviz.org>.
    Dot,
    /// The W3C's State Chart XML, <https://www.w3.org/TR/scxml/>.
    Scxml,
}

/// A machine or system in another notation; none for a system in SCXML, which has no word for it.
pub fn export(drawing: &Drawing<'_>, notation: Notation) -> Option<String> {
    let subject = drawing.subject();
    match notation {
        Notation::Mermaid => Some(mermaid::mermaid(&drawing.scene(), drawing.name())),
        Notation::Dot => Some(dot::dot(&drawing.scene(), drawing.name())),
        Notation::Scxml => subject.machine().map(|machine| chart::scxml_of(subject.chart, machine)),
    }
}
