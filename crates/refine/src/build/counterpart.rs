//! Which function of the concrete machine is one of the abstract machine, where nothing says so.
//!
//! In: a function. Out: the one that has its name and its domains. Overloads differ in their domains; functions that export lists hide from
//! each other may not.

use program::FunctionId;
use syntax::Diagnostic;

use crate::build::{Builder, is_state};
use crate::coupling::{Incomparable, start};
use crate::fault::bad_coupling;
use crate::{ABSTRACT, CONCRETE, SIDES};

impl Builder {
    /// Why no function of the concrete machine is one of the abstract machine that is part of its state; none if no other one has its name.
    pub(super) fn incomparable(&self, here: FunctionId) -> Option<Incomparable> {
        let named = |side: usize| {
            let all = (0..).map(FunctionId).zip(&self.coupling.programs[side].functions);
            let name = &self.coupling.programs[ABSTRACT].function(here).name;
            all.filter(move |(_, one)| one.name == *name && is_state(one)).map(|(id, _)| id)
        };
        let has_counterpart = |there: &FunctionId| {
            named(ABSTRACT).any(|one| self.domains(ABSTRACT, one) == self.domains(CONCRETE, *there))
        };
        let arity = |side: usize, id| self.coupling.programs[side].function(id).parameters.len();
        let there = named(CONCRETE).filter(|there| !has_counterpart(there));
        let there = there.min_by_key(|there| arity(CONCRETE, *there).abs_diff(arity(ABSTRACT, here)))?;
        let arities = [arity(ABSTRACT, here), arity(CONCRETE, there)];
        match arities[ABSTRACT] == arities[CONCRETE] {
            true => self.other_domain(here, there).map(Incomparable::Domains),
            false => Some(Incomparable::Arguments(arities)),
        }
    }

    /// The function of the concrete machine that has the name and the domains of one of the abstract machine, if there is one of that kind.
    ///
    /// # Errors
    /// Several have, and it cannot be told which is meant: export lists can hide them from each other.
    pub(super) fn counterpart(
        &self,
        here: FunctionId,
        is_meant: fn(&program::Function) -> bool,
    ) -> Result<Option<FunctionId>, Diagnostic> {
        let function = self.coupling.programs[ABSTRACT].function(here);
        let domains = self.domains(ABSTRACT, here);
        let alike = |side: usize| -> Vec<(FunctionId, &str)> {
            let all = (0..).map(FunctionId).zip(&self.coupling.programs[side].functions);
            let named = all.filter(|(_, one)| one.name == function.name && is_meant(one));
            let alike = named.filter(|(id, _)| self.domains(side, *id) == domains);
            alike.map(|(id, one)| (id, one.module.as_str())).collect()
        };
        let [ours, theirs] = [alike(ABSTRACT), alike(CONCRETE)];
        // Those of one module belong together.
        let of_module = |all: &[(FunctionId, &str)], module: &str| all.iter().filter(|one| one.1 == module).count();
        let in_both = |one: &(FunctionId, &str)| of_module(&ours, one.1) == 1 && of_module(&theirs, one.1) == 1;
        if in_both(&(here, &function.module)) {
            return Ok(theirs.iter().find(|one| one.1 == function.module).map(|one| one.0));
        }
        // So do those of the models' own files, and the only ones besides.
        let rest = |side: usize, all: &[(FunctionId, &str)]| -> (Vec<FunctionId>, Vec<FunctionId>) {
            let program = &self.coupling.programs[side];
            let file = program.main.map(|main| program.procedure(main).span.file);
            let left = all.iter().filter(|one| !in_both(one)).map(|one| one.0);
            left.partition(|id| Some(program.function(*id).span.file) == file)
        };
        let [(own, others), (their_own, their_others)] = [rest(ABSTRACT, &ours), rest(CONCRETE, &theirs)];
        let (ours, theirs) = match (own.is_empty() || their_own.is_empty(), own.contains(&here)) {
            (true, _) => ([own, others].concat(), [their_own, their_others].concat()),
            (false, true) => (own, their_own),
            (false, false) => (others, their_others),
        };
        match (&ours[..], &theirs[..]) {
            (_, []) => Ok(None),
            ([_], [there]) => Ok(Some(*there)),
            _ => {
                let side = SIDES[if theirs.len() > 1 { CONCRETE } else { ABSTRACT }];
                let message = format!(
                    "the {side} machine has several functions `{}` with the same domains, of which a coupling cannot say which it means",
                    function.name
                );
                Err(bad_coupling(start(self.coupling.file), message).with_help("give each a name of its own"))
            }
        }
    }
}
