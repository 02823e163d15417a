//! The parser's machinery: a cursor over the tokens, the tree under construction, and the faults.
//!
//! In: a text and the grammar's start. Out: a [`Parse`]. The grammar (module `grammar`) decides; this module keeps the
//! books. INVARIANT: every token goes into the tree exactly once and in order, so the tree is lossless; no node but the
//! root starts or ends with trivia. At most one fault is reported at a token; faults that follow from it are not.
//!
//! LIMIT: those of [`crate::limit`].

mod cursor;
mod nesting;
mod report;
mod tree;

use crate::fault;
use crate::lexer::{self, Mode, Token};
use crate::limit::MAX_TEXT_BYTES;
use crate::{AsmetaL, Diagnostic, FileId, Parse, Span, Stop, SyntaxKind, SyntaxKind::*};
use nesting::Open;
use rowan::{GreenNodeBuilder, Language};
use std::cell::Cell;
use tree::{Event, Wrap};

/// What surrounds a term, as far as that changes its operators.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Within {
    /// Parentheses, keywords or nothing.
    Plain,
    /// A bag, which a bare `>` closes.
    Bag,
    /// Braces, where `->` stands between a key and its value.
    Braces,
    /// The bindings of a `let`, after which `in` stands.
    Bindings,
}

/// The state of one parse.
pub(crate) struct Parser<'t> {
    file: FileId,
    text: &'t str,
    tokens: Vec<Token>,
    /// The current token; never a skipped one.
    at: usize,
    events: Vec<Event>,
    wraps: Vec<Wrap>,

    faults: Vec<Diagnostic>,
    /// The token at which the last fault was reported.
    fault_at: usize,
    /// Starts of tokens that the lexer found without their end; faults right after them are not reported again.
    unterminated: Vec<u32>,

    /// Constructs that wait for their end, innermost last.
    open: Vec<Open<'t>>,
    /// Constructs whose end is not below their beginning.
    crooked: Vec<Open<'t>>,
    nesting_reported: bool,
    /// Keywords that are declared as names.
    keywords: Vec<&'t str>,
    /// One of these was used, and read as the keyword that it is. Faults after it follow from that.
    confused: bool,
    depth: usize,
    /// The greatest depth of the tree since the last [`Parser::take_deepest`].
    deepest: usize,

    /// How often the current token was looked at.
    looks: Cell<u32>,
    /// What surrounds a term, as far as that changes its operators.
    pub(crate) within: Within,
    /// A scenario is read: `;` ends a command.
    pub(crate) in_scenario: bool,
    /// Looked at every [`LOOK`] tokens.
    stop: Stop,
    /// The rest of the tokens is not read, and what was made of the others is thrown away.
    is_stopped: bool,
}

/// So many tokens are read between two looks at [`Parser::stop`].
const LOOK: usize = 4096;

/// Parses a text from one start of the grammar.
pub(crate) fn parse(file: FileId, text: &str, mode: Mode, root: SyntaxKind, grammar: fn(&mut Parser<'_>)) -> Parse {
    parse_unless(&Stop::default(), file, text, mode, root, grammar)
}

/// The same unless it is stopped: then the text is one token, unread.
pub(crate) fn parse_unless(
    stop: &Stop,
    file: FileId,
    text: &str,
    mode: Mode,
    root: SyntaxKind,
    grammar: fn(&mut Parser<'_>),
) -> Parse {
    if text.len() > MAX_TEXT_BYTES {
        let fault = fault::file_too_large(Span { file, start: 0, end: 0 }, text.len());
        return unread(text, root, vec![fault]);
    }
    if stop.is_asked() {
        return unread(text, root, Vec::new());
    }
    let lexed = lexer::tokenize(file, text, mode);
    let mut parser = Parser {
        file,
        text,
        tokens: lexed.tokens,
        at: 0,
        events: Vec::new(),
        wraps: Vec::new(),
        faults: lexed.faults,
        fault_at: usize::MAX,
        unterminated: lexed.unterminated,
        open: Vec::new(),
        crooked: Vec::new(),
        nesting_reported: false,
        keywords: Vec::new(),
        confused: false,
        depth: 0,
        deepest: 0,
        looks: Cell::new(0),
        within: Within::Plain,
        in_scenario: mode == Mode::Avalla,
        stop: stop.clone(),
        is_stopped: false,
    };
    parser.skip();
    grammar(&mut parser);
    if parser.is_stopped {
        return unread(text, root, Vec::new());
    }
    parser.finish_root(root)
}

/// The text as one token.
fn unread(text: &str, root: SyntaxKind, diagnostics: Vec<Diagnostic>) -> Parse {
    let mut builder = GreenNodeBuilder::new();
    builder.start_node(AsmetaL::kind_to_raw(root));
    // A token's length is 32 bits wide; beyond that not even the tree can hold the text.
    if u32::try_from(text.len()).is_ok() {
        builder.token(AsmetaL::kind_to_raw(ERROR), text);
    }
    builder.finish_node();
    Parse { green: builder.finish(), diagnostics }
}
