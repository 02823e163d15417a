//! The parser's machinery: a cursor over the tokens, the tree under construction, and the faults.
//!
//! In: a text and the grammar's start. Out: a [`Parse`]. The grammar (module `grammar`) decides; this file keeps the
//! books. INVARIANT: every token goes into the tree exactly once and in order, so the tree is lossless; a node never
//! starts or ends with trivia, except the root. At one token at most one fault is reported: what follows from it is no
//! news.
//!
//! LIMIT: [`MAX_NESTING`], [`MAX_CHAIN`], [`MAX_FAULTS`], [`MAX_TEXT_BYTES`].

use crate::fault::{self, Found};
use crate::lexer::{self, Mode, Token};
use crate::token_set::TokenSet;
use crate::{AsmetaL, Diagnostic, FileId, Parse, Span, SyntaxKind, SyntaxKind::*};
use rowan::{Checkpoint, GreenNodeBuilder, Language};

/// How many constructs may be nested in one another (parentheses, rules in rules, right operands …).
pub const MAX_NESTING: usize = 256;

/// The greatest height of the tree of one rule or term. A chain of left-associative operators (`a + b + …`) makes the
/// tree higher by one for each operator; so a chain has at most this many.
pub const MAX_CHAIN: usize = 1000;

/// How many faults of one file are reported.
pub const MAX_FAULTS: usize = 200;

/// The longest text that is read.
pub const MAX_TEXT_BYTES: usize = 1 << 30;

/// Parses a text from one start of the grammar.
pub(crate) fn parse(file: FileId, text: &str, mode: Mode, root: SyntaxKind, grammar: fn(&mut Parser<'_>)) -> Parse {
    let (tokens, faults) = lexer::tokenize(file, text, mode);
    let mut parser = Parser {
        file,
        text,
        tokens,
        at: 0,
        emitted: 0,
        builder: GreenNodeBuilder::new(),
        faults,
        fault_at: usize::MAX,
        open: Vec::new(),
        nesting_reported: false,
        depth: 0,
        deepest: 0,
        in_bag: false,
        in_scenario: false,
    };
    parser.skip_trivia();
    parser.builder.start_node(AsmetaL::kind_to_raw(root));
    grammar(&mut parser);
    parser.finish_root()
}

/// A construct that waits for its end.
#[derive(Debug, Clone, Copy)]
struct Open {
    /// The token that ends it.
    end: SyntaxKind,
    /// The token that opened it.
    opener: usize,
}

/// The state of one parse.
pub(crate) struct Parser<'t> {
    file: FileId,
    text: &'t str,
    tokens: Vec<Token>,
    /// The current token; never trivia.
    at: usize,
    /// The first token that is not in the tree yet.
    emitted: usize,
    builder: GreenNodeBuilder<'static>,
    faults: Vec<Diagnostic>,
    /// The token at which the last fault was reported.
    fault_at: usize,
    /// Constructs that wait for their end, innermost last.
    open: Vec<Open>,
    nesting_reported: bool,
    depth: usize,
    /// The greatest depth of the tree since the last [`Parser::take_deepest`].
    deepest: usize,
    /// A bare `>` closes the bag around.
    pub(crate) in_bag: bool,
    /// A scenario is read: `;` ends a command.
    pub(crate) in_scenario: bool,
}

/// Looking.
impl<'t> Parser<'t> {
    pub(crate) fn current(&self) -> SyntaxKind {
        self.tokens[self.at].kind
    }

    /// The kind of the `n`th significant token from here; the current one is 0.
    pub(crate) fn peek(&self, n: usize) -> SyntaxKind {
        self.tokens[self.peek_index(n)].kind
    }

    fn peek_index(&self, n: usize) -> usize {
        let mut at = self.at;
        for _ in 0..n {
            if self.tokens[at].kind == EOF {
                break;
            }
            at += 1;
            while self.tokens[at].kind.is_trivia() {
                at += 1;
            }
        }
        at
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

    pub(crate) fn token_text(&self) -> &'t str {
        self.text_of(self.at)
    }

    pub(crate) fn peek_text(&self, n: usize) -> &'t str {
        self.text_of(self.peek_index(n))
    }

    fn text_of(&self, at: usize) -> &'t str {
        let start = self.tokens[at].start as usize;
        let end = self.tokens.get(at + 1).map_or(self.text.len(), |next| next.start as usize);
        &self.text[start..end]
    }

    /// The current token and the next one touch.
    pub(crate) fn touches_next(&self) -> bool {
        self.tokens.get(self.at + 1).is_some_and(|next| !next.kind.is_trivia())
    }

    /// The current token is the first one on its line.
    pub(crate) fn on_new_line(&self) -> bool {
        let before = self.tokens[..self.at].iter().rposition(|token| !token.kind.is_trivia());
        let Some(before) = before else { return true };
        let end = self.tokens[before + 1].start as usize;
        self.text[end..self.tokens[self.at].start as usize].contains('\n')
    }

    /// How far the cursor has come.
    pub(crate) fn position(&self) -> usize {
        self.tokens[self.at].start as usize
    }

    /// The cursor is at the end of a command of a scenario, or of the file.
    pub(crate) fn ends_command(&self) -> bool {
        self.at(EOF) || self.in_scenario && self.at(SEMICOLON)
    }

    /// How many tokens stand between the cursor and a token of this kind on the same line.
    pub(crate) fn find_on_line(&self, kind: SyntaxKind) -> Option<usize> {
        let mut count = 0;
        for at in self.at..(self.at + 64).min(self.tokens.len()) {
            let here = self.tokens[at].kind;
            if here == kind {
                return Some(count);
            }
            if here.is_trivia() {
                if self.text_of(at).contains('\n') {
                    return None;
                }
            } else {
                count += 1;
            }
        }
        None
    }

    /// The column of a token that is the first one on its line, in bytes.
    fn indentation(&self, at: usize) -> Option<usize> {
        let start = self.tokens[at].start as usize;
        let line = self.text[..start].rfind('\n').map_or(0, |end| end + 1);
        self.text[line..start].chars().all(char::is_whitespace).then_some(start - line)
    }

    /// By the indentation the current token stands beside the innermost open construct, not in it.
    pub(crate) fn is_left_of_innermost(&self) -> bool {
        let opener = self.open.last().and_then(|open| self.indentation(open.opener));
        self.on_new_line() && opener.is_some_and(|opener| self.indentation(self.at).is_some_and(|here| here <= opener))
    }

    pub(crate) fn span(&self) -> Span {
        self.span_of(self.at)
    }

    fn span_of(&self, at: usize) -> Span {
        let start = self.tokens[at].start;
        Span { file: self.file, start, end: start + self.text_of(at).len() as u32 }
    }
}

/// Building.
impl Parser<'_> {
    fn skip_trivia(&mut self) {
        while self.tokens[self.at].kind.is_trivia() {
            self.at += 1;
        }
    }

    fn emit(&mut self, kind: SyntaxKind) {
        self.builder.token(AsmetaL::kind_to_raw(kind), self.text_of(self.emitted));
        self.emitted += 1;
    }

    fn emit_trivia(&mut self) {
        while self.emitted < self.at {
            self.emit(self.tokens[self.emitted].kind);
        }
    }

    pub(crate) fn start(&mut self, kind: SyntaxKind) {
        self.emit_trivia();
        self.builder.start_node(AsmetaL::kind_to_raw(kind));
    }

    pub(crate) fn checkpoint(&mut self) -> Checkpoint {
        self.emit_trivia();
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
        self.emit_trivia();
        self.emit(kind);
        self.at += 1;
        self.skip_trivia();
    }

    /// Takes the first byte of the current token as a token of its own; the rest becomes the current token.
    pub(crate) fn bump_split(&mut self, first: SyntaxKind, rest: SyntaxKind) {
        self.emit_trivia();
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

    fn finish_root(mut self) -> Parse {
        self.at = self.tokens.len() - 1;
        self.emit_trivia();
        self.builder.finish_node();
        let mut diagnostics = self.faults;
        diagnostics.sort_by_key(|fault| fault.primary.span.start);
        Parse { green: self.builder.finish(), diagnostics }
    }
}

/// Limits.
impl Parser<'_> {
    /// Goes one construct deeper; gives `false`, with a fault, when that is too deep.
    pub(crate) fn enter(&mut self) -> bool {
        self.depth += 1;
        self.deepest = self.deepest.max(self.depth);
        self.depth <= MAX_NESTING
    }

    pub(crate) fn leave(&mut self) {
        self.depth -= 1;
    }

    /// Starts to measure the depth of a subtree; the result goes back by [`Parser::restore_deepest`].
    pub(crate) fn take_deepest(&mut self) -> usize {
        std::mem::replace(&mut self.deepest, self.depth)
    }

    pub(crate) fn restore_deepest(&mut self, outside: usize) {
        self.deepest = self.deepest.max(outside);
    }

    /// The depth of the subtree if one more operator is put on top of it.
    pub(crate) fn lift_deepest(&mut self) -> usize {
        self.deepest += 1;
        self.deepest
    }
}

/// Ends of constructs.
impl<'t> Parser<'t> {
    /// Takes the token that opens a construct which `end` ends.
    pub(crate) fn bump_opener(&mut self, end: SyntaxKind) {
        self.open.push(Open { end, opener: self.at });
        self.bump();
    }

    /// Takes the token that opens a construct, a contextual keyword.
    pub(crate) fn bump_opener_as(&mut self, kind: SyntaxKind, end: SyntaxKind) {
        self.open.push(Open { end, opener: self.at });
        self.bump_as(kind);
    }

    /// Takes the first byte of the current token as the opener of a construct.
    pub(crate) fn split_opener(&mut self, first: SyntaxKind, rest: SyntaxKind, end: SyntaxKind) {
        self.open.push(Open { end, opener: self.at });
        self.bump_split(first, rest);
    }

    /// The innermost construct: its end, and the token that opened it.
    pub(crate) fn innermost(&self) -> Option<(SyntaxKind, Found<'t>)> {
        self.open.last().map(|open| (open.end, self.found_at(open.opener)))
    }

    pub(crate) fn close(&mut self) {
        self.open.pop();
    }

    /// A construct around waits for this end.
    pub(crate) fn is_awaited(&self, end: SyntaxKind) -> bool {
        self.open.iter().any(|open| open.end == end)
    }
}

/// Faults.
impl<'t> Parser<'t> {
    pub(crate) fn found(&self) -> Found<'t> {
        self.found_at(self.at)
    }

    fn found_at(&self, at: usize) -> Found<'t> {
        Found { span: self.span_of(at), kind: self.tokens[at].kind, text: self.text_of(at) }
    }

    /// Reports a fault at the current token, unless one stands there already.
    pub(crate) fn fault(&mut self, fault: Diagnostic) {
        let news = self.fault_at != self.at && !self.at(ERROR);
        self.fault_at = self.at;
        if news {
            self.faults.push(fault);
        }
    }

    /// Reports a fault that lies before the current token.
    pub(crate) fn fault_before(&mut self, fault: Diagnostic) {
        self.faults.push(fault);
    }

    /// Reports that something is nested too deeply, the first time.
    pub(crate) fn fault_once(&mut self, fault: Diagnostic) {
        if !std::mem::replace(&mut self.nesting_reported, true) {
            self.faults.push(fault);
        }
        self.fault_at = self.at;
    }

    /// Reports that a token is missing, at the end of what stands before.
    pub(crate) fn fault_missing(&mut self, kind: SyntaxKind, context: &str) {
        let found = self.found();
        let at = if self.on_new_line() { self.end_of_previous() } else { found.span };
        self.fault(fault::expected_token(found, at, kind, context));
    }

    fn end_of_previous(&self) -> Span {
        let before = self.tokens[..self.at].iter().rposition(|token| !token.kind.is_trivia());
        let at = before.map_or(0, |before| self.tokens[before + 1].start);
        Span { file: self.file, start: at, end: at }
    }

    pub(crate) fn expect(&mut self, kind: SyntaxKind, context: &str) -> bool {
        if self.eat(kind) {
            return true;
        }
        let found = self.found();
        self.fault(fault::expected_token(found, found.span, kind, context));
        false
    }
}
