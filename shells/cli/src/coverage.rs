//! The coverage of a model by scenarios, as text and JSON.

use std::io::Write;

use groundstate::scenario::Items;
use groundstate::tell::uncovered;
use syntax::Sources;

use crate::failure::Failure;
use crate::shell::Shell;

/// Writes the coverage of one model.
pub fn report(shell: &mut Shell, model: &str, sources: &Sources, items: &Items) -> Result<(), Failure> {
    if shell.json() {
        return shell.object(&wire::Coverage::new(model, sources, items));
    }
    if !shell.talks() {
        return Ok(());
    }
    writeln!(shell.out(), "\ncoverage of {model}")?;
    for (kind, coverage) in items.totals() {
        let (covered, total) = (coverage.covered, coverage.total);
        if total > 0 {
            // Less than all is less than 100 %, however it is rounded.
            let percent = 100.0 * covered as f64 / total as f64;
            let percent = if covered < total { percent.min(99.9) } else { percent };
            writeln!(shell.out(), "  {kind:<9} {covered:>4} of {total:<4} {percent:>5.1} %")?;
        }
    }
    let uncovered = uncovered(sources, items);
    if !uncovered.is_empty() {
        writeln!(shell.out(), "not covered")?;
        for missing in &uncovered {
            let at = sources.position(missing.span);
            writeln!(shell.out(), "  {at}: {} of {}", missing.what, missing.rule)?;
        }
    }
    Ok(())
}
