//! The compiled engine: a procedure that makes steps, mostly the main rule, as machine code.
//!
//! In: a program and a started machine. Out: code that computes the update set of a step on the machine's own store
//! and update set, by Cranelift. It computes what the interpreter ([`crate::perform`], [`crate::evaluate`]) computes
//! as long as nothing is at fault. Where a step meets a fault, or anything that is not translated in full, it is
//! *abandoned*: rolled back and interpreted, with the inputs and choices already made. So each fault is told by one
//! piece of code, and a program needs no translation for what is rare. See docs/adr/0003-compiled-engine.md.
#![allow(unsafe_code)]

mod arithmetic;
mod binder;
mod commit;
mod context;
mod helper;
mod kleene;
mod location;
mod memory;
mod plan;
mod rule;
mod runtime;
mod shape;
mod term;
mod total;
mod translate;
mod unit;

use std::sync::atomic::Ordering;

use cranelift_codegen::ir::{InstBuilder, UserFuncName, types};
use cranelift_codegen::settings::{self, Configurable};
use cranelift_frontend::{FunctionBuilder, FunctionBuilderContext};
use cranelift_jit::{JITBuilder, JITModule};
use cranelift_module::{FuncId, Linkage, Module, default_libcall_names};
use program::{ProcedureId, Program, RuleId};

use crate::execute::{Core, Executor};
use crate::step::Passed;
pub(crate) use commit::apply;
use context::Context;
use helper::{Helpers, signature};
use plan::{Fixed, Plan, Tables, UnitKey};
use translate::Translator;

/// The compiled entry: the context, to a status that is not zero where the step is abandoned.
type Entry = unsafe extern "C" fn(*mut Context) -> i64;

/// LIMIT: after so many steps the share of abandoned ones decides whether the code is used further.
const TRIAL: u64 = 64;

/// A program's main rule, or another procedure without parameters that makes steps, compiled.
pub(crate) struct Engine {
    entry: Entry,
    /// Where `self` is kept.
    myself: Option<u32>,
    tables: Tables,
    runs: u64,
    abandoned: u64,
    /// Owns the code.
    module: Option<JITModule>,
}

impl std::fmt::Debug for Engine {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Engine").field("runs", &self.runs).field("abandoned", &self.abandoned).finish_non_exhaustive()
    }
}

impl Drop for Engine {
    fn drop(&mut self) {
        if let Some(module) = self.module.take() {
            // SAFETY: the code runs only within `run`, which borrows the engine.
            unsafe { module.free_memory() };
        }
    }
}

impl Engine {
    /// Compiles a procedure for a started machine; none on a machine that Cranelift has no code for. The code notes which
    /// rules run if that is wanted.
    pub fn compile(program: &Program, main: ProcedureId, core: &Core, notes_rules: bool) -> Option<Engine> {
        let mut flags = settings::builder();
        flags.set("opt_level", "speed").ok()?;
        flags.set("is_pic", "false").ok()?;
        flags.set("enable_verifier", if cfg!(debug_assertions) { "true" } else { "false" }).ok()?;
        let isa = cranelift_native::builder().ok()?.finish(settings::Flags::new(flags)).ok()?;
        let mut builder = JITBuilder::with_isa(isa, default_libcall_names());
        Helpers::register(&mut builder);
        let mut module = JITModule::new(builder);
        let helpers = Helpers::declare(&mut module)?;
        let mut plan = Plan::new(program, main, core, helpers);
        if notes_rules {
            plan.note_rules(program);
        }

        let entry = signature(&module, &[types::I64], &[types::I64]);
        let entry = module.declare_function("entry", Linkage::Local, &entry).ok()?;
        let mut scratch = FunctionBuilderContext::new();
        define(program, &mut module, &mut plan, &mut scratch, None, main, entry)?;
        while let Some((key, id)) = plan.queue.pop() {
            define(program, &mut module, &mut plan, &mut scratch, Some(key), main, id)?;
        }
        module.finalize_definitions().ok()?;
        let code = module.get_finalized_function(entry);
        // SAFETY: the code was just defined with this signature.
        let entry = unsafe { std::mem::transmute::<*const u8, Entry>(code) };
        let myself = plan.self_location(program);
        Some(Engine { entry, myself, tables: plan.tables, runs: 0, abandoned: 0, module: Some(module) })
    }

    /// Whether running the code has paid so far.
    pub fn pays(&self) -> bool {
        self.runs < TRIAL || self.abandoned * 8 < self.runs
    }

    /// Whether a rule has run in some step, as far as that is noted.
    pub fn has_run(&self, rule: RuleId) -> bool {
        self.tables.ran.get(rule.0 as usize).is_some_and(|ran| ran.load(Ordering::Relaxed) != 0)
    }

    /// Computes the update set of a step; false where the step must be rolled back and interpreted instead.
    pub fn run(&mut self, executor: &mut Executor<'_>) -> bool {
        // SAFETY: the tables outlive the context, and nothing else uses them.
        let mut context = unsafe { Context::new(&raw mut self.tables) };
        context.look(executor.core);
        context.begin(executor);
        self.compute(&mut context, executor)
    }

    /// Makes steps until there are as many as `wanted`; the inputs of the last one are forgotten
    /// first if they are `stale`.
    pub fn pass(&mut self, executor: &mut Executor<'_>, stale: bool, wanted: u64, passed: &mut Passed) -> Ended {
        let program = executor.program;
        // SAFETY: the tables outlive the context, and nothing else uses them.
        let mut context = unsafe { Context::new(&raw mut self.tables) };
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
        self.runs += 1;
        let former = self.myself.map(|index| executor.core.store.values[index as usize].clone());
        // SAFETY: the context refers to the executor and the tables, which outlive this call; while the code runs
        // nothing else uses them. The code was compiled for this program and this layout of the store.
        let status = unsafe { (self.entry)(&raw mut *context) };
        context.enter(executor.core);
        if status == 0 {
            debug_assert!(context.temporary == 0 && context.candidate == 0);
            return true;
        }
        context.release(0);
        context.drop_candidates();
        self.abandoned += 1;
        self.tables.clear();
        if let (Some(index), Some(value)) = (self.myself, former) {
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

/// Builds one function: the entry, or a unit.
fn define(
    program: &Program,
    module: &mut JITModule,
    plan: &mut Plan,
    scratch: &mut FunctionBuilderContext,
    key: Option<UnitKey>,
    main: ProcedureId,
    id: FuncId,
) -> Option<()> {
    let mut code = module.make_context();
    code.func.signature = match key {
        Some(key) => unit::unit_signature(program, module, key),
        None => signature(module, &[types::I64], &[types::I64]),
    };
    code.func.name = UserFuncName::user(0, id.as_u32());
    {
        let mut builder = FunctionBuilder::new(&mut code.func, scratch);
        let start = builder.create_block();
        builder.append_block_params_for_function_params(start);
        builder.switch_to_block(start);
        let parameters = builder.block_params(start).to_vec();
        let mut translator = Translator::new(builder, module, plan, program, parameters[0]);
        match key {
            Some(key) => translator.unit(key, &parameters[1..]),
            None => {
                translator.main(main);
                let good = translator.word(0);
                translator.builder.ins().return_(&[good]);
                translator.switch(translator.bail);
                let bad = translator.word(1);
                translator.builder.ins().return_(&[bad]);
            }
        }
        translator.builder.seal_all_blocks();
        translator.builder.finalize();
    }
    module.define_function(id, &mut code).ok()?;
    module.clear_context(&mut code);
    Some(())
}
