//! A scalar of a YAML file: its text, and where in the file each byte of that stands.
//!
//! In: the text as YAML makes it of the file, quotes, escapes, folds and indentation taken away; the piece of the file. Out: places in the
//! file for places in the text. INVARIANT: whatever the file has, a place is within the scalar's own.

use std::fmt;
use std::ops::{Deref, Range};

use saphyr_parser::ScalarStyle;
use syntax::{Diagnostic, FileId, Label, Span};

/// See the module.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Scalar {
    text: String,
    span: Span,
    /// What stands for each byte of the text.
    bytes: Vec<Bytes>,
    /// Where the text ends.
    end: u32,
}

/// A range of the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Bytes {
    start: u32,
    end: u32,
}

impl Scalar {
    /// The scalar that stands at a place of a file; `written` is what is to be seen there.
    pub(crate) fn new(text: String, style: ScalarStyle, span: Span, written: &str) -> Scalar {
        let mut reader = Reader { written, at: begin(style, written), style };
        let mut bytes = Vec::with_capacity(text.len());
        for c in text.chars() {
            let found = reader.find(c);
            let found = Bytes { start: span.start + found.start as u32, end: span.start + found.end as u32 };
            bytes.extend((0..c.len_utf8()).map(|_| found));
        }
        let end = bytes.last().map_or(span.start + reader.at as u32, |last| last.end);
        Scalar { text, span, bytes, end }
    }

    /// Texts as one, with something between them.
    pub(crate) fn joined(scalars: Vec<Scalar>, between: &str) -> Option<Scalar> {
        scalars.into_iter().reduce(|mut all, next| {
            let end = Bytes { start: all.end, end: all.end };
            all.bytes.extend(between.bytes().map(|_| end));
            all.bytes.extend(next.bytes);
            all.text = all.text + between + &next.text;
            (all.end, all.span.end) = (next.end, next.span.end);
            all
        })
    }

    /// Where it stands.
    pub fn span(&self) -> Span {
        self.span
    }

    /// Where a part of the text stands.
    pub fn place(&self, part: Range<u32>) -> Span {
        let bytes = |at: u32| self.bytes.get(at as usize).copied();
        let behind = Bytes { start: self.end, end: self.end };
        let start = bytes(part.start).unwrap_or(behind).start;
        let end = if part.is_empty() { start } else { bytes(part.end - 1).unwrap_or(behind).end };
        Span { file: self.span.file, start, end: end.max(start) }
    }

    /// Faults of the text, which was read as a file of its own, at their places in this one.
    pub fn placed(&self, mut faults: Vec<Diagnostic>, read_as: FileId) -> Vec<Diagnostic> {
        let place = |label: &mut Label| {
            if label.span.file == read_as {
                label.span = self.place(label.span.start..label.span.end);
            }
        };
        for fault in &mut faults {
            place(&mut fault.primary);
            fault.secondary.iter_mut().for_each(place);
        }
        faults
    }
}

impl Deref for Scalar {
    type Target = str;

    fn deref(&self) -> &str {
        &self.text
    }
}

impl fmt::Display for Scalar {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

/// Where the contents begin: behind the quote, or the header of a block.
fn begin(style: ScalarStyle, written: &str) -> usize {
    match style {
        ScalarStyle::Plain => 0,
        ScalarStyle::SingleQuoted | ScalarStyle::DoubleQuoted => written.find(['\'', '"']).map_or(0, |at| at + 1),
        ScalarStyle::Literal | ScalarStyle::Folded => match written.trim_start().starts_with(['|', '>']) {
            true => written.find('\n').map_or(0, |at| at + 1),
            false => 0,
        },
    }
}

/// Goes through what is written beside the text. Blanks are skipped on both sides, since YAML folds them; all else stands in the file as it is
/// in the text, or as an escape.
struct Reader<'a> {
    written: &'a str,
    at: usize,
    style: ScalarStyle,
}

impl Reader<'_> {
    /// What stands for the next character of the text.
    fn find(&mut self, c: char) -> Range<usize> {
        if !c.is_whitespace() {
            self.skip_blanks();
        }
        let (at, rest) = (self.at, self.rest());
        let first = rest.chars().next();
        self.at += match self.style {
            ScalarStyle::DoubleQuoted if first == Some('\\') => self.escape(),
            ScalarStyle::SingleQuoted if rest.starts_with("''") => 2,
            // A blank that a fold has made of nothing.
            _ if c.is_whitespace() && !first.is_some_and(char::is_whitespace) => 0,
            _ => first.map_or(0, char::len_utf8),
        };
        at..self.at
    }

    fn rest(&self) -> &str {
        &self.written[self.at..]
    }

    fn skip_blanks(&mut self) {
        loop {
            self.at += self.rest().len() - self.rest().trim_start().len();
            // The end of a line that goes on.
            let goes_on = self.style == ScalarStyle::DoubleQuoted && self.rest().starts_with("\\\n");
            if !goes_on {
                return;
            }
            self.at += 2;
        }
    }

    /// How many bytes an escape has.
    fn escape(&self) -> usize {
        let rest = self.rest();
        let Some(letter) = rest[1..].chars().next() else { return 1 };
        let digits = match letter {
            'x' => 2,
            'u' => 4,
            'U' => 8,
            _ => 0,
        };
        (1 + letter.len_utf8() + digits).min(rest.len())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::node::{Shape, read};

    /// Where the word of a scalar is found, and all of the text, where every letter is at its place.
    fn check(source: &str, text: &str, word: &str, line_and_column: (usize, usize)) {
        let node = read(FileId(0), source, "id").expect("it is YAML");
        let Shape::Map(entries) = &node.shape else { panic!("{node:?}") };
        let Shape::Text(scalar) = &entries[0].1.shape else { panic!("{node:?}") };
        assert_eq!(&**scalar, text);
        let start = text.find(word).expect("the word") as u32;
        let place = scalar.place(start..start + word.len() as u32);
        let before = &source[..place.start as usize];
        let line = before.matches('\n').count() + 1;
        let column = before.len() - before.rfind('\n').map_or(0, |at| at + 1) + 1;
        assert_eq!((line, column), line_and_column, "{place:?} of {scalar:?}");
        let seen = &source[place.range()];
        assert!(seen == word || seen == "''", "{seen}");
    }

    #[test]
    fn plain_scalars() {
        check("a: x = nowhere\n", "x = nowhere", "nowhere", (1, 8));
        check("ä: x = nowhere and ä\n", "x = nowhere and ä", "nowhere", (1, 9));
        check("a: x = 1\n  and nowhere = 2\nb: c\n", "x = 1 and nowhere = 2", "nowhere", (2, 7));
    }

    #[test]
    fn quoted_scalars() {
        check("a: 'x = nowhere'\n", "x = nowhere", "nowhere", (1, 9));
        check("a: 'it''s = nowhere'\n", "it's = nowhere", "nowhere", (1, 13));
        check("a: \"x = nowhere\"\n", "x = nowhere", "nowhere", (1, 9));
        check("a: \"s = \\\"t\\\" and\\tnowhere\"\n", "s = \"t\" and\tnowhere", "nowhere", (1, 20));
        check("a: \"\\u0041 = nowhere\"\n", "A = nowhere", "nowhere", (1, 14));
        check("a: \"x = 1\n   and nowhere\"\n", "x = 1 and nowhere", "nowhere", (2, 8));
        check("a: \"x = 1 \\\n   and nowhere\"\n", "x = 1 and nowhere", "nowhere", (2, 8));
        check("a: 'it''s'\n", "it's", "'", (1, 7));
    }

    #[test]
    fn blocks() {
        check("a: |\n  x = 1\n    and nowhere\n", "x = 1\n  and nowhere\n", "nowhere", (3, 9));
        check("a: >-\n  x = 1\n  and nowhere\nb: c\n", "x = 1 and nowhere", "nowhere", (3, 7));
        check("a: > # why\n\n  x = 1\n\n  and nowhere\n", "\nx = 1\nand nowhere\n", "nowhere", (5, 7));
        check("a:\n  - b\nc: d\n".replace("\n  - b", " |-\n  é = nowhere").as_str(), "é = nowhere", "nowhere", (2, 8));
    }

    #[test]
    fn several_as_one() {
        let source = "a: [x, nowhere]\n";
        let node = read(FileId(0), source, "id").expect("it is YAML");
        let Shape::Map(entries) = node.shape else { panic!() };
        let Shape::List(items) = &entries[0].1.shape else { panic!() };
        let texts = items.iter().filter_map(|item| match &item.shape {
            Shape::Text(scalar) => Some(scalar.clone()),
            _ => None,
        });
        let joined = Scalar::joined(texts.collect(), " ").expect("there are two");
        assert_eq!(&*joined, "x nowhere");
        assert_eq!(&source[joined.place(2..9).range()], "nowhere");
    }
}
