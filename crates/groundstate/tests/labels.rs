//! No label of a diagnostic repeats its message: on the examples of all fault pages and on all transcripts of the
//! command line.

use std::collections::BTreeMap;
use std::sync::Arc;

use groundstate::scenario::{FirstCandidate, Options};
use groundstate::simulate::{End, Inputs, Record, Run};
use groundstate::verify::Outcome;
use groundstate::verify::review::{Meta, review};
use groundstate::workspace::{Absent, Files};
use groundstate::{Suite, Workspace};
use syntax::{Diagnostic, SourceFile};
use testkit::{Page, Texts, page, repository};

/// The examples of a page, as files.
#[derive(Clone)]
struct Examples(BTreeMap<String, String>);

impl Files for Examples {
    fn read(&mut self, path: &str) -> Result<SourceFile, Absent> {
        self.0.get(path).map(|text| SourceFile::new(path, text.as_str())).ok_or(Absent::Missing)
    }
}

/// The name of the file that a block is, by its info string.
fn file_of(info: &str, text: &str) -> Option<String> {
    if let Some((_, name)) = info.split_once("file=") {
        return Some(name.to_string());
    }
    let second = text.split_whitespace().nth(1).unwrap_or("Example");
    match info.split_whitespace().next()? {
        "asmetal" => Some(format!("{second}.asm")),
        "chart" => Some(format!("{second}.chart")),
        "avalla" => Some("example.avalla".to_string()),
        _ => None,
    }
}

fn faults_of(page: &Page) -> Vec<Diagnostic> {
    let blocks = page.blocks();
    let files: BTreeMap<String, String> =
        blocks.iter().filter_map(|block| Some((file_of(block.info, block.text)?, block.text.to_string()))).collect();
    let mut workspace = Workspace::new(Examples(files.clone()));
    let mut found = Vec::new();
    let mut loader = Texts::of(files.iter().map(|(name, text)| (name.as_str(), text.as_str())));
    for name in files.keys() {
        let checked = workspace.check(name).expect("it is there");
        found.extend(checked.faults.into_iter().flat_map(|(_, faults)| faults));
        if name.ends_with(".avalla") {
            let source = SourceFile::new(name.as_str(), files[name].as_str());
            let tested = Suite::new().test(source, &mut loader, Options::default(), &mut FirstCandidate);
            if let Some((verdict, program)) = tested.verdict.zip(tested.program) {
                let failures = verdict.failures();
                found.extend(failures.iter().flat_map(|failure| groundstate::diagnose_failure(failure, &program)));
                found.extend(verdict.remarks.iter().map(groundstate::diagnose_remark));
            }
        }
        if name.ends_with(".asm")
            && let Ok(loaded) = workspace.load(name)
        {
            ran(&loaded, &mut found);
        }
    }
    found
}

/// The diagnostics of running, reviewing and verifying a model.
fn ran(loaded: &groundstate::Loaded, found: &mut Vec<Diagnostic>) {
    let program = &loaded.program;
    if program.main.is_none() {
        return;
    }
    let options = groundstate::simulate::Options { steps: Some(10), ..Default::default() };
    let mut run = Run::new(Arc::clone(program), machine::Limits::default(), Inputs::new(), options);
    while let Some(record) = run.advance() {
        match record {
            Record::Initial { violations, .. } => {
                found.extend(violations.iter().map(|one| groundstate::diagnose_violation(one, 0, run.machine_mut())));
            }
            Record::Step(step) | Record::Attempt(step) => found.extend(
                step.violations.iter().map(|one| groundstate::diagnose_violation(one, step.step, run.machine_mut())),
            ),
            Record::End(End::Fault(fault)) => found.push(groundstate::diagnose_fault(&fault, program)),
            Record::Back { .. } | Record::End(_) => {}
        }
    }
    let bounds = groundstate::verify::Options { max_states: 1_000, ..Default::default() };
    if let Ok(review) = review(&loaded.model, program, &bounds, &Meta::ALL, &|_| true, &mut |_| true) {
        found.extend(review.findings.iter().map(|finding| groundstate::diagnose_finding(finding, &review, program)));
    }
    if let Ok(report) = groundstate::verify::verify(program, &bounds, &mut |_| true) {
        for verdict in report.verdicts {
            if let (Outcome::Violated(trace), groundstate::verify::Subject::Property(index)) =
                (verdict.outcome, verdict.subject)
            {
                found.push(groundstate::diagnose_property(&program.properties[index], &trace));
            }
        }
    }
}

#[test]
fn no_label_repeats_its_message() {
    let mut ids: Vec<&str> = Vec::new();
    for path in repository::files("spec/faults", &["md"]) {
        let id = path.file_stem().expect("a name").to_string_lossy().into_owned();
        for fault in faults_of(&Page::spec(&format!("faults/{id}"))) {
            ids.push(fault.id);
            for label in std::iter::once(&fault.primary).chain(&fault.secondary) {
                assert_ne!(label.text, fault.message, "a label of {} on the page of {id}", fault.id);
            }
        }
    }
    ids.sort_unstable();
    ids.dedup();
    assert!(ids.len() > 130, "{} kinds of faults are shown: {ids:?}", ids.len());
}

/// `error[an-id]: the message`, and below it lines that end with `^^^ the label`.
#[test]
fn no_label_of_a_transcript_repeats_its_message() {
    let mut labels = 0;
    for path in repository::files("shells/cli/tests/cmd", &["trycmd"]) {
        for block in page::blocks(&repository::text(&path)) {
            let mut message = "";
            for line in block.text.lines() {
                if let Some((head, said)) = line.split_once("]: ")
                    && ["error[", "warning[", "note["].iter().any(|word| head.starts_with(word))
                {
                    message = said;
                }
                if let Some((_, label)) = line.rsplit_once("^ ").or_else(|| line.rsplit_once("- ")) {
                    assert_ne!(label, message, "{}", path.display());
                    labels += 1;
                }
            }
        }
    }
    assert!(labels > 10, "{labels} labels");
}
