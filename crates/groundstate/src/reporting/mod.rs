//! Makes the report of a run: checks the specification against the model, then follows the run step by step.
//!
//! In: a report specification, an [`Overlay`] of its model, [`Files`] for the charts that it names; the records of a
//! run. Out: a [`Report`], or all faults of the specification. The shell adds to the report what else it knows of the
//! run.

mod charts;
mod counted;
mod derived;
mod evidence;
mod of_model;
mod recorded;
mod refinement;
mod watch;
mod watched;

use std::sync::Arc;

use chart::{NotDrawn, Pictures};
use model::{Loader, PropertyKind};
use program::Program;
use report::{Invariant, Report, ReportBuilder, Specification, read_specification};
use simulate::{End, Record, Run, Violation};
use syntax::{Diagnostic, SourceFile, Sources};

use crate::workspace::Files;
use crate::{Overlay, diagnose_fault, has_errors};
use watch::Watch;

pub use counted::{Counted, counted_inputs, counted_times};
pub use derived::{specification_beside, system_beside};
pub use evidence::{reported_coverage, reported_scenario};
pub use recorded::{held_in_words, run_name};
pub use refinement::{NoPage, refinement_page};
pub use watched::Watched;

/// The result of reading a specification.
#[derive(Debug)]
pub struct Prepared {
    /// Ready for a run; `None` if a fault is an error.
    pub reporter: Option<Reporter>,
    /// The faults of the specification and of the charts that it names.
    pub faults: Vec<Diagnostic>,
}

/// Reads a specification and checks it against its model. Files that it names are looked up beside it.
///
/// # Errors
/// A chart that it names cannot be drawn.
pub fn prepare_report<F: Files + Loader>(
    asked: &mut Overlay,
    specification: SourceFile,
    path: &str,
    files: &mut F,
    pictures: &dyn Pictures,
) -> Result<Prepared, NotDrawn> {
    let text = Arc::clone(&specification.text);
    let file = asked.add(specification);
    let mut wanted = match read_specification(file, &text) {
        Ok(wanted) => wanted,
        Err(faults) => return Ok(Prepared { reporter: None, faults }),
    };
    let mut faults = charts::add(files, &mut asked.sources, &mut wanted, (path, ""), pictures)?;
    if has_errors(&faults) {
        return Ok(Prepared { reporter: None, faults });
    }
    match Reporter::new(asked, wanted) {
        Ok(reporter) => Ok(Prepared { reporter: Some(reporter), faults }),
        Err(found) => {
            faults.extend(found);
            Ok(Prepared { reporter: None, faults })
        }
    }
}

/// Follows a run and makes its report.
#[derive(Debug)]
pub struct Reporter {
    builder: ReportBuilder,
    watch: Watch,
    program: Arc<Program>,
    invariants: Vec<Invariant>,
    stopped: Option<String>,
    at_fault: bool,
    interrupted: bool,
}

impl Reporter {
    fn new(asked: &mut Overlay, wanted: Specification) -> Result<Reporter, Vec<Diagnostic>> {
        let Specification { spec, places, .. } = wanted;
        let builder = ReportBuilder::new(spec);
        let watch = Watch::new(asked, builder.terms(), &places)?;
        Ok(Reporter {
            builder,
            watch,
            program: Arc::clone(&asked.program),
            invariants: invariants(&asked.program, &asked.sources),
            stopped: None,
            at_fault: false,
            interrupted: false,
        })
    }

    /// Records what `run` has just done.
    pub fn note(&mut self, record: &Record, run: &mut Run, sources: &Sources) {
        match record {
            Record::Initial { violations, .. } => {
                self.violated(violations, "in the initial state", sources);
                self.watch.look(run.machine_mut(), &mut self.builder);
                self.builder.begin();
            }
            Record::Step(step) => {
                self.violated(&step.violations, &format!("first in step {}", step.step), sources);
                self.watch.look(run.machine_mut(), &mut self.builder);
                self.builder.step();
            }
            Record::Attempt(step) => {
                self.violated(&step.violations, &format!("first in step {}", step.step), sources);
            }
            Record::End(End::Fault(fault)) => {
                let found = diagnose_fault(fault, &self.program);
                let place = sources.position(found.primary.span);
                self.stopped = Some(format!("step {} could not be made: {} ({place})", run.steps() + 1, found.message));
                self.at_fault = true;
            }
            Record::End(End::Interrupted) => {
                self.stopped = Some(format!("the run was interrupted after step {}", run.steps()));
                self.interrupted = true;
            }
            Record::Back { .. } | Record::End(_) => {}
        }
    }

    fn violated(&mut self, violations: &[Violation], when: &str, sources: &Sources) {
        for violation in violations {
            let position = sources.position(violation.span).to_string();
            let known = self.invariants.iter_mut().find(|known| known.position == position);
            if let Some(invariant) = known.filter(|known| known.violated.is_none()) {
                invariant.violated = Some(when.to_string());
            }
            self.at_fault = true;
        }
    }

    /// Whether the run met a fault or violated an invariant.
    pub fn is_at_fault(&self) -> bool {
        self.at_fault
    }

    /// Whether the run was stopped from outside.
    pub fn was_interrupted(&self) -> bool {
        self.interrupted
    }

    /// The report of what was recorded.
    pub fn finish(self) -> Report {
        let mut report = self.builder.finish(&self.program.name);
        report.invariants = self.invariants;
        report.stopped = self.stopped;
        report
    }
}

fn invariants(program: &Program, sources: &Sources) -> Vec<Invariant> {
    let invariants = program.properties.iter().filter(|property| property.kind == PropertyKind::Invariant);
    let invariant = |name: &str, position: String| Invariant { name: name.to_string(), position, violated: None };
    invariants.map(|property| invariant(&property.name, sources.position(property.span).to_string())).collect()
}
