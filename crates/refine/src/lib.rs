//! Refinement: whether every run of a concrete machine corresponds to a run of an abstract one.
//!
//! In: two programs and a coupling file's text. Out: a [`Report`]: the concrete machine refines the abstract one, or does not, with both
//! runs side by side to the first step that nothing matches, or it is not known. Theory: E. Börger, *The ASM refinement method* (2003);
//! G. Schellhorn, *Verification of ASM refinements using generalized forward simulation* (2001). Decided by a game on pairs of states,
//! docs/adr/0023. It must not know files or how results are told.

mod behind;
mod bmc;
mod bounded;
mod build;
mod checkpoint;
mod circles;
mod computed;
mod coupling;
mod determined;
mod diagram;
mod evidence;
mod fair;
mod fault;
mod formulas;
mod game;
mod induction;
mod joint;
mod judge;
mod layout;
mod limited;
mod options;
mod preserve;
mod product;
mod readings;
mod refine;
mod report;
mod search;
mod short_search;
mod side;
mod transfer;
mod translate;
mod why;
mod written;

pub use bmc::refute;
pub use coupling::{Coupling, Faulty, Incomparable, LeftOut};
pub use diagram::{Diagram, Diagrams, MOST};
pub use evidence::{Ended, Refutation, Run, Segment, Tried};
pub use explore::checkpoint::{Keeper, Refusal};
pub use fault::{IDS, bad_coupling};
pub use formulas::ask::Provers;
pub use formulas::obligation::{Obligation, Origin, SOLVERS, Said};
pub use induction::proof::{Attempt, Gap, Known, Proof, Stuck};
pub use induction::prove;
pub use layout::format;
pub use options::{Extent, Options};
pub use preserve::Preserved;
pub use refine::{Trouble, refine, refine_kept};
pub use report::{Assumed, From, Left, Progress, Report, Runs, Vacuous, Verdict, Why};
pub use why::{Differs, Instance, Part};
pub use written::{Mapped, Part as WrittenPart, WORDS, Written, read};

/// The abstract machine's place in a pair.
pub const ABSTRACT: usize = 0;
/// The concrete machine's place in a pair.
pub const CONCRETE: usize = 1;
/// What the machines are called in a coupling.
pub const SIDES: [&str; 2] = ["abstract", "concrete"];
