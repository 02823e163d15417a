//! The built-in libraries: their texts, and how an import finds them.
//!
//! In: the path of an import. Out: the text, shown under `<std>/NAME.asm`. A library is known by the file name at
//! the end of the path, whatever folder stands before it. What a copy of it declares can be compared
//! (spec/standard-library.md).

use std::collections::BTreeSet;

use syntax::ast::{self, AstNode};
use syntax::{FileId, SourceFile};

use crate::model::PropertyKind;

/// Name and text of each library.
const LIBRARIES: [(&str, &str); 5] = [
    ("StandardLibrary", include_str!("../../../library/std/StandardLibrary.asm")),
    ("CTLLibrary", include_str!("../../../library/std/CTLLibrary.asm")),
    ("LTLLibrary", include_str!("../../../library/std/LTLLibrary.asm")),
    ("TimeLibrary", include_str!("../../../library/std/TimeLibrary.asm")),
    ("TimeLibrarySimple", include_str!("../../../library/std/TimeLibrarySimple.asm")),
];

/// The library that an import path names, as a source file.
pub fn find(path: &str) -> Option<SourceFile> {
    let stem = stem(path);
    let (name, text) = LIBRARIES.iter().find(|(name, _)| name.eq_ignore_ascii_case(stem))?;
    Some(SourceFile::new(format!("<std>/{name}.asm"), *text))
}

/// The names of all libraries.
pub fn libraries() -> impl Iterator<Item = &'static str> {
    LIBRARIES.iter().map(|(name, _)| *name)
}

/// A file of that name is one of the built-in libraries, or takes its place.
pub(crate) fn is_library(path: &str) -> bool {
    LIBRARIES.iter().any(|(name, _)| *name == stem(path))
}

/// The library's text says everything that it means, so a copy can be read in its place: the time libraries. What the
/// others declare is known to the machine alone.
pub(crate) fn is_all_text(path: &str) -> bool {
    stem(path).starts_with("TimeLibrary")
}

/// Names of functions and domains that a copy of a library declares and the built-in one does not, in order.
pub(crate) fn missing(copy: &SourceFile, built_in: &SourceFile) -> Vec<String> {
    if copy.text == built_in.text {
        return Vec::new();
    }
    // The built-in text has each declaration on a line of its own, so it need not be parsed for its names.
    let known: BTreeSet<&str> = built_in.text.lines().filter_map(declared_name).map(str::trim).collect();
    let mut names: Vec<String> =
        declared_names(copy).into_iter().filter(|name| !known.contains(name.as_str())).collect();
    let mut seen = BTreeSet::new();
    names.retain(|name| seen.insert(name.clone()));
    names
}

fn declared_names(source: &SourceFile) -> Vec<String> {
    let parse = syntax::parse_asmetal(FileId(0), &source.text);
    let Some(signature) = ast::SourceFile::cast(parse.syntax()).and_then(|tree| tree.signature()) else {
        return Vec::new();
    };
    let domains = signature.domains().filter_map(|domain| domain.name());
    let functions = signature.functions().filter_map(|function| function.name());
    domains.chain(functions).map(|name| name.text().to_string()).collect()
}

/// The file name at the end of a path, without `.asm`; either slash separates.
pub(crate) fn stem(path: &str) -> &str {
    let name = path.rsplit(['/', '\\']).next().unwrap_or(path);
    name.strip_suffix(".asm").unwrap_or(name)
}

/// Names of the functions of the standard library, to tell a missing import from a misspelling.
pub(crate) fn is_standard_name(name: &str) -> bool {
    let text = LIBRARIES[0].1;
    text.lines().filter_map(declared_name).any(|declared| declared == name)
}

/// The library of a logic's operators, if the name is one of them.
pub(crate) fn of_operator(name: &str, kind: PropertyKind) -> Option<&'static str> {
    let library = match kind {
        PropertyKind::Ctl => "CTLLibrary",
        PropertyKind::Ltl => "LTLLibrary",
        _ => return None,
    };
    let (library, text) = LIBRARIES.iter().find(|(known, _)| *known == library)?;
    text.lines().filter_map(declared_name).any(|declared| declared == name).then_some(*library)
}

fn declared_name(line: &str) -> Option<&str> {
    let line = line.trim();
    if let Some(rest) = line.strip_prefix("static ").or_else(|| line.strip_prefix("controlled ")) {
        return rest.split(':').next();
    }
    line.strip_prefix("basic domain ")
        .or_else(|| line.strip_prefix("anydomain "))
        .or_else(|| line.strip_prefix("dynamic abstract domain "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_library_is_found_by_the_end_of_the_path() {
        let name = |path| find(path).map(|file| file.name).unwrap_or_default();
        assert_eq!(name("../../STDL/StandardLibrary"), "<std>/StandardLibrary.asm");
        assert_eq!(name("C:\\models\\CTLLibrary.asm"), "<std>/CTLLibrary.asm");
        assert_eq!(name("TimeLibrarySimple"), "<std>/TimeLibrarySimple.asm");
        assert_eq!(name("MyTimeLibrary"), "");
    }

    #[test]
    fn a_copy_is_told_apart_by_what_it_declares() {
        let file = |text: &str| SourceFile::new("a/StandardLibrary.asm", text);
        let built_in = find("StandardLibrary").unwrap();
        assert!(missing(&built_in, &built_in).is_empty());
        let renamed = SourceFile::new("a/StandardLibrary.asm", format!("{}\n", built_in.text));
        assert!(missing(&renamed, &built_in).is_empty());
        let copy = file(
            "module StandardLibrary export * signature: basic domain Integer static plus: Integer -> Integer static two: Integer static two: Integer -> Integer definitions: function two = 2",
        );
        assert_eq!(missing(&copy, &built_in), ["two"]);
    }

    #[test]
    fn the_lines_of_a_library_declare_what_its_tree_declares() {
        for name in libraries().filter(|name| !is_all_text(name)) {
            let library = find(name).unwrap();
            let of_lines: BTreeSet<&str> = library.text.lines().filter_map(declared_name).map(str::trim).collect();
            let of_tree = declared_names(&library);
            assert_eq!(of_lines, of_tree.iter().map(String::as_str).collect(), "{name}");
        }
    }

    #[test]
    fn standard_names_are_those_declared() {
        assert!(is_standard_name("plus") && is_standard_name("Integer") && is_standard_name("Agent"));
        assert!(!is_standard_name("plu") && !is_standard_name("ag"));
    }
}
