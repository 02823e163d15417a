//! Edits of a text: applied, and told as the lines that they change.
//!
//! In: a text and edits whose ranges do not overlap, in their order. Out: the new text; the lines before and after, without
//! those at both ends that stay as they are.

use std::ops::Range;

/// A range of bytes and what comes in its place.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Edit {
    /// What is replaced.
    pub range: Range<usize>,
    /// By what.
    pub text: String,
}

impl Edit {
    /// An edit.
    pub fn new(range: impl Into<Range<usize>>, text: impl Into<String>) -> Edit {
        Edit { range: range.into(), text: text.into() }
    }
}

/// Lines before and after.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Change {
    /// The number of the first line that changes, from 1.
    pub line: u32,
    /// The lines that go.
    pub before: Vec<String>,
    /// The lines that come.
    pub after: Vec<String>,
}

/// The text with the edits.
pub fn applied(text: &str, edits: &[Edit]) -> String {
    let mut made = String::with_capacity(text.len());
    let mut at = 0;
    for edit in edits {
        made.push_str(&text[at..edit.range.start]);
        made.push_str(&edit.text);
        at = edit.range.end;
    }
    made.push_str(&text[at..]);
    made
}

/// The lines that edits change.
pub fn changed(text: &str, edits: &[Edit]) -> Change {
    let new = applied(text, edits);
    let (old, new): (Vec<&str>, Vec<&str>) = (text.lines().collect(), new.lines().collect());
    let same = old.iter().zip(&new).take_while(|(old, new)| old == new).count();
    let rest = old.len().min(new.len()) - same;
    let tail = old.iter().rev().zip(new.iter().rev()).take(rest).take_while(|(old, new)| old == new).count();
    let lines = |of: &[&str]| of[same..of.len() - tail].iter().map(|line| (*line).to_string()).collect();
    Change { line: same as u32 + 1, before: lines(&old), after: lines(&new) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edits_change_lines() {
        let text = "par\n\ta := 1\n\tb := 2\nendpar\n";
        let edits = [Edit::new(0..3, "seq"), Edit::new(text.len() - 7..text.len() - 1, "endseq")];
        assert_eq!(applied(text, &edits), "seq\n\ta := 1\n\tb := 2\nendseq\n");
        let change = changed(text, &[Edit::new(5..11, "skip")]);
        assert_eq!(
            (change.line, &change.before[..], &change.after[..]),
            (2, &["\ta := 1".to_string()][..], &["\tskip".to_string()][..])
        );
        // A line that goes away, and one like its neighbour.
        let change = changed("a\na\nb\n", &[Edit::new(2..4, "")]);
        assert_eq!((change.line, change.before.len(), change.after.len()), (2, 1, 0));
    }
}
