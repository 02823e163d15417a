//! The libraries of temporal operators for what the command line asks: imported where the model itself does not.
//!
//! INVARIANT: the model is another only in that it knows the operators; one that has names of its own that are theirs stays
//! as it is, and the fault of the formula is told.

use groundstate::Loaded;

use crate::shell::Shell;

/// The model with the operators of CTL, of LTL, as they are asked for.
pub fn import(shell: &Shell, loaded: Loaded, ctl: bool, ltl: bool) -> Loaded {
    let asked = [("CTLLibrary", ctl), ("LTLLibrary", ltl)];
    let libraries: Vec<&str> = asked.iter().filter(|(_, asked)| *asked).map(|(library, _)| *library).collect();
    groundstate::with_libraries(&loaded, &libraries, &mut shell.disk()).unwrap_or(loaded)
}
