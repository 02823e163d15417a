//! The machine code of a procedure that makes steps, or of conditions on states.
//!
//! In: a program and a started machine. Out: code for every machine of that program that agrees in the [`Facts`] the code
//! relies on. INVARIANT: the code does not change, and what it changes belongs to the machine that runs it; only the
//! marks of the rules that have run are shared.

use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};

use cranelift_codegen::ir::{UserFuncName, types};
use cranelift_codegen::settings::{self, Configurable};
use cranelift_frontend::{FunctionBuilder, FunctionBuilderContext};
use cranelift_jit::{ArenaMemoryProvider, JITBuilder, JITModule};
use cranelift_module::{FuncId, Linkage, Module, default_libcall_names};
use program::{Expression, FunctionId, ProcedureId, Program, RuleId};

use crate::execute::Core;
use crate::native::context::Context;
use crate::native::facts::Facts;
use crate::native::helper::{Helpers, signature};
use crate::native::nesting::UnitKey;
use crate::native::numbered::Numbered;
use crate::native::plan::Plan;
use crate::native::settled::unsettled;
use crate::native::translate::Translator;
use crate::native::unit;
use crate::native::unused::drop_unused_loads;
use crate::weighed::Items;

/// A compiled entry: the context, to a status. It is zero where the step has been computed, or the condition is true, and not where
/// the step is abandoned, or it is not known whether the condition is true.
pub(super) type Entry = unsafe extern "C" fn(*mut Context) -> i64;

/// What is compiled.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Subject {
    /// A procedure that makes steps.
    Steps(ProcedureId),
    /// Conditions on states, each with an entry of its own.
    Conditions(Arc<[Expression]>),
}

/// See the module.
pub(crate) struct Code {
    program: Arc<Program>,
    subject: Subject,
    facts: Facts,
    /// One for a procedure; for conditions one each, none where a condition asks somebody.
    pub(super) entries: Box<[Option<Entry>]>,
    /// Where `self` is kept.
    pub(super) myself: Option<u32>,
    pub(super) numbered: Arc<Numbered>,
    /// By rule, 1 where it has run; empty where that is not noted.
    ran: Box<[AtomicU8]>,
    /// What the code refers to.
    _pinned: Vec<Arc<Items>>,
    _owner: Owner,
}

impl std::fmt::Debug for Code {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Code").field("subject", &self.subject).finish_non_exhaustive()
    }
}

/// Owns the code's memory, and gives it back.
struct Owner(Option<JITModule>);

// SAFETY: nothing looks at the module between the making of the code and its end, when its one owner is dropped. Its memory is
// the provider's that Cranelift comes with: pages of the system, which any thread may give back.
unsafe impl Send for Owner {}
// SAFETY: as above; there is nothing that a reference to it could be used for.
unsafe impl Sync for Owner {}

impl Drop for Owner {
    fn drop(&mut self) {
        if let Some(module) = self.0.take() {
            // SAFETY: an engine that runs the code holds it, so nothing does any more.
            unsafe { module.free_memory() };
        }
    }
}

/// LIMIT: bytes of the address space for one program's code. Functions call each other by distances of 32 bits, which memory from
/// anywhere may exceed once the process has gigabytes; this is in one piece. Only what is written takes memory.
const ROOM: usize = 64 << 20;

impl Code {
    /// Compiles for a started machine; none on a processor that Cranelift has no code for, or where there is no room for it.
    /// The code notes which rules run if that is wanted.
    pub fn compile(program: &Arc<Program>, subject: Subject, core: &Core, notes_rules: bool) -> Option<Code> {
        let mut flags = settings::builder();
        flags.set("opt_level", "speed").ok()?;
        flags.set("is_pic", "false").ok()?;
        flags.set("enable_verifier", if cfg!(debug_assertions) { "true" } else { "false" }).ok()?;
        let isa = cranelift_native::builder().ok()?.finish(settings::Flags::new(flags)).ok()?;
        let mut builder = JITBuilder::with_isa(isa, default_libcall_names());
        builder.memory_provider(Box::new(ArenaMemoryProvider::new_with_size(ROOM).ok()?));
        Helpers::register(&mut builder);
        let mut module = JITModule::new(builder);
        let helpers = Helpers::declare(&mut module)?;
        let main = if let Subject::Steps(procedure) = &subject { Some(*procedure) } else { None };
        let mut plan = Plan::new(program, main, core, helpers);
        if notes_rules {
            plan.note_rules(program);
        }

        let bodies: Vec<Option<Body<'_>>> = match &subject {
            Subject::Steps(procedure) => vec![Some(Body::Steps(*procedure))],
            Subject::Conditions(conditions) => conditions
                .iter()
                .map(|condition| plan.is_silent(program, condition.body).then_some(Body::Condition(condition)))
                .collect(),
        };
        let mut scratch = FunctionBuilderContext::new();
        let mut entries = Vec::new();
        for (number, body) in bodies.into_iter().enumerate() {
            entries.push(match body {
                Some(body) => {
                    let signature = signature(&module, &[types::I64], &[types::I64]);
                    let name = format!("entry{number}");
                    let id = module.declare_function(&name, Linkage::Local, &signature).ok()?;
                    define(program, &mut module, &mut plan, &mut scratch, body, id)?;
                    Some(id)
                }
                None => None,
            });
        }
        while let Some((key, id)) = plan.queue.pop() {
            define(program, &mut module, &mut plan, &mut scratch, Body::Unit(key), id)?;
        }
        module.finalize_definitions().ok()?;
        let entry_of = |id: FuncId| {
            let code = module.get_finalized_function(id);
            // SAFETY: the code was just defined with this signature.
            unsafe { std::mem::transmute::<*const u8, Entry>(code) }
        };
        let entries = entries.into_iter().map(|id| id.map(entry_of)).collect();
        let myself = plan.self_location(program);
        let Plan { facts, numbered, pinned, ran, .. } = plan;
        Some(Code {
            program: Arc::clone(program),
            subject,
            facts,
            entries,
            myself,
            numbered: Arc::new(numbered),
            ran,
            _pinned: pinned,
            _owner: Owner(Some(module)),
        })
    }

    /// Whether a started machine may run the code as this. Its program may have more terms, for conditions.
    pub fn fits(&self, program: &Arc<Program>, subject: &Subject, core: &Core) -> bool {
        let same = Arc::ptr_eq(&self.program, program) || program.extends(&self.program);
        same && self.subject == *subject && self.facts == Facts::of(program, core)
    }

    /// The functions that the code takes for constants and that have other values in a machine now.
    pub fn unsettled(&self, core: &Core) -> Vec<FunctionId> {
        unsettled(&self.facts.settled, core)
    }

    /// Whether a rule has run in some step, as far as that is noted.
    pub fn has_run(&self, rule: RuleId) -> bool {
        self.ran.get(rule.0 as usize).is_some_and(|ran| ran.load(Ordering::Relaxed) != 0)
    }
}

/// What one compiled function does.
#[derive(Debug, Clone, Copy)]
enum Body<'c> {
    /// An entry: makes a step.
    Steps(ProcedureId),
    /// An entry: decides a condition.
    Condition(&'c Expression),
    /// What entries call.
    Unit(UnitKey),
}

/// Builds one function.
fn define(
    program: &Program,
    module: &mut JITModule,
    plan: &mut Plan,
    scratch: &mut FunctionBuilderContext,
    body: Body<'_>,
    id: FuncId,
) -> Option<()> {
    let mut code = module.make_context();
    code.func.signature = match body {
        Body::Unit(key) => unit::unit_signature(program, module, key),
        Body::Steps(_) | Body::Condition(_) => signature(module, &[types::I64], &[types::I64]),
    };
    code.func.name = UserFuncName::user(0, id.as_u32());
    {
        let mut builder = FunctionBuilder::new(&mut code.func, scratch);
        let start = builder.create_block();
        builder.append_block_params_for_function_params(start);
        builder.switch_to_block(start);
        let parameters = builder.block_params(start).to_vec();
        let mut translator = Translator::new(builder, module, plan, program, parameters[0]);
        match body {
            Body::Unit(key) => translator.unit(key, &parameters[1..]),
            Body::Steps(main) => translator.main(main),
            Body::Condition(condition) => translator.condition(condition),
        }
        translator.builder.seal_all_blocks();
        translator.builder.finalize();
    }
    drop_unused_loads(&mut code.func);
    module.define_function(id, &mut code).ok()?;
    module.clear_context(&mut code);
    Some(())
}
