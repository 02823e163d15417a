//! Describes what solvers looked at of runs from the initial states, for a refinement.
//!
//! In: how far they looked, the words for the two models. Out: lines. INVARIANT: that no run of so many steps is refuted is said in the
//! name of those that say so.

use refine::{Left, Origin, Runs};

use super::proof::{joined, named, said};
use super::{Refinements, plural};

/// LIMIT: what may be looked for by hand.
const FURTHER: &str = "  look further: `--depth N`; or prove it: `--method induction`";

impl Refinements<'_> {
    /// Why it is not known, as a clause.
    pub fn no_run(&self, runs: &Runs) -> String {
        let steps = |steps: &u64| plural(*steps as usize, "step");
        match &runs.left {
            None => none_refuted(runs),
            Some(Left::Outside(origin, outside)) => {
                format!("solvers are not told of {}", self.named(*origin, outside))
            }
            Some(Left::Beyond(most, outside)) => {
                let what = self.named(Origin::Side(refine::CONCRETE), outside);
                format!("in a run of {} the machine may come to what solvers are not told of: {what}", steps(most))
            }
            Some(Left::Silent(most, _)) => format!("not all solvers decide about runs of {}", steps(most)),
            Some(Left::Odd(most)) => format!(
                "a solver found a run of {} that the machines do not make or that refutes nothing, which is a bug of this program or, where \
                 reals are computed, of rounding",
                steps(most)
            ),
            Some(Left::Unclear(most, why)) => {
                format!("a solver found a run of {} that cannot be made again: {}", steps(most), self.why(why))
            }
            Some(Left::Stopped) => "stopped".to_string(),
        }
    }

    /// The lines about runs that solvers looked for.
    pub(super) fn sought(&self, runs: &Runs, after_proof: bool) -> Vec<String> {
        let by = joined(&named(&runs.solvers));
        if let Some((steps, solver)) = &runs.found {
            let solver = joined(&named(std::slice::from_ref(solver)));
            let steps = plural(*steps as usize, "step");
            return vec![format!("  found by   {solver}: a run of {steps}, which both machines make again")];
        }
        let mut lines = Vec::new();
        if let Some((steps, solver)) = &runs.reached {
            let solver = joined(&named(std::slice::from_ref(solver)));
            lines.push(match steps {
                0 => format!("  {solver} says that an initial pair is such a one"),
                _ => format!("  {solver} says that a run of {} comes to such a pair", plural(*steps as usize, "step")),
            });
        } else if let Some(steps) = runs.apart {
            let steps = plural(steps as usize, "step");
            lines.push(format!("  no run of at most {steps} comes to such a pair, by {by}"));
        }
        let is_told = !after_proof && runs.left.is_none();
        if runs.depth > 0 {
            lines.push(match is_told {
                true => format!("  looked at  all runs of at most {}, by {by}", plural(runs.depth as usize, "step")),
                false => format!("  {}, by {by}", none_refuted(runs)),
            });
        }
        match &runs.left {
            Some(left) if after_proof && *left != Left::Stopped => lines.push(format!("  {}", self.no_run(runs))),
            None if !after_proof => lines.push(FURTHER.to_string()),
            _ => {}
        }
        if let Some(Left::Silent(_, all)) = &runs.left {
            for (solver, word) in runs.solvers.iter().zip(all) {
                lines.push(format!("  {solver} says: {}", said(word)));
            }
        }
        lines
    }
}

fn none_refuted(runs: &Runs) -> String {
    format!("no run of at most {} of the concrete machine is refuted", plural(runs.depth as usize, "step"))
}
