//! Lowers the checked model to the IR, which the machine, the checker and the generators read.
//!
//! In: a complete [`model::Model`]. Out: a [`Program`]: flat arenas of terms and rules in which variables are frame
//! slots, macro calls are procedures specialised on their by-name arguments, and library functions are
//! [`Builtin`]s. It must not know values, states or how a step is made.

mod builtin;
mod certain;
mod dump;
mod ir;
mod lower;
mod verify;

pub use builtin::{Builtin, BuiltinInfo, Cpp, Effect, Kind, LooksThrough, Operands, ShowsOrder, TemporalOperator};
pub use certain::{Certain, Certainty, Entered, Locations};
pub use dump::dump;
pub use ir::*;
pub use lower::{IDS, lower, lower_location, lower_rule, lower_term};
pub use model::{Basic, CollectionKind, DomainId, FunctionId, FunctionKind, Literal, PropertyKind, Quantifier};
pub use verify::verify;
