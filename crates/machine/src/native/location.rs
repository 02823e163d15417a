//! Locations: their numbers, reading them, updating them.
//!
//! A location of a dense function is found by arithmetic on its arguments; one outside the array, or of a sparse
//! function, by a helper.

use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::{self, InstBuilder, types};
use program::{FunctionId, FunctionKind, RuleId, TermId};

use crate::layout::{Dimension, DimensionKind, Layout};
use crate::membership::Membership;
use crate::native::context::Offset;
use crate::native::helper;
use crate::native::runtime::MAY_LEAVE;
use crate::native::shape::{Kind, Operand, Scalar};
use crate::native::translate::{FLAGS, Translator};
use crate::update::{Stamp, Update};
use crate::value::Value;

/// Where a location is: its number, and a byte that is zero where the number must be looked up instead.
struct Found {
    index: ir::Value,
    inside: Option<ir::Value>,
    /// The array's first location, and the arguments' parts of the offset, where nothing has to be checked.
    parts: Option<(u32, Vec<ir::Value>)>,
}

impl Translator<'_, '_> {
    /// The offset of arguments in an array, and a byte that is zero where they lie outside; none if never.
    pub fn offset(
        &mut self,
        dimensions: &[Dimension],
        arguments: &[Operand],
    ) -> Option<(ir::Value, Option<ir::Value>)> {
        let mut offset: Option<ir::Value> = None;
        let mut inside: Option<ir::Value> = None;
        for (dimension, argument) in dimensions.iter().zip(arguments) {
            let size = i64::from(dimension.size);
            let (kind, low) = match dimension.kind {
                DimensionKind::Boolean => (Kind::Boolean, 0),
                DimensionKind::Enum(domain) => (Kind::Enum(domain), 0),
                DimensionKind::Element(domain) => (Kind::Element(domain), 0),
                DimensionKind::Integer { low } => (Kind::Integer, low),
            };
            let scalar = match argument {
                Operand::Scalar(scalar) if scalar.kind == kind => *scalar,
                Operand::Boxed(_) | Operand::Shelved(_) | Operand::Stored(_) => self.scalar(*argument, kind),
                _ => return None,
            };
            let mut checks = Vec::from_iter(scalar.flag);
            let mut index = scalar.value;
            if kind == Kind::Boolean {
                index = self.builder.ins().uextend(types::I64, index);
            } else {
                if low != 0 {
                    index = self.builder.ins().iadd_imm(index, low.wrapping_neg());
                }
                let bounds = self.plan.bounds(self.program, scalar);
                let fits = bounds.is_some_and(|(a, b)| low <= a && b < low + size);
                if !fits {
                    checks.push(self.builder.ins().icmp_imm(IntCC::UnsignedLessThan, index, size));
                }
            }
            for check in checks {
                inside = Some(match inside {
                    Some(before) => self.builder.ins().band(before, check),
                    None => check,
                });
            }
            offset = Some(match offset {
                Some(before) => {
                    let scaled = self.builder.ins().imul_imm(before, size);
                    self.builder.ins().iadd(scaled, index)
                }
                None => index,
            });
        }
        Some((offset?, inside))
    }

    /// The parts of an offset in bytes, one an argument, each of which is often the same in several locations.
    pub fn parts(&mut self, dimensions: &[Dimension], arguments: &[Operand]) -> Option<Vec<ir::Value>> {
        let mut parts = Vec::new();
        let mut stride = 16i64;
        for (dimension, argument) in dimensions.iter().zip(arguments).rev() {
            let Operand::Scalar(scalar) = argument else { return None };
            let mut index = scalar.value;
            match dimension.kind {
                DimensionKind::Boolean => index = self.builder.ins().uextend(types::I64, index),
                DimensionKind::Integer { low } if low != 0 => {
                    index = self.builder.ins().iadd_imm(index, low.wrapping_neg());
                }
                _ => {}
            }
            parts.push(self.builder.ins().imul_imm(index, stride));
            stride *= i64::from(dimension.size);
        }
        parts.reverse();
        Some(parts)
    }

    fn find(&mut self, function: FunctionId, arguments: &[Operand]) -> Option<Found> {
        match self.plan.facts.layouts[function.0 as usize].clone() {
            Layout::Single(index) => {
                Some(Found { index: self.word(i64::from(index)), inside: None, parts: Some((index, Vec::new())) })
            }
            Layout::Dense { base, dimensions, .. } => {
                let (offset, inside) = self.offset(&dimensions, arguments)?;
                let index = self.builder.ins().iadd_imm(offset, i64::from(base));
                let parts = inside.is_none().then(|| self.parts(&dimensions, arguments)).flatten();
                Some(Found { index, inside, parts: parts.map(|parts| (base, parts)) })
            }
            Layout::None | Layout::Sparse => None,
        }
    }

    /// Reads a location.
    pub fn read(&mut self, function: FunctionId, arguments: &[Operand], term: TermId) -> Operand {
        let program = self.program;
        let declared = program.function(function);
        if Some(function) == program.self_function {
            match (self.agent, self.plan.self_location(program), self.kind_of(term)) {
                (Some(agent), ..) => return Operand::Scalar(agent),
                (None, Some(index), Some(kind)) => {
                    let index = self.word(i64::from(index));
                    let place = self.stored(index);
                    let unit = self.frames.last().and_then(|frame| frame.unit);
                    return Operand::Scalar(match unit.is_some_and(|unit| self.plan.runs_by_agent(unit)) {
                        true => Scalar::defined(kind, self.payload(place, kind)),
                        false => self.stored_scalar(place, kind),
                    });
                }
                _ => {}
            }
        }
        if let Some(element) = declared.element
            && let Some(kind) = self.kind(declared.codomain)
        {
            let value = self.word(i64::from(element));
            return Operand::Scalar(Scalar::defined(kind, value).within(i64::from(element), i64::from(element)));
        }
        if matches!(declared.kind, FunctionKind::Static | FunctionKind::Derived) {
            return Operand::Undef;
        }
        if let Some(settled) = self.read_settled(function, arguments, term) {
            return settled;
        }
        let kind = self.kind_of(term);
        let lazy = self.plan.facts.lazy[function.0 as usize];
        let direct = self.plan.facts.plain[function.0 as usize];
        let asked = match declared.kind {
            FunctionKind::Monitored => true,
            FunctionKind::Shared => !lazy,
            _ => false,
        };
        let found = if direct || asked { self.find(function, arguments) } else { None };
        let Some(Found { index, inside, parts }) = found else {
            return self.read_elsewhere(function, arguments, kind);
        };
        let conditional = lazy || matches!(declared.kind, FunctionKind::Monitored | FunctionKind::Shared);
        match (inside, conditional, kind) {
            (None, false, Some(kind)) => {
                let (place, offset) = match parts {
                    Some((base, parts)) if base < 1 << 26 => {
                        let mut place = self.field(Offset::values);
                        for part in parts {
                            place = self.builder.ins().iadd(place, part);
                        }
                        (place, 16 * base as i32)
                    }
                    _ => (self.stored(index), 0),
                };
                let certain = self.plan.certainty.at_place(function);
                let range = certain.bounds.filter(|_| kind == Kind::Integer);
                let scalar = match certain.defined {
                    true => Scalar::defined(kind, self.payload_at(place, offset, kind)),
                    false => self.stored_scalar_at(place, offset, kind),
                };
                Operand::Scalar(Scalar { range, ..scalar })
            }
            (None, false, None) => Operand::Stored(index),
            (inside, conditional, kind) => {
                let slow = self.block();
                self.builder.set_cold_block(slow);
                if let Some(inside) = inside {
                    // An index outside the array must not be read.
                    let next = self.block();
                    self.branch(inside, next, slow);
                    self.switch(next);
                }
                if conditional {
                    self.be_ready(function, arguments, index, slow);
                }
                match kind {
                    Some(kind) => Operand::Scalar(self.read_either(function, arguments, (index, slow), kind)),
                    None => Operand::Boxed(self.keep_either(function, arguments, (index, slow))),
                }
            }
        }
    }

    /// Goes on where a location has the value that it is to be read with: an input is asked for, and what else has no value yet is read in
    /// the block `slow`.
    fn be_ready(&mut self, function: FunctionId, arguments: &[Operand], index: ir::Value, slow: ir::Block) {
        let fast = self.block();
        match self.program.function(function).kind {
            FunctionKind::Monitored => {
                let given = self.field(Offset::given);
                let place = self.element(given, index, 2);
                let given = self.builder.ins().uload32(FLAGS, place, 0);
                let epoch = self.field(Offset::epoch);
                let ready = self.builder.ins().icmp(IntCC::Equal, given, epoch);
                let ask = self.block();
                self.branch(ready, fast, ask);
                self.switch(ask);
                let pointers = self.pointers(arguments);
                let (id, count) = (self.word(i64::from(function.0)), self.word(arguments.len() as i64));
                self.call_or_bail(helper::ASK, [self.context, id, pointers, count, index]);
                self.jump(fast);
            }
            FunctionKind::Shared => {
                let place = self.stored(index);
                let tag = self.load(types::I64, place, 0);
                let ready = self.builder.ins().icmp_imm(IntCC::NotEqual, tag, 0);
                self.branch(ready, fast, slow);
            }
            FunctionKind::Static
            | FunctionKind::Derived
            | FunctionKind::Controlled
            | FunctionKind::Out
            | FunctionKind::Local => {
                let ready = self.has_initial(index);
                self.branch(ready, fast, slow);
            }
        }
        self.switch(fast);
    }

    /// A scalar at a place, or, from the block `slow` on, wherever the machine finds it.
    fn read_either(
        &mut self,
        function: FunctionId,
        arguments: &[Operand],
        (index, slow): (ir::Value, ir::Block),
        kind: Kind,
    ) -> Scalar {
        let (value, flag, done) = (self.variable(kind.register()), self.variable(types::I8), self.block());
        // An initial value that is still to come is certain of nothing that the others are not.
        let certain = self.plan.certainty.function(function);
        let place = self.stored(index);
        let leave = |this: &mut Self, place: ir::Value| {
            let there = match certain.defined {
                true => Scalar::defined(kind, this.payload(place, kind)),
                false => this.stored_scalar(place, kind),
            };
            this.set(value, there.value);
            if let Some(fits) = there.flag {
                this.set(flag, fits);
            }
        };
        leave(self, place);
        self.jump(done);
        self.switch(slow);
        // What the machine finds is kept no longer than it takes to look at it: the code around has nothing to release.
        let mark = self.field(Offset::temporary);
        let pointers = self.pointers(arguments);
        let (id, count) = (self.word(i64::from(function.0)), self.word(arguments.len() as i64));
        let found = self.call(helper::READ, [self.context, id, pointers, count]);
        self.require(found);
        leave(self, found);
        self.call(helper::RELEASE, [self.context, mark]);
        self.jump(done);
        self.switch(done);
        let range = certain.bounds.filter(|_| kind == Kind::Integer);
        let flag = if certain.defined { None } else { Some(self.get(flag)) };
        Scalar { kind, value: self.get(value), flag, range }
    }

    /// The same for other values, kept for the statement: the store may grow before the value is used.
    fn keep_either(
        &mut self,
        function: FunctionId,
        arguments: &[Operand],
        (index, slow): (ir::Value, ir::Block),
    ) -> ir::Value {
        let (pointer, done) = (self.variable(types::I64), self.block());
        let place = self.stored(index);
        self.set(pointer, place);
        self.jump(done);
        self.switch(slow);
        let pointers = self.pointers(arguments);
        let (id, count) = (self.word(i64::from(function.0)), self.word(arguments.len() as i64));
        let value = self.call_for_value(helper::READ, [self.context, id, pointers, count]);
        self.set(pointer, value);
        self.jump(done);
        self.switch(done);
        let pointer = self.get(pointer);
        self.call_for_value(helper::KEEP, [self.context, pointer])
    }

    /// Whether reading a function asks nobody and computes nothing, wherever its locations have a place.
    pub fn is_read_at_once(&self, function: FunctionId) -> bool {
        let (index, facts) = (function.0 as usize, &self.plan.facts);
        let declared = self.program.function(function);
        matches!(declared.kind, FunctionKind::Controlled | FunctionKind::Out)
            && Some(function) != self.program.self_function
            && declared.element.is_none()
            && facts.plain[index]
            && !facts.lazy[index]
            && facts.settled[index].is_none()
    }

    /// The number of a location that may have no place, and a byte that is zero where it has none; none where it always or never has.
    pub fn place_of(&mut self, function: FunctionId, arguments: &[Operand]) -> Option<(ir::Value, ir::Value)> {
        let Found { index, inside, .. } = self.find(function, arguments)?;
        Some((index, inside?))
    }

    /// Whether the initial value of a location is there.
    fn has_initial(&mut self, index: ir::Value) -> ir::Value {
        let given = self.field(Offset::given);
        let place = self.element(given, index, 2);
        let given = self.builder.ins().uload32(FLAGS, place, 0);
        self.builder.ins().icmp_imm(IntCC::NotEqual, given, 0)
    }

    pub fn read_elsewhere(&mut self, function: FunctionId, arguments: &[Operand], kind: Option<Kind>) -> Operand {
        let pointers = self.pointers(arguments);
        let (id, count) = (self.word(i64::from(function.0)), self.word(arguments.len() as i64));
        let value = self.call_for_value(helper::READ, [self.context, id, pointers, count]);
        match kind {
            Some(kind) => Operand::Scalar(self.unboxed(value, kind)),
            None => Operand::Boxed(value),
        }
    }

    /// A scalar out of the store, where a location holds values of its kind and undef alone.
    fn stored_scalar(&mut self, place: ir::Value, kind: Kind) -> Scalar {
        self.stored_scalar_at(place, 0, kind)
    }

    fn stored_scalar_at(&mut self, place: ir::Value, offset: i32, kind: Kind) -> Scalar {
        let tag = self.load(types::I64, place, offset);
        let flag = self.builder.ins().icmp_imm(IntCC::Equal, tag, kind.tag());
        let value = self.payload_at(place, offset, kind);
        Scalar { kind, value, flag: Some(flag), range: None }
    }

    /// Adds the update `function(arguments) := value`, the value translated first, by a rule that may be known to be
    /// alone in updating the location.
    pub fn update(
        &mut self,
        function: FunctionId,
        arguments: &[Operand],
        value: Operand,
        (rule, alone): (RuleId, bool),
    ) {
        let value = match value {
            Operand::Items(items) => Operand::Boxed(self.made(items)),
            other => other,
        };
        self.check_codomain(function, value);
        let direct =
            self.plan.facts.plain[function.0 as usize] || self.program.function(function).kind == FunctionKind::Shared;
        let lazy = self.plan.facts.lazy[function.0 as usize];
        let found = if direct { self.find(function, arguments) } else { None };
        let index = match found {
            Some(Found { index, inside: None, .. }) if !lazy => index,
            Some(Found { index, inside, .. }) => {
                let number = self.variable(types::I64);
                let (fast, slow, done) = (self.block(), self.block(), self.block());
                self.builder.set_cold_block(slow);
                if let Some(inside) = inside {
                    let next = self.block();
                    self.branch(inside, next, slow);
                    self.switch(next);
                }
                if lazy {
                    let ready = self.has_initial(index);
                    self.branch(ready, fast, slow);
                } else {
                    self.jump(fast);
                }
                self.switch(fast);
                self.set(number, index);
                self.jump(done);
                self.switch(slow);
                let located = self.locate(function, arguments);
                self.set(number, located);
                self.jump(done);
                self.switch(done);
                self.get(number)
            }
            None => self.locate(function, arguments),
        };
        // Undef may stand for what others have given, or for what is still to come.
        let may_leave =
            matches!(self.program.function(function).kind, FunctionKind::Controlled | FunctionKind::Out) && !lazy;
        match value {
            Operand::Scalar(_) | Operand::Undef if self.plan.is_terse() => {
                self.push_briefly(index, value, rule, may_leave)
            }
            _ => self.push(index, value, rule, alone),
        }
    }

    /// Adds an update of a scalar to the current unit, by a call unless it leaves the location as it is: most of a search do, and searches
    /// run too few steps to pay for more code.
    fn push_briefly(&mut self, index: ir::Value, value: Operand, rule: RuleId, may_leave: bool) {
        let (tag, payload) = match value {
            Operand::Scalar(scalar) => self.words(scalar),
            _ => (self.word(0), self.word(0)),
        };
        let payload = match self.builder.func.dfg.value_type(payload) {
            types::F64 => self.builder.ins().bitcast(types::I64, ir::MemFlags::new(), payload),
            _ => payload,
        };
        let leave = if may_leave { MAY_LEAVE } else { 0 };
        let rule = self.word((u64::from(rule.0) | leave) as i64);
        let done = self.block();
        if may_leave {
            let mask = match value {
                Operand::Scalar(scalar) => scalar.kind.mask(),
                _ => 0,
            };
            self.leave_briefly(index, [tag, payload], mask, done);
        }
        self.call_or_bail(helper::PUSH, [self.context, index, tag, payload, rule]);
        self.jump(done);
        self.switch(done);
    }

    /// Notes that the current unit gives a location the scalar that it has, of these words, and goes on behind; where it does not, or where
    /// that cannot be told here, goes on here.
    fn leave_briefly(&mut self, index: ir::Value, [tag, payload]: [ir::Value; 2], mask: u64, done: ir::Block) {
        let (leaves, pushes) = (self.block(), self.block());
        let place = self.stored(index);
        let (old_tag, old_payload) = (self.load(types::I64, place, 0), self.load(types::I64, place, 8));
        let stamps = self.field(Offset::stamps);
        let stamp = self.element(stamps, index, 3);
        let holder = self.builder.ins().uload32(FLAGS, stamp, 0);
        let (unit, terse) = (self.field(Offset::unit), self.field(Offset::terse));
        let differs = self.builder.ins().bxor(payload, old_payload);
        let differs = self.builder.ins().band_imm(differs, mask as i64);
        let same_tag = self.builder.ins().icmp(IntCC::Equal, tag, old_tag);
        let same = self.builder.ins().icmp_imm(IntCC::Equal, differs, 0);
        let fresh = self.builder.ins().icmp(IntCC::NotEqual, holder, unit);
        let is_terse = self.builder.ins().icmp_imm(IntCC::NotEqual, terse, 0);
        let all = self.builder.ins().band(same_tag, same);
        let all = self.builder.ins().band(all, fresh);
        let all = self.builder.ins().band(all, is_terse);
        self.branch(all, leaves, pushes);
        self.switch(leaves);
        let unchanged = self.word(i64::from(Stamp::UNCHANGED) << 32);
        let mark = self.builder.ins().bor(unit, unchanged);
        self.store(mark, stamp, 0);
        self.jump(done);
        self.switch(pushes);
    }

    fn locate(&mut self, function: FunctionId, arguments: &[Operand]) -> ir::Value {
        let pointers = self.pointers(arguments);
        let (id, count) = (self.word(i64::from(function.0)), self.word(arguments.len() as i64));
        self.call_for_number(helper::LOCATE, [self.context, id, pointers, count])
    }

    /// Gives the step up where a value lies outside the codomain.
    fn check_codomain(&mut self, function: FunctionId, value: Operand) {
        let membership = self.plan.facts.codomains[function.0 as usize].clone();
        let bounds = match (&membership, value) {
            (Membership::Any, _) | (_, Operand::Undef) => return,
            (Membership::Natural, Operand::Scalar(Scalar { kind: Kind::Integer, .. })) => Some((0, i64::MAX)),
            (Membership::Between(low, high), Operand::Scalar(Scalar { kind: Kind::Integer, .. })) => {
                Some((*low, *high))
            }
            (Membership::Domain(domain), Operand::Scalar(Scalar { kind: Kind::Element(_), .. })) => {
                self.plan.numbers(self.program, *domain)
            }
            _ => None,
        };
        match (bounds, value) {
            (Some((low, high)), Operand::Scalar(scalar)) => {
                let (a, b) = scalar.bounds();
                if low <= a && b <= high {
                    return;
                }
                let shifted = self.builder.ins().iadd_imm(scalar.value, low.wrapping_neg());
                let width = self.word(high.wrapping_sub(low));
                let mut inside = self.builder.ins().icmp(IntCC::UnsignedLessThanOrEqual, shifted, width);
                if let Some(flag) = scalar.flag {
                    let undef = self.builder.ins().icmp_imm(IntCC::Equal, flag, 0);
                    inside = self.builder.ins().bor(inside, undef);
                }
                self.require(inside);
            }
            _ => {
                let pointer = self.boxed(value);
                let id = self.word(i64::from(function.0));
                let inside = self.call(helper::MEMBER, [self.context, id, pointer]);
                self.require(inside);
            }
        }
    }

    /// Adds an update to the current unit: [`crate::update::Updates::push`] in line.
    fn push(&mut self, index: ir::Value, value: Operand, rule: RuleId, alone: bool) {
        use std::mem::offset_of;
        let (room, write, done) = (self.block(), self.block(), self.block());
        self.builder.set_cold_block(room);
        // Without a stamp nothing shows that the location is updated, so that nobody may look for it.
        let stamp = (!alone).then(|| {
            let stamps = self.field(Offset::stamps);
            let stamp = self.element(stamps, index, 3);
            let previous = self.load(types::I64, stamp, 0);
            let holder = self.builder.ins().band_imm(previous, 0xffff_ffff);
            let unit = self.field(Offset::unit);
            let met = self.builder.ins().icmp(IntCC::Equal, holder, unit);
            let (conflict, fresh) = (self.block(), self.block());
            self.builder.set_cold_block(conflict);
            self.branch(met, conflict, fresh);
            self.switch(conflict);
            let pointer = self.boxed(value);
            self.call_or_bail(helper::AGREES, [self.context, index, pointer]);
            self.jump(done);
            self.switch(fresh);
            (stamp, previous, unit)
        });
        let held = self.field(Offset::held);
        let capacity = self.field(Offset::capacity);
        let full = self.builder.ins().icmp(IntCC::Equal, held, capacity);
        self.branch(full, room, write);
        self.switch(room);
        self.call_or_bail(helper::GROW, [self.context]);
        self.jump(write);

        self.switch(write);
        if let Some((stamp, _, unit)) = stamp {
            let high = self.builder.ins().ishl_imm(held, 32);
            let mark = self.builder.ins().bor(unit, high);
            self.store(mark, stamp, 0);
        }
        let stack = self.field(Offset::stack);
        let entry = self.element(stack, held, 5);
        let identity = self.builder.ins().bor_imm(index, i64::from(rule.0) << 32);
        self.store(identity, entry, offset_of!(Update, location) as i32);
        let previous = match stamp {
            Some((_, previous, _)) => previous,
            None => self.word(0),
        };
        self.store(previous, entry, offset_of!(Update, previous) as i32);
        let at = offset_of!(Update, value) as i32;
        match value {
            Operand::Undef => {
                let undef = self.word(0);
                self.store(undef, entry, at);
            }
            Operand::Scalar(scalar) => {
                let (tag, payload) = self.words(scalar);
                self.store(tag, entry, at);
                self.store(payload, entry, at + 8);
            }
            Operand::Boxed(_) | Operand::Shelved(_) | Operand::Stored(_) | Operand::Items(_) => {
                let pointer = self.boxed(value);
                let place = self.builder.ins().iadd_imm(entry, i64::from(at));
                self.call(helper::COPY, [self.context, pointer, place]);
            }
        }
        let held = self.builder.ins().iadd_imm(held, 1);
        self.set_field(Offset::held, held);
        self.jump(done);
        self.switch(done);
    }
}

const _: () = assert!(size_of::<Update>() == 32 && size_of::<Value>() == 16);
