//! The lines that changed since a revision, by git.
//!
//! In: the revision and the texts. Out: for each text, the ranges of its lines that are new or changed. A text that git does
//! not know is new.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::RangeInclusive;
use std::path::Path;
use std::process::{Command, Stdio};

use crate::failure::Failure;

/// The changed lines of each text.
pub fn changed_lines(
    revision: &str,
    texts: &BTreeSet<String>,
) -> Result<BTreeMap<String, Vec<RangeInclusive<u32>>>, Failure> {
    let mut changed = BTreeMap::new();
    if revision.starts_with('-') {
        return Err(Failure::usage(format!("{revision} is no revision")));
    }
    for text in texts {
        let path = Path::new(text);
        let folder = path.parent().filter(|folder| *folder != Path::new("")).unwrap_or(Path::new("."));
        let name = path.file_name().unwrap_or_default();
        let run = |arguments: &[&str]| {
            let mut command = Command::new("git");
            command.args(arguments).arg(name).current_dir(folder).stdin(Stdio::null()).output()
        };
        if !knows(folder, revision)? {
            return Err(Failure::usage(format!("git knows no revision {revision} in {}", folder.display())));
        }
        let known = run(&["ls-files", "--error-unmatch", "--"]);
        let known =
            known.map_err(|error| Failure::usage(format!("--since needs git, which cannot be started: {error}")))?;
        if !known.status.success() {
            changed.insert(text.clone(), vec![1..=u32::MAX]);
            continue;
        }
        let diff = run(&["diff", "--no-color", "--no-ext-diff", "-U0", revision, "--"]);
        let diff = diff.map_err(|error| Failure::usage(format!("git cannot be started: {error}")))?;
        if !diff.status.success() {
            let told = String::from_utf8_lossy(&diff.stderr);
            let told = told.lines().next().unwrap_or_default().trim_start_matches("fatal: ").to_string();
            return Err(Failure::usage(format!("git does not know what changed since {revision}: {told}")));
        }
        changed.insert(text.clone(), ranges(&String::from_utf8_lossy(&diff.stdout)));
    }
    Ok(changed)
}

/// Whether git knows a revision in a folder.
fn knows(folder: &Path, revision: &str) -> Result<bool, Failure> {
    let mut command = Command::new("git");
    let commit = format!("{revision}^{{commit}}");
    command.args(["rev-parse", "--verify", "--quiet", &commit]).current_dir(folder);
    let asked = command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).status();
    asked
        .map(|status| status.success())
        .map_err(|error| Failure::usage(format!("--since needs git, which cannot be started: {error}")))
}

/// The lines that a difference has on its new side.
fn ranges(diff: &str) -> Vec<RangeInclusive<u32>> {
    let hunks = diff.lines().filter_map(|line| line.strip_prefix("@@ "));
    let new = hunks.filter_map(|hunk| hunk.split_whitespace().find_map(|word| word.strip_prefix('+')));
    let range = |new: &str| {
        let (start, count) = new.split_once(',').unwrap_or((new, "1"));
        let (start, count): (u32, u32) = (start.parse().ok()?, count.parse().ok()?);
        (count > 0).then(|| start..=start + count - 1)
    };
    new.filter_map(range).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_a_difference() {
        let diff =
            "--- a/A.asm\n+++ b/A.asm\n@@ -3 +3,2 @@ asm A\n-x\n+y\n+z\n@@ -9,2 +10,0 @@\n-a\n-b\n@@ -20 +19 @@\n";
        assert_eq!(ranges(diff), [3..=4, 19..=19]);
    }
}
