//! The numbers of each function's locations in the store.
//!
//! In: the program and the contents of its static domains. Out: a [`Layout`] for each function. A function over small
//! finite domains is *dense*: its locations are an array, and a location's number is computed from its arguments. For an
//! infinite or growing domain, the array covers a window. All other functions are *sparse*, and so are arguments outside
//! the array, such as undef: their locations are numbered as they appear. INVARIANT: number ↔ location is one to one.

use program::{DomainId, DomainKind, Function, FunctionKind, Program};

use crate::value::Value;

/// The number of a location in the store.
pub type LocationIndex = u32;

/// LIMIT: a function with more locations than this is sparse.
const DENSE_LIMIT: u64 = 1 << 18;

/// Where a function's locations stand.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Layout {
    /// It has none: static or derived by definition, or of the library.
    None,
    /// One location: a function without arguments.
    Single(LocationIndex),
    /// An array from `base`, one dimension a parameter, the last varying fastest.
    Dense { base: LocationIndex, len: u32, dimensions: Box<[Dimension]> },
    /// Numbered as they come up.
    Sparse,
}

/// How one argument becomes an index.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Dimension {
    pub kind: DimensionKind,
    pub size: u32,
}

/// The values a dimension covers: `size` of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum DimensionKind {
    Boolean,
    Enum(DomainId),
    Element(DomainId),
    Integer { low: i64 },
}

impl Dimension {
    /// The index of a value, if the dimension covers it.
    #[inline]
    pub fn index(&self, value: &Value) -> Option<u32> {
        let index = match (self.kind, value) {
            (DimensionKind::Boolean, Value::Boolean(b)) => u32::from(*b),
            (DimensionKind::Enum(domain), Value::Enum(other, index)) if domain == *other => *index,
            (DimensionKind::Element(domain), Value::Element(other, index)) if domain == *other => *index,
            (DimensionKind::Integer { low }, Value::Integer(n)) => {
                u32::try_from(n.wrapping_sub(low)).ok().filter(|_| *n >= low)?
            }
            _ => return None,
        };
        (index < self.size).then_some(index)
    }

    /// The index of a covered value's number: an integer, or the place of a literal, an element, a truth value.
    pub fn offset_of(&self, number: i64) -> i64 {
        match self.kind {
            DimensionKind::Boolean | DimensionKind::Enum(_) | DimensionKind::Element(_) => number,
            DimensionKind::Integer { low } => number - low,
        }
    }

    /// The value of an index.
    pub fn value(&self, index: u32) -> Value {
        match self.kind {
            DimensionKind::Boolean => Value::Boolean(index == 1),
            DimensionKind::Enum(domain) => Value::Enum(domain, index),
            DimensionKind::Element(domain) => Value::Element(domain, index),
            DimensionKind::Integer { low } => Value::Integer(low + i64::from(index)),
        }
    }
}

/// What is known of the extents of a program's domains.
pub(crate) struct Extents<'a> {
    pub program: &'a Program,
    /// The elements of a static concrete domain, where they are known.
    pub contents: &'a dyn Fn(DomainId) -> Option<Vec<Value>>,
    /// By domain: no step makes elements of it, whatever was declared.
    constant: Vec<bool>,
}

impl<'a> Extents<'a> {
    pub fn new(program: &'a Program, contents: &'a dyn Fn(DomainId) -> Option<Vec<Value>>) -> Extents<'a> {
        Extents { program, contents, constant: program.constant_domains() }
    }
}

/// Lays out all functions; gives the layouts and the number of dense locations. A window, which is memory for locations that
/// may never come up, is laid out only while there are at most `most` locations.
pub(crate) fn lay_out(extents: &Extents<'_>, most: u64) -> (Vec<Layout>, u32) {
    let program = extents.program;
    let mut next = 0u32;
    let layouts = program.functions.iter().map(|function| {
        if !has_locations(function) {
            return Layout::None;
        }
        if function.parameters.is_empty() {
            next += 1;
            return Layout::Single(next - 1);
        }
        let Some((dimensions, len)) = dimensions_of(extents, &function.parameters) else {
            return Layout::Sparse;
        };
        let all_inside = || function.parameters.iter().all(|domain| dimension(extents, *domain).is_some());
        if next > u32::MAX / 2 || u64::from(next) + u64::from(len) > most && !all_inside() {
            return Layout::Sparse;
        }
        let base = next;
        next += len;
        Layout::Dense { base, len, dimensions }
    });
    let layouts = layouts.collect();
    (layouts, next)
}

/// The dimensions of an array over these domains and its length, if they are finite and small.
pub(crate) fn dimensions_of(extents: &Extents<'_>, domains: &[DomainId]) -> Option<(Box<[Dimension]>, u32)> {
    let dimensions: Box<[Dimension]> = domains
        .iter()
        .map(|domain| dimension(extents, *domain).or_else(|| window(extents.program, *domain, domains.len())))
        .collect::<Option<_>>()?;
    let len = dimensions.iter().fold(1u64, |len, dimension| len.saturating_mul(u64::from(dimension.size)));
    (1..=DENSE_LIMIT).contains(&len).then_some((dimensions, len as u32))
}

fn has_locations(function: &Function) -> bool {
    match function.kind {
        FunctionKind::Static | FunctionKind::Derived => false,
        FunctionKind::Monitored
        | FunctionKind::Controlled
        | FunctionKind::Shared
        | FunctionKind::Out
        | FunctionKind::Local => true,
    }
}

fn dimension(extents: &Extents<'_>, domain: DomainId) -> Option<Dimension> {
    let Extents { program, contents, constant } = extents;
    match &program.domain(domain).kind {
        DomainKind::Basic(model::Basic::Boolean) => Some(Dimension { kind: DimensionKind::Boolean, size: 2 }),
        DomainKind::Enum { literals } => {
            Some(Dimension { kind: DimensionKind::Enum(domain), size: literals.len() as u32 })
        }
        DomainKind::Abstract { elements, dynamic } if !dynamic || constant[domain.0 as usize] => {
            Some(Dimension { kind: DimensionKind::Element(domain), size: elements.len() as u32 })
        }
        DomainKind::Concrete { base, .. } => match &program.domain(*base).kind {
            DomainKind::Basic(model::Basic::Integer | model::Basic::Natural) => integers(&contents(domain)?),
            DomainKind::Basic(_) => dimension(extents, *base),
            DomainKind::Enum { .. } | DomainKind::Abstract { .. } => dimension(extents, *base),
            _ => None,
        },
        _ => None,
    }
}

/// A part of an infinite or growing domain: the values that most models use of it. Others are sparse.
fn window(program: &Program, domain: DomainId, parameters: usize) -> Option<Dimension> {
    let size = match parameters {
        1 => 256,
        2 => 32,
        _ => return None,
    };
    match &program.domain(domain).kind {
        DomainKind::Basic(model::Basic::Integer) => Some(Dimension { kind: DimensionKind::Integer { low: -4 }, size }),
        DomainKind::Basic(model::Basic::Natural) => Some(Dimension { kind: DimensionKind::Integer { low: 0 }, size }),
        DomainKind::Abstract { elements, .. } => {
            Some(Dimension { kind: DimensionKind::Element(domain), size: elements.len() as u32 + size / 4 })
        }
        DomainKind::Concrete { base, .. } => window(program, *base, parameters),
        _ => None,
    }
}

/// The span from the least to the greatest of these numbers.
fn integers(contents: &[Value]) -> Option<Dimension> {
    let numbers = || contents.iter().filter_map(|value| if let Value::Integer(n) = value { Some(*n) } else { None });
    let (low, high) = (numbers().min()?, numbers().max()?);
    let size = u32::try_from(high.checked_sub(low)?.checked_add(1)?).ok()?;
    let compact = u64::from(size) <= 4 * contents.len() as u64 + 16;
    compact.then_some(Dimension { kind: DimensionKind::Integer { low }, size })
}
