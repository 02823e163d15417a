//! What a composite state has beside shapes: that it remembers, and what is done when it is entered and left.
//!
//! In: the name of a composite state. Out: the text with `history`, or with one more entry or exit action; these have texts, links and names
//! as shapes have, and go as shapes go. INVARIANT: they stand at the head of the composite state: history, entries, exits.

use syntax::SyntaxKind::{self, *};
use syntax::SyntaxNode;
use syntax::ast::{AstNode, Shape};

use super::arrow::words;
use super::name::in_camel_case;
use super::text::{linked, quoted};
use super::{Moment, Section, Work};

impl Work {
    /// The node of a composite state.
    pub(super) fn composite(&self, name: &str) -> Result<SyntaxNode, String> {
        let Section::Machine(machine) = self.section()? else {
            return Err("composite states belong to a machine".to_string());
        };
        let is_it = |shape: &Shape| shape.name().is_some_and(|own| own.text() == name);
        let found = machine.shapes().find(|shape| is_it(shape) && matches!(shape, Shape::Composite(_)));
        found.map(|shape| shape.syntax().clone()).ok_or_else(|| format!("there is no composite state `{name}`"))
    }

    /// See [`super::Operation::History`].
    pub(super) fn set_history(&mut self, name: &str, history: Option<Option<&str>>) -> Result<(), String> {
        let wanted = match history {
            Some(Some(link)) => Some(format!("history {}", linked(link)?)),
            Some(None) => Some("history".to_string()),
            None => None,
        };
        let of = |node: &SyntaxNode| node.children().find(|child| child.kind() == HISTORY);
        match (of(&self.composite(name)?), &wanted) {
            (Some(present), Some(wanted)) => {
                let tokens = words(&present);
                let (Some(first), Some(last)) = (tokens.first(), tokens.last()) else { return Ok(()) };
                self.replace(usize::from(first.text_range().start())..usize::from(last.text_range().end()), wanted);
            }
            (None, Some(wanted)) => {
                let node = self.composite(name)?;
                let inner = format!("{}\t", self.indent_of(&node));
                self.add_line_in(&node, |_| false, wanted, &inner);
            }
            (_, None) => {
                // A text may have it more than once.
                while let Some(present) = of(&self.composite(name)?) {
                    self.remove(&present);
                }
            }
        }
        self.select = vec![name.to_string()];
        Ok(())
    }

    /// See [`super::Operation::AddDoing`].
    pub(super) fn add_doing(&mut self, name: &str, moment: Moment, text: Option<&str>) -> Result<(), String> {
        let (word, otherwise, before): (_, _, &[SyntaxKind]) = match moment {
            Moment::Entry => ("entry", "begin", &[ENTRY_ACTION, HISTORY]),
            Moment::Exit => ("exit", "end", &[EXIT_ACTION, ENTRY_ACTION, HISTORY]),
        };
        let node = self.composite(name)?;
        let own = self.fresh_name(&text.map(in_camel_case).unwrap_or_default(), otherwise)?;
        let shown = text.map(|text| format!(" {}", quoted(text))).unwrap_or_default();
        let inner = format!("{}\t", self.indent_of(&node));
        let behind = before.iter().find(|kind| node.children().any(|child| child.kind() == **kind));
        self.add_line_in(&node, |child| Some(&child.kind()) == behind, &format!("{word} {own}{shown}"), &inner);
        self.select = vec![name.to_string()];
        Ok(())
    }
}
