//! Every dependency from outside is named in docs/dependencies.md, with what it is there for.
//!
//! In: the manifests of Rust, and that page. Out: findings for dependencies that the page does not name in backquotes,
//! and for names on the page that nothing uses any more.

use std::collections::BTreeMap;

use super::layers::{dependencies, name_of};
use super::{File, Finding};

const PAGE: &str = "docs/dependencies.md";

/// Every dependency is documented.
pub fn documented(files: &[File]) -> Vec<Finding> {
    let manifests: Vec<&File> = files.iter().filter(|file| file.path.ends_with("Cargo.toml")).collect();
    let own: Vec<&str> = manifests.iter().filter_map(|file| name_of(file.text.as_deref()?)).collect();
    let mut used: BTreeMap<&str, (&File, usize)> = BTreeMap::new();
    for file in &manifests {
        for dependency in dependencies(file.text.as_deref().unwrap_or_default()) {
            if !own.contains(&dependency.name) {
                used.entry(dependency.name).or_insert((file, dependency.line));
            }
        }
    }
    let page = files.iter().find(|file| file.path == PAGE).and_then(|file| file.text.as_deref());
    let Some(page) = page else {
        let first = used.values().next();
        return first.map(|(file, line)| Finding::at(file, *line, format!("there is no {PAGE}"))).into_iter().collect();
    };
    used.iter()
        .filter(|(name, _)| !page.contains(&format!("`{name}`")))
        .map(|(name, (file, line))| Finding::at(file, *line, format!("`{name}` is not named in {PAGE}")))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dependency_without_a_line_is_found() {
        let manifest = File::new("crates/a/Cargo.toml", "name = \"a\"\n[dependencies]\ncsv = \"1\"\ntar = \"1\"\n");
        let page = File::new(PAGE, "| `csv` | tables |\n");
        let findings = documented(&[manifest.clone(), page]);
        assert_eq!(findings, [Finding::at(&manifest, 3, format!("`tar` is not named in {PAGE}"))]);
    }
}
