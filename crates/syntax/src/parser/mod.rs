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
use crate::{AsmetaL, Diagnostic, FileId, Parse, Span, SyntaxKind, SyntaxKind::*};
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
}

/// Parses a text from one start of the grammar.
pub(crate) fn parse(file: FileId, text: &str, mode: Mode, root: SyntaxKind, grammar: fn(&mut Parser<'_>)) -> Parse {
    if text.len() > MAX_TEXT_BYTES {
        return too_large(file, text, root);
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
    };
    parser.skip();
    grammar(&mut parser);
    parser.finish_root(root)
}

/// A text beyond the limit is one token, unread.
fn too_large(file: FileId, text: &str, root: SyntaxKind) -> Parse {
    let mut builder = GreenNodeBuilder::new();
    builder.start_node(AsmetaL::kind_to_raw(root));
    // A token's length is 32 bits wide; beyond that not even the tree can hold the text.
    if u32::try_from(text.len()).is_ok() {
        builder.token(AsmetaL::kind_to_raw(ERROR), text);
    }
    builder.finish_node();
    let fault = fault::file_too_large(Span { file, start: 0, end: 0 }, text.len());
    Parse { green: builder.finish(), diagnostics: vec![fault] }
}
