//! `cargo xtask tidy`: the house rules as a test.
//!
//! In: the files that the repository holds. Out: one [`Finding`] for each place that breaks a rule. Each rule is one
//! function from the files to findings; a test of this crate runs them all over the repository, so `cargo test` keeps
//! them too. It must not know what the code does.

mod builtins;
mod circles;
mod dependencies;
mod layers;
mod links;
mod source;

use std::fmt;

use crate::{Failure, Outcome, repository};

/// A file of the repository.
#[derive(Debug, Clone)]
pub struct File {
    /// Relative to the root, with `/`.
    pub path: String,
    /// Its text; none if it is no UTF-8.
    pub text: Option<String>,
}

impl File {
    /// A file with this text, for tests of rules.
    #[cfg(test)]
    pub fn new(path: &str, text: &str) -> File {
        File { path: path.to_string(), text: Some(text.to_string()) }
    }

    /// Its text, if the name ends so.
    pub fn text_of(&self, ending: &str) -> Option<&str> {
        self.text.as_deref().filter(|_| self.path.ends_with(ending))
    }
}

/// A broken rule.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Finding {
    /// The file.
    pub path: String,
    /// The line, from 1; 0 for the file as a whole.
    pub line: usize,
    /// What is wrong and what to do.
    pub what: String,
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            0 => write!(f, "{}: {}", self.path, self.what),
            line => write!(f, "{}:{line}: {}", self.path, self.what),
        }
    }
}

impl Finding {
    /// Of a file as a whole.
    pub fn of(file: &File, what: impl Into<String>) -> Finding {
        Finding { path: file.path.clone(), line: 0, what: what.into() }
    }

    /// Of a line, counted from 0.
    pub fn at(file: &File, line: usize, what: impl Into<String>) -> Finding {
        Finding { path: file.path.clone(), line: line + 1, what: what.into() }
    }
}

/// One house rule.
type Rule = fn(&[File]) -> Vec<Finding>;

/// All house rules.
const RULES: &[Rule] = &[
    source::header,
    source::length,
    source::unfinished,
    source::machine_paths,
    source::unlisted_tests,
    layers::layers,
    dependencies::documented,
    links::links,
    builtins::builtins,
    circles::circles,
];

/// The command.
///
/// # Errors
/// The files cannot be listed.
pub fn run(words: &[String]) -> Result<Outcome, Failure> {
    crate::arguments::Arguments::read(words, &[], &[])?;
    let findings = findings(&files()?);
    for finding in &findings {
        println!("{finding}");
    }
    match findings.len() {
        0 => Ok(Outcome::Good),
        count => {
            println!("{count} places break a rule of the house");
            Ok(Outcome::AtFault)
        }
    }
}

fn findings(files: &[File]) -> Vec<Finding> {
    RULES.iter().flat_map(|rule| rule(files)).collect()
}

fn files() -> Result<Vec<File>, Failure> {
    let root = repository::root();
    let read = |path: String| {
        let bytes = std::fs::read(root.join(&path)).map_err(|error| format!("{path}: {error}"))?;
        Ok(File { path, text: String::from_utf8(bytes).ok() })
    };
    repository::files()?.into_iter().map(read).collect()
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_house_is_tidy() {
        let findings = super::findings(&super::files().unwrap());
        let lines: Vec<String> = findings.iter().map(ToString::to_string).collect();
        assert!(lines.is_empty(), "\n{}", lines.join("\n"));
    }
}
