//! Rules about source files one by one: a header, a bounded length, nothing unfinished, no path of one machine.
//!
//! Which files are source is told by their endings; what tools made (lock files, snapshots) is no source.

use super::{File, Finding};

/// LIMIT: lines of a source file.
const MAX_LINES: usize = 600;

/// Endings of source files, with what opens a comment.
const SOURCES: &[(&str, &[&str])] = &[
    (".rs", &["//!", "//"]),
    (".py", &["\"\"\"", "#"]),
    (".hpp", &["//", "/*"]),
    (".cpp", &["//", "/*"]),
    (".h", &["//", "/*"]),
    (".ts", &["//", "/*"]),
    (".tsx", &["//", "/*"]),
    (".mjs", &["//", "/*"]),
    (".sh", &["#"]),
    (".asm", &["//", "/*"]),
];

fn comment_of(file: &File) -> Option<&'static [&'static str]> {
    let found = SOURCES.iter().find(|(ending, _)| file.path.ends_with(ending))?;
    // What a tool wrote, and texts that are data of a test.
    let made = file.path.ends_with(".d.ts")
        || file.path.contains("/generated/")
        || file.path.starts_with("editors/tree-sitter-asmetal/src/");
    let data =
        ["/tests/data/", "/golden/", "/snapshots/", "/fixtures/"].iter().any(|folder| file.path.contains(folder));
    let ours = ["crates/", "shells/"].iter().any(|folder| file.path.starts_with(folder));
    let model = ours && file.path.contains("/tests/") && file.path.ends_with(".asm");
    (!made && !data && !model).then_some(found.1)
}

/// Every source file opens with a comment that says what it owns.
pub fn header(files: &[File]) -> Vec<Finding> {
    let mut findings = Vec::new();
    for file in files {
        let (Some(openers), Some(text)) = (comment_of(file), file.text.as_deref()) else { continue };
        let first = text.lines().find(|line| !line.trim().is_empty() && !line.starts_with("#!/")).unwrap_or_default();
        if !openers.iter().any(|opener| first.starts_with(opener)) {
            findings.push(Finding::of(file, "open the file with a comment that says what it owns"));
        }
    }
    findings
}

/// A model that `chart build` wrote: as long as its chart and its components' machines make it.
fn is_built(file: &File) -> bool {
    file.path.ends_with(".asm") && file.text.as_deref().is_some_and(|text| text.starts_with("/* Made from "))
}

/// No source file is too long to read at once.
pub fn length(files: &[File]) -> Vec<Finding> {
    let sources = files.iter().filter(|file| comment_of(file).is_some() && !is_built(file));
    let long = sources.filter_map(|file| Some((file, file.text.as_deref()?.lines().count())));
    long.filter(|(_, lines)| *lines > MAX_LINES)
        .map(|(file, lines)| Finding::of(file, format!("{lines} lines, more than {MAX_LINES}: split it")))
        .collect()
}

/// Nothing is left unfinished, no test is left out.
pub fn unfinished(files: &[File]) -> Vec<Finding> {
    // Put together here, so that this file does not find itself.
    let words =
        [("to", "do!("), ("unimple", "mented!("), ("FIX", "ME"), ("#[ig", "nore")].map(|(a, b)| format!("{a}{b}"));
    let mut findings = Vec::new();
    for file in files.iter().filter(|file| comment_of(file).is_some()) {
        for (number, line) in file.text.iter().flat_map(|text| text.lines().enumerate()) {
            if let Some(word) = words.iter().find(|word| line.contains(word.as_str())) {
                findings.push(Finding::at(file, number, format!("`{word}` is left in the file: finish it")));
            }
        }
    }
    findings
}

/// No file names a place that only one machine has.
pub fn machine_paths(files: &[File]) -> Vec<Finding> {
    let places = [("/wo", "rk/"), ("/ho", "me/"), ("/ro", "ot/"), ("/Us", "ers/"), ("/tm", "p/")];
    let places = places.map(|(a, b)| format!("{a}{b}"));
    let mut findings = Vec::new();
    for file in files {
        for (number, line) in file.text.iter().flat_map(|text| text.lines().enumerate()) {
            if let Some(place) = places.iter().find(|place| names(line, place)) {
                findings.push(Finding::at(file, number, format!("`{place}` is a path of one machine")));
            }
        }
    }
    findings
}

/// No file of tests is left out of the program that its crate's tests are: Cargo would not miss it.
pub fn unlisted_tests(files: &[File]) -> Vec<Finding> {
    let mut findings = Vec::new();
    for list in files.iter().filter(|file| file.path.ends_with("/tests/all.rs")) {
        let folder = list.path.trim_end_matches("all.rs");
        for file in files.iter().filter(|file| file.path != list.path) {
            let Some(rest) = file.path.strip_prefix(folder) else { continue };
            let Some(name) = rest.strip_suffix("/mod.rs").or_else(|| rest.strip_suffix(".rs")) else { continue };
            let listed = list.text.iter().flat_map(|text| text.lines()).any(|line| line == format!("mod {name};"));
            if !name.contains('/') && !listed {
                findings.push(Finding::of(file, format!("its tests do not run: write `mod {name};` in {}", list.path)));
            }
        }
    }
    findings
}

/// The place stands at the beginning of a path, not in the middle of a longer one or of an address.
fn names(line: &str, place: &str) -> bool {
    line.match_indices(place).any(|(at, _)| {
        let before = line[..at].chars().next_back();
        !before.is_some_and(|c| c.is_alphanumeric() || "/.-_}$~:)".contains(c))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_header_may_follow_the_interpreter() {
        let files = [File::new("a.sh", "#!/bin/sh\n# What it owns.\n"), File::new("b.rs", "use x;\n")];
        assert_eq!(header(&files), [Finding::of(&files[1], "open the file with a comment that says what it owns")]);
    }

    #[test]
    fn paths_of_one_machine_are_found() {
        let place = ["/ho", "me/me"].concat();
        let home = ["/ho", "me/"].concat();
        assert!(names(&format!("see {place}"), &home));
        assert!(!names(&format!("see .{place} and https://a.org{place}"), &home));
    }

    #[test]
    fn tests_that_would_not_run_are_found() {
        let names = ["c/tests/all.rs", "c/tests/a.rs", "c/tests/b.rs", "c/tests/d/mod.rs", "c/tests/a/part.rs"];
        let files = names.map(|name| File::new(name, "//! It.\nmod a;\n"));
        let paths: Vec<String> = unlisted_tests(&files).into_iter().map(|finding| finding.path).collect();
        assert_eq!(paths, ["c/tests/b.rs", "c/tests/d/mod.rs"]);
    }

    #[test]
    fn unfinished_work_is_found() {
        let word = ["to", "do!()"].concat();
        let files = [File::new("a.rs", &format!("//! A.\nfn f() {{ {word} }}\n"))];
        assert_eq!(unfinished(&files).len(), 1);
    }
}
