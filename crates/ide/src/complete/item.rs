//! One thing that can be written at a place.

/// What an item is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum ItemKind {
    /// A function.
    Function,
    /// A rule.
    Rule,
    /// A domain.
    Domain,
    /// An enum literal.
    Literal,
    /// A logical variable.
    Variable,
    /// A keyword.
    Keyword,
    /// A whole construct, with places to fill in.
    Snippet,
    /// A file, or a library that is built in.
    File,
}

/// One thing that can be written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Item {
    /// What is shown, and filtered by.
    pub label: String,
    /// What it is.
    pub kind: ItemKind,
    /// A word on it: its signature.
    pub detail: String,
    /// What is put in; `$0`, `${1:x}` are places to fill in if it is a snippet.
    pub insert: String,
    /// Whether `insert` has such places.
    pub is_snippet: bool,
    /// Lower ones come first.
    pub rank: u8,
}

impl Item {
    pub(super) fn new(label: &str, kind: ItemKind, detail: impl Into<String>, rank: u8) -> Item {
        Item {
            label: label.to_string(),
            kind,
            detail: detail.into(),
            insert: label.to_string(),
            is_snippet: false,
            rank,
        }
    }

    pub(super) fn snippet(label: &str, detail: &str, insert: &str, rank: u8) -> Item {
        let (detail, insert) = (detail.to_string(), insert.to_string());
        Item { label: label.to_string(), kind: ItemKind::Snippet, detail, insert, is_snippet: true, rank }
    }
}
