//! Units: bodies that are called, and tables of fixed terms.
//!
//! A unit takes the context and, for each parameter, a register and a flag, or a pointer. It gives a status (a
//! procedure), a state and a register (a scalar definition; the state is 0 undef, 1 defined, 2 the step is given up),
//! or a pointer, null where the step is given up.

use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::{self, Block, InstBuilder, Signature, Type, types};
use cranelift_jit::JITModule;
use cranelift_module::{Linkage, Module};
use program::{DomainId, FunctionId, ProcedureId, Program, Slot, TermId};

use crate::native::context::Offset;
use crate::native::helper::{self, signature};
use crate::native::nesting::UnitKey;
use crate::native::shape::{Bound, Kind, Operand, Scalar};
use crate::native::translate::{Frame, Translator};

/// LIMIT: calls inside each other in compiled code; a step that needs more is interpreted.
const NESTED: i64 = 400;

/// The domains of a unit's parameters and, for a definition, of its values.
pub(super) fn interface(program: &Program, key: UnitKey) -> (Vec<DomainId>, Option<DomainId>) {
    match key {
        UnitKey::Procedure(id) => (program.procedure(id).parameters.clone(), None),
        UnitKey::Definition(id) => {
            let function = program.function(id);
            let domain = function.definition.as_ref().map(|definition| program.term_domain(definition.body));
            (function.parameters.clone(), domain)
        }
    }
}

/// The signature of a unit.
pub(super) fn unit_signature(program: &Program, module: &JITModule, key: UnitKey) -> Signature {
    let (parameters, result) = interface(program, key);
    let mut types: Vec<Type> = vec![types::I64];
    for parameter in parameters {
        match Kind::of(program, parameter) {
            Some(kind) => types.extend([kind.register(), types::I8]),
            None => types.push(types::I64),
        }
    }
    let results = match (key, result.map(|domain| Kind::of(program, domain))) {
        (UnitKey::Procedure(_), _) => vec![types::I8],
        (_, Some(Some(kind))) => vec![types::I8, kind.register()],
        _ => vec![types::I64],
    };
    signature(module, &types, &results)
}

/// Where the value of a definition is kept.
struct Shelved {
    index: ir::Value,
    /// The mark of a value that holds now.
    mark: ir::Value,
    /// Zero where the arguments have no place.
    inside: Option<ir::Value>,
}

impl Translator<'_, '_> {
    /// Whether a unit is translated where it is called.
    pub fn inlines(&self, key: UnitKey) -> bool {
        !self.frames.iter().any(|frame| frame.unit == Some(key))
            && self.plan.is_small(self.program, key, self.weight, self.frames.len())
    }

    /// Translates the whole of a unit, whose entry block is current, its parameters those of the block.
    pub fn unit(&mut self, key: UnitKey, parameters: &[ir::Value]) {
        let program = self.program;
        let (domains, result) = interface(program, key);
        let certain = match key {
            UnitKey::Procedure(id) => self.plan.certainty.parameters_of_procedure(id),
            UnitKey::Definition(id) => self.plan.certainty.parameters_of_definition(id),
        };
        let defined: Vec<bool> = certain.iter().map(|certain| certain.defined).collect();
        let mut slots = Vec::new();
        let mut rest = parameters.iter().copied();
        for (domain, defined) in domains.into_iter().zip(defined) {
            let mut next = || rest.next().expect("as the signature says");
            slots.push(match Kind::of(program, domain) {
                Some(kind) => {
                    let (value, flag) = (next(), next());
                    Bound::Scalar(Scalar { kind, value, flag: (!defined).then_some(flag), range: None })
                }
                None => Bound::Boxed(next()),
            });
        }
        let depth = self.descend(key);
        match key {
            UnitKey::Procedure(id) => {
                let procedure = program.procedure(id);
                self.frames.push(Frame { unit: Some(key), size: procedure.frame, slots });
                self.rule(procedure.body);
                self.ascend(depth);
                let good = self.byte(0);
                self.builder.ins().return_(&[good]);
                self.switch(self.bail);
                let bad = self.byte(1);
                self.builder.ins().return_(&[bad]);
            }
            UnitKey::Definition(id) => {
                let definition = program.function(id).definition.as_ref().expect("a unit has one");
                self.frames.push(Frame { unit: Some(key), size: definition.frame, slots });
                let mark = self.field(Offset::temporary);
                let (items, gatherers) = (self.field(Offset::item), self.gatherers);
                let operand = self.term(definition.body);
                self.ascend(depth);
                match result.and_then(|domain| Kind::of(program, domain)) {
                    Some(kind) => {
                        let scalar = self.scalar(operand, kind);
                        if self.keeps {
                            self.release(mark);
                        }
                        self.give_back(items, gatherers);
                        let state = match scalar.flag {
                            Some(flag) => flag,
                            None => self.byte(1),
                        };
                        self.builder.ins().return_(&[state, scalar.value]);
                        self.switch(self.bail);
                        let bad = self.byte(2);
                        let nothing = match kind {
                            Kind::Real => self.builder.ins().f64const(0.0),
                            Kind::Boolean => self.byte(0),
                            _ => self.word(0),
                        };
                        self.builder.ins().return_(&[bad, nothing]);
                    }
                    None => {
                        let pointer = self.pinned(operand);
                        // A scalar's box lies in this function's own frame.
                        let pointer = match operand {
                            Operand::Scalar(_) => self.call_for_value(helper::KEEP, [self.context, pointer]),
                            _ => pointer,
                        };
                        self.give_back(items, gatherers);
                        self.builder.ins().return_(&[pointer]);
                        self.switch(self.bail);
                        let null = self.word(0);
                        self.builder.ins().return_(&[null]);
                    }
                }
            }
        }
        self.frames.pop();
    }

    /// Counts a call: its work, and how deep it is, where that is not known to be little. Gives the depth before.
    fn descend(&mut self, key: UnitKey) -> Option<ir::Value> {
        let depth = (!self.plan.nesting.is_short(key)).then(|| self.field(Offset::depth));
        if let Some(depth) = depth {
            let deep = self.builder.ins().icmp_imm(IntCC::UnsignedGreaterThan, depth, NESTED);
            self.refuse(deep);
        }
        let one = self.word(1);
        self.spend(one);
        if let Some(depth) = depth {
            let deeper = self.builder.ins().iadd_imm(depth, 1);
            self.set_field(Offset::depth, deeper);
        }
        depth
    }

    fn ascend(&mut self, depth: Option<ir::Value>) {
        if let Some(depth) = depth {
            self.set_field(Offset::depth, depth);
        }
    }

    /// Calls a unit; gives its results.
    fn call_unit(&mut self, key: UnitKey, operands: &[Operand]) -> Vec<ir::Value> {
        let program = self.program;
        let (domains, _) = interface(program, key);
        let mut arguments = vec![self.context];
        for (domain, operand) in domains.iter().zip(operands) {
            match Kind::of(program, *domain) {
                Some(kind) => {
                    let scalar = self.scalar(*operand, kind);
                    let flag = match scalar.flag {
                        Some(flag) => flag,
                        None => self.byte(1),
                    };
                    arguments.extend([scalar.value, flag]);
                }
                None => arguments.push(self.pinned(*operand)),
            }
        }
        let known = self.plan.units.iter().find(|(unit, _)| *unit == key).map(|(_, id)| *id);
        let id = match known {
            Some(id) => id,
            None => {
                let name = format!("unit{}", self.plan.units.len());
                let signature = unit_signature(program, self.module, key);
                let id = self
                    .module
                    .declare_function(&name, Linkage::Local, &signature)
                    .expect("a new name in a module under construction");
                self.plan.units.push((key, id));
                self.plan.queue.push((key, id));
                id
            }
        };
        let reference = self.module.declare_func_in_func(id, self.builder.func);
        let call = self.builder.ins().call(reference, &arguments);
        self.builder.inst_results(call).to_vec()
    }

    /// Calls a procedure.
    pub fn call_procedure(&mut self, procedure: ProcedureId, operands: &[Operand]) {
        let status = self.call_unit(UnitKey::Procedure(procedure), operands)[0];
        self.refuse(status);
    }

    /// The value of a definition, kept from earlier in this state or computed by a call.
    pub fn call_definition(&mut self, function: FunctionId, operands: &[Operand], id: TermId) -> Operand {
        let kind = self.kind_of(id);
        let body = self.program.function(function).definition.as_ref().map(|d| self.program.term_domain(d.body));
        let returned = body.and_then(|domain| self.kind(domain));
        let Some(place) = self.shelf_place(function, operands) else {
            return self.computed(function, operands, (returned, kind));
        };
        match returned {
            Some(of) if Some(of) == kind => Operand::Scalar(self.kept_scalar(function, operands, place, of)),
            _ => self.kept_value(function, operands, place, (returned, kind)),
        }
    }

    /// The place where a value of a definition is kept, if it is.
    fn shelf_place(&mut self, function: FunctionId, operands: &[Operand]) -> Option<Shelved> {
        let shelf = self.plan.facts.shelves[function.0 as usize].clone()?;
        let (offset, inside) = match shelf.dimensions.len() {
            0 => (self.word(0), None),
            _ => self.offset(&shelf.dimensions, operands)?,
        };
        let index = self.builder.ins().iadd_imm(offset, i64::from(shelf.base));
        let mark = if shelf.for_good {
            self.word(1)
        } else {
            let version = self.field(Offset::version);
            self.builder.ins().iadd_imm(version, 1)
        };
        Some(Shelved { index, mark, inside })
    }

    /// Goes to `found`, with the entry current, where a value is kept that holds now, and to `compute` elsewhere.
    fn look_on_shelf(&mut self, place: &Shelved, found: Block, compute: Block) {
        if let Some(inside) = place.inside {
            let look = self.block();
            self.branch(inside, look, compute);
            self.switch(look);
        }
        let versions = self.field(Offset::versions);
        let version = self.element(versions, place.index, 3);
        let version = self.load(types::I64, version, 0);
        let holds = self.builder.ins().icmp(IntCC::Equal, version, place.mark);
        self.branch(holds, found, compute);
    }

    /// The address of the value kept at a place.
    fn entry(&mut self, place: &Shelved) -> ir::Value {
        let kept = self.field(Offset::kept);
        self.element(kept, place.index, 4)
    }

    /// A scalar that a definition gives. Nothing but such scalars and undef stands at its place, so none of them has to be dropped.
    fn kept_scalar(&mut self, function: FunctionId, operands: &[Operand], place: Shelved, kind: Kind) -> Scalar {
        let defined = self.plan.certainty.function(function).defined;
        let (value, flag) = (self.variable(kind.register()), self.variable(types::I8));
        let (found, compute, done) = (self.block(), self.block(), self.block());
        self.look_on_shelf(&place, found, compute);
        self.switch(found);
        let entry = self.entry(&place);
        let payload = self.payload(entry, kind);
        self.set(value, payload);
        if !defined {
            let tag = self.load(types::I64, entry, 0);
            let fits = self.builder.ins().icmp_imm(IntCC::Equal, tag, kind.tag());
            self.set(flag, fits);
        }
        self.jump(done);

        self.switch(compute);
        let Operand::Scalar(result) = self.computed(function, operands, (Some(kind), Some(kind))) else {
            unreachable!("a kind is that of a scalar")
        };
        self.set(value, result.value);
        if let Some(fits) = result.flag {
            self.set(flag, fits);
        }
        let keep = self.block();
        match place.inside {
            Some(inside) => self.branch(inside, keep, done),
            None => self.jump(keep),
        }
        self.switch(keep);
        let (tag, payload) = self.words(result);
        let entry = self.entry(&place);
        self.store(tag, entry, 0);
        self.store(payload, entry, 8);
        let versions = self.field(Offset::versions);
        let version = self.element(versions, place.index, 3);
        self.store(place.mark, version, 0);
        self.jump(done);
        self.switch(done);
        let value = self.get(value);
        let flag = if defined { None } else { Some(self.get(flag)) };
        Scalar { kind, value, flag, range: None }
    }

    /// Any other value.
    fn kept_value(
        &mut self,
        function: FunctionId,
        operands: &[Operand],
        place: Shelved,
        (returned, kind): (Option<Kind>, Option<Kind>),
    ) -> Operand {
        let pointer = self.variable(types::I64);
        let (found, compute, done) = (self.block(), self.block(), self.block());
        self.look_on_shelf(&place, found, compute);
        self.switch(found);
        let entry = self.entry(&place);
        self.set(pointer, entry);
        self.jump(done);

        self.switch(compute);
        let value = self.computed(function, operands, (returned, returned));
        let value = self.boxed(value);
        self.set(pointer, value);
        let keep = self.block();
        match place.inside {
            Some(inside) => self.branch(inside, keep, done),
            None => self.jump(keep),
        }
        self.switch(keep);
        self.call(helper::KEEP_DERIVED, [self.context, place.index, place.mark, value]);
        self.jump(done);
        self.switch(done);
        let pointer = self.get(pointer);
        match kind {
            Some(kind) => Operand::Scalar(self.unboxed(pointer, kind)),
            None if self.plan.visits => Operand::Boxed(self.call_for_value(helper::KEEP, [self.context, pointer])),
            None => Operand::Shelved(pointer),
        }
    }

    /// What calling a definition gives: of one kind, wanted as one of another or the same.
    fn computed(
        &mut self,
        function: FunctionId,
        operands: &[Operand],
        (returned, wanted): (Option<Kind>, Option<Kind>),
    ) -> Operand {
        let results = self.call_unit(UnitKey::Definition(function), operands);
        match returned {
            Some(kind) => {
                let given_up = self.builder.ins().icmp_imm(IntCC::Equal, results[0], 2);
                self.refuse(given_up);
                let defined = self.plan.certainty.function(function).defined;
                let flag = (!defined).then_some(results[0]);
                Operand::Scalar(Scalar { kind, value: results[1], flag, range: None })
            }
            None => {
                self.note_kept();
                self.require(results[0]);
                match wanted {
                    Some(kind) => Operand::Scalar(self.unboxed(results[0], kind)),
                    None => Operand::Boxed(results[0]),
                }
            }
        }
    }

    /// A fixed term out of its table.
    pub fn fixed(&mut self, id: TermId) -> Option<Operand> {
        let program = self.program;
        if !self.plan.is_fixed(program, id) {
            return None;
        }
        let mut slots = Vec::new();
        self.plan.slots_of_term(program, id, &mut slots);
        let own = self.plan.own_slots(program, id);
        slots.retain(|slot| !own.contains(slot));
        let mut entries = 1i64;
        let mut index: Option<ir::Value> = None;
        let mut columns = Vec::new();
        for slot in &slots {
            let Bound::Scalar(scalar) = self.slot(Slot(*slot)) else { return None };
            if scalar.flag.is_some() {
                return None;
            }
            let (low, high) = self.plan.bounds(program, scalar)?;
            let size = high.checked_sub(low)?.checked_add(1)?;
            entries = entries.checked_mul(size)?;
            columns.push((scalar, low, size));
        }
        // Refused here, the table has left no code behind.
        let frame = self.frame().size;
        let spill = self.plan.numbered.spill(frame, slots.clone());
        let table = self.plan.table(id, spill, entries)?;
        for (scalar, low, size) in columns {
            let mut column = scalar.value;
            if scalar.kind == Kind::Boolean {
                column = self.builder.ins().uextend(types::I64, column);
            }
            if low != 0 {
                column = self.builder.ins().iadd_imm(column, low.wrapping_neg());
            }
            index = Some(match index {
                Some(before) => {
                    let scaled = self.builder.ins().imul_imm(before, size);
                    self.builder.ins().iadd(scaled, column)
                }
                None => column,
            });
        }
        let index = match index {
            Some(index) => index,
            None => self.word(0),
        };
        let tables = self.field(Offset::tables);
        let states = self.load(types::I64, tables, 16 * table as i32);
        let state = self.builder.ins().iadd(states, index);
        let state = self.load(types::I8, state, 0);
        let (fill, ready) = (self.block(), self.block());
        self.builder.set_cold_block(fill);
        self.branch(state, ready, fill);
        self.switch(fill);
        let operands: Vec<Operand> = slots.iter().map(|slot| self.slot(Slot(*slot)).into()).collect();
        let pointers = self.pointers(&operands);
        let number = self.word(table as i64);
        self.call_or_bail(helper::FILL, [self.context, number, index, pointers]);
        self.jump(ready);
        self.switch(ready);
        let values = self.load(types::I64, tables, 16 * table as i32 + 8);
        let pointer = self.element(values, index, 4);
        Some(match self.kind_of(id) {
            Some(kind) => {
                let tag = self.load(types::I64, pointer, 0);
                let flag = self.builder.ins().icmp_imm(IntCC::Equal, tag, kind.tag());
                let value = self.payload(pointer, kind);
                Operand::Scalar(Scalar { kind, value, flag: Some(flag), range: None })
            }
            None => Operand::Boxed(pointer),
        })
    }
}
