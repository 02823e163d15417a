//! Couplings at renames: what a coupling says of two machines, by names that it writes and by names that both have.
//!
//! In: a project, a coupling file, a name that is to change. Out: the edits of its places, or why it cannot change. INVARIANT: what a coupling
//! compares is the same after a rename. What both machines have by one name is compared by that name, though no file writes it.

use groundstate::refine::Coupling;
use groundstate::workspace::Files;
use model::Referent;

use crate::analysis::Symbol;
use crate::coupling::{all_named, literals, models};
use crate::position::Edit;
use crate::project::Project;

/// The edits of a coupling that writes a name.
///
/// # Errors
/// What the name means there is not known, or it means something in each machine.
pub(super) fn edits<F: Files>(
    project: &mut Project<F>,
    file: &str,
    from: &str,
    to: &str,
    symbol: &Symbol,
) -> Result<Vec<Edit>, String> {
    let analysis = project.analysis(file).map_err(|absent| absent.told(file))?;
    let mut edits = Vec::new();
    for named in all_named(project, &analysis, from) {
        let line = analysis.source().line_column(named.range.0).line;
        match named.symbols().as_slice() {
            [] if models(project, &analysis).iter().all(Option::is_some) => {}
            [] => {
                return Err(format!("{file}:{line} writes `{from}`, and which models it speaks of is not known"));
            }
            [one] if one == symbol => edits.push(Edit::new(named.range.0..named.range.1, to)),
            several if several.contains(symbol) => {
                return Err(format!(
                    "{file}:{line} names something of each machine by `{from}`: couple it by terms first"
                ));
            }
            _ => {}
        }
    }
    Ok(edits)
}

/// Refuses to rename a literal that a coupling of two machines takes for one of both: literals are equal by their names.
///
/// # Errors
/// It is such a literal.
pub(super) fn no_literal_is_of_both<F: Files>(
    project: &mut Project<F>,
    file: &str,
    referent: Referent,
    from: &str,
    symbol: &Symbol,
) -> Result<(), String> {
    if !matches!(referent, Referent::Literal(..)) {
        return Ok(());
    }
    let analysis = project.analysis(file).map_err(|absent| absent.told(file))?;
    let models = models(project, &analysis).into_iter().flatten();
    let literals =
        models.flat_map(|model| literals(&model, from).into_iter().map(move |literal| model.symbol(literal)));
    let literals: Vec<Symbol> = literals.collect();
    match literals.contains(symbol) && literals.iter().any(|other| other != symbol) {
        true => Err(format!("{file} compares two machines, and takes `{from}` of both for the same: rename by hand")),
        false => Ok(()),
    }
}

/// What a coupling says but for its terms.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Says {
    same: Vec<String>,
    inputs: Vec<String>,
    free: Vec<String>,
    left_out: Vec<String>,
    parts: usize,
}

/// What a coupling says, with a name changed; none if its models or itself are at fault.
pub(super) fn says<F: Files>(project: &mut Project<F>, file: &str, from: &str, to: &str) -> Option<Says> {
    let coupling = project.coupling(file)?;
    let Coupling { same, inputs, free, left_out, .. } = &coupling;
    let changed = |names: &mut dyn Iterator<Item = &String>| {
        let mut names: Vec<String> = names.map(|name| if name == from { to } else { name }.to_string()).collect();
        names.sort();
        names
    };
    Some(Says {
        same: changed(&mut same.iter()),
        inputs: changed(&mut inputs.iter()),
        free: changed(&mut free.iter()),
        left_out: changed(&mut left_out.iter().map(|left| &left.name)),
        parts: coupling.conjuncts(),
    })
}
