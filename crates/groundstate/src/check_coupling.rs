//! Checks a coupling file (`NAME.refine`), for `check` and for editors: its form, and if it names both models what it says of them.
//!
//! In: the file's text and a [`Loader`] for the models. Out: [`Findings`]. The faults of the models are theirs, and are not told here.

use std::sync::Arc;

use machine::Limits;
use model::Loader;
use program::Program;
use refine::{Coupling, SIDES, bad_coupling, read};
use syntax::{Diagnostic, FileId, SourceFile, Sources};

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
    coupling_of(root, loader).err().map_or_else(Findings::default, |found| *found)
}

/// The coupling of the two models that a file names.
///
/// # Errors
/// What is wrong with it, or why it was not checked.
pub fn coupling_of(root: &SourceFile, loader: &mut dyn Loader) -> Result<Coupling, Box<Findings>> {
    let faulty =
        |fault: Box<Diagnostic>| Box::new(Findings { faults: vec![(sources_of(root), vec![*fault])], open: None });
    let written = read(FileId(0), &root.text).map_err(faulty)?;
    let mut programs: Vec<Arc<Program>> = Vec::new();
    for (side, named) in written.models.iter().enumerate() {
        let Some(named) = named else {
            return Err(Box::new(Findings::not_checked(format!("it does not name the {} model", SIDES[side]))));
        };
        let source = loader.load(root, &named.text);
        let source = source.map_err(|reason| faulty(bad_coupling(named.span, reason.to_string())))?;
        match load(source, loader) {
            Ok(loaded) => programs.push(loaded.program),
            Err(_) => return Err(Box::new(Findings::not_checked(format!("{} has faults", named.text)))),
        }
    }
    let coupling = Coupling::new([&programs[0], &programs[1]], Some(root.clone()), &Limits::default());
    coupling.map_err(|faulty| Box::new(Findings { faults: vec![(faulty.sources, faulty.faults)], open: None }))
}
