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
    /// It may have made steps and do so no more; it still knows which rules have run.
    compiled: Option<Box<Compiled>>,
    tried: bool,
    /// Of how many states it has made the steps.
    made: u64,
    /// Of how many it did not know them.
    unknown: u64,
}

/// LIMIT: states of which machine code has made the steps before the tree is given up for it, or of which it has not
/// known them before it is asked no more.
const TRIAL: u64 = 64;

impl Makers {
    /// The code, unless it was asked in vain too often.
    pub fn code(&mut self) -> Option<&mut Compiled> {
        let useless = self.unknown >= TRIAL && self.unknown > self.made;
        self.compiled.as_deref_mut().filter(|_| !useless)
    }
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
            self.makers.compiled = compiled.map(Box::new);
        }
    }

    /// Counts a state that the code was asked about; it takes over from the tree once it has shown that it knows steps.
    pub(super) fn count_compiled(&mut self, known: bool) {
        match known {
            true => self.makers.made += 1,
            false => self.makers.unknown += 1,
        }
        if known && self.makers.made == TRIAL {
            self.steps.tree.give_up();
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
