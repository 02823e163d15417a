//! The initial state: contents of dynamic domains, initial values, programs of agents.
//!
//! It is the default one, or the only one that the model has. INVARIANT: the program of a subset of `Agent` comes
//! before that of `Agent`, so an agent's program is the first one whose domain holds the agent.

use model::{DomainKind, Init};

use crate::ir::AgentProgram;
use crate::lower::Lowering;

impl<'m> Lowering<'m, '_> {
    /// Adds the initial state, if the model has one.
    pub(super) fn lower_initial_state(&mut self) {
        let model = self.model;
        let only = (model.inits.len() == 1).then_some(0);
        let Some(init) = model.default_init.or(only).and_then(|index| model.inits.get(index)) else { return };
        self.lower_initial_contents(init);
        self.lower_initial_values(init);
        self.lower_agents(init);
    }

    fn lower_agents(&mut self, init: &'m Init) {
        for agent in &init.agents {
            let procedure = self.procedure_by_value(agent.rule);
            self.program.agents.push(AgentProgram { domain: agent.domain, procedure });
        }
        let domains = &self.model.domains;
        self.program.agents.sort_by_key(|agent| !matches!(domains.kind(agent.domain), DomainKind::Concrete { .. }));
    }
}
