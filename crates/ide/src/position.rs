//! Positions as editors count them: lines, and code units within a line.
//!
//! In: a text. Out: [`Lines`], which takes positions to byte offsets and back, in the [`Encoding`] that was agreed on. A line
//! ends at `\n`, `\r\n` or `\r`. INVARIANT: an offset that comes out is on a character boundary of the text; a position beyond
//! the end of a line is that end, and one beyond the last line the end of the text.

use std::ops::Range;
use std::sync::Arc;

/// What a column counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Encoding {
    /// Bytes.
    Utf8,
    /// What every editor knows.
    #[default]
    Utf16,
    /// Characters.
    Utf32,
}

impl Encoding {
    fn units(self, letter: char) -> u32 {
        match self {
            Encoding::Utf8 => letter.len_utf8() as u32,
            Encoding::Utf16 => letter.len_utf16() as u32,
            Encoding::Utf32 => 1,
        }
    }
}

/// A place between two characters; both numbers count from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub struct Position {
    /// The line.
    pub line: u32,
    /// The code units before it in its line.
    pub column: u32,
}

/// The lines of a text.
#[derive(Debug, Clone)]
pub struct Lines {
    text: Arc<str>,
    starts: Vec<usize>,
}

impl Lines {
    /// Finds the lines.
    pub fn new(text: Arc<str>) -> Lines {
        let bytes = text.as_bytes();
        let mut starts = vec![0];
        for (at, byte) in bytes.iter().enumerate() {
            if *byte == b'\n' || (*byte == b'\r' && bytes.get(at + 1) != Some(&b'\n')) {
                starts.push(at + 1);
            }
        }
        Lines { text, starts }
    }

    /// The text.
    pub fn text(&self) -> &Arc<str> {
        &self.text
    }

    /// How many lines there are, at least one.
    pub fn count(&self) -> u32 {
        self.starts.len() as u32
    }

    /// The bytes of a line, without its end; nothing of a line that is not there.
    pub fn line(&self, line: u32) -> Range<usize> {
        let Some(start) = self.starts.get(line as usize).copied() else { return self.text.len()..self.text.len() };
        let end = self.starts.get(line as usize + 1).copied().unwrap_or(self.text.len());
        start..start + self.text[start..end].trim_end_matches(['\r', '\n']).len()
    }

    /// The byte at a position.
    pub fn offset(&self, position: Position, encoding: Encoding) -> usize {
        let line = self.line(position.line);
        let mut column = 0;
        for (at, letter) in self.text[line.clone()].char_indices() {
            column += encoding.units(letter);
            if column > position.column {
                return line.start + at;
            }
        }
        line.end
    }

    /// The position of a byte. One that is not on a character boundary counts as the beginning of its character.
    pub fn position(&self, offset: usize, encoding: Encoding) -> Position {
        let mut offset = offset.min(self.text.len());
        while !self.text.is_char_boundary(offset) {
            offset -= 1;
        }
        let line = self.starts.partition_point(|start| *start <= offset) - 1;
        let column = self.text[self.starts[line]..offset].chars().map(|letter| encoding.units(letter)).sum();
        Position { line: line as u32, column }
    }
}

/// Some bytes of a text replaced by others.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Edit {
    /// The bytes that go.
    pub range: (u32, u32),
    /// What comes there.
    pub text: String,
}

impl Edit {
    /// Replaces a range.
    pub fn new(range: impl Into<Range<u32>>, text: impl Into<String>) -> Edit {
        let range = range.into();
        Edit { range: (range.start, range.end), text: text.into() }
    }

    /// Puts in a text and takes away nothing.
    pub fn insert(at: u32, text: impl Into<String>) -> Edit {
        Edit::new(at..at, text)
    }
}

/// The text with edits made. They must not overlap; their order does not matter.
pub fn edited(text: &str, edits: &[Edit]) -> String {
    let mut edits: Vec<&Edit> = edits.iter().collect();
    edits.sort();
    let mut result = String::with_capacity(text.len());
    let mut at = 0;
    for edit in edits {
        result.push_str(&text[at..edit.range.0 as usize]);
        result.push_str(&edit.text);
        at = edit.range.1 as usize;
    }
    result.push_str(&text[at..]);
    result
}

/// The one edit that takes a text to another, as short as it can be at both ends.
pub fn difference(before: &str, after: &str) -> Option<Edit> {
    if before == after {
        return None;
    }
    let same = |(a, b): &(char, char)| a == b;
    let start: usize = before.chars().zip(after.chars()).take_while(same).map(|(letter, _)| letter.len_utf8()).sum();
    let (rest, new) = (&before[start..], &after[start..]);
    let end: usize =
        rest.chars().rev().zip(new.chars().rev()).take_while(same).map(|(letter, _)| letter.len_utf8()).sum();
    let range = start as u32..(before.len() - end) as u32;
    Some(Edit::new(range, &new[..new.len() - end]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_count_code_units() {
        let lines = Lines::new("a😀b\r\nä\rc\n".into());
        let check = |offset: usize, encoding, line, column| {
            let position = Position { line, column };
            assert_eq!(lines.position(offset, encoding), position, "byte {offset}");
            assert_eq!(lines.offset(position, encoding), offset, "{position:?}");
        };
        check(5, Encoding::Utf16, 0, 3);
        check(5, Encoding::Utf8, 0, 5);
        check(5, Encoding::Utf32, 0, 2);
        check(6, Encoding::Utf16, 0, 4);
        check(10, Encoding::Utf16, 1, 1);
        check(11, Encoding::Utf16, 2, 0);
        check(13, Encoding::Utf16, 3, 0);
        assert_eq!(lines.count(), 4);
        // The middle of a surrogate pair is the beginning of its character; what is beyond a line is its end.
        let at = |line, column| lines.offset(Position { line, column }, Encoding::Utf16);
        assert_eq!((at(0, 2), at(0, 99), at(9, 0)), (1, 6, 13));
        assert_eq!(lines.position(3, Encoding::Utf16), Position { line: 0, column: 1 });
    }

    #[test]
    fn edits_are_made_in_any_order() {
        let edits = [Edit::new(4..5, "E"), Edit::insert(0, "<"), Edit::new(1..3, "")];
        assert_eq!(edited("abcdef", &edits), "<adEf");
    }

    #[test]
    fn a_layout_changes_what_it_must() {
        let check = |before: &str, after: &str| {
            let edits: Vec<Edit> = difference(before, after).into_iter().collect();
            assert_eq!(edited(before, &edits), after);
            edits.first().map(|edit| edit.range)
        };
        assert_eq!(check("a  b", "a b"), Some((2, 3)));
        assert_eq!(check("aaa", "aa"), Some((2, 3)));
        assert_eq!(check("ä\r\nb", "ä\nb"), Some((2, 3)));
        assert_eq!(check("a", "a"), None);
    }
}
