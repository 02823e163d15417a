//! Formulas without branches: connectives of simple parts, in Kleene's logic.
//!
//! Where every part is a read or a comparison that asks nobody and cannot be at fault, evaluating all of it is cheaper
//! than jumping around the half that does not matter. The value is what the interpreter's would be; where that is
//! undef the flag is zero.

use cranelift_codegen::ir::{self, InstBuilder};
use program::{Builtin, Term, TermId};

use crate::layout::Layout;
use crate::native::shape::{Bound, Kind, Scalar};
use crate::native::translate::Translator;

/// LIMIT: terms of a formula evaluated as a whole.
const SIMPLE: u32 = 12;

impl Translator<'_, '_> {
    /// A formula of simple parts: its value, and a flag that is zero where it is undef.
    pub fn branchless(&mut self, id: TermId) -> Option<Scalar> {
        self.is_simple(id, &mut { SIMPLE }).then(|| self.kleene(id))
    }

    fn is_simple(&self, id: TermId, left: &mut u32) -> bool {
        let program = self.program;
        if *left == 0 {
            return false;
        }
        *left -= 1;
        match program.term(id) {
            Term::Builtin { builtin, arguments } => match (builtin, program.term_list(*arguments)) {
                (Builtin::And | Builtin::Or, [a, b]) => self.is_simple(*a, left) && self.is_simple(*b, left),
                (Builtin::Not, [a]) => self.is_simple(*a, left),
                (Builtin::Eq | Builtin::Neq, [a, b]) => self.is_direct(*a) && self.is_direct(*b),
                (Builtin::IsDef | Builtin::IsUndef, [a]) => self.is_direct(*a),
                _ => false,
            },
            Term::Read { .. } | Term::Slot(_) => self.kind_of(id) == Some(Kind::Boolean) && self.is_direct(id),
            _ => false,
        }
    }

    /// Whether a term is a constant, a variable, or a location that stands in the store.
    fn is_direct(&self, id: TermId) -> bool {
        let program = self.program;
        match program.term(id) {
            Term::Constant(_) => self.kind_of(id).is_some(),
            Term::Slot(slot) => {
                let bound = self.frames.last().and_then(|frame| frame.slots.get(slot.0 as usize));
                matches!(bound, Some(Bound::Scalar(_)))
            }
            Term::Read { function, arguments } => {
                let index = function.0 as usize;
                let variables = |term: &TermId| matches!(program.term(*term), Term::Slot(_));
                self.plan.facts.plain[index]
                    && !self.plan.facts.lazy[index]
                    && self.kind_of(id).is_some()
                    && !matches!(self.plan.facts.layouts[index], Layout::Sparse)
                    && program.term_list(*arguments).iter().all(variables)
            }
            _ => false,
        }
    }

    fn kleene(&mut self, id: TermId) -> Scalar {
        let program = self.program;
        if let Term::Builtin { builtin, arguments } = program.term(id) {
            match (builtin, program.term_list(*arguments)) {
                (Builtin::And | Builtin::Or, [a, b]) => {
                    let (a, b) = (self.kleene(*a), self.kleene(*b));
                    return self.connected(*builtin == Builtin::And, a, b);
                }
                (Builtin::Not, [a]) => {
                    let a = self.kleene(*a);
                    let value = self.builder.ins().bxor_imm(a.value, 1);
                    return Scalar { flag: a.flag, ..Scalar::defined(Kind::Boolean, value) };
                }
                _ => {}
            }
        }
        let operand = self.term(id);
        let scalar = self.scalar(operand, Kind::Boolean);
        // What stands beside the tag of undef is no truth value.
        let value = match scalar.flag {
            Some(flag) => self.builder.ins().band(scalar.value, flag),
            None => scalar.value,
        };
        Scalar { value, range: None, ..scalar }
    }

    fn connected(&mut self, and: bool, a: Scalar, b: Scalar) -> Scalar {
        let value =
            if and { self.builder.ins().band(a.value, b.value) } else { self.builder.ins().bor(a.value, b.value) };
        if a.flag.is_none() && b.flag.is_none() {
            return Scalar::defined(Kind::Boolean, value);
        }
        let one = self.byte(1);
        let (a_flag, b_flag) = (a.flag.unwrap_or(one), b.flag.unwrap_or(one));
        // An operand that decides by itself makes up for the other's being undef.
        let mut decides = |scalar: Scalar, flag: ir::Value| {
            let value = if and { self.builder.ins().bxor_imm(scalar.value, 1) } else { scalar.value };
            self.builder.ins().band(value, flag)
        };
        let (a_decides, b_decides) = (decides(a, a_flag), decides(b, b_flag));
        let both = self.builder.ins().band(a_flag, b_flag);
        let any = self.builder.ins().bor(a_decides, b_decides);
        let flag = self.builder.ins().bor(both, any);
        Scalar { flag: Some(flag), ..Scalar::defined(Kind::Boolean, value) }
    }
}
