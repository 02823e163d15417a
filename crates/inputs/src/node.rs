//! A YAML document as a tree whose every node knows its place.
//!
//! In: a text, and the id of its faults. Out: a [`Node`], or the first fault. Scalars are taken as they are written.
//! LIMIT: nesting deeper than `DEPTH` is refused, and so are aliases.

use saphyr_parser::{Event, Parser, ScalarStyle, ScanError, Span as Mark, StrInput};
use syntax::{Diagnostic, FileId, Span};

use crate::Scalar;

const DEPTH: u32 = 20;

/// A node.
#[derive(Debug, Clone)]
pub struct Node {
    /// Where it stands.
    pub span: Span,
    /// What it is.
    pub shape: Shape,
}

/// What a node is.
#[derive(Debug, Clone)]
pub enum Shape {
    /// A scalar, as it is written.
    Text(Scalar),
    /// A sequence.
    List(Vec<Node>),
    /// A mapping, in the order of the file; no key comes twice.
    Map(Vec<(Key, Node)>),
}

/// A key of a mapping.
#[derive(Debug, Clone)]
pub struct Key {
    /// The key, as it is written.
    pub text: String,
    /// Where it stands.
    pub span: Span,
}

/// Reads a document; an empty one is an empty text. `id` is that of its faults.
///
/// # Errors
/// The first fault.
pub fn read(file: FileId, source: &str, id: &'static str) -> Result<Node, Box<Diagnostic>> {
    // Marks count characters, spans bytes.
    let offsets = source.char_indices().map(|(at, _)| at as u32).chain([source.len() as u32]).collect();
    let mut yaml = Yaml { parser: Parser::new_from_str(source), source, file, id, offsets, depth: 0 };
    loop {
        match yaml.next()? {
            (Event::StreamStart | Event::DocumentStart(_), _) => {}
            (Event::StreamEnd, mark) => {
                let span = yaml.span(mark);
                return Ok(Node { span, shape: Shape::Text(Scalar::new(String::new(), ScalarStyle::Plain, span, "")) });
            }
            (event, mark) => {
                let node = yaml.node(event, mark)?;
                yaml.end()?;
                return Ok(node);
            }
        }
    }
}

/// What stands behind a document would be left out without a word.
pub(crate) const SECOND: &str = "a second document begins here; a file has one";

struct Yaml<'a> {
    parser: Parser<'a, StrInput<'a>>,
    source: &'a str,
    file: FileId,
    id: &'static str,
    offsets: Vec<u32>,
    depth: u32,
}

impl<'a> Yaml<'a> {
    fn fault(&self, span: Span, message: impl Into<String>) -> Box<Diagnostic> {
        Box::new(Diagnostic::error(self.id, span, message))
    }

    fn byte(&self, index: usize) -> u32 {
        self.offsets.get(index).or(self.offsets.last()).copied().unwrap_or(0)
    }

    fn span(&self, mark: Mark) -> Span {
        Span { file: self.file, start: self.byte(mark.start.index()), end: self.byte(mark.end.index()) }
    }

    fn next(&mut self) -> Result<(Event<'a>, Mark), Box<Diagnostic>> {
        match self.parser.next_event() {
            Some(Ok(event)) => Ok(event),
            Some(Err(error)) => Err(self.no_yaml(&error)),
            None => Err(self.fault(Span { file: self.file, start: 0, end: 0 }, "the file ends too early")),
        }
    }

    /// Nothing but the end of the file follows a document.
    fn end(&mut self) -> Result<(), Box<Diagnostic>> {
        loop {
            match self.next()? {
                (Event::StreamEnd, _) => return Ok(()),
                (Event::DocumentEnd, _) => {}
                (_, mark) => return Err(self.fault(self.span(mark), SECOND)),
            }
        }
    }

    fn no_yaml(&self, error: &ScanError) -> Box<Diagnostic> {
        let at = self.byte(error.marker().index());
        self.fault(Span { file: self.file, start: at, end: at }, format!("this is not YAML: {}", error.info()))
    }

    fn node(&mut self, event: Event<'a>, mark: Mark) -> Result<Node, Box<Diagnostic>> {
        let span = self.span(mark);
        self.depth += 1;
        if self.depth > DEPTH {
            return Err(self.fault(span, "this nests too deep"));
        }
        let shape = match event {
            Event::Scalar(text, style, ..) => {
                Shape::Text(Scalar::new(text.into_owned(), style, span, &self.source[span.range()]))
            }
            Event::SequenceStart(..) => self.list()?,
            Event::MappingStart(..) => self.map()?,
            _ => return Err(self.fault(span, "a text, a list or a mapping is expected")),
        };
        self.depth -= 1;
        Ok(Node { span, shape })
    }

    fn list(&mut self) -> Result<Shape, Box<Diagnostic>> {
        let mut items = Vec::new();
        loop {
            match self.next()? {
                (Event::SequenceEnd, _) => return Ok(Shape::List(items)),
                (event, mark) => items.push(self.node(event, mark)?),
            }
        }
    }

    fn map(&mut self) -> Result<Shape, Box<Diagnostic>> {
        let mut entries: Vec<(Key, Node)> = Vec::new();
        loop {
            let (event, mark) = self.next()?;
            let span = self.span(mark);
            let text = match event {
                Event::MappingEnd => return Ok(Shape::Map(entries)),
                Event::Scalar(text, ..) => text.into_owned(),
                _ => return Err(self.fault(span, "a key is a text")),
            };
            if entries.iter().any(|(key, _)| key.text == text) {
                return Err(self.fault(span, format!("`{text}` is given twice")));
            }
            let (event, mark) = self.next()?;
            entries.push((Key { text, span }, self.node(event, mark)?));
        }
    }
}
