//! What compiled code sees of the machine: pointers into the store, the update set and the kept values.
//!
//! INVARIANT: while compiled code runs, the lengths here are the true ones; [`Context::enter`] hands them back to
//! the machine before a helper works on it, [`Context::leave`] takes pointers and lengths anew. Compiled code
//! reads and writes the fields by their offsets, so their order is part of the interface.
#![allow(unsafe_code)]

use std::mem::offset_of;

use crate::execute::{Core, Executor};
use crate::native::memory::Memory;
use crate::update::{Stamp, Update};
use crate::value::Value;
use crate::work::INTERVAL;

/// LIMIT: compound values that one statement may hold at a time.
const TEMPORARIES: usize = 1 << 16;
/// LIMIT: candidates of a choice, times its variables; where there are more the step is interpreted.
const CANDIDATES: usize = 1 << 20;
/// LIMIT: items of collections that are not made; where there are more the step is interpreted.
const ITEMS: usize = 1 << 20;

/// The view of compiled code.
#[repr(C)]
#[derive(Debug)]
pub(super) struct Context {
    pub values: *mut Value,
    pub given: *mut u32,
    pub stamps: *mut Stamp,
    pub stack: *mut Update,
    pub held: u64,
    pub capacity: u64,
    pub unit: u64,
    pub epoch: u64,
    pub kept: *mut Value,
    pub versions: *mut u64,
    pub version: u64,
    /// Values of the running statements, a stack.
    pub temporaries: *mut Value,
    pub temporary: u64,
    /// The candidates of a choice.
    pub candidates: *mut Value,
    pub candidate: u64,
    pub candidate_capacity: u64,
    /// Items of the collections that running rules have not made, a stack of scalars.
    pub items: *mut Value,
    pub item: u64,
    pub item_capacity: u64,
    /// How many elements a collection may have.
    pub most: i64,
    /// Not zero where an update that leaves its location as it is may be left out.
    pub terse: u64,
    pub depth: u64,
    /// Work left until the machine looks whether the step is to end ([`crate::work`]).
    pub budget: i64,
    /// By table of a fixed term: where its states and its values are.
    pub tables: *const [u64; 2],
    /// The executor of the running step.
    executor: *mut Executor<'static>,
    /// What the machine keeps for the compiled code.
    memory: *mut Memory,
}

/// Where the fields are.
#[derive(Debug)]
pub(super) struct Offset;

#[allow(non_upper_case_globals, reason = "named as the fields are")]
impl Offset {
    pub const values: i32 = offset_of!(Context, values) as i32;
    pub const given: i32 = offset_of!(Context, given) as i32;
    pub const stamps: i32 = offset_of!(Context, stamps) as i32;
    pub const stack: i32 = offset_of!(Context, stack) as i32;
    pub const held: i32 = offset_of!(Context, held) as i32;
    pub const capacity: i32 = offset_of!(Context, capacity) as i32;
    pub const unit: i32 = offset_of!(Context, unit) as i32;
    pub const epoch: i32 = offset_of!(Context, epoch) as i32;
    pub const kept: i32 = offset_of!(Context, kept) as i32;
    pub const versions: i32 = offset_of!(Context, versions) as i32;
    pub const version: i32 = offset_of!(Context, version) as i32;
    pub const temporary: i32 = offset_of!(Context, temporary) as i32;
    pub const candidates: i32 = offset_of!(Context, candidates) as i32;
    pub const candidate: i32 = offset_of!(Context, candidate) as i32;
    pub const candidate_capacity: i32 = offset_of!(Context, candidate_capacity) as i32;
    pub const items: i32 = offset_of!(Context, items) as i32;
    pub const item: i32 = offset_of!(Context, item) as i32;
    pub const item_capacity: i32 = offset_of!(Context, item_capacity) as i32;
    pub const most: i32 = offset_of!(Context, most) as i32;
    pub const terse: i32 = offset_of!(Context, terse) as i32;
    pub const depth: i32 = offset_of!(Context, depth) as i32;
    pub const budget: i32 = offset_of!(Context, budget) as i32;
    pub const tables: i32 = offset_of!(Context, tables) as i32;

    /// Whether compiled code itself changes the field.
    pub fn is_counter(offset: i32) -> bool {
        [Self::held, Self::temporary, Self::candidate, Self::item, Self::terse, Self::depth, Self::budget]
            .contains(&offset)
    }
}

impl Context {
    /// A view of no machine yet: see [`Context::begin`].
    ///
    /// # Safety
    /// `memory` lives as long as the context, and nothing else uses it.
    pub unsafe fn new(memory: *mut Memory) -> Context {
        let own = memory;
        // SAFETY: as the caller promises.
        let memory = unsafe { &mut *memory };
        if memory.temporaries.capacity() == 0 {
            memory.temporaries.reserve(TEMPORARIES);
            memory.candidates.reserve(CANDIDATES.min(1 << 12));
            memory.items.reserve_exact(ITEMS);
        }
        Context {
            values: std::ptr::null_mut(),
            given: std::ptr::null_mut(),
            stamps: std::ptr::null_mut(),
            stack: std::ptr::null_mut(),
            held: 0,
            capacity: 0,
            unit: 0,
            epoch: 0,
            kept: std::ptr::null_mut(),
            versions: std::ptr::null_mut(),
            version: 0,
            temporaries: memory.temporaries.as_mut_ptr(),
            temporary: 0,
            candidates: memory.candidates.as_mut_ptr(),
            candidate: 0,
            candidate_capacity: memory.candidates.capacity() as u64,
            items: memory.items.as_mut_ptr(),
            item: 0,
            item_capacity: 0,
            most: 0,
            terse: 0,
            depth: 0,
            budget: 0,
            tables: memory.places(),
            executor: std::ptr::null_mut(),
            memory: own,
        }
    }

    /// Begins a step: what compiled code sees is this executor's machine until the code returns.
    #[inline]
    pub fn begin(&mut self, executor: &mut Executor<'_>) {
        self.count(executor.core);
        self.budget = INTERVAL as i64;
        // So one that is too large for the interpreter is never completed.
        self.terse = 1;
        (self.item, self.item_capacity) = (0, executor.limits.collection.min(ITEMS as u64));
        self.most = i64::try_from(executor.limits.collection).unwrap_or(i64::MAX);
        self.executor = std::ptr::from_mut(executor).cast::<Executor<'static>>();
    }

    /// Takes pointers and lengths from the machine.
    #[inline]
    pub fn leave(&mut self, core: &mut Core) {
        self.look(core);
        self.count(core);
    }

    /// Takes the pointers, which stay as long as nothing grows.
    #[inline]
    pub fn look(&mut self, core: &mut Core) {
        core.updates.cover(core.store.len());
        self.values = core.store.values.as_mut_ptr();
        self.given = core.store.given.as_mut_ptr();
        self.stamps = core.updates.stamps.as_mut_ptr();
        self.stack = core.updates.stack.as_mut_ptr();
        self.capacity = core.updates.stack.capacity() as u64;
        (self.kept, self.versions) = core.memo.view();
    }

    /// Takes the numbers that differ from step to step.
    #[inline]
    fn count(&mut self, core: &Core) {
        self.held = core.updates.stack.len() as u64;
        self.unit = u64::from(core.updates.unit());
        self.epoch = u64::from(core.epoch);
        self.version = core.memo.version_now();
    }

    /// Hands the lengths back to the machine.
    #[inline]
    pub fn enter(&mut self, core: &mut Core) {
        debug_assert!(self.held <= self.capacity);
        // SAFETY: compiled code has written every update below `held`, which it keeps at or below the capacity.
        unsafe { core.updates.stack.set_len(self.held as usize) };
    }

    /// Runs a helper on the machine.
    ///
    /// # Safety
    /// `context` has begun a step, whose executor and memory still live; nothing else uses them now.
    #[inline]
    pub unsafe fn with<T>(context: *mut Context, helper: impl FnOnce(&mut Executor<'static>, &mut Context) -> T) -> T {
        // SAFETY: as the caller promises; compiled code holds no reference while a helper runs.
        let (context, executor) = unsafe { (&mut *context, &mut *(*context).executor) };
        context.enter(executor.core);
        let result = helper(executor, context);
        context.leave(executor.core);
        result
    }

    /// The executor, to do what touches neither store nor update set.
    ///
    /// # Safety
    /// As for [`Context::with`].
    pub unsafe fn executor<'c>(context: *mut Context) -> &'c mut Executor<'static> {
        // SAFETY: as the caller promises.
        unsafe { &mut *(*context).executor }
    }

    /// The update set may now hold a value with memory of its own.
    ///
    /// # Safety
    /// As for [`Context::with`].
    pub unsafe fn mark_compound(context: *mut Context) {
        // SAFETY: as the caller promises.
        unsafe { (*(*context).executor).core.updates.compound = true };
    }

    /// What the machine keeps for the compiled code.
    ///
    /// # Safety
    /// As for [`Context::with`].
    pub unsafe fn memory<'c>(context: *mut Context) -> &'c mut Memory {
        // SAFETY: as the caller promises.
        unsafe { &mut *(*context).memory }
    }

    /// Keeps a value until the statement ends; null where there is no room.
    #[inline]
    pub fn keep(&mut self, value: Value) -> *const Value {
        if self.temporary as usize >= TEMPORARIES {
            return std::ptr::null();
        }
        // SAFETY: the memory is reserved for that many values, and none lives at this place.
        unsafe {
            let place = self.temporaries.add(self.temporary as usize);
            place.write(value);
            self.temporary += 1;
            place
        }
    }

    /// Forgets the values kept since there were `mark`.
    pub fn release(&mut self, mark: u64) {
        while self.temporary > mark {
            self.temporary -= 1;
            // SAFETY: values below the mark reached were written by `keep` and not dropped since.
            unsafe { self.temporaries.add(self.temporary as usize).drop_in_place() };
        }
    }

    /// Makes room for more candidates; false at the limit.
    pub fn more_candidates(&mut self, memory: &mut Memory) -> bool {
        let filled = self.candidate as usize;
        let wanted = 2 * self.candidate_capacity as usize;
        if wanted > CANDIDATES {
            return false;
        }
        // SAFETY: that many were written; the vector's length goes back to 0 before anything else uses it.
        unsafe {
            memory.candidates.set_len(filled);
            memory.candidates.reserve_exact(wanted - filled);
            self.candidates = memory.candidates.as_mut_ptr();
            memory.candidates.set_len(0);
        }
        self.candidate_capacity = wanted as u64;
        true
    }

    /// The candidates written, which are forgotten by [`Context::drop_candidates`].
    pub fn candidate_slice(&self) -> &[Value] {
        // SAFETY: compiled code has written that many.
        unsafe { std::slice::from_raw_parts(self.candidates, self.candidate as usize) }
    }

    /// Forgets the candidates.
    pub fn drop_candidates(&mut self) {
        for index in 0..self.candidate as usize {
            // SAFETY: written by compiled code, dropped once.
            unsafe { self.candidates.add(index).drop_in_place() };
        }
        self.candidate = 0;
    }
}
