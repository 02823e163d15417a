//! Text → tokens.
//!
//! In: the text of one file. Out: tokens that cover it without gap, and the faults of characters that are no token.
//! Three places read otherwise than the rest: the name behind `asm`, `module` and `init` is of any shape, the path
//! behind `import` (and behind `load` in a scenario) is read as a whole, and a number takes the imaginary unit that
//! touches it. A complex literal never takes a sign, nor the start of a name.
//!
//! INVARIANT: the tokens' texts joined are the text.

mod raw;
mod word;

use crate::fault;
use crate::{Diagnostic, FileId, Span, SyntaxKind, SyntaxKind::*};
use logos::Logos;
use raw::Raw;

/// Which language is read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Mode {
    AsmetaL,
    Avalla,
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
}

/// Cuts a text into tokens; the last one is an [`EOF`] of no length.
pub(crate) fn tokenize(file: FileId, text: &str, mode: Mode) -> (Vec<Token>, Vec<Diagnostic>) {
    let mut lexer = Lexer {
        file,
        text,
        mode,
        context: Context::Normal,
        path_seen: false,
        tokens: Vec::with_capacity(text.len() / 4 + 1),
        faults: Vec::new(),
    };
    lexer.run();
    lexer.push(EOF, text.len());
    (lexer.tokens, lexer.faults)
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
                        self.faults.push(fault::unterminated_comment(self.span(start, start + 2)));
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
            Ok(Raw::Word) => self.word(text, start),
            Ok(Raw::ForeignWord) => {
                self.faults.push(fault::foreign_letter(self.span(start, end), text));
                word::classify(text)
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
                self.faults.push(fault::unterminated_string(self.span(start, end)));
                STRING
            }
            Ok(Raw::OpenChar) => {
                self.faults.push(fault::unterminated_character(self.span(start, end)));
                CHAR
            }
            Ok(Raw::Foreign) => {
                self.faults.push(fault::foreign_operator(self.span(start, end), text));
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
                self.faults.push(fault::unknown_character(self.span(start, end), text));
                ERROR
            }
        };
        self.push(kind, start);
    }

    fn word(&mut self, text: &str, start: usize) -> SyntaxKind {
        let kind = word::classify(text);
        match self.mode {
            Mode::AsmetaL => match kind {
                ASM_KW | MODULE_KW | INIT_KW => self.context = Context::Name,
                IMPORT_KW => self.context = Context::Path,
                _ => {}
            },
            Mode::Avalla => {
                if text == "load" && !self.path_seen && self.starts_header(start) {
                    self.path_seen = true;
                    self.context = Context::Path;
                }
            }
        }
        kind
    }

    /// `load` stands where a scenario's header has it: nothing but a name or two comes before.
    fn starts_header(&self, start: usize) -> bool {
        let before = self.tokens.iter().filter(|token| !token.kind.is_trivia()).take(3).count();
        start == 0 || before <= 2
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

    /// `1.5e3` is meant as a number with an exponent: says so and joins the two.
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
        self.faults.push(fault::exponent(span, &self.text[from..start + text.len()]));
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
                && !matches!(escaped, 'n' | 't' | 'b' | 'r' | 'f' | '\\' | '\'' | '"' | 'u' | '0'..='7')
            {
                let span = self.span(start + at, start + next + escaped.len_utf8());
                self.faults.push(fault::unknown_escape(span, escaped));
            }
        }
        kind
    }

    fn span(&self, start: usize, end: usize) -> Span {
        Span { file: self.file, start: start as u32, end: end as u32 }
    }

    fn push(&mut self, kind: SyntaxKind, start: usize) {
        self.tokens.push(Token { kind, start: start as u32 });
    }
}
