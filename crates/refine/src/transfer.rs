//! What a proof of refinement says of runs: which states of a concrete run correspond, and how the two runs keep step.
//!
//! In: a product whose game is won. Out: a [`Transfer`], by which [`crate::preserve`] decides which properties come along. The same game
//! is played again by stricter rules: what is still won then is what the abstract machine can keep to. INVARIANT: each answer is what
//! holds for every run of the concrete machine, never for one that was met.

use program::PropertyKind;

use crate::CONCRETE;
use crate::coupling::Coupling;
use crate::coupling::FairTerm;
use crate::game::{Parents, Rules, solve, solve_fairly};
use crate::product::Product;

/// Which concrete states correspond to abstract ones.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ends {
    /// All that the concrete machine comes to.
    Every,
    /// Those at the ends of segments, which the coupling names; and initial ones.
    Segments,
    /// Some, and nothing says which.
    Some,
}

/// See the module.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Transfer {
    /// Which states correspond.
    pub ends: Ends,
    /// An initial state is none that the coupling names as the end of a segment.
    pub begins_inside: bool,
    /// No diagram needs several abstract steps: no abstract state is passed over.
    pub each: bool,
    /// The concrete machine never goes on for ever while the abstract one makes no step, and has a step in every state.
    pub live: bool,
    /// Diagrams of one step each are enough.
    pub exact: bool,
}

impl Transfer {
    /// Of a proof that knows no runs: by the diagrams that the coupling allows, whichever of them are used.
    pub(crate) fn of_allowed(coupling: &Coupling) -> Transfer {
        let diagrams = &coupling.diagrams;
        let stands = coupling.waiting || coupling.variant.is_some();
        let stands = stands && diagrams.0.iter().any(|diagram| *diagram.m.start() == 0);
        let properties = &coupling.programs[CONCRETE].properties;
        // An assumption may leave a state without a step.
        let goes_on = !coupling.overflow && !properties.iter().any(|property| property.kind == PropertyKind::Invar);
        let ends = if diagrams.most_concrete() == 1 { Ends::Every } else { Ends::Some };
        let each = diagrams.0.iter().all(|diagram| *diagram.m.end() <= 1);
        let live = each && goes_on && !(stands && coupling.waiting);
        let exact = live && ends == Ends::Every && !stands;
        Transfer { ends, begins_inside: false, each, live, exact }
    }

    /// Of a product whose game is won by the coupling's rules.
    pub(crate) fn of(product: &mut Product<'_>, parents: &Parents) -> Transfer {
        let rules = Rules::of(product, false);
        let is_won = |product: &Product<'_>, rules: Rules| solve(product, parents, rules).won;
        let single = Rules { most_n: 1, ..rules };
        let segments = product.judge.coupling.segment.is_some();
        // A run that ends within a diagram, where assumptions leave no step, passes through states that correspond to nothing.
        let breaks_off = product.sides[CONCRETE].has_dead_end() && product.judge.coupling.diagrams.most_concrete() > 1;
        let (ends, rules) = match !breaks_off && is_won(product, single) {
            true => (Ends::Every, single),
            false if segments && product.judge.marks_clearly(&mut product.sides) => (Ends::Segments, rules),
            false => (Ends::Some, rules),
        };
        let each = Rules { most_m: 1, ..rules };
        // Formulas of the concrete model are about the runs that are fair by its own words, not by those of the coupling.
        let conditions = product.judge.coupling.fair.iter().enumerate();
        let own = conditions.filter(|(_, fair)| matches!(fair.term, FairTerm::Own(_)));
        let own: Vec<usize> = own.map(|(place, _)| place).collect();
        let live = Rules { waiting: false, ..each };
        let exact = Rules { least_m: 1, ..live };
        // A state without a step is one in which a run stays for ever; the proof says nothing of that.
        let goes_on = !product.sides[CONCRETE].has_dead_end();
        let begun: Vec<u32> = product.begun.iter().map(|(_, state, _)| *state).collect();
        let begins_inside = begun.into_iter().any(|state| !product.judge.ends(&mut product.sides, state));
        let each_holds = is_won(product, each);
        let live_holds = each_holds && goes_on && solve_fairly(product, parents, live, own.clone()).won;
        let exact_holds = live_holds && ends == Ends::Every && solve_fairly(product, parents, exact, own).won;
        Transfer { ends, begins_inside, each: each_holds, live: live_holds, exact: exact_holds }
    }
}
