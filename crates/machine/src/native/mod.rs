//! The compiled engine: a procedure that makes steps, mostly the main rule, as machine code.
//!
//! In: a program and a started machine. Out: code that computes the update set of a step on the machine's own store
//! and update set, by Cranelift. It computes what the interpreter ([`crate::perform`], [`crate::evaluate`]) computes
//! as long as nothing is at fault. Where a step meets a fault, or anything that is not translated in full, it is
//! *abandoned*: rolled back and interpreted, with the inputs and choices already made. So each fault is told by one
//! piece of code, and a program needs no translation for what is rare. See docs/adr/0003-compiled-engine.md.
#![allow(unsafe_code)]

mod anatomy;
mod arithmetic;
mod binder;
mod cases;
mod code;
mod commit;
mod comprehension;
mod constant;
mod context;
mod facts;
mod gathered;
mod grounds;
mod helper;
mod items;
mod kleene;
mod location;
mod memory;
mod nesting;
mod numbered;
mod plan;
mod rule;
mod runtime;
mod settled;
mod shape;
mod term;
mod translate;
mod unit;
mod unused;

use std::sync::{Arc, OnceLock};

use crate::execute::Executor;
use crate::step::Passed;
pub(crate) use code::{Code, Subject};
pub(crate) use commit::apply;
use context::Context;
pub(crate) use facts::is_solid;
use memory::Memory;

/// LIMIT: after so many steps the share of abandoned ones decides whether the code is used further.
const TRIAL: u64 = 64;

/// The code of a program's main rule, for machines that make its steps side by side or one after the other: the first that needs
/// it compiles it.
#[derive(Debug, Clone, Default)]
pub struct SharedCode(Arc<OnceLock<Option<Arc<Code>>>>);

impl SharedCode {
    /// Whether some machine has compiled it.
    pub fn is_made(&self) -> bool {
        matches!(self.0.get(), Some(Some(_)))
    }

    pub(crate) fn get_or_compile(&self, compile: impl FnOnce() -> Option<Arc<Code>>) -> Option<Arc<Code>> {
        self.0.get_or_init(compile).clone()
    }
}

/// Compiled code with what one machine needs to run it.
pub(crate) struct Engine {
    code: Arc<Code>,
    memory: Memory,
    runs: u64,
    abandoned: u64,
}

impl std::fmt::Debug for Engine {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Engine").field("runs", &self.runs).field("abandoned", &self.abandoned).finish_non_exhaustive()
    }
}

impl Engine {
    /// For a machine that the code fits.
    pub fn new(code: Arc<Code>) -> Engine {
        let memory = Memory::new(Arc::clone(&code.numbered));
        Engine { code, memory, runs: 0, abandoned: 0 }
    }

    /// What it runs.
    pub fn code(&self) -> &Code {
        &self.code
    }

    /// Whether a condition is surely true in the present state, outside a step or before its commit. Where it is not, nothing is known.
    pub fn surely_holds(&mut self, condition: usize, executor: &mut Executor<'_>) -> bool {
        let Some(entry) = self.code.entries[condition] else { return false };
        // SAFETY: the memory outlives the context, and nothing else uses it.
        let mut context = unsafe { Context::new(&raw mut self.memory) };
        context.look(executor.core);
        context.begin(executor);
        let held = context.held;
        // SAFETY: as in `compute`.
        let status = unsafe { entry(&raw mut context) };
        debug_assert_eq!(context.held, held, "a condition updates nothing");
        context.enter(executor.core);
        self.clear(&mut context);
        status == 0
    }

    /// Forgets what an entry left that gave up.
    fn clear(&mut self, context: &mut Context) {
        context.release(0);
        context.drop_candidates();
        self.memory.clear();
    }

    /// Whether running the code has paid so far.
    pub fn pays(&self) -> bool {
        self.runs < TRIAL || self.abandoned * 8 < self.runs
    }

    /// Computes the update set of a step; false where the step must be rolled back and interpreted instead.
    pub fn run(&mut self, executor: &mut Executor<'_>) -> bool {
        // SAFETY: the memory outlives the context, and nothing else uses it.
        let mut context = unsafe { Context::new(&raw mut self.memory) };
        context.look(executor.core);
        context.begin(executor);
        self.compute(&mut context, executor)
    }

    /// Makes steps until there are as many as `wanted`; the inputs of the last one are forgotten
    /// first if they are `stale`.
    pub fn pass(&mut self, executor: &mut Executor<'_>, stale: bool, wanted: u64, passed: &mut Passed) -> Ended {
        let program = executor.program;
        // SAFETY: the memory outlives the context, and nothing else uses it.
        let mut context = unsafe { Context::new(&raw mut self.memory) };
        let mut stale = stale;
        context.look(executor.core);
        while passed.steps < wanted {
            if std::mem::replace(&mut stale, true) && executor.core.forget_inputs(program) {
                context.look(executor.core);
            }
            executor.core.begin_step();
            context.begin(executor);
            if !self.compute(&mut context, executor) {
                return Ended::Abandoned;
            }
            let step = executor.core.commit(program);
            passed.count(step);
            executor.environment.step_made();
            if step.grown || step.updates == 0 {
                return Ended::Paused;
            }
        }
        Ended::Enough
    }

    #[inline]
    fn compute(&mut self, context: &mut Context, executor: &mut Executor<'_>) -> bool {
        let Some(entry) = self.code.entries[0] else { return false };
        self.runs += 1;
        let former = self.code.myself.map(|index| executor.core.store.values[index as usize].clone());
        // SAFETY: the context refers to the executor and the memory, which outlive this call; while the code runs
        // nothing else uses them. The code was compiled for this program and this layout of the store.
        let status = unsafe { entry(&raw mut *context) };
        context.enter(executor.core);
        if status == 0 {
            debug_assert!(context.temporary == 0 && context.candidate == 0);
            return true;
        }
        self.abandoned += 1;
        self.clear(context);
        if let (Some(index), Some(value)) = (self.code.myself, former) {
            executor.core.store.values[index as usize] = value;
        }
        false
    }
}

/// Why compiled code stopped making steps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Ended {
    /// As many were made as were wanted.
    Enough,
    /// The last one made a domain grow, or had nothing to update.
    Paused,
    /// The next one has begun and cannot be computed to its end.
    Abandoned,
}
