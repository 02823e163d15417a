//! The grammar's folder, its parser, and the repository's texts in the three languages.
//!
//! In: nothing. Out: texts with their names and kinds, trees of both parsers.

use std::path::PathBuf;

use syntax::{FileId, Parse, Severity};
use testkit::{Page, repository};
use tree_sitter::{Language, Node, Parser, Tree};

/// Which language a text is in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    Model,
    Scenario,
    Chart,
}

/// A text of the repository.
#[derive(Debug, Clone)]
pub struct Source {
    pub name: String,
    pub kind: Kind,
    pub text: String,
}

/// Folders with models, scenarios and charts.
const FOLDERS: [&str; 6] =
    ["library", "examples", "bench/models", "cpp/systems", "crates/syntax/tests", "shells/cli/tests"];

/// Where the grammar lies.
pub fn folder() -> PathBuf {
    repository::root().join("editors/tree-sitter-asmetal")
}

/// A text beside the grammar.
pub fn text(path: &str) -> String {
    repository::text(folder().join(path))
}

pub fn language() -> Language {
    tree_sitter_asmetal::LANGUAGE.into()
}

/// The tree of the generated parser.
pub fn tree(text: &str) -> Tree {
    let mut parser = Parser::new();
    parser.set_language(&language()).expect("an ABI that the library knows");
    parser.parse(text, None).expect("a tree")
}

impl Source {
    /// What Groundstate's own parser makes of it.
    pub fn parse(&self) -> Parse {
        match self.kind {
            Kind::Model => syntax::parse_asmetal(FileId(0), &self.text),
            Kind::Scenario => syntax::parse_avalla(FileId(0), &self.text),
            Kind::Chart => syntax::parse_chart(FileId(0), &self.text),
        }
    }

    /// Whether Groundstate's own parser has no fault to tell.
    pub fn is_clean(&self) -> bool {
        !self.parse().diagnostics.iter().any(|fault| fault.severity == Severity::Error)
    }
}

/// Every file of the repository, every fenced model, scenario and chart of `spec` that begins a file, and the corpus.
pub fn sources() -> Vec<Source> {
    let mut sources: Vec<Source> = corpus().into_iter().map(|(source, _)| source).collect();
    for path in FOLDERS.iter().flat_map(|folder| repository::files(folder, &["asm", "avalla", "chart"])) {
        let kind = match path.extension().and_then(|ending| ending.to_str()) {
            Some("avalla") => Kind::Scenario,
            Some("chart") => Kind::Chart,
            _ => Kind::Model,
        };
        let name = path.strip_prefix(repository::root()).unwrap_or(&path).display().to_string();
        // Two are there to be no UTF-8.
        let bytes = std::fs::read(&path).unwrap_or_else(|error| panic!("{name}: {error}"));
        let Ok(text) = String::from_utf8(bytes) else { continue };
        sources.push(Source { name, kind, text });
    }
    for path in repository::files("spec", &["md"]) {
        let page = Page::read(&path.display().to_string());
        for block in page.blocks() {
            let kind = match block.info.split(' ').next() {
                Some("asmetal") => Kind::Model,
                Some("avalla") => Kind::Scenario,
                Some("chart") => Kind::Chart,
                _ => continue,
            };
            let head = block.text.split_whitespace().find(|word| !word.starts_with('/')).unwrap_or_default();
            if ["asm", "module", "asyncr", "scenario", "chart"].contains(&head) {
                let name =
                    format!("{}:{}", path.strip_prefix(repository::root()).unwrap_or(&path).display(), block.line);
                sources.push(Source { name, kind, text: block.text.to_string() });
            }
        }
    }
    sources
}

/// The texts of the corpus and their trees, in tree-sitter's format: a title between lines of `=`, a text, a line of `---`, a tree.
pub fn corpus() -> Vec<(Source, String)> {
    let mut cases = Vec::new();
    for path in repository::files(folder().join("test/corpus"), &["txt"]) {
        let page = repository::text(&path);
        let parts: Vec<&str> = page.split("==================\n").skip(1).collect();
        assert!(parts.len().is_multiple_of(2), "{}: a title without a text", path.display());
        for case in parts.chunks(2) {
            let (text, tree) = case[1].split_once("\n---\n").expect("a line of `---` behind the text");
            let kind = if text.starts_with("chart ") {
                Kind::Chart
            } else if text.starts_with("scenario ") {
                Kind::Scenario
            } else {
                Kind::Model
            };
            let name = format!("{} in the corpus", case[0].trim());
            cases.push((Source { name, kind, text: text.to_string() }, tree.to_string()));
        }
    }
    cases
}

/// Every node of a tree, with those that have no name, parents first.
pub fn nodes(tree: &Tree) -> Vec<Node<'_>> {
    let mut found = Vec::new();
    let mut open = vec![tree.root_node()];
    while let Some(node) = open.pop() {
        found.push(node);
        open.extend((0..node.child_count()).rev().filter_map(|index| node.child(index)));
    }
    found
}

/// The first place that the generated parser could not read.
pub fn first_error(tree: &Tree) -> Option<String> {
    let node = nodes(tree).into_iter().find(|node| node.is_error() || node.is_missing())?;
    let what = if node.is_missing() { format!("`{}` is missing", node.kind()) } else { "an error".to_string() };
    Some(format!("{what} at line {}", node.start_position().row + 1))
}
