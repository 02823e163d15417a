//! What compiled code must not rely on, though the present state and the program's rules would have it so.
//!
//! In: what whoever runs the machine knows of other states, for one the other initial states of a search. Out: by function, whether
//! its locations may have other values than now although no step changes them, and whether some may be undef. INVARIANT: a
//! function of which nothing is said is the same in all states but for what steps do.

use program::FunctionId;

/// See the module.
#[derive(Debug, Clone, Default)]
pub struct Elsewhere {
    varies: Vec<bool>,
    undefined: Vec<bool>,
}

impl Elsewhere {
    /// By function: whether its values may be others, and whether some may be undef.
    pub fn new(varies: Vec<bool>, undefined: Vec<bool>) -> Elsewhere {
        Elsewhere { varies, undefined }
    }

    /// Whether a function may have other values than now without an update.
    pub fn varies(&self, function: FunctionId) -> bool {
        self.varies.get(function.0 as usize).is_some_and(|varies| *varies)
    }

    /// Whether it may be undef without an update.
    pub fn may_be_undef(&self, function: FunctionId) -> bool {
        self.undefined.get(function.0 as usize).is_some_and(|undefined| *undefined)
    }

    /// Adds functions that may have other values.
    pub(crate) fn add_varying(&mut self, functions: &[FunctionId]) {
        for function in functions {
            let index = function.0 as usize;
            self.varies.resize(self.varies.len().max(index + 1), false);
            self.varies[index] = true;
        }
    }
}
