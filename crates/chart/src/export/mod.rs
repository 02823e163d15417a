//! Charts in the notations of other tools: Mermaid and Graphviz DOT for pictures, SCXML for state machines.
//!
//! In: a chart without errors. Out: one text a machine or system. Pictures say what ours say, in the shapes those tools
//! have; SCXML says what the machine does, with AsmetaL as its data model.

mod dot;
mod mermaid;
pub(crate) mod scxml;

use crate::draw::Drawing;

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
    match notation {
        Notation::Mermaid => Some(mermaid::mermaid(&drawing.scene(), drawing.name())),
        Notation::Dot => Some(dot::dot(&drawing.scene(), drawing.name())),
        Notation::Scxml => drawing.machine().map(|machine| scxml::scxml(drawing.chart(), machine)),
    }
}
