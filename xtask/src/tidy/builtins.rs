//! What is known of every builtin is known in one place: the table in `crates/program`.
//!
//! In: all files. Out: findings for files that list most builtins themselves, where a new one would be forgotten; and a
//! finding where an ordinary builtin is named in more places than [`PLACES`]. A file that treats some builtins specially may
//! do so. The oracle is left out: it is written without the table so that it can judge it.

use std::collections::BTreeSet;

use super::{File, Finding};

const TABLE: &str = "crates/program/src/builtin/table.rs";

/// A builtin that no engine treats specially, as it is written in Rust, in AsmetaL and in C++.
const ORDINARY: [&str; 3] = ["SymmetricDifference", "symmetricDifference", "symmetric_difference"];

/// Its row, what it computes, its twin in C++, its signature in the library, its line in the specification.
const PLACES: usize = 5;

/// Where a place counts.
fn counts(path: &str) -> bool {
    let ours = ["crates/", "shells/"].iter().any(|folder| path.starts_with(folder));
    let code = ours && path.contains("/src/") && !path.starts_with("crates/oracle/");
    code || ["library/", "spec/", "cpp/include/"].iter().any(|folder| path.starts_with(folder))
}

fn words(text: &str) -> BTreeSet<&str> {
    text.split(|c: char| !c.is_alphanumeric() && c != '_').collect()
}

/// The variants that the table has rows for.
fn variants(table: &str) -> BTreeSet<&str> {
    let rows = table.split("\nbuiltins! {\n").nth(1).unwrap_or_default();
    let rows = rows.lines().filter(|line| line.contains(": ") && !line.trim_start().starts_with("//"));
    rows.filter_map(|row| row.trim_start().split([':', '(']).next()).collect()
}

/// No second file lists the builtins, and an ordinary one has few places.
pub fn builtins(files: &[File]) -> Vec<Finding> {
    let Some(table) = files.iter().find(|file| file.path == TABLE) else { return Vec::new() };
    let variants = variants(table.text.as_deref().unwrap_or_default());
    if variants.is_empty() {
        return vec![Finding::of(table, "no rows were found: mend the rule that reads them")];
    }
    let mut findings = Vec::new();
    let mut places = Vec::new();
    for file in files.iter().filter(|file| counts(&file.path)) {
        let words = words(file.text.as_deref().unwrap_or_default());
        if ORDINARY.iter().any(|name| words.contains(name)) {
            places.push(file.path.as_str());
        }
        let named = variants.intersection(&words).count();
        if file.path != TABLE && words.contains("Builtin") && named * 2 > variants.len() {
            let what =
                format!("names {named} of {} builtins: make what it tells of them a column of {TABLE}", variants.len());
            findings.push(Finding::of(file, what));
        }
    }
    if places.len() > PLACES {
        let what = format!("`{}` is named in more than {PLACES} places: {}", ORDINARY[0], places.join(", "));
        findings.push(Finding::of(table, what));
    }
    findings
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> File {
        let rows = "    // Sets\n    Union: \"union\", [\"union\"], Of(&[Set, Set]), Pure;\n    Part(u8 = 0): \"part\", [], Own, Pure;\n";
        File::new(TABLE, &format!("//! It.\nmacro_rules! builtins {{}}\n\nbuiltins! {{\n{rows}}}\n"))
    }

    #[test]
    fn rows_are_read() {
        assert_eq!(variants(table().text.as_deref().unwrap()), BTreeSet::from(["Union", "Part"]));
    }

    #[test]
    fn a_second_list_is_found() {
        let list = File::new("crates/a/src/list.rs", "//! It.\nmatches!(b, Builtin::Union | Builtin::Part(_))\n");
        let one = File::new("crates/a/src/one.rs", "//! It.\nmatches!(b, Builtin::Union)\n");
        let paths: Vec<String> = builtins(&[table(), list, one]).into_iter().map(|finding| finding.path).collect();
        assert_eq!(paths, ["crates/a/src/list.rs"]);
    }

    #[test]
    fn an_ordinary_builtin_has_few_places() {
        let file =
            |number: usize| File::new(&format!("crates/a/src/{number}.rs"), "//! It.\nfn symmetric_difference() {}\n");
        let mut files: Vec<File> = (0..PLACES).map(file).collect();
        files.push(table());
        assert_eq!(builtins(&files), []);
        files.push(file(PLACES));
        assert_eq!(builtins(&files).len(), 1);
    }
}
