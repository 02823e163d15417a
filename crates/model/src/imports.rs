//! Reads the root file and everything that it imports, each file once.
//!
//! In: the root text and a [`Loader`]. Out: [`Unit`]s, imported files before those that import them, the root last; a
//! built-in library counts as one file, wherever it is looked for (spec/standard-library.md). Each import leads to the
//! unit that it names, or, after a reported fault, to none. INVARIANT: no unit leads back to itself: an import that
//! would close a circle is a fault and leads nowhere.

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
    /// It is a built-in library, or a copy that is read in its place.
    pub(crate) library: bool,
    /// It has a fault so early that a declaration may be lost.
    pub(crate) broken: bool,
}

/// One import of a unit.
pub(crate) struct Import {
    /// As written.
    pub(crate) clause: ast::Import,
    /// The index of the unit imported.
    pub(crate) target: Option<usize>,
}

/// Reads all files; returns the units in the order in which they must be checked.
pub(crate) fn read(root: SourceFile, loader: &mut dyn Loader, sources: &mut Sources, faults: &mut Faults) -> Vec<Unit> {
    let mut reader = Reader { loader, sources, faults, seen: BTreeMap::new(), open: Vec::new(), units: Vec::new() };
    let (identity, library) = (identity(&root.name), library::is_library(&root.name));
    reader.read(root, identity, library);
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
    fn read(&mut self, source: SourceFile, identity: String, library: bool) -> Option<usize> {
        self.seen.insert(identity.clone(), None);
        self.open.push((identity.clone(), source.name.clone()));
        let file = self.sources.add(source.clone());
        let parse = self.loader.parse(file, &source);
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
        self.units.push(Unit { file, tree: tree?, imports, library, broken });
        self.seen.insert(identity, Some(unit));
        Some(unit)
    }

    fn follow(&mut self, importer: &SourceFile, file: FileId, clause: &ast::Import) -> Option<usize> {
        let span = Span::new(file, clause.path_token()?.text_range());
        let path = clause.path()?;
        if let Some(built_in) = library::find(&path) {
            let name = library::stem(&built_in.name).to_string();
            if library::stem(&path) != name {
                self.faults.push(fault::import::library_path(span, library::stem(&path), &name));
            }
            // A model has each library once, whatever folder it is looked for in.
            let identity = identity(&built_in.name);
            if let Some(Some(unit)) = self.seen.get(&identity) {
                return Some(*unit);
            }
            let source = self.library(importer, &path, span, built_in);
            return self.read(source, identity, true);
        }
        let source = match self.loader.load(importer, &path) {
            Ok(source) => source,
            Err(reason) => {
                self.faults.push(fault::import::not_found(span, &path, &reason));
                return None;
            }
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
            None => {
                let library = library::is_library(&source.name);
                self.read(source, identity, library)
            }
        }
    }

    /// The library itself, or the copy that stands where the import says, if a copy can be read in its place.
    fn library(&mut self, importer: &SourceFile, path: &str, span: Span, built_in: SourceFile) -> SourceFile {
        let Ok(copy) = self.loader.load(importer, path) else { return built_in };
        if library::is_all_text(&built_in.name) {
            return copy;
        }
        let names = library::missing(&copy, &built_in);
        if !names.is_empty() {
            self.faults.push(fault::import::library_copy(span, &copy.name, &names));
        }
        built_in
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
