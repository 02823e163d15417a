//! Each kind of fault of a scenario has a page in spec/faults/, and the page's example yields it.

use groundstate::scenario::{FirstCandidate, Options};
use groundstate::{Suite, diagnose_failure};
use syntax::SourceFile;

/// Every kind of fault that scenarios have beyond those of models and of running them.
const IDS: [&str; 14] = [
    "ambiguous-pick",
    "bound-reached",
    "check-failed",
    "duplicate-block",
    "expected-failure",
    "invariant-violated",
    "pick-no-candidate",
    "recursive-block",
    "too-many-commands",
    "unknown-block",
    "unknown-model",
    "unknown-pick",
    "unknown-scenario",
    "unused-pick",
];

/// The one model of a page.
struct OneModel(String);

impl model::Loader for OneModel {
    fn load(&mut self, _importer: &SourceFile, path: &str) -> Result<SourceFile, String> {
        match path {
            "Lamp.asm" => Ok(SourceFile::new("Lamp.asm", self.0.as_str())),
            other => Err(format!("there is no file {other}")),
        }
    }
}

fn block<'p>(page: &'p str, info: &str) -> &'p str {
    let (_, rest) = page.split_once(&format!("```{info}\n")).unwrap_or_else(|| panic!("no block {info} in {page}"));
    rest.split_once("```").expect("the block ends").0
}

fn faults_of(page: &str) -> Vec<String> {
    let mut loader = OneModel(block(page, "asmetal").to_string());
    let scenario = SourceFile::new("example.avalla", block(page, "avalla fault"));
    let tested = Suite::new().test(scenario, &mut loader, Options::default(), &mut FirstCandidate);
    let Some((verdict, program)) = tested.verdict.zip(tested.program) else {
        return tested.diagnostics.iter().map(|fault| format!("{}: {}", fault.id, fault.message)).collect();
    };
    let failures = verdict.failures().iter().flat_map(|failure| diagnose_failure(failure, &program));
    let failures = failures.map(|fault| format!("{}: {}", fault.id, fault.message));
    failures.chain(verdict.remarks.iter().map(|remark| format!("unused-pick: {}", remark.message))).collect()
}

#[test]
#[allow(clippy::disallowed_methods, reason = "the pages are files")]
fn every_fault_has_a_page_that_shows_it() {
    for id in IDS {
        let path = format!("{}/../../spec/faults/{id}.md", env!("CARGO_MANIFEST_DIR"));
        let page = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
        assert!(page.starts_with(&format!("# {id}\n")), "the page of {id} has another title");
        let faults = faults_of(&page);
        let ids: Vec<&str> = faults.iter().filter_map(|fault| fault.split(':').next()).collect();
        assert_eq!(ids, [id], "{faults:#?}");
    }
}
