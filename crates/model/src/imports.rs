//! Reads the root file and all that it imports, each once.
//!
//! In: the root text and a [`Loader`]. Out: [`Unit`]s, imported files before those that import them, the root last;
//! each import leads to the unit it names, or to none after a reported fault. INVARIANT: no unit leads back to itself:
//! an import that would close a circle is a fault and leads nowhere.

use std::collections::BTreeMap;

use syntax::ast::{self, AstNode};
use syntax::{FileId, Severity, SourceFile, Sources, Span};

use crate::fault::{self, Faults};
use crate::library;
use crate::model::Loader;

/// One file read and parsed.
pub(crate) struct Unit {
    /// The file.
    pub(crate) file: FileId,
    /// Its tree.
    pub(crate) tree: ast::SourceFile,
    /// Its imports in order.
    pub(crate) imports: Vec<Import>,
    /// It is a built-in library.
    pub(crate) library: bool,
    /// A fault stands in it so early that a declaration may be lost.
    pub(crate) broken: bool,
}

/// One import of a unit.
pub(crate) struct Import {
    /// As written.
    pub(crate) clause: ast::Import,
    /// The index of the unit imported.
    pub(crate) target: Option<usize>,
}

/// Reads everything; the units stand in the order in which they are to be checked.
pub(crate) fn read(root: SourceFile, loader: &mut dyn Loader, sources: &mut Sources, faults: &mut Faults) -> Vec<Unit> {
    let mut reader = Reader { loader, sources, faults, seen: BTreeMap::new(), open: Vec::new(), units: Vec::new() };
    reader.read(root);
    reader.units
}

struct Reader<'a> {
    loader: &'a mut dyn Loader,
    sources: &'a mut Sources,
    faults: &'a mut Faults,
    /// The unit of each file; none while it is being read.
    seen: BTreeMap<String, Option<usize>>,
    /// The files being read, the innermost last.
    open: Vec<(String, String)>,
    units: Vec<Unit>,
}

impl Reader<'_> {
    fn read(&mut self, source: SourceFile) -> Option<usize> {
        let (name, identity) = (source.name.clone(), identity(&source.name));
        self.seen.insert(identity.clone(), None);
        self.open.push((identity.clone(), name.clone()));
        let file = self.sources.add(source.clone());
        let parse = syntax::parse_asmetal(file, &source.text);
        let tree = ast::SourceFile::cast(parse.syntax());
        let header_end = tree.as_ref().and_then(|tree| tree.definitions()).map(|node| node.range().start());
        let broken = parse.diagnostics.iter().any(|fault| {
            fault.severity == Severity::Error && header_end.is_none_or(|end| fault.primary.span.start <= u32::from(end))
        });
        self.faults.extend(source.foreign.map(|foreign| foreign.warning(file)));
        self.faults.extend(parse.diagnostics);

        let mut imports = Vec::new();
        for clause in tree.iter().flat_map(|tree| tree.imports()) {
            let target = stacker::maybe_grow(64 * 1024, 1024 * 1024, || self.follow(&source, file, &clause));
            imports.push(Import { clause, target });
        }
        self.open.pop();
        let unit = self.units.len();
        self.units.push(Unit { file, tree: tree?, imports, library: library::is_library(&name), broken });
        self.seen.insert(identity, Some(unit));
        Some(unit)
    }

    fn follow(&mut self, importer: &SourceFile, file: FileId, clause: &ast::Import) -> Option<usize> {
        let span = Span::new(file, clause.path_token()?.text_range());
        let path = clause.path()?;
        let source = match library::find(&path) {
            Some(library) => {
                let name = library::stem(&library.name).to_string();
                if library::stem(&path) != name {
                    self.faults.push(fault::import::library_path(span, library::stem(&path), &name));
                }
                library
            }
            None => match self.loader.load(importer, &path) {
                Ok(source) => source,
                Err(reason) => {
                    self.faults.push(fault::import::not_found(span, &path, &reason));
                    return None;
                }
            },
        };
        let identity = identity(&source.name);
        match self.seen.get(&identity) {
            Some(Some(unit)) => Some(*unit),
            Some(None) => {
                let start = self.open.iter().position(|(open, _)| *open == identity).unwrap_or(0);
                let mut cycle: Vec<String> = self.open[start..].iter().map(|(_, name)| name.clone()).collect();
                cycle.push(source.name);
                self.faults.push(fault::import::circular(span, &cycle));
                None
            }
            None => self.read(source),
        }
    }
}

/// A file's name with `.`, `..` and backslashes resolved, so that two routes to a file are seen to be the same.
fn identity(name: &str) -> String {
    let mut parts: Vec<&str> = Vec::new();
    for part in name.split(['/', '\\']) {
        match part {
            "." => {}
            ".." if parts.last().is_some_and(|last| *last != ".." && !last.is_empty()) => {
                parts.pop();
            }
            _ => parts.push(part),
        }
    }
    parts.join("/")
}

#[cfg(test)]
mod tests {
    use super::identity;

    #[test]
    fn one_file_has_one_identity() {
        assert_eq!(identity("a/b/../c.asm"), identity("./a/c.asm"));
        assert_eq!(identity("..\\x.asm"), "../x.asm");
    }
}
