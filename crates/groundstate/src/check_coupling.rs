//! Checks a coupling file (`NAME.refine`), for `check` and for editors: its form, and if it names both models what it says of them.
//!
//! In: the file's text and a [`Loader`] for the models. Out: [`Findings`]. The faults of the models are theirs, and are not told here.

use std::sync::Arc;

use machine::Limits;
use model::Loader;
use program::Program;
use refine::{Coupling, SIDES, bad_coupling, read};
use syntax::{FileId, SourceFile, Sources};

use crate::load;
use crate::workspace::Findings;

/// Checks a coupling.
pub fn check_coupling(root: &SourceFile, loader: &mut dyn Loader) -> Findings {
    let mut found = written_well(root, loader);
    if let Some(foreign) = root.foreign {
        let mut sources = Sources::default();
        let file = sources.add(root.clone());
        found.faults.insert(0, (sources, vec![foreign.warning(file)]));
    }
    found
}

/// The coupling's own text.
fn sources_of(root: &SourceFile) -> Sources {
    let mut sources = Sources::default();
    sources.add(root.clone());
    sources
}

fn written_well(root: &SourceFile, loader: &mut dyn Loader) -> Findings {
    let written = match read(FileId(0), &root.text) {
        Ok(written) => written,
        Err(fault) => return Findings { faults: vec![(sources_of(root), vec![*fault])], open: None },
    };
    let mut programs: Vec<Arc<Program>> = Vec::new();
    for (side, named) in written.models.iter().enumerate() {
        let Some(named) = named else {
            return Findings::not_checked(format!("it does not name the {} model", SIDES[side]));
        };
        let source = match loader.load(root, &named.text) {
            Ok(source) => source,
            Err(reason) => {
                let fault = bad_coupling(named.span, reason.to_string());
                return Findings { faults: vec![(sources_of(root), vec![*fault])], open: None };
            }
        };
        match load(source, loader) {
            Ok(loaded) => programs.push(loaded.program),
            Err(_) => return Findings::not_checked(format!("{} has faults", named.text)),
        }
    }
    match Coupling::new([&programs[0], &programs[1]], Some(root.clone()), &Limits::default()) {
        Ok(_) => Findings { faults: Vec::new(), open: None },
        Err(faulty) => Findings { faults: vec![(faulty.sources, faulty.faults)], open: None },
    }
}
