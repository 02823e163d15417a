//! The helpers of [`crate::native::runtime`] as compiled code knows them: their names, addresses and signatures.

use cranelift_codegen::ir::{AbiParam, FuncRef, Signature, Type, types};
use cranelift_frontend::FunctionBuilder;
use cranelift_jit::{JITBuilder, JITModule};
use cranelift_module::{FuncId, Linkage, Module};

use crate::native::runtime;

/// A helper.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Helper {
    Grow,
    Agrees,
    Read,
    Ask,
    Locate,
    Member,
    Apply,
    Component,
    Equal,
    Copy,
    Keep,
    Release,
    Evaluate,
    Perform,
    Elements,
    Range,
    BeginSequence,
    EndSequence,
    Open,
    ApplyUnit,
    Join,
    Iteration,
    Create,
    Choose,
    ChooseOf,
    MoreCandidates,
    DropCandidates,
    AgentProgram,
    Fill,
    KeepDerived,
    Look,
}

impl Helper {
    const ALL: [Helper; 31] = [
        Helper::Grow,
        Helper::Agrees,
        Helper::Read,
        Helper::Ask,
        Helper::Locate,
        Helper::Member,
        Helper::Apply,
        Helper::Component,
        Helper::Equal,
        Helper::Copy,
        Helper::Keep,
        Helper::Release,
        Helper::Evaluate,
        Helper::Perform,
        Helper::Elements,
        Helper::Range,
        Helper::BeginSequence,
        Helper::EndSequence,
        Helper::Open,
        Helper::ApplyUnit,
        Helper::Join,
        Helper::Iteration,
        Helper::Create,
        Helper::Choose,
        Helper::ChooseOf,
        Helper::MoreCandidates,
        Helper::DropCandidates,
        Helper::AgentProgram,
        Helper::Fill,
        Helper::KeepDerived,
        Helper::Look,
    ];

    /// Its name, its address, how many words it takes and whether it gives one.
    fn describe(self) -> (&'static str, *const u8, usize, bool) {
        match self {
            Helper::Grow => ("grow", runtime::grow as *const u8, 1, true),
            Helper::Agrees => ("agrees", runtime::agrees as *const u8, 3, true),
            Helper::Read => ("read", runtime::read as *const u8, 4, true),
            Helper::Ask => ("ask", runtime::ask as *const u8, 5, true),
            Helper::Locate => ("locate", runtime::locate as *const u8, 4, true),
            Helper::Member => ("member", runtime::member as *const u8, 3, true),
            Helper::Apply => ("apply", runtime::apply as *const u8, 4, true),
            Helper::Component => ("component", runtime::component as *const u8, 2, true),
            Helper::Equal => ("equal", runtime::equal as *const u8, 2, true),
            Helper::Copy => ("copy", runtime::copy as *const u8, 3, false),
            Helper::Keep => ("keep", runtime::keep as *const u8, 2, true),
            Helper::Release => ("release", runtime::release as *const u8, 2, false),
            Helper::Evaluate => ("evaluate", runtime::evaluate as *const u8, 4, true),
            Helper::Perform => ("perform", runtime::perform as *const u8, 4, true),
            Helper::Elements => ("elements", runtime::elements as *const u8, 2, true),
            Helper::Range => ("range", runtime::range as *const u8, 3, true),
            Helper::BeginSequence => ("begin_sequence", runtime::begin_sequence as *const u8, 1, false),
            Helper::EndSequence => ("end_sequence", runtime::end_sequence as *const u8, 1, true),
            Helper::Open => ("open", runtime::open as *const u8, 1, false),
            Helper::ApplyUnit => ("apply_unit", runtime::apply_unit as *const u8, 1, true),
            Helper::Join => ("join", runtime::join as *const u8, 1, true),
            Helper::Iteration => ("iteration", runtime::iteration as *const u8, 1, true),
            Helper::Create => ("create", runtime::create as *const u8, 2, true),
            Helper::Choose => ("choose", runtime::choose as *const u8, 3, true),
            Helper::ChooseOf => ("choose_of", runtime::choose_of as *const u8, 5, true),
            Helper::MoreCandidates => ("more_candidates", runtime::more_candidates as *const u8, 1, true),
            Helper::DropCandidates => ("drop_candidates", runtime::drop_candidates as *const u8, 1, false),
            Helper::AgentProgram => ("agent_program", runtime::agent_program as *const u8, 2, true),
            Helper::Fill => ("fill", runtime::fill as *const u8, 4, true),
            Helper::KeepDerived => ("keep_derived", runtime::keep_derived as *const u8, 4, false),
            Helper::Look => ("look", runtime::look as *const u8, 1, true),
        }
    }
}

/// The helpers declared in a module.
#[derive(Debug)]
pub(super) struct Helpers {
    ids: Vec<FuncId>,
}

impl Helpers {
    /// Tells the linker where they are.
    pub fn register(builder: &mut JITBuilder) {
        for helper in Helper::ALL {
            let (name, address, ..) = helper.describe();
            builder.symbol(name, address);
        }
    }

    /// Declares them.
    pub fn declare(module: &mut JITModule) -> Option<Helpers> {
        let declare = |helper: &Helper| {
            let (name, _, parameters, result) = helper.describe();
            let results: &[Type] = if result { &[types::I64] } else { &[] };
            let signature = signature(module, &vec![types::I64; parameters], results);
            module.declare_function(name, Linkage::Import, &signature).ok()
        };
        let ids = Helper::ALL.iter().map(declare).collect::<Option<_>>()?;
        Some(Helpers { ids })
    }

    /// A helper as the function being built can call it.
    pub fn reference(&self, helper: Helper, module: &mut JITModule, builder: &mut FunctionBuilder<'_>) -> FuncRef {
        module.declare_func_in_func(self.ids[helper as usize], builder.func)
    }
}

/// A signature in the platform's convention.
pub(super) fn signature(module: &JITModule, parameters: &[Type], results: &[Type]) -> Signature {
    let mut signature = module.make_signature();
    signature.params.extend(parameters.iter().map(|ty| AbiParam::new(*ty)));
    signature.returns.extend(results.iter().map(|ty| AbiParam::new(*ty)));
    signature
}
