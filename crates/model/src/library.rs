//! The built-in libraries: their texts, and how an import finds them.
//!
//! In: the path of an import. Out: the text, shown under `<std>/NAME.asm`. A library is known by the file name at
//! the end of the path, whatever folder stands before it, so a copy beside a model is never read
//! (spec/standard-library.md).

use syntax::SourceFile;

/// Name and text of each library.
const LIBRARIES: [(&str, &str); 5] = [
    ("StandardLibrary", include_str!("../../../library/std/StandardLibrary.asm")),
    ("CTLLibrary", include_str!("../../../library/std/CTLLibrary.asm")),
    ("LTLLibrary", include_str!("../../../library/std/LTLLibrary.asm")),
    ("TimeLibrary", include_str!("../../../library/std/TimeLibrary.asm")),
    ("TimeLibrarySimple", include_str!("../../../library/std/TimeLibrarySimple.asm")),
];

/// The library that an import path names, as a source file.
pub(crate) fn find(path: &str) -> Option<SourceFile> {
    let stem = stem(path);
    let (name, text) = LIBRARIES.iter().find(|(name, _)| name.eq_ignore_ascii_case(stem))?;
    Some(SourceFile::new(format!("<std>/{name}.asm"), *text))
}

/// A file of that name is one of the built-in libraries, or stands for one.
pub(crate) fn is_library(path: &str) -> bool {
    LIBRARIES.iter().any(|(name, _)| *name == stem(path))
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
    fn standard_names_are_those_declared() {
        assert!(is_standard_name("plus") && is_standard_name("Integer") && is_standard_name("Agent"));
        assert!(!is_standard_name("plu") && !is_standard_name("ag"));
    }
}
