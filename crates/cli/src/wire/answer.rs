//! Small objects: the answers of single commands.

use serde::Serialize;

/// An object of the command's output; the variant's name in small letters is its `type`.
#[derive(Debug, Serialize)]
#[serde(tag = "type", rename_all = "lowercase")]
pub enum Answer<'a> {
    /// Faults that are not shown.
    More { faults: usize },
    /// What `check` came to.
    #[serde(rename = "summary")]
    Checked { files: usize, errors: usize, warnings: usize },
    /// What `test` came to.
    #[serde(rename = "summary")]
    Tested { passed: usize, failed: usize, not_run: usize },
    /// What `fmt` did with a file, or with `--check` would do.
    Formatted { file: &'a str, changed: bool },
    /// Where a replay parts from its trace.
    Parted { step: u64, trace: &'a str, now: &'a str },
    /// The page of a kind of fault.
    Page {
        id: &'a str,
        title: &'a str,
        #[serde(skip_serializing_if = "Option::is_none")]
        text: Option<&'a str>,
    },
}
