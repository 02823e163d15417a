//! Update sets under construction (Börger & Stärk 2003, definitions 2.4.5 and 4.1.1).
//!
//! A *unit* is a rule whose updates must be consistent among themselves: the whole step, one part of a `seq`, one
//! round of a `while`, the body of a turbo call. Units nest; their updates are consecutive suffixes of one stack.
//! A location's *stamp* says whether the current unit holds an update for it, so a clash is found in constant time.
//!
//! A finished part of a `seq` is applied to the store at once. What it overwrites is logged once for each location; the
//! values in between are not kept. At the end of the `seq` the log is taken back, and the net effect (the U ⊕ V of the
//! book) joins the enclosing unit. So a read in an intermediate state costs nothing extra, and a loop takes memory only
//! for the locations that it writes, however often it writes them.

use program::{DomainId, RuleId};

use crate::layout::LocationIndex;
use crate::store::Store;
use crate::value::Value;
use crate::words::{put, shorten, swap, take};

/// One update: the new value of a location, and the place of the rule. Compiled code writes updates by their layout.
#[derive(Debug, Clone)]
#[repr(C)]
pub(crate) struct Update {
    pub location: LocationIndex,
    pub rule: RuleId,
    pub value: Value,
    /// The location's stamp before this update.
    pub previous: Stamp,
}

/// Which unit holds an update of a location, and where on the stack. Unit 0 is none.
#[derive(Debug, Clone, Copy, Default)]
#[repr(C)]
pub(crate) struct Stamp {
    pub unit: u32,
    pub index: u32,
}

impl Stamp {
    /// In place of an index: the unit gives the location the value that it has, which is not on the stack.
    pub const UNCHANGED: u32 = u32::MAX;
}

/// What a `seq` overwrote.
#[derive(Debug, Clone)]
struct Overwritten {
    location: LocationIndex,
    /// The rule that wrote the location last.
    rule: RuleId,
    before: Value,
    /// When that was.
    time: u64,
    /// The location's other entry in the log: of an enclosing sequence.
    previous: Logged,
}

/// Which sequence has logged a location last, and where in the log. Sequence 0 is none.
#[derive(Debug, Clone, Copy, Default)]
struct Logged {
    sequence: u32,
    index: u32,
}

// What is put together before it is put into a list is written in small pieces and read in large ones, for which a processor waits. So
// each field is written where it stays.
#[allow(unsafe_code)]
impl Update {
    #[inline(always)]
    fn append(stack: &mut Vec<Update>, location: LocationIndex, rule: RuleId, value: &mut Value, previous: Stamp) {
        stack.reserve(1);
        let place = stack.spare_capacity_mut()[0].as_mut_ptr();
        // SAFETY: there is room for one more, and all its fields are written before it counts.
        unsafe {
            (&raw mut (*place).location).write(location);
            (&raw mut (*place).rule).write(rule);
            put(&mut *(&raw mut (*place).value).cast(), value);
            (&raw mut (*place).previous).write(previous);
            stack.set_len(stack.len() + 1);
        }
    }
}

#[allow(unsafe_code)]
impl Overwritten {
    #[inline(always)]
    fn append(
        log: &mut Vec<Overwritten>,
        location: LocationIndex,
        rule: RuleId,
        before: &mut Value,
        (time, previous): (u64, Logged),
    ) {
        log.reserve(1);
        let place = log.spare_capacity_mut()[0].as_mut_ptr();
        // SAFETY: as above.
        unsafe {
            (&raw mut (*place).location).write(location);
            (&raw mut (*place).rule).write(rule);
            put(&mut *(&raw mut (*place).before).cast(), before);
            (&raw mut (*place).time).write(time);
            (&raw mut (*place).previous).write(previous);
            log.set_len(log.len() + 1);
        }
    }
}

/// A unit being computed.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Unit {
    enclosing: u32,
    updates: usize,
    created: usize,
}

/// A `seq` being computed.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sequence {
    enclosing: u32,
    log: usize,
    created: usize,
}

/// Two updates of one location with different values.
#[derive(Debug)]
pub(crate) struct Clash {
    pub location: LocationIndex,
    pub first: (Value, RuleId),
    pub second: (Value, RuleId),
}

/// The update set of the running step.
#[derive(Debug, Default)]
pub(crate) struct Updates {
    pub stack: Vec<Update>,
    /// Whether a value on the stack may own memory.
    pub compound: bool,
    pub stamps: Vec<Stamp>,
    log: Vec<Overwritten>,
    /// By location.
    logged: Vec<Logged>,
    /// The running sequence.
    sequence: u32,
    sequences: u32,
    /// How often something was overwritten.
    time: u64,
    /// Elements made by `extend`, with the domain that gets them.
    created: Vec<(DomainId, Value)>,
    unit: u32,
    /// The unit that is the whole step.
    outermost: u32,
    units: u32,
    /// The sequence that is the whole step need not be taken back at its end: whoever reads the update set reads it there.
    pub stays: bool,
    /// Such a sequence has ended, and its intermediate state is still there.
    standing: bool,
    merge: Vec<Overwritten>,
    /// The state before the step is shown, and the intermediate elements of each domain are kept here.
    original: bool,
    hidden: Vec<Vec<Value>>,
}

impl Updates {
    /// Begins a step; the last one was committed ([`Updates::release`]) or rolled back.
    pub fn begin(&mut self) {
        if self.units.max(self.sequences) > u32::MAX / 2 {
            self.renumbered();
        }
        // Unit numbers are never used again, so an old stamp cannot be mistaken for a new one.
        self.units += 1;
        self.unit = self.units;
        self.outermost = self.unit;
    }

    /// Whether the current unit is the whole step.
    pub fn is_outermost(&self) -> bool {
        self.unit == self.outermost
    }

    /// Location numbers have changed: no stamp is valid any more.
    pub fn renumbered(&mut self) {
        self.stamps.clear();
        self.logged.clear();
        (self.units, self.sequences, self.sequence) = (0, 0, 0);
    }

    /// The current unit.
    pub fn unit(&self) -> u32 {
        self.unit
    }

    /// Makes stamps for so many locations at least.
    #[inline]
    pub fn cover(&mut self, locations: usize) {
        if self.stamps.len() < locations {
            self.stamps.resize(locations, Stamp::default());
        }
    }

    /// The current unit's update of a location.
    pub fn held(&self, location: LocationIndex) -> Option<&Update> {
        let stamp = self.stamps.get(location as usize)?;
        (stamp.unit == self.unit && stamp.index != Stamp::UNCHANGED).then(|| &self.stack[stamp.index as usize])
    }

    /// Whether the current unit gives a location the value that it has, without an update on the stack.
    pub fn leaves(&self, location: LocationIndex) -> bool {
        let stamp = self.stamps.get(location as usize);
        stamp.is_some_and(|stamp| stamp.unit == self.unit && stamp.index == Stamp::UNCHANGED)
    }

    /// How many updates the step has so far.
    pub fn len(&self) -> usize {
        self.stack.len()
    }

    /// The elements made in the step.
    pub fn created(&self) -> &[(DomainId, Value)] {
        &self.created
    }

    /// The update set has been applied: what remains on the stack is a record of it.
    pub fn settle(&mut self) {
        self.log.clear();
        self.created.clear();
    }

    /// Empties the update set, keeping its memory.
    pub fn release(&mut self) {
        self.clear_stack();
        self.log.clear();
        self.created.clear();
    }

    /// Adds an update to the current unit.
    #[inline]
    pub fn push(&mut self, location: LocationIndex, mut value: Value, rule: RuleId) -> Result<(), Box<Clash>> {
        self.push_taken(location, &mut value, rule)
    }

    /// Adds an update to the current unit, and takes its value.
    fn push_taken(&mut self, location: LocationIndex, value: &mut Value, rule: RuleId) -> Result<(), Box<Clash>> {
        if location as usize >= self.stamps.len() {
            self.stamps.resize(location as usize + 1, Stamp::default());
        }
        let stamp = &mut self.stamps[location as usize];
        if stamp.unit == self.unit && stamp.index == Stamp::UNCHANGED {
            // Only compiled code leaves such stamps; it gives the step up, and the interpreter says whether this is one.
            let clash = Clash { location, first: (Value::Undef, rule), second: (take(value), rule) };
            return Err(Box::new(clash));
        }
        if stamp.unit == self.unit {
            let held = &self.stack[stamp.index as usize];
            if held.value == *value {
                return Ok(());
            }
            let first = (held.value.clone(), held.rule);
            return Err(Box::new(Clash { location, first, second: (take(value), rule) }));
        }
        self.compound |= !value.is_scalar();
        let previous = *stamp;
        *stamp = Stamp { unit: self.unit, index: self.stack.len() as u32 };
        Update::append(&mut self.stack, location, rule, value, previous);
        Ok(())
    }

    /// Records an element made by `extend`.
    pub fn create(&mut self, domain: DomainId, element: Value) {
        self.created.push((domain, element));
    }

    /// Begins a unit inside the current one.
    pub fn open(&mut self) -> Unit {
        let unit = Unit { enclosing: self.unit, updates: self.stack.len(), created: self.created.len() };
        self.units += 1;
        self.unit = self.units;
        unit
    }

    /// Whether the unit has no update and made no element.
    pub fn is_empty(&self, unit: Unit) -> bool {
        self.stack.len() == unit.updates && self.created.len() == unit.created
    }

    /// Ends a unit by joining its updates to the enclosing one; an update of `dropped` is left out and its value
    /// given back.
    pub fn join(&mut self, unit: Unit, dropped: Option<LocationIndex>) -> Result<Option<Value>, Box<Clash>> {
        let updates = self.close(unit);
        let mut result = None;
        for update in updates {
            if Some(update.location) == dropped {
                result = Some(update.value);
            } else {
                self.push(update.location, update.value, update.rule)?;
            }
        }
        Ok(result)
    }

    /// Takes the unit's updates off the stack and makes the enclosing unit current.
    fn close(&mut self, unit: Unit) -> Vec<Update> {
        let updates: Vec<Update> = self.stack.drain(unit.updates..).collect();
        for update in updates.iter().rev() {
            self.stamps[update.location as usize] = update.previous;
        }
        self.unit = unit.enclosing;
        updates
    }

    /// Begins a `seq`.
    pub fn begin_sequence(&mut self) -> Sequence {
        self.sequences += 1;
        let enclosing = std::mem::replace(&mut self.sequence, self.sequences);
        Sequence { enclosing, log: self.log.len(), created: self.created.len() }
    }

    /// Ends a part of a `seq`: its updates become the intermediate state.
    pub fn apply(&mut self, unit: Unit, store: &mut Store) {
        if self.logged.len() < self.stamps.len() {
            self.logged.resize(self.stamps.len(), Logged::default());
        }
        let mut may_own = false;
        for update in self.stack[unit.updates..].iter_mut().rev() {
            let Update { location, rule, previous, ref mut value } = *update;
            self.stamps[location as usize] = previous;
            swap(&mut store.values[location as usize], value);
            self.time += 1;
            let time = self.time;
            let logged = &mut self.logged[location as usize];
            if logged.sequence == self.sequence {
                let entry = &mut self.log[logged.index as usize];
                (entry.rule, entry.time) = (rule, time);
                may_own |= !value.is_scalar();
                continue;
            }
            let at = self.log.len();
            let previous = std::mem::replace(logged, Logged { sequence: self.sequence, index: at as u32 });
            Overwritten::append(&mut self.log, location, rule, value, (time, previous));
        }
        shorten(&mut self.stack, unit.updates, may_own);
        self.unit = unit.enclosing;
        for (domain, element) in &self.created[unit.created..] {
            store.carriers[domain.0 as usize].intermediate.push(element.clone());
        }
    }

    /// Ends a `seq`: takes the intermediate state back and adds the net effect to the current unit, leaving out
    /// updates of locations for which `local` holds.
    pub fn end_sequence(
        &mut self,
        sequence: Sequence,
        store: &mut Store,
        local: &dyn Fn(&Store, LocationIndex) -> bool,
    ) -> Result<(), Box<Clash>> {
        let mut merge = std::mem::take(&mut self.merge);
        merge.clear();
        while self.log.len() > sequence.log {
            let mut entry = self.log.pop().expect("longer than the sequence's start");
            swap(&mut store.values[entry.location as usize], &mut entry.before);
            self.logged[entry.location as usize] = entry.previous;
            merge.push(entry); // `before` now holds the value after
        }
        self.sequence = sequence.enclosing;
        self.forget_intermediate(sequence.created, store);
        // What was written last comes first.
        if !merge.is_sorted_by(|one, other| one.time > other.time) {
            merge.sort_unstable_by_key(|entry| std::cmp::Reverse(entry.time));
        }
        let mut outcome = Ok(());
        for entry in merge.drain(..) {
            if local(store, entry.location) {
                continue;
            }
            outcome = self.push(entry.location, entry.before, entry.rule);
            if outcome.is_err() {
                break;
            }
        }
        self.merge = merge;
        outcome
    }

    /// The same of all locations, in one pass over the log. The order of the updates, and so which of several clashes is found, is
    /// not that of [`Updates::end_sequence`].
    pub fn end_sequence_at_once(&mut self, sequence: Sequence, store: &mut Store) -> Result<(), Box<Clash>> {
        let (mut outcome, mut may_own) = (Ok(()), false);
        let mut log = std::mem::take(&mut self.log);
        for entry in log[sequence.log..].iter_mut().rev() {
            swap(&mut store.values[entry.location as usize], &mut entry.before);
            self.logged[entry.location as usize] = entry.previous;
            if outcome.is_ok() {
                outcome = self.push_taken(entry.location, &mut entry.before, entry.rule);
                may_own |= !entry.before.is_scalar();
            } else {
                may_own = true;
            }
        }
        shorten(&mut log, sequence.log, may_own);
        self.log = log;
        self.sequence = sequence.enclosing;
        self.forget_intermediate(sequence.created, store);
        outcome
    }

    /// Ends a `seq` that is the whole step, where its intermediate state may stay: what its log tells is the update set.
    pub fn leave_sequence(&mut self) {
        debug_assert!(self.stays && self.stack.is_empty() && self.is_outermost());
        self.standing = true;
    }

    /// The updates, each with its value.
    pub fn net<'u>(&'u self, store: &'u Store) -> impl Iterator<Item = (LocationIndex, &'u Value)> {
        let log = if self.standing { &self.log[..] } else { &[] };
        let written = log.iter().map(|entry| (entry.location, &store.values[entry.location as usize]));
        self.stack.iter().map(|update| (update.location, &update.value)).chain(written)
    }

    /// Whether the intermediate state has overwritten a location.
    pub fn has_overwritten(&self, location: LocationIndex) -> bool {
        self.logged.get(location as usize).is_some_and(|logged| logged.sequence != 0)
    }

    /// Takes back every intermediate state and empties the update set; returns whether there was anything.
    pub fn roll_back(&mut self, store: &mut Store) -> bool {
        let any = !(self.stack.is_empty() && self.log.is_empty() && self.created.is_empty());
        let mut may_own = false;
        for entry in self.log.iter_mut().rev() {
            swap(&mut store.values[entry.location as usize], &mut entry.before);
            self.logged[entry.location as usize] = entry.previous;
            may_own |= !entry.before.is_scalar();
        }
        shorten(&mut self.log, 0, may_own);
        self.sequence = 0;
        self.standing = false;
        self.forget_intermediate(0, store);
        for (domain, _) in &self.created {
            let carrier = &mut store.carriers[domain.0 as usize];
            carrier.fresh = carrier.count;
        }
        self.release();
        any
    }

    /// Takes elements out of the intermediate state. INVARIANT: those that were made last stand last in it; one whose part of
    /// a `seq` was not finished never came there.
    fn forget_intermediate(&self, from: usize, store: &mut Store) {
        for (domain, element) in self.created[from..].iter().rev() {
            let intermediate = &mut store.carriers[domain.0 as usize].intermediate;
            if intermediate.last() == Some(element) {
                intermediate.pop();
            }
        }
    }

    /// Whether the state before the step has replaced the intermediate one.
    pub fn shows_original(&self) -> bool {
        self.original
    }

    /// Puts the state before the step in place of the intermediate one, or back again: an involution.
    pub fn swap_original(&mut self, store: &mut Store, back: bool) {
        self.original = !back;
        self.hidden.resize(store.carriers.len(), Vec::new());
        for (carrier, hidden) in store.carriers.iter_mut().zip(&mut self.hidden) {
            std::mem::swap(&mut carrier.intermediate, hidden);
        }
        let mut swap = |entry: &mut Overwritten| {
            std::mem::swap(&mut store.values[entry.location as usize], &mut entry.before);
        };
        if back {
            self.log.iter_mut().for_each(&mut swap);
        } else {
            self.log.iter_mut().rev().for_each(&mut swap);
        }
    }
}
