//! Derives names of shapes from foreign names and texts.

use std::collections::BTreeSet;

use crate::chart::WORDS;

/// Names in use in one machine.
#[derive(Debug, Default)]
pub(super) struct Names {
    taken: BTreeSet<String>,
}

impl Names {
    /// An unused name derived from a text. Case does not distinguish names, since literals are derived from them.
    pub(super) fn fresh(&mut self, text: &str) -> String {
        let base = bare(text);
        let mut name = base.clone();
        let mut count = 2;
        while WORDS.contains(&name.as_str()) || !self.taken.insert(key(&name)) {
            name = format!("{base}{count}");
            count += 1;
        }
        name
    }
}

fn key(name: &str) -> String {
    name.replace('_', "").to_lowercase()
}

/// The letters, digits and underscores of a text, with words joined; it begins with a letter.
pub(super) fn bare(text: &str) -> String {
    let mut out = String::new();
    let mut gap = false;
    for letter in text.chars().take(60) {
        if letter.is_ascii_alphanumeric() || letter == '_' {
            if std::mem::take(&mut gap) && !out.is_empty() {
                out.push('_');
            }
            out.push(letter);
        } else {
            gap = true;
        }
    }
    let starts = out.starts_with(|letter: char| letter.is_ascii_alphabetic());
    if starts { out } else { format!("x{out}") }
}

/// A name that a function can have: it begins with a lower-case letter.
pub(super) fn function(text: &str) -> String {
    let name = bare(text);
    let mut letters = name.chars();
    let small = letters.next().map(|first| first.to_lowercase().chain(letters).collect()).unwrap_or(name);
    if crate::read::names_function(&small) { small } else { format!("{small}_") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names() {
        assert_eq!(bare("button.pressed"), "button_pressed");
        assert_eq!(bare("  In('s 1')"), "In_s_1");
        assert_eq!(bare("3 times"), "x3_times");
        assert_eq!(function("Open"), "open");
        assert_eq!(function("if"), "if_");
        let mut names = Names::default();
        let made = ["idle", "Idle", "state", "idle"].map(|name| names.fresh(name));
        assert_eq!(made, ["idle", "Idle2", "state2", "idle3"]);
    }
}
