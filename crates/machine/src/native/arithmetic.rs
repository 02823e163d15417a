//! Library functions on scalars: connectives, order, Integer and Real arithmetic. The others are applied by a
//! helper.
//!
//! Integer operations that cannot leave 64 bits, by the bounds of their operands, are not checked.

use cranelift_codegen::ir::condcodes::{FloatCC, IntCC};
use cranelift_codegen::ir::{self, InstBuilder, types};
use program::{Builtin, Effect, Term, TermId};

use crate::native::shape::{Kind, Operand, Scalar};
use crate::native::translate::Translator;

impl Translator<'_, '_> {
    /// Translates the application of a library function.
    pub fn builtin(&mut self, builtin: Builtin, arguments: &[TermId], id: TermId) -> Operand {
        match builtin.info().effect {
            Effect::ReadsBefore | Effect::Chooses | Effect::SpeaksOfRuns => return self.interpreted(id),
            Effect::Pure | Effect::ReadsAgents | Effect::ReadsClock => {}
        }
        if let Some(known) = self.on_items(builtin, arguments) {
            return known;
        }
        match (builtin, arguments) {
            (Builtin::And | Builtin::Or | Builtin::Implies | Builtin::Not, _) => self.truth(id),
            (Builtin::Eq | Builtin::Neq, [left, right]) => {
                let (left, right) = (self.term(*left), self.term(*right));
                let equal = self.equal(left, right);
                let value =
                    if builtin == Builtin::Eq { equal } else { self.builder.ins().icmp_imm(IntCC::Equal, equal, 0) };
                Operand::Scalar(Scalar::defined(Kind::Boolean, value))
            }
            (Builtin::IsDef | Builtin::IsUndef, [operand]) => {
                let operand = self.term(*operand);
                let value = match (self.is_defined(operand), builtin) {
                    (None, _) => self.byte(i64::from(builtin == Builtin::IsDef)),
                    (Some(flag), Builtin::IsDef) => self.builder.ins().icmp_imm(IntCC::NotEqual, flag, 0),
                    (Some(flag), _) => self.builder.ins().icmp_imm(IntCC::Equal, flag, 0),
                };
                Operand::Scalar(Scalar::defined(Kind::Boolean, value))
            }
            (Builtin::SetSize | Builtin::SeqLength, [operand]) => match self.count(*operand) {
                Some(count) => Operand::Scalar(count),
                None => self.applied(id, arguments),
            },
            (Builtin::SetIsEmpty | Builtin::SetNotEmpty | Builtin::SeqIsEmpty, [operand]) => {
                match self.count(*operand) {
                    Some(count) => {
                        let condition = if builtin == Builtin::SetNotEmpty { IntCC::NotEqual } else { IntCC::Equal };
                        let value = self.builder.ins().icmp_imm(condition, count.value, 0);
                        Operand::Scalar(Scalar::defined(Kind::Boolean, value))
                    }
                    _ => self.applied(id, arguments),
                }
            }
            (Builtin::SetContains | Builtin::SetNotIn, [set, element]) => {
                self.membership_in_literal(builtin, *set, *element, id, arguments)
            }
            (_, [left, right]) => {
                let (left, right) = (self.term(*left), self.term(*right));
                self.binary(builtin, left, right).unwrap_or_else(|| self.apply(id, &[left, right]))
            }
            (_, [operand]) => {
                let operand = self.term(*operand);
                self.unary(builtin, operand).unwrap_or_else(|| self.apply(id, &[operand]))
            }
            _ => self.applied(id, arguments),
        }
    }

    fn applied(&mut self, id: TermId, arguments: &[TermId]) -> Operand {
        let operands: Vec<Operand> = arguments.iter().map(|term| self.term(*term)).collect();
        self.apply(id, &operands)
    }

    /// `contains({a, b, …}, x)`: compared one by one where the set is written out.
    fn membership_in_literal(
        &mut self,
        builtin: Builtin,
        set: TermId,
        element: TermId,
        id: TermId,
        arguments: &[TermId],
    ) -> Operand {
        let program = self.program;
        let Term::Collection { elements, .. } = program.term(set) else { return self.applied(id, arguments) };
        if elements.len > 16 || self.kind_of(element).is_none() {
            return self.applied(id, arguments);
        }
        let members: Vec<Operand> = program.term_list(*elements).iter().map(|term| self.term(*term)).collect();
        let element = self.term(element);
        let element = self.scalar(element, self.kind_of(arguments[1]).unwrap_or(Kind::Integer));
        let Some(flag) = element.flag else { return self.is_any(builtin, &members, element) };
        let (fast, slow, done) = (self.block(), self.block(), self.block());
        self.builder.set_cold_block(slow);
        let mut merge = self.merge(id);
        self.branch(flag, fast, slow);
        self.switch(fast);
        let known = self.is_any(builtin, &members, Scalar { flag: None, ..element });
        self.leave(&mut merge, known, done);
        // An undefined element is the library's business. Nothing is evaluated twice: a member may be chosen.
        self.switch(slow);
        let written = self.apply(set, &members);
        let told = self.apply(id, &[written, Operand::Scalar(element)]);
        self.leave(&mut merge, told, done);
        self.switch(done);
        self.merged(&merge)
    }

    /// Whether an element is one of these, or none.
    fn is_any(&mut self, builtin: Builtin, members: &[Operand], element: Scalar) -> Operand {
        let mut any = self.byte(0);
        for member in members {
            let equal = self.equal(*member, Operand::Scalar(element));
            any = self.builder.ins().bor(any, equal);
        }
        self.member_result(builtin, any)
    }

    fn member_result(&mut self, builtin: Builtin, any: ir::Value) -> Operand {
        let condition = if builtin == Builtin::SetContains { IntCC::NotEqual } else { IntCC::Equal };
        let value = self.builder.ins().icmp_imm(condition, any, 0);
        Operand::Scalar(Scalar::defined(Kind::Boolean, value))
    }

    fn unary(&mut self, builtin: Builtin, operand: Operand) -> Option<Operand> {
        let Operand::Scalar(scalar) = operand else { return None };
        let result = match (builtin, scalar.kind) {
            (Builtin::IntNeg, Kind::Integer) => {
                let zero = self.word(0);
                let zero = Scalar::defined(Kind::Integer, zero).within(0, 0);
                return self.binary(Builtin::IntSub, Operand::Scalar(zero), operand);
            }
            (Builtin::IntAbs, Kind::Integer) => {
                let scalar = self.defined(scalar);
                let (low, high) = scalar.bounds();
                if low == i64::MIN {
                    let least = self.builder.ins().icmp_imm(IntCC::Equal, scalar.value, i64::MIN);
                    self.refuse(least);
                }
                let negated = self.builder.ins().ineg(scalar.value);
                let negative = self.builder.ins().icmp_imm(IntCC::SignedLessThan, scalar.value, 0);
                let value = self.builder.ins().select(negative, negated, scalar.value);
                let bound = low.saturating_neg().max(high).max(0);
                Scalar::defined(Kind::Integer, value).within(0, bound)
            }
            (Builtin::NatToInt, Kind::Integer) => self.defined(scalar),
            (Builtin::IntToNat, Kind::Integer) => {
                let scalar = self.defined(scalar);
                let (low, high) = scalar.bounds();
                if low < 0 {
                    let negative = self.builder.ins().icmp_imm(IntCC::SignedLessThan, scalar.value, 0);
                    self.refuse(negative);
                }
                scalar.within(low.max(0), high.max(0))
            }
            (Builtin::IntToReal | Builtin::NatToReal, Kind::Integer) => {
                let scalar = self.defined(scalar);
                let value = self.builder.ins().fcvt_from_sint(types::F64, scalar.value);
                Scalar::defined(Kind::Real, value)
            }
            (Builtin::RealNeg, Kind::Real) => {
                let scalar = self.defined(scalar);
                let value = self.builder.ins().fneg(scalar.value);
                self.number(value)
            }
            (Builtin::RealAbs, Kind::Real) => {
                let scalar = self.defined(scalar);
                let value = self.builder.ins().fabs(scalar.value);
                self.number(value)
            }
            _ => return None,
        };
        Some(Operand::Scalar(result))
    }

    fn binary(&mut self, builtin: Builtin, left: Operand, right: Operand) -> Option<Operand> {
        let (Operand::Scalar(a), Operand::Scalar(b)) = (left, right) else { return None };
        if a.kind != b.kind {
            return None;
        }
        let supported = match a.kind {
            Kind::Integer => matches!(
                builtin,
                Builtin::Lt
                    | Builtin::Le
                    | Builtin::Gt
                    | Builtin::Ge
                    | Builtin::IntAdd
                    | Builtin::IntSub
                    | Builtin::IntMul
                    | Builtin::IntMod
                    | Builtin::IntQuotient
                    | Builtin::IntDiv
                    | Builtin::IntMin
                    | Builtin::IntMax
            ),
            Kind::Real => matches!(
                builtin,
                Builtin::Lt
                    | Builtin::Le
                    | Builtin::Gt
                    | Builtin::Ge
                    | Builtin::RealAdd
                    | Builtin::RealSub
                    | Builtin::RealMul
                    | Builtin::RealDiv
            ),
            Kind::Char => matches!(builtin, Builtin::Lt | Builtin::Le | Builtin::Gt | Builtin::Ge),
            Kind::Boolean => matches!(builtin, Builtin::Xor | Builtin::Iff),
            _ => false,
        };
        if !supported {
            return None;
        }
        let (a, b) = (self.defined(a), self.defined(b));
        let truth = |value| Scalar::defined(Kind::Boolean, value);
        let result = match (builtin, a.kind) {
            (Builtin::Xor, _) => truth(self.builder.ins().icmp(IntCC::NotEqual, a.value, b.value)),
            (Builtin::Iff, _) => truth(self.builder.ins().icmp(IntCC::Equal, a.value, b.value)),
            (Builtin::Lt | Builtin::Le | Builtin::Gt | Builtin::Ge, Kind::Real) => {
                let condition = match builtin {
                    Builtin::Lt => FloatCC::LessThan,
                    Builtin::Le => FloatCC::LessThanOrEqual,
                    Builtin::Gt => FloatCC::GreaterThan,
                    _ => FloatCC::GreaterThanOrEqual,
                };
                truth(self.builder.ins().fcmp(condition, a.value, b.value))
            }
            (Builtin::Lt | Builtin::Le | Builtin::Gt | Builtin::Ge, _) => {
                let condition = match builtin {
                    Builtin::Lt => IntCC::SignedLessThan,
                    Builtin::Le => IntCC::SignedLessThanOrEqual,
                    Builtin::Gt => IntCC::SignedGreaterThan,
                    _ => IntCC::SignedGreaterThanOrEqual,
                };
                truth(self.builder.ins().icmp(condition, a.value, b.value))
            }
            (_, Kind::Real) => self.real(builtin, a.value, b.value),
            _ => self.integer(builtin, a, b),
        };
        Some(Operand::Scalar(result))
    }

    /// A Real result: no NaN, no negative zero.
    fn number(&mut self, value: ir::Value) -> Scalar {
        let odd = self.builder.ins().fcmp(FloatCC::Unordered, value, value);
        self.refuse(odd);
        let zero = self.builder.ins().f64const(0.0);
        let value = self.builder.ins().fadd(value, zero);
        Scalar::defined(Kind::Real, value)
    }

    fn real(&mut self, builtin: Builtin, a: ir::Value, b: ir::Value) -> Scalar {
        let value = match builtin {
            Builtin::RealAdd => self.builder.ins().fadd(a, b),
            Builtin::RealSub => self.builder.ins().fsub(a, b),
            Builtin::RealMul => self.builder.ins().fmul(a, b),
            _ => {
                let zero = self.builder.ins().f64const(0.0);
                let divides = self.builder.ins().fcmp(FloatCC::NotEqual, b, zero);
                self.require(divides);
                self.builder.ins().fdiv(a, b)
            }
        };
        self.number(value)
    }

    fn integer(&mut self, builtin: Builtin, a: Scalar, b: Scalar) -> Scalar {
        let ((al, ah), (bl, bh)) = (a.bounds(), b.bounds());
        let wide = |bounds: [i128; 4]| -> (Option<(i64, i64)>, bool) {
            let (low, high) = (*bounds.iter().min().expect("four"), *bounds.iter().max().expect("four"));
            match (i64::try_from(low), i64::try_from(high)) {
                (Ok(low), Ok(high)) => (Some((low, high)), true),
                _ => (None, false),
            }
        };
        let [al_, ah_, bl_, bh_] = [al, ah, bl, bh].map(i128::from);
        let known = |value, range| Scalar { kind: Kind::Integer, value, flag: None, range };
        match builtin {
            Builtin::IntAdd => match wide([al_ + bl_, ah_ + bh_, al_ + bl_, ah_ + bh_]) {
                (range, true) => known(self.builder.ins().iadd(a.value, b.value), range),
                _ => {
                    let (value, over) = self.builder.ins().sadd_overflow(a.value, b.value);
                    self.refuse(over);
                    known(value, None)
                }
            },
            Builtin::IntSub => match wide([al_ - bh_, ah_ - bl_, al_ - bh_, ah_ - bl_]) {
                (range, true) => known(self.builder.ins().isub(a.value, b.value), range),
                _ => {
                    let (value, over) = self.builder.ins().ssub_overflow(a.value, b.value);
                    self.refuse(over);
                    known(value, None)
                }
            },
            Builtin::IntMul => match wide([al_ * bl_, al_ * bh_, ah_ * bl_, ah_ * bh_]) {
                (range, true) => known(self.builder.ins().imul(a.value, b.value), range),
                _ => {
                    let (value, over) = self.builder.ins().smul_overflow(a.value, b.value);
                    self.refuse(over);
                    known(value, None)
                }
            },
            Builtin::IntMin | Builtin::IntMax => {
                let least = builtin == Builtin::IntMin;
                let condition = if least { IntCC::SignedLessThan } else { IntCC::SignedGreaterThan };
                let first = self.builder.ins().icmp(condition, a.value, b.value);
                let value = self.builder.ins().select(first, a.value, b.value);
                let range = if least { (al.min(bl), ah.min(bh)) } else { (al.max(bl), ah.max(bh)) };
                known(value, Some(range))
            }
            Builtin::IntDiv => {
                let zero = self.builder.ins().icmp_imm(IntCC::Equal, b.value, 0);
                self.refuse(zero);
                let (a, b) = (
                    self.builder.ins().fcvt_from_sint(types::F64, a.value),
                    self.builder.ins().fcvt_from_sint(types::F64, b.value),
                );
                let value = self.builder.ins().fdiv(a, b);
                self.number(value)
            }
            _ => self.division(builtin, a, b),
        }
    }

    /// `idiv` and `mod`, which truncate toward zero.
    fn division(&mut self, builtin: Builtin, a: Scalar, b: Scalar) -> Scalar {
        let ((al, ah), (bl, bh)) = (a.bounds(), b.bounds());
        let remainder = builtin == Builtin::IntMod;
        let known = |value, range| Scalar { kind: Kind::Integer, value, flag: None, range };
        if bl <= 0 && bh >= 0 {
            let zero = self.builder.ins().icmp_imm(IntCC::Equal, b.value, 0);
            self.refuse(zero);
        }
        if bl <= -1 && bh >= -1 && al == i64::MIN {
            let minus = self.builder.ins().icmp_imm(IntCC::Equal, b.value, -1);
            self.refuse(minus);
        }
        if al >= 0 && bl > 0 {
            let value = match (b.constant(), remainder) {
                (Some(n), true) => self.builder.ins().urem_imm(a.value, n),
                (Some(n), false) => self.builder.ins().udiv_imm(a.value, n),
                (None, true) => self.builder.ins().urem(a.value, b.value),
                (None, false) => self.builder.ins().udiv(a.value, b.value),
            };
            let range = if remainder { (0, ah.min(bh - 1)) } else { (al / bh, ah / bl) };
            return known(value, Some(range));
        }
        let value = match (b.constant(), remainder) {
            (Some(n), true) => self.builder.ins().srem_imm(a.value, n),
            (Some(n), false) => self.builder.ins().sdiv_imm(a.value, n),
            (None, true) => self.builder.ins().srem(a.value, b.value),
            (None, false) => self.builder.ins().sdiv(a.value, b.value),
        };
        let range = match b.constant() {
            Some(n) if remainder && n != i64::MIN => {
                let most = n.abs() - 1;
                Some((if al >= 0 { 0 } else { -most }, if ah <= 0 { 0 } else { most }))
            }
            _ => None,
        };
        known(value, range)
    }
}
