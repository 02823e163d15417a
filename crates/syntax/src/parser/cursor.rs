//! Looking at the tokens around the cursor, and at their places in the lines.

use super::Parser;
use crate::fault::{self, Found};
use crate::token_set::TokenSet;
use crate::{Span, SyntaxKind, SyntaxKind::*};

impl<'t> Parser<'t> {
    /// The kind of the current token.
    ///
    /// # Panics
    ///
    /// When the grammar is stuck, which is a bug: it looks at the same token again and again.
    pub(crate) fn current(&self) -> SyntaxKind {
        let looks = self.looks.get() + 1;
        self.looks.set(looks);
        assert!(looks < 1_000_000, "the grammar is stuck at {}", self.position());
        self.tokens[self.at].kind
    }

    /// The kind of the `n`th token from here; the current one is 0.
    pub(crate) fn peek(&self, n: usize) -> SyntaxKind {
        let mut at = self.at;
        for _ in 0..n {
            if self.tokens[at].kind == EOF {
                break;
            }
            at += 1;
            while self.is_skipped(at) {
                at += 1;
            }
        }
        self.tokens[at].kind
    }

    pub(crate) fn at(&self, kind: SyntaxKind) -> bool {
        self.current() == kind
    }

    pub(crate) fn at_any(&self, set: TokenSet) -> bool {
        set.contains(self.current())
    }

    /// The current token is this name.
    pub(crate) fn at_word(&self, word: &str) -> bool {
        self.at(FUNCTION_ID) && self.token_text() == word
    }

    /// The next token is this name.
    pub(crate) fn is_word_next(&self, word: &str) -> bool {
        self.peek(1) == FUNCTION_ID && self.next_text() == word
    }

    /// The text of the next token.
    pub(crate) fn next_text(&self) -> &'t str {
        let mut at = (self.at + 1).min(self.tokens.len() - 1);
        while self.is_skipped(at) {
            at += 1;
        }
        self.text_of(at)
    }

    pub(crate) fn token_text(&self) -> &'t str {
        self.text_of(self.at)
    }

    /// The current token as a fault shows it.
    pub(crate) fn found(&self) -> Found<'t> {
        self.found_at(self.at)
    }

    pub(super) fn found_at(&self, at: usize) -> Found<'t> {
        Found { span: self.span_of(at), kind: self.tokens[at].kind, text: self.text_of(at) }
    }

    /// How far the cursor has come.
    pub(crate) fn position(&self) -> usize {
        self.tokens[self.at].start as usize
    }

    /// The cursor is at the end of a command of a scenario, or of the file.
    pub(crate) fn ends_command(&self) -> bool {
        self.at(EOF) || self.in_scenario && self.at(SEMICOLON)
    }

    /// The current token and the next one that the grammar sees touch.
    pub(crate) fn touches_next(&self) -> bool {
        self.at + 1 < self.tokens.len() && !self.is_skipped(self.at + 1)
    }

    /// The current token and the one before touch.
    pub(crate) fn touches_previous(&self) -> bool {
        self.at > 0 && !self.is_skipped(self.at - 1)
    }

    /// The current token is the first one on its line.
    pub(crate) fn on_new_line(&self) -> bool {
        let end = self.end_of_previous().start as usize;
        self.text[end..self.position()].contains('\n')
    }

    /// How many tokens stand between the cursor and a token of this kind on the same line.
    ///
    /// LIMIT: looks at most 64 tokens ahead, so a long faulty line takes linear time.
    pub(crate) fn find_on_line(&self, kind: SyntaxKind) -> Option<usize> {
        let mut count = 0;
        for at in self.at..(self.at + 64).min(self.tokens.len()) {
            if self.tokens[at].kind == kind {
                return Some(count);
            }
            if !self.is_skipped(at) {
                count += 1;
            } else if self.text_of(at).contains('\n') {
                return None;
            }
        }
        None
    }

    /// By its indentation, the current token stands beside the innermost open construct, not in it.
    pub(crate) fn is_left_of_innermost(&self) -> bool {
        let opener = self.open.last().and_then(|open| self.indentation(open.opener));
        let here = self.indentation(self.at);
        opener.is_some_and(|opener| here.is_some_and(|here| here <= opener))
    }

    /// The column of a token that is the first one on its line, in bytes.
    pub(super) fn indentation(&self, at: usize) -> Option<usize> {
        let start = self.tokens[at].start as usize;
        let space = if at == 0 { "" } else { self.text_of(at - 1) };
        let line = match space.rfind('\n') {
            Some(end) => space.len() - end - 1,
            None if start == space.len() => start,
            None => return None,
        };
        (at == 0 || self.tokens[at - 1].kind == WHITESPACE).then_some(line)
    }

    /// An empty span after the token before the current one.
    pub(super) fn end_of_previous(&self) -> Span {
        let mut at = self.at;
        while at > 0 && self.is_skipped(at - 1) {
            at -= 1;
        }
        let end = if at == 0 { 0 } else { self.tokens[at].start };
        Span { file: self.file, start: end, end }
    }

    pub(super) fn span_of(&self, at: usize) -> Span {
        let start = self.tokens[at].start;
        Span { file: self.file, start, end: start + self.text_of(at).len() as u32 }
    }

    pub(super) fn text_of(&self, at: usize) -> &'t str {
        let start = self.tokens[at].start as usize;
        let end = self.tokens.get(at + 1).map_or(self.text.len(), |next| next.start as usize);
        &self.text[start..end]
    }

    /// The grammar does not see this token: it is trivia, or a strange character, which the lexer has reported. It does
    /// see an operator of another language, so the operands stay together.
    pub(super) fn is_skipped(&self, at: usize) -> bool {
        let kind = self.tokens[at].kind;
        kind.is_trivia() || kind == ERROR && fault::replacement(self.text_of(at)).is_none()
    }

    pub(super) fn skip(&mut self) {
        while self.is_skipped(self.at) {
            self.at += 1;
        }
    }
}
