//! What can be written at a place of `MODEL.report.yaml` or `MODEL.verify.yaml`: its keys, and terms of the model.
//!
//! In: a text, however broken, and an offset. Out: the keys that lead there, and a [`Slot`]. Only lines and their indents are read, so
//! that a text that is no YAML yet is as good as one that is. The keys of a report are those of its reader; those of a verification are
//! the ones that its reader knows, which a test holds them to.

use groundstate::Kind;
use groundstate::report::{Tone, keys};

/// What may stand at a place.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Slot {
    /// One of these keys, with a colon behind it.
    Keys(Vec<&'static str>),
    /// One of these words.
    Words(Vec<&'static str>),
    /// A term of the model; whether it is a condition.
    Term { condition: bool },
    /// An input of the model; whether it is a key.
    Input { is_key: bool },
    /// A term as a key.
    TermKey,
    /// The file of a chart, as a key.
    Chart,
    /// Nothing that is known.
    Nothing,
}

/// What may stand at an offset, the bytes of the word that is there, and whether a colon is behind it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct At {
    pub range: (u32, u32),
    pub slot: Slot,
    pub has_colon: bool,
}

/// What may stand at an offset of a specification.
pub(super) fn at(kind: Kind, text: &str, offset: u32) -> Option<At> {
    let offset = (offset as usize).min(text.len());
    let before = text.get(..offset)?;
    let line_start = before.rfind('\n').map_or(0, |end| end + 1);
    let Line { mut path, value } = line(&before[line_start..])?;
    let mut outer = ancestors(&before[..line_start], &before[line_start..]);
    // Behind `- ` an item is meant; what is deeper than its key belongs to the key.
    outer.append(&mut path);
    let word = before.len() - before.trim_end_matches(|c: char| c.is_alphanumeric() || "_$".contains(c)).len();
    let rest = text[offset..].trim_start_matches(|c: char| c.is_alphanumeric() || "_$".contains(c));
    let keys: Vec<&str> = outer.iter().map(String::as_str).collect();
    let slot = match kind {
        Kind::Report => in_report(&keys, value),
        Kind::Verification => in_verification(&keys, value),
        Kind::Model | Kind::Scenario | Kind::Chart | Kind::Coupling => Slot::Nothing,
    };
    let range = ((offset - word) as u32, offset as u32);
    Some(At { range, slot, has_colon: rest.starts_with(':') })
}

fn in_report(path: &[&str], value: bool) -> Slot {
    let group =
        |name: &str| keys::LANES.into_iter().find(|lanes| lanes.group == name).map(|lanes| (lanes.told, lanes.terms));
    let term = Slot::Term { condition: false };
    let condition = Slot::Term { condition: true };
    match (path, value) {
        ([], false) => Slot::Keys(keys::ROOT.to_vec()),
        (["activities"], false) => Slot::TermKey,
        (["activities", _, ..], true) => Slot::Words(Tone::ALL.map(Tone::name).to_vec()),
        ([of], false) if group(of).is_some() => Slot::Keys(keys::GROUP.to_vec()),
        ([of, "each"], false) if group(of).is_some() => Slot::TermKey,
        ([of, "terms"], false) => group(of).map_or(Slot::Nothing, |(_, terms)| Slot::Keys(terms.to_vec())),
        ([of, "each", _], false) => group(of).map_or(Slot::Nothing, |(told, terms)| Slot::Keys([told, terms].concat())),
        ([of, "terms" | "counters", _], true) if group(of).is_some() => term,
        ([of, "each", _, key], true) => match group(of) {
            Some((_, terms)) if terms.contains(key) => term,
            _ => Slot::Nothing,
        },
        (["series", _], false) => Slot::Keys(keys::SERIES.to_vec()),
        (["series", _, "value" | "bound"], true) => term,
        (["series", _, "unit"], true) => Slot::Words(keys::UNITS.to_vec()),
        (["flow"], false) => Slot::Keys(keys::FLOW.to_vec()),
        (["flow", "hops", ITEM], false) => Slot::Keys(keys::HOP.to_vec()),
        (["flow", "hops", ITEM, "task" | "value"], true) => term,
        (["charts"], false) => Slot::Chart,
        (["charts", _], false) => Slot::Keys(keys::CHART.to_vec()),
        (["charts", _, "each", ..], true) => term,
        (["charts", _, "machines", _], false) => Slot::Keys(keys::MACHINE.to_vec()),
        (["charts", _, "machines", _, "when"], true) => condition,
        _ => Slot::Nothing,
    }
}

fn in_verification(keys: &[&str], value: bool) -> Slot {
    match (keys, value) {
        ([], false) => {
            Slot::Keys(vec!["bounds", "undefined", "assume", "terminal", "fair", "invariants", "ctl", "ltl"])
        }
        (["bounds"], false) => Slot::Input { is_key: true },
        (["undefined", ..], true) => Slot::Input { is_key: false },
        (["bounds", ..], true) => Slot::Term { condition: false },
        (["fair"], true) => Slot::Words(vec!["weak", "strong"]),
        (["assume" | "terminal" | "invariants" | "ctl" | "ltl", ..], _) => Slot::Term { condition: true },
        _ => Slot::Nothing,
    }
}

/// What an item of a list is called in a path.
const ITEM: &str = "-";

/// What a line says up to the cursor: the keys and items that are opened in it, and whether a value is being written.
#[derive(Debug, PartialEq, Eq)]
struct Line {
    path: Vec<String>,
    value: bool,
}

fn indent(line: &str) -> usize {
    line.len() - line.trim_start_matches(' ').len()
}

/// Reads a line up to the cursor; none in a comment.
fn line(before: &str) -> Option<Line> {
    let mut path = Vec::new();
    let mut rest = before.trim_start_matches(' ');
    while let Some(item) = rest.strip_prefix("- ").or_else(|| (rest == "-").then_some("")) {
        path.push(ITEM.to_string());
        rest = item.trim_start_matches(' ');
    }
    if rest.starts_with('#') {
        return None;
    }
    let is_item = !path.is_empty();
    let Some((key, value)) = key(rest) else {
        // In a list a text is a value as well as the beginning of a key: formulas are texts.
        return Some(match flow(rest, &mut path) {
            Some(value) => Line { path, value },
            None => Line { path, value: is_item && rest.starts_with(['"', '\'']) },
        });
    };
    path.push(key.to_string());
    if value.contains(" #") && !value.trim_start().starts_with(['"', '\'']) {
        return None;
    }
    let value = value.trim_start();
    let is_value = flow(value, &mut path).unwrap_or(true);
    Some(Line { path, value: is_value })
}

/// A key with what stands behind its colon.
fn key(text: &str) -> Option<(&str, &str)> {
    let (open, quote) = match text.chars().next() {
        Some(quote @ ('"' | '\'')) => (1, Some(quote)),
        Some('{' | '[' | '#') | None => return None,
        Some(_) => (0, None),
    };
    let end = match quote {
        Some(quote) => open + text[open..].find(quote)?,
        None => {
            text.char_indices().find(|(at, letter)| *letter == ':' && ends_key(&text[at + 1..])).map(|(at, _)| at)?
        }
    };
    let key = &text[open..end];
    let behind = text[end + open..].strip_prefix(':')?;
    ends_key(behind).then_some((key, behind))
}

fn ends_key(behind: &str) -> bool {
    behind.is_empty() || behind.starts_with([' ', '\t'])
}

/// Reads `{ key: value, key: …` and `[value, …`. Out: whether a value is being written; none if the text is neither.
fn flow(text: &str, path: &mut Vec<String>) -> Option<bool> {
    if !text.starts_with(['{', '[']) {
        return None;
    }
    // For each bracket that is open: whether it has keys, and whether one was written.
    let mut open: Vec<(bool, bool)> = Vec::new();
    let mut word = String::new();
    let mut quote = None;
    let mut letters = text.chars().peekable();
    while let Some(letter) = letters.next() {
        match letter {
            _ if quote == Some(letter) => quote = None,
            _ if quote.is_some() => word.push(letter),
            '"' | '\'' if word.trim().is_empty() => quote = Some(letter),
            '{' | '[' if word.trim().is_empty() => {
                if let Some((false, _)) = open.last() {
                    path.push(ITEM.to_string());
                }
                open.push((letter == '{', false));
            }
            '}' | ']' | ',' => {
                if let Some((true, keyed @ true)) = open.last_mut() {
                    path.pop();
                    *keyed = false;
                }
                if letter != ',' {
                    open.pop();
                    if let Some((false, _)) = open.last() {
                        path.pop();
                    }
                }
                word.clear();
            }
            ':' if letters.peek().is_none_or(|next| *next == ' ') => {
                if let Some((true, keyed @ false)) = open.last_mut() {
                    path.push(word.trim().to_string());
                    *keyed = true;
                    word.clear();
                }
            }
            _ => word.push(letter),
        }
    }
    Some(open.last().is_none_or(|(has_keys, keyed)| !has_keys || *keyed))
}

/// The keys that lead to a line, from the lines before it.
fn ancestors(before: &str, line: &str) -> Vec<String> {
    let mut found: Vec<String> = Vec::new();
    let mut indent_of = indent(line);
    // The items of a list may stand as deep as its key.
    let mut list = line.trim_start_matches(' ').starts_with('-').then_some(indent_of);
    for line in before.lines().rev() {
        let bare = line.trim_start_matches(' ');
        let at = indent(line);
        if bare.is_empty() || bare.starts_with('#') {
            continue;
        }
        // `- key: …` opens an item whose keys stand deeper than the dash.
        let mut inner = bare;
        let mut dashes = Vec::new();
        while let Some(item) = inner.strip_prefix("- ") {
            dashes.push(at + bare.len() - inner.len());
            inner = item.trim_start_matches(' ');
        }
        let of_key = at + bare.len() - inner.len();
        let is_outside = of_key < indent_of || dashes.is_empty() && list == Some(of_key);
        if is_outside
            && let Some((key, value)) = key(inner)
            && (value.trim().is_empty() || value.trim_start().starts_with(['#', '|', '>']))
        {
            found.push(key.to_string());
            (indent_of, list) = (of_key, None);
        }
        for dash in dashes.into_iter().rev() {
            if dash < indent_of {
                found.push(ITEM.to_string());
                (indent_of, list) = (dash, Some(dash));
            }
        }
        if indent_of == 0 && list.is_none() {
            break;
        }
    }
    found.reverse();
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn path(text: &str) -> String {
        let start = text.rfind('\n').map_or(0, |end| end + 1);
        let Some(Line { path, value }) = line(&text[start..]) else { return "nothing".to_string() };
        let mut all = ancestors(&text[..start], &text[start..]);
        all.extend(path);
        format!("{}{}", all.join("/"), if value { " =" } else { "" })
    }

    #[test]
    fn keys_lead_to_a_place() {
        assert_eq!(path(""), "");
        assert_eq!(path("ti"), "");
        assert_eq!(path("tick: 3 "), "tick =");
        assert_eq!(path("tasks:\n  terms:\n    "), "tasks/terms");
        assert_eq!(path("tasks:\n  # a comment\n\n  terms:\n    period: f("), "tasks/terms/period =");
        assert_eq!(path("tasks:\n  each:\n    left: { name: work, cycl"), "tasks/each/left");
        assert_eq!(path("tasks:\n  each:\n    left: { name: work, cycles: \"f(a, "), "tasks/each/left/cycles =");
        assert_eq!(path("tasks:\n  each:\n    left: { name: work }\n  te"), "tasks");
        assert_eq!(path("flow:\n  hops:\n    - { task: a, value: "), "flow/hops/-/value =");
        assert_eq!(path("flow:\n  hops:\n    - task: a\n      val"), "flow/hops/-");
        assert_eq!(path("flow:\n  hops:\n  - task: a\n    value: x"), "flow/hops/-/value =");
        assert_eq!(path("activities:\n  IDLE: [idle, "), "activities/IDLE =");
        assert_eq!(path("bounds: { level: 0..10, co"), "bounds");
        assert_eq!(path("bounds: { level: [a, "), "bounds/level =");
        assert_eq!(path("invariants:\n  - a = "), "invariants/-");
        assert_eq!(path("invariants:\n- \"a = "), "invariants/- =");
        assert_eq!(path("ltl: [\"a\", "), "ltl =");
        assert_eq!(path("# ti"), "nothing");
        assert_eq!(path("tick: 3 # mor"), "nothing");
        assert_eq!(path("\"a b\": x"), "a b =");
        assert_eq!(path("note: >-\n  some wo"), "note");
    }
}
