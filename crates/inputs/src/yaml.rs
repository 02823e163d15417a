//! YAML inputs: steps to locations to values.
//!
//! ```yaml
//! always: { passed: false }
//! 1:
//!   temperature(ROOM1): 21
//! 3..5:
//!   passed: true
//! random: { stop: 1 %, mode: { FAULT: 2 %, SLOW: 10 % } }
//! ```
//!
//! Scalars are taken as they are written, whatever YAML would make of them: the domain of the location decides how they
//! are read. Sequences are sequences, sets, bags or tuples; mappings are maps.

use saphyr_parser::{Event, Parser, ScanError, Span as Mark};
use simulate::{Given, Often, Steps, Weighing, Written};
use syntax::{Diagnostic, FileId, Span};

use crate::node::SECOND;
use crate::{Contents, Read, fault, steps, whole};

/// Reads a document.
pub fn read(file: FileId, source: &str) -> Read<Contents> {
    let mut yaml = Yaml { parser: Parser::new_from_str(source), place: Places::new(file, source), depth: 0 };
    let mut contents = Contents::default();
    let mut documents = 0;
    loop {
        let (event, mark) = yaml.next()?;
        match event {
            Event::DocumentStart(_) if documents > 0 => return Err(fault(yaml.place.span(mark), SECOND)),
            Event::DocumentStart(_) => documents += 1,
            Event::StreamStart | Event::DocumentEnd => {}
            Event::StreamEnd => return Ok(contents),
            Event::MappingStart(..) => yaml.document(&mut contents)?,
            // An empty document is one empty scalar.
            Event::Scalar(text, ..) if text.is_empty() || text == "~" => {}
            _ => return Err(fault(yaml.place.span(mark), EXPECTED)),
        }
    }
}

const EXPECTED: &str = "a mapping of steps to locations is expected, such as `1: { passed: true }`";

const OFTEN: &str = "how often values come is expected, such as `stop: 1 %`, or `mode: { SLOW: 3, FAST: 1 }`";

struct Yaml<'a> {
    parser: Parser<'a, saphyr_parser::StrInput<'a>>,
    place: Places<'a>,
    depth: u32,
}

/// LIMIT: values nested deeper than this are refused.
const DEPTH: u32 = 100;

impl<'a> Yaml<'a> {
    fn next(&mut self) -> Result<(Event<'a>, Mark), Box<Diagnostic>> {
        match self.parser.next_event() {
            Some(Ok(event)) => Ok(event),
            Some(Err(error)) => Err(self.scan_fault(&error)),
            None => Err(fault(whole(self.place.file), "the file ends too early")),
        }
    }

    fn scan_fault(&self, error: &ScanError) -> Box<Diagnostic> {
        let at = self.place.byte(error.marker().index());
        let span = Span { file: self.place.file, start: at, end: at };
        fault(span, format!("this is not YAML: {}", error.info()))
    }

    fn document(&mut self, contents: &mut Contents) -> Result<(), Box<Diagnostic>> {
        loop {
            let (event, mark) = self.next()?;
            let span = self.place.span(mark);
            match event {
                Event::MappingEnd => return Ok(()),
                Event::Scalar(key, ..) if key == "random" => self.random(&mut contents.weighings)?,
                Event::Scalar(key, ..) => {
                    let steps = steps(&key, span)?;
                    self.step(steps, &mut contents.given)?;
                }
                _ => return Err(fault(span, EXPECTED)),
            }
        }
    }

    fn step(&mut self, steps: Steps, given: &mut Vec<Given>) -> Result<(), Box<Diagnostic>> {
        let (event, mark) = self.next()?;
        match event {
            Event::MappingStart(..) => {}
            Event::Scalar(text, ..) if text.is_empty() || text == "~" => return Ok(()),
            _ => return Err(fault(self.place.span(mark), "a mapping of locations to values is expected")),
        }
        loop {
            let (event, mark) = self.next()?;
            let span = self.place.span(mark);
            match event {
                Event::MappingEnd => return Ok(()),
                Event::Scalar(name, ..) => {
                    let name = name.into_owned();
                    let value = self.value()?;
                    given.push(Given { steps, location: (name, span), value });
                }
                _ => return Err(fault(span, "the name of a location is expected")),
            }
        }
    }

    /// How often values come: a location has a share, or a mapping of values to weights or shares.
    fn random(&mut self, weighings: &mut Vec<Weighing>) -> Result<(), Box<Diagnostic>> {
        let (event, mark) = self.next()?;
        match event {
            Event::MappingStart(..) => {}
            Event::Scalar(text, ..) if text.is_empty() || text == "~" => return Ok(()),
            _ => return Err(fault(self.place.span(mark), OFTEN)),
        }
        loop {
            let (event, mark) = self.next()?;
            let place = self.place.span(mark);
            match event {
                Event::MappingEnd => return Ok(()),
                Event::Scalar(name, ..) => {
                    let location = (name.into_owned(), place);
                    let (event, mark) = self.next()?;
                    let whole = self.place.span(mark);
                    let (often, values) = match event {
                        Event::Scalar(share, ..) if share.trim_end().ends_with('%') => {
                            (Often::True(share.into_owned()), Vec::new())
                        }
                        Event::Scalar(text, ..) if text.trim_start().starts_with("after ") => {
                            (Often::After(text.into_owned()), Vec::new())
                        }
                        Event::MappingStart(..) => self.each()?,
                        _ => return Err(fault(whole, OFTEN)),
                    };
                    let whole = match (values.first(), values.last()) {
                        (Some(first), Some(last)) => Span { end: last.end, ..*first },
                        _ => whole,
                    };
                    weighings.push(Weighing { location, often: (often, whole), values });
                }
                _ => return Err(fault(place, "the name of a location is expected")),
            }
        }
    }

    /// Values, each with how often it comes.
    fn each(&mut self) -> Result<(Often, Vec<Span>), Box<Diagnostic>> {
        let (mut each, mut places) = (Vec::new(), Vec::new());
        loop {
            let (event, mark) = self.next()?;
            if matches!(event, Event::MappingEnd) {
                return Ok((Often::Each(each), places));
            }
            let begin = self.place.span(mark);
            let value = self.written(event, begin)?;
            match self.next()? {
                (Event::Scalar(often, ..), mark) => {
                    each.push((value, often.into_owned()));
                    places.push(Span { end: self.place.span(mark).end, ..begin });
                }
                (_, mark) => return Err(fault(self.place.span(mark), OFTEN)),
            }
        }
    }

    fn value(&mut self) -> Result<(Written, Span), Box<Diagnostic>> {
        let (event, mark) = self.next()?;
        let span = self.place.span(mark);
        self.written(event, span).map(|written| (written, span))
    }

    fn written(&mut self, event: Event<'a>, span: Span) -> Result<Written, Box<Diagnostic>> {
        self.depth += 1;
        if self.depth > DEPTH {
            return Err(fault(span, "this nests too deep"));
        }
        let written = match event {
            Event::Scalar(text, ..) => Ok(Written::Text(text.into_owned())),
            Event::SequenceStart(..) => self.sequence(),
            Event::MappingStart(..) => self.mapping(),
            Event::Alias(_) => Err(fault(span, "aliases are not read here: write the value again")),
            _ => Err(fault(span, "a value is expected")),
        };
        self.depth -= 1;
        written
    }

    fn sequence(&mut self) -> Result<Written, Box<Diagnostic>> {
        let mut items = Vec::new();
        loop {
            match self.next()? {
                (Event::SequenceEnd, _) => return Ok(Written::List(items)),
                (event, mark) => {
                    let span = self.place.span(mark);
                    items.push(self.written(event, span)?);
                }
            }
        }
    }

    fn mapping(&mut self) -> Result<Written, Box<Diagnostic>> {
        let mut entries = Vec::new();
        loop {
            match self.next()? {
                (Event::MappingEnd, _) => return Ok(Written::Entries(entries)),
                (event, mark) => {
                    let span = self.place.span(mark);
                    let key = self.written(event, span)?;
                    entries.push((key, self.value()?.0));
                }
            }
        }
    }
}

/// Marks count characters, spans bytes.
struct Places<'a> {
    file: FileId,
    source: &'a str,
    /// Byte offsets of the characters, where the two differ.
    offsets: Option<Vec<u32>>,
}

impl<'a> Places<'a> {
    fn new(file: FileId, source: &'a str) -> Self {
        let offsets = (!source.is_ascii()).then(|| source.char_indices().map(|(at, _)| at as u32).collect());
        Places { file, source, offsets }
    }

    fn byte(&self, index: usize) -> u32 {
        let end = self.source.len() as u32;
        match &self.offsets {
            None => (index as u32).min(end),
            Some(offsets) => offsets.get(index).copied().unwrap_or(end),
        }
    }

    fn span(&self, mark: Mark) -> Span {
        Span { file: self.file, start: self.byte(mark.start.index()), end: self.byte(mark.end.index()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(source: &str, expected: &[&str]) {
        let read: Vec<String> = match read(FileId(0), source) {
            Ok(Contents { given, weighings }) => {
                let given = given.iter().map(|g| format!("{:?} {} = {:?}", g.steps, g.location.0, g.value.0));
                let often = |w: &Weighing| {
                    let places = w.values.iter().map(|span| &source[span.start as usize..span.end as usize]);
                    format!("{}: {:?} at {:?}", w.location.0, w.often.0, places.collect::<Vec<_>>())
                };
                given.chain(weighings.iter().map(often)).collect()
            }
            Err(fault) => vec![fault.message],
        };
        assert_eq!(read, expected);
    }

    #[test]
    fn scalars_are_as_written() {
        check(
            "always: { passed: no }\n1:\n  level: 1.0\n3..5:\n  at(A,B): 07\n",
            &["From(0) passed = Text(\"no\")", "From(1) level = Text(\"1.0\")", "Range(3, 5) at(A,B) = Text(\"07\")"],
        );
    }

    #[test]
    fn collections() {
        check(
            "2: { s: [1, 2], m: {a: 1} }",
            &["From(2) s = List([Text(\"1\"), Text(\"2\")])", "From(2) m = Entries([(Text(\"a\"), Text(\"1\"))])"],
        );
    }

    #[test]
    fn how_often() {
        check(
            "random: { stop: 1 %, 'at(A)': { '(1,2)': 3, B: 1 } }",
            &[
                "stop: True(\"1 %\") at []",
                "at(A): Each([(Text(\"(1,2)\"), \"3\"), (Text(\"B\"), \"1\")]) at [\"'(1,2)': 3\", \"B: 1\"]",
            ],
        );
        check("random: { stop: after 0..4..16 }", &["stop: After(\"after 0..4..16\") at []"]);
        check("random: { stop: true }", &[OFTEN]);
        check("random: [stop]", &[OFTEN]);
        check("random: { mode: { A: [1] } }", &[OFTEN]);
        check("random: { stop: [1] }", &[OFTEN]);
    }

    #[test]
    fn trouble() {
        check("- 1", &[EXPECTED]);
        check("", &[]);
        check("1: {a: x}\n---\n1: {a: y}", &[SECOND]);
        check("---\n---\n1: {a: y}", &[SECOND]);
        check("1: {a: 'x", &["this is not YAML: while scanning a quoted scalar, found unexpected end of stream"]);
    }
}
