//! The text of a coupling file, taken apart into its statements (spec/refine.md).
//!
//! In: the text. Out: a [`Written`], whose terms are still texts that know their places, or the first fault of the form. What the
//! terms mean is known only beside two models: see [`crate::coupling`].

use syntax::{Diagnostic, FileId, Span};

use crate::diagram::{Diagram, Diagrams};
use crate::fault::bad_coupling;

/// A part of the text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Part {
    /// The text without the space around it.
    pub text: String,
    /// Where it stands.
    pub span: Span,
}

/// The function of one side that a statement names.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Mapped {
    /// The abstract machine's input.
    pub input: Part,
    /// Its value: a term over the concrete machine.
    pub term: Part,
}

/// What a coupling file says.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Written {
    /// The file.
    pub file: FileId,
    /// The paths of the abstract and of the concrete model.
    pub models: [Option<Part>; 2],
    /// Functions that are equal in both machines.
    pub same: Vec<Part>,
    /// The conjuncts of the coupling relation.
    pub couples: Vec<Part>,
    /// What holds where a segment ends.
    pub segment: Option<Part>,
    /// The diagrams that are allowed.
    pub diagrams: Option<Diagrams>,
    /// Inputs of the abstract machine that are given by terms.
    pub inputs: Vec<Mapped>,
    /// Inputs that the abstract machine takes as it likes.
    pub free: Vec<Part>,
    /// The concrete machine may go on for ever without a step of the abstract one.
    pub waiting: bool,
    /// Runs of the concrete machine are looked at as far as its numbers have 64 bits.
    pub overflow: bool,
    /// What is true again and again in the runs of the concrete machine that count.
    pub fair: Vec<Part>,
    /// What decreases while the abstract machine makes no step.
    pub variant: Option<Part>,
}

/// The words that statements begin with.
pub const WORDS: [&str; 11] =
    ["abstract", "allow", "concrete", "couple", "diagrams", "fair", "free", "input", "same", "segment", "variant"];

impl Written {
    /// A file that says nothing: the default coupling.
    pub fn nothing(file: FileId) -> Written {
        let (models, same, couples) = ([None, None], Vec::new(), Vec::new());
        let (segment, diagrams, inputs, free, variant) = (None, None, Vec::new(), Vec::new(), None);
        let (waiting, overflow, fair) = (false, false, Vec::new());
        Written { file, models, same, couples, segment, diagrams, inputs, free, waiting, overflow, fair, variant }
    }
}

/// A statement as it stands.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Statement {
    /// The word that it begins with.
    pub word: Part,
    /// What stands between the word and the `;`.
    pub body: Part,
    /// The place behind the `;`.
    pub end: usize,
}

/// The statements of a text that says something, in its order.
///
/// # Errors
/// The first place that says nothing.
pub(crate) fn statements(file: FileId, text: &str) -> Result<Vec<Statement>, Box<Diagnostic>> {
    read(file, text)?;
    let mut reader = Reader { file, text, at: 0 };
    let mut all = Vec::new();
    while let Some(word) = reader.word()? {
        let body = reader.body(&word)?;
        all.push(Statement { word, body, end: reader.at });
    }
    Ok(all)
}

/// What a text says.
///
/// # Errors
/// The first place that says nothing.
pub fn read(file: FileId, text: &str) -> Result<Written, Box<Diagnostic>> {
    let mut reader = Reader { file, text, at: 0 };
    let mut written = Written::nothing(file);
    while let Some(word) = reader.word()? {
        reader.statement(&word, &mut written)?;
    }
    Ok(written)
}

struct Reader<'t> {
    file: FileId,
    text: &'t str,
    at: usize,
}

impl<'t> Reader<'t> {
    fn span(&self, start: usize, end: usize) -> Span {
        Span { file: self.file, start: start as u32, end: end as u32 }
    }

    fn rest(&self) -> &'t str {
        &self.text[self.at..]
    }

    /// Skips a comment that begins here; whether there was one.
    fn comment(&mut self) -> Result<bool, Box<Diagnostic>> {
        let rest = self.rest();
        if rest.starts_with("//") {
            self.at += rest.find('\n').unwrap_or(rest.len());
            return Ok(true);
        }
        if rest.starts_with("/*") {
            let Some(end) = rest.find("*/") else {
                let opening = self.span(self.at, self.at + 2);
                return Err(bad_coupling(opening, "this comment does not end"));
            };
            self.at += end + 2;
            return Ok(true);
        }
        Ok(false)
    }

    /// The word that the next statement begins with; none at the end.
    fn word(&mut self) -> Result<Option<Part>, Box<Diagnostic>> {
        loop {
            self.at = self.text.len() - self.rest().trim_start().len();
            if !self.comment()? {
                break;
            }
        }
        let rest = self.rest();
        let Some(first) = rest.chars().next() else { return Ok(None) };
        let len = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len()).max(first.len_utf8());
        let word = Part { text: rest[..len].to_string(), span: self.span(self.at, self.at + len) };
        if !WORDS.contains(&&*word.text) {
            let message = format!("`{}` begins no statement", word.text);
            let help = format!("a statement begins with one of: {}", WORDS.join(", "));
            return Err(Box::new(bad_coupling(word.span, message).with_help(help)));
        }
        self.at += len;
        Ok(Some(word))
    }

    /// The text up to the `;` that ends the statement.
    fn body(&mut self, word: &Part) -> Result<Part, Box<Diagnostic>> {
        let start = self.at;
        let mut at_line_start = false;
        loop {
            if self.comment()? {
                continue;
            }
            let rest = self.rest();
            let Some(next) = rest.chars().next() else {
                let message = format!("the statement `{}` has no `;` at its end", word.text);
                return Err(bad_coupling(word.span, message));
            };
            match next {
                ';' => break,
                '"' => {
                    let Some(end) = rest[1..].find('"') else {
                        return Err(bad_coupling(self.span(self.at, self.at + 1), "this string does not end"));
                    };
                    self.at += end + 2;
                    at_line_start = false;
                    continue;
                }
                '\n' => at_line_start = true,
                next if next.is_whitespace() => {}
                _ => {
                    let begins = |word: &&&str| {
                        rest.strip_prefix(**word).is_some_and(|rest| rest.starts_with([' ', '\t', '\n']))
                    };
                    if at_line_start && let Some(next) = WORDS.iter().find(begins) {
                        let message = format!("a `;` is missing before `{next}`");
                        return Err(bad_coupling(self.span(self.at, self.at + next.len()), message));
                    }
                    at_line_start = false;
                }
            }
            self.at += next.len_utf8();
        }
        let body = self.part(start, self.at);
        self.at += 1;
        if body.text.is_empty() {
            return Err(bad_coupling(word.span, format!("the statement `{}` says nothing", word.text)));
        }
        Ok(body)
    }

    fn part(&self, start: usize, end: usize) -> Part {
        let text = &self.text[start..end];
        let start = start + (text.len() - text.trim_start().len());
        let text = text.trim();
        Part { text: text.to_string(), span: self.span(start, start + text.len()) }
    }

    fn statement(&mut self, word: &Part, written: &mut Written) -> Result<(), Box<Diagnostic>> {
        let body = self.body(word)?;
        let start = body.span.start as usize;
        let again = |what: bool| {
            if what { Err(bad_coupling(word.span, format!("`{}` is said twice", word.text))) } else { Ok(()) }
        };
        match word.text.as_str() {
            "abstract" | "concrete" => {
                let side = usize::from(word.text == "concrete");
                again(written.models[side].is_some())?;
                let quoted = body.text.strip_prefix('"').and_then(|text| text.strip_suffix('"'));
                let Some(path) = quoted.filter(|path| !path.is_empty()) else {
                    let message = format!("the path of a model is expected: {} \"Model.asm\";", word.text);
                    return Err(bad_coupling(body.span, message));
                };
                written.models[side] = Some(Part { text: path.to_string(), span: body.span });
            }
            "couple" => written.couples.push(body),
            "fair" => written.fair.push(body),
            "segment" => {
                again(written.segment.is_some())?;
                written.segment = Some(body);
            }
            "variant" => {
                again(written.variant.is_some())?;
                written.variant = Some(body);
            }
            "same" => {
                for (from, to) in split(&body.text, ',') {
                    let name = self.part(start + from, start + to);
                    let wrong = ["abstract.", "concrete."].iter().any(|side| name.text.starts_with(side));
                    if wrong || !is_name(&name.text) {
                        let message = "the name of a function that both machines have is expected";
                        return Err(bad_coupling(name.span, message));
                    }
                    written.same.push(name);
                }
            }
            "allow" => {
                let allowed = match &*body.text {
                    "waiting" => &mut written.waiting,
                    "overflow" => &mut written.overflow,
                    _ => {
                        let message = "only waiting and overflow can be allowed: allow waiting; or allow overflow;";
                        return Err(bad_coupling(body.span, message));
                    }
                };
                again(std::mem::replace(allowed, true))?;
            }
            "free" => {
                for (from, to) in split(&body.text, ',') {
                    written.free.push(self.abstract_input(start + from, start + to)?);
                }
            }
            "input" => {
                let Some(equals) = body.text.find('=') else {
                    let message = "an input and its value are expected: input abstract.f = concrete.g;";
                    return Err(bad_coupling(body.span, message));
                };
                let input = self.abstract_input(start, start + equals)?;
                let term = self.part(start + equals + 1, body.span.end as usize);
                if term.text.is_empty() {
                    return Err(bad_coupling(body.span, "a value is expected behind `=`"));
                }
                written.inputs.push(Mapped { input, term });
            }
            _ => {
                again(written.diagrams.is_some())?;
                let mut allowed = Vec::new();
                for (from, to) in split(&body.text, ',') {
                    let part = self.part(start + from, start + to);
                    let diagram = Diagram::read(&part.text);
                    allowed.push(diagram.map_err(|message| bad_coupling(part.span, message))?);
                }
                written.diagrams = Some(Diagrams(allowed));
            }
        }
        Ok(())
    }

    /// `abstract.NAME`
    fn abstract_input(&self, start: usize, end: usize) -> Result<Part, Box<Diagnostic>> {
        let part = self.part(start, end);
        match part.text.strip_prefix("abstract.") {
            Some(name) if is_name(name) => Ok(Part { text: name.to_string(), span: part.span }),
            _ => Err(bad_coupling(part.span, "an input of the abstract machine is expected: abstract.NAME")),
        }
    }
}

fn is_name(text: &str) -> bool {
    !text.is_empty() && text.chars().all(|c| c.is_alphanumeric() || c == '_')
}

/// The ranges between the separators.
fn split(text: &str, at: char) -> Vec<(usize, usize)> {
    let mut start = 0;
    let mut parts = Vec::new();
    for (place, _) in text.match_indices(at) {
        parts.push((start, place));
        start = place + 1;
    }
    parts.push((start, text.len()));
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_file_says() {
        let text = "// a\nabstract \"A.asm\"; same f, g;\ncouple abstract.n = concrete.m\n  + 1;\nsegment concrete.pc = IDLE;\
                    diagrams 0..1:1..4;input abstract.x = concrete.y; free abstract.z;";
        let written = read(FileId(0), text).expect("it says something");
        assert_eq!(written.models[0].as_ref().map(|part| &*part.text), Some("A.asm"));
        assert_eq!(written.same.iter().map(|part| &*part.text).collect::<Vec<_>>(), ["f", "g"]);
        assert_eq!(&text[written.couples[0].span.range()], "abstract.n = concrete.m\n  + 1");
        assert_eq!((&*written.inputs[0].input.text, &*written.inputs[0].term.text), ("x", "concrete.y"));
        assert_eq!(written.free[0].text, "z");
        assert!(written.diagrams.expect("some").allows(0, 4));
        assert_eq!(read(FileId(0), " /* nothing */ "), Ok(Written::nothing(FileId(0))));
    }

    #[test]
    fn trouble() {
        let check = |text: &str, at: u32, message: &str| {
            let fault = read(FileId(0), text).expect_err("a fault");
            assert_eq!((fault.primary.span.start, fault.message.as_str()), (at, message));
        };
        check("relate x;", 0, "`relate` begins no statement");
        check("couple x", 0, "the statement `couple` has no `;` at its end");
        check("couple x\nsame f;", 9, "a `;` is missing before `same`");
        check("couple ;", 0, "the statement `couple` says nothing");
        check("same abstract.f;", 5, "the name of a function that both machines have is expected");
        check("free concrete.f;", 5, "an input of the abstract machine is expected: abstract.NAME");
        check("input abstract.f;", 6, "an input and its value are expected: input abstract.f = concrete.g;");
        check("abstract A.asm;", 9, "the path of a model is expected: abstract \"Model.asm\";");
        check("fair;", 0, "the statement `fair` says nothing");
        check("segment a; segment b;", 11, "`segment` is said twice");
        check("variant 1; variant 2;", 11, "`variant` is said twice");
        check("diagrams 1:0;", 9, "a diagram has at least one step of the concrete machine: `m:n` with n from 1");
        check("allow faults;", 6, "only waiting and overflow can be allowed: allow waiting; or allow overflow;");
        check("allow waiting; allow overflow; allow waiting;", 31, "`allow` is said twice");
        check("/* a", 0, "this comment does not end");
        check("€;", 0, "`€` begins no statement");
    }
}
