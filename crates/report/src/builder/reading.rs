//! The present values of the terms, read from their text only when it changes.
//!
//! INVARIANT: `changed` says whether a term has another value than before the last `settle`.

use std::collections::BTreeMap;

/// A term of the specification.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Slot(usize);

/// A value: the number of its text, and its numeric value if it has one. Equal readings are equal texts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Reading {
    word: u32,
    integer: Option<i64>,
}

const UNDEF: Reading = Reading { word: 0, integer: None };

#[derive(Debug)]
pub(super) struct Readings {
    terms: Vec<String>,
    now: Vec<Reading>,
    before: Vec<Reading>,
    touched: Vec<usize>,
    words: BTreeMap<String, u32>,
    texts: Vec<String>,
}

impl Readings {
    pub fn new(terms: Vec<String>) -> Readings {
        let (now, before) = (vec![UNDEF; terms.len()], vec![UNDEF; terms.len()]);
        let words = BTreeMap::from([("undef".to_owned(), 0)]);
        Readings { terms, now, before, touched: Vec::new(), words, texts: vec!["undef".to_owned()] }
    }

    pub fn terms(&self) -> &[String] {
        &self.terms
    }

    /// The term of this text, which the specification holds.
    pub fn slot(&self, term: &str) -> Slot {
        Slot(self.terms.iter().position(|known| known == term).expect("a term of the specification"))
    }

    pub fn optional(&self, term: Option<&String>) -> Option<Slot> {
        term.map(|term| self.slot(term))
    }

    pub fn set(&mut self, term: usize, text: &str) {
        self.now[term] = self.read(text);
        self.touched.push(term);
    }

    /// A text as a value.
    pub fn read(&mut self, text: &str) -> Reading {
        // Numbers are told apart by their value, so a clock does not fill the table of words.
        if let Ok(integer) = text.parse() {
            return Reading { word: u32::MAX, integer: Some(integer) };
        }
        let next = self.texts.len() as u32;
        let word = *self.words.entry(text.to_owned()).or_insert(next);
        if word == next {
            self.texts.push(text.to_owned());
        }
        Reading { word, integer: None }
    }

    /// The value of a term; `None` when undef.
    pub fn value(&self, slot: Slot) -> Option<Reading> {
        Some(self.now[slot.0]).filter(|value| *value != UNDEF)
    }

    pub fn text(&self, slot: Slot) -> String {
        let Reading { word, integer } = self.now[slot.0];
        integer.map_or_else(|| self.texts[word as usize].clone(), |integer| integer.to_string())
    }

    pub fn integer(&self, slot: Slot) -> Option<i64> {
        self.now[slot.0].integer
    }

    /// The number to be drawn: truth is 1, falsehood 0.
    pub fn level(&self, slot: Slot) -> Option<i64> {
        let Reading { word, integer } = self.now[slot.0];
        integer.or_else(|| match self.texts[word as usize].as_str() {
            "true" => Some(1),
            "false" => Some(0),
            _ => None,
        })
    }

    pub fn integer_before(&self, slot: Slot) -> Option<i64> {
        self.before[slot.0].integer
    }

    /// The number an optional term has now.
    pub fn number(&self, term: Option<&String>) -> Option<i64> {
        self.optional(term).and_then(|slot| self.integer(slot))
    }

    pub fn changed(&self, slot: Slot) -> bool {
        self.now[slot.0] != self.before[slot.0]
    }

    /// What is now becomes what was before.
    pub fn settle(&mut self) {
        for term in self.touched.drain(..) {
            self.before[term] = self.now[term];
        }
    }
}
