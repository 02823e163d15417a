//! Names for what is drawn: made of what it shows, and taken by nothing else.

use syntax::SyntaxKind::*;
use syntax::SyntaxNode;
use syntax::ast::{AstNode, Phase, PhaseKind};

use super::{Section, Work};

/// LIMIT: letters of a name that is made.
const LENGTH: usize = 40;

impl Work {
    /// A name for a new part of the drawing that nothing there has.
    pub(super) fn fresh_name(&self, wanted: &str, otherwise: &str) -> Result<String, String> {
        let taken = self.names()?;
        let base = if is_name(wanted) { wanted.to_string() } else { otherwise.to_string() };
        if !taken.contains(&base) {
            return Ok(base);
        }
        let stem = base.trim_end_matches(|c: char| c.is_ascii_digit());
        let stem = if stem.is_empty() { otherwise } else { stem };
        let numbered = (2..).map(|number| format!("{stem}{number}"));
        Ok(numbered.into_iter().find(|name| !taken.contains(name)).unwrap_or(base))
    }

    /// See [`super::Operation::Rename`].
    pub(super) fn rename(&mut self, name: &str, to: &str) -> Result<(), String> {
        self.select = vec![to.to_string()];
        if name == to {
            return Ok(());
        }
        if !is_name(to) {
            return Err(format!("`{to}` is no name: a letter first, then letters, digits and _; no word of charts"));
        }
        if name == "enter" || !self.shown()?.iter().any(|known| known == name) {
            return Err(format!("there is no shape `{name}`"));
        }
        if self.names()?.iter().any(|taken| taken == to) {
            return Err(format!("`{to}` is there already"));
        }
        let section = self.section()?;
        let layout = self.layout()?.map(|layout| layout.syntax().clone());
        let nodes = [Some(section.syntax().clone()), layout];
        let mut found: Vec<std::ops::Range<usize>> = Vec::new();
        for node in nodes.iter().flatten() {
            for child in node.descendants() {
                let tokens = child.children_with_tokens().filter_map(|element| element.into_token());
                let mut own = tokens.filter(|token| token.kind() == GENERIC_ID);
                // Which of the names in a node are those of parts of the drawing; links are AsmetaL.
                let named: Vec<_> = match child.kind() {
                    CONTROL_STATE | COMPOSITE_STATE | GUARD_SHAPE | ACTION_SHAPE | ENTRY_ACTION | EXIT_ACTION
                    | ABORT_ACTION | PATTERN_INSTANCE | COMPONENT | DEVICE | PLACEMENT => {
                        own.next().into_iter().collect()
                    }
                    PHASE if !is_elaboration(&child) => own.next().into_iter().collect(),
                    PATH_STOP | SEQUENCE | AWAITS | CHANNEL | CHANNEL_KIND | AGE_BOUND | CONNECTION => own.collect(),
                    _ => continue,
                };
                let named = named.iter().filter(|token| token.text() == name);
                found.extend(named.map(|token| std::ops::Range::from(token.text_range())));
            }
        }
        found.sort_by_key(|range| range.start);
        found.into_iter().rev().for_each(|range| self.replace(range, to));
        Ok(())
    }

    /// The names of all parts of the drawing.
    pub(super) fn names(&self) -> Result<Vec<String>, String> {
        let section = self.section()?;
        let mut names: Vec<String> = match &section {
            Section::Machine(machine) => {
                machine.shapes().filter_map(|shape| shape.name()).map(|name| name.text().to_string()).collect()
            }
            Section::System(system) => {
                let components = system.components().filter_map(|component| component.name());
                let channels = system.channels().filter_map(|channel| channel.name());
                let devices = system.devices().filter_map(|device| device.name());
                components.chain(channels).chain(devices).map(|name| name.text().to_string()).collect()
            }
        };
        // What is broken may have names that no view shows.
        let words = section.syntax().descendants_with_tokens().filter_map(|element| element.into_token());
        let named = words.filter(|token| token.kind() == GENERIC_ID);
        names.extend(named.map(|token| token.text().to_string()));
        Ok(names)
    }
}

fn is_elaboration(node: &SyntaxNode) -> bool {
    Phase::cast(node.clone()).is_some_and(|phase| phase.kind() == Some(PhaseKind::Elaborate))
}

/// Whether a text is a name in charts.
pub(super) fn is_name(text: &str) -> bool {
    let fits = text.chars().all(|c| c.is_ascii_alphanumeric() || c == '_') && text.len() <= 200;
    if !fits || !text.starts_with(|c: char| c.is_ascii_alphabetic()) {
        return false;
    }
    !chart::WORDS.contains(&text)
}

/// "Time elapsed" → timeElapsed.
pub(super) fn in_camel_case(text: &str) -> String {
    let mut name = String::new();
    for word in text.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty()) {
        let shouts = !word.chars().any(|c| c.is_ascii_lowercase());
        let rest = if shouts { word[1..].to_ascii_lowercase() } else { word[1..].to_string() };
        let first = &word[..1];
        name += &if name.is_empty() { first.to_ascii_lowercase() } else { first.to_ascii_uppercase() };
        name += &rest;
        if name.len() > LENGTH {
            break;
        }
    }
    name
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_made_of_what_is_shown() {
        let check = |text: &str, name: &str| assert_eq!(in_camel_case(text), name);
        check("Time elapsed", "timeElapsed");
        check("WRITE ON SB", "writeOnSb");
        check("  image >= 3? ", "image3");
        check("Größe", "grE");
        check("", "");
        let words = ["state", "enter", "endmachine", "yes", "exit"];
        assert_eq!(words.map(is_name), [false; 5], "words of the grammar are no names");
        assert!(is_name("timeElapsed") && is_name("a_1") && !is_name("1a") && !is_name("ä") && !is_name(""));
    }
}
