//! Functions that keep their values: compiled code reads them as constants.
//!
//! In: a program and a started core. Out: by function the values at its numbered locations, where no step changes them; and
//! reads of such functions as operands, of which the kind, the bounds and often the value are known. INVARIANT: the code is
//! run only while the locations have these values. Whoever changes one from outside has the machine look again
//! ([`crate::machine::Machine::has_code`]); a search says beforehand what differs between its initial states
//! ([`crate::inside::Elsewhere`]).

use std::sync::Arc;

use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::{InstBuilder, MemFlags, types};
use program::{FunctionId, FunctionKind, Program, TermId};

use crate::execute::Core;
use crate::layout::{Dimension, DimensionKind, Layout};
use crate::native::shape::{Kind, Operand, Scalar};
use crate::native::translate::Translator;
use crate::value::Value;
use crate::weighed::Items;

/// Memory that nothing changes while there is code.
const CONSTANT: MemFlags = MemFlags::trusted().with_readonly();

/// By function, the values at its numbered locations, in their order; none where they may change.
pub(super) fn settled_functions(program: &Program, core: &Core, lazy: &[bool]) -> Vec<Option<Arc<Items>>> {
    let updated = program.updated_functions();
    (0..program.functions.len())
        .map(|index| {
            let function = FunctionId(index as u32);
            let kind = program.function(function).kind;
            let kept = matches!(kind, FunctionKind::Controlled | FunctionKind::Out)
                && core.plain[index]
                && !lazy[index]
                && !core.elsewhere.varies(function)
                && !updated.contains(&function)
                && Some(function) != program.self_function;
            kept.then(|| values_of(core, function)).flatten().map(|values| Arc::new(Items::new(values.to_vec())))
        })
        .collect()
}

/// Of which functions, that were settled, the locations have other values now.
pub(super) fn unsettled(settled: &[Option<Arc<Items>>], core: &Core) -> Vec<FunctionId> {
    let functions = (0..).map(FunctionId).zip(settled);
    let changed = functions.filter(|(function, values)| {
        values.as_ref().is_some_and(|values| values_of(core, *function) != Some(&values[..]))
    });
    changed.map(|(function, _)| function).collect()
}

fn values_of(core: &Core, function: FunctionId) -> Option<&[Value]> {
    let dense = core.store.dense(function)?;
    Some(&core.store.values[dense.start as usize..dense.end as usize])
}

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
