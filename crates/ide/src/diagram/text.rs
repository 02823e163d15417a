//! What a shape says: its text, its link, whether it is to be refined, whether the machine starts in it.

use syntax::SyntaxKind::*;
use syntax::ast::{AstNode, Shape};
use syntax::{FileId, Severity, SyntaxNode, SyntaxToken, parse_chart};

use super::arrow::words;
use super::name::is_name;
use super::{Section, Work};

impl Work {
    /// The node that declares a part of the drawing.
    fn declaration(&self, name: &str) -> Result<SyntaxNode, String> {
        let is = |token: Option<SyntaxToken>| token.is_some_and(|token| token.text() == name);
        let found = match self.section()? {
            Section::Machine(machine) => {
                machine.shapes().find(|shape| is(shape.name())).map(|shape| shape.syntax().clone())
            }
            Section::System(system) => {
                let component = system.components().find(|part| is(part.name())).map(|part| part.syntax().clone());
                component.or_else(|| system.devices().find(|part| is(part.name())).map(|part| part.syntax().clone()))
            }
        };
        found.ok_or_else(|| format!("`{name}` has no text of its own"))
    }

    /// See [`super::Operation::Text`].
    pub(super) fn set_text(&mut self, name: &str, text: Option<&str>) -> Result<(), String> {
        let node = if name == self.drawing { self.section()?.syntax().clone() } else { self.declaration(name)? };
        let own = own_tokens(&node);
        let present = own.iter().find(|token| token.kind() == STRING);
        match (present, text) {
            (Some(token), Some(text)) => self.replace(range(token), &quoted(text)),
            (Some(token), None) => self.take(token),
            (None, Some(text)) => {
                let at = self.behind_name(&node);
                self.replace(at..at, &format!(" {}", quoted(text)));
            }
            (None, None) => {}
        }
        self.select = vec![name.to_string()];
        Ok(())
    }

    /// See [`super::Operation::Link`].
    pub(super) fn set_link(&mut self, name: &str, link: Option<&str>) -> Result<(), String> {
        let node = self.declaration(name)?;
        if Shape::cast(node.clone()).is_none() {
            return Err(format!("`{name}` has no link"));
        }
        let present = node.children().find(|child| child.kind() == LINK);
        match (present.as_ref().map(words), link) {
            (Some(tokens), Some(link)) => {
                let (Some(first), Some(last)) = (tokens.first(), tokens.last()) else { return Ok(()) };
                self.replace(range(first).start..range(last).end, &linked(link)?);
            }
            (Some(tokens), None) => {
                let (Some(first), Some(last)) = (tokens.first(), tokens.last()) else { return Ok(()) };
                let start = self.text[..range(first).start].trim_end_matches([' ', '\t']).len();
                self.replace(start..range(last).end, "");
            }
            (None, Some(link)) => {
                let string = own_tokens(&node).into_iter().find(|token| token.kind() == STRING);
                let at = string.map_or_else(|| self.behind_name(&node), |token| range(&token).end);
                self.replace(at..at, &format!(" {}", linked(link)?));
            }
            (None, None) => {}
        }
        self.select = vec![name.to_string()];
        Ok(())
    }

    /// See [`super::Operation::Refine`].
    pub(super) fn set_refinement(&mut self, name: &str, refinement: Option<Option<&str>>) -> Result<(), String> {
        let node = self.declaration(name)?;
        if !matches!(Shape::cast(node.clone()), Some(Shape::Guard(_) | Shape::Action(_))) {
            return Err("only guards and actions are to be refined".to_string());
        }
        if let Some(Some(by)) = refinement
            && !is_name(by)
        {
            return Err(format!("`{by}` is no name"));
        }
        let wanted = refinement.map(|by| match by {
            Some(by) => format!(" to refine by {by}"),
            None => " to refine".to_string(),
        });
        let present = node.children().find(|child| child.kind() == REFINEMENT).map(|node| words(&node));
        let (start, end) = match present.as_deref() {
            Some([first, .., last]) => (range(first).start, range(last).end),
            _ => {
                let end = words(&node).last().map_or(0, |token| range(token).end);
                (end, end)
            }
        };
        let start = self.text[..start].trim_end_matches([' ', '\t']).len();
        self.replace(start..end, &wanted.unwrap_or_default());
        self.select = vec![name.to_string()];
        Ok(())
    }

    /// See [`super::Operation::Initial`].
    pub(super) fn set_initial(&mut self, name: &str) -> Result<(), String> {
        let Section::Machine(machine) = self.section()? else {
            return Err("a system starts in no control state".to_string());
        };
        let is_it = |shape: &Shape| shape.name().is_some_and(|own| own.text() == name);
        let is_state = |shape: &Shape| matches!(shape, Shape::State(_) | Shape::Composite(_));
        let Some(wanted) = machine.shapes().find(|shape| is_state(shape) && is_it(shape)) else {
            return Err(format!("`{name}` is no control state"));
        };
        let around = wanted.syntax().parent();
        // In a composite state of a pattern one is the first.
        if machine.is_pattern() && around.as_ref() == Some(machine.syntax()) {
            return Err("a pattern starts where its entering arrow leads".to_string());
        }
        let mut edits: Vec<(std::ops::Range<usize>, &str)> = Vec::new();
        for shape in machine.shapes().filter(|shape| shape.syntax().parent() == around) {
            let is_initial = match &shape {
                Shape::State(state) => state.is_initial(),
                Shape::Composite(state) => state.is_initial(),
                _ => continue,
            };
            let tokens = words(shape.syntax());
            match (is_initial, is_it(&shape), tokens.as_slice()) {
                (true, false, [initial, word, ..]) => edits.push((range(initial).start..range(word).start, "")),
                (false, true, [word, ..]) => edits.push((range(word).start..range(word).start, "initial ")),
                _ => {}
            }
        }
        for (range, text) in edits.into_iter().rev() {
            self.replace(range, text);
        }
        self.select = vec![name.to_string()];
        Ok(())
    }

    /// Behind the name of a declaration, where its text stands; behind the pattern of an instance and its arguments.
    fn behind_name(&self, node: &SyntaxNode) -> usize {
        let own = own_tokens(node);
        let mut names = own.iter().filter(|token| token.kind() == GENERIC_ID);
        let name = match node.kind() {
            PATTERN_INSTANCE => names.next_back(),
            _ => names.next(),
        };
        let end = name.map_or(0, |token| range(token).end);
        let behind = node.children().filter(|child| matches!(child.kind(), ARGUMENT_LIST | PARAMETER_LIST));
        behind.filter_map(|list| words(&list).last().map(|token| range(token).end)).fold(end, usize::max)
    }

    /// Takes a token away with the blanks before it.
    fn take(&mut self, token: &SyntaxToken) {
        let start = self.text[..range(token).start].trim_end_matches([' ', '\t']).len();
        self.replace(start..range(token).end, "");
    }
}

fn own_tokens(node: &SyntaxNode) -> Vec<SyntaxToken> {
    node.children_with_tokens().filter_map(|element| element.into_token()).collect()
}

fn range(token: &SyntaxToken) -> std::ops::Range<usize> {
    token.text_range().into()
}

/// From the first word of a node to its last one.
pub(super) fn extent(node: &SyntaxNode) -> std::ops::Range<usize> {
    let tokens = words(node);
    let start = tokens.first().map_or(0, |token| range(token).start);
    start..tokens.last().map_or(start, |token| range(token).end)
}

/// A text as charts write it.
pub(super) fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for letter in text.chars() {
        match letter {
            '"' => out.push_str("\\\""),
            '\\' => out.push_str("\\\\"),
            '\n' => out.push_str("\\n"),
            letter if letter.is_control() => {}
            letter => out.push(letter),
        }
    }
    out + "\""
}

/// A link as charts write it.
pub(super) fn linked(link: &str) -> Result<String, String> {
    let link = link.trim();
    // What closes the brace, or runs to the end of the file, would change what stands behind it.
    let reads = |word: &str| {
        let probe = format!("chart A machine m {word} x {{{link}}} state y endmachine");
        let parse = parse_chart(FileId(0), &probe);
        let shapes = syntax::ast::ChartFile::cast(parse.syntax())
            .and_then(|file| Some(file.machines().next()?.shapes().count()));
        shapes == Some(2) && !parse.diagnostics.iter().any(|fault| fault.severity == Severity::Error)
    };
    match !link.is_empty() && ["state", "guard", "action", "instance p of q"].iter().any(|word| reads(word)) {
        true => Ok(format!("{{{link}}}")),
        false => Err(format!("`{link}` is no term or rule of AsmetaL")),
    }
}
