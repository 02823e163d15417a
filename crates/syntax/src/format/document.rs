//! What the printer prints: texts, and places where a line may or must end.
//!
//! Made by `layout` and `comment`, printed by `printer`. A comment is a piece of its own, because it ends its line
//! whatever stands around it.

/// A piece of output.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Document {
    /// Text without a line end (a comment in `/* */` may have some).
    Text(String),
    /// A blank.
    Space,
    /// A blank, or a line end when the group around is folded.
    Line,
    /// Nothing, or a line end when the group around is folded.
    SoftLine,
    /// A line end.
    HardLine,
    /// A line end and an empty line.
    BlankLine,
    /// A comment after a token, which ends the line.
    TrailingComment(String),
    /// A comment on a line of its own.
    OwnLineComment(String),
    /// Lines within start further right.
    Indent(Box<Document>),
    /// Printed on one line if that fits.
    Group(Box<Document>),
    /// One after the other.
    Concat(Vec<Document>),
}

impl Document {
    pub(super) fn nothing() -> Document {
        Document::Concat(Vec::new())
    }
}
