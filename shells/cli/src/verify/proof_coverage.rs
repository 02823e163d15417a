//! `verify --coverage`: what the properties that hold depend on, and what none of them does.
//!
//! In: a program, and what was found of its properties. Out: text or JSON; no verdict changes.

use std::io::Write;

use groundstate::verify::dependence::{Written, dependence};
use groundstate::verify::{Outcome, Report, Subject};
use program::{FunctionId, Program};
use wire::ProofCoverage;

use super::tell::Teller;
use crate::check::plural;
use crate::failure::Failure;
use crate::shell::Shell;

/// Tells what the properties that hold depend on.
pub fn tell(shell: &mut Shell, teller: &Teller<'_>, report: &Report) -> Result<(), Failure> {
    let (program, sources): (&Program, _) = (teller.words.program, teller.words.sources);
    let held: Vec<usize> = report
        .verdicts
        .iter()
        .filter_map(|verdict| match (verdict.subject, &verdict.outcome) {
            (Subject::Property(index), Outcome::Holds) => Some(index),
            _ => None,
        })
        .collect();
    let found = dependence(program, &held);
    if shell.json() {
        return shell.object(&ProofCoverage::new(program, sources, &found));
    }
    let name = |function: &FunctionId| program.function(*function).name.as_str();
    let updates = |all: &[Written]| all.iter().map(|written| written.updates.len()).sum::<usize>();
    let (within, outside) = (updates(&found.within), updates(&found.outside));
    writeln!(
        shell.out(),
        "coverage of {}: {} of {}, {within} of {}",
        if held.len() == 1 {
            "1 property that holds".to_string()
        } else {
            format!("{} properties that hold", held.len())
        },
        found.within.len(),
        plural(found.within.len() + found.outside.len(), "function"),
        plural(within + outside, "update"),
    )?;
    if shell.talks() {
        for cone in &found.cones {
            let on: Vec<&str> = cone.functions.iter().map(name).collect();
            let on = if on.is_empty() { "nothing that changes".to_string() } else { on.join(", ") };
            writeln!(shell.out(), "  {} depends on {on}", program.properties[cone.property].name)?;
        }
    }
    for written in &found.outside {
        writeln!(shell.out(), "  no property depends on {}", name(&written.function))?;
        for span in &written.updates {
            let file = sources.file(span.file);
            let place = file.line_column(span.start);
            let text = file.text[span.range()].split_whitespace().collect::<Vec<_>>().join(" ");
            writeln!(shell.out(), "    {}:{}:{} {text}", file.name, place.line, place.column)?;
        }
    }
    Ok(())
}
