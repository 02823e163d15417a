//! The machine's use of compiled code: for the steps of a run that is long enough to pay for it, and for conditions that are asked in
//! state after state.
//!
//! In: a machine. Out: its steps, and which conditions surely hold. INVARIANT: both engines make the same steps with the same faults,
//! and a condition that code says is true the interpreter says is true. Code is thrown away as soon as something that it relies on
//! was changed from outside.

use std::sync::Arc;

use program::{Expression, ProcedureId};

use crate::engine::{
    COMPILED_AFTER, CONDITIONS_COMPILED_AFTER, Code, Conditions, EngineChoice, EngineState, OTHERS_COMPILED_AFTER, Use,
};
use crate::environment::{Closed, Environment};
use crate::execute::Executor;
use crate::fault::Fault;
use crate::machine::Machine;
use crate::native::{self, Ended, Engine, SharedCode, Subject};
use crate::step::Passed;

impl Machine {
    /// Makes steps of the main rule one after the other, until as many are made as are `wanted` in all, a domain has
    /// grown, or there was nothing to update. After each the environment is told ([`Environment::step_made`]); else
    /// nobody looks at the states between them, which makes these steps the fastest.
    ///
    /// # Errors
    /// A fault leaves the state as it was after the steps that were counted.
    pub fn pass(&mut self, wanted: u64, environment: &mut dyn Environment, passed: &mut Passed) -> Result<(), Fault> {
        while passed.steps < wanted {
            let main = self.program.main;
            let step = match main.filter(|main| self.has_code(*main)) {
                None => self.step(environment)?,
                Some(main) => match self.passes_compiled(wanted, environment, passed) {
                    Ended::Enough | Ended::Paused => return Ok(()),
                    Ended::Abandoned => {
                        self.interpret(main, environment)?;
                        self.commit()
                    }
                },
            };
            passed.count(step);
            environment.step_made();
            if step.grown || step.updates == 0 {
                break;
            }
        }
        Ok(())
    }

    /// Which engine makes the steps; [`EngineChoice::Automatic`] if nobody says.
    pub fn use_engine(&mut self, choice: EngineChoice) {
        self.engine.choice = choice;
        self.drop_code();
    }

    /// Forgets all code, and what has been counted to decide whether there should be any.
    pub(crate) fn drop_code(&mut self) {
        let watched = Arc::clone(&self.engine.conditions.watched);
        self.engine = EngineState { choice: self.engine.choice, ..EngineState::default() };
        self.watch_conditions(watched);
    }

    /// Whether there is compiled code for a procedure, compiling it when that is due.
    pub(crate) fn has_code(&mut self, procedure: ProcedureId) -> bool {
        self.look_after_disturbance();
        let choice = self.engine.choice;
        let Code { work, tried, engine, .. } = self.engine.run(procedure);
        let is_main = self.program.main == Some(procedure);
        let due = match choice {
            EngineChoice::Interpreted => false,
            EngineChoice::Compiled if is_main => true,
            _ if is_main => *work > COMPILED_AFTER,
            _ => *work > OTHERS_COMPILED_AFTER,
        };
        if !due || self.core.coverage.is_some() {
            return false;
        }
        if !*tried {
            *tried = true;
            let code = native::Code::compile(&self.program, Subject::Steps(procedure), &self.core, false);
            *engine = code.map(|code| Box::new(Engine::new(Arc::new(code))));
        }
        if choice == EngineChoice::Automatic && engine.as_ref().is_some_and(|engine| !engine.pays()) {
            *engine = None;
        }
        engine.is_some()
    }

    fn look_after_disturbance(&mut self) {
        if std::mem::take(&mut self.core.disturbed) {
            self.look_again();
        }
    }

    /// Throws code away that takes a function for a constant which has other values now. The next code relies on it no more.
    fn look_again(&mut self) {
        for code in &mut self.engine.codes {
            let changed = code.engine.as_ref().map(|engine| engine.code().unsettled(&self.core)).unwrap_or_default();
            if !changed.is_empty() {
                self.core.elsewhere.add_varying(&changed);
                (code.tried, code.engine) = (false, None);
            }
        }
        let conditions = &mut self.engine.conditions;
        let changed = conditions.engine.as_ref().map(|engine| engine.code().unsettled(&self.core)).unwrap_or_default();
        if !changed.is_empty() {
            self.core.elsewhere.add_varying(&changed);
            (conditions.tried, conditions.engine) = (false, None);
        }
    }

    /// Compiles the main rule now, to code that notes which rules run, unless another machine has done so; whether there is
    /// such code.
    pub(crate) fn compile_main(&mut self, shared: &SharedCode) -> bool {
        let Some(main) = self.program.main else { return false };
        let subject = Subject::Steps(main);
        let compile = || native::Code::compile(&self.program, subject.clone(), &self.core, true).map(Arc::new);
        let engine = match shared.get_or_compile(compile) {
            Some(code) if code.fits(&self.program, &subject, &self.core) => Some(code),
            Some(_) => compile(),
            None => None,
        };
        let code = self.engine.run(main);
        (code.tried, code.engine) = (true, engine.map(|code| Box::new(Engine::new(code))));
        code.engine.is_some()
    }

    /// The code of the main rule, if it was compiled.
    pub(crate) fn main_engine(&self) -> Option<&Engine> {
        self.engine.codes.iter().find(|code| Some(code.procedure) == self.program.main)?.engine.as_deref()
    }

    /// Computes the update set of a step that has begun by compiled code; false where it is to be interpreted.
    pub(crate) fn runs_compiled(&mut self, environment: &mut dyn Environment) -> bool {
        let Machine { program, core, limits, engine, .. } = self;
        let Some(engine) = &mut engine.codes[engine.running].engine else { return false };
        core.clear_calls();
        let mut executor = Executor { program, core, environment, limits };
        let computed = engine.run(&mut executor);
        if !computed {
            self.repeat();
        }
        computed
    }

    /// Makes steps by compiled code. One that is abandoned has begun, and is to be interpreted.
    fn passes_compiled(&mut self, wanted: u64, environment: &mut dyn Environment, passed: &mut Passed) -> Ended {
        self.discard();
        let Machine { program, core, limits, engine, .. } = self;
        let Some(engine) = &mut engine.codes[engine.running].engine else { return Ended::Enough };
        core.clear_calls();
        let before = passed.steps;
        let mut executor = Executor { program, core, environment, limits };
        let ended = engine.pass(&mut executor, self.stale, wanted, passed);
        self.steps += passed.steps - before;
        (self.settled, self.stale) = (true, true);
        if let Ended::Abandoned = ended {
            (self.settled, self.stale) = (false, false);
            self.repeat();
        }
        ended
    }

    /// From now on [`Machine::surely_holds`] is asked about these conditions on states, by their places in the list.
    pub fn watch_conditions(&mut self, watched: Arc<[Expression]>) {
        let uses = vec![Use::default(); watched.len()].into_boxed_slice();
        self.engine.conditions = Conditions { watched, uses, ..Conditions::default() };
    }

    /// Whether a watched condition is true in the present state, as compiled code finds. Where it is not known to be, [`Machine::evaluate`]
    /// tells its value: false, undef, a fault, or true after all. Nobody is asked for an input.
    pub fn surely_holds(&mut self, condition: usize) -> bool {
        self.look_after_disturbance();
        if !self.knows_condition(condition) {
            return false;
        }
        let Machine { program, core, limits, engine, .. } = self;
        let Conditions { uses, engine: Some(engine), .. } = &mut engine.conditions else { return false };
        core.clear_calls();
        let mut executor = Executor { program, core, environment: &mut Closed, limits };
        let holds = engine.surely_holds(condition, &mut executor);
        uses[condition].count(holds);
        holds
    }

    /// Whether there is code for a condition, compiling it when that is due.
    fn knows_condition(&mut self, condition: usize) -> bool {
        let choice = self.engine.choice;
        let conditions = &mut self.engine.conditions;
        conditions.asked += 1;
        let due = match choice {
            EngineChoice::Interpreted => false,
            EngineChoice::Compiled => true,
            EngineChoice::Automatic => conditions.asked > CONDITIONS_COMPILED_AFTER,
        };
        if !due || self.core.coverage.is_some() {
            return false;
        }
        if !conditions.tried {
            conditions.tried = true;
            let subject = Subject::Conditions(Arc::clone(&conditions.watched));
            let code = native::Code::compile(&self.program, subject, &self.core, false);
            conditions.engine = code.map(|code| Box::new(Engine::new(Arc::new(code))));
        }
        conditions.engine.is_some() && conditions.uses[condition].pays()
    }
}
