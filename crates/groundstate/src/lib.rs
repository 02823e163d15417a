//! The whole flow in one place: text → checked model → program → a run, a verdict.
//!
//! In: the root file's text and a [`model::Loader`] that finds the others. Out: the result of each stage, with all
//! faults, including run-time faults, as [`syntax::Diagnostic`]s. Shells build on this crate and use only types of the
//! crates below. It must not know files, terminals or wire formats.

mod asked_of_system;
mod assumptions;
mod avalla;
mod build;
mod check_coupling;
mod check_specification;
mod check_verification;
mod counterexample;
mod decide;
mod fault;
mod fingerprint;
pub mod job;
mod kind;
pub mod mutation;
mod overlay;
mod owed;
mod owed_leaving;
pub mod patterns;
mod picked;
mod proof_on_part;
pub mod reporting;
pub mod session;
pub mod tell;
mod test;
pub mod test_generation;
mod verified_system;
mod verify_preserved;
mod whole_run;
pub mod workspace;

use std::collections::BTreeMap;
use std::sync::Arc;

use model::{Checked, Loader, Model};
use program::{Program, Rule, RuleId};
use syntax::ast::AstNode;
use syntax::{Diagnostic, Severity, SourceFile, Sources, Span};

pub use asked_of_system::{check_asked_of_system, draws_system, libraries_of, refusal, words, words_of};
pub use assumptions::{Assumptions, OPTION as ASSUME, assume, terms_of};
pub use avalla::leaves_out;
pub use build::{BuiltChart, Located, build_chart};
pub use check_coupling::{check_coupling, coupling_of};
pub use check_specification::check_specification;
pub use check_verification::check_verification;
pub use counterexample::{counterexample_run, counterexample_scenario};
pub use fault::IDS as FAULT_IDS;
pub use fault::review::{REVIEW_IDS, diagnose_finding};
pub use fault::run::{diagnose_fault, diagnose_no_main, diagnose_record, diagnose_violation};
pub use fault::scenario::{diagnose_failure, diagnose_remark};
pub use fault::verification::{
    diagnose_idle, diagnose_outside, diagnose_property, diagnose_unbounded, diagnose_unreachable, short_place,
};
pub use fingerprint::{fingerprint, text_fingerprint};
pub use kind::{Kind, chart_of, has_ending, model_of};
pub use overlay::{Overlay, Said};
pub use owed::{Owed, OwedProof, owed};
pub use owed_leaving::{Leaving, Stuck, StuckAt, leaving};
pub use proof_on_part::{PartQuestion, PartSearch, ProofOnPart, SystemParts};
pub use test::{SeededChoices, Suite, Tested, own_files};
pub use verified_system::{
    AgedWay, GroundRun, ReducedSystem, SureAge, VerifiedSystem, aged_system, aged_ways, not_kept, reduced_system,
    verified_system,
};
pub use verify_preserved::verify_preserved;
pub use workspace::Workspace;
pub use {
    chart, conform, generate, inputs, machine, model, mutate, program, refine, report, scenario, simulate, solve,
    syntax, verify,
};

/// A model that is ready to run. It never changes: use an [`Overlay`] to add terms and properties.
#[derive(Debug, Clone)]
pub struct Loaded {
    /// All texts that were read.
    pub sources: Sources,
    /// The checked model.
    pub model: Arc<Model>,
    /// The program to run.
    pub program: Arc<Program>,
    /// Warnings and notes.
    pub diagnostics: Vec<Diagnostic>,
}

/// Why a text cannot be used.
#[derive(Debug, Clone)]
pub struct Faulty {
    /// All texts that were read.
    pub sources: Sources,
    /// The faults, at least one of them an error.
    pub diagnostics: Vec<Diagnostic>,
}

/// Checks a model, its lowering and its temporal properties. If it reports no error, [`load`] accepts the model.
pub fn check(root: SourceFile, loader: &mut dyn Loader) -> Checked {
    decide::decide(root, loader).checked
}

/// Whether any of these is an error.
pub fn has_errors(diagnostics: &[Diagnostic]) -> bool {
    diagnostics.iter().any(|diagnostic| diagnostic.severity == Severity::Error)
}

/// Checks a model like [`check`], and returns the program to run.
///
/// # Errors
/// The model has errors.
pub fn load(root: SourceFile, loader: &mut dyn Loader) -> Result<Loaded, Box<Faulty>> {
    let decide::Decision { checked, program } = decide::decide(root, loader);
    let Checked { sources, model, diagnostics } = checked;
    match program {
        Some(program) => Ok(Loaded { sources, model: Arc::new(model), program: Arc::new(program), diagnostics }),
        None => Err(Box::new(Faulty { sources, diagnostics })),
    }
}

/// Loads the model again as if its root also imported these libraries, for example `CTLLibrary`. Returns `None` if the
/// root has them already, or if the result has errors, such as a clash of names. The root's lines keep their numbers.
pub fn with_libraries(loaded: &Loaded, libraries: &[&str], loader: &mut dyn Loader) -> Option<Loaded> {
    let root = loaded.sources.file(loaded.model.root);
    let there = |library: &str| loaded.sources.iter().any(|(_, file)| file.name == format!("<std>/{library}.asm"));
    let missing: Vec<&str> = libraries.iter().copied().filter(|library| !there(library)).collect();
    if missing.is_empty() {
        return None;
    }
    let parse = syntax::parse_asmetal(loaded.model.root, &root.text);
    let name = syntax::ast::SourceFile::cast(parse.syntax())?.machine_name()?;
    let end = usize::from(name.syntax().text_range().end());
    let (before, after) = root.text.split_at(end);
    let imports: String = missing.iter().map(|library| format!(" import {library}")).collect();
    load(SourceFile::new(root.name.clone(), format!("{before}{imports}{after}")), loader).ok()
}

/// The variables that each choose rule binds, keyed by the rule's place.
pub fn choice_variables(program: &Program) -> BTreeMap<Span, Vec<String>> {
    let mut found = BTreeMap::new();
    for procedure in &program.procedures {
        let mut open: Vec<RuleId> = vec![procedure.body];
        while let Some(id) = open.pop() {
            if let Rule::Choose { binders, .. } = program.rule(id) {
                let slots = program.binder_list(*binders).iter().map(|binder| binder.slot.0 as usize);
                let names = slots.map(|slot| procedure.names[slot].clone()).collect();
                found.insert(program.rule_span(id), names);
            }
            program.each_child_of_rule(id, &mut |child| open.push(child));
        }
    }
    found
}
