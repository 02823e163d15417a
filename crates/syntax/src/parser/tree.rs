//! Building the tree: nodes are opened and finished, tokens are taken into the innermost open one.

use super::{MAX_FAULTS, Parser};
use crate::fault;
use crate::lexer::Token;
use crate::{AsmetaL, Parse, SyntaxKind, SyntaxKind::*};
use rowan::{Checkpoint, Language};

impl Parser<'_> {
    pub(crate) fn start(&mut self, kind: SyntaxKind) {
        self.emit_skipped();
        self.builder.start_node(AsmetaL::kind_to_raw(kind));
    }

    /// A place at which a node can be opened later, by [`Parser::start_at`].
    pub(crate) fn checkpoint(&mut self) -> Checkpoint {
        self.emit_skipped();
        self.builder.checkpoint()
    }

    pub(crate) fn start_at(&mut self, checkpoint: Checkpoint, kind: SyntaxKind) {
        self.builder.start_node_at(checkpoint, AsmetaL::kind_to_raw(kind));
    }

    pub(crate) fn finish(&mut self) {
        self.builder.finish_node();
    }

    pub(crate) fn bump(&mut self) {
        self.bump_as(self.current());
    }

    /// Takes the current token as one of another kind: a contextual keyword, a name of the wrong class.
    pub(crate) fn bump_as(&mut self, kind: SyntaxKind) {
        if self.at(EOF) {
            return;
        }
        self.emit_skipped();
        self.emit(kind);
        self.at += 1;
        self.skip();
    }

    /// Takes the first byte of the current token as a token of its own; the rest becomes the current token.
    pub(crate) fn bump_split(&mut self, first: SyntaxKind, rest: SyntaxKind) {
        self.emit_skipped();
        let start = self.tokens[self.at].start as usize;
        self.builder.token(AsmetaL::kind_to_raw(first), &self.text[start..start + 1]);
        self.tokens[self.at] = Token { kind: rest, start: start as u32 + 1 };
    }

    pub(crate) fn eat(&mut self, kind: SyntaxKind) -> bool {
        let here = self.at(kind);
        if here {
            self.bump();
        }
        here
    }

    fn emit(&mut self, kind: SyntaxKind) {
        self.builder.token(AsmetaL::kind_to_raw(kind), self.text_of(self.emitted));
        self.emitted += 1;
    }

    fn emit_skipped(&mut self) {
        while self.emitted < self.at {
            self.emit(self.tokens[self.emitted].kind);
        }
    }

    pub(super) fn finish_root(mut self) -> Parse {
        self.at = self.tokens.len() - 1;
        self.emit_skipped();
        self.builder.finish_node();
        let mut diagnostics = self.faults;
        diagnostics.sort_by_key(|fault| fault.primary.span.start);
        if diagnostics.len() > MAX_FAULTS {
            let next = diagnostics[MAX_FAULTS].primary.span;
            diagnostics.truncate(MAX_FAULTS);
            diagnostics.push(fault::too_many_faults(next));
        }
        Parse { green: self.builder.finish(), diagnostics }
    }
}
