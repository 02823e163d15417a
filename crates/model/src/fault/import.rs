//! Faults of imports, exports and file names.

use syntax::{Diagnostic, Span};

/// The imported file cannot be read.
pub(crate) fn not_found(span: Span, path: &str, reason: &str) -> Diagnostic {
    Diagnostic::error("import-not-found", span, format!("cannot import `{path}`: {reason}"))
        .with_help("a path is relative to the folder of this file; `.asm` may be left out")
}

/// A file imports itself, directly or through others.
pub(crate) fn circular(span: Span, cycle: &[String]) -> Diagnostic {
    Diagnostic::error("circular-import", span, format!("circular import: {}", cycle.join(" → ")))
        .here("leads back to a file that is being read")
        .with_help("move what both files need into a third one that imports neither")
}

/// The imported file exports nothing.
pub(crate) fn without_export(span: Span, path: &str) -> Diagnostic {
    Diagnostic::warning(
        "import-without-export",
        span,
        format!("`{path}` exports nothing, so this import brings nothing"),
    )
    .with_help("write `export *`, or `export` and a list of names, in that file before its signature")
}

/// A name in an import's selection is not exported.
pub(crate) fn not_exported(span: Span, name: &str, path: &str, suggestion: Option<&str>) -> Diagnostic {
    let help = match suggestion {
        Some(other) => format!("did you mean `{other}`?"),
        None => format!("add `{name}` to the export list of `{path}`"),
    };
    Diagnostic::warning("not-exported", span, format!("`{path}` does not export `{name}`")).with_help(help)
}

/// A name in an export list means nothing.
pub(crate) fn unknown_name(span: Span, name: &str, help: String) -> Diagnostic {
    Diagnostic::warning(
        "unknown-name-exported",
        span,
        format!("`{name}` is exported, but there is nothing of that name"),
    )
    .with_help(help)
}

/// The name after `asm` differs from the file's.
pub(crate) fn file_name(span: Span, name: &str, stem: &str, word: &str) -> Diagnostic {
    Diagnostic::error("file-name-mismatch", span, format!("the {word} is named `{name}`, but its file is `{stem}.asm`"))
        .with_help(format!("write `{word} {stem}`, or rename the file to `{name}.asm`"))
}

/// A library name that differs from a built-in one only in capitals.
pub(crate) fn library_path(span: Span, written: &str, name: &str) -> Diagnostic {
    Diagnostic::warning("library-path", span, format!("`{written}` is read as the built-in library `{name}`"))
        .with_help(format!("write `{name}`; elsewhere the letters' case matters"))
}

/// A copy of a built-in library is not read, and declares what the library does not.
pub(crate) fn library_copy(span: Span, copy: &str, names: &[String]) -> Diagnostic {
    const SHOWN: usize = 4;
    let shown: Vec<String> = names.iter().take(SHOWN).map(|name| format!("`{name}`")).collect();
    let more = if names.len() > SHOWN { format!(" and {} more", names.len() - SHOWN) } else { String::new() };
    let message =
        format!("the built-in library is read, not `{copy}`, which alone declares {}{more}", shown.join(", "));
    Diagnostic::warning("library-copy", span, message)
        .with_help("move what the model needs of it into a module of another name, and import that too")
}

/// Something of the standard library is used, but it is not imported.
pub(crate) fn missing_library(span: Span, what: &str) -> Diagnostic {
    Diagnostic::error(
        "missing-standard-library",
        span,
        format!("{what} comes from the standard library, which is not imported"),
    )
    .with_help("write `import StandardLibrary` before the signature; it is built in, so no file is needed")
}
