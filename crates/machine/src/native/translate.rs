//! The translator of one function: blocks, calls of helpers, boxing and unboxing.
//!
//! In: a procedure or a definition of the program. Out: machine code that does what [`crate::perform`] and
//! [`crate::evaluate`] do, as long as nothing goes wrong. Where anything would (an undefined operand, an overflow, a
//! clash) it jumps to [`Translator::bail`] and the step is interpreted instead, so that the meaning of a fault stands
//! in one place. INVARIANT: inputs and choices are asked for in the interpreter's order.

use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::{
    self, AliasRegion, Block, FuncRef, InstBuilder, MemFlags, StackSlotData, StackSlotKind, Type, types,
};
use cranelift_frontend::{FunctionBuilder, Variable};
use cranelift_jit::JITModule;
use program::{Certain, DomainId, Program, TermId};

use crate::native::context::Offset;
use crate::native::helper::{self, Given, Helper};
use crate::native::nesting::UnitKey;
use crate::native::plan::Plan;
use crate::native::shape::{Bound, Kind, Operand, Scalar};
use crate::value::Value;

/// Memory that compiled code may read and write without a check: values, updates, stamps.
pub(super) const FLAGS: MemFlags = MemFlags::trusted().with_alias_region(Some(AliasRegion::Heap));
/// Memory that compiled code only writes.
pub(super) const MARKS: MemFlags = MemFlags::trusted();
/// Fields of the context that only helpers change.
const FIXED: MemFlags = MemFlags::trusted().with_alias_region(Some(AliasRegion::Vmctx));
/// Fields of the context that compiled code changes.
const COUNTERS: MemFlags = MemFlags::trusted().with_alias_region(Some(AliasRegion::Table));

/// The variables of an inlined procedure or definition.
#[derive(Debug)]
pub(super) struct Frame {
    /// None of a condition, which nothing calls.
    pub unit: Option<UnitKey>,
    /// How many slots the interpreter's frame has.
    pub size: u32,
    pub slots: Vec<Bound>,
}

/// The function being built.
pub(super) struct Translator<'t, 'f> {
    pub builder: FunctionBuilder<'f>,
    pub module: &'t mut JITModule,
    pub plan: &'t mut Plan,
    pub program: &'t Program,
    pub context: ir::Value,
    /// Gives the step up.
    pub bail: Block,
    pub frames: Vec<Frame>,
    /// The running agent, where the program that runs was entered here.
    pub agent: Option<Scalar>,
    /// A compound value was kept since the last mark.
    pub keeps: bool,
    /// How many places have been translated that keep one.
    pub keepers: usize,
    /// How many places have been translated that gather items.
    pub gatherers: usize,
    /// The variables of the `forall` rules around the rule being translated; none where another rule that makes a
    /// unit, or ranges over what may repeat, stands between it and the step.
    pub foralls: Option<Vec<program::Slot>>,
    /// Nothing else updates anything in the step while the rule being translated runs, or has done so before.
    pub sole: bool,
    /// The rule being translated is the whole of a part of a sequence, of which nobody asks whether it made updates.
    pub is_part: bool,
    /// Terms and rules translated into this function.
    pub weight: usize,
    /// How often the loops around that do not count their rounds run what is being translated.
    pub rounds: i64,
    references: Vec<(usize, FuncRef)>,
}

impl<'t, 'f> Translator<'t, 'f> {
    /// A translator at the start of a function, whose entry block is current.
    pub fn new(
        mut builder: FunctionBuilder<'f>,
        module: &'t mut JITModule,
        plan: &'t mut Plan,
        program: &'t Program,
        context: ir::Value,
    ) -> Self {
        let bail = builder.create_block();
        builder.set_cold_block(bail);
        Translator {
            builder,
            module,
            plan,
            program,
            context,
            bail,
            frames: Vec::new(),
            agent: None,
            keeps: false,
            keepers: 0,
            gatherers: 0,
            foralls: None,
            sole: false,
            is_part: false,
            weight: 0,
            rounds: 1,
            references: Vec::new(),
        }
    }

    // ---- constants and memory

    pub fn word(&mut self, n: i64) -> ir::Value {
        self.builder.ins().iconst(types::I64, n)
    }

    pub fn byte(&mut self, n: i64) -> ir::Value {
        self.builder.ins().iconst(types::I8, n)
    }

    pub fn address<T>(&mut self, pointer: *const T) -> ir::Value {
        self.word(pointer as i64)
    }

    pub fn field(&mut self, offset: i32) -> ir::Value {
        let flags = if Offset::is_counter(offset) { COUNTERS } else { FIXED };
        self.builder.ins().load(types::I64, flags, self.context, offset)
    }

    pub fn set_field(&mut self, offset: i32, value: ir::Value) {
        debug_assert!(Offset::is_counter(offset));
        self.builder.ins().store(COUNTERS, value, self.context, offset);
    }

    pub fn load(&mut self, ty: Type, address: ir::Value, offset: i32) -> ir::Value {
        self.builder.ins().load(ty, FLAGS, address, offset)
    }

    pub fn store(&mut self, value: ir::Value, address: ir::Value, offset: i32) {
        self.builder.ins().store(FLAGS, value, address, offset);
    }

    /// `base + index * 2^shift`
    pub fn element(&mut self, base: ir::Value, index: ir::Value, shift: i64) -> ir::Value {
        let offset = self.builder.ins().ishl_imm(index, shift);
        self.builder.ins().iadd(base, offset)
    }

    /// The address of a location's value.
    pub fn stored(&mut self, index: ir::Value) -> ir::Value {
        let values = self.field(Offset::values);
        self.element(values, index, 4)
    }

    pub fn scratch(&mut self, words: u32) -> ir::Value {
        let data = StackSlotData::new(StackSlotKind::ExplicitSlot, 8 * words, 4);
        let slot = self.builder.create_sized_stack_slot(data);
        self.builder.ins().stack_addr(types::I64, slot, 0)
    }

    // ---- control

    pub fn block(&mut self) -> Block {
        self.builder.create_block()
    }

    pub fn switch(&mut self, block: Block) {
        self.builder.switch_to_block(block);
    }

    pub fn jump(&mut self, block: Block) {
        self.builder.ins().jump(block, &[]);
    }

    pub fn branch(&mut self, condition: ir::Value, then: Block, otherwise: Block) {
        self.builder.ins().brif(condition, then, &[], otherwise, &[]);
    }

    /// Goes on only where the condition is not zero.
    pub fn require(&mut self, condition: ir::Value) {
        let next = self.block();
        self.branch(condition, next, self.bail);
        self.switch(next);
    }

    /// Goes on only where the condition is zero.
    pub fn refuse(&mut self, condition: ir::Value) {
        let next = self.block();
        self.branch(condition, self.bail, next);
        self.switch(next);
    }

    /// Gives the step up here; what follows is never reached.
    pub fn give_up(&mut self) {
        self.jump(self.bail);
        let unreachable = self.block();
        self.switch(unreachable);
    }

    pub fn variable(&mut self, ty: Type) -> Variable {
        self.builder.declare_var(ty)
    }

    pub fn set(&mut self, variable: Variable, value: ir::Value) {
        self.builder.def_var(variable, value);
    }

    pub fn get(&mut self, variable: Variable) -> ir::Value {
        self.builder.use_var(variable)
    }

    /// Counts work, and looks whether the step is to end where the budget is spent.
    pub fn spend(&mut self, amount: ir::Value) {
        let budget = self.field(Offset::budget);
        let left = self.builder.ins().isub(budget, amount);
        self.set_field(Offset::budget, left);
        let spent = self.builder.ins().icmp_imm(IntCC::SignedLessThan, left, 0);
        let (look, next) = (self.block(), self.block());
        self.builder.set_cold_block(look);
        self.branch(spent, look, next);
        self.switch(look);
        self.call_or_bail(helper::LOOK, [self.context]);
        self.jump(next);
        self.switch(next);
    }

    // ---- helpers

    /// Calls a helper; gives its result.
    pub fn call<const WORDS: usize, R: Given>(
        &mut self,
        helper: Helper<WORDS, R>,
        arguments: [ir::Value; WORDS],
    ) -> R::Translated {
        let index = helper.index();
        let reference = match self.references.iter().find(|(known, _)| *known == index) {
            Some((_, reference)) => *reference,
            None => {
                let reference = self.plan.helpers.reference(index, self.module, &mut self.builder);
                self.references.push((index, reference));
                reference
            }
        };
        let call = self.builder.ins().call(reference, &arguments);
        R::translated(self.builder.inst_results(call))
    }

    /// Calls a helper that gives a pointer, null where the step cannot go on. The value lives as long as the
    /// statement.
    pub fn call_for_value<const WORDS: usize>(
        &mut self,
        helper: Helper<WORDS, *const Value>,
        arguments: [ir::Value; WORDS],
    ) -> ir::Value {
        self.note_kept();
        let pointer = self.call(helper, arguments);
        self.require(pointer);
        pointer
    }

    /// Code that keeps a compound value has been translated.
    pub fn note_kept(&mut self) {
        self.keeps = true;
        self.keepers += 1;
    }

    /// Calls a helper that gives a status, not zero where the step cannot go on.
    pub fn call_or_bail<const WORDS: usize>(&mut self, helper: Helper<WORDS, i64>, arguments: [ir::Value; WORDS]) {
        let status = self.call(helper, arguments);
        self.refuse(status);
    }

    /// Calls a helper that gives a number, negative where the step cannot go on.
    pub fn call_for_number<const WORDS: usize>(
        &mut self,
        helper: Helper<WORDS, i64>,
        arguments: [ir::Value; WORDS],
    ) -> ir::Value {
        let number = self.call(helper, arguments);
        let negative = self.builder.ins().icmp_imm(IntCC::SignedLessThan, number, 0);
        self.refuse(negative);
        number
    }

    /// Translates a statement, after which the compound values it kept are forgotten.
    pub fn statement<T>(&mut self, body: impl FnOnce(&mut Self) -> T) -> T {
        let before = std::mem::replace(&mut self.keeps, false);
        let mark = self.field(Offset::temporary);
        let result = body(self);
        if self.keeps {
            self.release(mark);
        }
        self.keeps = before;
        result
    }

    pub fn release(&mut self, mark: ir::Value) {
        let now = self.field(Offset::temporary);
        let any = self.builder.ins().icmp(IntCC::NotEqual, now, mark);
        let (some, next) = (self.block(), self.block());
        self.branch(any, some, next);
        self.switch(some);
        self.call(helper::RELEASE, [self.context, mark]);
        self.jump(next);
        self.switch(next);
    }

    // ---- boxing

    /// The two words of a scalar as a value has them.
    pub fn words(&mut self, scalar: Scalar) -> (ir::Value, ir::Value) {
        let tag = self.word(scalar.kind.tag());
        let tag = match scalar.flag {
            None => tag,
            Some(flag) => {
                let undef = self.word(0);
                self.builder.ins().select(flag, tag, undef)
            }
        };
        let payload = match scalar.kind {
            Kind::Boolean => self.builder.ins().uextend(types::I64, scalar.value),
            Kind::Enum(domain) | Kind::Element(domain) => {
                let high = self.builder.ins().ishl_imm(scalar.value, 32);
                self.builder.ins().bor_imm(high, i64::from(domain.0))
            }
            Kind::Integer | Kind::Real | Kind::Char | Kind::Rule => scalar.value,
        };
        (tag, payload)
    }

    /// A pointer to the value of an operand.
    pub fn boxed(&mut self, operand: Operand) -> ir::Value {
        match operand {
            Operand::Undef => {
                let undef = self.plan.undef();
                self.address(undef)
            }
            Operand::Boxed(pointer) | Operand::Shelved(pointer) => pointer,
            Operand::Stored(index) => self.stored(index),
            Operand::Items(items) => self.made(items),
            Operand::Scalar(scalar) => {
                let (tag, payload) = self.words(scalar);
                let place = self.scratch(2);
                self.store(tag, place, 0);
                self.store(payload, place, 8);
                place
            }
        }
    }

    /// A pointer that stays valid until the statement ends.
    pub fn pinned(&mut self, operand: Operand) -> ir::Value {
        match operand {
            Operand::Stored(_) | Operand::Shelved(_) => {
                let place = self.boxed(operand);
                self.call_for_value(helper::KEEP, [self.context, place])
            }
            other => self.boxed(other),
        }
    }

    /// An array of pointers to the values of operands.
    pub fn pointers(&mut self, operands: &[Operand]) -> ir::Value {
        if operands.is_empty() {
            return self.word(0);
        }
        let place = self.scratch(operands.len() as u32);
        for (index, operand) in operands.iter().enumerate() {
            let pointer = self.boxed(*operand);
            self.store(pointer, place, 8 * index as i32);
        }
        place
    }

    /// Reads the payload of a kind out of a value.
    pub fn payload(&mut self, pointer: ir::Value, kind: Kind) -> ir::Value {
        self.payload_at(pointer, 0, kind)
    }

    /// The same of a value so many bytes on.
    pub fn payload_at(&mut self, pointer: ir::Value, offset: i32, kind: Kind) -> ir::Value {
        self.payload_in(FLAGS, pointer, offset, kind)
    }

    /// The same out of memory of which something is known.
    pub fn payload_in(&mut self, flags: MemFlags, pointer: ir::Value, offset: i32, kind: Kind) -> ir::Value {
        match kind {
            Kind::Boolean => self.builder.ins().load(types::I8, flags, pointer, offset + 8),
            Kind::Integer => self.builder.ins().load(types::I64, flags, pointer, offset + 8),
            Kind::Real => self.builder.ins().load(types::F64, flags, pointer, offset + 8),
            Kind::Enum(_) | Kind::Element(_) => self.builder.ins().uload32(flags, pointer, offset + 12),
            Kind::Char | Kind::Rule => self.builder.ins().uload32(flags, pointer, offset + 8),
        }
    }

    /// Takes a scalar out of a value. A value of another kind gives the step up.
    pub fn unboxed(&mut self, pointer: ir::Value, kind: Kind) -> Scalar {
        let tag = self.load(types::I64, pointer, 0);
        let fits = self.builder.ins().icmp_imm(IntCC::Equal, tag, kind.tag());
        let undef = self.builder.ins().icmp_imm(IntCC::Equal, tag, 0);
        let known = self.builder.ins().bor(fits, undef);
        self.require(known);
        let value = self.payload(pointer, kind);
        Scalar { kind, value, flag: Some(fits), range: None }
    }

    /// The same of a value that is known to be no undef.
    pub fn unboxed_defined(&mut self, pointer: ir::Value, kind: Kind) -> Scalar {
        let tag = self.load(types::I64, pointer, 0);
        let fits = self.builder.ins().icmp_imm(IntCC::Equal, tag, kind.tag());
        self.require(fits);
        Scalar::defined(kind, self.payload(pointer, kind))
    }

    /// What is certain of a term's value here.
    pub fn certain(&self, term: TermId) -> Certain {
        let slots = self.frames.last().map_or(&[][..], |frame| &frame.slots[..]);
        self.plan.certain(self.program, term, &|slot| match slots.get(slot.0 as usize) {
            Some(Bound::Scalar(Scalar { flag: None, .. })) => Certain::DEFINED,
            Some(Bound::Scalar(_) | Bound::Boxed(_) | Bound::Items(_) | Bound::Undef) | None => Certain::NOTHING,
        })
    }

    /// An operand as a scalar of a kind, if it can be one.
    pub fn scalar(&mut self, operand: Operand, kind: Kind) -> Scalar {
        match operand {
            Operand::Scalar(scalar) if scalar.kind == kind => scalar,
            Operand::Undef => {
                let value = self.zero(kind);
                let flag = self.byte(0);
                Scalar { kind, value, flag: Some(flag), range: None }
            }
            Operand::Scalar(_) | Operand::Items(_) => {
                // A value of another kind: the interpreter knows what that means.
                let value = self.zero(kind);
                self.give_up();
                Scalar::defined(kind, value)
            }
            Operand::Boxed(_) | Operand::Shelved(_) | Operand::Stored(_) => {
                let place = self.boxed(operand);
                self.unboxed(place, kind)
            }
        }
    }

    fn zero(&mut self, kind: Kind) -> ir::Value {
        match kind {
            Kind::Real => self.builder.ins().f64const(0.0),
            Kind::Boolean => self.byte(0),
            _ => self.word(0),
        }
    }

    /// A scalar that must be defined.
    pub fn defined(&mut self, scalar: Scalar) -> Scalar {
        if let Some(flag) = scalar.flag {
            self.require(flag);
        }
        Scalar { flag: None, ..scalar }
    }

    /// Whether an operand is defined, as a byte; none if it always is.
    pub fn is_defined(&mut self, operand: Operand) -> Option<ir::Value> {
        match operand {
            Operand::Undef => Some(self.byte(0)),
            Operand::Scalar(scalar) => scalar.flag,
            Operand::Items(_) => None,
            Operand::Boxed(_) | Operand::Shelved(_) | Operand::Stored(_) => {
                let pointer = self.boxed(operand);
                let tag = self.load(types::I64, pointer, 0);
                Some(self.builder.ins().icmp_imm(IntCC::NotEqual, tag, 0))
            }
        }
    }

    /// What a variable is bound to so as to stay bound.
    pub fn bound(&mut self, operand: Operand) -> Bound {
        match operand {
            Operand::Undef => Bound::Undef,
            Operand::Scalar(scalar) => Bound::Scalar(scalar),
            Operand::Items(items) => Bound::Items(items),
            other => Bound::Boxed(self.pinned(other)),
        }
    }

    // ---- variables

    pub fn frame(&mut self) -> &mut Frame {
        self.frames.last_mut().expect("a body is being translated")
    }

    pub fn bind(&mut self, slot: program::Slot, bound: Bound) {
        let slots = &mut self.frame().slots;
        let index = slot.0 as usize;
        if slots.len() <= index {
            slots.resize(index + 1, Bound::Undef);
        }
        slots[index] = bound;
    }

    pub fn slot(&mut self, slot: program::Slot) -> Bound {
        self.frame().slots.get(slot.0 as usize).copied().unwrap_or(Bound::Undef)
    }

    /// The kind of a term's values.
    pub fn kind_of(&self, term: TermId) -> Option<Kind> {
        Kind::of(self.program, self.program.term_domain(term))
    }

    /// The kind of a domain's values.
    pub fn kind(&self, domain: DomainId) -> Option<Kind> {
        Kind::of(self.program, domain)
    }
}
