//! The machine code of a procedure that makes steps.
//!
//! In: a program and a started machine. Out: code for every machine of that program that agrees in the [`Facts`] the code
//! relies on. INVARIANT: the code does not change, and what it changes belongs to the machine that runs it; only the
//! marks of the rules that have run are shared.

use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};

use cranelift_codegen::ir::{InstBuilder, UserFuncName, types};
use cranelift_codegen::settings::{self, Configurable};
use cranelift_frontend::{FunctionBuilder, FunctionBuilderContext};
use cranelift_jit::{JITBuilder, JITModule};
use cranelift_module::{FuncId, Linkage, Module, default_libcall_names};
use program::{FunctionId, ProcedureId, Program, RuleId};

use crate::execute::Core;
use crate::native::context::Context;
use crate::native::helper::{Helpers, signature};
use crate::native::numbered::Numbered;
use crate::native::plan::{Facts, Plan, UnitKey};
use crate::native::settled::unsettled;
use crate::native::translate::Translator;
use crate::native::unit;
use crate::weighed::Items;

/// The compiled entry: the context, to a status that is not zero where the step is abandoned.
type Entry = unsafe extern "C" fn(*mut Context) -> i64;

/// See the module.
pub(crate) struct Code {
    program: Arc<Program>,
    procedure: ProcedureId,
    facts: Facts,
    pub(super) entry: Entry,
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
        f.debug_struct("Code").field("procedure", &self.procedure).finish_non_exhaustive()
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

impl Code {
    /// Compiles a procedure for a started machine; none on a processor that Cranelift has no code for. The code notes which
    /// rules run if that is wanted.
    pub fn compile(program: &Arc<Program>, procedure: ProcedureId, core: &Core, notes_rules: bool) -> Option<Code> {
        let mut flags = settings::builder();
        flags.set("opt_level", "speed").ok()?;
        flags.set("is_pic", "false").ok()?;
        flags.set("enable_verifier", if cfg!(debug_assertions) { "true" } else { "false" }).ok()?;
        let isa = cranelift_native::builder().ok()?.finish(settings::Flags::new(flags)).ok()?;
        let mut builder = JITBuilder::with_isa(isa, default_libcall_names());
        Helpers::register(&mut builder);
        let mut module = JITModule::new(builder);
        let helpers = Helpers::declare(&mut module)?;
        let mut plan = Plan::new(program, procedure, core, helpers);
        if notes_rules {
            plan.note_rules(program);
        }

        let entry = signature(&module, &[types::I64], &[types::I64]);
        let entry = module.declare_function("entry", Linkage::Local, &entry).ok()?;
        let mut scratch = FunctionBuilderContext::new();
        define(program, &mut module, &mut plan, &mut scratch, None, procedure, entry)?;
        while let Some((key, id)) = plan.queue.pop() {
            define(program, &mut module, &mut plan, &mut scratch, Some(key), procedure, id)?;
        }
        module.finalize_definitions().ok()?;
        let code = module.get_finalized_function(entry);
        // SAFETY: the code was just defined with this signature.
        let entry = unsafe { std::mem::transmute::<*const u8, Entry>(code) };
        let myself = plan.self_location(program);
        let Plan { facts, numbered, pinned, ran, .. } = plan;
        Some(Code {
            program: Arc::clone(program),
            procedure,
            facts,
            entry,
            myself,
            numbered: Arc::new(numbered),
            ran,
            _pinned: pinned,
            _owner: Owner(Some(module)),
        })
    }

    /// Whether a started machine may run the code as this procedure. Its program may have more terms, for conditions.
    pub fn fits(&self, program: &Arc<Program>, procedure: ProcedureId, core: &Core) -> bool {
        let same = Arc::ptr_eq(&self.program, program) || program.extends(&self.program);
        same && self.procedure == procedure && self.facts == Facts::of(program, core)
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
