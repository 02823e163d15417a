//! A YAML document as a tree whose every node knows its place.
//!
//! Scalars are taken as they are written. LIMIT: nesting deeper than [`DEPTH`] is refused, so are aliases.

use saphyr_parser::{Event, Parser, ScanError, Span as Mark, StrInput};
use syntax::{Diagnostic, FileId, Span};

const DEPTH: u32 = 20;

/// A node.
#[derive(Debug, Clone)]
pub struct Node {
    pub span: Span,
    pub shape: Shape,
}

/// What a node is.
#[derive(Debug, Clone)]
pub enum Shape {
    Text(String),
    List(Vec<Node>),
    Map(Vec<(Key, Node)>),
}

/// A key of a mapping.
#[derive(Debug, Clone)]
pub struct Key {
    pub text: String,
    pub span: Span,
}

/// A fault in a specification.
pub fn fault(span: Span, message: impl Into<String>) -> Diagnostic {
    Diagnostic::error("bad-report-specification", span, message)
}

/// Reads a document; an empty one is an empty text.
pub fn read(file: FileId, source: &str) -> Result<Node, Box<Diagnostic>> {
    // Marks count characters, spans bytes.
    let offsets = source.char_indices().map(|(at, _)| at as u32).chain([source.len() as u32]).collect();
    let mut yaml = Yaml { parser: Parser::new_from_str(source), file, offsets, depth: 0 };
    loop {
        match yaml.next()? {
            (Event::StreamStart | Event::DocumentStart(_), _) => {}
            (Event::StreamEnd, mark) => return Ok(Node { span: yaml.span(mark), shape: Shape::Text(String::new()) }),
            (event, mark) => return yaml.node(event, mark),
        }
    }
}

struct Yaml<'a> {
    parser: Parser<'a, StrInput<'a>>,
    file: FileId,
    offsets: Vec<u32>,
    depth: u32,
}

impl<'a> Yaml<'a> {
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
            None => Err(Box::new(fault(Span { file: self.file, start: 0, end: 0 }, "the file ends too early"))),
        }
    }

    fn no_yaml(&self, error: &ScanError) -> Box<Diagnostic> {
        let at = self.byte(error.marker().index());
        Box::new(fault(Span { file: self.file, start: at, end: at }, format!("this is not YAML: {}", error.info())))
    }

    fn node(&mut self, event: Event<'a>, mark: Mark) -> Result<Node, Box<Diagnostic>> {
        let span = self.span(mark);
        self.depth += 1;
        if self.depth > DEPTH {
            return Err(Box::new(fault(span, "this nests too deep")));
        }
        let shape = match event {
            Event::Scalar(text, ..) => Shape::Text(text.into_owned()),
            Event::SequenceStart(..) => self.list()?,
            Event::MappingStart(..) => self.map()?,
            _ => return Err(Box::new(fault(span, "a text, a list or a mapping is expected"))),
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
                _ => return Err(Box::new(fault(span, "a key is a text"))),
            };
            if entries.iter().any(|(key, _)| key.text == text) {
                return Err(Box::new(fault(span, format!("`{text}` is given twice"))));
            }
            let (event, mark) = self.next()?;
            entries.push((Key { text, span }, self.node(event, mark)?));
        }
    }
}
