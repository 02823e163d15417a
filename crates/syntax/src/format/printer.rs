//! Prints a document: a group that fits on the rest of the line is printed flat; otherwise its lines end where they
//! may.
//!
//! In: a document. Out: text without a final line end. Blanks and line ends wait until the next text, so no line ends
//! with white space, and a comment to the end of a line can never swallow a token. It keeps its own stack, so any depth
//! is fine. Time is linear: one line's width decides whether a group fits.

use super::WIDTH;
use super::document::Document::{self, *};

const TAB: usize = 4;

struct Printer {
    out: String,
    column: usize,
    /// Line ends that wait for the next text: at most two.
    lines: usize,
    /// How far right the next line starts, as the last line end says; a comment leaves it to what follows.
    indent: Option<usize>,
    space: bool,
}

#[derive(Clone, Copy)]
struct Job<'d> {
    document: &'d Document,
    indent: usize,
    flat: bool,
}

/// Prints a document.
pub(super) fn print(document: &Document) -> String {
    let mut printer = Printer { out: String::new(), column: 0, lines: 0, indent: None, space: false };
    let mut jobs = vec![Job { document, indent: 0, flat: false }];
    while let Some(job) = jobs.pop() {
        let Job { document, indent, flat } = job;
        match document {
            Text(text) => printer.text(text, indent),
            Space => printer.space = true,
            Line if flat => printer.space = true,
            SoftLine if flat => {}
            Line | SoftLine | HardLine => printer.end_line(1, Some(indent)),
            BlankLine => printer.end_line(2, Some(indent)),
            TrailingComment(comment) => {
                printer.space = true;
                printer.text(comment, indent);
                printer.end_line(1, None);
            }
            OwnLineComment(comment) => {
                printer.end_line(1, Some(indent));
                printer.text(comment, indent);
                printer.end_line(1, None);
            }
            Indent(inner) => jobs.push(Job { document: inner, indent: indent + 1, flat }),
            Group(inner) => {
                let flat = flat || fits(inner, printer.room(indent), &jobs);
                jobs.push(Job { document: inner, indent, flat });
            }
            Concat(parts) => jobs.extend(parts.iter().rev().map(|document| Job { document, indent, flat })),
        }
    }
    printer.out
}

impl Printer {
    fn end_line(&mut self, count: usize, indent: Option<usize>) {
        self.lines = self.lines.max(count);
        self.indent = indent;
    }

    /// How much of the line is left.
    fn room(&self, indent: usize) -> usize {
        let column =
            if self.lines > 0 { self.indent.unwrap_or(indent) * TAB } else { self.column + usize::from(self.space) };
        WIDTH.saturating_sub(column)
    }

    fn text(&mut self, text: &str, indent: usize) {
        let indent = self.indent.take().unwrap_or(indent);
        if self.out.is_empty() {
            self.lines = 0;
        } else if self.lines > 0 {
            self.out.extend(std::iter::repeat_n('\n', self.lines));
            self.out.extend(std::iter::repeat_n('\t', indent));
            self.column = indent * TAB;
        } else if self.space {
            self.out.push(' ');
            self.column += 1;
        }
        self.lines = 0;
        self.space = false;
        self.out.push_str(text);
        self.column = match text.rfind('\n') {
            Some(end) => text[end + 1..].chars().count(),
            None => self.column + text.chars().count(),
        };
    }
}

/// The document fits into this many columns, together with what follows on the same line.
fn fits(document: &Document, room: usize, rest: &[Job<'_>]) -> bool {
    let mut room = room as isize;
    let mut jobs = vec![(document, true)];
    let mut rest = rest.iter().rev();
    let mut ended = false; // by a comment to the end of the line
    loop {
        let (document, flat) = match jobs.pop() {
            Some(job) => job,
            None if ended => return true,
            None => match rest.next() {
                Some(job) => (job.document, job.flat),
                None => return true,
            },
        };
        match document {
            Text(text) if ended || text.contains('\n') => return false,
            Text(text) => room -= text.chars().count() as isize,
            Space => room -= 1,
            Line if flat => room -= 1,
            SoftLine if flat => {}
            TrailingComment(_) => ended = true, // it may be longer than the line
            HardLine | BlankLine | OwnLineComment(_) if flat => return false,
            Line | SoftLine | HardLine | BlankLine | OwnLineComment(_) => return room >= 0,
            Indent(inner) => jobs.push((inner, flat)),
            Group(inner) => jobs.push((inner, flat)),
            Concat(parts) => jobs.extend(parts.iter().rev().map(|part| (part, flat))),
        }
        if room < 0 {
            return false;
        }
    }
}
