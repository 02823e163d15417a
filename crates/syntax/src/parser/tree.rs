//! Building the tree. The grammar opens and finishes nodes and takes tokens. All of that is noted as events, which are
//! made into the tree at the end.
//!
//! INVARIANT: a node starts right before its first token and ends right after its last one. So trivia and skipped
//! characters lie outside the nodes that they separate, and a node without tokens is never made.

use super::{LOOK, Parser};
use crate::fault;
use crate::lexer::Token;
use crate::limit::MAX_FAULTS;
use crate::{AsmetaL, Parse, SyntaxKind, SyntaxKind::*};
use rowan::{GreenNodeBuilder, Language};

/// What the grammar did.
#[derive(Debug, Clone, Copy)]
pub(super) enum Event {
    /// Opened a node.
    Start(SyntaxKind),
    /// Marked a place where nodes may be opened later: the outermost of them, by its index in the wraps.
    Checkpoint(Option<u32>),
    /// Finished the innermost node.
    Finish,
    /// Took a token, as one of this kind.
    Token(SyntaxKind, u32),
    /// Took two tokens that touch, as one of this kind.
    Joined(SyntaxKind, u32),
}

/// A node that was opened at a checkpoint.
#[derive(Debug, Clone, Copy)]
pub(super) struct Wrap {
    kind: SyntaxKind,
    /// The node within, opened earlier at the same checkpoint.
    within: Option<u32>,
}

/// A place at which nodes can be opened later: the index of its event.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Checkpoint(usize);

impl Parser<'_> {
    pub(crate) fn start(&mut self, kind: SyntaxKind) {
        self.events.push(Event::Start(kind));
    }

    pub(crate) fn checkpoint(&mut self) -> Checkpoint {
        self.events.push(Event::Checkpoint(None));
        Checkpoint(self.events.len() - 1)
    }

    /// Opens a node at a checkpoint, around everything read since and around the nodes opened there before.
    pub(crate) fn start_at(&mut self, checkpoint: Checkpoint, kind: SyntaxKind) {
        if let Event::Checkpoint(outermost) = &mut self.events[checkpoint.0] {
            self.wraps.push(Wrap { kind, within: *outermost });
            *outermost = Some(self.wraps.len() as u32 - 1);
        }
    }

    pub(crate) fn finish(&mut self) {
        self.events.push(Event::Finish);
    }

    pub(crate) fn bump(&mut self) {
        self.bump_as(self.current());
    }

    /// Takes the current token as one of another kind: a contextual keyword, a name of the wrong class.
    pub(crate) fn bump_as(&mut self, kind: SyntaxKind) {
        if !self.at(EOF) {
            self.events.push(Event::Token(kind, self.at as u32));
            let before = self.at;
            self.at += 1;
            self.looks.set(0);
            self.skip();
            if before / LOOK != self.at / LOOK && self.stop.is_asked() {
                // The grammar sees the end of the text, and comes to its own.
                self.is_stopped = true;
                self.tokens.truncate(self.at + 1);
                self.tokens[self.at].kind = EOF;
            }
        }
    }

    /// Takes the current token and the next one, which touches it, as one of this kind.
    pub(crate) fn bump_joined(&mut self, kind: SyntaxKind) {
        self.events.push(Event::Joined(kind, self.at as u32));
        self.at += 2;
        self.looks.set(0);
        self.skip();
    }

    pub(crate) fn eat(&mut self, kind: SyntaxKind) -> bool {
        let here = self.at(kind);
        if here {
            self.bump();
        }
        here
    }

    /// Makes the tree, and the faults in order.
    pub(super) fn finish_root(self, root: SyntaxKind) -> Parse {
        let mut diagnostics = self.faults;
        diagnostics.sort_by_key(|fault| fault.primary.span.start);
        if diagnostics.len() > MAX_FAULTS {
            let next = diagnostics[MAX_FAULTS].primary.span;
            diagnostics.truncate(MAX_FAULTS);
            diagnostics.push(fault::too_many_faults(next));
        }
        let mut builder = Builder {
            text: self.text,
            tokens: &self.tokens,
            token: 0,
            green: GreenNodeBuilder::new(),
            waiting: Vec::new(),
        };
        builder.green.start_node(AsmetaL::kind_to_raw(root));
        for event in &self.events {
            builder.event(*event, &self.wraps);
        }
        builder.go_to(self.tokens.len() - 1);
        builder.green.finish_node();
        Parse { green: builder.green.finish(), diagnostics }
    }
}

/// Makes the tree from the events.
struct Builder<'t> {
    text: &'t str,
    tokens: &'t [Token],
    /// The next token.
    token: usize,
    green: GreenNodeBuilder<'static>,
    /// Nodes that are open but have no token yet, outermost first.
    waiting: Vec<SyntaxKind>,
}

impl Builder<'_> {
    fn event(&mut self, event: Event, wraps: &[Wrap]) {
        match event {
            Event::Start(kind) => self.waiting.push(kind),
            Event::Checkpoint(mut next) => {
                while let Some(index) = next {
                    let wrap = wraps[index as usize];
                    self.waiting.push(wrap.kind);
                    next = wrap.within;
                }
            }
            Event::Finish => {
                if self.waiting.pop().is_none() {
                    self.green.finish_node();
                }
            }
            Event::Token(kind, index) => self.tokens(kind, index as usize, 1),
            Event::Joined(kind, index) => self.tokens(kind, index as usize, 2),
        }
    }

    /// Before a token: what was skipped goes into the enclosing node, then the nodes that wait for a token start.
    fn go_to(&mut self, index: usize) {
        while self.token < index {
            self.emit(self.tokens[self.token].kind, 1);
        }
        for kind in self.waiting.drain(..) {
            self.green.start_node(AsmetaL::kind_to_raw(kind));
        }
    }

    /// This many tokens, as one of this kind.
    fn tokens(&mut self, kind: SyntaxKind, index: usize, count: usize) {
        self.go_to(index);
        self.emit(kind, count);
    }

    fn emit(&mut self, kind: SyntaxKind, count: usize) {
        let start = self.tokens[self.token].start as usize;
        self.token += count;
        let end = self.tokens[self.token].start as usize;
        self.green.token(AsmetaL::kind_to_raw(kind), &self.text[start..end]);
    }
}
