//! Which engine makes the steps of a machine, and how far the compiled one has come.
//!
//! In: steps made and conditions asked. Out: what there is code for, and whether it has paid so far; [`crate::compiled`] uses it.

use std::sync::Arc;

use program::{Expression, ProcedureId};

use crate::native::Engine;
use crate::step::Step;

/// What makes the steps. Both give the same steps and the same faults.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum EngineChoice {
    /// Interpreted at first, compiled once the run has become long enough to pay for it.
    #[default]
    Automatic,
    /// The program is walked over.
    Interpreted,
    /// Machine code from the first step on, where there is any for this processor.
    Compiled,
}

/// LIMIT: steps made, and an eighth of their updates, before the main rule is compiled.
pub(crate) const COMPILED_AFTER: u64 = 256;
/// LIMIT: the same of another procedure, most of which make few steps.
pub(crate) const OTHERS_COMPILED_AFTER: u64 = 1 << 16;
/// LIMIT: how often conditions are asked before they are compiled, all together.
pub(crate) const CONDITIONS_COMPILED_AFTER: u64 = 1 << 13;
/// LIMIT: after so many questions the share of those that code left open decides whether it is asked further.
const TRIAL: u64 = 64;

/// The compiled engine, as far as it has come.
#[derive(Debug, Default)]
pub(crate) struct EngineState {
    pub choice: EngineChoice,
    /// One a procedure that has made steps, in the order in which they came up.
    pub codes: Vec<Code>,
    /// The one that makes the present step.
    pub running: usize,
    pub conditions: Conditions,
}

/// A procedure that makes steps.
#[derive(Debug)]
pub(crate) struct Code {
    pub procedure: ProcedureId,
    /// Steps made, and an eighth of their updates.
    pub work: u64,
    pub tried: bool,
    pub engine: Option<Box<Engine>>,
}

/// Conditions on states that are asked again and again.
#[derive(Debug)]
pub(crate) struct Conditions {
    pub watched: Arc<[Expression]>,
    /// By condition.
    pub uses: Box<[Use]>,
    /// How often any was asked.
    pub asked: u64,
    pub tried: bool,
    pub engine: Option<Box<Engine>>,
}

impl Default for Conditions {
    fn default() -> Conditions {
        Conditions { watched: Arc::from([]), uses: Box::default(), asked: 0, tried: false, engine: None }
    }
}

/// How the code of a condition has done.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Use {
    asked: u64,
    open: u64,
}

impl Use {
    pub fn count(&mut self, known: bool) {
        self.asked += 1;
        self.open += u64::from(!known);
    }

    /// Whether asking has paid so far.
    pub fn pays(self) -> bool {
        self.asked < TRIAL || self.open * 8 < self.asked
    }
}

impl EngineState {
    /// From now on this procedure makes the step.
    pub fn run(&mut self, procedure: ProcedureId) -> &mut Code {
        if self.codes.get(self.running).is_none_or(|code| code.procedure != procedure) {
            let known = self.codes.iter().position(|code| code.procedure == procedure);
            self.running = known.unwrap_or(self.codes.len());
            if known.is_none() {
                self.codes.push(Code { procedure, work: 0, tried: false, engine: None });
            }
        }
        &mut self.codes[self.running]
    }

    /// The procedure that made the present step has made it.
    pub fn count(&mut self, step: Step) {
        if let Some(code) = self.codes.get_mut(self.running) {
            code.work += 1 + step.updates as u64 / 8;
        }
    }
}
