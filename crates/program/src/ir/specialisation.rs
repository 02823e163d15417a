//! Maps a rule with its arguments to the procedure that stands for it. The map is kept with the program, so that terms and
//! rules that are lowered later use the same procedures.

use std::collections::BTreeMap;

use crate::ir::ProcedureId;

/// Names a by-name argument: equal arguments have one id.
pub(crate) type ArgumentId = u32;

/// The procedures of rules with their arguments.
#[derive(Debug, Clone, Default)]
pub struct Specialisations {
    /// By-name arguments by their canonical text.
    pub(crate) arguments: BTreeMap<String, ArgumentId>,
    /// Procedures by rule and shape of the arguments.
    pub(crate) procedures: BTreeMap<String, ProcedureId>,
}
