//! Inputs to begin with: this project's models, its scenarios with their models, and the blocks of its pages.
//!
//! In: files as paths from the root and texts, and the dictionary of the fuzz targets. Out: texts. It reads no disk.

use crate::Property;

/// Divides an input for a scenario: the model before it, the scenario after it.
pub const DIVIDER: &str = "\n%%%%\n";

/// A file: its path from the root of the repository, and its text.
pub type File = (String, String);

/// Inputs for a property.
pub fn seeds(property: &Property, files: &[File]) -> Vec<String> {
    let mut seeds = Vec::new();
    for (path, text) in files {
        if property.of_scenario && path.ends_with(".avalla") {
            let loaded = loaded_model(path, text);
            let model = files.iter().find(|(path, _)| Some(path) == loaded.as_ref()).map_or("", |(_, text)| text);
            let scenario: Vec<&str> = text
                .lines()
                .map(|line| if line.trim_start().starts_with("load ") { "load Model.asm" } else { line })
                .collect();
            seeds.push(format!("{model}{DIVIDER}{}\n", scenario.join("\n")));
        } else if !property.of_scenario && (path.ends_with(".asm") || path.ends_with(".avalla")) {
            seeds.push(text.clone());
        } else if !property.of_scenario && path.starts_with("spec/") && path.ends_with(".md") {
            seeds.extend(blocks(text));
        }
    }
    seeds
}

/// The words of a dictionary as libFuzzer reads it: one on each line, in quotes.
pub fn words(dictionary: &str) -> Vec<String> {
    let quoted =
        |line: &str| Some(line.strip_prefix('"')?.strip_suffix('"')?.replace("\\\"", "\"").replace("\\\\", "\\"));
    dictionary.lines().filter_map(|line| quoted(line.trim())).collect()
}

/// The path of the model that a scenario loads.
fn loaded_model(path: &str, scenario: &str) -> Option<String> {
    let written = scenario.lines().find_map(|line| line.trim().strip_prefix("load "))?;
    let written = written.trim().trim_matches('"');
    let mut parts: Vec<&str> = path.split('/').collect();
    parts.pop();
    for part in written.split('/') {
        match part {
            "." => {}
            ".." => {
                parts.pop()?;
            }
            part => parts.push(part),
        }
    }
    Some(parts.join("/"))
}

/// The fenced blocks of a Markdown page.
fn blocks(page: &str) -> Vec<String> {
    let mut blocks = Vec::new();
    let mut open: Option<Vec<&str>> = None;
    for line in page.lines() {
        match (&mut open, line.trim_start().starts_with("```")) {
            (None, true) => open = Some(Vec::new()),
            (Some(_), true) => blocks.extend(open.take().map(|lines| lines.join("\n") + "\n")),
            (Some(lines), false) => lines.push(line),
            (None, false) => {}
        }
    }
    blocks
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_are_taken_out_of_pages() {
        assert_eq!(blocks("a\n```asmetal\nx := 1\n```\nb\n```\ny\n```\n"), ["x := 1\n", "y\n"]);
    }

    #[test]
    fn words_are_taken_out_of_quotes() {
        assert_eq!(words("# a comment\n\"asm \"\n\n\"\\\"\"\n"), ["asm ", "\""]);
    }

    #[test]
    fn a_scenario_is_with_its_model() {
        let file = |path: &str, text: &str| (path.to_string(), text.to_string());
        let files = [file("a/M.asm", "asm M"), file("a/b/S.avalla", "scenario s\nload ../M.asm\n")];
        let of = |of_scenario| seeds(&Property { of_scenario, ..crate::ALL[0] }, &files);
        assert_eq!(of(true), ["asm M\n%%%%\nscenario s\nload Model.asm\n"]);
        assert_eq!(of(false), ["asm M", "scenario s\nload ../M.asm\n"]);
    }

    #[test]
    fn a_scenario_leads_to_its_model() {
        assert_eq!(loaded_model("a/b/S.avalla", "scenario s\nload ../M.asm\n").as_deref(), Some("a/M.asm"));
    }
}
