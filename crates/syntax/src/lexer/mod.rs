//! Text → tokens.
//!
//! In: the text of one file. Out: tokens that cover it without gaps, and the faults of characters that make no token.
//! Three places have rules of their own: the name after `asm`, `module` and `init` has any shape; the path after
//! `import` (and after `load` in a scenario) is read as a whole; and a number takes the imaginary unit that touches it.
//! A complex literal never takes a sign, nor the start of a name.
//!
//! INVARIANT: the tokens' texts joined are the text.

mod raw;
mod word;

use crate::fault;
use crate::limit::MAX_FAULTS;
use crate::{Diagnostic, FileId, Span, SyntaxKind, SyntaxKind::*};
use logos::Logos;
use raw::Raw;
pub(crate) use word::classify;

/// Which language is read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Mode {
    AsmetaL,
    Avalla,
    Chart,
}

/// A token: it ends where the next one starts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Token {
    pub(crate) kind: SyntaxKind,
    pub(crate) start: u32,
}

/// What the next significant token is read as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Context {
    Normal,
    Name,
    Path,
}

struct Lexer<'t> {
    file: FileId,
    text: &'t str,
    mode: Mode,
    context: Context,
    path_seen: bool,
    tokens: Vec<Token>,
    faults: Vec<Diagnostic>,
    unterminated: Vec<u32>,
}

/// What the lexer gives.
#[derive(Debug)]
pub(crate) struct Lexed {
    /// The last one is an [`EOF`] of no length.
    pub(crate) tokens: Vec<Token>,
    pub(crate) faults: Vec<Diagnostic>,
    /// Starts of strings, characters and comments without their end.
    pub(crate) unterminated: Vec<u32>,
}

/// Cuts a text into tokens.
pub(crate) fn tokenize(file: FileId, text: &str, mode: Mode) -> Lexed {
    let mut lexer = Lexer {
        file,
        text,
        mode,
        context: Context::Normal,
        path_seen: false,
        unterminated: Vec::new(),
        tokens: Vec::with_capacity(text.len() / 4 + 1),
        faults: Vec::new(),
    };
    lexer.run();
    lexer.push(EOF, text.len());
    Lexed { tokens: lexer.tokens, faults: lexer.faults, unterminated: lexer.unterminated }
}

impl<'t> Lexer<'t> {
    fn run(&mut self) {
        let mut raw = Raw::lexer(self.text);
        while let Some(token) = raw.next() {
            let (start, end) = (raw.span().start, raw.span().end);
            match token {
                Ok(Raw::Whitespace) => self.push(WHITESPACE, start),
                Ok(Raw::LineComment) => self.push(LINE_COMMENT, start),
                Ok(Raw::BlockComment) => {
                    if end - start < 4 || !self.text[start..end].ends_with("*/") {
                        self.fault(fault::unterminated_comment(self.span(start, start + 2)));
                        self.unterminated.push(start as u32);
                    }
                    self.push(BLOCK_COMMENT, start);
                }
                _ if self.context == Context::Path && token != Ok(Raw::String) => {
                    self.context = Context::Normal;
                    let length = self.path_length(start);
                    if length == 0 {
                        self.significant(token, start, end);
                    } else {
                        self.push(MODULE_REF, start);
                        raw = Raw::lexer(self.text);
                        raw.bump(start + length);
                    }
                }
                Ok(Raw::Word | Raw::Imaginary) if self.context == Context::Name && self.mode == Mode::Avalla => {
                    self.context = Context::Normal;
                    self.push(GENERIC_ID, start);
                    raw = Raw::lexer(self.text);
                    raw.bump(start + self.dotted_name_length(start));
                }
                _ => self.significant(token, start, end),
            }
        }
    }

    fn significant(&mut self, token: Result<Raw, ()>, start: usize, end: usize) {
        let text = &self.text[start..end];
        let context = std::mem::replace(&mut self.context, Context::Normal);
        let kind = match token {
            Ok(Raw::Word | Raw::Imaginary) if context == Context::Name && !text.contains('.') => GENERIC_ID,
            Ok(Raw::Word) if self.takes_exponent(text, start) => return,
            Ok(Raw::Word) => self.word(text),
            Ok(Raw::ForeignWord) => {
                self.fault(fault::foreign_letter(self.span(start, end), text));
                classify(text)
            }
            Ok(Raw::Imaginary) => match self.number_before(start) {
                Some(number) => {
                    number.kind = COMPLEX;
                    return;
                }
                None => COMPLEX,
            },
            Ok(Raw::String) => self.quoted(STRING, text, start),
            Ok(Raw::Char) => self.quoted(CHAR, text, start),
            Ok(Raw::OpenString) => {
                self.fault(fault::unterminated_string(self.span(start, end)));
                self.unterminated.push(start as u32);
                STRING
            }
            Ok(Raw::OpenChar) => {
                self.fault(fault::unterminated_character(self.span(start, end)));
                self.unterminated.push(start as u32);
                CHAR
            }
            Ok(Raw::Foreign) => {
                self.fault(fault::foreign_operator(self.span(start, end), text));
                ERROR
            }
            Ok(Raw::ForeignComment) => {
                self.fault(fault::unknown_character(self.span(start, start + 1), "#"));
                ERROR
            }
            Ok(mark) => mark.kind(),
            Err(()) => {
                if let Some(last) = self.tokens.last()
                    && last.kind == ERROR
                    && fault::replacement(&self.text[last.start as usize..start]).is_none()
                    && fault::replacement(text).is_none()
                {
                    return; // a run of strange characters is one token, reported once
                }
                self.fault(fault::unknown_character(self.span(start, end), text));
                ERROR
            }
        };
        self.push(kind, start);
    }

    fn word(&mut self, text: &str) -> SyntaxKind {
        let kind = classify(text);
        match self.mode {
            Mode::AsmetaL => match kind {
                ASM_KW | MODULE_KW | INIT_KW => self.context = Context::Name,
                IMPORT_KW => self.context = Context::Path,
                _ => {}
            },
            Mode::Chart if kind == IMPORT_KW => self.context = Context::Path,
            Mode::Chart => {}
            Mode::Avalla => match text {
                "scenario" if self.significant_before() == 0 => self.context = Context::Name,
                "load" if !self.path_seen && (self.significant_before() <= 2 || self.starts_line()) => {
                    self.path_seen = true;
                    self.context = Context::Path;
                }
                _ => {}
            },
        }
        kind
    }

    /// The token read last is white space that ends a line.
    fn starts_line(&self) -> bool {
        let space = self.tokens.last().filter(|token| token.kind == WHITESPACE);
        space.is_some_and(|space| self.text[space.start as usize..].starts_with(['\n', '\r']))
    }

    /// How many tokens other than trivia were read; 3 also stands for more.
    fn significant_before(&self) -> usize {
        self.tokens.iter().filter(|token| !token.kind.is_trivia()).take(3).count()
    }

    /// The length of the name of a scenario, which may hold dots.
    fn dotted_name_length(&self, start: usize) -> usize {
        let rest = &self.text[start..];
        let part = |letter: char| letter.is_ascii_alphanumeric() || letter == '_' || letter == '.';
        rest.find(|letter| !part(letter)).unwrap_or(rest.len())
    }

    /// The length of the path that starts here; 0 when there is none.
    fn path_length(&self, start: usize) -> usize {
        let rest = &self.text[start..];
        let bytes = rest.as_bytes();
        let drive =
            bytes.len() > 2 && bytes[0].is_ascii_alphabetic() && bytes[1] == b':' && matches!(bytes[2], b'/' | b'\\');
        let from = if drive { 2 } else { 0 };
        let mut length = from;
        for (at, letter) in rest[from..].char_indices() {
            let here = &rest[from + at..];
            let part = letter.is_alphanumeric() || "/\\._-+~@#".contains(letter);
            if !part || here.starts_with("//") || here.starts_with("/*") {
                break;
            }
            length = from + at + letter.len_utf8();
        }
        let next_line = self.tokens.last().is_some_and(|token| self.text[token.start as usize..start].contains('\n'));
        match &rest[..length] {
            "signature" | "import" | "export" | "definitions" if next_line => 0, // the path is missing
            _ => length,
        }
    }

    /// The number that touches this place.
    fn number_before(&mut self, start: usize) -> Option<&mut Token> {
        let text = self.text;
        self.tokens.last_mut().filter(|token| {
            matches!(token.kind, INTEGER | REAL)
                && text[token.start as usize..start].bytes().all(|b| b.is_ascii_digit() || b == b'.')
        })
    }

    /// `1.5e3` is meant as a number with an exponent: reports that and joins the two.
    fn takes_exponent(&mut self, text: &str, start: usize) -> bool {
        let exponent = text.len() > 1
            && matches!(text.as_bytes()[0], b'e' | b'E')
            && text.bytes().skip(1).all(|b| b.is_ascii_digit());
        if !exponent {
            return false;
        }
        let Some(number) = self.number_before(start) else { return false };
        number.kind = REAL;
        let from = number.start as usize;
        let span = self.span(from, start + text.len());
        self.fault(fault::exponent(span, &self.text[from..start + text.len()]));
        true
    }

    /// Checks the escapes of a character or string literal.
    fn quoted(&mut self, kind: SyntaxKind, text: &str, start: usize) -> SyntaxKind {
        if !text.contains('\\') {
            return kind;
        }
        let mut letters = text.char_indices();
        while let Some((at, letter)) = letters.next() {
            if letter == '\\'
                && let Some((next, escaped)) = letters.next()
                && !matches!(escaped, 'n' | 't' | 'b' | 'r' | 'f' | '\\' | '\'' | '"' | '0'..='7')
                && !(escaped == 'u' && is_hexadecimal(text, next + 1))
            {
                let span = self.span(start + at, start + next + escaped.len_utf8());
                self.fault(fault::unknown_escape(span, escaped));
            }
        }
        kind
    }

    fn fault(&mut self, fault: Diagnostic) {
        if self.faults.len() <= MAX_FAULTS {
            self.faults.push(fault);
        }
    }

    fn span(&self, start: usize, end: usize) -> Span {
        Span { file: self.file, start: start as u32, end: end as u32 }
    }

    fn push(&mut self, kind: SyntaxKind, start: usize) {
        self.tokens.push(Token { kind, start: start as u32 });
    }
}
/// Whether four hexadecimal digits stand there.
fn is_hexadecimal(text: &str, at: usize) -> bool {
    text.as_bytes().get(at..at + 4).is_some_and(|digits| digits.iter().all(u8::is_ascii_hexdigit))
}
