//! The words of the grammar are those of `crates/syntax`.
//!
//! In: `src/grammar.json`, which is what the generated parser was made of; the lexer's keywords, and the words that the
//! parser of scenarios and charts knows. A word that one of the two lacks is a failure.

use std::collections::BTreeSet;

use serde_json::Value;
use syntax::SyntaxKind;
use testkit::repository;

use crate::support::text;

/// Words that are no kinds of tokens: operators, which may be called as functions, and what a scenario expects.
const BY_TEXT: &[&str] =
    &["and", "or", "xor", "not", "implies", "iff", "mod", "failure", "inconsistent", "update", "error"];

fn is_word(text: &str) -> bool {
    text.starts_with(|c: char| c.is_ascii_alphabetic()) && text.chars().all(|c| c.is_ascii_alphanumeric())
}

fn strings(value: &Value, found: &mut BTreeSet<String>) {
    match value {
        Value::Object(object) => {
            if object.get("type").is_some_and(|kind| kind == "STRING") {
                let word = object["value"].as_str().expect("a text");
                found.extend(is_word(word).then(|| word.to_string()));
            }
            object.values().for_each(|value| strings(value, found));
        }
        Value::Array(values) => values.iter().for_each(|value| strings(value, found)),
        _ => {}
    }
}

#[test]
fn the_words_are_those_of_our_parser() {
    let grammar: Value = serde_json::from_str(&text("src/grammar.json")).expect("JSON");
    let mut generated = BTreeSet::new();
    strings(&grammar["rules"], &mut generated);
    // Two spellings of a keyword are one kind, so the lexer's own list is read as well.
    let lexer = repository::text("crates/syntax/src/lexer/word.rs");
    let arms = lexer.lines().filter(|line| line.contains("=>")).flat_map(|line| line.split('"').skip(1).step_by(2));
    let kinds = SyntaxKind::ALL.iter().filter_map(|kind| kind.text());
    let ours: BTreeSet<String> =
        arms.chain(kinds).chain(BY_TEXT.iter().copied()).filter(|word| is_word(word)).map(String::from).collect();
    assert!(ours.len() > 150, "{ours:?}");
    let only =
        |these: &BTreeSet<String>, those: &BTreeSet<String>| these.difference(those).cloned().collect::<Vec<_>>();
    assert_eq!(only(&ours, &generated), [""; 0], "the grammar lacks these");
    assert_eq!(only(&generated, &ours), [""; 0], "the grammar alone has these");
}
