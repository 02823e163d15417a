//! The queries name nodes that there are, colour every keyword and every name, and no node twice.
//!
//! Editors differ in whether the first or the last pattern that matches a node counts, so no node may be matched by two.
//! They differ in the names of colours that they know, too; here are those that Helix, Neovim and Zed share, or fall back from.

use std::collections::{BTreeMap, BTreeSet};

use tree_sitter::{Query, QueryCursor, StreamingIterator};

use crate::support::{Source, language, nodes, sources, text, tree};

const FILES: [&str; 6] =
    ["queries/highlights", "queries/folds", "queries/locals", "helix/highlights", "helix/locals", "helix/indents"];

/// First words of names that all three editors have colours for.
const COLOURS: [&str; 15] = [
    "boolean",
    "character",
    "comment",
    "constant",
    "function",
    "keyword",
    "label",
    "module",
    "number",
    "operator",
    "property",
    "punctuation",
    "string",
    "type",
    "variable",
];

fn query(name: &str) -> Query {
    let text = text(&format!("{name}.scm"));
    Query::new(&language(), &text).unwrap_or_else(|error| panic!("{name}.scm: {error}"))
}

/// What a query captures: from byte, to byte, kind of the node, name of the capture.
fn captures(query: &Query, source: &Source) -> Vec<(usize, usize, &'static str, String)> {
    let tree = tree(&source.text);
    let mut found = Vec::new();
    let mut cursor = QueryCursor::new();
    let mut captures = cursor.captures(query, tree.root_node(), source.text.as_bytes());
    while let Some((matched, index)) = captures.next() {
        let capture = matched.captures[*index];
        let name = query.capture_names()[capture.index as usize];
        found.push((capture.node.start_byte(), capture.node.end_byte(), capture.node.kind(), name.to_string()));
    }
    found
}

#[test]
fn every_pattern_matches_somewhere() {
    let sources: Vec<Source> = sources().into_iter().filter(Source::is_clean).collect();
    for name in FILES {
        let query = query(name);
        let mut met = vec![false; query.pattern_count()];
        for source in &sources {
            let tree = tree(&source.text);
            let mut cursor = QueryCursor::new();
            let mut matches = cursor.matches(&query, tree.root_node(), source.text.as_bytes());
            while let Some(matched) = matches.next() {
                met[matched.pattern_index] = true;
            }
        }
        let text = text(&format!("{name}.scm"));
        let never = (0..met.len()).filter(|index| !met[*index]);
        let never: Vec<&str> =
            never.map(|index| &text[query.start_byte_for_pattern(index)..query.end_byte_for_pattern(index)]).collect();
        assert!(never.is_empty(), "{name}.scm: nothing matches {never:#?}");
    }
}

#[test]
fn no_node_has_two_colours() {
    let query = query("queries/highlights");
    for name in query.capture_names() {
        assert!(COLOURS.contains(&name.split('.').next().unwrap_or_default()), "no editor knows @{name}");
    }
    for source in sources().iter().filter(|source| source.is_clean()) {
        let mut colours = BTreeMap::new();
        for (from, to, kind, colour) in captures(&query, source) {
            let before = colours.insert((from, to, kind), colour.clone());
            let shown = &source.text[from..to];
            assert_eq!(before, None, "{}: {kind} {shown:?} is @{colour}, too", source.name);
        }
    }
}

#[test]
fn every_word_has_a_colour() {
    let query = query("queries/highlights");
    for source in sources().iter().filter(|source| source.is_clean()) {
        let coloured: BTreeSet<(usize, usize)> =
            captures(&query, source).iter().map(|(from, to, ..)| (*from, *to)).collect();
        let tree = tree(&source.text);
        for node in nodes(&tree).into_iter().filter(|node| node.child_count() == 0 && node.kind() != "identifier") {
            // A number or a string has its colour as a whole.
            let within = std::iter::successors(Some(node), |node| node.parent()).take(3);
            let places = within.map(|node| (node.start_byte(), node.end_byte()));
            let shown = &source.text[node.start_byte()..node.end_byte()];
            assert!(
                places.into_iter().any(|place| coloured.contains(&place)),
                "{}: {} {shown:?}",
                source.name,
                node.kind()
            );
        }
    }
}

#[test]
fn helix_has_the_same_patterns() {
    // Of the words behind `@` it knows others, and no comments count.
    let patterns = |name: &str| -> Vec<String> {
        let text = text(name);
        let lines = text.lines().filter(|line| !line.starts_with(';'));
        let words = lines.flat_map(str::split_whitespace).filter(|word| !word.starts_with('@'));
        words.map(String::from).collect()
    };
    for name in ["highlights", "locals"] {
        assert_eq!(patterns(&format!("helix/{name}.scm")), patterns(&format!("queries/{name}.scm")), "{name}");
    }
    let scopes = [
        "comment",
        "constant",
        "function",
        "keyword",
        "label",
        "namespace",
        "operator",
        "punctuation",
        "string",
        "type",
        "variable",
    ];
    for name in query("helix/highlights").capture_names() {
        assert!(scopes.contains(&name.split('.').next().unwrap_or_default()), "Helix has no @{name}");
    }
}
