//! Checks lossless trees, and makes the model of them.
//!
//! In: the root file and a [`Loader`] that finds imported texts. Out: [`Checked`]: the sources read, an immutable
//! [`Model`] in which every name is resolved, every term has a domain and every coercion is explicit, and the
//! faults found. If no fault is an error, the model is complete; later stages may rely on that.
//!
//! Definitions follow E. Börger, R. Stärk, *Abstract State Machines*, Springer 2003, chapter 2; where AsmetaL
//! differs, spec/language.md says so. It must not know how a model is executed or what a shell looks like.

pub mod domain;
pub mod rule;
pub mod term;

mod check;
mod coerce;
mod collection;
mod compat;
mod constant;
mod declaration;
mod declare;
mod dump;
mod endless;
mod fault;
mod fragment;
mod id;
mod imports;
mod library;
mod macros;
mod model;
mod names;
mod overload;
mod running;
mod site;
mod suggest;
mod unstarted;
mod uses;
mod visit;

pub use check::check;

pub use collection::CollectionKind;
pub use declaration::{Definition, Function, FunctionKind, Rule, Variable};
pub use domain::{Basic, Domain, DomainKind, Domains};
pub use fault::IDS;
pub use fault::name::missing_operator;
pub use fragment::Fragment;
pub use id::DomainId;
pub use id::{FunctionId, RuleId, VariableId};
pub use library::{find as library, libraries};
pub use model::{AgentProgram, Checked, Init, InitialFunction, Loader, Model, Property, PropertyKind};
pub use names::Names;
pub use rule::{Call, RuleKind, RuleNode, Target};
pub use site::kind_word;
pub use suggest::nearest;
pub use term::{Binder, Literal, Quantifier, Term, TermKind};
pub use uses::{Referent, Use, Uses};
