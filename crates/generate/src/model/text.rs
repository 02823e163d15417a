//! Generated text: indented lines, each of which may correspond to a place in the model.
//!
//! In: lines in order. Out: the text with `#line` directives, so that compiler messages and debuggers point into the
//! model, and the corresponding [`Mapping`]s. INVARIANT: outside of marked lines, the directives name the generated
//! file and the true line.

use syntax::{Sources, Span};

/// A generated line and its place in the model.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Mapping {
    /// The generated line, from 1.
    pub line: u32,
    /// The rule, term or declaration of the model.
    pub span: Span,
}

#[derive(Debug, Clone)]
struct Line {
    indent: usize,
    text: String,
    span: Option<Span>,
}

/// A file under construction.
#[derive(Debug, Clone, Default)]
pub(crate) struct Text {
    lines: Vec<Line>,
    indent: usize,
}

impl Text {
    /// One line, or several.
    pub fn line(&mut self, text: impl AsRef<str>) {
        for text in text.as_ref().split('\n') {
            self.lines.push(Line { indent: self.indent, text: text.to_string(), span: None });
        }
    }

    /// A line that corresponds to a place in the model.
    pub fn marked(&mut self, span: Span, text: impl Into<String>) {
        self.lines.push(Line { indent: self.indent, text: text.into(), span: Some(span) });
    }

    /// A line that opens a block.
    pub fn open(&mut self, text: impl AsRef<str>) {
        self.line(text);
        self.indent += 1;
    }

    /// The same, for a place in the model.
    pub fn open_marked(&mut self, span: Span, text: impl Into<String>) {
        self.marked(span, text);
        self.indent += 1;
    }

    /// A line that closes a block.
    pub fn close(&mut self, text: impl AsRef<str>) {
        self.indent -= 1;
        self.line(text);
    }

    /// A line that closes a block and opens another.
    pub fn between(&mut self, text: impl AsRef<str>) {
        self.indent -= 1;
        self.open(text);
    }

    /// Moves the lines into another text, at its indentation.
    pub fn pour(self, into: &mut Text) {
        let indent = into.indent;
        into.lines.extend(self.lines.into_iter().map(|line| Line { indent: line.indent + indent, ..line }));
    }

    /// The lines without their marks.
    pub fn plain(&self) -> String {
        let mut out = String::new();
        self.lines.iter().for_each(|line| push(&mut out, line));
        out
    }

    /// The text as the file of this name, and the places of its lines.
    pub fn finish(&self, name: &str, sources: &Sources) -> (String, Vec<Mapping>) {
        let mut out = String::new();
        let mut mappings = Vec::new();
        let mut number = 0;
        let mut marked: Option<Span> = None;
        for line in &self.lines {
            match line.span {
                Some(span) => {
                    let file = sources.file(span.file);
                    let at = file.line_column(span.start).line;
                    out.push_str(&format!("#line {at} \"{}\"\n", escaped(&file.name)));
                    number += 1;
                    mappings.push(Mapping { line: number + 1, span });
                }
                None if marked.is_some() => {
                    // This directive is on line number + 1 and describes the next line.
                    out.push_str(&format!("#line {} \"{name}\"\n", number + 2));
                    number += 1;
                }
                None => {}
            }
            marked = line.span;
            push(&mut out, line);
            number += 1;
        }
        (out, mappings)
    }
}

fn push(out: &mut String, line: &Line) {
    if !line.text.is_empty() {
        out.push_str(&"    ".repeat(line.indent));
        out.push_str(&line.text);
    }
    out.push('\n');
}

/// A text as the contents of a C++ string literal.
pub(crate) fn escaped(text: &str) -> String {
    let mut out = String::new();
    for letter in text.chars() {
        match letter {
            '"' => out.push_str("\\\""),
            '\\' => out.push_str("\\\\"),
            '\n' => out.push_str("\\n"),
            // Always three digits, so that following digits are not read as part of the escape.
            letter if !(' '..='~').contains(&letter) => {
                let mut bytes = [0; 4];
                for byte in letter.encode_utf8(&mut bytes).bytes() {
                    out.push_str(&format!("\\{byte:03o}"));
                }
            }
            letter => out.push(letter),
        }
    }
    // Prevents trigraphs.
    out.replace("??", "?\\?")
}
