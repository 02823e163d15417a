//! Which procedure stands for which rule with which arguments: kept with the program, so that terms and rules lowered later
//! share its procedures.

use std::collections::BTreeMap;

use crate::ir::ProcedureId;

/// Names a by-name argument: equal arguments have one id.
pub(crate) type ArgumentId = u32;

/// Which procedure stands for which rule with which arguments.
#[derive(Debug, Clone, Default)]
pub struct Specialisations {
    /// By-name arguments by their canonical text.
    pub(crate) arguments: BTreeMap<String, ArgumentId>,
    /// Procedures by rule and shape of the arguments.
    pub(crate) procedures: BTreeMap<String, ProcedureId>,
}
