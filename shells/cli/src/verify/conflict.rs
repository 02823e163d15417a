//! Explains conflicts between options of `verify`.

use groundstate::verify::{Conflict, EngineKind, Part};

use crate::failure::Failure;

/// The option for a part of a request.
fn option(part: Part) -> &'static str {
    match part {
        Part::First => "--first",
        Part::MaxStates => "--max-states",
        Part::MaxDepth => "--depth",
        Part::PartialOrder => "--partial-order",
        Part::Symmetry => "--symmetry",
        Part::Storage => "--storage",
        Part::Checkpoint => "--checkpoint",
        Part::Disk => "--disk",
    }
}

/// Why a request cannot be carried out.
pub fn conflict(conflict: Conflict) -> Failure {
    let (message, help) = match conflict {
        Conflict::Engine(part @ (Part::First | Part::MaxStates | Part::MaxDepth), EngineKind::Symbolic) => (
            format!("{} does not work with --engine bdd", option(part)),
            "bound sets of states by --max-memory and --time, or leave out --engine bdd".to_string(),
        ),
        Conflict::Engine(part, _) => (
            format!("{} works only with the explicit engine", option(part)),
            format!("leave out --engine, or {}", option(part)),
        ),
        Conflict::Parts(one, other) => (
            format!("{} and {} cannot be combined", option(one), option(other)),
            format!("leave out {} or {}", option(one), option(other)),
        ),
    };
    Failure::usage_with_help(message, help)
}
