//! A coupling as a judge: what refines as it is must refine with the mutant, too.
//!
//! In: the path of a coupling file that names both of its models. Out: whether the concrete model refines the abstract one, by the texts
//! as they are now. INVARIANT: a mutant is killed only by a refutation, or if the question says nothing any more; what is not
//! decided is open.

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::Arc;

use machine::Interrupt;
use refine::{CONCRETE, Coupling, Options, SIDES, Trouble, Verdict, read, refine};
use syntax::{Diagnostic, FileId, Sources};

use super::Extent;
use crate::workspace::{Files, NotLoaded, tidy};
use crate::{Faulty, Workspace, assume, fingerprint, text_fingerprint};

/// A coupling that judges.
#[derive(Debug)]
pub(super) struct Link {
    pub path: String,
    /// The paths of its models.
    pub models: Vec<String>,
    /// The paths of the texts that these have.
    pub files: BTreeSet<String>,
    /// A fingerprint of its own text and of these.
    pub print: String,
}

/// What a coupling says.
pub(super) enum Says {
    /// The concrete model refines the abstract one.
    Refines,
    /// It does not: so many steps of the concrete model show it. Or nothing is left to refine.
    DoesNot(u64),
    /// That is not known, for this reason.
    Open(String),
    /// It cannot be asked: why, and the faults.
    Unfit(String, Sources, Vec<Diagnostic>),
}

/// The paths of the texts that the models of a coupling have; none if it cannot be asked.
pub(super) fn files<F: Files>(path: &str, workspace: &mut Workspace<F>) -> BTreeSet<String> {
    let Ok(file) = workspace.text(path) else { return BTreeSet::new() };
    let Ok(written) = read(FileId(0), &file.text) else { return BTreeSet::new() };
    let named = written.models.iter().flatten().map(|named| beside(path, &named.text));
    let loaded = named.filter_map(|model| workspace.load(&model).ok());
    loaded.flat_map(|loaded| loaded.sources.iter().map(|(_, file)| tidy(&file.name)).collect::<Vec<_>>()).collect()
}

/// A path that stands in the file at another one.
fn beside(path: &str, named: &str) -> String {
    tidy(&Path::new(path).parent().unwrap_or(Path::new("")).join(named).to_string_lossy())
}

/// Asks a coupling by the texts as they are; the texts that it is about, and what it says.
pub(super) fn ask<F: Files>(
    path: &str,
    workspace: &mut Workspace<F>,
    extent: &Extent,
    interrupt: &Interrupt,
) -> (Link, Says) {
    let mut link = Link { path: path.to_string(), models: vec![], files: BTreeSet::new(), print: String::new() };
    let said = asked(&mut link, workspace, extent, interrupt).unwrap_or_else(|unfit| *unfit);
    (link, said)
}

fn asked<F: Files>(
    link: &mut Link,
    workspace: &mut Workspace<F>,
    extent: &Extent,
    interrupt: &Interrupt,
) -> Result<Says, Box<Says>> {
    let unfit = |why: String| Box::new(Says::Unfit(why, Sources::default(), Vec::new()));
    let file = workspace.text(&link.path).map_err(|absent| unfit(absent.told(&link.path)))?;
    link.print = format!("{} {}", link.path, text_fingerprint(&file.text));
    let written = read(FileId(0), &file.text).map_err(|fault| {
        let mut sources = Sources::default();
        sources.add(file.clone());
        Box::new(Says::Unfit("has faults".to_string(), sources, vec![*fault]))
    })?;
    let mut programs = Vec::new();
    let mut options = Options { max_pairs: extent.max_states, ..Options::default() };
    for (side, named) in written.models.iter().enumerate() {
        let Some(named) = named else { return Err(unfit(format!("does not name the {} model", SIDES[side]))) };
        let model = beside(&link.path, &named.text);
        let loaded = workspace.load(&model).map_err(|not| match not {
            NotLoaded::Absent(absent) => unfit(absent.told(&model)),
            NotLoaded::Faulty(faulty) => {
                let Faulty { sources, diagnostics } = *faulty;
                Box::new(Says::Unfit(format!("is about {model}, which has faults"), sources, diagnostics))
            }
        })?;
        link.files.extend(loaded.sources.iter().map(|(_, file)| tidy(&file.name)));
        link.print += &format!(" {}", fingerprint(&loaded.sources));
        if loaded.program.main.is_none() {
            return Err(unfit(format!("is about {model}, which has no main rule")));
        }
        let spec = Path::new(&model).with_extension("verify.yaml");
        let beside = workspace.text(&spec.to_string_lossy()).ok();
        if let Some(beside) = &beside {
            link.print += &format!(" {}", text_fingerprint(&beside.text));
        }
        let assumptions = assume(&loaded, beside.as_ref(), &[]).map_err(|trouble| {
            let (sources, faults) = *trouble;
            Box::new(Says::Unfit(format!("is about {model}, whose .verify.yaml has faults"), sources, faults))
        })?;
        assumptions.put(&mut options.extents[side]);
        programs.push(Arc::clone(&assumptions.model.program));
        link.models.push(model);
    }
    let coupling = Coupling::new([&programs[0], &programs[1]], Some(file), &extent.limits)
        .map_err(|faulty| Box::new(Says::Unfit("has faults".to_string(), faulty.sources, faulty.faults)))?;
    for side in &mut options.extents {
        (side.limits, side.interrupt) = (extent.limits.clone(), interrupt.clone());
    }
    Ok(match refine(&coupling, &options, &mut |_| !interrupt.is_raised()) {
        Err(Trouble::Fault(..)) => Says::DoesNot(0),
        Err(Trouble::Unbounded(..)) => Says::Open("its initial states cannot be listed".to_string()),
        Err(Trouble::Stopped(_)) => Says::Open("the time was up".to_string()),
        Err(Trouble::Refused(_)) => unreachable!("a checkpoint is refused where there is one"),
        Ok(report) => match report.verdict {
            Verdict::Refines => Says::Refines,
            Verdict::DoesNot(refutation) => Says::DoesNot(refutation.runs[CONCRETE].steps.len() as u64),
            Verdict::Vacuous(_) => Says::DoesNot(0),
            Verdict::Unknown(_) if interrupt.is_raised() => Says::Open("the time was up".to_string()),
            Verdict::Unknown(_) => Says::Open("the refinement could not be decided".to_string()),
        },
    })
}
