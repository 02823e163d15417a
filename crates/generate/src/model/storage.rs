//! Chooses the class of the runtime that stores the locations of a function.
//!
//! In: the generator's assumptions about the function, and its [`Form`]. Out: a [`Storage`], the class as C++ writes
//! it. Few locations with small values share one machine word; intervals tell how many bits an integer takes.

use program::{DomainKind, FunctionId};

use crate::model::form::Form;
use crate::model::generator::Generator;
use crate::model::plan::{FunctionPlan, Role, integer};
use crate::model::types::Type;

/// LIMIT: functions with at most this many locations log their updates within the object; larger ones on the heap.
const LOG_IN_PLACE: u64 = 64;
/// The bits of a machine word.
const WORD: u64 = 64;

/// The storage of a function.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Storage {
    /// The class.
    pub class: String,
    /// Where updates of the running step are stored.
    pub updates: Updates,
}

/// Where a running step stores its updates of a function.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Updates {
    /// Nowhere: no rule updates it.
    None,
    /// In a local variable of the step.
    Step,
    /// In a log of its own.
    Log,
}

impl Generator<'_> {
    /// The storage of a function that has locations.
    pub fn storage(&self, id: FunctionId) -> Storage {
        let function = self.plan.function(id);
        let total = self.assumed.total[id.0 as usize];
        let cell = self.plan.cpp(function.ty, total);
        let whole = self.is_whole(id);
        let capacity = self.capacity(&self.program.function(id).name);
        let sparse = match (whole, self.options.bare) {
            (true, _) => "gs::Nowhere".to_string(),
            (false, false) => "gs::Growing".to_string(),
            (false, true) => format!("gs::AtMost<{}>", capacity.unwrap_or(0)),
        };
        let (dimensions, places) = self.dimensions(id);
        let locations = places + u64::from(capacity.unwrap_or(0));
        // The log holds up to one update of a location per level of nesting.
        let log = match (self.writes.levels, self.options.bare) {
            (Some(levels), false) if whole && locations <= LOG_IN_PLACE => locations.max(1) * (levels + 1).max(9),
            (levels, true) => locations.max(1) * (levels.unwrap_or(0) + 1).max(9),
            _ => 0,
        };
        let kept = |class: String| Storage { class, updates: Updates::Log };
        let stepped = |class: String| Storage { class, updates: Updates::Step };
        match function.role {
            Role::Input => return kept(format!("gs::Inputs<{cell}, {sparse}{dimensions}>")),
            Role::Shared => return kept(format!("gs::SharedLocations<{cell}, {sparse}, {log}{dimensions}>")),
            _ => {}
        }
        if self.is_fixed(id) {
            return Storage { class: format!("gs::Fixed<{cell}{dimensions}>"), updates: Updates::None };
        }
        let form = self.form(id);
        let clashes = match form {
            Form::General | Form::Unsequenced => "gs::Clashes::possible",
            Form::Disjoint | Form::Whole => "gs::Clashes::impossible",
        };
        match form {
            Form::General => {}
            _ if function.dimensions.is_empty() => return stepped(format!("gs::Location<{clashes}, {cell}>")),
            Form::Unsequenced | Form::Disjoint | Form::Whole if whole && locations <= LOG_IN_PLACE => {
                if let Some((code, bits)) = self.code(id, function, total)
                    && bits * locations <= WORD
                {
                    return stepped(format!("gs::Word<{clashes}, {code}{dimensions}>"));
                }
                if form != Form::Whole {
                    return stepped(format!("gs::FewLocations<{clashes}, {cell}{dimensions}>"));
                }
            }
            _ => {}
        }
        match form {
            Form::Whole => {
                let capacity = if self.options.bare { places } else { 0 };
                stepped(format!("gs::WholeArray<{cell}, {capacity}{dimensions}>"))
            }
            Form::Disjoint => kept(format!("gs::DisjointLocations<{cell}, {sparse}, {log}{dimensions}>")),
            Form::General | Form::Unsequenced => kept(format!("gs::Locations<{cell}, {sparse}, {log}{dimensions}>")),
        }
    }

    /// Whether no rule updates the function and all its locations are in its array.
    pub fn is_fixed(&self, id: FunctionId) -> bool {
        self.plan.function(id).role == Role::State && self.is_whole(id) && !self.writes.anywhere(id)
    }

    /// How many places a function's array has.
    pub fn places(&self, id: FunctionId) -> u64 {
        self.dimensions(id).1
    }

    /// The dimensions of a function's array as template arguments, and its number of places.
    fn dimensions(&self, id: FunctionId) -> (String, u64) {
        let mut text = String::new();
        let mut places = 1;
        for (argument, dimension) in self.plan.function(id).dimensions.iter().enumerate() {
            let undef = self.has_undef_place(id, argument);
            let class = &dimension.text;
            text += &if undef { format!(", gs::OrUndef<{class}>") } else { format!(", {class}") };
            places *= dimension.size + u64::from(undef);
        }
        (text, places)
    }

    /// How to store a function's values in few bits, and in how many.
    fn code(&self, id: FunctionId, function: &FunctionPlan, total: bool) -> Option<(String, u64)> {
        let ordinals = |count: usize| -> Option<(String, u64)> {
            let count = u64::try_from(count).ok().filter(|count| *count > 0)?;
            Some((format!("gs::OrdinalCode<{}, {count}>", self.plan.cpp(function.ty, true)), count))
        };
        let (code, count) = match function.ty {
            Type::Boolean => ordinals(2),
            Type::Enum(domain) => match &self.program.domain(domain).kind {
                DomainKind::Enum { literals } => ordinals(literals.len()),
                _ => None,
            },
            Type::Element(domain) => match &self.program.domain(domain).kind {
                DomainKind::Abstract { elements, dynamic: false } => ordinals(elements.len()),
                _ => None,
            },
            Type::Integer => {
                let values = self.assumed.values[id.0 as usize];
                let count = i128::from(values.high) - i128::from(values.low) + 1;
                let count = u64::try_from(count).ok().filter(|count| (1..1 << 32).contains(count))?;
                Some((format!("gs::IntegerCode<{}, {}>", integer(values.low), integer(values.high)), count))
            }
            _ => None,
        }?;
        let (code, count) = if total { (code, count) } else { (format!("gs::MaybeCode<{code}>"), count + 1) };
        Some((code, u64::from(64 - (count - 1).leading_zeros()).max(1)))
    }
}
