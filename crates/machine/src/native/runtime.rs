//! What compiled code calls: the machine's own operations, with values passed by pointer.
//!
//! Every helper works on the machine that the context belongs to. One that meets a fault says so (null, −1 or 1)
//! and drops it: the step is then rolled back and interpreted, which reports it ([`crate::native`]). INVARIANT: what
//! a helper does to the machine, rolling back the update set undoes, or doing it again does nothing.
//!
//! Compiled code promises every helper three things, which the SAFETY comments call by name:
//! - *context*: it passes the context of the step that runs. Executor and memory live as long as that step, and nothing
//!   else uses them during the call: compiled code holds pointers only, and reads those that may move anew after it.
//! - *values*: a pointer to a value leads to one that is initialised and that nothing drops before the statement ends: a
//!   constant, a location's, one kept for the statement, two words on the code's stack. A list has as many as it says.
//! - *numbers*: the numbers of tables, and what is asked of them, are those that the code was compiled with.
#![allow(unsafe_code)]

use std::mem::ManuallyDrop;

use program::{DomainId, FunctionId, RuleId, Term, TermId};
use smallvec::SmallVec;
use syntax::{FileId, Span};

use crate::environment::Choice;
use crate::evaluate::collection;
use crate::execute::{Core, Executor, Outcome};
use crate::native::comprehension::kind_of;
use crate::native::context::Context;
pub(super) use crate::native::gathered::{arrange, extend, items, make, position};
use crate::native::memory::Collected;
use crate::update::Stamp;
use crate::value::Value;
use crate::words::is_same_scalar;
use crate::work::INTERVAL;

type Pointer = *mut Context;

const NOWHERE: Span = Span { file: FileId(0), start: 0, end: 0 };
/// The step cannot go on here.
const BAIL: i64 = 1;

/// Operands, not owned: bit copies of values that live elsewhere.
type Operands = SmallVec<[ManuallyDrop<Value>; 6]>;

/// A slice of values out of borrowed ones.
fn slice(operands: &Operands) -> &[Value] {
    // SAFETY: `ManuallyDrop<Value>` has the layout of `Value`.
    unsafe { std::slice::from_raw_parts(operands.as_ptr().cast::<Value>(), operands.len()) }
}

/// # Safety
/// `pointers` are `count` pointers to living values.
unsafe fn borrow(pointers: *const *const Value, count: u64) -> Operands {
    // SAFETY: as the caller promises; the copies are never dropped and do not outlive the originals.
    (0..count as usize).map(|i| unsafe { ManuallyDrop::new(std::ptr::read(*pointers.add(i))) }).collect()
}

fn kept(context: &mut Context, outcome: Outcome<Value>) -> *const Value {
    match outcome {
        Ok(value) => context.keep(value),
        Err(_) => std::ptr::null(),
    }
}

fn status(outcome: Outcome<()>) -> i64 {
    if outcome.is_ok() { 0 } else { BAIL }
}

/// Room for one more update.
pub unsafe extern "C" fn grow(context: Pointer) -> i64 {
    // SAFETY: *context*; the code reads anew where the stack is, which moves here.
    unsafe {
        Context::with(context, |executor, _| {
            let stack = &mut executor.core.updates.stack;
            if stack.len() as u64 >= executor.limits.updates {
                return BAIL;
            }
            let room = (stack.len() as u64 * 2).clamp(64, executor.limits.updates.max(64));
            stack.reserve_exact(room as usize - stack.len());
            0
        })
    }
}

/// Above the number of a rule: its update may be left out where it leaves the location as it is.
pub(super) const MAY_LEAVE: u64 = 1 << 32;

/// Adds an update of a scalar to the current unit.
pub unsafe extern "C" fn push(context: Pointer, location: u64, tag: u64, payload: u64, rule: u64) -> i64 {
    // SAFETY: *context*; the stamps and the values are as many as the locations, of which the code knows the number; the two
    // words are those of a scalar, which can be copied; below the capacity there is room on the stack.
    unsafe {
        let place = (*context).stamps.add(location as usize);
        let previous = *place;
        if u64::from(previous.unit) == (*context).unit {
            return agrees_with(context, location, tag, payload);
        }
        let unit = (*context).unit as u32;
        if (*context).terse != 0
            && rule & MAY_LEAVE != 0
            && is_same_scalar([tag, payload], &*(*context).values.add(location as usize))
        {
            *place = Stamp { unit, index: Stamp::UNCHANGED };
            return 0;
        }
        if (*context).held == (*context).capacity && grow(context) != 0 {
            return BAIL;
        }
        let index = (*context).held;
        // Field by field, as compiled code does.
        let update = (*context).stack.add(index as usize);
        (&raw mut (*update).location).write(location as u32);
        (&raw mut (*update).rule).write(RuleId(rule as u32));
        let value = (&raw mut (*update).value).cast::<u64>();
        value.write(tag);
        value.add(1).write(payload);
        (&raw mut (*update).previous).write(previous);
        // The stack's growing moves no stamp.
        *place = Stamp { unit, index: index as u32 };
        (*context).held = index + 1;
    }
    0
}

/// The same as [`agrees`] of a scalar, by its words.
#[cold]
unsafe fn agrees_with(context: Pointer, location: u64, tag: u64, payload: u64) -> i64 {
    let words = [tag, payload];
    // SAFETY: as the caller promises; the two words are those of a scalar.
    unsafe { agrees(context, location as i64, std::ptr::from_ref(&words).cast::<Value>()) }
}

/// Whether the current unit's update of a location has this value.
pub unsafe extern "C" fn agrees(context: Pointer, location: i64, value: *const Value) -> i64 {
    // SAFETY: *context* and *values*; looking for the update that is held moves and changes no value.
    unsafe {
        let value = &*value;
        Context::with(context, |executor, _| {
            let Core { updates, store, .. } = &*executor.core;
            let agrees = match updates.leaves(location as u32) {
                true => store.values[location as usize] == *value,
                false => updates.held(location as u32).is_some_and(|held| held.value == *value),
            };
            if agrees { 0 } else { BAIL }
        })
    }
}

/// The value of a location, asked for where it is an input.
pub unsafe extern "C" fn read(
    context: Pointer,
    function: i64,
    arguments: *const *const Value,
    count: u64,
) -> *const Value {
    // SAFETY: *context* and *values*; where the store grows, its values move, and the words borrowed stay good.
    unsafe {
        let arguments = borrow(arguments, count);
        Context::with(context, |executor, context| {
            let value = executor.read(FunctionId(function as u32), slice(&arguments), NOWHERE);
            kept(context, value)
        })
    }
}

/// Asks for an input whose location has a number.
pub unsafe extern "C" fn ask(
    context: Pointer,
    function: i64,
    arguments: *const *const Value,
    count: u64,
    index: i64,
) -> i64 {
    // SAFETY: *context* and *values*; the arguments are read before the input is written.
    unsafe {
        let arguments = borrow(arguments, count);
        Context::with(context, |executor, _| {
            i64::from(!executor.ask_at(FunctionId(function as u32), slice(&arguments), index as u32))
        })
    }
}

/// The number of a location about to be updated.
pub unsafe extern "C" fn locate(context: Pointer, function: i64, arguments: *const *const Value, count: u64) -> i64 {
    // SAFETY: *context* and *values*; where the store grows, its values move, and the words borrowed stay good.
    unsafe {
        let arguments = borrow(arguments, count);
        let function = FunctionId(function as u32);
        Context::with(context, |executor, _| {
            let found = executor.core.store.find(function, slice(&arguments));
            let initial = executor.core.initials[function.0 as usize].is_some()
                && found.is_none_or(|index| executor.core.store.given[index as usize] == 0);
            if initial && executor.read(function, slice(&arguments), NOWHERE).is_err() {
                return -1;
            }
            if executor.core.store.len() as u64 > executor.limits.locations {
                return -1;
            }
            i64::from(executor.core.store.number(function, slice(&arguments)))
        })
    }
}

/// Whether a value may be written to a function.
pub unsafe extern "C" fn member(context: Pointer, function: i64, value: *const Value) -> i64 {
    // SAFETY: *context* and *values*; no location changes while the value is looked at.
    unsafe {
        let value = &*value;
        Context::with(context, |executor, _| i64::from(executor.is_member(FunctionId(function as u32), value)))
    }
}

/// Applies a library function, or builds a tuple or collection.
pub unsafe extern "C" fn apply(context: Pointer, term: i64, operands: *const *const Value, count: u64) -> *const Value {
    // SAFETY: *context* and *values*; what the operands share is counted again where the result keeps it.
    unsafe {
        let operands = borrow(operands, count);
        Context::with(context, |executor, context| {
            let id = TermId(term as u32);
            let outcome = match executor.program.term(id) {
                Term::Builtin { builtin, .. } => executor.apply(*builtin, slice(&operands), id),
                Term::Tuple(_) => executor.made(Value::tuple(slice(&operands).to_vec()), NOWHERE),
                Term::Collection { kind, .. } => executor.made(collection(*kind, slice(&operands).to_vec()), NOWHERE),
                _ => unreachable!("only these are applied"),
            };
            kept(context, outcome)
        })
    }
}

/// A component of a tuple, where the tuple keeps it; null of anything else.
pub unsafe extern "C" fn component(tuple: *const Value, index: i64) -> *const Value {
    // SAFETY: *values*; the part belongs to the tuple and lives as long.
    match unsafe { &*tuple } {
        Value::Tuple(parts) => &parts[index as usize],
        _ => std::ptr::null(),
    }
}

/// Whether two values are equal.
pub unsafe extern "C" fn equal(left: *const Value, right: *const Value) -> i64 {
    // SAFETY: *values*.
    unsafe { i64::from(*left == *right) }
}

/// Writes a copy of a value to a place that holds none: an update or a candidate.
pub unsafe extern "C" fn copy(context: Pointer, value: *const Value, place: *mut Value) {
    // SAFETY: *context* and *values*; the code has room at the place and has not counted it yet, so no value is there.
    unsafe {
        place.write((*value).clone());
        Context::mark_compound(context);
    }
}

/// Keeps a copy of a value until the statement ends.
pub unsafe extern "C" fn keep(context: Pointer, value: *const Value) -> *const Value {
    // SAFETY: *context* and *values*; it is copied before the kept values, of which it may be one, become more.
    unsafe { (*context).keep((*value).clone()) }
}

/// Ends a statement.
pub unsafe extern "C" fn release(context: Pointer, mark: u64) {
    // SAFETY: *context*; the code takes the mark at the beginning of the statement that ends here.
    unsafe { (*context).release(mark) }
}

/// Opens a frame with the variables that an interpreted part reads.
///
/// # Safety
/// *context*, *numbers* and *values* hold, and `values` are as many as the spill lists slots.
unsafe fn in_spilled_frame<T>(
    context: Pointer,
    spill: u64,
    values: *const *const Value,
    body: impl FnOnce(&mut Executor<'static>) -> Outcome<T>,
) -> Option<T> {
    // SAFETY: as the caller promises.
    unsafe {
        let (frame, slots) = &Context::memory(context).numbered.spills[spill as usize];
        let values = borrow(values, slots.len() as u64);
        let slots: &[u32] = slots;
        let frame = *frame;
        Context::with(context, |executor, _| {
            let start = executor.core.frames.len();
            executor.core.frames.resize(start + frame as usize, Value::Undef);
            for (slot, value) in slots.iter().zip(slice(&values)) {
                executor.core.frames[start + *slot as usize] = value.clone();
            }
            executor.in_frame(start, frame, NOWHERE, body).ok()
        })
    }
}

/// Evaluates a term by interpretation.
pub unsafe extern "C" fn evaluate(
    context: Pointer,
    term: i64,
    spill: u64,
    values: *const *const Value,
) -> *const Value {
    // SAFETY: *context*, *numbers* and *values*, of which the code spills as many as the table lists.
    unsafe {
        match in_spilled_frame(context, spill, values, |executor| executor.evaluate(TermId(term as u32))) {
            Some(value) => (*context).keep(value),
            None => std::ptr::null(),
        }
    }
}

/// Runs a rule by interpretation.
pub unsafe extern "C" fn perform(context: Pointer, rule: i64, spill: u64, values: *const *const Value) -> i64 {
    // SAFETY: *context*, *numbers* and *values*, of which the code spills as many as the table lists.
    unsafe {
        let done = in_spilled_frame(context, spill, values, |executor| executor.perform(RuleId(rule as u32)));
        if done.is_some() { 0 } else { BAIL }
    }
}

/// Begins to collect the elements of a comprehension.
pub unsafe extern "C" fn collect(context: Pointer) {
    // SAFETY: *context*; the memory is no part of the executor.
    unsafe { Context::memory(context).collections.push(Collected::default()) };
}

/// Adds an element to the comprehension that was begun last.
pub unsafe extern "C" fn add(context: Pointer, element: *const Value) -> i64 {
    // SAFETY: *context* and *values*; neither store nor update set is touched.
    unsafe {
        let Some(collected) = Context::memory(context).collections.last_mut() else { return BAIL };
        let element = (*element).clone();
        // Sorting compares what is shared again and again: its size is held against the limit before.
        collected.leaves = collected.leaves.saturating_add(element.weight().leaves);
        collected.elements.push(element);
        status(Context::executor(context).check_size(collected.leaves, NOWHERE))
    }
}

/// The collection of a comprehension whose elements were all added.
pub unsafe extern "C" fn collected(context: Pointer, kind: i64) -> *const Value {
    // SAFETY: *context*; the memory is no part of the executor, so both may be changed at once.
    unsafe {
        let Some(collected) = Context::memory(context).collections.pop() else { return std::ptr::null() };
        let value = collection(kind_of(kind), collected.elements);
        Context::with(context, |executor, context| kept(context, executor.made(value, NOWHERE)))
    }
}

/// The elements of a domain as a sequence.
pub unsafe extern "C" fn elements(context: Pointer, domain: i64) -> *const Value {
    // SAFETY: *context*.
    unsafe {
        Context::with(context, |executor, context| {
            let outcome = executor.listed(DomainId(domain as u32), NOWHERE).map(Value::Seq);
            kept(context, outcome)
        })
    }
}

/// Where the elements of a collection are and how many, written to two words.
pub unsafe extern "C" fn range(context: Pointer, collection: *const Value, out: *mut [u64; 2]) -> i64 {
    // SAFETY: *context* and *values*; `out` is two words on the code's stack. The items live as long as their
    // collection, and one made here is kept for the statement.
    unsafe {
        let items: &[Value] = match &*collection {
            Value::Set(items) | Value::Seq(items) => items,
            Value::Map(entries) => {
                let pairs = entries.iter().map(|(key, value)| Value::tuple(vec![key.clone(), value.clone()]));
                let place = (*context).keep(Value::seq(pairs.collect()));
                return if place.is_null() { BAIL } else { range(context, place, out) };
            }
            Value::Bag(counts) => {
                let all = counts.iter().flat_map(|(value, n)| std::iter::repeat_n(value.clone(), *n as usize));
                let place = (*context).keep(Value::seq(all.collect()));
                return if place.is_null() { BAIL } else { range(context, place, out) };
            }
            _ => return BAIL,
        };
        *out = [items.as_ptr() as u64, items.len() as u64];
    }
    0
}

/// Begins a `seq`.
pub unsafe extern "C" fn begin_sequence(context: Pointer) {
    // SAFETY: *context*; the memory is no part of the executor, so both may be changed at once.
    unsafe {
        let memory = Context::memory(context);
        Context::with(context, |executor, _| {
            let version = executor.core.memo.version();
            memory.sequences.push((executor.core.updates.begin_sequence(), version));
        });
    }
}

/// Ends a `seq`, joining its net effect to the unit around it.
pub unsafe extern "C" fn end_sequence(context: Pointer) -> i64 {
    // SAFETY: *context*; the memory is no part of the executor, so both may be changed at once.
    unsafe {
        let memory = Context::memory(context);
        Context::with(context, |executor, _| {
            let Some((sequence, version)) = memory.sequences.pop() else { return BAIL };
            let core = &mut *executor.core;
            core.memo.back_to(version);
            // Which of several clashes is told, the interpreter decides.
            let ended = core.updates.end_sequence_at_once(sequence, &mut core.store);
            i64::from(ended.is_err())
        })
    }
}

/// Ends a `seq` that is the whole step: nothing is read or updated after it.
pub unsafe extern "C" fn end_last_sequence(context: Pointer) -> i64 {
    // SAFETY: *context*; the memory is no part of the executor.
    unsafe {
        if (*context).held == 0 && Context::executor(context).core.updates.stays {
            let sequence = Context::memory(context).sequences.pop();
            Context::with(context, |executor, _| executor.core.updates.leave_sequence());
            return i64::from(sequence.is_none());
        }
        end_sequence(context)
    }
}

/// Opens a unit.
pub unsafe extern "C" fn open(context: Pointer) {
    // SAFETY: *context*; the memory is no part of the executor, so both may be changed at once.
    unsafe {
        let memory = Context::memory(context);
        Context::with(context, |executor, _| memory.units.push(executor.core.updates.open()));
    }
}

/// Ends a part of a `seq`; tells whether it made updates.
pub unsafe extern "C" fn apply_unit(context: Pointer) -> i64 {
    // SAFETY: *context*; the memory is no part of the executor, so both may be changed at once.
    unsafe {
        let memory = Context::memory(context);
        Context::with(context, |executor, _| {
            let Some(unit) = memory.units.pop() else { return 0 };
            let core = &mut *executor.core;
            let any = !core.updates.is_empty(unit);
            core.updates.apply(unit, &mut core.store);
            if any {
                core.memo.changed();
            }
            i64::from(any)
        })
    }
}

/// Ends a turbo call's unit.
pub unsafe extern "C" fn join(context: Pointer) -> i64 {
    // SAFETY: *context*; the memory is no part of the executor, so both may be changed at once.
    unsafe {
        let memory = Context::memory(context);
        Context::with(context, |executor, _| match memory.units.pop() {
            Some(unit) => i64::from(executor.core.updates.join(unit, None).is_err()),
            None => BAIL,
        })
    }
}

/// Counts a round of a loop.
pub unsafe extern "C" fn iteration(context: Pointer) -> i64 {
    // SAFETY: *context*.
    unsafe { Context::with(context, |executor, _| status(executor.count_iteration(NOWHERE))) }
}

/// Makes a fresh element; its number.
pub unsafe extern "C" fn create(context: Pointer, domain: i64) -> i64 {
    // SAFETY: *context*.
    unsafe {
        Context::with(context, |executor, _| match executor.create(DomainId(domain as u32), NOWHERE) {
            Ok(Value::Element(_, number)) => i64::from(number),
            _ => -1,
        })
    }
}

/// Lets the environment choose among the candidates written; its index.
pub unsafe extern "C" fn choose(context: Pointer, rule: i64, variables: u64) -> i64 {
    // SAFETY: *context*; the candidates counted have been written.
    unsafe {
        Context::with(context, |executor, context| {
            let values = context.candidate_slice();
            let count = values.len() / variables.max(1) as usize;
            if values.len() as u64 > executor.limits.collection {
                return -1;
            }
            let span = executor.program.rule_span(RuleId(rule as u32));
            let choice = Choice { span, values, variables: variables as usize };
            match executor.core.choices.choose(&mut *executor.environment, executor.program, &choice) {
                Ok(chosen) if chosen < count => chosen as i64,
                _ => -1,
            }
        })
    }
}

/// Lets the environment choose among candidates that never change; the index of the one.
pub unsafe extern "C" fn choose_of(
    context: Pointer,
    rule: i64,
    values: *const Value,
    count: u64,
    variables: u64,
) -> i64 {
    // SAFETY: *context*, and a choice touches neither store nor update set; the values belong to the code, are `count`
    // times `variables`, and live as long as it.
    unsafe {
        let values = std::slice::from_raw_parts(values, (count * variables) as usize);
        let executor = Context::executor(context);
        let span = executor.program.rule_span(RuleId(rule as u32));
        let choice = Choice { span, values, variables: variables as usize };
        match executor.core.choices.choose(&mut *executor.environment, executor.program, &choice) {
            Ok(chosen) if chosen < count as usize => chosen as i64,
            _ => -1,
        }
    }
}

/// Makes room for more candidates.
pub unsafe extern "C" fn more_candidates(context: Pointer) -> i64 {
    // SAFETY: *context*; the memory is no part of the context, so both may be changed at once.
    unsafe {
        let memory = Context::memory(context);
        if (*context).more_candidates(memory) { 0 } else { BAIL }
    }
}

/// Forgets the candidates.
pub unsafe extern "C" fn drop_candidates(context: Pointer) {
    // SAFETY: *context*; the candidates counted have been written, and are counted no more.
    unsafe { (*context).drop_candidates() }
}

/// The program of an agent.
pub unsafe extern "C" fn agent_program(context: Pointer, agent: *const Value) -> i64 {
    // SAFETY: *context* and *values*; no location changes while the agent is looked at.
    unsafe {
        let agent = &*agent;
        Context::with(context, |executor, _| executor.agent_program(agent).map_or(-1, |id| i64::from(id.0)))
    }
}

/// Evaluates an entry of a table of fixed terms.
pub unsafe extern "C" fn fill(context: Pointer, table: u64, entry: i64, values: *const *const Value) -> i64 {
    // SAFETY: *context*, *numbers* and *values*, of which the code spills as many as the table lists.
    unsafe {
        let numbered = std::sync::Arc::clone(&Context::memory(context).numbered);
        let fixed = &numbered.fixed[table as usize];
        match in_spilled_frame(context, fixed.spill, values, |executor| executor.evaluate(fixed.term)) {
            Some(value) => {
                Context::memory(context).fill(table as usize, entry as usize, value);
                0
            }
            None => BAIL,
        }
    }
}

/// Keeps the value of a derived function at a place for the state as it is.
pub unsafe extern "C" fn keep_derived(context: Pointer, place: i64, mark: i64, value: *const Value) {
    // SAFETY: *context* and *values*; it is copied before the kept value, which it may be, changes.
    unsafe {
        let value = (*value).clone();
        Context::with(context, |executor, _| executor.core.memo.keep((place as u32, mark as u64), value));
    }
}

/// Looks whether the step is to end, when its budget is spent.
pub unsafe extern "C" fn look(context: Pointer) -> i64 {
    // SAFETY: *context*.
    unsafe {
        Context::with(context, |executor, context| {
            let spent = INTERVAL as i64 - std::mem::replace(&mut context.budget, INTERVAL as i64);
            executor.works(u64::try_from(spent).unwrap_or(0));
            status(executor.look(NOWHERE))
        })
    }
}
