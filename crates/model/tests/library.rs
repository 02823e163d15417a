//! The built-in libraries: they have no faults, and spec/standard-library.md lists exactly their functions.

use std::collections::BTreeSet;
use std::path::PathBuf;

use crate::support::{check_file, faults};

const LIBRARIES: [&str; 5] = ["StandardLibrary", "CTLLibrary", "LTLLibrary", "TimeLibrary", "TimeLibrarySimple"];

#[allow(clippy::disallowed_methods, reason = "a test reads the files it is about")]
fn read(path: &str) -> String {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../..").join(path);
    std::fs::read_to_string(&path).unwrap_or_else(|_| panic!("cannot read {}", path.display()))
}

/// `name: domain` of each declared function.
fn declared(library: &str) -> BTreeSet<String> {
    let text = read(&format!("library/std/{library}.asm"));
    let kinds = ["static ", "derived ", "controlled ", "monitored "];
    let declarations =
        text.lines().map(str::trim).filter_map(|line| kinds.iter().find_map(|kind| line.strip_prefix(kind)));
    declarations.map(|line| line.split("//").next().unwrap_or(line).trim().to_string()).collect()
}

/// `name: domain` of each row of the tables.
fn listed() -> BTreeSet<String> {
    let mut listed = BTreeSet::new();
    for line in read("spec/standard-library.md").lines() {
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        if cells.len() != 6 || !cells[1].starts_with('`') {
            continue;
        }
        let name = cells[1].trim_matches('`');
        listed.extend(cells[2].split("<br>").map(|signature| format!("{name}: {}", signature.trim_matches('`'))));
    }
    listed
}

#[test]
fn the_page_lists_exactly_the_functions_of_the_libraries() {
    let declared: BTreeSet<String> = LIBRARIES.iter().flat_map(|library| declared(library)).collect();
    let listed = listed();
    let missing: Vec<&String> = declared.difference(&listed).collect();
    let unknown: Vec<&String> = listed.difference(&declared).collect();
    assert!(
        missing.is_empty() && unknown.is_empty(),
        "not on the page: {missing:#?}\nnot in the libraries: {unknown:#?}"
    );
}

#[test]
fn the_libraries_have_no_faults() {
    for library in LIBRARIES {
        let name = format!("{library}.asm");
        assert_eq!(faults(&check_file(&name, &read(&format!("library/std/{name}")), &[])), "");
        let import = format!("asm t\nimport somewhere/{library}\nsignature:\ndefinitions:\n");
        assert_eq!(faults(&check_file("t.asm", &import, &[])), "");
    }
}

#[test]
fn all_libraries_together_have_no_faults() {
    let imports: String = LIBRARIES[..4].iter().map(|library| format!("import {library}\n")).collect();
    assert_eq!(faults(&check_file("t.asm", &format!("asm t\n{imports}signature:\ndefinitions:\n"), &[])), "");
}
