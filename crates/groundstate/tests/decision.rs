//! What `check` tells no error of, every command takes, and the other way round: over the models of the repository, the
//! examples of the pages of faults, and mutants of all of them.

#![allow(clippy::disallowed_methods, reason = "a test reads the repository's own models")]

use std::path::{Path, PathBuf};

use syntax::{Severity, SourceFile};

struct Disk;

impl model::Loader for Disk {
    fn load(&mut self, importer: &SourceFile, path: &str) -> Result<SourceFile, String> {
        let folder = Path::new(&importer.name).parent().unwrap_or(Path::new(""));
        let path = folder.join(if path.ends_with(".asm") { path.to_string() } else { format!("{path}.asm") });
        let text = std::fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
        Ok(SourceFile::new(path.display().to_string(), text))
    }
}

/// The ids of the errors that `check` tells; what `load` does must fit.
fn errors(name: &str, text: &str) -> Vec<&'static str> {
    let root = SourceFile::new(name, text);
    let checked = groundstate::check(root.clone(), &mut Disk);
    let errors = checked.diagnostics.iter().filter(|fault| fault.severity == Severity::Error);
    let errors: Vec<&str> = errors.map(|fault| fault.id).collect();
    match groundstate::load(root, &mut Disk) {
        Ok(loaded) => {
            assert_eq!(errors, [""; 0], "{name} is loaded:\n{text}");
            // What starts a run is there.
            let module = !text.contains("asm ");
            assert!(loaded.program.main.is_some() || module || loaded.model.main.is_none(), "{name}");
        }
        Err(_) => assert!(!errors.is_empty(), "{name} is not loaded, and nobody says why:\n{text}"),
    }
    errors
}

fn collect(folder: &Path, ending: &str, files: &mut Vec<PathBuf>) {
    let entries = std::fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.expect("an entry").path()).collect();
    paths.sort();
    for path in paths {
        if path.is_dir() {
            collect(&path, ending, files);
        } else if path.extension().is_some_and(|found| found == ending) {
            files.push(path);
        }
    }
}

fn models() -> Vec<(String, String)> {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut files = Vec::new();
    for folder in ["library", "examples", "bench/models"] {
        collect(&root.join(folder), "asm", &mut files);
    }
    // Models over all of the patterns take long to read; a fair sample of them is enough.
    let over_patterns = |path: &PathBuf| std::fs::read_to_string(path).is_ok_and(|text| text.contains("library/"));
    let mut count = 0;
    files.retain(|path| {
        count += usize::from(over_patterns(path));
        !over_patterns(path) || count % 8 == 1
    });
    let read = |path: &PathBuf| std::fs::read_to_string(path).ok().map(|text| (path.display().to_string(), text));
    let mut models: Vec<(String, String)> = files.iter().filter_map(read).collect();
    let mut pages = Vec::new();
    collect(&root.join("spec/faults"), "md", &mut pages);
    for (name, page) in pages.iter().filter_map(read) {
        let blocks = page.split("\n```asmetal").skip(1).filter_map(|rest| rest.split_once('\n')?.1.split_once("```"));
        models.extend(blocks.map(|(text, _)| (name.replace(".md", ".asm"), text.to_string())));
    }
    models
}

#[test]
fn the_models_of_the_repository() {
    for (name, text) in models() {
        errors(&name, &text);
    }
}

/// Each mutant has one token less, one twice, or two exchanged, at places that a seed chooses.
#[test]
fn mutants_of_these() {
    let mut seed = 7_u64;
    let mut random = |below: usize| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) as usize % below.max(1)
    };
    for (name, text) in models().iter().filter(|(_, text)| text.len() < 3_000 && !text.contains("library/")) {
        let words: Vec<&str> = text.split_inclusive([' ', '\n', '\t', '(', ')', '[', ']', ',']).collect();
        let (one, other) = (random(words.len()), random(words.len()));
        let mut mutant: Vec<&str> = words.clone();
        match random(3) {
            0 => _ = mutant.remove(one),
            1 => mutant.insert(other, words[one]),
            _ => mutant.swap(one, other),
        }
        errors(name, &mutant.concat());
    }
}

#[test]
fn what_lowering_refuses_is_told() {
    let text = "asm A import StandardLibrary signature: controlled k: Integer controlled r: Rule(Integer) definitions: \
                rule r_set($l in Integer) = $l := 1 \
                main rule r_Main = let ($r = <<r_set(Integer)>>) in $r[3 + 1] endlet default init s: function k = 0";
    assert_eq!(errors("A.asm", text), ["not-a-location"]);
}

#[test]
fn an_asm_without_main_rule_is_told() {
    assert_eq!(errors("A.asm", "asm A signature: definitions:"), ["no-main-rule"]);
    assert_eq!(errors("A.asm", "module A export * signature: definitions:"), [""; 0]);
}

#[test]
fn a_formula_without_meaning_is_told() {
    let text = "asm A import StandardLibrary import CTLLibrary import LTLLibrary signature: controlled b: Boolean \
                definitions: CTLSPEC g(b) main rule r_Main = b := true default init s: function b = true";
    assert_eq!(errors("A.asm", text), ["mixed-logics"]);
}
