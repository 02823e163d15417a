//! Imports the libraries of temporal operators for formulas on the command line, if the model does not import them.
//!
//! INVARIANT: the model changes only in that it knows the operators. If its own names clash with theirs, it stays
//! unchanged, and the formula's fault is reported.

use groundstate::Loaded;

use crate::shell::Shell;

/// The model with the operators of CTL and of LTL, as requested.
pub fn import(shell: &Shell, loaded: Loaded, ctl: bool, ltl: bool) -> Loaded {
    let asked = [("CTLLibrary", ctl), ("LTLLibrary", ltl)];
    let libraries: Vec<&str> = asked.iter().filter(|(_, asked)| *asked).map(|(library, _)| *library).collect();
    groundstate::with_libraries(&loaded, &libraries, &mut shell.disk()).unwrap_or(loaded)
}
