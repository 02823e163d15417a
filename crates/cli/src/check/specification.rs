//! What is to be shown of a model, `MODEL.report.yaml`, and what is to be verified of it, `MODEL.verify.yaml`: its form, and
//! its terms against the model beside it.

use std::path::Path;

use groundstate::reporting::prepare_report;
use syntax::SourceFile;

use super::Seen;
use crate::failure::Failure;
use crate::files::{Disk, has_ending};

/// Looks at a specification.
pub fn look(path: &Path, root: &SourceFile, disk: &mut Disk) -> Result<Seen, Failure> {
    let report = has_ending(path, "report.yaml");
    if !report && !has_ending(path, "verify.yaml") {
        return Err(Failure::usage_with_help(
            format!("{} is no specification by its name", path.display()),
            "what a report shows is called MODEL.report.yaml, what is verified MODEL.verify.yaml, beside MODEL.asm",
        ));
    }
    // `Model.report.yaml` is of `Model.asm`.
    let model = path.with_extension("").with_extension("asm");
    let source = match disk.root(&model) {
        Ok(source) => source,
        Err(Failure::Missing(_)) => {
            let open = format!("not checked: there is no model {}", model.display());
            return Ok(Seen { open: Some(open), ..Seen::default() });
        }
        Err(failure) => return Err(failure),
    };
    let mut asked = match groundstate::load(source, disk) {
        Ok(loaded) => loaded.overlay(),
        Err(faulty) => return Ok(Seen::of(faulty.sources, faulty.diagnostics)),
    };
    let faults = match report {
        true => {
            let prepared = prepare_report(&mut asked, root.clone(), &root.name, disk);
            prepared.map_err(|fault| Failure::usage(fault.to_string()))?.faults
        }
        false => groundstate::check_verification(&mut asked, &root.name, &root.text),
    };
    Ok(Seen::of(asked.sources, faults))
}
