//! Reporting faults, each mistake once.

use super::Parser;
use crate::fault::{self, Found};
use crate::limit::MAX_FAULTS;
use crate::{Diagnostic, Span, SyntaxKind, SyntaxKind::*};

impl<'t> Parser<'t> {
    /// Reports a fault at the current token, unless it follows from a known one.
    pub(crate) fn fault(&mut self, fault: Diagnostic) {
        let news =
            self.fault_at != self.at && !self.at(ERROR) && !self.has_enough_faults() && !self.follows_lexical_fault();
        self.fault_at = self.at;
        if news {
            self.push_fault(fault);
        }
    }

    /// Reports a keyword at the cursor that is declared as a name, once for each word.
    pub(crate) fn keyword_as_name(&mut self, fault: Diagnostic) {
        let word = self.token_text();
        if !self.keywords.contains(&word) {
            self.fault(fault);
            self.keywords.push(word);
        }
        self.fault_at = self.at;
    }

    /// The current token, or one of the two before it, is a keyword that is declared as a name. So the text after it
    /// does not mean what it says.
    fn follows_keyword(&self) -> bool {
        let before = (0..=self.at).rev().filter(|at| !self.is_skipped(*at)).take(3);
        !self.keywords.is_empty() && before.into_iter().any(|at| self.keywords.contains(&self.text_of(at)))
    }

    /// Something new starts at the current token: a fault there is reported, even if one about the text before was
    /// reported there.
    pub(crate) fn starts_anew(&mut self) {
        self.fault_at = usize::MAX;
    }

    /// Reports a fault that lies before the current token.
    pub(crate) fn fault_before(&mut self, fault: Diagnostic) {
        self.push_fault(fault);
    }

    /// Reports that something is nested too deeply, the first time.
    pub(crate) fn fault_once(&mut self, fault: Diagnostic) {
        if !std::mem::replace(&mut self.nesting_reported, true) {
            self.push_fault(fault);
        }
        self.fault_at = self.at;
    }

    /// Takes a token that must stand here, or reports that it is missing.
    pub(crate) fn expect(&mut self, kind: SyntaxKind, context: &str) -> bool {
        if self.eat(kind) {
            return true;
        }
        self.fault(fault::expected_token(self.missing(), kind, context));
        false
    }

    /// The current token, as shown by a fault that reports something missing before it.
    pub(crate) fn missing(&self) -> Found<'t> {
        Found { span: self.missing_place(), ..self.found() }
    }

    /// Where something is missing: at the current token, or, if that is on a later line, after the one before.
    pub(crate) fn missing_place(&self) -> Span {
        if self.on_new_line() || self.at(EOF) { self.end_of_previous() } else { self.span_of(self.at) }
    }

    /// Something that the lexer has reported stands right before the current token: a strange character, or a string,
    /// character or comment without its end.
    fn follows_lexical_fault(&self) -> bool {
        let mut from = self.at;
        while from > 0 && self.is_skipped(from - 1) {
            from -= 1;
            if self.tokens[from].kind == ERROR {
                return true;
            }
        }
        let from = self.tokens[from.saturating_sub(1)].start;
        let until = self.tokens[self.at].start;
        let next = self.unterminated.partition_point(|start| *start < from);
        self.unterminated.get(next).is_some_and(|start| *start < until)
    }

    /// So many faults are known that no more are kept. (The lexer runs first, and keeps half as many.)
    pub(super) fn has_enough_faults(&self) -> bool {
        self.faults.len() > 2 * MAX_FAULTS
    }

    fn push_fault(&mut self, fault: Diagnostic) {
        self.confused |= self.follows_keyword();
        if !self.confused && !self.has_enough_faults() {
            self.faults.push(fault);
        }
    }
}
