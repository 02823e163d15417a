//! Small objects: the answers of single commands.
//!
//! In: the result of a command. Out: an object, whose `type` names its kind.

use serde::Serialize;

/// An object of a command's output; its `type` is the variant's name in lower case.
#[derive(Debug, Serialize)]
#[serde(tag = "type", rename_all = "lowercase")]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub enum Answer<'a> {
    /// Further faults that are not shown.
    More {
        /// How many.
        faults: usize,
    },
    /// The result of `check`.
    #[serde(rename = "summary")]
    Checked {
        /// The files that were checked.
        files: usize,
        /// In all files.
        errors: usize,
        /// In all files.
        warnings: usize,
    },
    /// The result of `test`.
    #[serde(rename = "summary")]
    Tested {
        /// Scenarios that pass, or fail as they should.
        passed: usize,
        /// Scenarios that do not, or that have faults.
        failed: usize,
        /// Scenarios that had not run when the command was interrupted.
        not_run: usize,
    },
    /// What `fmt` did with a file, or with `--check` what it would do.
    Formatted {
        /// Its path.
        file: &'a str,
        /// Whether formatting changes the file.
        changed: bool,
    },
    /// Where a replay first differs from its trace.
    Parted {
        /// The first step that differs.
        step: u64,
        /// What happens at that step in the trace.
        trace: &'a str,
        /// What happens at that step now.
        now: &'a str,
    },
    /// The page of a kind of fault.
    Page {
        /// The kind.
        id: &'a str,
        /// The page's title.
        title: &'a str,
        /// The page in Markdown; absent in the list of all pages.
        #[serde(skip_serializing_if = "Option::is_none")]
        text: Option<&'a str>,
    },
}
