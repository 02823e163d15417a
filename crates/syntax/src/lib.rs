//! Text → lossless tree.
//!
//! In: the text of one file. Out: a [`Parse`]: a lossless tree (every byte of the text is in it), and the
//! faults found on the way. Parsing never fails, never panics, and knows no second file; the tree holds no
//! semantic facts. Later stages read the tree through the typed views of [`ast`] only.
//!
//! The grammar is that of `spec/language.md` (AsmetaL), `spec/avalla.md` (scenarios) and `spec/charts.md`.

pub mod ast;
pub mod diagnostic;
pub mod kind;
pub mod source;

mod dump;
mod encoding;
mod fault;
mod format;
mod grammar;
mod invariant;
mod lexer;
mod limit;
mod parser;
mod span;
mod stop;
mod token_set;

pub use diagnostic::{Diagnostic, Label, Severity};
pub use dump::dump;
pub use encoding::{Foreign, NotText};
pub use fault::IDS as FAULT_IDS;
pub use format::format;
pub use invariant::{assert_invariants, differ_in_layout_only};
pub use kind::{AsmetaL, SyntaxKind};
pub use limit::{MAX_CHAIN, MAX_COMPOSITES, MAX_FAULTS, MAX_NESTING, MAX_TEXT_BYTES};
pub use source::{LineColumn, SourceFile, Sources};
pub use span::{FileId, Span};
pub use stop::Stop;

use lexer::Mode;

/// An untyped node of the lossless tree.
pub type SyntaxNode = rowan::SyntaxNode<AsmetaL>;
/// A token of the lossless tree.
pub type SyntaxToken = rowan::SyntaxToken<AsmetaL>;

/// A node or a token of the lossless tree.
pub type SyntaxElement = rowan::SyntaxElement<AsmetaL>;

/// What parsing one file gives: always a tree, and the faults found.
#[derive(Debug, Clone)]
pub struct Parse {
    green: rowan::GreenNode,
    /// Faults in the order of their position.
    pub diagnostics: Vec<Diagnostic>,
}

impl Parse {
    /// The root of the tree: a [`SyntaxKind::SOURCE_FILE`], [`SyntaxKind::SCENARIO_FILE`] or
    /// [`SyntaxKind::CHART_FILE`].
    pub fn syntax(&self) -> SyntaxNode {
        SyntaxNode::new_root(self.green.clone())
    }

    /// The same of another file with the same text.
    #[must_use]
    pub fn in_file(mut self, file: FileId) -> Parse {
        for fault in &mut self.diagnostics {
            fault.primary.span.file = file;
            fault.secondary.iter_mut().for_each(|label| label.span.file = file);
        }
        self
    }
}

/// Parses a file of AsmetaL (`.asm`).
pub fn parse_asmetal(file: FileId, text: &str) -> Parse {
    parser::parse(file, text, Mode::AsmetaL, SyntaxKind::SOURCE_FILE, grammar::source_file)
}

/// Parses a file of AsmetaL unless that is stopped: then the text is one token, unread.
pub fn parse_asmetal_unless(stop: &Stop, file: FileId, text: &str) -> Parse {
    parser::parse_unless(stop, file, text, Mode::AsmetaL, SyntaxKind::SOURCE_FILE, grammar::source_file)
}

/// Parses a scenario file (`.avalla`).
pub fn parse_avalla(file: FileId, text: &str) -> Parse {
    parser::parse(file, text, Mode::Avalla, SyntaxKind::SCENARIO_FILE, grammar::scenario_file)
}

/// Parses a chart file (`.chart`).
pub fn parse_chart(file: FileId, text: &str) -> Parse {
    parser::parse(file, text, Mode::Chart, SyntaxKind::CHART_FILE, grammar::chart_file)
}

/// Parses a single term, as written on a command line (`--until TERM`).
pub fn parse_term(file: FileId, text: &str) -> Parse {
    parser::parse(file, text, Mode::AsmetaL, SyntaxKind::TERM_FILE, grammar::term_file)
}
