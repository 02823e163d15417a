//! Who makes the steps of a state: the tree of decisions, machine code, or the machine.
//!
//! In: the settings, and the tree's record ([`crate::memory::record`]). Out: whether the steps are compiled, and the tree is given
//! up. INVARIANT: no maker gives other steps than another.

use machine::EngineChoice;

use crate::compiled::Compiled;
use crate::explorer::Explorer;

/// Machine code, as far as it has come.
#[derive(Debug, Default)]
pub(crate) struct Makers {
    pub compiled: Option<Box<Compiled>>,
    tried: bool,
    /// Of how many states it has made the steps.
    pub made: u64,
}

impl Explorer {
    /// Compiles the steps, after the tree has missed a state, where that is the better way; at most once.
    pub(super) fn compile_if_due(&mut self) {
        if self.makers.tried {
            return;
        }
        let due = match self.settings.engine {
            EngineChoice::Interpreted => false,
            EngineChoice::Compiled => true,
            EngineChoice::Automatic => {
                // Where another explorer of the search has compiled them, its tree has lost.
                let pays = !self.steps.tree.is_used()
                    || self.settings.code.is_made()
                    || self.steps.tree.record().loses_to_code();
                !self.settings.forgetful && pays
            }
        };
        if due {
            self.makers.tried = true;
            let Explorer { program, settings, encoding, view, starts, .. } = self;
            let compiled = Compiled::new(program, settings, encoding, view.shared(), starts);
            if compiled.is_some() {
                self.steps.tree.give_up();
            }
            self.makers.compiled = compiled.map(Box::new);
        }
    }

    /// Of how many states the steps were made by machine code.
    pub fn compiled_states(&self) -> u64 {
        self.makers.made
    }

    /// By rule, whether it has run in some step.
    pub fn executed(&self) -> Vec<bool> {
        let interpreted = self.machine.coverage().expect("counted from the beginning");
        let rules = (0..).map(program::RuleId).zip(&interpreted.executed);
        let compiled = self.makers.compiled.as_deref();
        rules.map(|(rule, count)| *count > 0 || compiled.is_some_and(|code| code.has_run(rule))).collect()
    }
}
