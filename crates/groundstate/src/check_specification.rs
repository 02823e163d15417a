//! Checks a specification against its model, for `check` and for editors.
//!
//! In: the texts of `MODEL.report.yaml` or `MODEL.verify.yaml` and of the model, and [`Files`] for what both name. Out:
//! [`Findings`]: the model's faults if it has errors, else those of the specification. A verification specification beside a chart that
//! draws a system is about that system.

use std::path::Path;

use chart::NoPictures;
use model::Loader;
use syntax::{Diagnostic, Severity, SourceFile, Sources};

use crate::asked_of_system::{check_asked_of_system, draws_system};
use crate::kind::{Kind, chart_of, model_of};
use crate::reporting::prepare_report;
use crate::workspace::{Absent, Files, Findings};
use crate::{check_verification, load};

/// Checks a specification. Without a model, nothing is checked. A file that is not named as a report specification is
/// read as a verification specification.
pub fn check_specification<F: Files + Loader>(root: &SourceFile, model: Option<SourceFile>, files: &mut F) -> Findings {
    let path = Path::new(&root.name);
    if let Some(foreign) = root.foreign {
        let mut sources = Sources::default();
        let file = sources.add(root.clone());
        let fault = Diagnostic { severity: Severity::Error, ..foreign.warning(file) };
        return Findings { faults: vec![(sources, vec![fault])], open: None };
    }
    if Kind::of(path) == Some(Kind::Verification) {
        match files.read(&chart_of(path).to_string_lossy()) {
            Ok(chart) if draws_system(&chart) => return check_asked_of_system(root, chart, files),
            Ok(_) | Err(Absent::Missing) => {}
            Err(Absent::Unreadable(reason)) => return Findings::not_checked(reason),
        }
    }
    let Some(model) = model else {
        return Findings::not_checked(format!("there is no model {}", model_of(path).display()));
    };
    let mut asked = match load(model, files) {
        Ok(loaded) => loaded.overlay(),
        Err(faulty) => return Findings { faults: vec![(faulty.sources, faulty.diagnostics)], open: None },
    };
    let faults = match Kind::of(path) {
        Some(Kind::Report) => match prepare_report(&mut asked, root.clone(), &root.name, files, &NoPictures) {
            Ok(prepared) => prepared.faults,
            Err(undrawn) => return Findings::not_checked(undrawn),
        },
        _ => check_verification(&mut asked, &root.name, &root.text),
    };
    Findings { faults: vec![(asked.sources, faults)], open: None }
}
