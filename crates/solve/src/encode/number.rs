//! Encodes numbers: arithmetic, order and conversions, with the machine's faults.
//!
//! Integers have 64 bits: a larger result is a fault. The machine rounds reals. A relation for finding runs computes
//! exactly; one for proofs allows every result within the rounding error. LIMIT: reals beyond the range of doubles.

use machine::Value;
use program::Builtin;
use syntax::Span;

use super::{Encoder, FaultClass, InputKind, Result};
use crate::shared::{Kind, Node, Terms};
use crate::symbol::{Open, Shape, Symbol};

/// The range of integers.
pub(super) const INTEGERS: (Option<i128>, Option<i128>) = (Some(i64::MIN as i128), Some(i64::MAX as i128));

impl Encoder {
    /// A number's term; adds a fault if it is undef.
    fn operand(&mut self, symbol: &Symbol) -> Option<Open> {
        self.need(symbol);
        match symbol {
            // The fault has been recorded, so any number will do.
            Symbol::Known(Value::Undef) => {
                let value = self.terms.integer(0);
                Some(Open { shape: Shape::Integer, value, defined: Terms::TRUE })
            }
            symbol => self.open(symbol, None).filter(|open| matches!(open.shape, Shape::Integer | Shape::Real)),
        }
    }

    pub(super) fn integer_operand(&mut self, symbol: &Symbol, span: Span) -> Result<Node> {
        match self.operand(symbol) {
            Some(Open { shape: Shape::Integer, value, .. }) => Ok(value),
            _ => self.outside("a range that is not of integers", span),
        }
    }

    fn real_of(&mut self, open: Open) -> Node {
        if open.shape == Shape::Real {
            return open.value;
        }
        let real = self.terms.to_real(open.value);
        match self.terms.bounds(open.value) {
            (Some(low), Some(high)) if low.abs().max(high.abs()) <= 1 << 53 => real,
            _ => self.rounded(real),
        }
    }

    /// A real as the machine rounds it.
    fn rounded(&mut self, real: Node) -> Node {
        if self.terms.constant(real).is_some() {
            return real;
        }
        self.inexact = true;
        if self.exact {
            return real;
        }
        let result = self.input("rounded", Kind::Real, (None, None), InputKind::Rounding);
        let (error, least) = (self.terms.real(2f64.powi(-53)), self.terms.real(5e-324));
        let part = self.terms.multiply(error, real);
        let zero = self.terms.real(0.0);
        let minus = self.terms.subtract(zero, part);
        let negative = self.terms.less(real, zero);
        let size = self.terms.choose(negative, minus, part);
        let room = self.terms.add(size, least);
        let (low, high) = (self.terms.subtract(real, room), self.terms.add(real, room));
        let both = [self.terms.at_most(low, result), self.terms.at_most(result, high)];
        self.given.extend(both);
        result
    }

    pub(super) fn coerce(&mut self, symbol: &Symbol, complex: bool, span: Span) -> Result {
        match symbol {
            _ if complex => self.outside("a complex number", span),
            Symbol::Open(open) if open.shape == Shape::Integer => {
                let value = self.real_of(*open);
                Ok(self.symbol(Open { shape: Shape::Real, value, ..*open }))
            }
            Symbol::Known(Value::Integer(_)) => {
                let open = self.open(symbol, None);
                let value = open.map(|open| self.real_of(open));
                Ok(value.map_or(Symbol::UNDEF, |value| {
                    self.symbol(Open { shape: Shape::Real, value, defined: Terms::TRUE })
                }))
            }
            other => Ok(other.clone()),
        }
    }

    /// A result that must fit in 64 bits.
    fn fitting(&mut self, value: Node) -> Option<Symbol> {
        let fits = self.terms.within(value, INTEGERS);
        let overflow = self.terms.not(fits);
        self.overflow(overflow);
        Some(self.symbol(Open { shape: Shape::Integer, value, defined: Terms::TRUE }))
    }

    fn real(&mut self, exact: Node) -> Option<Symbol> {
        let value = self.rounded(exact);
        Some(self.symbol(Open { shape: Shape::Real, value, defined: Terms::TRUE }))
    }

    /// Encodes the functions of numbers; `None` if this is not one of them, or its operands are not numbers of that
    /// kind.
    pub(super) fn number(&mut self, builtin: Builtin, operands: &[Symbol], span: Span) -> Result<Option<Symbol>> {
        use Builtin::*;
        let known = matches!(
            builtin,
            Lt | Le
                | Gt
                | Ge
                | IntNeg
                | IntAdd
                | IntSub
                | IntMul
                | IntDiv
                | IntMod
                | IntMin
                | IntMax
                | IntAbs
                | IntQuotient
                | IntPower
                | RealNeg
                | RealAdd
                | RealSub
                | RealMul
                | RealDiv
                | RealMin
                | RealMax
                | RealAbs
                | Floor
                | Round
                | RealToInt
                | RealToNat
                | IntToReal
                | IntToNat
                | NatToReal
                | NatToInt
        );
        if !known {
            return Ok(None);
        }
        let mut numbers = Vec::with_capacity(operands.len());
        for operand in operands {
            let Some(number) = self.operand(operand) else { return Ok(None) };
            numbers.push(number);
        }
        let whole = numbers.iter().all(|open| open.shape == Shape::Integer);
        Ok(match (builtin, &numbers[..]) {
            (Lt | Le | Gt | Ge, [a, b]) => {
                let (a, b) = if whole { (a.value, b.value) } else { (self.real_of(*a), self.real_of(*b)) };
                Some(Symbol::boolean(match builtin {
                    Lt => self.terms.less(a, b),
                    Gt => self.terms.less(b, a),
                    Le => self.terms.at_most(a, b),
                    _ => self.terms.at_most(b, a),
                }))
            }
            (
                RealNeg | RealAbs | RealMin | RealMax | RealAdd | RealSub | RealMul | RealDiv | Floor | Round
                | RealToInt | RealToNat | IntToReal | NatToReal,
                all,
            ) => {
                let all: Vec<Node> = all.iter().map(|open| self.real_of(*open)).collect();
                self.real_number(builtin, &all)
            }
            (IntPower, [base, exponent]) if whole => match self.terms.whole(exponent.value) {
                Some(exponent @ 0..=16) => {
                    let mut product = self.terms.integer(1);
                    for _ in 0..exponent {
                        product = self.terms.multiply(product, base.value);
                    }
                    self.fitting(product)
                }
                _ => return self.outside("a power whose exponent is not a small number", span),
            },
            (_, all) if whole => {
                let all: Vec<Node> = all.iter().map(|open| open.value).collect();
                self.whole_number(builtin, &all)
            }
            _ => None,
        })
    }

    fn whole_number(&mut self, builtin: Builtin, operands: &[Node]) -> Option<Symbol> {
        let zero = self.terms.integer(0);
        match (builtin, operands) {
            (Builtin::IntNeg, [a]) => {
                let negative = self.terms.subtract(zero, *a);
                self.fitting(negative)
            }
            (Builtin::IntAbs, [a]) => {
                let (negative, below) = (self.terms.subtract(zero, *a), self.terms.less(*a, zero));
                let size = self.terms.choose(below, negative, *a);
                self.fitting(size)
            }
            (Builtin::IntAdd, [a, b]) => {
                let sum = self.terms.add(*a, *b);
                self.fitting(sum)
            }
            (Builtin::IntSub, [a, b]) => {
                let difference = self.terms.subtract(*a, *b);
                self.fitting(difference)
            }
            (Builtin::IntMul, [a, b]) => {
                let product = self.terms.multiply(*a, *b);
                self.fitting(product)
            }
            (Builtin::IntMin | Builtin::IntMax, [a, b]) => {
                let less = self.terms.less(*a, *b);
                let least = builtin == Builtin::IntMin;
                let value = if least { self.terms.choose(less, *a, *b) } else { self.terms.choose(less, *b, *a) };
                self.fitting(value)
            }
            (Builtin::IntQuotient | Builtin::IntMod | Builtin::IntDiv, [a, b]) => {
                let by_zero = self.terms.equal(*b, zero);
                self.fault(FaultClass::Undefined, by_zero);
                if by_zero == Terms::TRUE {
                    return Some(Symbol::UNDEF);
                }
                match builtin {
                    Builtin::IntQuotient => {
                        let quotient = self.terms.quotient(*a, *b);
                        self.fitting(quotient)
                    }
                    Builtin::IntMod => {
                        let rest = self.terms.remainder(*a, *b);
                        self.fitting(rest)
                    }
                    _ => {
                        let whole = |value| Open { shape: Shape::Integer, value, defined: Terms::TRUE };
                        let (a, b) = (self.real_of(whole(*a)), self.real_of(whole(*b)));
                        let quotient = self.terms.divide(a, b);
                        self.real(quotient)
                    }
                }
            }
            (Builtin::IntToNat, [a]) => {
                let negative = self.terms.less(*a, zero);
                self.fault(FaultClass::Undefined, negative);
                self.fitting(*a)
            }
            (Builtin::NatToInt, [a]) => self.fitting(*a),
            _ => None,
        }
    }

    fn real_number(&mut self, builtin: Builtin, operands: &[Node]) -> Option<Symbol> {
        let zero = self.terms.real(0.0);
        // Not rounded: the result is an operand or its negative.
        let as_it_is = |this: &Self, value| Some(this.symbol(Open { shape: Shape::Real, value, defined: Terms::TRUE }));
        match (builtin, operands) {
            (Builtin::RealNeg, [a]) => {
                let negative = self.terms.subtract(zero, *a);
                as_it_is(self, negative)
            }
            (Builtin::RealAbs, [a]) => {
                let (negative, below) = (self.terms.subtract(zero, *a), self.terms.less(*a, zero));
                let size = self.terms.choose(below, negative, *a);
                as_it_is(self, size)
            }
            (Builtin::RealMin | Builtin::RealMax, [a, b]) => {
                let less = self.terms.less(*a, *b);
                let least = builtin == Builtin::RealMin;
                let value = if least { self.terms.choose(less, *a, *b) } else { self.terms.choose(less, *b, *a) };
                as_it_is(self, value)
            }
            (Builtin::IntToReal | Builtin::NatToReal, [a]) => as_it_is(self, *a),
            (Builtin::RealAdd, [a, b]) => {
                let sum = self.terms.add(*a, *b);
                self.real(sum)
            }
            (Builtin::RealSub, [a, b]) => {
                let difference = self.terms.subtract(*a, *b);
                self.real(difference)
            }
            (Builtin::RealMul, [a, b]) => {
                let product = self.terms.multiply(*a, *b);
                self.real(product)
            }
            (Builtin::RealDiv, [a, b]) => {
                let by_zero = self.terms.equal(*b, zero);
                self.fault(FaultClass::Undefined, by_zero);
                if by_zero == Terms::TRUE {
                    return Some(Symbol::UNDEF);
                }
                let quotient = self.terms.divide(*a, *b);
                self.real(quotient)
            }
            (Builtin::Floor, [a]) => {
                let whole = self.terms.floor(*a);
                self.fitting(whole)
            }
            (Builtin::Round, [a]) => {
                let whole = self.terms.floor(*a);
                let back = self.terms.to_real(whole);
                let rest = self.terms.subtract(*a, back);
                let half = self.terms.real(0.5);
                let down = self.terms.less(rest, half);
                let one = self.terms.integer(1);
                let next = self.terms.add(whole, one);
                let nearest = self.terms.choose(down, whole, next);
                self.fitting(nearest)
            }
            (Builtin::RealToInt | Builtin::RealToNat, [a]) => {
                let minus = self.terms.subtract(zero, *a);
                let (down, up) = (self.terms.floor(*a), self.terms.floor(minus));
                let none = self.terms.integer(0);
                let up = self.terms.subtract(none, up);
                let below = self.terms.less(*a, zero);
                let whole = self.terms.choose(below, up, down);
                if builtin == Builtin::RealToNat {
                    let negative = self.terms.less(whole, none);
                    self.fault(FaultClass::Undefined, negative);
                }
                self.fitting(whole)
            }
            _ => None,
        }
    }
}
