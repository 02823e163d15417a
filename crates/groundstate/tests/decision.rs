//! Every command accepts a model exactly if `check` reports no error for it: on the models of the repository, the
//! examples of the fault pages, and mutants of all of them.

use std::path::Path;

use syntax::{Severity, SourceFile};
use testkit::page::blocks;
use testkit::{Disk, repository};

/// The ids of the errors that `check` reports; `load` must agree.
fn errors(name: &str, text: &str) -> Vec<&'static str> {
    let root = SourceFile::new(name, text);
    let checked = groundstate::check(root.clone(), &mut Disk);
    let errors = checked.diagnostics.iter().filter(|fault| fault.severity == Severity::Error);
    let errors: Vec<&str> = errors.map(|fault| fault.id).collect();
    match groundstate::load(root, &mut Disk) {
        Ok(loaded) => {
            assert_eq!(errors, [""; 0], "{name} is loaded:\n{text}");
            // An `asm` that loads has a main rule.
            let module = !text.contains("asm ");
            assert!(loaded.program.main.is_some() || module || loaded.model.main.is_none(), "{name}");
        }
        Err(_) => assert!(!errors.is_empty(), "{name} is not loaded, and nobody says why:\n{text}"),
    }
    errors
}

fn models() -> Vec<(String, String)> {
    let read = |path: &Path| (path.display().to_string(), repository::text(path));
    let files = ["library", "examples", "bench/models"].map(|folder| repository::files(folder, &["asm"])).concat();
    let mut models: Vec<(String, String)> = files.iter().map(|path| read(path)).collect();
    // Models that import all patterns take long to read, so a sample of them is tested.
    let mut count = 0;
    models.retain(|(_, text)| {
        let over_patterns = text.contains("library/");
        count += usize::from(over_patterns);
        !over_patterns || count % 8 == 1
    });
    for (name, page) in repository::files("spec/faults", &["md"]).iter().map(|path| read(path)) {
        let examples = blocks(&page).into_iter().filter(|block| block.info.starts_with("asmetal"));
        models.extend(examples.map(|block| (name.replace(".md", ".asm"), block.text.to_string())));
    }
    models
}

#[test]
fn the_models_of_the_repository() {
    for (name, text) in models() {
        errors(&name, &text);
    }
}

/// Each mutant has one token removed, one doubled, or two swapped, at places that a seed chooses.
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
