//! The helpers of [`crate::native::runtime`] as compiled code knows them: their names, addresses and signatures.
//!
//! In: the functions of the runtime. Out: a constant for each, by which the translator calls it, and what the linker needs.
//! INVARIANT: code that calls a helper with too few or too many words, or takes for a pointer what is none, does not
//! compile: a helper's row is held to the function's type, and a call to the row.

use std::marker::PhantomData;

use cranelift_codegen::ir::{self, AbiParam, FuncRef, Signature, Type, types};
use cranelift_frontend::FunctionBuilder;
use cranelift_jit::{JITBuilder, JITModule};
use cranelift_module::{FuncId, Linkage, Module};

use crate::native::runtime;
use crate::value::Value;

/// A helper that takes so many words and gives an `R`.
#[derive(Debug)]
pub(super) struct Helper<const WORDS: usize, R> {
    index: usize,
    result: PhantomData<fn() -> R>,
}

/// A type that is one word in a register.
trait Word {}

impl Word for i64 {}
impl Word for u64 {}
impl<T> Word for *const T {}
impl<T> Word for *mut T {}

/// What a helper may give.
pub(super) trait Given {
    /// How the translator has it.
    type Translated;
    const TYPES: &'static [Type];

    fn translated(results: &[ir::Value]) -> Self::Translated;
}

impl Given for () {
    type Translated = ();
    const TYPES: &'static [Type] = &[];

    fn translated(_: &[ir::Value]) {}
}

impl Given for i64 {
    type Translated = ir::Value;
    const TYPES: &'static [Type] = &[types::I64];

    fn translated(results: &[ir::Value]) -> ir::Value {
        results[0]
    }
}

impl Given for *const Value {
    type Translated = ir::Value;
    const TYPES: &'static [Type] = &[types::I64];

    fn translated(results: &[ir::Value]) -> ir::Value {
        results[0]
    }
}

/// A function that compiled code may call.
trait Callable<const WORDS: usize> {
    const RESULTS: &'static [Type];

    fn address(self) -> *const u8;
}

macro_rules! callable {
    ($words:literal: $($parameter:ident)*) => {
        impl<$($parameter: Word,)* R: Given> Callable<$words> for unsafe extern "C" fn($($parameter),*) -> R {
            const RESULTS: &'static [Type] = R::TYPES;

            fn address(self) -> *const u8 {
                self as *const u8
            }
        }
    };
}

callable!(1: A);
callable!(2: A B);
callable!(3: A B C);
callable!(4: A B C D);
callable!(5: A B C D E);

/// A helper as the linker knows it.
struct Described {
    name: &'static str,
    address: *const u8,
    words: usize,
    results: &'static [Type],
}

fn described<const WORDS: usize, F: Callable<WORDS>>(name: &'static str, function: F) -> Described {
    Described { name, address: function.address(), words: WORDS, results: F::RESULTS }
}

/// A parameter whose type is the function's business.
macro_rules! inferred {
    ($parameter:ident) => {
        _
    };
}

/// `CONSTANT = function(parameters) -> result;`
macro_rules! helpers {
    ($($helper:ident = $function:ident($($parameter:ident),*) -> $result:ty;)*) => {
        /// The numbers of the helpers, in their order.
        #[allow(non_camel_case_types, clippy::upper_case_acronyms, reason = "named as the constants are")]
        enum Index {
            $($helper,)*
        }

        $(pub(super) const $helper: Helper<{ [$(stringify!($parameter)),*].len() }, $result> =
            Helper { index: Index::$helper as usize, result: PhantomData };)*

        /// All of them, by their numbers.
        fn all() -> Vec<Described> {
            vec![$(described::<{ [$(stringify!($parameter)),*].len() }, _>(
                stringify!($function),
                runtime::$function as unsafe extern "C" fn($(inferred!($parameter)),*) -> $result,
            )),*]
        }
    };
}

helpers! {
    GROW = grow(context) -> i64;
    PUSH = push(context, location, tag, payload, rule) -> i64;
    AGREES = agrees(context, location, value) -> i64;
    READ = read(context, function, arguments, count) -> *const Value;
    ASK = ask(context, function, arguments, count, index) -> i64;
    LOCATE = locate(context, function, arguments, count) -> i64;
    MEMBER = member(context, function, value) -> i64;
    APPLY = apply(context, term, operands, count) -> *const Value;
    COMPONENT = component(tuple, index) -> *const Value;
    EQUAL = equal(left, right) -> i64;
    COPY = copy(context, value, place) -> ();
    KEEP = keep(context, value) -> *const Value;
    RELEASE = release(context, mark) -> ();
    EVALUATE = evaluate(context, term, spill, values) -> *const Value;
    PERFORM = perform(context, rule, spill, values) -> i64;
    COLLECT = collect(context) -> ();
    ADD = add(context, element) -> i64;
    COLLECTED = collected(context, kind) -> *const Value;
    ELEMENTS = elements(context, domain) -> *const Value;
    RANGE = range(context, collection, out) -> i64;
    ITEMS = items(collection, kind, out) -> i64;
    EXTEND = extend(context, start, count) -> i64;
    ARRANGE = arrange(start, count) -> i64;
    POSITION = position(start, count, tag, payload) -> i64;
    MAKE = make(context, start, count, kind) -> *const Value;
    BEGIN_SEQUENCE = begin_sequence(context) -> ();
    END_SEQUENCE = end_sequence(context) -> i64;
    END_LAST_SEQUENCE = end_last_sequence(context) -> i64;
    OPEN = open(context) -> ();
    APPLY_UNIT = apply_unit(context) -> i64;
    JOIN = join(context) -> i64;
    ITERATION = iteration(context) -> i64;
    CREATE = create(context, domain) -> i64;
    CHOOSE = choose(context, rule, variables) -> i64;
    CHOOSE_OF = choose_of(context, rule, values, count, variables) -> i64;
    MORE_CANDIDATES = more_candidates(context) -> i64;
    DROP_CANDIDATES = drop_candidates(context) -> ();
    AGENT_PROGRAM = agent_program(context, agent) -> i64;
    FILL = fill(context, table, entry, values) -> i64;
    KEEP_DERIVED = keep_derived(context, place, mark, value) -> ();
    LOOK = look(context) -> i64;
}

impl<const WORDS: usize, R> Helper<WORDS, R> {
    /// Its number.
    pub fn index(&self) -> usize {
        self.index
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
        for helper in all() {
            builder.symbol(helper.name, helper.address);
        }
    }

    /// Declares them.
    pub fn declare(module: &mut JITModule) -> Option<Helpers> {
        let declare = |helper: Described| {
            let signature = signature(module, &vec![types::I64; helper.words], helper.results);
            module.declare_function(helper.name, Linkage::Import, &signature).ok()
        };
        let ids = all().into_iter().map(declare).collect::<Option<_>>()?;
        Some(Helpers { ids })
    }

    /// The helper of a number as the function being built can call it.
    pub fn reference(&self, index: usize, module: &mut JITModule, builder: &mut FunctionBuilder<'_>) -> FuncRef {
        module.declare_func_in_func(self.ids[index], builder.func)
    }
}

/// A signature in the platform's convention.
pub(super) fn signature(module: &JITModule, parameters: &[Type], results: &[Type]) -> Signature {
    let mut signature = module.make_signature();
    signature.params.extend(parameters.iter().map(|ty| AbiParam::new(*ty)));
    signature.returns.extend(results.iter().map(|ty| AbiParam::new(*ty)));
    signature
}
