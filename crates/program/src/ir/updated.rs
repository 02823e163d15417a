//! Which functions a step can change.
//!
//! In: a program. Out: the functions of which some rule updates a location, or which are declared within a rule. The machine's
//! compiled code, the packing of states and generated code treat the others as constants. INVARIANT: of a function that is not
//! here no step changes a location; initial values, the environment and whoever sets values from outside still give it some.

use std::collections::BTreeSet;

use crate::ir::{Program, Rule};
use model::FunctionId;

impl Program {
    /// The functions that some rule updates or declares locally.
    pub fn updated_functions(&self) -> BTreeSet<FunctionId> {
        let mut found = BTreeSet::new();
        for rule in &self.rules {
            match rule {
                Rule::Update { function, .. } | Rule::Return { function, .. } => {
                    found.insert(*function);
                }
                Rule::Local { start, len, .. } => {
                    found.extend(&self.function_lists[*start as usize..(*start + *len) as usize]);
                }
                Rule::Skip
                | Rule::Call { .. }
                | Rule::TurboCall { .. }
                | Rule::RunValue { .. }
                | Rule::RunAgent { .. }
                | Rule::Par(_)
                | Rule::Seq(_)
                | Rule::If { .. }
                | Rule::Switch { .. }
                | Rule::Let { .. }
                | Rule::Choose { .. }
                | Rule::Forall { .. }
                | Rule::Extend { .. }
                | Rule::Iterate(_)
                | Rule::While { .. }
                | Rule::RecursiveWhile { .. } => {}
            }
        }
        found
    }
}
