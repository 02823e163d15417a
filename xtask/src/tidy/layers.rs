//! Which crate may use which: the flow is the tree, and a crate reads only what lies before it.
//!
//! In: the manifests. Out: findings where a dependency goes against the flow
//! (syntax ← model ← program ← machine ← solve ← operations ← groundstate ← shells). Operations never use each other; the
//! oracle and what else only tests need may be a dev-dependency alone.

use super::{File, Finding};

/// The layers, lower ones first: a crate may use crates of the layers below its own.
const LAYERS: &[&[&str]] = &[
    &["syntax", "palette"],
    &["model"],
    &["program"],
    &["machine"],
    &["explore", "solve"],
    &["recording", "testkit"],
    &["simulate", "scenario", "verify", "refine", "chart", "conform", "mutate"],
    &["draw", "generate"],
    &["inputs"],
    &["report"],
    &["groundstate"],
    &["ide", "properties", "wire"],
    &["lsp", "dap", "python"],
    &["studio"],
    &["cli", "xtask"],
];

/// Crates that only tests may use.
const FOR_TESTS: &[&str] = &["oracle", "testkit"];

fn layer(name: &str) -> Option<usize> {
    LAYERS.iter().position(|layer| layer.contains(&name))
}

/// One dependency of a manifest: the line it stands in, its name, and whether only tests have it.
pub struct Dependency<'a> {
    /// From 0.
    pub line: usize,
    /// The name.
    pub name: &'a str,
    /// A dev-dependency.
    pub dev: bool,
}

/// The dependencies that a manifest lists.
pub fn dependencies(manifest: &str) -> Vec<Dependency<'_>> {
    let mut section = "";
    let mut found = Vec::new();
    for (number, line) in manifest.lines().enumerate() {
        let line = line.trim();
        if line.starts_with('[') {
            section = line.trim_matches(['[', ']']);
            // `[dependencies.name]`
            if let Some((table, name)) = section.split_once("dependencies.")
                && !name.is_empty()
            {
                found.push(Dependency { line: number, name, dev: table.ends_with("dev-") });
            }
            continue;
        }
        let of_section = section.ends_with("dependencies") && !line.is_empty() && !line.starts_with('#');
        if let (true, Some((key, _))) = (of_section, line.split_once('=')) {
            let name = key.trim().trim_end_matches(".workspace");
            // A key of an inline table that goes over several lines is no name of a crate.
            if !name.contains([' ', '"', '{', '}']) {
                found.push(Dependency { line: number, name, dev: section.ends_with("dev-dependencies") });
            }
        }
    }
    found
}

/// The name of the crate of a manifest.
pub fn name_of(manifest: &str) -> Option<&str> {
    let line = manifest.lines().find_map(|line| line.strip_prefix("name = "))?;
    Some(line.trim().trim_matches('"'))
}

/// No dependency goes against the flow.
pub fn layers(files: &[File]) -> Vec<Finding> {
    let mut findings = Vec::new();
    for file in files {
        let Some(text) = file.text_of("Cargo.toml") else { continue };
        let Some(user) = name_of(text) else { continue };
        for used in dependencies(text) {
            if FOR_TESTS.contains(&used.name) && !used.dev && !FOR_TESTS.contains(&user) {
                findings.push(Finding::at(
                    file,
                    used.line,
                    format!("`{}` is there for tests: make it a dev-dependency", used.name),
                ));
            }
            let (Some(above), Some(below)) = (layer(user), layer(used.name)) else { continue };
            let own_test = used.dev && user != used.name && above <= below;
            if below >= above && !own_test {
                findings.push(Finding::at(
                    file,
                    used.line,
                    format!("`{user}` must not use `{}`: the flow goes the other way", used.name),
                ));
            }
        }
    }
    findings
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(manifest: &str) -> Vec<usize> {
        layers(&[File::new("crates/x/Cargo.toml", manifest)]).into_iter().map(|finding| finding.line).collect()
    }

    #[test]
    fn the_flow_is_kept() {
        assert_eq!(check("name = \"model\"\n[dependencies]\nsyntax.workspace = true\nmachine = \"1\"\n"), [4]);
        assert_eq!(check("name = \"simulate\"\n[dependencies]\nscenario = { path = \"../scenario\" }\n"), [3]);
        assert_eq!(check("name = \"cli\"\n[dependencies]\noracle.workspace = true\n"), [3]);
        assert_eq!(
            check("name = \"machine\"\n[dev-dependencies]\noracle.workspace = true\n[dependencies]\nprogram = \"1\"\n"),
            [0usize; 0]
        );
    }
}
