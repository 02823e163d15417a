//! Small objects: the answers of single commands.
//!
//! In: what a command came to. Out: an object, whose `type` tells what it is of.

use serde::Serialize;

/// An object of the command's output; the variant's name in small letters is its `type`.
#[derive(Debug, Serialize)]
#[serde(tag = "type", rename_all = "lowercase")]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub enum Answer<'a> {
    /// Faults that are not shown.
    More {
        /// How many.
        faults: usize,
    },
    /// What `check` came to.
    #[serde(rename = "summary")]
    Checked {
        /// Those that were looked at.
        files: usize,
        /// In all files.
        errors: usize,
        /// In all files.
        warnings: usize,
    },
    /// What `test` came to.
    #[serde(rename = "summary")]
    Tested {
        /// Scenarios whose checks hold, or that fail as they are to.
        passed: usize,
        /// Scenarios that do not, or have faults.
        failed: usize,
        /// Scenarios that were left when the command was interrupted.
        not_run: usize,
    },
    /// What `fmt` did with a file, or with `--check` would do.
    Formatted {
        /// Its path.
        file: &'a str,
        /// Whether it was formatted otherwise.
        changed: bool,
    },
    /// Where a replay parts from its trace.
    Parted {
        /// The first step that differs.
        step: u64,
        /// What it came to in the trace.
        trace: &'a str,
        /// What it comes to now.
        now: &'a str,
    },
    /// The page of a kind of fault.
    Page {
        /// The kind.
        id: &'a str,
        /// The page's title.
        title: &'a str,
        /// The page in Markdown, where one page is asked for.
        #[serde(skip_serializing_if = "Option::is_none")]
        text: Option<&'a str>,
    },
}
