//! Reads of functions that keep their values: constants.
//!
//! In: what [`crate::native::settled`] knows. Out: operands of which the kind, the bounds and often the value are known. It must not
//! read a location that lies outside of the array: that is read as other functions are.

use std::sync::Arc;

use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::{InstBuilder, MemFlags, types};
use program::{FunctionId, TermId};

use crate::layout::{Dimension, DimensionKind, Layout};
use crate::native::shape::{Kind, Operand, Scalar};
use crate::native::translate::Translator;
use crate::value::Value;

/// Memory that nothing changes while there is code.
const CONSTANT: MemFlags = MemFlags::trusted().with_readonly();

impl Translator<'_, '_> {
    /// Reads a location of a function that keeps its values; none where it may, or the location has no number.
    pub fn read_settled(&mut self, function: FunctionId, arguments: &[Operand], term: TermId) -> Option<Operand> {
        let values = Arc::clone(self.plan.facts.settled[function.0 as usize].as_ref()?);
        let layout = self.plan.facts.layouts[function.0 as usize].clone();
        let (place, known) = match &layout {
            Layout::Single(_) => (None, Some(0)),
            Layout::Dense { dimensions, .. } => {
                // What may lie outside of the array is read as other functions are.
                let mut known = Some(0);
                for (dimension, argument) in dimensions.iter().zip(arguments) {
                    let Operand::Scalar(scalar) = argument else { return None };
                    if scalar.flag.is_some() || !self.is_inside(dimension, *scalar) {
                        return None;
                    }
                    let index = scalar.constant().map(|number| dimension.offset_of(number));
                    known = known.zip(index).map(|(known, index)| known * i64::from(dimension.size) + index);
                }
                let parts = if known.is_none() { self.parts(dimensions, arguments)? } else { Vec::new() };
                (Some(parts), known)
            }
            Layout::None | Layout::Sparse => return None,
        };
        let kind = self.kind_of(term);
        let all_of_kind = |kind: Kind| values.iter().all(|value| value.is_undef() || kind.number_of(value).is_some());
        if kind.is_some_and(|kind| !all_of_kind(kind)) {
            return None;
        }
        let same = values.iter().all(|value| *value == values[0]);
        let known = known.or(same.then_some(0));
        // The facts keep the values as long as there is the code.
        if let Some(index) = known {
            return Some(self.known(&values[index as usize]));
        }
        let mut place_of_value = self.address(values.as_ptr());
        for part in place.into_iter().flatten() {
            place_of_value = self.builder.ins().iadd(place_of_value, part);
        }
        let Some(kind) = kind else { return Some(Operand::Boxed(place_of_value)) };
        let flag = values.iter().any(Value::is_undef).then(|| {
            let tag = self.builder.ins().load(types::I64, CONSTANT, place_of_value, 0);
            self.builder.ins().icmp_imm(IntCC::Equal, tag, kind.tag())
        });
        let value = self.payload_in(CONSTANT, place_of_value, 0, kind);
        let numbers = || values.iter().filter_map(|value| kind.number_of(value));
        let range = match kind {
            Kind::Real => None,
            _ => numbers().min().zip(numbers().max()),
        };
        Some(Operand::Scalar(Scalar { kind, value, flag, range }))
    }

    /// Whether a number lies within a dimension: it is known to, or nothing else is of its type, so that the step is given up
    /// where it does not.
    fn is_inside(&mut self, dimension: &Dimension, scalar: Scalar) -> bool {
        let kind = match dimension.kind {
            DimensionKind::Boolean => return scalar.kind == Kind::Boolean,
            DimensionKind::Enum(domain) => Kind::Enum(domain),
            DimensionKind::Element(domain) => Kind::Element(domain),
            DimensionKind::Integer { low } => {
                let last = low.saturating_add(i64::from(dimension.size) - 1);
                return scalar.kind == Kind::Integer && scalar.range.is_some_and(|(a, b)| low <= a && b <= last);
            }
        };
        if scalar.kind != kind {
            return false;
        }
        let last = i64::from(dimension.size) - 1;
        if scalar.range.is_some_and(|(a, b)| 0 <= a && b <= last) {
            return true;
        }
        if self.plan.bounds(self.program, Scalar { range: None, ..scalar }).is_none_or(|(_, most)| most > last) {
            return false;
        }
        let size = self.word(i64::from(dimension.size));
        let inside = self.builder.ins().icmp(IntCC::UnsignedLessThan, scalar.value, size);
        self.require(inside);
        true
    }
}
