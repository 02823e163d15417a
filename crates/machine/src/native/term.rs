//! Terms: the counterpart of [`crate::evaluate`].

use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::{self, Block, InstBuilder, types};
use cranelift_frontend::Variable;
use program::{Builtin, FunctionId, Quantifier, Term, TermId, TermList};

use crate::native::context::Offset;
use crate::native::helper;
use crate::native::nesting::UnitKey;
use crate::native::shape::{Bound, Kind, Operand, Scalar};
use crate::native::translate::{Frame, Translator};
use crate::value::Value;

/// Where the branches of a term leave their value.
pub(super) struct Merge {
    kind: Option<Kind>,
    value: Variable,
    flag: Variable,
    /// Some branch may be undef.
    undefined: bool,
    range: Option<(i64, i64)>,
    first: bool,
}

impl Translator<'_, '_> {
    /// Translates a term. A term whose domain is scalar gives a scalar, or undef.
    pub fn term(&mut self, id: TermId) -> Operand {
        self.weight += 1;
        if let Some(table) = self.fixed(id) {
            return table;
        }
        let operand = self.plain_term(id);
        match (operand, self.kind_of(id)) {
            (Operand::Boxed(_) | Operand::Shelved(_) | Operand::Stored(_), Some(kind)) => {
                Operand::Scalar(self.scalar(operand, kind))
            }
            _ => operand,
        }
    }

    /// Translates terms in their order.
    pub fn terms(&mut self, list: TermList) -> Vec<Operand> {
        let program = self.program;
        program.term_list(list).iter().map(|term| self.term(*term)).collect()
    }

    /// What a term makes of all its parts.
    fn of_parts(&mut self, parts: TermList, id: TermId) -> Operand {
        let operands = self.terms(parts);
        self.apply(id, &operands)
    }

    fn plain_term(&mut self, id: TermId) -> Operand {
        let program = self.program;
        match program.term(id) {
            Term::Constant(index) => self.constant(*index),
            Term::Slot(slot) => self.slot(*slot).into(),
            Term::Read { function, arguments } => {
                let arguments = self.terms(*arguments);
                self.read(*function, &arguments, id)
            }
            Term::Define { function, arguments } => self.define(*function, *arguments, id),
            Term::Builtin { builtin, arguments } => self.builtin(*builtin, program.term_list(*arguments), id),
            Term::If { branches, otherwise } => {
                let branches: Vec<(TermId, TermId)> =
                    program.term_list(*branches).chunks_exact(2).map(|pair| (pair[0], pair[1])).collect();
                self.conditional(&branches, *otherwise, id)
            }
            Term::Switch { subject, cases, otherwise } => {
                self.switch_term(*subject, program.term_list(*cases), *otherwise, id)
            }
            Term::Let { slot, value, body } => {
                let value = self.term(*value);
                let bound = self.bound(value);
                self.bind(*slot, bound);
                self.term(*body)
            }
            Term::Quantified { quantifier, binders, condition } => self.quantified(*quantifier, *binders, *condition),
            Term::Tuple(list) => self.of_parts(*list, id),
            Term::Collection { kind, elements } => match self.literal(*kind, program.term_list(*elements)) {
                Some(items) => items,
                None => self.of_parts(*elements, id),
            },
            Term::Project { tuple, index } => {
                let tuple = self.term(*tuple);
                let tuple = self.pinned(tuple);
                let index = self.word(i64::from(*index));
                let component = self.call(helper::COMPONENT, [tuple, index]);
                self.require(component);
                Operand::Boxed(component)
            }
            Term::Unbound | Term::Missing(_) => self.interpreted(id),
            Term::Rule(procedure) => {
                let n = i64::from(procedure.0);
                let value = self.word(n);
                Operand::Scalar(Scalar::defined(Kind::Rule, value).within(n, n))
            }
            Term::Coerce(operand) => {
                if self.kind_of(id) == Some(Kind::Real) && self.kind_of(*operand) == Some(Kind::Integer) {
                    let operand = self.term(*operand);
                    let scalar = self.scalar(operand, Kind::Integer);
                    let value = self.builder.ins().fcvt_from_sint(types::F64, scalar.value);
                    return Operand::Scalar(Scalar { kind: Kind::Real, value, flag: scalar.flag, range: None });
                }
                self.interpreted(id)
            }
            Term::Comprehension { kind, binders, condition, body } => {
                self.comprehension(*kind, *binders, *condition, *body)
            }
            Term::Domain(_) | Term::Range { .. } => self.interpreted(id),
        }
    }

    fn constant(&mut self, index: u32) -> Operand {
        let constants = std::sync::Arc::clone(&self.plan.constants);
        self.known(&constants[index as usize])
    }

    /// A value that stays where it is as long as the code.
    pub fn known(&mut self, value: &Value) -> Operand {
        let (kind, n) = match value {
            Value::Undef => return Operand::Undef,
            Value::Real(real) => {
                let value = self.builder.ins().f64const(real.get());
                return Operand::Scalar(Scalar::defined(Kind::Real, value));
            }
            Value::Boolean(truth) => {
                let value = self.byte(i64::from(*truth));
                let n = i64::from(*truth);
                return Operand::Scalar(Scalar::defined(Kind::Boolean, value).within(n, n));
            }
            Value::Integer(n) => (Kind::Integer, *n),
            Value::Enum(domain, index) => (Kind::Enum(*domain), i64::from(*index)),
            Value::Element(domain, index) => (Kind::Element(*domain), i64::from(*index)),
            Value::Char(c) => (Kind::Char, i64::from(u32::from(*c))),
            Value::Rule(procedure) => (Kind::Rule, i64::from(procedure.0)),
            _ => return Operand::Boxed(self.address(value)),
        };
        let value = self.word(n);
        Operand::Scalar(Scalar::defined(kind, value).within(n, n))
    }

    /// A term that the interpreter evaluates, its variables handed over.
    pub fn interpreted(&mut self, id: TermId) -> Operand {
        let program = self.program;
        let mut slots = Vec::new();
        self.plan.slots_of_term(program, id, &mut slots);
        let (spill, values) = self.spill(slots);
        let term = self.word(i64::from(id.0));
        Operand::Boxed(self.call_for_value(helper::EVALUATE, [self.context, term, spill, values]))
    }

    /// Hands variables over to the interpreter: the number of the list of slots, and where their values are.
    pub fn spill(&mut self, slots: Vec<u32>) -> (ir::Value, ir::Value) {
        let operands: Vec<Operand> = slots.iter().map(|slot| self.slot(program::Slot(*slot)).into()).collect();
        let size = self.frame().size;
        let spill = self.plan.numbered.spill(size, slots);
        let values = self.pointers(&operands);
        (self.word(spill as i64), values)
    }

    /// Applies a library function to operands, or builds a tuple or a collection of them.
    pub fn apply(&mut self, id: TermId, operands: &[Operand]) -> Operand {
        let pointers = self.pointers(operands);
        let (term, count) = (self.word(i64::from(id.0)), self.word(operands.len() as i64));
        Operand::Boxed(self.call_for_value(helper::APPLY, [self.context, term, pointers, count]))
    }

    // ---- branches

    pub fn merge(&mut self, id: TermId) -> Merge {
        let kind = self.kind_of(id);
        let value = self.variable(kind.map_or(types::I64, Kind::register));
        let flag = self.variable(types::I8);
        Merge { kind, value, flag, undefined: false, range: None, first: true }
    }

    /// Leaves a branch's value and goes on at `done`.
    pub fn leave(&mut self, merge: &mut Merge, operand: Operand, done: Block) {
        match merge.kind {
            None => {
                let pointer = self.pinned(operand);
                self.set(merge.value, pointer);
            }
            Some(kind) => {
                let scalar = self.scalar(operand, kind);
                self.set(merge.value, scalar.value);
                let flag = match scalar.flag {
                    Some(flag) => {
                        merge.undefined = true;
                        flag
                    }
                    None => self.byte(1),
                };
                self.set(merge.flag, flag);
                if !matches!(operand, Operand::Undef) {
                    merge.range = match (merge.first, merge.range, scalar.range) {
                        (true, _, range) => range,
                        (false, Some((a, b)), Some((c, d))) => Some((a.min(c), b.max(d))),
                        _ => None,
                    };
                    merge.first = false;
                }
            }
        }
        self.jump(done);
    }

    pub fn merged(&mut self, merge: &Merge) -> Operand {
        let value = self.get(merge.value);
        match merge.kind {
            None => Operand::Boxed(value),
            Some(kind) => {
                let flag = if merge.undefined { Some(self.get(merge.flag)) } else { None };
                Operand::Scalar(Scalar { kind, value, flag, range: merge.range })
            }
        }
    }

    fn conditional(&mut self, branches: &[(TermId, TermId)], otherwise: Option<TermId>, id: TermId) -> Operand {
        if let ([(guard, term)], Some(otherwise)) = (branches, otherwise)
            && let Some(value) = self.selected(*guard, *term, otherwise)
        {
            return value;
        }
        let done = self.block();
        let mut merge = self.merge(id);
        for (guard, term) in branches {
            let (then, next) = (self.block(), self.block());
            self.guard(*guard, then, next);
            self.switch(then);
            let value = self.term(*term);
            self.leave(&mut merge, value, done);
            self.switch(next);
        }
        let value = otherwise.map_or(Operand::Undef, |term| self.term(term));
        self.leave(&mut merge, value, done);
        self.switch(done);
        self.merged(&merge)
    }

    /// One of two constants, without a branch.
    fn selected(&mut self, guard: TermId, then: TermId, otherwise: TermId) -> Option<Operand> {
        let program = self.program;
        let constant = |term: TermId| matches!(program.term(term), Term::Constant(_));
        if !constant(then) || !constant(otherwise) || self.kind_of(then) != self.kind_of(otherwise) {
            return None;
        }
        let (Operand::Scalar(a), Operand::Scalar(b)) = (self.term(then), self.term(otherwise)) else { return None };
        let guard = self.term(guard);
        let guard = self.scalar(guard, Kind::Boolean);
        let guard = self.defined(guard);
        let value = match (a.kind, a.constant(), b.constant()) {
            (Kind::Integer, Some(1), Some(0)) => self.builder.ins().uextend(types::I64, guard.value),
            _ => self.builder.ins().select(guard.value, a.value, b.value),
        };
        let range = a.range.zip(b.range).map(|((al, ah), (bl, bh))| (al.min(bl), ah.max(bh)));
        Some(Operand::Scalar(Scalar { kind: a.kind, value, flag: None, range }))
    }

    fn switch_term(&mut self, subject: TermId, cases: &[TermId], otherwise: Option<TermId>, id: TermId) -> Operand {
        let subject = self.term(subject);
        let done = self.block();
        let mut merge = self.merge(id);
        let values: Vec<TermId> = cases.iter().step_by(2).copied().collect();
        match self.known_cases(subject, &values) {
            Some((scalar, known)) => {
                let (arms, none) = self.select_case(scalar, &known);
                for (arm, case) in arms.into_iter().zip(&known) {
                    self.switch(arm);
                    let value = self.term(cases[2 * case.place + 1]);
                    self.leave(&mut merge, value, done);
                }
                self.switch(none);
            }
            None => {
                let subject = self.bound(subject).into();
                for case in cases.chunks_exact(2) {
                    let value = self.term(case[0]);
                    let equal = self.equal(subject, value);
                    let (then, next) = (self.block(), self.block());
                    self.branch(equal, then, next);
                    self.switch(then);
                    let value = self.term(case[1]);
                    self.leave(&mut merge, value, done);
                    self.switch(next);
                }
            }
        }
        let value = otherwise.map_or(Operand::Undef, |term| self.term(term));
        self.leave(&mut merge, value, done);
        self.switch(done);
        self.merged(&merge)
    }

    /// Goes to `then` where a guard is true and to `otherwise` where it is false.
    pub fn guard(&mut self, id: TermId, then: Block, otherwise: Block) {
        let program = self.program;
        if let Term::Builtin { builtin, arguments } = program.term(id) {
            let connective = matches!(builtin, Builtin::And | Builtin::Or | Builtin::Not);
            if connective && let Some(scalar) = self.branchless(id) {
                let scalar = self.defined(scalar);
                return self.branch(scalar.value, then, otherwise);
            }
            match (builtin, program.term_list(*arguments)) {
                (Builtin::And, [left, right]) => {
                    let next = self.block();
                    self.guard(*left, next, otherwise);
                    self.switch(next);
                    return self.guard(*right, then, otherwise);
                }
                (Builtin::Or, [left, right]) => {
                    let next = self.block();
                    self.guard(*left, then, next);
                    self.switch(next);
                    return self.guard(*right, then, otherwise);
                }
                (Builtin::Not, [operand]) => return self.guard(*operand, otherwise, then),
                (Builtin::Implies, [left, right]) => {
                    let next = self.block();
                    self.guard(*left, next, then);
                    self.switch(next);
                    return self.guard(*right, then, otherwise);
                }
                _ => {}
            }
        }
        let operand = self.term(id);
        let scalar = self.scalar(operand, Kind::Boolean);
        let scalar = self.defined(scalar);
        match scalar.constant() {
            Some(0) => self.jump(otherwise),
            Some(_) => self.jump(then),
            None => self.branch(scalar.value, then, otherwise),
        }
    }

    /// A guard as a value: never undef, as that gives the step up.
    pub fn truth(&mut self, id: TermId) -> Operand {
        if let Some(scalar) = self.branchless(id) {
            return Operand::Scalar(self.defined(scalar));
        }
        let truth = self.variable(types::I8);
        let (then, otherwise, done) = (self.block(), self.block(), self.block());
        self.guard(id, then, otherwise);
        self.switch(then);
        let one = self.byte(1);
        self.set(truth, one);
        self.jump(done);
        self.switch(otherwise);
        let zero = self.byte(0);
        self.set(truth, zero);
        self.jump(done);
        self.switch(done);
        let value = self.get(truth);
        Operand::Scalar(Scalar::defined(Kind::Boolean, value))
    }

    /// Whether two operands are equal, as a byte.
    pub fn equal(&mut self, left: Operand, right: Operand) -> ir::Value {
        match (left, right) {
            (Operand::Undef, other) | (other, Operand::Undef) => match self.is_defined(other) {
                None => self.byte(0),
                Some(flag) => self.builder.ins().icmp_imm(IntCC::Equal, flag, 0),
            },
            (Operand::Scalar(a), Operand::Scalar(b)) if a.kind == b.kind => {
                let same = match a.kind {
                    Kind::Real => self.builder.ins().fcmp(ir::condcodes::FloatCC::Equal, a.value, b.value),
                    _ => self.builder.ins().icmp(IntCC::Equal, a.value, b.value),
                };
                match (a.flag, b.flag) {
                    (None, None) => same,
                    (Some(flag), None) | (None, Some(flag)) => self.builder.ins().band(same, flag),
                    (Some(a), Some(b)) => {
                        let both = self.builder.ins().band(a, b);
                        let any = self.builder.ins().bor(a, b);
                        let defined = self.builder.ins().band(same, both);
                        let neither = self.builder.ins().icmp_imm(IntCC::Equal, any, 0);
                        self.builder.ins().bor(defined, neither)
                    }
                }
            }
            (left, right) => {
                let (left, right) = (self.boxed(left), self.boxed(right));
                let equal = self.call(helper::EQUAL, [left, right]);
                self.builder.ins().ireduce(types::I8, equal)
            }
        }
    }

    // ---- definitions

    fn define(&mut self, function: FunctionId, arguments: TermList, id: TermId) -> Operand {
        let program = self.program;
        let Some(definition) = &program.function(function).definition else {
            self.terms(arguments);
            return Operand::Undef;
        };
        let operands = self.terms(arguments);
        let key = UnitKey::Definition(function);
        if !self.inlines(key) {
            return self.call_definition(function, &operands, id);
        }
        let slots: Vec<Bound> = operands.into_iter().map(|operand| self.bound(operand)).collect();
        self.frames.push(Frame { unit: Some(key), size: definition.frame, slots });
        let value = self.term(definition.body);
        self.frames.pop();
        value
    }

    // ---- quantifiers

    fn quantified(
        &mut self,
        quantifier: Quantifier,
        binders: program::BinderList,
        condition: Option<TermId>,
    ) -> Operand {
        let program = self.program;
        let count = self.variable(types::I64);
        let zero = self.word(0);
        self.set(count, zero);
        let done = self.block();
        let (mark, keepers) = (self.field(Offset::temporary), self.keepers);
        let (items, gatherers) = (self.field(Offset::item), self.gatherers);
        let mut binders = program.binder_list(binders).to_vec();
        let unordered = self.unordered(quantifier, &binders, condition);
        if let Some(range) = unordered {
            binders[0].range = range;
        }
        // Counts the witnesses of an existential formula, the counterexamples of a universal one.
        self.each_binding(&binders, &mut |this| {
            let (witness, next) = (this.block(), this.block());
            match (condition, quantifier) {
                (None, Quantifier::Forall) => this.jump(next),
                (None, _) => this.jump(witness),
                (Some(condition), Quantifier::Forall) => this.guard(condition, next, witness),
                (Some(condition), _) => this.guard(condition, witness, next),
            }
            this.switch(witness);
            let before = this.get(count);
            let after = this.builder.ins().iadd_imm(before, 1);
            this.set(count, after);
            if unordered.is_some() {
                // One that comes later may be at fault, and come first in the set.
                this.jump(next);
            } else if quantifier == Quantifier::ExistsUnique {
                let many = this.builder.ins().icmp_imm(IntCC::UnsignedGreaterThan, after, 1);
                this.branch(many, done, next);
            } else {
                this.jump(done);
            }
            this.switch(next);
        });
        self.jump(done);
        self.switch(done);
        // A loop that is left early has not ended its statements.
        if self.keepers > keepers {
            self.release(mark);
        }
        self.give_back(items, gatherers);
        let count = self.get(count);
        let value = match quantifier {
            Quantifier::Forall => self.builder.ins().icmp_imm(IntCC::Equal, count, 0),
            Quantifier::Exists => self.builder.ins().icmp_imm(IntCC::NotEqual, count, 0),
            Quantifier::ExistsUnique => self.builder.ins().icmp_imm(IntCC::Equal, count, 1),
        };
        Operand::Scalar(Scalar::defined(Kind::Boolean, value))
    }
}
