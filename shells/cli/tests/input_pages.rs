//! Each kind of fault in a file beside the model (inputs, report specification, verification specification, coupling) has a page
//! in spec/faults/, whose example shows it.

#![allow(clippy::disallowed_methods, reason = "the pages are files, and so is what is given to the command")]

use std::process::Command;

fn block<'p>(page: &'p str, info: &str) -> &'p str {
    let (_, rest) = page.split_once(&format!("```{info}\n")).expect("a block");
    rest.split_once("```").expect("the block ends").0
}

#[test]
fn every_fault_has_a_page_that_shows_it() {
    let inputs = &["run", "Lamp.asm", "--input", "file.yaml"][..];
    let specification = &["report", "Lamp.asm", "--spec", "file.yaml", "--steps", "1"][..];
    let verification = &["verify", "Lamp.asm", "--spec", "file.yaml"][..];
    let kinds = [
        ("bad-input-file", inputs),
        ("bad-input-value", inputs),
        ("unknown-input", inputs),
        ("bad-report-specification", specification),
        ("bad-verification-file", verification),
    ];
    for (id, arguments) in kinds {
        let path = format!("{}/../../spec/faults/{id}.md", env!("CARGO_MANIFEST_DIR"));
        let page = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
        assert!(page.starts_with(&format!("# {id}\n")), "the page of {id} has another title");
        let folder = tempfile::tempdir().expect("a temporary folder");
        let write = |name: &str, text| std::fs::write(folder.path().join(name), text).expect("a file");
        write("Lamp.asm", block(&page, "asmetal"));
        write("file.yaml", block(&page, "yaml fault"));
        let output = Command::new(env!("CARGO_BIN_EXE_groundstate"))
            .args(arguments)
            .current_dir(folder.path())
            .output()
            .expect("it starts");
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(said.contains(&format!("error[{id}]")), "{id}: {said}");
        assert_eq!(output.status.code(), Some(2));
    }
}

#[test]
fn every_fault_of_a_coupling_has_a_page_that_shows_it() {
    for id in ["bad-coupling", "input-not-coupled", "vacuous-refinement"] {
        let path = format!("{}/../../spec/faults/{id}.md", env!("CARGO_MANIFEST_DIR"));
        let page = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
        let folder = tempfile::tempdir().expect("a temporary folder");
        let write = |name: &str, text| std::fs::write(folder.path().join(name), text).expect("a file");
        let abstractly = block(&page, "asmetal");
        let concrete = page.contains("```asmetal concrete");
        let concretely = if concrete { block(&page, "asmetal concrete") } else { abstractly };
        let [one, other] = [abstractly, concretely].map(|text| {
            let name = format!("{}.asm", text.split_whitespace().nth(1).expect("a name"));
            write(&name, text);
            name
        });
        write("file.refine", block(&page, "refine fault"));
        let output = Command::new(env!("CARGO_BIN_EXE_groundstate"))
            .args(["refine", &one, &other, "--with", "file.refine"])
            .current_dir(folder.path())
            .output()
            .expect("it starts");
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(said.contains(&format!("error[{id}]")), "{id}: {said}");
        assert_eq!(output.status.code(), Some(2));
    }
}
