//! Relative links in Markdown lead to files that are there.
//!
//! In: all files. Out: findings for links to files or folders that the repository does not hold. Links to other
//! hosts are not followed, fragments not looked at.

use std::collections::BTreeSet;

use super::{File, Finding};

/// Every relative link resolves.
pub fn links(files: &[File]) -> Vec<Finding> {
    let mut there: BTreeSet<String> = BTreeSet::new();
    for file in files {
        let mut path = file.path.as_str();
        there.insert(path.to_string());
        while let Some((folder, _)) = path.rsplit_once('/') {
            there.insert(folder.to_string());
            path = folder;
        }
    }
    let mut findings = Vec::new();
    for file in files {
        let Some(text) = file.text_of(".md") else { continue };
        let mut fenced = false;
        for (number, line) in text.lines().enumerate() {
            fenced ^= line.trim_start().starts_with("```");
            for target in targets(line).filter(|_| !fenced) {
                if let Some(path) = resolved(&file.path, target)
                    && !there.contains(&path)
                    && !path.is_empty()
                {
                    findings.push(Finding::at(file, number, format!("the link to `{target}` leads nowhere")));
                }
            }
        }
    }
    findings
}

/// What the links of a line point to: `[text](target)`, outside of code.
fn targets(line: &str) -> impl Iterator<Item = &str> {
    let outside = line.split('`').step_by(2);
    outside.flat_map(|piece| piece.split("](").skip(1).filter_map(|rest| rest.split([')', ' ']).next()))
}

/// The path in the repository, if the target is one.
fn resolved(page: &str, target: &str) -> Option<String> {
    let target = target.split('#').next().unwrap_or_default();
    if target.is_empty() || target.contains("://") || target.starts_with("mailto:") || target.starts_with('/') {
        return None;
    }
    let mut parts: Vec<&str> = page.split('/').collect();
    parts.pop();
    for part in target.trim_end_matches('/').split('/') {
        match part {
            "." | "" => {}
            ".." => {
                // Out of the repository: not ours to judge.
                parts.pop()?;
            }
            part => parts.push(part),
        }
    }
    Some(parts.join("/"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_are_resolved_from_the_page() {
        let page = File::new("docs/a.md", "[x](b.md#here) [y](../crates/) [z](c.md)\n`[w](d.md)` [h](https://a.b/c)\n");
        let files = [page.clone(), File::new("docs/b.md", ""), File::new("crates/m/lib.rs", "")];
        assert_eq!(links(&files), [Finding::at(&page, 0, "the link to `c.md` leads nowhere")]);
    }
}
