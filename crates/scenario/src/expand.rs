//! Blocks: each `execblock` is replaced by the commands of its block.
//!
//! In: the tree of a scenario and a [`Blocks`] that finds others. Out: commands that are neither blocks nor calls of
//! blocks, each with its file. A block is run where it is defined and again wherever it is called.

use std::collections::BTreeMap;

use syntax::ast::{AstNode, Block, Command, ExecBlockCommand, ScenarioFile};
use syntax::{Diagnostic, FileId, SourceFile, Sources, Span};

/// Finds another scenario of which blocks are called.
pub trait Blocks {
    /// The scenario `name` (without its extension), called from `importer`. The error is a sentence for the user.
    fn load(&mut self, importer: &SourceFile, name: &str) -> Result<SourceFile, String>;
}

/// A command and the file it is written in.
pub(crate) type Placed = (Command, FileId);

pub(crate) struct Expansion<'a> {
    pub sources: &'a mut Sources,
    pub blocks: &'a mut dyn Blocks,
    pub faults: Vec<Diagnostic>,
    files: BTreeMap<String, Option<(ScenarioFile, FileId)>>,
    /// The blocks being expanded, by file and name.
    open: Vec<(FileId, String)>,
    expanded: Vec<Placed>,
    /// Commands met so far.
    met: usize,
}

/// LIMIT: commands after expansion, so blocks that call blocks cannot grow without end.
const COMMANDS: usize = 100_000;

impl<'a> Expansion<'a> {
    pub fn new(sources: &'a mut Sources, blocks: &'a mut dyn Blocks) -> Self {
        Expansion {
            sources,
            blocks,
            faults: Vec::new(),
            files: BTreeMap::new(),
            open: Vec::new(),
            expanded: Vec::new(),
            met: 0,
        }
    }

    /// The commands of a scenario without blocks.
    pub fn expand(mut self, tree: &ScenarioFile, file: FileId) -> (Vec<Placed>, Vec<Diagnostic>) {
        self.report_doubles(tree, file);
        self.commands(tree.commands(), tree, file);
        (self.expanded, self.faults)
    }

    fn commands(&mut self, commands: impl Iterator<Item = Command>, tree: &ScenarioFile, file: FileId) {
        for command in commands {
            // Calls count, too: empty blocks could call each other for a very long time.
            self.met += 1;
            if self.met > COMMANDS {
                if self.met == COMMANDS + 1 {
                    let message = format!("blocks expand to more than {COMMANDS} commands");
                    self.faults.push(Diagnostic::error("too-many-commands", span(file, &command), message));
                }
                return;
            }
            match command {
                Command::Block(block) => {
                    let name = block.name().map(|name| name.text().to_string()).unwrap_or_default();
                    self.inside(file, name, span(file, &block), |this| this.commands(block.commands(), tree, file));
                }
                Command::ExecBlock(call) => self.call(&call, tree, file),
                other => self.expanded.push((other, file)),
            }
        }
    }

    fn call(&mut self, call: &ExecBlockCommand, tree: &ScenarioFile, file: FileId) {
        let (Some(name), place) = (call.block(), span(file, call)) else { return };
        let name = name.text().to_string();
        let found = match call.file() {
            None => find(tree, &name).map(|block| (block, tree.clone(), file)),
            Some(other) => match self.other(other.text(), file, place) {
                Some((tree, file)) => find(&tree, &name).map(|block| (block, tree, file)),
                None => return,
            },
        };
        match found {
            Some((block, tree, file)) => {
                self.inside(file, name, place, |this| this.commands(block.commands(), &tree, file));
            }
            None => {
                let fault = Diagnostic::error("unknown-block", place, format!("there is no block `{name}`"))
                    .with_help("a block is written `begin NAME … end`");
                self.faults.push(fault);
            }
        }
    }

    /// Another scenario, read once.
    fn other(&mut self, name: &str, importer: FileId, place: Span) -> Option<(ScenarioFile, FileId)> {
        if let Some(known) = self.files.get(name) {
            return known.clone();
        }
        let loaded = self.blocks.load(self.sources.file(importer), name);
        let found = match loaded {
            Ok(source) => {
                let (text, foreign) = (source.text.clone(), source.foreign);
                let file = self.sources.add(source);
                self.faults.extend(foreign.map(|foreign| foreign.warning(file)));
                let parsed = syntax::parse_avalla(file, &text);
                self.faults.extend(parsed.diagnostics.iter().cloned());
                let tree = ScenarioFile::cast(parsed.syntax())?;
                self.report_doubles(&tree, file);
                Some((tree, file))
            }
            Err(message) => {
                self.faults.push(Diagnostic::error("unknown-scenario", place, message));
                None
            }
        };
        self.files.insert(name.to_string(), found.clone());
        found
    }

    fn inside(&mut self, file: FileId, name: String, place: Span, expand: impl FnOnce(&mut Self)) {
        let block = (file, name);
        if self.open.contains(&block) {
            let message = format!("block `{}` calls itself", block.1);
            self.faults.push(Diagnostic::error("recursive-block", place, message));
            return;
        }
        self.open.push(block);
        expand(self);
        self.open.pop();
    }

    fn report_doubles(&mut self, tree: &ScenarioFile, file: FileId) {
        let mut seen: BTreeMap<String, Span> = BTreeMap::new();
        for block in all_blocks(tree) {
            let Some(name) = block.name() else { continue };
            let place = Span::new(file, name.text_range());
            if let Some(first) = seen.get(name.text()) {
                let fault =
                    Diagnostic::error("duplicate-block", place, format!("block `{}` is defined twice", name.text()))
                        .with_label(*first, "first here");
                self.faults.push(fault);
            } else {
                seen.insert(name.text().to_string(), place);
            }
        }
    }
}

fn span(file: FileId, node: &impl AstNode) -> Span {
    Span::new(file, node.range())
}

fn find(tree: &ScenarioFile, name: &str) -> Option<Block> {
    all_blocks(tree).into_iter().find(|block| block.name().is_some_and(|token| token.text() == name))
}

fn all_blocks(tree: &ScenarioFile) -> Vec<Block> {
    let mut found = Vec::new();
    let mut open: Vec<Command> = tree.commands().collect();
    open.reverse();
    while let Some(command) = open.pop() {
        if let Command::Block(block) = command {
            let mut inner: Vec<Command> = block.commands().collect();
            inner.reverse();
            open.extend(inner);
            found.push(block);
        }
    }
    found
}
